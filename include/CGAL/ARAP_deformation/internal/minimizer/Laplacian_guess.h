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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LAPLACIAN_GUESS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LAPLACIAN_GUESS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// Naive Laplacian editing (Section 4 of the paper): the positions x of the free vertices that
// minimize || L x - L p ||^2, where row i of L is the sum of w_ij (x_i - x_j) over the star of i,
// and p is the rest shape. The rows are those of the free vertices and their neighbors; all others
// are constant. Vertices that are pulled to targets are put there; hard rows are met; other rows
// are not considered. Vertices that are placed already stay where they are.
//
// L^T L is not formed: it has far more entries than L, and its condition number is the square of
// that of L. The normal equations are solved by conjugate gradients, preconditioned by A^-1 A^-1,
// with A the system of the global step, whose factor is there anyway.
class Laplacian_guess
{
public:
  Laplacian_guess(const Stars& stars, const Region& region, const Constraints& constraints,
                  const Array<char>& is_placed, Constrained_system& system)
    : m_stars(stars), m_region(region), m_constraints(constraints), m_system(system),
      m_is_solved_for(region.rest.size(), false), m_bound(region.rest.size(), 0)
  {
    for(std::size_t v = 0; v < is_placed.size(); ++v)
      m_is_solved_for[v] = !constraints.is_fixed[v] && !is_placed[v];
    // Where an equation with large weights has a small one, its rounding error may be anything
    // compared to that: the vertex of the small weight must not move far away to make up for it.
    Array<double> sums(stars.size(), 0); // of the weights of each equation
    stars.for_each_edge([&](int i, int, double w) { sums[i] += std::abs(w); });
    for(int i = 0; i < stars.size(); ++i)
      m_bound[i] += rounding_of_a_sum * sums[i] * sums[i];
    stars.for_each_edge([&](int i, int j, double w) {
      const double error = rounding_of_a_sum * sums[i];
      m_bound[i] += error * error;
      m_bound[j] += error * error + rounding_of_a_sum * w * w;
    });
  }

  // Moves the free vertices of x. Where they are before makes no difference. Returns false if the
  // solver failed.
  bool operator()(const Targets& targets, Array<Coordinates>& x)
  {
    const std::size_t n = m_constraints.is_fixed.size();
    for(std::size_t v = 0; v < n; ++v)
      if(m_is_solved_for[v])
        x[v] = m_region.rest[v];
    for(int r = 0; r < m_constraints.rows.size(); ++r)
      if(const int v = m_constraints.rows.position(r); v >= 0 && m_is_solved_for[v])
      {
        m_is_solved_for[v] = false;
        x[v] = targets.soft[r];
      }
    // solutions with the system keep hard rows
    if(!m_system.meet(targets.hard, x))
      return false;

    // What is raised in the matrix is made up for by further passes, until they gain nothing.
    Coordinates last = {0, 0, 0};
    double first = 0;
    for(int pass = 0; pass < 4; ++pass)
    {
      Array<Coordinates> from_x(x.size());
      std::transform(m_region.rest.begin(), m_region.rest.end(), x.begin(), from_x.begin(),
                     difference);
      Array<Coordinates> correction;
      bool is_solved = false;
      if(!solve(normal_product(from_x, false), correction, is_solved))
        return false;
      if(!is_solved) // in later passes what is left is below what rounding permits
      {
        m_is_found = pass > 0;
        break;
      }
      const Coordinates size = products(correction, correction);
      for(std::size_t c = 0; c < 3; ++c)
        if(pass == 0 || size[c] < 0.25 * last[c])
          for(std::size_t v = 0; v < n; ++v)
            x[v][c] += correction[v][c];
      const double total = size[0] + size[1] + size[2];
      if(pass == 0)
        first = total;
      else if(total <= 1e-8 * first || total >= 0.25 * (last[0] + last[1] + last[2]))
        break;
      last = size;
    }
    return true;
  }

  // whether iterations were enough: not where bending makes the factor a bad preconditioner
  bool is_found() const { return m_is_found; }

private:
  // The solution for a right-hand side, for each coordinate a system of its own, and whether
  // iterations were enough. Returns false if the solver failed.
  bool solve(Array<Coordinates> residual, Array<Coordinates>& x, bool& is_solved)
  {
    const std::size_t n = residual.size();
    x.assign(n, Coordinates{0, 0, 0});
    Array<Coordinates> direction(n, Coordinates{0, 0, 0});
    Coordinates last = {0, 0, 0}, first = last;
    for(int iteration = 0; iteration < 300; ++iteration)
    {
      Array<Coordinates> preconditioned = residual;
      for(int factor = 0; factor < 2; ++factor)
        if(!m_system.solve(preconditioned))
          return false;
      leave_out_others(preconditioned);
      const Coordinates size = products(residual, preconditioned);
      if(iteration == 0)
        first = size;
      bool is_done = true;
      for(std::size_t c = 0; c < 3; ++c)
        is_done &= !(size[c] > 1e-14 * first[c]);
      if(is_done)
        return is_solved = true;
      for(std::size_t v = 0; v < n; ++v)
        for(std::size_t c = 0; c < 3; ++c)
          direction[v][c] = preconditioned[v][c] +
                            (last[c] > 0 ? size[c] / last[c] * direction[v][c] : 0);
      last = size;
      const Array<Coordinates> image = normal_product(direction, true);
      const Coordinates curvature = products(direction, image);
      for(std::size_t c = 0; c < 3; ++c)
      {
        const double step = curvature[c] > 0 ? size[c] / curvature[c] : 0;
        for(std::size_t v = 0; v < n; ++v)
        {
          x[v][c] += step * direction[v][c];
          residual[v][c] -= step * image[v][c];
        }
      }
    }
    return true;
  }

  // L^T L x, of the vertices that are solved for; zero for the other movable ones
  Array<Coordinates> normal_product(Array<Coordinates> x, bool is_raised) const
  {
    x.resize(m_region.rest.size(), Coordinates{0, 0, 0});
    Array<Coordinates> image(m_stars.size(), Coordinates{0, 0, 0});
    m_stars.for_each_edge([&](int i, int j, double w) {
      add(image[i], w, difference(x[i], x[j]));
    });
    Array<Coordinates> result(x.size(), Coordinates{0, 0, 0});
    m_stars.for_each_edge([&](int i, int j, double w) {
      add(result[i], w, image[i]);
      add(result[j], -w, image[i]);
    });
    result.resize(m_constraints.is_fixed.size());
    if(is_raised)
      for(std::size_t v = 0; v < result.size(); ++v)
        add(result[v], m_bound[v], x[v]);
    leave_out_others(result);
    return result;
  }

  void leave_out_others(Array<Coordinates>& x) const
  {
    for(std::size_t v = 0; v < x.size(); ++v)
      if(!m_is_solved_for[v])
        x[v] = {0, 0, 0};
  }

  static Coordinates products(const Array<Coordinates>& a, const Array<Coordinates>& b)
  {
    Coordinates sums = {0, 0, 0};
    for(std::size_t v = 0; v < a.size(); ++v)
      for(std::size_t c = 0; c < 3; ++c)
        sums[c] += a[v][c] * b[v][c];
    return sums;
  }

  const Stars& m_stars;
  const Region& m_region;
  const Constraints& m_constraints;
  Constrained_system& m_system;
  Array<char> m_is_solved_for; // for each vertex
  Array<double> m_bound;       // for each vertex, what is added to the diagonal of L^T L
  bool m_is_found = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LAPLACIAN_GUESS_H
