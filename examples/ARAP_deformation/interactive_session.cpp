#include <CGAL/ARAP_deformation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using vertex_descriptor = Mesh::Vertex_index;

int main(int argc, char** argv)
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/elephant.off");
  Mesh mesh;
  if(!CGAL::IO::read_polygon_mesh(file, mesh) || mesh.is_empty())
  {
    std::cerr << file << " cannot be read as a surface" << std::endl;
    return EXIT_FAILURE;
  }

  // the vertices above the middle may move, those near the top are the handle, all others are fixed
  std::vector<double> heights;
  for(const Point& p : mesh.points())
    heights.push_back(p.y());
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double middle = (*lowest + *highest) / 2, top = *highest - 0.1 * (*highest - *lowest);

  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  for(vertex_descriptor v : mesh.vertices())
  {
    if(heights[v] > middle) deformation.insert_roi_vertex(v);
    if(heights[v] > top) deformation.insert_control_vertex(v);
  }
  const CGAL::ARAP::Outcome ready = deformation.preprocess(); // the costly part, once
  if(!ready)
  {
    std::cerr << ready.message << std::endl;
    return EXIT_FAILURE;
  }

  // drag and turn the handle a little in each frame; a few iterations per frame are enough
  const std::vector<vertex_descriptor> handle = deformation.control_vertices();
  if(handle.empty())
  {
    std::cerr << file << " is flat: it has no vertex above its middle" << std::endl;
    return EXIT_FAILURE;
  }
  Point pivot = mesh.point(handle.front());
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()));
  const Kernel::Vector_3 step(0, 0.01 * (*highest - *lowest), 0);
  std::vector<CGAL::ARAP_deformation<Mesh>::State> history; // what undo returns to
  history.push_back(deformation.state()); // once for the drag: a state copies the region
  for(int frame = 1; frame <= 10; ++frame)
  {
    deformation.rotate(handle, Eigen::Vector3d(pivot.x(), pivot.y(), pivot.z()), turn);
    deformation.translate(handle, step);
    pivot = pivot + step;
    const CGAL::ARAP::Report report = deformation.deform(3, 0);
    if(!report)
    {
      std::cerr << report.message << std::endl;
      return EXIT_FAILURE;
    }
    std::cout << "frame " << frame << ": energy " << report.final_energy() << ", "
              << 1000 * report.seconds.total << " ms" << std::endl;
  }

  // the drag has ended: on to the minimum
  const CGAL::ARAP::Report end = deformation.deform();
  if(!end)
  {
    std::cerr << end.message << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "the minimum: energy " << end.final_energy() << ", "
            << 1000 * end.seconds.total << " ms" << std::endl;

  // undo; deformation.reset() would return to the rest shape
  const CGAL::ARAP::Outcome undone = deformation.restore(history.back());
  if(!undone)
  {
    std::cerr << undone.message << std::endl;
    return EXIT_FAILURE;
  }
  history.pop_back();
  std::cout << "after undo: the handle is at " << mesh.point(handle.front()) << std::endl;
  return EXIT_SUCCESS;
}
