#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/arap_deform.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using vertex_descriptor = Mesh::Vertex_index;

int main()
{
  // a gutter, half a tube, of length 10 along the z axis
  Mesh mesh;
  const int around = 12, along = 60;
  const double turn = CGAL_PI / around;
  CGAL::make_grid(along, around, mesh, [=](std::size_t i, std::size_t j) {
    return Point(std::cos(turn * j), std::sin(turn * j), 10.0 * i / along);
  }, true);

  // the bottom stays, the top moves to the side and turns by a right angle
  auto constrained = mesh.add_property_map<vertex_descriptor, bool>("v:constrained", false).first;
  auto target = mesh.add_property_map<vertex_descriptor, Point>("v:target").first;
  for(vertex_descriptor v : mesh.vertices())
  {
    const Point& p = mesh.point(v);
    constrained[v] = p.z() < 0.5 || p.z() > 9.5;
    target[v] = p.z() < 0.5 ? p : Point(4 + p.z() - 5, p.y(), 6 - p.x());
  }

  const CGAL::ARAP::Report report = CGAL::arap_deform(mesh, constrained, target);
  if(!report)
  {
    std::cerr << "not deformed: " << report.message << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << report.iterations << " iterations, energy " << report.energy.front() << " -> "
            << report.energy.back() << std::endl;
  return CGAL::IO::write_polygon_mesh("bent_gutter.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}
