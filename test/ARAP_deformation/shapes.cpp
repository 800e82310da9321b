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

#include "include/shapes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

Eigen::AlignedBox3d bounding_box(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::AlignedBox3d box;
  for(const auto& p : points)
    box.extend(p);
  return box;
}

double diameter_of(const std::vector<Eigen::Vector3d>& points)
{
  return bounding_box(points).diagonal().norm();
}

Shape grid(const std::string& name, int nu, int nv,
           const std::function<Eigen::Vector3d(double, double)>& f, bool wrap_u, bool wrap_v)
{
  Shape shape{name, {}, {}};
  const int columns = wrap_u ? nu : nu + 1, rows = wrap_v ? nv : nv + 1;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j)
      shape.points.push_back(f(double(i) / nu, double(j) / nv));
  const auto vertex = [&](int i, int j) { return std::size_t((i % columns) * rows + j % rows); };
  for(int i = 0; i < nu; ++i)
    for(int j = 0; j < nv; ++j)
    {
      const std::size_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                        d = vertex(i, j + 1);
      if((i + j) % 2 == 0)
        shape.triangles.insert(shape.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        shape.triangles.insert(shape.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return shape;
}

Shape octahedron()
{
  return {"octahedron",
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

Shape subdivided(const std::string& name, const Shape& coarse,
                 const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& f)
{
  Shape fine{name, coarse.points, {}};
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [it, is_new] = middles.insert({std::minmax(a, b), fine.points.size()});
    if(is_new)
      fine.points.push_back(f(0.5 * (coarse.points[a] + coarse.points[b])));
    return it->second;
  };
  for(const auto& [a, b, c] : coarse.triangles)
  {
    const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(),
                          {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

Shape shuffled(const Shape& shape, std::vector<std::size_t>& place)
{
  std::mt19937 random(11);
  place.resize(shape.points.size());
  std::iota(place.begin(), place.end(), std::size_t(0));
  std::shuffle(place.begin(), place.end(), random);
  Shape result = shape;
  for(std::size_t v = 0; v < place.size(); ++v)
    result.points[place[v]] = shape.points[v];
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  for(auto& t : result.triangles)
  {
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    for(auto& v : t)
      v = place[v];
  }
  return result;
}

Shape joined(const Shape& first, const Shape& second, const Eigen::Vector3d& shift)
{
  Shape both = first;
  both.name = first.name + " and " + second.name;
  for(const auto& p : second.points)
    both.points.push_back(p + shift);
  const std::size_t n = first.points.size();
  for(const auto& [a, b, c] : second.triangles)
    both.triangles.push_back({a + n, b + n, c + n});
  return both;
}

Shape two_components(const Shape& shape)
{
  Shape both = joined(shape, shape, {1.5 * shape.diameter(), 0, 0});
  both.name = "two of " + shape.name;
  return both;
}

std::vector<Shape> shapes()
{
  using V = Eigen::Vector3d;
  const double pi = std::acos(-1.0);
  const auto normalized = [](const V& p) { return V(p.normalized()); };
  const Shape sphere =
    subdivided("sphere", subdivided("", subdivided("", octahedron(), normalized), normalized),
               normalized);
  std::vector<Shape> all;
  all.push_back({"tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});
  all.push_back(octahedron());
  all.push_back(sphere);
  all.push_back(subdivided("ellipsoid", sphere, [](const V& p) { return p; }));
  for(auto& p : all.back().points)
    p = V(3 * p.x(), p.y(), 0.6 * p.z());
  all.push_back(grid("flat sheet", 12, 6, [](double u, double v) { return V(2 * u, v, 0); }));
  all.push_back(grid("bumpy sheet", 16, 12, [=](double u, double v) {
    return V(2 * u, 1.5 * v, 0.1 * std::sin(6 * pi * u) * std::cos(4 * pi * v));
  }));
  all.push_back(grid("obtuse sheet", 10, 8, [](double u, double v) {
    return V(u + 2.5 * v, 0.6 * v, 0.1 * u * u);
  }));
  all.push_back(grid("cylinder", 12, 15, [=](double u, double v) {
    return V(std::cos(2 * pi * u), std::sin(2 * pi * u), 5 * v);
  }, true));
  all.push_back(grid("torus", 16, 10, [=](double u, double v) {
    const double r = 2 + 0.7 * std::cos(2 * pi * v);
    return V(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 0.7 * std::sin(2 * pi * v));
  }, true, true));
  all.push_back(grid("saddle", 10, 10, [](double u, double v) {
    return V(2 * u - 1, 2 * v - 1, (2 * u - 1) * (2 * u - 1) - (2 * v - 1) * (2 * v - 1));
  }));
  all.push_back(two_components(grid("strip", 14, 3, [](double u, double v) {
    return V(0.5 * v, 4 * u, 0.2 * u * u);
  })));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  all.push_back(grid("irregular sheet", 14, 14, [&](double u, double v) {
    return V(u + jitter(random) / 14, v + jitter(random) / 14, 0.3 * u * v + jitter(random) / 14);
  }));
  return all;
}

template Mesh make_mesh<Mesh>(const std::vector<Eigen::Vector3d>&, const Triangles&);

double distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q)
{
  return (p - q).norm();
}

std::vector<Point> points_of(const Mesh& mesh)
{
  return {mesh.points().begin(), mesh.points().end()};
}

std::vector<Point> points_of(const std::vector<Eigen::Vector3d>& vectors)
{
  std::vector<Point> points;
  for(const auto& p : vectors)
    points.push_back(point(p));
  return points;
}

Scenario shuffled(const Scenario& s, const std::vector<std::size_t>& place)
{
  Scenario result = s;
  for(std::size_t v = 0; v < place.size(); ++v)
  {
    result.selection[place[v]] = s.selection[v];
    result.targets[place[v]] = s.targets[v];
  }
  return result;
}

Eigen::Vector3d Affine_map::operator*(const Eigen::Vector3d& p) const
{
  return linear * p + translation;
}

Affine_map Affine_map::operator*(const Affine_map& first) const
{
  return {linear * first.linear, linear * first.translation + translation};
}

Affine_map Affine_map::inverse() const
{
  const Eigen::Matrix3d back = linear.inverse();
  return {back, -(back * translation)};
}

Eigen::Matrix4d Affine_map::matrix() const
{
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = linear;
  m.topRightCorner<3, 1>() = translation;
  return m;
}

Affine_map rigid_motion(double angle, const Eigen::Vector3d& axis,
                        const Eigen::Vector3d& translation)
{
  return {Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), translation};
}

Affine_map motion_about(const Eigen::Vector3d& center, const Affine_map& motion)
{
  Affine_map there, back;
  there.translation = center;
  back.translation = -center;
  return there * motion * back;
}

Scenario scenario(const Shape& shape, double angle)
{
  const Eigen::AlignedBox3d box = bounding_box(shape.points);
  int axis;
  box.sizes().maxCoeff(&axis);
  std::vector<std::size_t> order(shape.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return shape.points[a][axis] < shape.points[b][axis];
  });
  const std::size_t count = (std::max)(order.size() / 6, std::size_t(1)), n = order.size();
  const Affine_map motion =
    motion_about(box.center(), rigid_motion(angle, {1, 2, 0.5}, 0.2 * box.sizes()));
  Scenario result{std::vector<int>(n, 1), shape.points};
  for(std::size_t k = 0; k < (std::max)(count, std::size_t(2)) && k + 1 < n; ++k)
    result.selection[order[k]] = 0;
  for(std::size_t k = n - count; k < n; ++k)
  {
    result.selection[order[k]] = 2;
    result.targets[order[k]] = motion * shape.points[order[k]];
  }
  return result;
}

Scenario in_whole(Scenario s)
{
  std::replace(s.selection.begin(), s.selection.end(), 0, 2);
  return s;
}

bool same_points(const Mesh& a, const Mesh& b)
{
  for(auto v : a.vertices())
    if(a.point(v) != b.point(v))
      return false;
  return true;
}
