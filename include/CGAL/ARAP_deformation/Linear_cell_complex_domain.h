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

#ifndef CGAL_ARAP_DEFORMATION_LINEAR_CELL_COMPLEX_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_LINEAR_CELL_COMPLEX_DOMAIN_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Incidence_table.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>

#include <CGAL/assertions.h>

#include <boost/range/iterator_range.hpp>

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief the volumes of a linear cell complex of dimension 3, or the faces of one of dimension 2,
/// over a combinatorial or a generalized map.
///
/// Volumes must be tetrahedra, and faces must be closed: preprocessing fails if it meets any
/// other cell, in or next to the region of interest.
///
/// Construction builds tables of vertices and simplices, in linear time and memory. The complex
/// must outlive the domain, and its cells must not change in the meantime.
///
/// \tparam LinearCellComplex a `CGAL::Linear_cell_complex_for_combinatorial_map` or
///         `CGAL::Linear_cell_complex_for_generalized_map` of dimension 2 or 3, with 3D points
///
/// \cgalModels{ARAPDomain}
///
/// \sa `make_linear_cell_complex_domain()`
template <typename LinearCellComplex>
class Linear_cell_complex_domain
  : public internal::Point_conversion<typename LinearCellComplex::Point>
{
  static_assert(LinearCellComplex::dimension == 2 || LinearCellComplex::dimension == 3,
                "Linear_cell_complex_domain: the dimension of the complex must be 2 or 3");
  static_assert(LinearCellComplex::ambient_dimension == 3,
                "Linear_cell_complex_domain: the points of the complex must be 3D");

  // the handle types have different names in different versions of CGAL
  using Dart = decltype(std::declval<LinearCellComplex&>().create_dart());

public:
  /// the type of a point.
  using Point = typename LinearCellComplex::Point;

#ifdef DOXYGEN_RUNNING
  /// a vertex: the handle of its attribute.
  using vertex_descriptor = unspecified_type;
#else
  using vertex_descriptor =
    decltype(std::declval<LinearCellComplex&>().vertex_attribute(std::declval<Dart>()));
#endif

  /// a simplex: its number in the order of `LinearCellComplex::one_dart_per_cell()`.
  using simplex_descriptor = std::size_t;

  /// the dimension of the simplices: that of the complex.
  static constexpr int dimension = static_cast<int>(LinearCellComplex::dimension);

  /// constructs the domain.
  explicit Linear_cell_complex_domain(LinearCellComplex& complex)
    : m_complex(&complex), m_tables(std::make_shared<const Tables>(complex))
  {}

  /// returns the number of `v`.
  std::size_t index(vertex_descriptor v) const { return m_tables->indices.at(v); }

  /// returns the point of `v`.
  Point point(vertex_descriptor v) const { return m_complex->point_of_vertex_attribute(v); }

  /// sets the point of `v`.
  void set_point(vertex_descriptor v, const Point& point) const
  {
    m_complex->point_of_vertex_attribute(v) = point;
  }

  /// returns `true`: points are changed in place.
  bool is_in_place() const { return true; }

  /// returns the range of all vertices.
  auto vertices() const { return boost::make_iterator_range(m_tables->vertices); }

  /// returns whether `v` was a vertex of the complex when the domain was constructed.
  bool is_vertex(vertex_descriptor v) const { return m_tables->indices.count(v) > 0; }

  /// returns whether no simplex is incident to `v`.
  bool is_isolated(vertex_descriptor v) const
  {
    return m_tables->incidences->is_isolated(index(v));
  }

  /// returns whether there was a simplex of that number when the domain was constructed.
  bool is_simplex(simplex_descriptor s) const { return s < m_tables->corners.size(); }

  /// returns the vertices of `s`, those of a face in their order around it; an empty range if `s`
  /// is not a closed face or not a tetrahedron.
  auto simplex_vertices(simplex_descriptor s) const
  {
    return boost::make_iterator_range(m_tables->corners.at(s));
  }

  /// calls `f(s, simplex_vertices(s))` for each simplex `s` at `v`.
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const
  {
    m_tables->incidences->for_each_simplex_at(
      index(v), [&](simplex_descriptor s) { f(s, simplex_vertices(s)); });
  }

private:
  struct Tables
  {
    std::vector<vertex_descriptor> vertices;
    std::unordered_map<vertex_descriptor, std::size_t> indices;
    std::vector<std::vector<vertex_descriptor>> corners; // of each simplex
    std::unique_ptr<const internal::Incidence_table> incidences;

    explicit Tables(LinearCellComplex& complex)
    {
      auto& attributes = complex.vertex_attributes();
      for(auto it = attributes.begin(); it != attributes.end(); ++it)
      {
        indices.emplace(it, vertices.size());
        vertices.push_back(it);
      }
      auto cells = complex.template one_dart_per_cell<dimension>();
      std::vector<std::vector<std::size_t>> numbers;
      for(auto it = cells.begin(); it != cells.end(); ++it)
      {
        corners.push_back(corners_of_cell(complex, it));
        numbers.emplace_back();
        // a cell that is refused is incident to its vertices too
        auto darts = complex.template one_dart_per_incident_cell<0, dimension>(it);
        for(auto dart = darts.begin(); dart != darts.end(); ++dart)
          numbers.back().push_back(indices.at(complex.vertex_attribute(dart)));
      }
      incidences = std::make_unique<const internal::Incidence_table>(vertices.size(), numbers);
    }

    // empty if the cell is not a closed face or not a tetrahedron
    static std::vector<vertex_descriptor> corners_of_cell(LinearCellComplex& complex, Dart cell)
    {
      std::vector<vertex_descriptor> corners;
      if constexpr(dimension == 2)
      {
        Dart dart = cell;
        do
        {
          if(!complex.is_next_exist(dart))
            return {};
          corners.push_back(complex.vertex_attribute(dart));
          dart = complex.next(dart);
        }
        while(dart != cell);
      }
      else if(complex.is_volume_combinatorial_tetrahedron(cell))
      {
        auto darts = complex.template one_dart_per_incident_cell<0, dimension>(cell);
        for(auto it = darts.begin(); it != darts.end(); ++it)
          corners.push_back(complex.vertex_attribute(it));
      }
      return corners;
    }
  };

  LinearCellComplex* m_complex;
  std::shared_ptr<const Tables> m_tables; // shared by copies
};

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a linear cell complex.
template <typename LinearCellComplex>
Linear_cell_complex_domain<LinearCellComplex>
make_linear_cell_complex_domain(LinearCellComplex& complex)
{
  return Linear_cell_complex_domain<LinearCellComplex>(complex);
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_LINEAR_CELL_COMPLEX_DOMAIN_H
