#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/arap_deform.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <map>

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

  // the top moves to the side and turns by a right angle, as its cells do; the bottom stays
  const Eigen::Quaterniond right_angle(Eigen::AngleAxisd(CGAL_PI / 2, Eigen::Vector3d::UnitY()));
  std::map<vertex_descriptor, Point> targets;
  std::map<vertex_descriptor, Eigen::Quaterniond> rotations;
  for(vertex_descriptor v : mesh.vertices())
    if(const Point& p = mesh.point(v); p.z() > 9.5)
    {
      targets[v] = Point(4 + p.z() - 5, p.y(), 6 - p.x());
      rotations.emplace(v, right_angle);
    }
  const auto is_bottom = [&mesh](vertex_descriptor v) { return mesh.point(v).z() < 0.5; };

  // the cells of the middle keep their shape, and leave the bending to the others
  const auto stiffness = [&mesh](vertex_descriptor v) {
    return std::abs(mesh.point(v).z() - 5) < 1 ? 100.0 : 1.0;
  };

  namespace params = CGAL::parameters;
  const CGAL::ARAP::Report report = CGAL::arap_deform(
    mesh, targets, params::target_rotations(rotations, params::cell_stiffness(stiffness))
                     .vertex_is_constrained_map(is_bottom));
  if(!report)
  {
    std::cerr << "not deformed: " << report.message << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << report.iterations << " iterations, energy " << report.energy.front() << " -> "
            << report.final_energy() << std::endl;
  if(!CGAL::IO::write_polygon_mesh("bent_gutter.off", mesh))
  {
    std::cerr << "bent_gutter.off cannot be written" << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
