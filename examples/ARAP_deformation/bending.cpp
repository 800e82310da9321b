#include <CGAL/ARAP_deformation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <map>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// Pulls one vertex, the middle of a unit square of n x n squares of two triangles each, whose
// border stays, and prints the heights along a line from it. Without bending the vertex stands
// alone: the finer the mesh, the thinner the spike. With it the shape is nearly the same on all
// meshes.
bool pull(int n, double bending_length)
{
  Mesh mesh;
  CGAL::make_grid(n, n, mesh, [n](std::size_t i, std::size_t j) {
    return Point(double(i) / n, double(j) / n, 0);
  }, true);
  std::map<int, Mesh::Vertex_index> line; // by the distance from the middle, in edges
  for(Mesh::Vertex_index v : mesh.vertices())
    if(const Point& p = mesh.point(v); p.x() >= 0.5 && p.y() == 0.5)
      line[int(std::lround((p.x() - 0.5) * n))] = v;

  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  CGAL::ARAP::Options options;
  options.bending_length = bending_length; // in the unit of the points
  const CGAL::ARAP::Outcome outcome = deformation.set_options(options);
  if(!outcome)
  {
    std::cerr << outcome.message << std::endl;
    return false;
  }
  deformation.insert_roi_vertices(mesh.vertices());
  for(Mesh::Vertex_index v : mesh.vertices())
    if(mesh.is_border(v))
      deformation.insert_control_vertex(v);
  deformation.insert_control_vertex(line[0], Point(0.5, 0.5, 0.2));
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << report.message << std::endl;
    return false;
  }
  std::cout << n << " x " << n << " squares, bending length " << bending_length << ": "
            << report.iterations << " iterations, energy " << report.final_energy() << ", heights";
  for(int distance : {0, 1, 2, 4, 6}) // in twentieths
    std::cout << ' ' << mesh.point(line[distance * n / 20]).z();
  std::cout << std::endl;
  return true;
}

int main()
{
  for(double bending_length : {0.0, 0.1})
    for(int n : {20, 40, 80})
      if(!pull(n, bending_length))
        return EXIT_FAILURE;
  return EXIT_SUCCESS;
}
