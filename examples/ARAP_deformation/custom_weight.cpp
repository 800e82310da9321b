#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using CGAL::ARAP::Cell_scheme;

// Weights that grow as edges get shorter, with an exponent chosen at run time.
class Inverse_length_weight
{
public:
  explicit Inverse_length_weight(double power = 1) : m_power(power) {}

  // the weights of the edges (0,1), (0,2), (1,2)
  std::array<double, 3>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& p) const
  {
    return {weight(p[0], p[1]), weight(p[0], p[2]), weight(p[1], p[2])};
  }

  // the weight of the edge between two vertices, given by their indices, from the sum over the
  // triangles of its edge set
  double edge_weight(CGAL::ARAP::Edge_set, std::size_t, std::size_t, double sum) const
  {
    return sum;
  }

private:
  double weight(const CGAL::ARAP::Coordinates& p, const CGAL::ARAP::Coordinates& q) const
  {
    return std::pow(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), -m_power);
  }

  double m_power;
};

template <typename Traits>
bool bend(const char* name, const Traits& traits, Cell_scheme cells)
{
  Mesh mesh;
  CGAL::make_grid(30, 10, mesh, [](std::size_t i, std::size_t j) {
    return Point(0.1 * i, 0.1 * j, 0.05 * std::sin(0.7 * i) * std::cos(0.9 * j));
  }, true);
  const Mesh rest = mesh;

  CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh, traits);
  CGAL::ARAP::Options options;
  options.cells = cells; // at run time
  if(const CGAL::ARAP::Outcome set = deformation.set_options(options); !set)
  {
    std::cerr << name << ": " << set.message << std::endl;
    return false;
  }
  for(Mesh::Vertex_index v : mesh.vertices())
  {
    if(rest.point(v).x() > 0.15) deformation.insert_roi_vertex(v);
    if(rest.point(v).x() < 2.85) continue;
    deformation.insert_control_vertex(v);
    deformation.translate(v, Kernel::Vector_3(-1, 0, 1.5));
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << name << ": " << report.message << std::endl;
    return false;
  }
  std::cout << name << ": " << report.iterations << " iterations, edge length error "
            << CGAL::ARAP::quality(mesh, rest.points()).edge_length_error << std::endl;
  return true;
}

int main()
{
  using Own_traits = CGAL::ARAP_deformation_traits<CGAL::Default, Inverse_length_weight>;
  const CGAL::ARAP_deformation_traits<> default_traits;
  const Own_traits own_traits({}, Inverse_length_weight(0.5));
  const bool done =
    bend("cotangents, spokes and rims", default_traits, Cell_scheme::spokes_and_rims()) &&
    bend("cotangents, spokes", default_traits, Cell_scheme::spokes()) &&
    bend("inverse lengths, spokes", own_traits, Cell_scheme::spokes());
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
