// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

#include "include/nasty_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

// each simplex with corners of its own
template <std::size_t N>
Nasty_shape<N> unwelded(const Nasty_shape<N>& shape)
{
  Nasty_shape<N> result;
  for(const auto& simplex : shape.simplices)
  {
    result.simplices.emplace_back();
    for(std::size_t k = 0; k < N; ++k)
    {
      result.simplices.back()[k] = result.points.size();
      result.points.push_back(shape.points[simplex[k]]);
    }
  }
  return result;
}

// both beside each other, with nothing between them
template <std::size_t N>
Nasty_shape<N> beside(Nasty_shape<N> a, const Nasty_shape<N>& b)
{
  const std::size_t n = a.points.size();
  for(const auto& p : b.points)
    a.points.push_back(p + Eigen::Vector3d(0, 0, 5));
  for(auto simplex : b.simplices)
  {
    for(std::size_t& corner : simplex)
      corner += n;
    a.simplices.push_back(simplex);
  }
  return a;
}

template <std::size_t N, typename Function>
Nasty_shape<N> moved(Nasty_shape<N> shape, const Function& f)
{
  for(auto& p : shape.points)
    p = f(p);
  return shape;
}

// What surfaces and volumes have in common; `shape` is a good one.
template <std::size_t N>
void add_common_shapes(const Nasty_shape<N>& shape, std::vector<Nasty_shape<N>>& shelf)
{
  using V = Eigen::Vector3d;
  const auto add = [&shelf](const std::string& name, Nasty_shape<N> nasty) {
    nasty.name = name;
    shelf.push_back(std::move(nasty));
  };
  const auto change = [&shape](const auto& f) {
    Nasty_shape<N> changed = shape;
    f(changed);
    return changed;
  };
  const auto& middle = shape.simplices[shape.simplices.size() / 2];
  add("nothing wrong", shape);
  add("one simplex", {"", {shape.points.begin(), shape.points.begin() + 4}, {[] {
    std::array<std::size_t, N> corners;
    for(std::size_t k = 0; k < N; ++k)
      corners[k] = k;
    return corners;
  }()}});
  add("two vertices at one place", change([&](auto& s) {
    s.points[middle[0]] = s.points[middle[1]];
  }));
  add("two vertices nearly at one place", change([&](auto& s) {
    s.points[middle[0]] = s.points[middle[1]] + V(1e-12, -1e-12, 2e-12);
  }));
  add("a simplex in one point", change([&](auto& s) {
    for(std::size_t corner : middle)
      s.points[corner] = s.points[middle[0]];
  }));
  add("a simplex on a line", change([&](auto& s) {
    for(std::size_t k = 2; k < N; ++k)
      s.points[middle[k]] = s.points[middle[0]] +
                            (0.2 + 0.3 * double(k)) * (s.points[middle[1]] - s.points[middle[0]]);
  }));
  add("a simplex nearly on a line", change([&](auto& s) {
    s.points[middle[2]] = (s.points[middle[0]] + s.points[middle[1]]) / 2 + V(0, 0, 1e-9);
  }));
  add("a simplex twice", change([&](auto& s) { s.simplices.push_back(middle); }));
  add("a simplex mirrored", change([&](auto& s) {
    s.simplices.push_back(middle);
    std::swap(s.simplices.back()[0], s.simplices.back()[1]);
  }));
  add("unreferenced vertices", change([](auto& s) {
    s.points.insert(s.points.end(), {V(9, 9, 9), V(0, 0, 0), s.points[0]});
  }));
  add("unwelded", unwelded(shape));
  add("two components", beside(shape, shape));
  add("a component that is nothing but a point", beside(shape, moved(shape, [](const V&) {
    return V(1, 2, 3);
  })));
  add("all on a line", moved(shape, [](const V& p) { return V(p.x() + 0.1 * p.y() + 0.3 * p.z(),
                                                              0, 0); }));
  add("all on a skew line", moved(shape, [](const V& p) {
    return V(V(1, 2, 3) * (p.x() + 0.1 * p.y() + 0.3 * p.z()));
  }));
  add("all at one point", moved(shape, [](const V&) { return V(1, 2, 3); }));
  add("all at the origin", moved(shape, [](const V&) { return V(0, 0, 0); }));
  add("flat", moved(shape, [](const V& p) { return V(p.x(), p.y(), 0); }));
  add("all but flat", moved(shape, [](const V& p) { return V(p.x(), p.y(), 1e-10 * p.z()); }));
  add("thin", moved(shape, [](const V& p) { return V(p.x(), 1e-7 * p.y(), p.z()); }));
  add("tiny", moved(shape, [](const V& p) { return V(1e-12 * p); }));
  add("huge", moved(shape, [](const V& p) { return V(1e12 * p); }));
  add("far from the origin", moved(shape, [](const V& p) { return V(p + V(1e6, -2e6, 5e5)); }));
  add("very far from the origin", moved(shape, [](const V& p) {
    return V(p + V(1e12, -2e12, 5e11));
  }));
  add("of very different sizes", moved(shape, [](const V& p) {
    return V(std::pow(10.0, 4 * p.x()) * p);
  }));
}

} // namespace

