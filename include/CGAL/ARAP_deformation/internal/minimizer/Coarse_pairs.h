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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_PAIRS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_PAIRS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_metric.h>
#include <CGAL/ARAP_deformation/internal/region/dot_product.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What a coarse metric adds to the pairs of a quasi-Newton method, slot by slot, and to the step d
// of the present force f: the parts P^T y, C^-1 P^T y and P^T f, C^-1 P^T f. These are as short as
// the nodes are few, so that all products with them cost next to nothing, and one solution for each
// f is enough.
class Coarse_pairs
{
public:
  explicit Coarse_pairs(std::size_t number_of_slots) : m_y(number_of_slots), m_z(number_of_slots) {}

  bool is_active() const { return m_metric != nullptr; }

  // another metric, or none; no slot is in use until it is remembered anew
  void set_metric(Coarse_metric* metric) { m_metric = metric; }

  bool set_next_force(const Array<Coordinates>& force)
  {
    if(!is_active())
      return true;
    m_next_force = m_next_d = m_metric->restricted(force);
    return m_metric->solve(m_next_d);
  }

  // y is the present force minus the next one, in this unit
  void remember(std::size_t slot, double unit)
  {
    m_y[slot] = change(m_force, m_next_force, unit);
    m_z[slot] = change(m_d, m_next_d, unit);
  }

  void take_next_force()
  {
    m_force.swap(m_next_force);
    m_d.swap(m_next_d);
  }

  // what is added to the products of z with f, and with a y
  double fz(std::size_t slot) const { return is_active() ? dot_product(m_force, m_z[slot]) : 0; }
  double zy(std::size_t slot, std::size_t other) const
  {
    return is_active() ? dot_product(m_z[slot], m_y[other]) : 0;
  }

  // what is added to a step that has these shares of d and of the z of slots
  template <typename Slots, typename Shares>
  Array<Coordinates> step(std::size_t number_of_vertices, double of_d, const Slots& slots,
                          const Shares& of_z) const
  {
    if(!is_active())
      return {};
    Array<Coordinates> u(m_d.size(), Coordinates{0, 0, 0});
    for(std::size_t k = 0; k < u.size(); ++k)
    {
      add(u[k], of_d, m_d[k]);
      for(std::size_t i = 0; i < slots.size(); ++i)
        add(u[k], of_z[i], m_z[slots[i]][k]);
    }
    Array<Coordinates> result(number_of_vertices, Coordinates{0, 0, 0});
    m_metric->add_prolonged(u, result);
    return result;
  }

private:
  static Array<Coordinates> change(const Array<Coordinates>& from, const Array<Coordinates>& to,
                                   double unit)
  {
    Array<Coordinates> result(from.size());
    for(std::size_t k = 0; k < from.size(); ++k)
      result[k] = scaled(difference(from[k], to[k]), 1 / unit);
    return result;
  }

  Coarse_metric* m_metric = nullptr;
  Array<Coordinates> m_force, m_d, m_next_force, m_next_d;
  std::vector<Array<Coordinates>> m_y, m_z; // of the slots
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_PAIRS_H
