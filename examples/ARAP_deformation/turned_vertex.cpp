#include <CGAL/ARAP_deformation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Deformation = CGAL::ARAP_deformation<Mesh>;

// Bends a strip that is held at one end. Near the other end all vertices within a radius of
// (9.5, 0, 0) are turned upright about this point, which goes to (6, 0, 5). With radius 0 this is
// one vertex.
bool bend(const std::string& name, double radius, bool has_frames)
{
  Mesh mesh;
  CGAL::make_grid(80, 8, mesh, [](std::size_t i, std::size_t j) {
    return Point(0.125 * double(i), 0.125 * double(j) - 0.5, 0);
  }, true);
  const Eigen::Vector3d from(9.5, 0, 0), to(6, 0, 5);
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(-CGAL_PI / 2, Eigen::Vector3d::UnitY()));

  Deformation deformation(mesh);
  std::vector<Mesh::Vertex_index> handle, far_end;
  for(Mesh::Vertex_index v : mesh.vertices())
  {
    const Point& p = mesh.point(v);
    deformation.insert_roi_vertex(v);
    if(p.x() < 0.3)
      deformation.insert_control_vertex(v);
    else if(std::hypot(p.x() - from.x(), p.y() - from.y()) <= radius)
      handle.push_back(v);
    if(p.x() == 10)
      far_end.push_back(v);
  }
  for(Mesh::Vertex_index v : handle)
  {
    const Point& p = mesh.point(v);
    const Eigen::Vector3d q = to + rotation * (Eigen::Vector3d(p.x(), p.y(), p.z()) - from);
    deformation.insert_control_vertex(v, Point(q.x(), q.y(), q.z()));
  }
  if(has_frames)
  {
    const CGAL::ARAP::Outcome turned =
      handle.size() == 1 ? deformation.set_target_rotation(handle.front(), rotation)
                         : deformation.set_target_rotations(handle); // of its motion
    if(!turned)
    {
      std::cerr << turned.message << std::endl;
      return false;
    }
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << report.message << std::endl;
    return false;
  }
  std::cout << name << ": " << report.iterations << " iterations, energy "
            << report.final_energy() << ", the end is at " << mesh.point(far_end[4]) << std::endl;
  return true;
}

int main()
{
  return bend("one vertex, only moved", 0, false) && bend("one vertex, turned", 0, true) &&
         bend("a set of vertices", 0.4, false) && bend("a set, as frames", 0.4, true)
           ? EXIT_SUCCESS : EXIT_FAILURE;
}