Nasty_surface sheet_of(int nu, int nv)
{
  const Shape shape = grid("", nu, nv, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.1 * std::sin(5 * u) * std::cos(4 * v));
  });
  return {"", shape.points, shape.triangles};
}

Nasty_volume block_of(int nx, int ny, int nz)
{
  const Block solid = block(nx, ny, nz);
  return {"", solid.points, solid.tetrahedra};
}

std::vector<Nasty_surface> nasty_surfaces()
{
  using V = Eigen::Vector3d;
  std::vector<Nasty_surface> shelf;
  add_common_shapes(sheet_of(8, 5), shelf);
  const double pi = std::acos(-1.0);

  Nasty_surface fins = {"three sheets at an edge", {}, {}};
  for(int fin = 0; fin < 3; ++fin)
    for(std::size_t k = 0; k < 6; ++k)
    {
      if(fin == 0)
        fins.points.emplace_back(double(k), 0, 0);
      fins.points.emplace_back(double(k), std::cos(fin), std::sin(fin));
    }
  // the vertices of the edge are 0, 2, ..., 10, those of the fins 1, 3, ..., and 12 and more
  for(std::size_t fin = 0; fin < 3; ++fin)
    for(std::size_t k = 0; k < 5; ++k)
    {
      const std::size_t outer = fin == 0 ? 2 * k + 1 : 6 + 6 * fin + k;
      const std::size_t next = fin == 0 ? outer + 2 : outer + 1;
      fins.simplices.insert(fins.simplices.end(),
                            {{2 * k, 2 * k + 2, outer}, {2 * k + 2, next, outer}});
    }
  shelf.push_back(fins);

  shelf.push_back({"two triangles at a vertex",
                   {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0.5}},
                   {{0, 1, 2}, {0, 3, 4}}});

  Nasty_surface moebius = {"a Moebius strip", {}, {}};
  const std::size_t n = 24;
  for(std::size_t k = 0; k < n; ++k)
    for(double w : {-0.3, 0.3})
    {
      const double a = 2 * pi * double(k) / double(n);
      moebius.points.emplace_back((1 + w * std::cos(a / 2)) * std::cos(a),
                                  (1 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2));
    }
  for(std::size_t k = 0; k < n; ++k)
  {
    const std::size_t a = 2 * k, b = a + 1, is_last = k + 1 == n;
    const std::size_t c = is_last ? 1 : a + 2, d = is_last ? 0 : a + 3;
    moebius.simplices.insert(moebius.simplices.end(), {{a, c, b}, {b, c, d}});
  }
  shelf.push_back(moebius);

  Nasty_surface fan = {"a vertex with 400 neighbors", {{0, 0, 0.1}}, {}};
  for(std::size_t k = 0; k < 400; ++k)
  {
    const double a = 2 * pi * double(k) / 400;
    fan.points.emplace_back(std::cos(a), std::sin(a), 0);
    fan.simplices.push_back({0, k + 1, (k + 1) % 400 + 1});
  }
  shelf.push_back(fan);

  Nasty_surface crossing = sheet_of(6, 6);
  const Nasty_surface other = crossing;
  crossing = beside(crossing, moved(other, [](const V& p) {
    return V(p.z() + 1, p.y(), p.x() - 6);
  }));
  crossing.name = "two sheets through each other";
  shelf.push_back(crossing);
  return shelf;
}

