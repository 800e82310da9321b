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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Rows, or columns, count as linearly dependent if the sine of an angle to the span of others is at
// most this: of what they say about positions six digits would be lost.
constexpr double smallest_sine = 1e-6;

// A sparse matrix B with a weight for each row, for the term  sum_r m_r || B_r x - t_r ||^2  of the
// energy. A vertex that is pulled to a target is a row with one coefficient, 1.
class Weighted_rows
{
public:
  // A row as the range of its vertices.
  struct Row
  {
    const int *first, *last;
    const double* coefficients; // of these vertices
    double length;              // the Euclidean norm of all coefficients

    const int* begin() const { return first; }
    const int* end() const { return last; }

    // Calls f(v, b) for each vertex and its coefficient.
    template <typename Function>
    void for_each_coefficient(const Function& f) const
    {
      const double* b = coefficients;
      for(int v : *this)
        f(v, *b++);
    }
  };

  int size() const { return m_vertices.size(); }

  // the vertex of a row that is the position of one vertex, or -1
  int position(int r) const
  {
    const int k = m_vertices.begin[r];
    return m_vertices.begin[r + 1] == k + 1 && m_coefficients[k] == 1 ? m_vertices.items[k] : -1;
  }

  // adds the row of one vertex
  void append(int vertex, double weight);

  // Adds a row; its vertices differ. It may have others that cannot move and are no part of it: of
  // their coefficients only the sum of squares counts, for its length.
  void append(const Array<int>& vertices, const Array<double>& coefficients, double weight,
              double squares_elsewhere = 0);

  // adds a row of others
  void append(const Row& row, double weight);

  double weight(int r) const { return m_weights[r]; }

  // Takes their weights from rows that have no free vertex: all that they add is a constant.
  void clear_weights_of_fixed(const Array<char>& is_fixed);

  // Calls f(i, j, a) for each entry a of M B^T B of each row with i >= j, in the order of the rows:
  // what entries of B^T M B consist of.
  template <typename Function>
  void for_each_entry(const Function& f) const
  {
    for(int r = 0; r < size(); ++r)
      for(int k = m_vertices.begin[r]; k < m_vertices.begin[r + 1]; ++k)
        for(int l = m_vertices.begin[r]; l < m_vertices.begin[r + 1]; ++l)
          if(m_vertices.items[k] >= m_vertices.items[l])
            f(m_vertices.items[k], m_vertices.items[l],
              m_weights[r] * m_coefficients[k] * m_coefficients[l]);
  }

  // B_r x
  Coordinates value(int r, const Coordinates* x) const
  {
    Coordinates sum = {0, 0, 0};
    row(r).for_each_coefficient([&](int v, double b) { add(sum, b, x[v]); });
    return sum;
  }

  // Where targets want vertices of these rows: a target itself may be no place at all, as the share
  // of vertices that cannot move, and are no part of a row, is taken from it.
  Array<Coordinates> places(const Array<Coordinates>& targets, const Array<Coordinates>& x) const;

  // whether each row has at most one vertex, so that B^T M B is diagonal
  bool is_diagonal() const { return m_is_diagonal; }

  Row row(int r) const
  {
    const int begin = m_vertices.begin[r], end = m_vertices.begin[r + 1];
    const int* const vertices = m_vertices.items.data();
    return {vertices + begin, vertices + end, m_coefficients.data() + begin, m_lengths[r]};
  }

  // calls f(row) for each row
  template <typename Function>
  void for_each_row(const Function& f) const
  {
    for(int r = 0; r < size(); ++r)
      f(row(r));
  }

  // Calls f(v) for each vertex of a row that only one of the two has.
  template <typename Function>
  static void for_each_changed_vertex(const Weighted_rows& a, const Weighted_rows& b,
                                      const Function& f)
  {
    const Array<int> a_order = a.order(), b_order = b.order();
    const auto visit = [&f](const Weighted_rows& rows, int r) {
      for(int v : rows.row(r))
        f(v);
    };
    auto i = a_order.begin(), j = b_order.begin();
    while(i != a_order.end() || j != b_order.end())
      if(j == b_order.end() || (i != a_order.end() && is_less(a, *i, b, *j)))
        visit(a, *i++);
      else if(i == a_order.end() || is_less(b, *j, a, *i))
        visit(b, *j++);
      else
        ++i, ++j;
  }

  // Returns the energy at x for these targets, one for each row, and adds minus half its gradient
  // to the forces.
  double pull(const Array<Coordinates>& targets, const Array<Coordinates>& x,
              Array<Coordinates>& force) const;

private:
  // the rows in an order by their contents
  Array<int> order() const;

  static bool is_less(const Weighted_rows& a, int r, const Weighted_rows& b, int s);

  Index_lists m_vertices;       // of each row
  Array<double> m_coefficients; // of each item of these lists
  Array<double> m_weights;      // of each row
  Array<double> m_lengths;      // the same
  bool m_is_diagonal = true;
};

// the rotation that a handle gives the cells at a vertex
struct Frame
{
  int vertex;
  Matrix_3x3 rotation;
};

// What is prescribed for the movable vertices of a region: some are fixed, rows pull others, and
// hard rows B x = t are met, whatever their weights.
// Targets are no part of it: they may change with each run.
struct Constraints
{
  Array<char> is_fixed;    // for each movable vertex
  Weighted_rows rows;      // of vertices that may be fixed or not
  Weighted_rows hard_rows; // the same
  double inertia = 0;      // If not 0, each free vertex of positive mass has a row that ties it to
                           // where its inertia takes it; then this is the sum of their weights.

  // calls f(row) for each row, first for the soft ones
  template <typename Function>
  void for_each_row(const Function& f) const
  {
    rows.for_each_row(f);
    hard_rows.for_each_row(f);
  }

  std::size_t number_of_free_vertices() const;
};

// The targets of the rows of constraints.
struct Targets
{
  // The target of a row that is a set: what a row has for its target is the projection of its
  // present value.
  struct Set
  {
    int row;
    std::function<Coordinates(const Coordinates&)> projection;
  };

  Array<Coordinates> soft, hard; // one for each row
  std::vector<Set> sets;         // of soft rows, in their order
  double precision = 1e-14;      // relative, of the points that projections take and return
  std::vector<Frame> frames;     // the rotations that are given to cells

  void project(const Weighted_rows& rows, const Array<Coordinates>& x);

  // makes the target of the last soft row a set
  void add_set(std::function<Coordinates(const Coordinates&)> projection)
  {
    sets.push_back({static_cast<int>(soft.size()) - 1, std::move(projection)});
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/constraints/Constraints_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_H
