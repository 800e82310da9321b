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

#ifndef CGAL_ARAP_DEFORMATION_SIMPLEX_SOUP_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_SIMPLEX_SOUP_DOMAIN_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Incidence_table.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/domain/weighted_points.h>

#include <CGAL/assertions.h>

#include <boost/range/counting_range.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <boost/range/iterator_range.hpp>

#include <cstddef>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief a surface or a tetrahedral complex, given by a range of points and a range of simplices
/// that index them.
///
/// Vertices and simplices are identified by their positions in the ranges. The faces need not be
/// oriented or manifold, and tetrahedra may have either orientation. Preprocessing fails if it
/// meets a simplex with a nonexistent or a repeated corner, in or next to the region of interest.
///
/// Construction builds a table of the simplices at each vertex, in linear time and memory. The
/// ranges must outlive the domain; their sizes and the simplices must not change in the meantime.
///
/// \tparam Dimension 2 if the simplices are triangles or polygons, 3 if they are tetrahedra
/// \tparam PointRange a model of `RandomAccessContainer` of points. The points have `operator[]`
///         and are made of three coordinates, in parentheses or braces, or of two for a surface in
///         the plane: points of \cgal, `std::array<double, 3>`, `Eigen::Vector3d`.
/// \tparam SimplexRange a model of `RandomAccessContainer` of ranges of integers, such as
///         `std::vector<std::array<int, 3>>`. The corners of a polygon are listed in order around
///         it.
///
/// \cgalModels{ARAPDomain}
///
/// \sa `make_polygon_soup_domain()`
/// \sa `make_tetrahedron_soup_domain()`
template <int Dimension, typename PointRange, typename SimplexRange>
class Simplex_soup_domain
  : public internal::Point_conversion<typename PointRange::value_type>
{
  static_assert(Dimension == 2 || Dimension == 3,
                "Simplex_soup_domain: the dimension of the simplices must be 2 (triangles and "
                "polygons) or 3 (tetrahedra)");
  static_assert(Dimension == 2 || !Simplex_soup_domain::is_planar,
                "Simplex_soup_domain: the points of tetrahedra must have three coordinates");

public:
  /// the type of a point.
  using Point = typename PointRange::value_type;

  /// a vertex: the position of its point in the range.
  using vertex_descriptor = std::size_t;

  /// a simplex: its position in the range.
  using simplex_descriptor = std::size_t;

  /// the dimension of the simplices.
  static constexpr int dimension = Dimension;

  /// constructs the domain. The points are changed in place.
  Simplex_soup_domain(PointRange& points, const SimplexRange& simplices)
    : Simplex_soup_domain(points, simplices, points)
  {}

  /// constructs the domain with separate ranges for reading and writing points. The points of all
  /// vertices of the region of interest are written.
  /// \throws std::invalid_argument unless `output_points.size() == points.size()`
  Simplex_soup_domain(const PointRange& points, const SimplexRange& simplices,
                      PointRange& output_points)
    : m_points(&points), m_output_points(&output_points), m_simplices(&simplices),
      m_incidences(std::make_shared<const internal::Incidence_table>(points.size(), simplices))
  {
    if(output_points.size() != points.size())
      throw std::invalid_argument("Simplex_soup_domain: there are " +
                                  std::to_string(points.size()) + " points, but " +
                                  std::to_string(output_points.size()) + " output points");
  }

#ifndef DOXYGEN_RUNNING
  // They would refer to simplices, or points that are only read, that are no longer there.
  Simplex_soup_domain(PointRange&, const SimplexRange&&) = delete;
  Simplex_soup_domain(const PointRange&, const SimplexRange&&, PointRange&) = delete;
  Simplex_soup_domain(const PointRange&&, const SimplexRange&, PointRange&) = delete;
#endif

  /// returns `v`.
  /// \pre `v` is smaller than the number of points. In Release all functions that take a vertex or
  ///      a simplex, except `is_simplex()`, throw `std::out_of_range` if it does not exist.
  std::size_t index(vertex_descriptor v) const { return checked("vertex ", v, m_points->size()); }

  /// returns the point of `v` in the input range.
  const Point& point(vertex_descriptor v) const { return (*m_points)[index(v)]; }

  /// sets the point of `v` in the output range. A weighted point keeps its weight.
  void set_point(vertex_descriptor v, const Point& point) const
  {
    (*m_output_points)[index(v)] =
      internal::with_weight_of_old(point, [&]() -> const Point& { return this->point(v); });
  }

  /// returns whether points are changed in place.
  bool is_in_place() const { return m_points == m_output_points; }

  /// returns the range of all vertices.
  auto vertices() const { return boost::counting_range(std::size_t(0), m_points->size()); }

  /// returns whether no simplex is incident to `v`.
  bool is_isolated(vertex_descriptor v) const { return m_incidences->is_isolated(index(v)); }

  /// returns whether there is a simplex of that number.
  bool is_simplex(simplex_descriptor s) const { return s < m_simplices->size(); }

  /// returns the corners of `s`, or an empty range if one of them does not exist.
  auto simplex_vertices(simplex_descriptor s) const
  {
    const auto& simplex = (*m_simplices)[checked("simplex ", s, m_simplices->size())];
    const auto corners = boost::make_iterator_range(
      boost::make_transform_iterator<To_vertex>(std::begin(simplex)),
      boost::make_transform_iterator<To_vertex>(std::end(simplex)));
    for(vertex_descriptor v : corners)
      if(v >= m_points->size())
        return boost::make_iterator_range(corners.begin(), corners.begin());
    return corners;
  }

  /// calls `f(s, simplex_vertices(s))` for each simplex `s` at `v`.
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const
  {
    m_incidences->for_each_simplex_at(
      index(v), [&](simplex_descriptor s) { f(s, simplex_vertices(s)); });
  }

private:
  struct To_vertex
  {
    template <typename Integer>
    vertex_descriptor operator()(Integer corner) const
    {
      return static_cast<vertex_descriptor>(corner);
    }
  };

  static std::size_t checked(const char* what, std::size_t k, std::size_t size)
  {
    CGAL_precondition(k < size);
    if(k >= size)
      throw std::out_of_range("Simplex_soup_domain: there is no " + (what + std::to_string(k)));
    return k;
  }

  const PointRange* m_points;
  PointRange* m_output_points;
  const SimplexRange* m_simplices;
  std::shared_ptr<const internal::Incidence_table> m_incidences; // shared by copies
};

