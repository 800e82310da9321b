#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Polyhedron_3<Kernel>;
using Deformation = CGAL::ARAP_deformation<Mesh>;
using vertex_descriptor = boost::graph_traits<Mesh>::vertex_descriptor;

int main()
{
  // a sheet, one end of which is lifted, and moved toward the other
  Mesh mesh;
  CGAL::make_grid(40, 20, mesh, [](std::size_t i, std::size_t j) {
    return Point(i / 20.0, j / 20.0, 0.02 * std::sin(double(i + j)));
  }, true);

  Deformation deformation(mesh);
  for(vertex_descriptor v : vertices(mesh))
  {
    const double x = v->point().x();
    if(x > 0.05) deformation.insert_roi_vertex(v);
    if(x < 1.95) continue;
    deformation.insert_control_vertex(v);
    deformation.translate(v, Kernel::Vector_3(-1, 0, 0.8));
  }

  // stop when an iteration lowers the energy by less than one percent
  double last = 0;
  const CGAL::ARAP::Report report = deformation.deform(1000, 0, [&](const auto& iterate) {
    const double energy = iterate.energy();
    std::cout << "iteration " << iterate.iteration() << ": energy " << energy << std::endl;
    const bool is_slow = iterate.iteration() > 0 && last - energy < 0.01 * energy;
    last = energy;
    return is_slow ? CGAL::ARAP::Visitor_action::stop : CGAL::ARAP::Visitor_action::proceed;
  });
  std::cout << report.message << std::endl;

  // check the guarantees: the energy never rises, and the results are rotations
  if(!report || CGAL::ARAP::first_rise_of_energy(report) != 0)
    return EXIT_FAILURE;
  for(vertex_descriptor v : vertices(mesh))
    if(!CGAL::ARAP::is_rotation(deformation.rotation(v)))
      return EXIT_FAILURE;
  return EXIT_SUCCESS;
}
