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

#ifndef CGAL_ARAP_DEFORMATION_CONTROL_POINT_H
#define CGAL_ARAP_DEFORMATION_CONTROL_POINT_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief a place inside a face or a tetrahedron.
///
/// The coordinates are barycentric, one for each corner of the simplex, in the order of
/// `simplex_vertices()` of the domain. They add up to one. (For a face of a `FaceGraph` the first
/// corner is `target(halfedge(f, mesh), mesh)`, unlike in the face locations of
/// `CGAL::Polygon_mesh_processing`, which begin with the source.)
template <typename Simplex>
struct Location
{
  Simplex simplex;                 ///< the face or tetrahedron.
  std::vector<double> coordinates; ///< the barycentric coordinates; see `Locator::locate()`.
  double distance = 0;             ///< how far from the simplex the point is that was located.
};

/// \ingroup PkgARAPDeformationRef
/// \brief identifies a control point of a `CGAL::ARAP_deformation`: a handle inside a face or a
/// tetrahedron.
class Control_point
{
public:
  /// constructs an identifier of no control point.
  Control_point() = default;

  /// constructs the identifier with a number; 0 is that of no control point.
  explicit Control_point(std::size_t number) : m_number(number) {}

  /// returns the number by which messages name it: 1, 2, ... in the order of insertion. No number
  /// is used twice in one object.
  std::size_t number() const { return m_number; }

  /// compares the numbers.
  friend bool operator==(Control_point a, Control_point b) { return a.m_number == b.m_number; }
  /// compares the numbers.
  friend bool operator!=(Control_point a, Control_point b) { return a.m_number != b.m_number; }
  /// compares the numbers.
  friend bool operator<(Control_point a, Control_point b) { return a.m_number < b.m_number; }

private:
  std::size_t m_number = 0;
};

/// \ingroup PkgARAPDeformationRef
/// the outcome of inserting a control point.
struct Control_point_insertion : Outcome
{
  Control_point point; ///< the new control point, if it was inserted

  /// constructs an outcome.
  explicit Control_point_insertion(Outcome outcome, Control_point point_ = Control_point())
    : Outcome(std::move(outcome)), point(point_)
  {}
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONTROL_POINT_H
