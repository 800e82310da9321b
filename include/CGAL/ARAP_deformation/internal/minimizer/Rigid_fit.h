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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_FIT_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_FIT_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <optional>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rigid motion that takes points nearest to others, in the sense of least squares. Where
// several motions are nearest up to rounding, as for points on a line, that with the smallest
// rotation.
class Rigid_fit
{
public:
  Rigid_fit(const Array<Coordinates>& from, const Array<Coordinates>& to);

  Coordinates operator()(const Coordinates& p) const
  {
    Coordinates q = product(m_rotation, difference(p, m_from));
    add(q, 1, m_to);
    return q;
  }

  const Matrix_3x3& rotation() const { return m_rotation; }

  // the largest squared distance that is left between two corresponding points
  double squared_error() const { return m_squared_error; }

private:
  Coordinates m_from, m_to; // the centroids
  Matrix_3x3 m_rotation = identity_matrix();
  double m_squared_error = 0;
};

// The rotation of the rigid motion that takes points to others, if there is one and only one.
std::optional<Matrix_3x3> rotation_of_motion(const Array<Coordinates>& from,
                                             const Array<Coordinates>& to);

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_FIT_H
