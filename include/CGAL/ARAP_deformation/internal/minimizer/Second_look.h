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
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_metric.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Pseudorandom_vectors.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/dot_product.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// A look at the second derivative 2 A of the energy where a run would end, by conjugate gradients
// for A s = f + e, with the metric M of the minimizer for the preconditioner: the Laplacian L, on
// large shapes completed by a coarse metric. f is the force, and e a small pseudorandom one, which
// reveals directions that the symmetry of shape and targets would hide.
// As long as all directions have positive curvature, the model of the energy decreases, and what it
// tends to is the gap that is left. A direction p with p A p < 0 is found if there is one in the
// space that the steps span (Steihaug 1983); the residual cannot become small as long as it has a
// part along such a direction. A step costs about what one of the minimizer does.
class Second_look
{
public:
  enum class Finding { nothing_yet, negative_curvature, positive_curvature, failure };

  Second_look(Minimization& run, const Pseudorandom_vectors& disturbance)
    : m_run(run), m_disturbance(disturbance)
  {
    {
      Scoped_seconds global(m_run.report.seconds.global_steps);
      m_coarse_metric = m_run.build_coarse_metric();
    }
    m_run.prepare_second_derivative();
  }
  ~Second_look() { m_run.clear_second_derivative(); }
  Second_look(const Second_look&) = delete;
  Second_look& operator=(const Second_look&) = delete;

  // `decrease` is by how much L would let e decrease the energy.
  Finding begin(double decrease)
  {
    const std::size_t n = m_run.number_of_vertices;
    m_r.resize(n);
    set_disturbance(m_r);
    if(!solve_laplacian())
      return Finding::failure;
    const double square = dot_product(m_r, m_z);
    m_factor = square > 0 ? std::sqrt(decrease / square) : 0;
    combine(m_r, m_factor, m_r, 1, m_run.force());
    m_p.assign(m_run.x.size(), Coordinates{0, 0, 0});
    m_mp.assign(n, Coordinates{0, 0, 0});
    m_s.assign(n, Coordinates{0, 0, 0});
    m_ms.assign(n, Coordinates{0, 0, 0});
    return next_direction();
  }

  Finding step()
  {
    m_run.change_of_force(m_p, m_z); // - A p
    const double pap = -dot_product(m_p, m_z);
    if(!(pap > least_curvature * m_p_square))
      return is_finite(pap) ? Finding::negative_curvature : Finding::failure;
    const double alpha = m_r_square / pap;
    m_curvature += alpha * m_r_square;
    combine(m_s, 1, m_s, alpha, m_p);
    combine(m_ms, 1, m_ms, alpha, m_mp);
    combine(m_r, 1, m_r, alpha, m_z);
    return next_direction();
  }

  // Begins to turn the last direction, the one of negative curvature.
  void turn_to_direction()
  {
    m_ap.swap(m_z); // where step() has left - A p
    combine(m_ap, -1, m_ap, 0, m_ap);
    m_w.assign(m_p.size(), Coordinates{0, 0, 0});
    m_q = m_aq = m_mq = Array<Coordinates>(m_run.number_of_vertices, Coordinates{0, 0, 0});
  }

  // The same for the solution, in which directions of little curvature dominate.
  void turn_to_solution()
  {
    std::copy(m_s.begin(), m_s.end(), m_p.begin());
    m_mp = m_ms;
    m_run.change_of_force(m_p, m_z);
    turn_to_direction();
  }

  // The direction is a mix of many. Turns it toward the one with the least curvature, by a step of
  // the locally optimal preconditioned conjugate gradients of Knyazev (2001): to the best
  // combination of the direction p, of w = M^-1 (A p - c M p) with its curvature c, and of the
  // change q in the last step. False if there is little left to turn, or if it fails.
  bool sharpen()
  {
    const double c = relative_curvature();
    combine(m_r, 1, m_ap, -c, m_mp);
    if(!solve())
      return false;
    const double square = dot_product(m_r, m_z); // of w, in the metric
    if(!(square > 0.01 * c * c * dot_product(m_p, m_mp)))
      return false;
    std::copy(m_z.begin(), m_z.end(), m_w.begin());
    m_run.change_of_force(m_w, m_z);
    combine(m_z, -1, m_z, 0, m_z);

    const Array<Coordinates>* const vectors[] = {&m_p, &m_w, &m_q};
    const Array<Coordinates>* const a_vectors[] = {&m_ap, &m_z, &m_aq};
    const Array<Coordinates>* const metric_vectors[] = {&m_mp, &m_r, &m_mq};
    Eigen::Matrix3d a, l;
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j <= i; ++j)
      {
        a(i, j) = a(j, i) = dot_product(*vectors[i], *a_vectors[j]);
        l(i, j) = l(j, i) = dot_product(*vectors[i], *metric_vectors[j]);
      }
    const Eigen::Vector3d best = lowest_combination(a, l);
    if(!is_finite({best[0], best[1], best[2]}) || best[0] == 0)
      return false;
    combine(m_q, best[1], m_w, best[2], m_q);
    combine(m_aq, best[1], m_z, best[2], m_aq);
    combine(m_mq, best[1], m_r, best[2], m_mq);
    combine(m_p, best[0], m_p, 1, m_q);
    combine(m_ap, best[0], m_ap, 1, m_aq);
    combine(m_mp, best[0], m_mp, 1, m_mq);
    return true;
  }

  // of the direction that is turned
  double curvature_along_direction() const { return dot_product(m_p, m_ap); }
  double relative_curvature() const // to the metric
  {
    return curvature_along_direction() / dot_product(m_p, m_mp);
  }
  bool is_curvature_negative() const { return relative_curvature() < -least_curvature; }

  bool has_coarse_metric() const { return m_coarse_metric != nullptr; }

  // the last direction, for all vertices of the region
  const Array<Coordinates>& direction() const { return m_p; }

  // Whether force and e, at the current positions, point along the direction rather than against
  // it. The force alone would leave to rounding errors what symmetry leaves open.
  bool is_along_force()
  {
    set_disturbance(m_r);
    return dot_product(m_run.force(), m_p) + m_factor * dot_product(m_r, m_p) >= 0;
  }

  const Array<Coordinates>& solution() const { return m_s; } // for the movable ones

  // by how much the energy decreases along the solution, by its model and up to what e changes
  double gap() const { return dot_product(m_run.force(), m_s); }

  double curvature() const { return m_curvature; } // s A s, of the solution s