/// \ingroup PkgARAPDeformationDomains
/// \brief a surface, given by a range of points and a range of triangles or polygons.
template <typename PointRange, typename PolygonRange>
using Polygon_soup_domain = Simplex_soup_domain<2, PointRange, PolygonRange>;

/// \ingroup PkgARAPDeformationDomains
/// \brief a tetrahedral complex, given by a range of points and a range of tetrahedra.
template <typename PointRange, typename TetrahedronRange>
using Tetrahedron_soup_domain = Simplex_soup_domain<3, PointRange, TetrahedronRange>;

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a surface that is given by ranges. The points are changed in place.
template <typename PointRange, typename PolygonRange>
Polygon_soup_domain<PointRange, PolygonRange>
make_polygon_soup_domain(PointRange& points, const PolygonRange& polygons)
{
  return {points, polygons};
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a surface that is given by ranges, with a range for the output.
template <typename PointRange, typename PolygonRange>
Polygon_soup_domain<PointRange, PolygonRange>
make_polygon_soup_domain(const PointRange& points, const PolygonRange& polygons,
                         PointRange& output_points)
{
  return {points, polygons, output_points};
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a tetrahedral complex that is given by ranges. The points are
/// changed in place.
template <typename PointRange, typename TetrahedronRange>
Tetrahedron_soup_domain<PointRange, TetrahedronRange>
make_tetrahedron_soup_domain(PointRange& points, const TetrahedronRange& tetrahedra)
{
  return {points, tetrahedra};
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a tetrahedral complex that is given by ranges, with a range for the
/// output.
template <typename PointRange, typename TetrahedronRange>
Tetrahedron_soup_domain<PointRange, TetrahedronRange>
make_tetrahedron_soup_domain(const PointRange& points, const TetrahedronRange& tetrahedra,
                             PointRange& output_points)
{
  return {points, tetrahedra, output_points};
}

#ifndef DOXYGEN_RUNNING
// A domain would refer to simplices, or points that are only read, that are no longer there.
template <typename PointRange, typename PolygonRange, typename... OutputPoints>
void make_polygon_soup_domain(PointRange&&, const PolygonRange&&, OutputPoints&&...) = delete;
template <typename PointRange, typename TetrahedronRange, typename... OutputPoints>
void make_tetrahedron_soup_domain(PointRange&&, const TetrahedronRange&&,
                                  OutputPoints&&...) = delete;
template <typename PointRange, typename PolygonRange>
void make_polygon_soup_domain(const PointRange&&, const PolygonRange&, PointRange&) = delete;
template <typename PointRange, typename TetrahedronRange>
void make_tetrahedron_soup_domain(const PointRange&&, const TetrahedronRange&,
                                  PointRange&) = delete;
#endif

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SIMPLEX_SOUP_DOMAIN_H
