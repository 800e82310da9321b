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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SECOND_LOOK_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SECOND_LOOK_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A look at the second derivative 2 A of the energy where a run would end, by conjugate gradients
// for A s = f + e, with the Laplacian L for the preconditioner, f the force and e a small
// pseudorandom one, without which what the symmetry of shape and targets hides would not be seen.
// As long as all directions have positive curvature, the model of the energy decreases, and what it
// tends to is the gap that is left. A direction p with p A p < 0 is found if there is one in the
// space that the steps span (Steihaug 1983); the residual cannot become small as long as it has a
// part along such a direction. A step costs about what one of the minimizer does.
class Second_look
{
public:
  enum class Finding { nothing_yet, negative_curvature, positive_curvature, failure };

  explicit Second_look(Minimization& run) : m_run(run) { m_run.prepare_second_derivative(); }
  ~Second_look() { m_run.clear_second_derivative(); }
  Second_look(const Second_look&) = delete;
  Second_look& operator=(const Second_look&) = delete;

  // `disturbance` is by how much L would let e decrease the energy.
  Finding begin(double disturbance)
  {
    const std::size_t n = m_run.number_of_vertices;
    m_r.resize(n);
    std::uint32_t state = 1;
    for(Coordinates& e : m_r)
      for(double& entry : e)
      {
        state = 1664525 * state + 1013904223;
        entry = state / 4294967296.0 - 0.5;
      }
    m_run.leave_free(m_r);
    if(!solve())
      return Finding::failure;
    const double square = dot_product(m_r, m_z);
    const double factor = square > 0 ? std::sqrt(disturbance / square) : 0;
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
      {
        m_r[v] = scaled(m_r[v], factor);
        add(m_r[v], 1, m_run.force()[v]);
      }
    });
    m_p.assign(m_run.x.size(), Coordinates{0, 0, 0});
    m_s.assign(n, Coordinates{0, 0, 0});
    return next_direction();
  }

  Finding step()
  {
    const std::size_t n = m_run.number_of_vertices;
    m_run.change_of_force(m_p, m_z); // - A p
    const double pap = -dot_product(m_p, m_z);
    if(!(pap > 1e-9 * m_p_square))
      return std::isfinite(pap) ? Finding::negative_curvature : Finding::failure;
    const double alpha = m_r_square / pap;
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
      {
        add(m_s[v], alpha, m_p[v]);
        add(m_r[v], alpha, m_z[v]);
      }
    });
    return next_direction();
  }

  // the last direction, for all vertices of the region
  const std::vector<Coordinates>& direction() const { return m_p; }
  const std::vector<Coordinates>& solution() const { return m_s; } // for the movable ones

  // by how much the energy decreases along the solution, by its model and up to what e changes
  double gap() const { return dot_product(m_run.force(), m_s); }

private:
  bool solve()
  {
    Scoped_seconds global(m_run.report.seconds.global_steps);
    return m_run.solve_for(m_r, m_z);
  }

  Finding next_direction()
  {
    if(!solve())
      return Finding::failure;
    const double square = dot_product(m_r, m_z);
    const double beta = m_first_r_square > 0 ? square / m_r_square : 0;
    if(m_first_r_square == 0)
      m_first_r_square = square;
    m_r_square = square;
    m_p_square = square + beta * beta * m_p_square; // r is orthogonal to the last p
    for_each_block(m_r.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
      {
        m_p[v] = scaled(m_p[v], beta);
        add(m_p[v], 1, m_z[v]);
      }
    });
    if(!(square > 0))
      return square == 0 ? Finding::positive_curvature : Finding::failure;
    // Over some hundred looks, what was found when the residual was smaller than this gained next
    // to nothing.
    constexpr double small_residual = 0.03;
    return square <= small_residual * small_residual * m_first_r_square
             ? Finding::positive_curvature : Finding::nothing_yet;
  }

  Minimization& m_run;
  std::vector<Coordinates> m_r, m_z, m_s; // residual, what L makes of it, solution
  std::vector<Coordinates> m_p;
  double m_r_square = 0, m_first_r_square = 0, m_p_square = 0; // in the metric of L
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SECOND_LOOK_H
