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

#ifndef CGAL_ARAP_DEFORMATION_TRIANGULATION_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_TRIANGULATION_DOMAIN_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/domain/triangulation_caches.h>
#include <CGAL/ARAP_deformation/internal/domain/weighted_points.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief the finite cells of a 3D triangulation, or a selection of them.
///
/// Deformation only moves vertices: the combinatorial structure, the indices and the weights of the
/// points do not change. **In general a deformed triangulation is no longer %Delaunay or regular**,
/// cells may be inverted, and the boundary may be non-convex. Do not locate points in it, insert or
/// remove vertices, or use dual constructions; traversing its cells and writing it to a file are
/// fine. Data that cells cache, such as circumcenters and qualities, is invalidated at each vertex
/// that moves.
///
/// Construction numbers the vertices, in linear time. The triangulation must outlive the domain;
/// its vertices, its cells and the selection must not change in the meantime.
///
/// \tparam Triangulation a `CGAL::Triangulation_3` or a class derived from it, weighted or not
///
/// \cgalModels{ARAPDomain}
///
/// \sa `make_triangulation_domain()`
/// \sa `make_complex_domain()`
template <typename Triangulation>
class Triangulation_domain
  : public internal::Point_conversion<typename Triangulation::Geom_traits::Point_3>
{
public:
  /// a point without a weight.
  using Point = typename Triangulation::Geom_traits::Point_3;

  /// a finite vertex.
  using vertex_descriptor = typename Triangulation::Vertex_handle;

  /// a selected cell.
  using simplex_descriptor = typename Triangulation::Cell_handle;

  /// 3: the simplices are tetrahedra.
  static constexpr int dimension = 3;

  /// tells whether a finite cell is selected.
  using Cell_predicate = std::function<bool(simplex_descriptor)>;

  /// constructs the domain of the finite cells for which `is_selected` is `true`.
  Triangulation_domain(Triangulation& triangulation, Cell_predicate is_selected)
    : m_triangulation(&triangulation), m_is_selected(std::move(is_selected)),
      m_indices(std::make_shared<Indices>())
  {
    for(vertex_descriptor v : triangulation.finite_vertex_handles())
      m_indices->emplace(v, m_indices->size());
    if constexpr(have_cells_caches)
      m_cells_with_caches = std::make_shared<Cells_of_vertices>(m_indices->size());
  }

  /// constructs the domain of all finite cells. If cells have a subdomain index, those with its
  /// default value, which denotes the outside, are left out: set the indices first.
  explicit Triangulation_domain(Triangulation& triangulation)
    : Triangulation_domain(triangulation, [](simplex_descriptor cell) {
        return internal::is_in_a_subdomain(*cell);
      })
  {}

  /// returns the number of `v` in the order of `Triangulation::finite_vertex_handles()`.
  std::size_t index(vertex_descriptor v) const { return m_indices->at(v); }

  /// returns the point of `v`.
  Point point(vertex_descriptor v) const { return internal::bare_point(v->point()); }

  /// sets the point of `v`, which keeps its weight, and invalidates the caches of the cells at `v`.
  void set_point(vertex_descriptor v, const Point& point) const
  {
    v->set_point(internal::with_weight_of(v->point(), point));
    if constexpr(have_cells_caches)
    {
      std::vector<simplex_descriptor>& cells = (*m_cells_with_caches)[index(v)];
      if(cells.empty()) // collected once: a session writes the same points again and again
        cells = incident_cells(v);
      for(simplex_descriptor cell : cells)
        internal::invalidate_caches(*cell);
    }
  }

  /// returns `true`: points are changed in place.
  bool is_in_place() const { return true; }

  /// returns the range of all finite vertices.
  auto vertices() const { return m_triangulation->finite_vertex_handles(); }

  /// returns whether `v` was a finite vertex of the triangulation when the domain was constructed.
  bool is_vertex(vertex_descriptor v) const { return m_indices->count(v) > 0; }

  /// returns whether no selected cell is incident to `v`.
  bool is_isolated(vertex_descriptor v) const
  {
    const std::vector<simplex_descriptor> cells = incident_cells(v);
    return std::none_of(cells.begin(), cells.end(),
                        [&](simplex_descriptor cell) { return is_in(cell); });
  }

  /// returns whether `s` is a selected cell, and not a default-constructed handle.
  bool is_simplex(simplex_descriptor s) const { return s != simplex_descriptor() && is_in(s); }

  /// returns the vertices of the cell `s`.
  std::array<vertex_descriptor, 4> simplex_vertices(simplex_descriptor s) const
  {
    return {s->vertex(0), s->vertex(1), s->vertex(2), s->vertex(3)};
  }

  /// calls `f(s, simplex_vertices(s))` for each selected cell `s` at `v`.
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const
  {
    for(simplex_descriptor cell : incident_cells(v))
      if(is_in(cell))
        f(cell, simplex_vertices(cell));
  }

private:
  using Indices = std::unordered_map<vertex_descriptor, std::size_t>;
  using Cells_of_vertices = std::vector<std::vector<simplex_descriptor>>;

  static constexpr bool have_cells_caches = internal::has_caches<typename Triangulation::Cell>;

  bool is_in(simplex_descriptor cell) const
  {
    return !m_triangulation->is_infinite(cell) && m_is_selected(cell);
  }

  // the cells at v, infinite ones included
  std::vector<simplex_descriptor> incident_cells(vertex_descriptor v) const
  {
    std::vector<simplex_descriptor> cells;
    if(m_triangulation->dimension() == 3)
      m_triangulation->incident_cells(v, std::back_inserter(cells));
    return cells;
  }

  Triangulation* m_triangulation;
  Cell_predicate m_is_selected;
  std::shared_ptr<Indices> m_indices; // shared by copies, as the next
  std::shared_ptr<Cells_of_vertices> m_cells_with_caches; // at each vertex that was moved
};

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of all finite cells of a 3D triangulation. If cells have a subdomain
/// index, those with its default value, which denotes the outside, are left out.
template <typename Triangulation>
Triangulation_domain<Triangulation> make_triangulation_domain(Triangulation& triangulation)
{
  return Triangulation_domain<Triangulation>(triangulation);
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of all cells of a complex in a 3D triangulation, in any subdomain.
/// The vertex indices are those of the domain that `ARAP_deformation` constructs for the complex.
/// The complex must outlive the domain.
/// \tparam MeshComplex a `CGAL::Mesh_complex_3_in_triangulation_3`, as 3D mesh generation makes it
template <typename MeshComplex>
Triangulation_domain<typename MeshComplex::Triangulation>
make_complex_domain(MeshComplex& complex)
{
  using Triangulation = typename MeshComplex::Triangulation;
  return Triangulation_domain<Triangulation>(
    complex.triangulation(), [&complex](typename Triangulation::Cell_handle cell) {
      return complex.is_in_complex(cell);
    });
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of one subdomain of a complex in a 3D triangulation. Vertices shared
/// with other subdomains belong to it: fix them to keep the shape of the others. The complex must
/// outlive the domain.
/// \tparam MeshComplex a `CGAL::Mesh_complex_3_in_triangulation_3`, as 3D mesh generation makes it
template <typename MeshComplex>
Triangulation_domain<typename MeshComplex::Triangulation>
make_complex_domain(MeshComplex& complex, typename MeshComplex::Subdomain_index subdomain)
{
  using Triangulation = typename MeshComplex::Triangulation;
  return Triangulation_domain<Triangulation>(
    complex.triangulation(), [&complex, subdomain](typename Triangulation::Cell_handle cell) {
      return complex.is_in_complex(cell) && complex.subdomain_index(cell) == subdomain;
    });
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_TRIANGULATION_DOMAIN_H
