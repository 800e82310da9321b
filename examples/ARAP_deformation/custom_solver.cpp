#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Sparse_linear_algebra_adaptor.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Sparse_matrix;

// A custom solver: the factorization L L^T of a band matrix. Each row of L is stored from the
// diagonal back to the end of the band.
class Band_solver
{
public:
  bool analyze(const Sparse_matrix& a)
  {
    m_width = 0;
    for(int column = 0; column < a.cols(); ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry) // the lower triangle
        m_width = (std::max)(m_width, static_cast<int>(entry.row()) - column);
    return true;
  }

  bool factorize(const Sparse_matrix& a)
  {
    m_factor.assign(a.rows() * (m_width + 1), 0);
    for(int column = 0; column < a.cols(); ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
        at(static_cast<int>(entry.row()), column) = entry.value();
    for(int i = 0; i < a.rows(); ++i)
      for(int j = first(i); j <= i; ++j)
      {
        double& value = at(i, j);
        for(int k = (std::max)(first(i), first(j)); k < j; ++k)
          value -= at(i, k) * at(j, k);
        if(i == j && !(value > 0))
          return false; // not positive definite
        value = i == j ? std::sqrt(value) : value / at(j, j);
      }
    return true;
  }

  bool solve(std::size_t n, Coordinates* x)
  {
    for(int c = 0; c < 3; ++c)
    {
      for(int i = 0; i < static_cast<int>(n); ++i)
      {
        for(int k = first(i); k < i; ++k)
          x[i][c] -= at(i, k) * x[k][c];
        x[i][c] /= at(i, i);
      }
      for(int i = static_cast<int>(n) - 1; i >= 0; --i)
      {
        x[i][c] /= at(i, i);
        for(int k = first(i); k < i; ++k)
          x[k][c] -= at(i, k) * x[i][c];
      }
    }
    return true;
  }

private:
  int first(int row) const { return (std::max)(row - m_width, 0); }
  double& at(int row, int column) { return m_factor[row * (m_width + 1) + row - column]; }

  int m_width = 0;
  std::vector<double> m_factor;
};

template <typename Solver>
bool bend(const char* name, const Solver& solver = Solver())
{
  const std::vector<std::string> violations = CGAL::ARAP::check_sparse_solver(solver);
  for(const std::string& violation : violations)
    std::cerr << name << ": " << violation << std::endl;
  if(!violations.empty())
    return false;

  Mesh mesh;
  CGAL::make_grid(20, 6, mesh, [](std::size_t i, std::size_t j) {
    return Point(0.1 * i, 0.1 * j, 0.05 * std::sin(0.7 * i) * std::cos(0.9 * j));
  }, true);
  const Mesh rest = mesh;

  using Traits = CGAL::ARAP_deformation_traits<Solver>; // all else by default
  CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh, Traits(solver));
  for(Mesh::Vertex_index v : mesh.vertices())
  {
    if(rest.point(v).x() > 0.15) deformation.insert_roi_vertex(v);
    if(rest.point(v).x() < 1.85) continue;
    deformation.insert_control_vertex(v);
    deformation.translate(v, Kernel::Vector_3(-0.6, 0, 1));
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << name << ": " << report.message << std::endl;
    return false;
  }
  std::cout << name << ": " << report.iterations << " iterations, energy " << report.final_energy()
            << std::endl;
  return true;
}

int main()
{
  // one of CGAL's own solvers
  using LU = Eigen::SparseLU<CGAL::Eigen_sparse_matrix<double>::EigenType>;
  using CGAL_solver = CGAL::ARAP::Sparse_linear_algebra_adaptor<CGAL::Eigen_solver_traits<LU>>;

  // an iterative solver, with a tolerance
  using Gradients = CGAL::ARAP::Eigen_conjugate_gradient_solver;
  const Gradients gradients([](Gradients::Eigen_solver& s) { s.setTolerance(1e-10); });

  const bool done = bend<CGAL::ARAP::Multifrontal_cholesky_solver>("the default") &&
                    bend<CGAL_solver>("CGAL's Eigen_solver_traits") &&
                    bend("conjugate gradients", gradients) &&
                    bend<Band_solver>("a custom solver");
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
