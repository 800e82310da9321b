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

#ifndef CGAL_ARAP_DEFORMATION_CHECKS_H
#define CGAL_ARAP_DEFORMATION_CHECKS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationChecks
/// returns whether \f$R^T R = I\f$ and \f$\det R = +1\f$, each entry up to `tolerance`.
inline bool is_rotation(const Matrix_3x3& r, double tolerance = 1e-12)
{
  const Coordinates rows[3] = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 3; ++j)
      if(!(std::abs(internal::dot(rows[i], rows[j]) - (i == j)) <= tolerance))
        return false;
  return std::abs(internal::dot(internal::cross(rows[0], rows[1]), rows[2]) - 1) <= tolerance;
}

/// \ingroup PkgARAPDeformationChecks
/// returns the number of the first iteration after which the energy is higher than before it, or 0
/// if it never rises. Differences below the rounding error of the energy's scale do not count.
inline std::size_t first_rise_of_energy(const Report& report)
{
  for(std::size_t k = 1; k < report.energy.size(); ++k)
  {
    const double before = report.energy[k - 1];
    if(!(report.energy[k] <= before + internal::energy_resolution(before, report.energy_scale)))
      return k;
  }
  return 0;
}

/// \ingroup PkgARAPDeformationChecks
/// \brief returns the relative root mean square error of the edge lengths,
/// \f$\sqrt{\sum (l' - l)^2 / \sum l^2}\f$ over all edges (Table 1 of
/// \cgalCite{Sorkine2007AsRigidAs}).
///
/// \param mesh a model of `EdgeListGraph`
/// \param rest_points a readable property map to the points of the rest shape, lengths \f$l\f$
/// \param points a readable property map to the points of the deformed shape, lengths \f$l'\f$
template <typename Mesh, typename RestPointMap, typename VertexPointMap>
double relative_edge_length_error(const Mesh& mesh, RestPointMap rest_points, VertexPointMap points)
{
  const auto length = [&mesh](auto map, auto edge) {
    const auto& p = get(map, source(edge, mesh));
    const auto& q = get(map, target(edge, mesh));
    return std::hypot(CGAL::to_double(p[0] - q[0]), CGAL::to_double(p[1] - q[1]),
                      CGAL::to_double(p[2] - q[2]));
  };
  double sum_of_errors = 0, sum_of_lengths = 0;
  for(auto edge : edges(mesh))
  {
    const double rest = length(rest_points, edge), error = length(points, edge) - rest;
    sum_of_errors += error * error;
    sum_of_lengths += rest * rest;
  }
  return sum_of_lengths == 0 ? 0 : std::sqrt(sum_of_errors / sum_of_lengths);
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CHECKS_H
