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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_ITERATE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_ITERATE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// An iterate, as a visitor sees it: a model of ARAPIterate.
template <typename Session>
class Iterate
{
public:
  unsigned int iteration() const { return m_iteration; }
  double energy() const { return m_energy; }

  template <typename VertexPointMap>
  void put_points(VertexPointMap map) const
  {
    m_session.for_each_written_vertex(
      m_session.new_points(m_positions),
      [&map](const auto& vertex, const auto& point) { put(map, vertex, point); });
  }

private:
  friend Session;

  Iterate(const Session& session, const Array<Coordinates>& positions,
          unsigned int iteration, double energy)
    : m_session(session), m_positions(positions), m_iteration(iteration), m_energy(energy)
  {}

  const Session& m_session;
  const Array<Coordinates>& m_positions;
  unsigned int m_iteration;
  double m_energy;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_ITERATE_H
