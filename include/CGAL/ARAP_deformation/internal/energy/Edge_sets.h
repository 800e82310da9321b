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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_SETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_SETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace CGAL {
namespace ARAP {
namespace internal {

// a share of the largest weight of an edge set: what is below zero by less is a rounding error
constexpr double negligible_weight = 1e-9;

// The edge sets that are stars: the neighbors of each center, in the order of their numbers, and
// the weights of the edges to them.
struct Stars
{
  Index_lists neighbors;
  Array<double> weights; // for each item of `neighbors`

  int size() const { return neighbors.size(); }

  // the place of the neighbor j of i
  int find(int i, int j) const
  {
    const auto [begin, end] = neighbors.list(i);
    const int* const found = std::lower_bound(begin, end, j);
    CGAL_assertion(found != end && *found == j);
    return static_cast<int>(found - neighbors.items.data());
  }

  // whether no star has a negative energy, up to rounding
  bool are_sums_of_squares() const
  {
    for(int i = 0; i < size(); ++i)
      if(neighbors.begin[i] < neighbors.begin[i + 1])
      {
        const auto [least, largest] = std::minmax_element(
          weights.begin() + neighbors.begin[i], weights.begin() + neighbors.begin[i + 1]);
        if(*least < -negligible_weight * *largest)
          return false;
      }
    return true;
  }

  // calls f(i, j, w) for each edge (i, j) of the star of i with its weight w
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    for(int i = 0; i < size(); ++i)
      for(int e = neighbors.begin[i]; e < neighbors.begin[i + 1]; ++e)
        f(i, neighbors.items[e], weights[e]);
  }
};

// a vertex with an edge whose weight is not finite, or -1; for what calls a function for each edge
template <typename Edges>
int find_vertex_of_non_finite_weight(const Edges& edges)
{
  int vertex = -1;
  edges.for_each_edge([&vertex](int i, int, double weight) {
    if(vertex < 0 && !is_finite(weight))
      vertex = i;
  });
  return vertex;
}

// The edge sets that are simplices: the corners of each, and the weights of the edges between all
// pairs of them, in the order (0, 1), (0, 2), ..., (1, 2), ...
struct Simplices
{
  Index_lists corners;
  Array<int> first_weight;
  Array<double> weights;
  bool is_sum_of_squares = true; // weights that come from the shapes of simplices count as such

  int size() const { return corners.size(); }
  int number_of_corners(int s) const { return corners.begin[s + 1] - corners.begin[s]; }

  // the weight of the edge between two corners of s, given by their places in corners.items
  double weight(int s, int place, int other) const
  {
    const int n = number_of_corners(s);
    const auto [a, b] = std::minmax({place - corners.begin[s], other - corners.begin[s]});
    return weights[first_weight[s] + a * (2 * n - a - 1) / 2 + b - a - 1];
  }

  // Whether no simplex has a negative energy, up to rounding, whatever its edges. Cubic time in the
  // number of its corners where a weight is negative.
  bool are_sums_of_squares() const
  {
    Array<double> matrix;
    for(int s = 0; s < size(); ++s)
    {
      const double* const w = weights.data() + first_weight[s];
      const int n = number_of_corners(s);
      if(std::any_of(w, w + n * (n - 1) / 2, [](double weight) { return weight < 0; }) &&
         !has_no_negative_energy(n, w, matrix))
        return false;
    }
    return true;
  }

  // calls f(s, i, j, w) for each edge (i, j) of each simplex s, in the order of their weights w
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    for(int s = 0; s < size(); ++s)
      for_each_edge_of(s, [&f, s](int i, int j, double w) { f(s, i, j, w); });
  }

  // calls f(i, j, w) for each edge of simplex s
  template <typename Function>
  void for_each_edge_of(int s, const Function& f) const
  {
    const double* w = weights.data() + first_weight[s];
    for(int a = corners.begin[s]; a < corners.begin[s + 1]; ++a)
      for(int b = a + 1; b < corners.begin[s + 1]; ++b, ++w)
        f(corners.items[a], corners.items[b], *w);
  }

private:
  // Whether the matrix of a simplex has no negative eigenvalue up to rounding: raised by that much
  // its pivots are positive. NaN are found elsewhere.
  static bool has_no_negative_energy(int n, const double* w, Array<double>& matrix)
  {
    matrix.assign(static_cast<std::size_t>(n * n), 0); // the lower triangle, row by row
    double largest = 0;
    for(int a = 0; a < n; ++a)
      for(int b = a + 1; b < n; ++b, ++w)
      {
        matrix[b * n + a] = -*w;
        matrix[a * n + a] += *w;
        matrix[b * n + b] += *w;
        largest = (std::max)(largest, std::abs(*w));
      }
    for(int a = 0; a < n; ++a)
      matrix[a * n + a] += negligible_weight * largest;
    for(int k = 0; k < n; ++k)
    {
      const double pivot = matrix[k * n + k];
      if(pivot <= 0)
        return false;
      for(int a = k + 1; a < n; ++a)
        for(int b = k + 1; b <= a; ++b)
          matrix[a * n + b] -= matrix[a * n + k] * matrix[b * n + k] / pivot;
    }
    return true;
  }
};

// The sums of |w| and of |w| ||e||^2 over edges e with weights w.
struct Edge_sums
{
  double weights = 0, squares = 0;

  void add(double weight, const Double4& edge)
  {
    const Double4 square = edge * edge;
    weights += std::abs(weight);
    squares += std::abs(weight) * (square[0] + square[1] + square[2]);
  }

  friend Edge_sums operator+(const Edge_sums& a, const Edge_sums& b)
  {
    return {a.weights + b.weights, a.squares + b.squares};
  }
};

// The edge sets of each cell, which share one rotation and the stiffness of the cell.
struct Cells
{
  Index_lists sets;
  Array<double> stiffness;

  int size() const { return sets.size(); }
};

// each edge set is a cell
inline Cells separate_cells(int number_of_sets)
{
  Cells cells;
  cells.sets.begin = Array<int>(number_of_sets + 1);
  std::iota(cells.sets.begin.begin(), cells.sets.begin.end(), 0);
  cells.sets.items.assign(cells.sets.begin.begin(), cells.sets.begin.end() - 1);
  cells.stiffness = Array<double>(number_of_sets, 1);
  return cells;
}

// the simplices with these corners are a cell at each of the first `number_of_centers` vertices
inline Cells vertex_cells(const Index_lists& corners, int number_of_centers)
{
  return {lists_with(corners, number_of_centers), Array<double>(number_of_centers, 1)};
}

// the stars within k rings around each of the first `number_of_cells` vertices
inline Cells ring_cells(const Index_lists& neighbors, int number_of_cells, unsigned int k)
{
  Cells cells;
  cells.stiffness = Array<double>(number_of_cells, 1);
  Array<int> last_cell(neighbors.size(), -1);
  for(int c = 0; c < number_of_cells; ++c)
  {
    Array<int>& items = cells.sets.items;
    std::size_t begin = items.size();
    items.push_back(c);
    last_cell[c] = c;
    for(unsigned int ring = 0; ring < k; ++ring)
      for(const std::size_t end = items.size(); begin < end; ++begin)
        for(int e = neighbors.begin[items[begin]]; e < neighbors.begin[items[begin] + 1]; ++e)
          if(const int j = neighbors.items[e]; last_cell[j] != c)
          {
            last_cell[j] = c;
            items.push_back(j);
          }
    cells.sets.end_list();
  }
  return cells;
}

// Sums the covariances of the edge sets of each cell in [begin, end), times the stiffness of the
// cell.
struct Sum_of_covariances_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Cells& cells, const Matrix_3x3* of_sets, int begin,
                                          int end, Matrix_3x3* covariances)
  {
    for(int c = begin; c < end; ++c)
    {
      Double4 first = Double4::zero(), second = first; // four entries each
      double last = 0;
      for(int k = cells.sets.begin[c]; k < cells.sets.begin[c + 1]; ++k)
      {
        const double* entries = of_sets[cells.sets.items[k]].data();
        first = first + Double4::load(entries);
        second = second + Double4::load(entries + 4);
        last += entries[8];
      }
      const Double4 stiffness = Double4::all(cells.stiffness[c]);
      double* sum = covariances[c - begin].data();
      (stiffness * first).store(sum);
      (stiffness * second).store(sum + 4);
      sum[8] = cells.stiffness[c] * last;
    }
  }
};

inline void add_up_covariances(const Cells& cells, const Array<Matrix_3x3>& of_sets, int begin,
                               int end, Matrix_3x3* covariances)
{
  run_kernel<Sum_of_covariances_kernel>(cells, of_sets.data(), begin, end, covariances);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_SETS_H
