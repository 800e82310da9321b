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

#ifndef CGAL_ARAP_DEFORMATION_LOCATE_H
#define CGAL_ARAP_DEFORMATION_LOCATE_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/domain/for_each_simplex.h>
#include <CGAL/ARAP_deformation/internal/domain/make_simplex_search.h>
#include <CGAL/ARAP_deformation/internal/domain/triangles_of_polygon.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief finds the face or the tetrahedron that is nearest to a point, for control points of
/// `CGAL::ARAP_deformation`.
///
/// It is built for the points that the domain has at construction: those of the input map, if a
/// deformation writes to an output map. Takes \f$O(n \log n)\f$ time for \f$n\f$ simplices, and
/// typically \f$O(\log n)\f$ time for each point. Polygons are cut into triangles, as seen along
/// their mean normal; they need not be convex, but non-convex ones with hundreds of corners take
/// long. Triangles without area are ignored, and so are tetrahedra without volume and simplices
/// with a point that is not finite.
///
/// \tparam Domain a model of `ARAPDomain`
template <typename Domain>
class Locator
{
  static_assert(internal::is_domain<Domain>,
                "Locator: pass a domain, as make_face_graph_domain(mesh) returns it for a mesh");

public:
  /// a face or a tetrahedron.
  using simplex_descriptor = typename Domain::simplex_descriptor;

  /// builds a search tree over the simplices of a domain.
  explicit Locator(const Domain& domain)
  {
    std::vector<Corners> corners;
    internal::for_each_simplex(domain, [&](const simplex_descriptor& s, const auto& vertices) {
      internal::Array<Coordinates> points;
      for(const auto& v : vertices)
        points.push_back(Domain::coordinates(domain.point(v)));
      if(internal::find_non_finite(points) < 0)
        append(s, points, corners);
    });
    m_search = internal::make_simplex_search(corners);
  }

  /// \brief returns the place of the nearest simplex that is nearest to `point`, and its
  /// coordinates; none if there is no simplex, if `point` is not finite, or if it is so far away,
  /// or the shape so large, that the computation overflows.
  ///
  /// On a surface the coordinates are not negative: those of the nearest point. For a point outside
  /// of all tetrahedra they are those of the point itself, and some are negative.
  std::optional<Location<simplex_descriptor>> locate(const typename Domain::Point& point) const
  {
    const Coordinates c = Domain::coordinates(point);
    if(m_search->is_empty() || !internal::is_finite(c))
      return std::nullopt;
    const auto found = m_search->locate(c);
    if(!found)
      return std::nullopt;
    const Part& part = m_parts[found->simplex];
    Location<simplex_descriptor> location = {part.simplex, {}, found->distance};
    location.coordinates.assign(part.number_of_corners, 0);
    for(std::size_t k = 0; k < found->coordinates.size(); ++k)
      location.coordinates[part.corners[k]] += found->coordinates[k];
    return location;
  }

private:
  using Search = internal::Simplex_search<Domain::dimension + 1>;
  using Corners = typename Search::Corners;

  // a simplex, or a triangle of a polygon
  struct Part
  {
    simplex_descriptor simplex;
    std::array<std::size_t, Domain::dimension + 1> corners; // numbers in the simplex
    std::size_t number_of_corners;                          // of the simplex
  };

  void append(const simplex_descriptor& s, const internal::Array<Coordinates>& points,
              std::vector<Corners>& all_corners)
  {
    const auto append_part = [&](const auto& corners) {
      m_parts.push_back({s, corners, points.size()});
      all_corners.emplace_back();
      for(std::size_t k = 0; k < corners.size(); ++k)
        all_corners.back()[k] = points[corners[k]];
    };
    if constexpr(Domain::dimension == 2)
    {
      for(const auto& triangle : internal::triangles_of_polygon(points))
        append_part(triangle);
    }
    else
      append_part(std::array<std::size_t, 4>{0, 1, 2, 3});
  }

  std::vector<Part> m_parts;
  std::unique_ptr<Search> m_search;
};

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the place in the simplices of a mesh or domain that is nearest to a point, for
/// `CGAL::ARAP_deformation::insert_control_point()`.
///
/// Builds a search tree. For more than one point use `Locator`.
///
/// \param shape a mesh as the template parameter `Mesh` of `ARAP_deformation`, with its own points,
///        or a model of `ARAPDomain`, which may have others
/// \param point a point of the shape's type
/// \returns a `std::optional` of a `Location`; none if there is no simplex, if `point` is not
///          finite, or if it is so far away, or the shape so large, that the computation
///          overflows
template <typename Shape, typename Point>
auto locate(const Shape& shape, const Point& point)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    return Locator<std::decay_t<decltype(domain)>>(domain).locate(point);
  });
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the point of a location for the points that a mesh or domain has now: what was
/// located in the rest shape follows the deformed one. Linear time in the number of corners, for a
/// domain; that of a mesh is constructed first, in each call.
///
/// \param shape a mesh or a domain, as for `locate()`
/// \param location a `Location` in it
/// \pre The simplex is one of `shape`, has as many corners as there are coordinates, and these add
///      up to one.
template <typename Shape, typename Simplex>
auto construct_point(const Shape& shape, const Location<Simplex>& location)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    using Domain = std::decay_t<decltype(domain)>;
    std::vector<Coordinates> corners;
    for(const auto& v : domain.simplex_vertices(location.simplex))
      corners.push_back(Domain::coordinates(domain.point(v)));
    CGAL_precondition(corners.size() == location.coordinates.size());
    return typename Domain::Point(Domain::make_point(internal::affine_combination(
      location.coordinates, [&](std::size_t k) { return corners.at(k); }))); // throws in Release
  });
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_LOCATE_H
