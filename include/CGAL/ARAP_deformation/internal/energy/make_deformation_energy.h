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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_MAKE_DEFORMATION_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_MAKE_DEFORMATION_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/energy/Bending.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_weight_model.h>
#include <CGAL/ARAP_deformation/internal/energy/Energy_model.h>
#include <CGAL/ARAP_deformation/internal/energy/Simplex_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Smooth_rotations.h>
#include <CGAL/ARAP_deformation/internal/energy/Star_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/weighted_edge_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/contents.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Calls f(facet) for each edge of polygon s, or triangle of tetrahedron s: the sorted numbers of
// its vertices, the last of which is -1 for an edge.
template <typename Function>
void for_each_facet(const Region& region, int s, const Function& f)
{
  const Index_range corners = region.corners_of(s);
  const auto n = static_cast<std::size_t>(corners.size());
  for(std::size_t k = 0; k < n; ++k)
  {
    std::array<int, 3> facet = {corners[k], corners[(k + 1) % n], -1};
    if(region.dimension == 3)
      facet[2] = corners[(k + 2) % n];
    if(facet[0] < facet[1]) std::swap(facet[0], facet[1]);
    if(facet[1] < facet[2]) std::swap(facet[1], facet[2]);
    if(facet[0] < facet[1]) std::swap(facet[0], facet[1]);
    f(facet);
  }
}

// For each center whether it is on the border: a facet there has one simplex only, or one that is
// there several times.
inline Array<char> find_border(const Region& region)
{
  using Facet = std::pair<std::array<int, 3>, int>; // with a simplex
  std::vector<Facet> facets;
  facets.reserve(region.corners.size());
  for(int s = 0; s < region.number_of_simplices(); ++s)
    for_each_facet(region, s,
                   [&](const std::array<int, 3>& facet) { facets.emplace_back(facet, s); });
  std::sort(facets.begin(), facets.end());
  const auto have_same_corners = [&](const Facet& f, const Facet& g) {
    const Index_range a = region.corners_of(f.second), b = region.corners_of(g.second);
    return std::is_permutation(a.begin(), a.end(), b.begin(), b.end());
  };
  Array<char> is_on_border(region.number_of_centers, false);
  for(auto begin = facets.begin(); begin != facets.end();)
  {
    const auto end = std::find_if(
      begin, facets.end(), [&](const Facet& other) { return other.first != begin->first; });
    if(std::all_of(begin + 1, end, [&](const Facet& f) { return have_same_corners(*begin, f); }))
      for(int v : begin->first)
        if(0 <= v && v < region.number_of_centers)
          is_on_border[v] = true;
    begin = end;
  }
  return is_on_border;
}

// the stiffness of a cell, 1 where nothing is said
inline double stiffness_of(const Energy_model& model, int c)
{
  return model.stiffness.empty() ? 1 : model.stiffness[c];
}

inline Bending make_bending(const Energy_model& energy_model, const Region& region)
{
  // a vertex with less of an area than this share of its squared edges has none
  constexpr double negligible = 1e-10;
  const Edge_weight_model_of<Cotangent_weight> cotangent{Cotangent_weight()};
  Stars stars = star_edge_sets(cotangent, weighted_simplices(cotangent, region), region);
  Array<double> masses = contents_at_centers(region);
  const Array<char> is_on_border = find_border(region);
  Array<double> factors(region.number_of_centers, 0);
  for(int i = 0; i < region.number_of_centers; ++i)
  {
    double square = 0;
    for(int e = stars.neighbors.begin[i]; e < stars.neighbors.begin[i + 1]; ++e)
    {
      const Coordinates edge = difference(region.rest[i], region.rest[stars.neighbors.items[e]]);
      square = (std::max)(square, dot(edge, edge));
    }
    if(is_on_border[i] || i >= region.number_of_vertex_cells ||
       !(masses[i] > negligible * std::pow(square, 0.5 * region.dimension)))
      masses[i] = 0;
    else
      factors[i] = energy_model.bending_length * energy_model.bending_length *
                   stiffness_of(energy_model, i);
  }
  return Bending(std::move(stars), std::move(masses), std::move(factors), region.rest,
                 region.number_of_movable_vertices);
}

