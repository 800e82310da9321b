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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_BARYCENTRIC_COORDINATES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_BARYCENTRIC_COORDINATES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

using Barycentric_coordinates = std::array<double, 4>;

// The barycentric coordinates of a point, or none if the tetrahedron has no volume up to rounding.
// Their sum is 1. The solution is backward stable: the coordinates reproduce the point even if the
// tetrahedron is thin.
inline std::optional<Barycentric_coordinates>
barycentric_coordinates(const std::array<Coordinates, 4>& corners, const Coordinates& point)
{
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> c(corners.data()->data());
  const Eigen::Matrix3d edges = c.rightCols<3>().colwise() - c.col(0);
  const Eigen::Vector3d from_first = Eigen::Map<const Eigen::Vector3d>(point.data()) - c.col(0);
  Eigen::FullPivLU<Eigen::Matrix3d> decomposition;
  decomposition.setThreshold(1e-12);
  if(!decomposition.compute(edges).isInvertible())
    return std::nullopt;
  const Eigen::Vector3d solution = decomposition.solve(from_first);
  return Barycentric_coordinates{1 - solution.sum(), solution[0], solution[1], solution[2]};
}

// The same for a point in the plane of a triangle, or none if that has no area up to rounding. They
// are those in a tetrahedron over it, as high as the longer edge at its first corner.
inline std::optional<std::array<double, 3>>
barycentric_coordinates(const std::array<Coordinates, 3>& corners, const Coordinates& point)
{
  Coordinates u = difference(corners[1], corners[0]), v = difference(corners[2], corners[0]),
              from_first = difference(point, corners[0]);
  const double size = (std::max)(largest_absolute_value(u), largest_absolute_value(v));
  for(Coordinates* vector : {&u, &v, &from_first})
    for(double& x : *vector)
      x /= size;
  const double length = std::sqrt((std::max)(dot(u, u), dot(v, v)));
  const Coordinates normal = cross(scaled(u, 1 / length), v); // its length is at most that
  const double height = std::sqrt(dot(normal, normal));
  if(!(height > 0))
    return std::nullopt;
  const auto found = barycentric_coordinates(
    {Coordinates{0, 0, 0}, u, v, scaled(normal, length / height)}, from_first);
  if(!found)
    return std::nullopt;
  return std::array<double, 3>{1 - (*found)[1] - (*found)[2], (*found)[1], (*found)[2]};
}

// the numbers of the simplices that have an area or a volume, up to rounding
template <std::size_t N>
std::vector<std::size_t>
simplices_with_content(const std::vector<std::array<Coordinates, N>>& simplices)
{
  std::vector<std::size_t> numbers;
  for(std::size_t s = 0; s < simplices.size(); ++s)
    if(barycentric_coordinates(simplices[s], simplices[s][0]))
      numbers.push_back(s);
  return numbers;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_BARYCENTRIC_COORDINATES_H
