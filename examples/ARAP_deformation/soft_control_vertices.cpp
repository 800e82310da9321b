#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// maps a point of the flat template to the scanned object, a part of a cylinder
Point scanned(const Point& p)
{
  return Point(2 * std::sin(p.x() / 2), p.y(), 2 - 2 * std::cos(p.x() / 2));
}

// Fits the template to noisy measurements of every fifth vertex. Hard targets (of infinite weight)
// reproduce all the noise; with soft targets the template smooths it.
bool fit(double weight)
{
  Mesh mesh;
  CGAL::make_grid(40, 20, mesh, [](std::size_t i, std::size_t j) {
    return Point(0.1 * i, 0.1 * j, 0);
  }, true);
  const Mesh rest = mesh;

  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  CGAL::Random random(1);
  for(Mesh::Vertex_index v : mesh.vertices())
  {
    deformation.insert_roi_vertex(v);
    if(v.idx() % 5 != 0)
      continue;
    const Point p = scanned(rest.point(v));
    const auto noise = [&random] { return random.get_double(-0.03, 0.03); };
    deformation.insert_control_vertex(v, Point(p.x() + noise(), p.y() + noise(), p.z() + noise()));
  }
  const CGAL::ARAP::Outcome weighted =
    deformation.set_target_weight(deformation.control_vertices(), weight);
  if(!weighted)
  {
    std::cerr << weighted.message << std::endl;
    return false;
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << report.message << std::endl;
    return false;
  }
  double sum = 0;
  for(Mesh::Vertex_index v : mesh.vertices())
    sum += CGAL::squared_distance(mesh.point(v), scanned(rest.point(v)));
  std::cout << "weight " << weight << ": " << report.iterations << " iterations, "
            << std::sqrt(sum / mesh.number_of_vertices()) << " from the object, edge length error "
            << CGAL::ARAP::quality(mesh, rest.points()).edge_length_error << std::endl;
  return true;
}

int main()
{
  for(double weight : {std::numeric_limits<double>::infinity(), 1.0, 0.1, 0.01, 0.001})
    if(!fit(weight))
      return EXIT_FAILURE;
  return EXIT_SUCCESS;
}
