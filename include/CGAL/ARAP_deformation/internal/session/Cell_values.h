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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_CELL_VALUES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_CELL_VALUES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/energy/Energy_model.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>
#include <CGAL/ARAP_deformation/internal/session/vertex_maps.h>
#include <CGAL/ARAP_deformation/of_simplices.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Map>
using Call_operator_of = decltype(&Map::operator());

// What a user says of cells: their stiffness, and which share a rotation. Cells are at vertices or
// are simplices, so that a map of the other kind is not asked.
template <typename Domain>
class Cell_values
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;

  template <typename Map>
  void set_stiffness(Map map) { m_stiffness.set(std::move(map), 1.0); }
  template <typename Map>
  void set_groups(Map map) { m_group.set(std::move(map), std::int64_t(-1)); }

  void clear_stiffness() { m_stiffness = Values<double>(); }
  void clear_groups() { m_group = Values<std::int64_t>(); }
  bool has_groups() const { return !m_group.is_empty(); }

  // order() returns the vertices in the order in which their cells are fitted; see Sequential_fit
  void set_fit_order(std::function<std::vector<vertex_descriptor>()> order, double weight)
  {
    m_fit_order = std::move(order);
    m_neighbor_weight = weight;
  }

  // Fills in the model for the cells of a region, if there is nothing wrong with the values.
  Outcome fill_in(Energy_model& model, const Options& options, const Domain& domain,
                  const Domain_region<Domain>& region, const Region& flat) const
  {
    model.cells = options.cells;
    model.bending_length = options.bending_length;
    model.smoothing_length = options.smoothing_length;
    const bool is_at_vertices = options.cells.has_vertex_cells();
    if(!is_at_vertices && (m_stiffness.is_undeclared() || m_group.is_undeclared()))
      return outcome(Status::undeclared_map);
    model.stiffness = m_stiffness.of(is_at_vertices, domain, region, flat);
    model.group = m_group.of(is_at_vertices, domain, region, flat);
    if(!is_finite(m_neighbor_weight))
      return {Status::invalid_option, "alpha of SRE_ARAP, times the area, is not finite"};
    if(m_fit_order) // edges without faces may lead to vertices without cells
      for(vertex_descriptor v : m_fit_order())
        if(const int cell = region.find_vertex(domain, v);
           cell >= 0 && cell < flat.number_of_centers)
          model.fit_order.push_back(cell);
    model.neighbor_weight = m_neighbor_weight;
    return check_stiffness(model, flat);
  }

private:
  template <typename T>
  class Values
  {
  public:
    bool is_empty() const { return !m_of_vertex && !m_of_simplex; }

    // whether what is there is for vertices because it does not tell its keys
    bool is_undeclared() const { return m_is_undeclared; }

    template <typename Map>
    void set(Map map, T otherwise)
    {
      Values next; // a map of the user may throw
      next.m_is_undeclared = !is_for_simplices<Map>() && !tells_keys<Map>();
      if constexpr(is_for_simplices<Map>())
        next.ask_for_simplices(map, otherwise);
      if constexpr(is_for_vertices<Map>())
        next.m_of_vertex = [map, otherwise](vertex_descriptor v, std::size_t index) {
          T result = otherwise;
          with_value(map, v, index, [&](T value) { result = value; });
          return result;
        };
      *this = std::move(next);
    }

    template <typename Map>
    void set(Simplex_map<Map> map, T otherwise)
    {
      static_assert(is_value_of<Map, simplex_descriptor> || is_simplex_index,
                    "of_simplices: the map must take the simplices of the domain");
      Values next;
      next.ask_for_simplices(map.map, otherwise);
      *this = std::move(next);
    }

    Array<T> of(bool is_at_vertices, const Domain& domain, const Domain_region<Domain>& region,
                const Region& flat) const
    {
      if(is_at_vertices ? !m_of_vertex : !m_of_simplex)
        return {};
      Array<T> values(is_at_vertices ? flat.number_of_centers : flat.number_of_movable_simplices);
      for(std::size_t c = 0; c < values.size(); ++c)
        values[c] = is_at_vertices
                      ? m_of_vertex(region.vertices[c], domain.index(region.vertices[c]))
                      : m_of_simplex(region.simplices[c]);
      return values;
    }

  private:
    template <typename Map>
    void ask_for_simplices(const Map& map, T otherwise)
    {
      m_of_simplex = [map, otherwise](simplex_descriptor s) {
        std::size_t index = 0;
        if constexpr(is_simplex_index)
          index = s;
        T result = otherwise;
        with_value(map, s, index, [&](T value) { result = value; });
        return result;
      };
    }

    std::function<T(vertex_descriptor, std::size_t)> m_of_vertex;
    std::function<T(simplex_descriptor)> m_of_simplex;
    bool m_is_undeclared = false;
  };

  static constexpr bool is_simplex_index = std::is_same_v<simplex_descriptor, std::size_t>;

  template <typename Map, typename Key>
  static constexpr bool is_value_of =
    is_valid<Call_map, Map, Key> || is_valid<Call_get, Map, Key> || is_valid<Call_find, Map, Key>;

  // A function object that takes vertices, but has no single call operator that tells so: whether
  // it takes simplices cannot be asked, as its body may not compile for them.
  template <typename Map>
  static constexpr bool is_generic =
    std::is_class_v<Map> && !is_valid<Call_operator_of, Map> &&
    is_valid<Call_map, Map, vertex_descriptor>;

  // not so for a vector, which takes numbers
  template <typename Map>
  static constexpr bool tells_keys()
  {
    if constexpr(is_generic<Map>)
      return false;
    else
      return is_value_of<Map, vertex_descriptor> || is_value_of<Map, simplex_descriptor>;
  }

  template <typename Map>
  static constexpr bool is_for_simplices()
  {
    if constexpr(is_generic<Map>)
      return std::is_same_v<vertex_descriptor, simplex_descriptor>;
    else
      return is_value_of<Map, simplex_descriptor> || (is_simplex_index && !tells_keys<Map>());
  }

  template <typename Map>
  static constexpr bool is_for_vertices()
  {
    if constexpr(is_generic<Map>)
      return true;
    else
      return is_value_of<Map, vertex_descriptor> || !tells_keys<Map>();
  }

  Values<double> m_stiffness;
  Values<std::int64_t> m_group;
  std::function<std::vector<vertex_descriptor>()> m_fit_order;
  double m_neighbor_weight = 0;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_CELL_VALUES_H
