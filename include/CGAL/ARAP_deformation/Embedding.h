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

#ifndef CGAL_ARAP_DEFORMATION_EMBEDDING_H
#define CGAL_ARAP_DEFORMATION_EMBEDDING_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/domain/make_simplex_search.h>
#include <CGAL/ARAP_deformation/internal/domain/weighted_points.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief points that follow a tetrahedral complex. Lets a shape that cannot be deformed itself
/// follow a coarse volume around it (Section 5 of \cgalCite{Sorkine2007AsRigidAs}).
///
/// At construction each point \f$p\f$ is bound to the tetrahedron that contains it, by its
/// barycentric coordinates \f$\lambda_k\f$: \f$p = \sum_k \lambda_k p_k\f$ with
/// \f$\sum_k \lambda_k = 1\f$, where \f$p_k\f$ are the corners. When these have moved to
/// \f$p'_k\f$, the point is at \f$p' = \sum_k \lambda_k p'_k\f$. This map reproduces affine maps,
/// and is continuous in the complex.
///
/// A point outside the complex is bound in the same way to the nearest tetrahedron, and follows its
/// affine map: some of its coordinates are negative. Outside, the map is discontinuous; the jumps
/// grow with the distance from the complex. Use `distance()` to reject points that are too far
/// away. Among equally near tetrahedra the one with the largest minimum coordinate is chosen. The
/// order of the simplices does not matter.
///
/// Tetrahedra without volume, that is, flat up to 1e-12 of their size, are ignored. The others must
/// not overlap when the points are bound.
///
/// The mesh of the domain must outlive the object, and its simplices must not change in the
/// meantime. The embedded points are only read at construction.
///
/// \tparam Domain a model of `ARAPDomain` of dimension 3
template <typename Domain>
class Embedding
{
  static_assert(internal::is_domain<Domain>,
                "Embedding: pass a domain, as make_triangulation_domain(triangulation) returns it");
  static_assert(Domain::dimension == 3,
                "Embedding: the simplices of the domain must be tetrahedra (dimension 3)");

public:
  /// a vertex of the complex.
  using vertex_descriptor = typename Domain::vertex_descriptor;

  /// \brief binds points to the current shape of a complex, which should be its rest shape.
  ///
  /// If this fails, `outcome()` tells why, and the object has no points:
  ///  - `Status::non_finite_point`: a point or a vertex has a coordinate that is infinite or not a
  ///    number, or a point is so far from the complex, or the complex so large, that the
  ///    computation overflows;
  ///  - `Status::not_a_simplex`: a simplex is not a tetrahedron;
  ///  - `Status::no_tetrahedron`: no tetrahedron has a volume.
  ///
  /// Takes \f$O(n \log n)\f$ time and linear memory for a temporary search tree over \f$n\f$
  /// tetrahedra, and typically \f$O(\log n)\f$ time for each point.
  ///
  /// \param domain the complex
  /// \param points a range of points, for example a `std::vector` or `Surface_mesh::points()`. The
  ///        points have `operator[]`.
  template <typename PointRange>
  Embedding(const Domain& domain, const PointRange& points)
    : m_domain(domain)
  {
    m_outcome = bind(points);
    if(!m_outcome)
      m_bindings.clear();
  }

  /// returns whether the points were bound, and if not, why.
  const Outcome& outcome() const { return m_outcome; }

  /// returns the number of points.
  std::size_t size() const { return m_bindings.size(); }

  /// \brief returns the position of point `k` for the current points of the domain. Constant time.
  ///
  /// The current points are those that the domain reads. If the deformation writes to other points,
  /// use a domain that reads these.
  /// \pre `k < size()`
  Coordinates position(std::size_t k) const
  {
    const Binding& bound = binding(k);
    return internal::affine_combination(bound.coordinates, [&](std::size_t i) {
      return Domain::coordinates(m_domain.point(bound.vertices[i]));
    });
  }

  /// \brief assigns all positions to the points of a range, in the order of the embedded points.
  /// Points that have weights keep them. Linear time.
  ///
  /// \param points a range of points, for example the one that was embedded
  /// \pre the range has `size()` points; in Release nothing is written otherwise
  template <typename PointRange>
  void put_points(PointRange&& points) const
  {
    using Point = std::decay_t<decltype(*std::begin(points))>;
    const auto n = std::distance(std::begin(points), std::end(points));
    CGAL_precondition(static_cast<std::size_t>(n) == size());
    if(static_cast<std::size_t>(n) != size())
      return;
    std::vector<Point> moved; // all before the first is assigned: an exception changes none
    moved.reserve(size());
    for(const Point& point : points)
    {
      const Coordinates c = position(moved.size());
      moved.push_back(internal::with_weight_of(
        point, internal::construct_point<false, internal::Bare_point_of<Point>>(c[0], c[1], c[2])));
    }
    std::move(moved.begin(), moved.end(), std::begin(points));
  }

