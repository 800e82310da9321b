#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cstddef>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// Lifts a sheet by a handle inside one of its faces, which a user has picked by a point.
int main()
{
  Mesh mesh;
  CGAL::make_grid(20, 10, mesh, [](std::size_t i, std::size_t j) {
    return Point(0.1 * i, 0.1 * j, 0);
  }, true);

  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  deformation.insert_roi_vertices(mesh.vertices());
  for(Mesh::Vertex_index v : mesh.vertices()) // one side stays
    if(mesh.point(v).x() == 0)
      deformation.insert_control_vertex(v);

  const auto location = CGAL::ARAP::locate(mesh, Point(1.73, 0.52, 0.01));
  if(!location)
  {
    std::cerr << "no face of the sheet has an area" << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "the nearest point is in face " << location->simplex << ", at a distance of "
            << location->distance << std::endl;
  const auto handle = deformation.insert_control_point(*location);
  if(!handle)
  {
    std::cerr << handle.message << std::endl;
    return EXIT_FAILURE;
  }
  for(int frame = 0; frame < 3; ++frame)
  {
    deformation.translate(handle.point, Kernel::Vector_3(0, 0, 0.2));
    const CGAL::ARAP::Report report = deformation.deform();
    if(!report)
    {
      std::cerr << report.message << std::endl;
      return EXIT_FAILURE;
    }
    std::cout << report.iterations << " iterations, energy " << report.final_energy()
              << ", the handle is at " << deformation.control_point_position(handle.point)
              << std::endl;
  }
  // a soft one need not reach its target
  CGAL::ARAP::Outcome outcome = deformation.set_target_weight(handle.point, 0.1);
  if(outcome)
    outcome = deformation.deform();
  if(!outcome)
  {
    std::cerr << outcome.message << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "with weight 0.1 it is at " << deformation.control_point_position(handle.point)
            << std::endl;
  return EXIT_SUCCESS;
}
