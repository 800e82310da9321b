#include <CGAL/ARAP_deformation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Cell_scheme;

double length(const Mesh& mesh, Vertex v, Vertex w)
{
  return std::sqrt(CGAL::squared_distance(mesh.point(v), mesh.point(w)));
}

// Bends a tube by a right angle. Cells in its middle have a stiffness, or share one rotation.
bool bend(const std::string& name, Cell_scheme cells, double stiffness, bool is_group)
{
  // a tube along the z axis: a grid whose first and last columns are the same
  const std::size_t around = 16, along = 60;
  Mesh mesh;
  for(std::size_t k = 0; k <= along; ++k)
    for(std::size_t i = 0; i < around; ++i)
    {
      const double angle = 2 * CGAL_PI * double(i) / around;
      mesh.add_vertex(Point(std::cos(angle), std::sin(angle), 15 * double(k) / along));
    }
  for(std::size_t k = 0; k < along; ++k)
    for(std::size_t i = 0; i < around; ++i)
    {
      const std::size_t next = (i + 1) % around, row = around * k, above = row + around;
      const Vertex a(row + i), b(row + next), c(above + next), d(above + i);
      mesh.add_face(a, b, c);
      mesh.add_face(a, c, d);
    }
  const Mesh rest = mesh;
  const auto is_middle = [&rest](Vertex v) { return std::abs(rest.point(v).z() - 7.5) < 2; };

  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  CGAL::ARAP::Options options;
  options.cells = cells;
  CGAL::ARAP::Outcome outcome = deformation.set_options(options);
  deformation.insert_roi_vertices(mesh.vertices());
  for(Vertex v : mesh.vertices())
    if(const Point p = mesh.point(v); p.z() < 1)
      deformation.insert_control_vertex(v);
    else if(p.z() > 14)
      deformation.insert_control_vertex(v, Point(p.z() - 7.5, p.y(), 10 - p.x()));
  if(outcome)
    outcome = deformation.set_stiffness([=](Vertex v) { return is_middle(v) ? stiffness : 1.0; });
  if(outcome && is_group)
    outcome = deformation.set_groups([=](Vertex v) { return is_middle(v) ? 0 : -1; });
  if(!outcome)
  {
    std::cerr << outcome.message << std::endl;
    return false;
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << report.message << std::endl;
    return false;
  }
  double error[2] = {0, 0}, sum[2] = {0, 0}; // of squares, elsewhere and in the middle
  for(Mesh::Edge_index e : mesh.edges())
  {
    const Vertex v = mesh.vertex(e, 0), w = mesh.vertex(e, 1);
    const double before = length(rest, v, w), change = length(mesh, v, w) - before;
    const int part = is_middle(v) && is_middle(w) ? 1 : 0;
    error[part] += change * change;
    sum[part] += before * before;
  }
  std::cout << name << ": energy " << report.final_energy() << ", edge error in the middle "
            << std::sqrt(error[1] / sum[1]) << ", elsewhere " << std::sqrt(error[0] / sum[0])
            << std::endl;
  return true;
}

int main()
{
  const Cell_scheme spokes = Cell_scheme::spokes();
  return bend("all alike", spokes, 1, false) && bend("stiff middle", spokes, 10, false) &&
         bend("very stiff middle", spokes, 1000, false) &&
         bend("middle as one group", spokes, 1, true) &&
         bend("1-ring cells", Cell_scheme::k_ring(1), 1, false) &&
         bend("3-ring cells", Cell_scheme::k_ring(3), 1, false) ? EXIT_SUCCESS : EXIT_FAILURE;
}