// The weights approximate the integral of the squared gradient of the rotations, times the squared
// smoothing length: for cells at vertices they are cotangents, where these are positive, and for
// cells that are simplices the content of the common facet over the distance of the centroids.
// Cells of one group have none between them: their rotations are one, and it would be held back.
inline Smooth_rotations make_smooth_rotations(const Energy_model& energy_model,
                                              const Region& region, int number_of_cells)
{
  const double factor = energy_model.smoothing_length * energy_model.smoothing_length;
  const auto share_rotation = [&groups = energy_model.group](int c, int d) {
    return !groups.empty() && groups[c] >= 0 && groups[c] == groups[d];
  };
  Index_lists neighbors;
  Array<double> weights;
  if(energy_model.cells.has_vertex_cells())
  {
    const Edge_weight_model_of<Clamped_cotangent_weight> cotangent{Clamped_cotangent_weight()};
    const Stars stars =
      star_edge_sets(cotangent, weighted_simplices(cotangent, region), region);
    for(int c = 0; c < number_of_cells; ++c)
    {
      for(int e = stars.neighbors.begin[c]; e < stars.neighbors.begin[c + 1]; ++e)
        if(const int d = stars.neighbors.items[e]; d < number_of_cells && !share_rotation(c, d))
        {
          neighbors.items.push_back(d);
          weights.push_back(factor * stars.weights[e]);
        }
      neighbors.end_list();
    }
    return Smooth_rotations(std::move(neighbors), std::move(weights));
  }

  std::map<std::array<int, 3>, std::vector<int>> simplices_at; // each facet
  for(int s = 0; s < number_of_cells; ++s)
  {
    for_each_facet(region, s,
                   [&](const std::array<int, 3>& facet) { simplices_at[facet].push_back(s); });
  }
  const auto centroid = [&](int s, const Coordinates& origin) {
    Coordinates sum = {0, 0, 0};
    const Index_range corners = region.corners_of(s);
    for(int v : corners)
      add(sum, 1.0 / corners.size(), difference(region.rest[v], origin));
    return sum;
  };
  std::vector<std::vector<std::pair<int, double>>> lists(static_cast<std::size_t>(number_of_cells));
  for(const auto& [facet, simplices] : simplices_at)
    for(int s : simplices)
      for(int other : simplices)
        if(s != other && !share_rotation(s, other))
        {
          const Coordinates& origin = region.rest[facet[0]];
          const Coordinates side = difference(region.rest[facet[1]], origin),
                            apart = difference(centroid(s, origin), centroid(other, origin));
          if(!(dot(apart, apart) > 1e-20 * dot(side, side))) // at one place, up to rounding
            continue;
          Coordinates content = side;
          if(facet[2] >= 0)
            content = scaled(cross(side, difference(region.rest[facet[2]], origin)), 0.5);
          const double weight = std::sqrt(dot(content, content) / dot(apart, apart));
          if(is_finite(weight))
            lists[static_cast<std::size_t>(s)].emplace_back(other, factor * weight);
        }
  for(const auto& list : lists)
  {
    for(const auto& [other, weight] : list)
    {
      neighbors.items.push_back(other);
      weights.push_back(weight);
    }
    neighbors.end_list();
  }
  return Smooth_rotations(std::move(neighbors), std::move(weights));
}

inline Deformation_energy make_rigidity(const Edge_weight_model& model, Simplices simplices,
                                        const Energy_model& energy_model, const Region& region)
{
  const int n = region.number_of_movable_vertices;
  const Cell_scheme scheme = energy_model.cells;
  if(scheme.edge_set() == Edge_set::star)
  {
    Stars stars = star_edge_sets(model, simplices, region);
    if(scheme.rings() > 0)
    {
      Cells cells = ring_cells(stars.neighbors, region.number_of_vertex_cells, scheme.rings());
      for(int c = 0; c < cells.size(); ++c)
        cells.stiffness[c] = stiffness_of(energy_model, c);
      return Deformation_energy(Star_energy(std::move(stars), std::move(cells), region.rest, n),
                                region.rest, n);
    }
    for(int i = 0; i < stars.size() && !energy_model.stiffness.empty(); ++i)
      for(int e = stars.neighbors.begin[i]; e < stars.neighbors.begin[i + 1]; ++e)
        stars.weights[e] *= energy_model.stiffness[i];
    return Deformation_energy(Star_energy(std::move(stars), n), region.rest, n);
  }
  simplices = simplex_edge_sets(model, std::move(simplices), region);
  Cells cells = scheme.grouped_at_vertices()
                  ? vertex_cells(simplices.corners, region.number_of_centers)
                  : separate_cells(region.number_of_movable_simplices);
  for(int c = 0; c < cells.size(); ++c)
    cells.stiffness[c] = stiffness_of(energy_model, c);
  return Deformation_energy(Simplex_energy(std::move(simplices), std::move(cells), n), region.rest,
                            n);
}

inline Sequential_fit make_sequential_fit(const Energy_model& energy_model, const Region& region,
                                          int number_of_cells)
{
  std::vector<std::pair<int, int>> edges; // each from a cell to a vertex
  for(int s = 0; s < region.number_of_simplices(); ++s)
    for(const int& c : region.corners_of(s))
      for(const int& v : region.corners_of(s))
        if(&c != &v && c < number_of_cells)
          edges.emplace_back(c, v);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  Index_lists neighbors;
  Array<double> factors;
  auto edge = edges.begin();
  for(int c = 0; c < number_of_cells; ++c)
  {
    int valence = 0;
    for(; edge != edges.end() && edge->first == c; ++edge, ++valence)
      if(edge->second < number_of_cells)
        neighbors.items.push_back(edge->second);
    neighbors.end_list();
    factors.push_back(energy_model.neighbor_weight / valence);
  }
  return Sequential_fit(energy_model.fit_order, std::move(neighbors), std::move(factors));
}

inline Deformation_energy make_deformation_energy(const Edge_weight_model& model,
                                                  Simplices simplices,
                                                  const Energy_model& energy_model,
                                                  const Region& region)
{
  Deformation_energy energy = make_rigidity(model, std::move(simplices), energy_model, region);
  if(energy_model.bending_length > 0)
    energy.set_bending(make_bending(energy_model, region));
  if(energy_model.smoothing_length > 0)
    energy.set_smooth_rotations(
      make_smooth_rotations(energy_model, region, energy.number_of_cells()));
  if(!energy_model.fit_order.empty())
    energy.set_sequential_fit(
      make_sequential_fit(energy_model, region, energy.number_of_cells()));
  if(!energy_model.group.empty())
  {
    std::vector<std::pair<std::int64_t, int>> members; // each a group and a cell
    for(int c = 0; c < energy.number_of_cells(); ++c)
      if(energy_model.group[c] >= 0)
        members.emplace_back(energy_model.group[c], c);
    energy.set_groups(lists_by_first(std::move(members)));
  }
  return energy;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_MAKE_DEFORMATION_ENERGY_H
