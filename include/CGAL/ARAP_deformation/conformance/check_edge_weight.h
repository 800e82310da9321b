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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_EDGE_WEIGHT_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_EDGE_WEIGHT_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/conformance/internal/Violations.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/energy/edge_weight_requirements.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

namespace internal {

template <typename EdgeWeight>
class Edge_weight_check
{
  static_assert(Edge_weight_requirements<EdgeWeight>::are_met);

public:
  using Edges = std::vector<std::pair<std::size_t, std::size_t>>;

  Edge_weight_check(const EdgeWeight& weight, const Edges& edges)
    : m_weight(weight), m_edges(edges)
  {}

  std::vector<std::string> operator()()
  {
    m_violations.run("the edge weight", [this] {
      check_simplices<3>("triangle");
      if constexpr(is_valid<Call_tetrahedron_weights, EdgeWeight>)
        check_simplices<4>("tetrahedron");
      check_sums();
    });
    return m_violations.sentences();
  }

private:
  double random() { return std::uniform_real_distribution<double>(-1, 1)(m_random); }

  // a regular simplex of random size and position, its corners perturbed by a tenth of its edges
  template <std::size_t N>
  std::array<Coordinates, N> well_shaped_simplex()
  {
    const Coordinates corners[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const double size = std::pow(10.0, 3 * random()), place = 3 * size * random();
    std::array<Coordinates, N> simplex;
    for(std::size_t k = 0; k < N; ++k)
      for(std::size_t c = 0; c < 3; ++c)
        simplex[k][c] = place + size * (corners[k][c] + 0.2 * random());
    return simplex;
  }

  // Calls f(k, a, b) for the k-th edge (a, b), in the order of the weights.
  template <std::size_t N, typename Function>
  static void for_each_edge(const Function& f)
  {
    std::size_t k = 0;
    for(std::size_t a = 0; a < N; ++a)
      for(std::size_t b = a + 1; b < N; ++b)
        f(k++, a, b);
  }

  template <std::size_t N>
  void check_simplices(const std::string& name)
  {
    const EdgeWeight copy(m_weight);
    for(int repetition = 0; repetition < 50; ++repetition)
    {
      const std::array<Coordinates, N> simplex = well_shaped_simplex<N>();
      const std::array<double, N * (N - 1) / 2> weights = m_weight.simplex_weights(simplex);
      double largest = 0;
      for(double w : weights)
      {
        m_violations.check(internal::is_finite(w), "a weight is not finite in a well-shaped ",
                           name);
        m_weights.push_back(w);
        largest = (std::max)(largest, std::abs(w));
      }
      if(!internal::is_finite(largest))
        continue;
      m_violations.check(m_weight.simplex_weights(simplex) == weights, "the weights of a ", name,
                         " differ when asked for again");
      m_violations.check(copy.simplex_weights(simplex) == weights,
                         "a copy gives other weights in a ", name);

      std::array<std::size_t, N> order;
      std::iota(order.begin(), order.end(), std::size_t(0));
      while(std::next_permutation(order.begin(), order.end()))
      {
        std::array<Coordinates, N> permuted;
        for(std::size_t k = 0; k < N; ++k)
          permuted[k] = simplex[order[k]];
        const std::array<double, N * (N - 1) / 2> others = m_weight.simplex_weights(permuted);
        for_each_edge<N>([&](std::size_t k, std::size_t a, std::size_t b) {
          for_each_edge<N>([&](std::size_t l, std::size_t c, std::size_t d) {
            if(std::minmax(order[a], order[b]) == std::minmax(c, d))
              m_violations.check(std::abs(others[k] - weights[l]) <= 1e-9 * largest, "the weight "
                                 "of an edge depends on the order of the vertices of a ", name);
          });
        });
      }
    }
  }

  void check_sums()
  {
    const EdgeWeight copy(m_weight);
    std::vector<double> sums = m_weights; // of one simplex, at a border edge, and of two
    for(std::size_t k = 1; k < m_weights.size(); ++k)
      sums.push_back(m_weights[k - 1] + m_weights[k]);
    sums.push_back(0);
    const std::set<std::pair<std::size_t, std::size_t>> known(m_edges.begin(), m_edges.end());
    for(const auto& [i, j] : m_edges)
    {
      const bool is_known_twice = known.count({j, i}) > 0;
      for(Edge_set edge_set : {Edge_set::star, Edge_set::simplex})
        for(double size : sums)
          for(double sum : {size, -size})
          {
            const double w = m_weight.edge_weight(edge_set, i, j, sum);
            m_violations.check(internal::is_finite(w),
                               "edge_weight() is not finite for a finite sum");
            if(!internal::is_finite(w))
              continue;
            m_violations.check(m_weight.edge_weight(edge_set, i, j, sum) == w,
                               "edge_weight() differs when asked for again");
            m_violations.check(copy.edge_weight(edge_set, i, j, sum) == w,
                               "edge_weight() of a copy differs");
            if(edge_set == Edge_set::simplex && is_known_twice)
              m_violations.check(m_weight.edge_weight(edge_set, j, i, sum) == w, "edge_weight() in "
                                 "a simplex depends on which vertex is first");
          }
    }
  }

  EdgeWeight m_weight;
  Edges m_edges;
  std::mt19937 m_random;
  std::vector<double> m_weights; // of simplices
  Violations m_violations;
};

} // namespace internal

/// \ingroup PkgARAPDeformationChecks
/// \brief returns a message for each requirement of `ARAPEdgeWeight` that a model violates; none if
/// it conforms.
///
/// In well-shaped triangles, and in tetrahedra if the model supports them, the weights must be
/// finite, independent of the order of the vertices, and the same in a second call and for a copy.
/// `edge_weight()` must be finite for their sums, and in simplices the same from both vertices of
/// an edge, if `edges` has it twice. Takes milliseconds.
///
/// \param weight the model
/// \param edges the edges to call `edge_weight()` with, given by the indices of their vertices; if
///        the model looks up weights, edges that it knows
template <typename EdgeWeight>
std::vector<std::string>
check_edge_weight(const EdgeWeight& weight,
                  const std::vector<std::pair<std::size_t, std::size_t>>& edges = {{0, 1}, {1, 0}})
{
  return internal::Edge_weight_check<EdgeWeight>(weight, edges)();
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_EDGE_WEIGHT_H
