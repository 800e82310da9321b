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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_STEPS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_STEPS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Smooth_rotations.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/dot_product.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/rotation_vectors.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Steps of all rotations together, where they are to be smooth: fitted one by one to what their
// neighbors were, rotations spread slowly, the more so the larger the smoothing length is. Of the
// rotations exp(w_c) R_c the energy is, to second order,
//   -2 sum_c f_c w_c + sum_c w_c H_c w_c + 2 sum over pairs of s_cd || w_c - w_d ||^2.
// A step is its minimum, but with the trace h_c of the covariance in the rest shape, which bounds
// H_c there, instead of H_c: that is one matrix for all iterations and three columns.
class Rotation_steps
{
public:
  // For each cell `leader` is the first one of its group, or itself, and `bounds` has h_c.
  Rotation_steps(std::unique_ptr<Linear_solver> prototype, const Smooth_rotations& smooth,
                 Array<int> leader, const Array<double>& bounds)
    : m_system(std::move(prototype)), m_leader(std::move(leader))
  {
    const int n = static_cast<int>(m_leader.size());
    Array<Eigen::Triplet<double, int>> entries;
    const auto add = [&](int c, int d, double entry) {
      entries.emplace_back((std::max)(m_leader[c], m_leader[d]),
                           (std::min)(m_leader[c], m_leader[d]), entry);
    };
    for(int c = 0; c < n; ++c)
    {
      entries.emplace_back(c, c, 0); // each diagonal entry is stored
      add(c, c, bounds[c]);
    }
    smooth.for_each_pair([&](int c, int d, double weight) {
      if(m_leader[c] == m_leader[d])
        return;
      add(c, c, 2 * weight);
      add(d, d, 2 * weight);
      add(c, d, -2 * weight);
    });
    Laplacian laplacian;
    laplacian.matrix.resize(n, n);
    laplacian.matrix.setFromTriplets(entries.begin(), entries.end());
    m_system.set_laplacian(std::move(laplacian));
  }

  // The rotations of these cells stay. False if the steps cannot be computed then, or nothing is
  // left to turn.
  bool set_given(const Array<int>& cells)
  {
    Constraints constraints;
    for(int c = 0; c < static_cast<int>(m_leader.size()); ++c)
      constraints.is_fixed.push_back(
        m_leader[c] != c || !(diagonal_entry(m_system.laplacian().matrix, c) > 0));
    for(int c : cells)
      constraints.is_fixed[m_leader[c]] = true;
    m_is_fixed = constraints.is_fixed;
    Stages stages;
    return constraints.number_of_free_vertices() > 0 &&
           m_system.prepare(constraints, stages).status == Status::success;
  }

  // By how much a step from the rotations would lower the energy, by its model. The covariances
  // are those of the positions.
  double gain(const Smooth_rotations& smooth, const Array<Matrix_3x3>& covariances,
              const Array<Matrix_3x3>& rotations)
  {
    const std::size_t n = rotations.size();
    m_step.resize(n);
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c)
      {
        // f_c, by which R_c is pulled: the axis of (S_c + sum over d of s_cd R_d) R_c^T
        Matrix_3x3 s = covariances[c];
        smooth.add_neighbors(static_cast<int>(c), rotations, s);
        m_step[c] = axial_vector(product_with_transpose(s, rotations[c]));
      }
    });
    for(std::size_t c = 0; c < n; ++c)
      if(const auto leader = static_cast<std::size_t>(m_leader[c]); leader != c)
        add(m_step[leader], 1, m_step[c]);
    for(std::size_t c = 0; c < n; ++c)
      if(m_is_fixed[c])
        m_step[c] = {0, 0, 0};
    m_force = m_step;
    if(!m_system.solve(m_step))
      return 0;
    return dot_product(m_force, m_step);
  }

  // Takes a step, or a share of it, if that lowers the energy; false if it does not.
  bool take(const Smooth_rotations& smooth, const Array<Matrix_3x3>& covariances,
            Array<Matrix_3x3>& rotations)
  {
    const std::size_t n = rotations.size();
    if(!(gain(smooth, covariances, rotations) > 0))
      return false;
    const double before = smooth.evaluate(rotations);
    m_trial.resize(n);
    for(double t = 1; t > 0.2; t *= 0.5)
    {
      const double gained = 2 * sum_over_blocks(n, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for(std::size_t c = begin; c < end; ++c)
        {
          const auto leader = static_cast<std::size_t>(m_leader[c]);
          m_trial[c] = m_is_fixed[leader]
            ? rotations[c]
            : product(rotation_of_vector(scaled(m_step[leader], t)), rotations[c]);
          for(std::size_t entry = 0; entry < 9; ++entry)
            sum += (m_trial[c][entry] - rotations[c][entry]) * covariances[c][entry];
        }
        return sum;
      });
      if(gained > smooth.evaluate(m_trial) - before)
      {
        rotations.swap(m_trial);
        return true;
      }
    }
    return false;
  }

private:
  Constrained_system m_system;
  Array<int> m_leader;
  Array<char> m_is_fixed;
  Array<Coordinates> m_force, m_step;
  Array<Matrix_3x3> m_trial;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_STEPS_H
