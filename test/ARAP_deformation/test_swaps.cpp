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


// One deformation, solved by all solvers and with all rotation fittings: how far the shapes are
// from that of the default, relative to the bounding box.

#include "include/Single_precision_solver.h"
#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/Sparse_linear_algebra_adaptor.h>
#include <CGAL/ARAP_deformation_traits_3.h>
#ifdef CGAL_LINKED_WITH_CHOLMOD
#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#endif

#include <CGAL/Default.h>
#include <CGAL/Deformation_Eigen_closest_rotation_traits_3.h>
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>
#include <CGAL/Eigen_solver_traits.h>

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

using namespace CGAL::ARAP;

using Matrix = CGAL::Eigen_sparse_matrix<double>::EigenType;
using CGAL_LU = CGAL::Eigen_solver_traits<Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>>;
using CGAL_LDLT = CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix>>;
using CGAL_svd = CGAL::Deformation_Eigen_closest_rotation_traits_3;
using CGAL_polar = CGAL::Deformation_Eigen_polar_closest_rotation_traits_3;

class Swaps
{
public:
  explicit Swaps(unsigned int iterations) : m_iterations(iterations) {}

  template <typename Traits>
  void operator()(const char* name, const Traits& traits, double bound)
  {
    double largest = 0;
    for(const Cell_scheme& cells :
        {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
      for(double target_weight : {std::numeric_limits<double>::infinity(), 0.5})
      {
        const std::size_t k = m_run++;
        if(k == m_default.size())
          m_default.push_back(deformed(traits, cells, target_weight));
        const std::vector<Eigen::Vector3d> points = deformed(traits, cells, target_weight);
        for(std::size_t v = 0; v < points.size(); ++v)
          largest = (std::max)(largest, (points[v] - m_default[k][v]).norm() / m_shape.diameter());
      }
    m_run = 0;
    std::printf("%-60s %.1e\n", name, largest);
    test_case() = name;
    CHECK_AT_MOST(largest, bound);
  }

private:
  template <typename Traits>
  std::vector<Eigen::Vector3d> deformed(const Traits& traits, const Cell_scheme& cells,
                                        double target_weight) const
  {
    Mesh mesh = make_mesh<Mesh>(m_shape);
    CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh, traits);
    Options options;
    options.cells = cells;
    deformation.set_options(options);
    prepare(deformation, scenario(m_shape), all_vertices(mesh));
    for(auto v : deformation.control_vertices())
      CHECK(deformation.set_target_weight(v, target_weight));
    CHECK(deformation.deform(m_iterations, 0));
    std::vector<Eigen::Vector3d> points;
    for(auto v : mesh.vertices())
      points.push_back(vector(mesh.point(v)));
    return points;
  }

  Shape m_shape = grid("bumpy sheet", 48, 36, [](double u, double v) {
    return Eigen::Vector3d(2 * u, 1.5 * v, 0.1 * std::sin(19 * u) * std::cos(13 * v));
  });
  unsigned int m_iterations;
  std::size_t m_run = 0;
  std::vector<std::vector<Eigen::Vector3d>> m_default; // for each case
};

template <typename Solver>
CGAL::ARAP_deformation_traits_3<Solver> with_solver(const Solver& solver = Solver())
{
  return CGAL::ARAP_deformation_traits_3<Solver>(solver);
}

template <typename Rotation>
CGAL::ARAP_deformation_traits_3<CGAL::Default, CGAL::Default, Rotation> with_rotation()
{
  return CGAL::ARAP_deformation_traits_3<CGAL::Default, CGAL::Default, Rotation>();
}

int main()
{
  Swaps swaps(20);
  swaps("Multifrontal_cholesky_solver, Newton_closest_rotation (default)",
        CGAL::ARAP_deformation_traits_3<>(), 0);

  const double direct = 1e-8;
  swaps("Eigen_sparse_solver<Eigen::SimplicialLLT>",
        with_solver<Eigen_sparse_solver<Eigen::SimplicialLLT<Sparse_matrix>>>(), direct);
  swaps("Eigen_LDLT_solver", with_solver<Eigen_LDLT_solver>(), direct);
#ifdef CGAL_LINKED_WITH_CHOLMOD
  swaps("Cholmod_solver", with_solver<Cholmod_solver>(), direct);
#endif
  swaps("CGAL::Eigen_solver_traits<Eigen::SparseLU>",
        with_solver<Sparse_linear_algebra_adaptor<CGAL_LU>>(), direct);
  swaps("CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT>",
        with_solver<Sparse_linear_algebra_adaptor<CGAL_LDLT>>(), direct);

  // the errors of these are corrections that come an iteration later
  swaps("Multifrontal_cholesky_solver, single precision", with_solver<Single_precision_solver>(),
        1e-6);
  swaps("Eigen_conjugate_gradient_solver", with_solver<Eigen_conjugate_gradient_solver>(), 1e-8);
  for(double tolerance : {1e-8, 1e-4})
  {
    const Eigen_conjugate_gradient_solver solver(
      [tolerance](auto& gradients) { gradients.setTolerance(tolerance); });
    swaps(tolerance == 1e-8 ? "Eigen_conjugate_gradient_solver, tolerance 1e-8"
                            : "Eigen_conjugate_gradient_solver, tolerance 1e-4",
          with_solver(solver), 10 * tolerance);
  }

  swaps("SVD_closest_rotation", with_rotation<SVD_closest_rotation>(), direct);
  swaps("CGAL::Deformation_Eigen_closest_rotation_traits_3",
        with_rotation<Closest_rotation_traits_adaptor<CGAL_svd>>(), direct);
  swaps("CGAL::Deformation_Eigen_polar_closest_rotation_traits_3",
        with_rotation<Closest_rotation_traits_adaptor<CGAL_polar>>(), direct);
  return checks_result();
}