private:
  static constexpr double least_curvature = 1e-9; // relative to the metric; else rounding errors

  void set_disturbance(Array<Coordinates>& forces) const
  {
    for_each_block(forces.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
        forces[v] = m_disturbance(v);
    });
    m_run.leave_free(forces);
  }

  // result := a x + b y, for the movable vertices; it may be one of them
  void combine(Array<Coordinates>& result, double a, const Array<Coordinates>& x,
               double b, const Array<Coordinates>& y) const
  {
    for_each_block(m_run.number_of_vertices, [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
      {
        const Coordinates other = y[v];
        result[v] = scaled(x[v], a);
        add(result[v], b, other);
      }
    });
  }

  // The coefficients that minimize a quadratic form a where another one, l, is 1, without vectors
  // that others determine.
  static Eigen::Vector3d lowest_combination(const Eigen::Matrix3d& a, const Eigen::Matrix3d& l)
  {
    Eigen::Vector3d scale;
    for(int k = 0; k < 3; ++k)
      scale[k] = l(k, k) > 0 ? 1 / std::sqrt(l(k, k)) : 0;
    const Eigen::Matrix3d scaled_l = scale.asDiagonal() * l * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> metric(scaled_l);
    Eigen::Matrix3d basis = scale.asDiagonal() * metric.eigenvectors();
    for(int k = 0; k < 3; ++k)
      basis.col(k) *= metric.eigenvalues()[k] > 1e-8 ? 1 / std::sqrt(metric.eigenvalues()[k]) : 0;
    Eigen::Matrix3d form = basis.transpose() * a * basis;
    const double above_all = 1 + form.norm();
    for(int k = 0; k < 3; ++k)
      if(basis.col(k).isZero(0)) // not a matrix of fewer rows: that costs seconds to compile
        form(k, k) = above_all;
    return basis * Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(form).eigenvectors().col(0);
  }

  bool solve_laplacian()
  {
    Scoped_seconds global(m_run.report.seconds.global_steps);
    return m_run.solve_for(m_r, m_z);
  }

  bool solve() // z := M^-1 r
  {
    if(!solve_laplacian())
      return false;
    Scoped_seconds global(m_run.report.seconds.global_steps);
    return !m_coarse_metric || m_coarse_metric->add_solution(m_r, m_z);
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
    combine(m_p, beta, m_p, 1, m_z);
    combine(m_mp, beta, m_mp, 1, m_r);
    if(!(square > 0))
      return square == 0 ? Finding::positive_curvature : Finding::failure;
    // Smaller ones tell the gap better and take more steps, but hardly find more; 0.2 finds less.
    constexpr double small_residual = 0.1;
    return square <= small_residual * small_residual * m_first_r_square
             ? Finding::positive_curvature : Finding::nothing_yet;
  }

  Minimization& m_run;
  const Pseudorandom_vectors& m_disturbance;
  Coarse_metric* m_coarse_metric = nullptr; // if there is one
  Array<Coordinates> m_r, m_z;      // residual and M^-1 times it
  Array<Coordinates> m_s, m_ms;     // solution and M s
  Array<Coordinates> m_p, m_mp;     // direction and M p
  Array<Coordinates> m_ap, m_w, m_q, m_aq, m_mq; // of sharpen(): A p and so on
  double m_r_square = 0, m_first_r_square = 0, m_p_square = 0; // in the metric
  double m_curvature = 0;
  double m_factor = 0; // of the disturbance
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SECOND_LOOK_H
