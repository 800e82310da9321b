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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SMOOTH_ROTATIONS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SMOOTH_ROTATIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Smooth rotations (Levi and Gotsman 2015), the last term of the energy, over pairs of
// neighboring cells c and d:
//   s_cd || R_c - R_d ||^2.
// Here rotations are state: all are fitted at once to what those before give, which are Q. A cell
// gets the covariance  sum over d of s_cd (Q_d + Q_c)  besides its own. By that the sum falls,
// since the matrix of the s_cd is at most twice its diagonal, and the order of the cells does not
// matter.
class Smooth_rotations
{
public:
  Smooth_rotations() = default; // none

  // the weights s_cd for each item of the lists, which are symmetric
  Smooth_rotations(Index_lists neighbors, Array<double> weights)
    : m_neighbors(std::move(neighbors)), m_weights(std::move(weights)),
      m_sum_of_weights(std::accumulate(m_weights.begin(), m_weights.end(), 0.0))
  {}

  bool is_none() const { return m_weights.empty(); }

  // what rounding the rotations makes of a sum that is zero
  double rounding_level() const
  {
    constexpr double error = 8 * std::numeric_limits<double>::epsilon(); // of a difference
    return m_sum_of_weights * error * error;
  }

  // to be called before the rotations are fitted
  void keep(const Array<Matrix_3x3>& rotations)
  {
    if(!is_none())
      m_before = rotations;
  }

  // for the cells in [begin, end)
  void add_covariances(int begin, int end, Matrix_3x3* covariances) const
  {
    if(is_none())
      return;
    for(int c = begin; c < end; ++c)
      for(int k = m_neighbors.begin[c]; k < m_neighbors.begin[c + 1]; ++k)
      {
        const auto own = static_cast<std::size_t>(c);
        const auto other = static_cast<std::size_t>(m_neighbors.items[k]);
        for(std::size_t entry = 0; entry < 9; ++entry)
          covariances[c - begin][entry] +=
            m_weights[k] * (m_before[own][entry] + m_before[other][entry]);
      }
  }

  // adds to a matrix the sum over d of s_cd R_d
  void add_neighbors(int c, const Array<Matrix_3x3>& rotations, Matrix_3x3& sum) const
  {
    for(int k = m_neighbors.begin[c]; k < m_neighbors.begin[c + 1]; ++k)
      add(sum, m_weights[k], rotations[m_neighbors.items[k]]);
  }

  // calls f(c, d, s_cd) for each pair of neighbors c < d
  template <typename Function>
  void for_each_pair(const Function& f) const
  {
    for(int c = 0; c < m_neighbors.size(); ++c)
      for(int k = m_neighbors.begin[c]; k < m_neighbors.begin[c + 1]; ++k)
        if(m_neighbors.items[k] > c)
          f(c, m_neighbors.items[k], m_weights[k]);
  }

  double evaluate(const Array<Matrix_3x3>& rotations) const
  {
    if(is_none())
      return 0;
    const auto number_of_cells = static_cast<std::size_t>(m_neighbors.size());
    return sum_over_blocks(number_of_cells, [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for(std::size_t c = begin; c < end; ++c)
        for(int k = m_neighbors.begin[c]; k < m_neighbors.begin[c + 1]; ++k)
          if(const auto d = static_cast<std::size_t>(m_neighbors.items[k]); c < d)
          {
            double square = 0;
            for(std::size_t entry = 0; entry < 9; ++entry)
            {
              const double difference = rotations[c][entry] - rotations[d][entry];
              square += difference * difference;
            }
            sum += m_weights[k] * square;
          }
      return sum;
    });
  }

private:
  Index_lists m_neighbors;
  Array<double> m_weights;
  double m_sum_of_weights = 0;
  Array<Matrix_3x3> m_before;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SMOOTH_ROTATIONS_H
