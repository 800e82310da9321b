#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using CGAL::ARAP::Initial_guess;

// Bends a wavy sheet. One edge stays, and the opposite one goes to the end of an arc of 120
// degrees, turned by some degrees. A run with 0 iterations is a preview.
bool bend(const std::string& name, double degrees, Initial_guess guess, unsigned int iterations)
{
  Mesh mesh;
  const int cells = 40;
  CGAL::make_grid(cells, cells, mesh, [](std::size_t i, std::size_t j) {
    const double x = double(i) / cells, y = double(j) / cells;
    return Point(x, y, 0.02 * std::sin(10 * CGAL_PI * x) * std::sin(10 * CGAL_PI * y));
  }, true);
  const std::vector<Point> rest(mesh.points().begin(), mesh.points().end());

  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  deformation.insert_roi_vertices(mesh.vertices());
  const double angle = degrees * CGAL_PI / 180, c = std::cos(angle), s = std::sin(angle);
  for(Mesh::Vertex_index v : mesh.vertices())
    if(const Point& p = rest[v]; p.x() < 0.04)
      deformation.insert_control_vertex(v);
    else if(p.x() > 0.96)
      deformation.insert_control_vertex(
        v, Point(0.41 + c * (p.x() - 1) - s * p.z(), p.y(), 0.72 + s * (p.x() - 1) + c * p.z()));

  CGAL::ARAP::Options options;
  options.initial_guess = guess;
  options.iterations = iterations;
  const CGAL::ARAP::Outcome chosen = deformation.set_options(options);
  if(!chosen)
  {
    std::cerr << chosen.message << std::endl;
    return false;
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << report.message << std::endl;
    return false;
  }
  const CGAL::ARAP::Quality quality = CGAL::ARAP::quality(mesh, rest);
  std::cout << name << ": energy " << report.final_energy() << ", edge error "
            << quality.edge_length_error << ", change of area " << quality.area_change
            << ", of an angle up to " << quality.largest_angle_change << " degrees, spike "
            << quality.largest_spike << std::endl;
  return true;
}

int main()
{
  for(const double degrees : {120.0, 0.0})
  {
    std::cout << "The edge is moved, and turned by " << degrees << " degrees:" << std::endl;
    if(!bend("  no guess", degrees, Initial_guess::previous, 0) ||
       !bend("  Poisson editing", degrees, Initial_guess::rotations, 0) ||
       !bend("  Laplacian editing", degrees, Initial_guess::laplacian, 0) ||
       !bend("  the minimum", degrees, Initial_guess::automatic, 1000))
      return EXIT_FAILURE;
  }
}