  /// returns how far outside the complex point `k` was when it was bound: 0 if it was inside, or
  /// outside by at most 1e-12 of the longest side of the bounding box of the complex.
  /// \pre `k < size()`
  double distance(std::size_t k) const { return binding(k).distance; }

  /// returns the vertices of the tetrahedron to which point `k` is bound, by ascending index.
  /// \pre `k < size()`
  const std::array<vertex_descriptor, 4>& vertices(std::size_t k) const
  {
    return binding(k).vertices;
  }

  /// returns the barycentric coordinates of point `k`, in the order of `vertices(k)`.
  /// \pre `k < size()`
  const std::array<double, 4>& barycentric_coordinates(std::size_t k) const
  {
    return binding(k).coordinates;
  }

private:
  using Tetrahedron = std::array<vertex_descriptor, 4>;

  struct Binding
  {
    Tetrahedron vertices;
    std::array<double, 4> coordinates;
    double distance;
  };

  const Binding& binding(std::size_t k) const
  {
    CGAL_precondition(k < size());
    return m_bindings.at(k); // throws in Release
  }

  // Each tetrahedron once, in an order that does not depend on that of the domain.
  Outcome find_tetrahedra(std::vector<Tetrahedron>& tetrahedra) const
  {
    const auto is_before = [this](vertex_descriptor v, vertex_descriptor w) {
      return m_domain.index(v) < m_domain.index(w);
    };
    const auto is_same = [this](vertex_descriptor v, vertex_descriptor w) {
      return m_domain.index(v) == m_domain.index(w);
    };
    Outcome outcome = internal::outcome(Status::success);
    std::vector<vertex_descriptor> corners;
    for(vertex_descriptor v : m_domain.vertices())
      m_domain.for_each_incident_simplex(v, [&](const auto&, const auto& simplex_vertices) {
        corners.assign(std::begin(simplex_vertices), std::end(simplex_vertices));
        std::sort(corners.begin(), corners.end(), is_before);
        if(corners.size() != 4 ||
           std::adjacent_find(corners.begin(), corners.end(), is_same) != corners.end())
        {
          if(outcome)
            outcome = internal::outcome(Status::not_a_simplex,
                                        internal::vertex_name(m_domain.index(v)));
        }
        else if(!is_before(corners[0], v)) // at the first of its vertices only
          tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
      });
    std::sort(tetrahedra.begin(), tetrahedra.end(), [&](const auto& a, const auto& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_before);
    });
    return outcome;
  }

  template <typename PointRange>
  Outcome bind(const PointRange& points)
  {
    std::vector<Tetrahedron> tetrahedra;
    if(Outcome outcome = find_tetrahedra(tetrahedra); !outcome)
      return outcome;
    std::vector<internal::Simplex_search<4>::Corners> corners(tetrahedra.size());
    for(std::size_t t = 0; t < tetrahedra.size(); ++t)
      for(std::size_t k = 0; k < 4; ++k)
      {
        const vertex_descriptor v = tetrahedra[t][k];
        corners[t][k] = Domain::coordinates(m_domain.point(v));
        if(!internal::is_finite(corners[t][k]))
          return internal::outcome(Status::non_finite_point,
                                   internal::vertex_name(m_domain.index(v)));
      }
    const auto search = internal::make_simplex_search(corners);
    if(search->is_empty())
      return internal::outcome(Status::no_tetrahedron);

    for(const auto& point : points)
    {
      using Point = std::decay_t<decltype(point)>;
      static_assert(!internal::Point_conversion<Point>::is_planar,
                    "Embedding: the points must have three coordinates");
      const Coordinates c = internal::Point_conversion<Point>::coordinates(point);
      const std::string name = "point " + std::to_string(size());
      if(!internal::is_finite(c))
        return internal::outcome(Status::non_finite_point, name);
      const auto location = search->locate(c);
      if(!location)
        return Outcome(Status::non_finite_point,
                       name + " is too far from the tetrahedra, or these are too large: the "
                              "computation overflows");
      m_bindings.push_back(
        {tetrahedra[location->simplex], location->coordinates, location->distance});
    }
    return Outcome(Status::success, "all points are bound to tetrahedra");
  }

  Domain m_domain;
  Outcome m_outcome;
  std::vector<Binding> m_bindings;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_EMBEDDING_H