std::vector<Nasty_polygons> nasty_polygons()
{
  const std::size_t nu = 6, nv = 4;
  Nasty_polygons quadrangles;
  for(std::size_t i = 0; i <= nu; ++i)
    for(std::size_t j = 0; j <= nv; ++j)
      quadrangles.points.emplace_back(0.4 * double(i), 0.3 * double(j),
                                      0.1 * std::sin(double(i) + 2.0 * double(j)));
  for(std::size_t i = 0; i < nu; ++i)
    for(std::size_t j = 0; j < nv; ++j)
    {
      const std::size_t v = i * (nv + 1) + j, next = v + nv + 1;
      quadrangles.simplices.push_back({v, next, next + 1, v + 1});
    }
  std::vector<Nasty_polygons> shelf;
  add_common_shapes(quadrangles, shelf);
  return shelf;
}

std::vector<Nasty_volume> nasty_volumes()
{
  std::vector<Nasty_volume> shelf;
  add_common_shapes(block_of(3, 2, 2), shelf);
  shelf.push_back(block_of(3, 2, 2));
  shelf.back().name = "all tetrahedra inside out";
  for(auto& t : shelf.back().simplices)
    std::swap(t[0], t[1]);
  shelf.push_back({"slivers", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1e-8},
                               {0.5, 0.5, 1}},
                   {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 3, 4}, {0, 1, 4, 5}, {1, 2, 4, 5},
                    {2, 3, 4, 5}, {3, 0, 4, 5}}});
  shelf.push_back({"two tetrahedra at an edge",
                   {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, -1, 0}, {0, -1, 1}},
                   {{0, 1, 2, 3}, {0, 1, 4, 5}}});
  return shelf;
}

std::vector<Nasty_volume> nasty_points_of_a_volume()
{
  std::vector<Nasty_volume> shelf = nasty_volumes();
  const Nasty_volume good = shelf.front();
  shelf.erase(std::remove_if(shelf.begin(), shelf.end(), [&good](const Nasty_volume& shape) {
    return shape.points.size() != good.points.size() || shape.simplices != good.simplices;
  }), shelf.end());
  return shelf;
}

template <std::size_t N>
Nasty_shape<N> random_shape(Nasty_shape<N> shape, std::mt19937& random)
{
  const auto number = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto index = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const double jitter = std::pow(10, number(-4, 0));
  for(auto& p : shape.points)
    p += jitter * Eigen::Vector3d(number(-1, 1), number(-1, 1), number(-1, 1));
  for(std::size_t k = index(6); k > 0; --k)
  {
    const auto simplex = shape.simplices[index(shape.simplices.size())];
    Eigen::Vector3d& p = shape.points[simplex[0]];
    switch(index(8))
    {
    case 0: p = shape.points[simplex[1]]; break;
    case 1: p = (shape.points[simplex[1]] + shape.points[simplex[2]]) / 2; break;
    case 2: p += std::pow(10, number(0, 6)) * Eigen::Vector3d(1, 1, 0); break;
    case 3: shape.simplices.push_back(simplex); break;
    case 4:
      if(shape.simplices.size() > 1)
        shape.simplices.pop_back();
      break;
    case 5: shape.points.push_back(p); break;
    case 6: // another corner
      shape.points.push_back(p);
      shape.simplices.push_back(simplex);
      shape.simplices.back()[0] = shape.points.size() - 1;
      break;
    default: p = shape.points[index(shape.points.size())];
    }
  }
  const double size = std::pow(10, number(-6, 6));
  const Eigen::Vector3d place = std::pow(10, number(-3, 6)) * size * Eigen::Vector3d(1, 2, -1);
  for(auto& p : shape.points)
    p = place + size * p;
  return shape;
}

template Nasty_surface random_shape(Nasty_surface, std::mt19937&);
template Nasty_volume random_shape(Nasty_volume, std::mt19937&);
