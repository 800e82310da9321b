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


// Each edge weight that ships conforms to the concept, and broken ones are caught.

#include "include/check.h"
#include "include/conformance.h"

#include <CGAL/ARAP_deformation/Edge_map_weight.h>
#include <CGAL/ARAP_deformation/conformance/check_deformation_traits.h>
#include <CGAL/ARAP_deformation/conformance/check_edge_weight.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation_traits_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

using namespace CGAL::ARAP;

using Triangle = std::array<Coordinates, 3>;

// weights for triangles only, looked up
struct Looked_up_weight
{
  std::array<double, 3> simplex_weights(const Triangle&) const { return {1, 1, 1}; }
  double edge_weight(Edge_set, std::size_t i, std::size_t j, double) const
  {
    return weights.at(std::minmax(i, j));
  }
  std::map<std::pair<std::size_t, std::size_t>, double> weights;
};

struct Depends_on_order : Cotangent_weight
{
  using Cotangent_weight::simplex_weights;
  std::array<double, 3> simplex_weights(const Triangle& t) const
  {
    std::array<double, 3> w = Cotangent_weight::simplex_weights(t);
    w[0] *= 1.001;
    return w;
  }
};

// the edges (0, 3) and (1, 2) are exchanged
struct Wrong_edges_of_tetrahedra : Cotangent_weight
{
  using Cotangent_weight::simplex_weights;
  std::array<double, 6> simplex_weights(const std::array<Coordinates, 4>& t) const
  {
    std::array<double, 6> w = Cotangent_weight::simplex_weights(t);
    std::swap(w[2], w[3]);
    return w;
  }
};

struct Never_finite : Cotangent_weight
{
  std::array<double, 3> simplex_weights(const Triangle&) const
  {
    return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  }
};

struct Counts_calls : Cotangent_weight
{
  std::array<double, 3> simplex_weights(const Triangle&) const
  {
    const double n = ++calls;
    return {n, n, n};
  }
  mutable int calls = 0;
};

struct Copies_are_doubled : Cotangent_weight
{
  Copies_are_doubled() = default;
  Copies_are_doubled(const Copies_are_doubled& other) : factor(2 * other.factor) {}
  Copies_are_doubled& operator=(const Copies_are_doubled&) = default;
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const { return factor * sum; }
  double factor = 1;
};

struct Divides : Cotangent_weight
{
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const { return 1 / sum; }
};

struct Sparse_solver_that_refuses : Multifrontal_cholesky_solver
{
  bool factorize(const Sparse_matrix&) { return false; }
};

int main()
{
  CHECK_CONFORMS(check_edge_weight(Safe_cotangent_weight()));
  CHECK_CONFORMS(check_edge_weight(Cotangent_weight()));
  CHECK_CONFORMS(check_edge_weight(Clamped_cotangent_weight()));
  CHECK_CONFORMS(check_edge_weight(Uniform_weight()));
  Edge_map_weight edge_map;
  edge_map.set_weight(0, 1, 1.5);
  CHECK_CONFORMS(check_edge_weight(edge_map));
  CHECK_CONFORMS(check_edge_weight(Looked_up_weight{{{{2, 7}, 1.5}}}, {{2, 7}, {7, 2}}));

  CHECK_CAUGHT(check_edge_weight(Looked_up_weight()), "threw an exception");
  CHECK_CAUGHT(check_edge_weight(Depends_on_order()), "order of the vertices of a triangle");
  CHECK_CAUGHT(check_edge_weight(Wrong_edges_of_tetrahedra()),
               "order of the vertices of a tetrahedron");
  CHECK_CAUGHT(check_edge_weight(Never_finite()), "not finite in a well-shaped triangle");
  CHECK_CAUGHT(check_edge_weight(Counts_calls()), "asked for again");
  CHECK_CAUGHT(check_edge_weight(Copies_are_doubled()), "of a copy");
  CHECK_CAUGHT(check_edge_weight(Divides()), "not finite for a finite sum");

  // what a traits object hands out
  CHECK_CONFORMS(check_deformation_traits(CGAL::ARAP_deformation_traits_3<>()));
  using Wrong_traits = CGAL::ARAP_deformation_traits_3<Sparse_solver_that_refuses, Divides>;
  CHECK_CAUGHT(check_deformation_traits(Wrong_traits()), "sparse_solver_object(): factorize()");
  CHECK_CAUGHT(check_deformation_traits(Wrong_traits()), "edge_weight_object(): edge_weight()");
  return checks_result();
}
