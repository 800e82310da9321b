#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Embedding.h>
#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::size_t, 3>;
using Mesh = CGAL::Surface_mesh<Point>;
using Mesh_domain = CGAL::Polyhedral_mesh_domain_3<Mesh, Kernel>;
using Mesh_triangulation = CGAL::Mesh_triangulation_3<Mesh_domain>::type;
using Mesh_criteria = CGAL::Mesh_criteria_3<Mesh_triangulation>;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Mesh_triangulation>;

// A surface as modeling tools leave it: open rings, some of which overlap the next one while
// others do not reach it, and two duplicated sheets that intersect the rings and each other.
void make_unclean_surface(std::vector<Point>& points, std::vector<Triangle>& faces)
{
  const auto add_strip = [&](int n, const auto& one_side, const auto& other_side) {
    for(int k = 0; k <= n; ++k)
    {
      points.push_back(one_side(k));
      points.push_back(other_side(k));
      const std::size_t end = points.size();
      if(k > 0)
        faces.insert(faces.end(), {{end - 4, end - 3, end - 2}, {end - 2, end - 3, end - 1}});
    }
  };
  for(int ring = 0; ring < 10; ++ring)
  {
    const double radius = 0.9 + 0.2 * (ring % 2), length = ring % 3 == 0 ? 0.9 : 1.1;
    const auto around = [=](int k, double z) {
      return Point(radius * std::cos(k * CGAL_PI / 12), radius * std::sin(k * CGAL_PI / 12), z);
    };
    add_strip(24, [=](int k) { return around(k, ring); },
              [=](int k) { return around(k, ring + length); });
  }
  for(int twice = 0; twice < 2; ++twice)
  {
    add_strip(40, [](int k) { return Point(-1.5, 0, k / 4.0); },
              [](int k) { return Point(1.5, 0, k / 4.0); });
    add_strip(40, [](int k) { return Point(0, -1.5, k / 4.0); },
              [](int k) { return Point(0, 1.5, k / 4.0); });
  }
}

int main()
{
  std::vector<Point> points;
  std::vector<Triangle> faces;
  make_unclean_surface(points, faces);

  // a coarse volume around it: what a ball of radius 1 cannot enter, plus an offset of 0.25
  Mesh wrap;
  CGAL::alpha_wrap_3(points, faces, 1.0, 0.25, wrap);
  const Mesh_domain mesh_domain(wrap);
  const Mesh_criteria criteria(Mesh_criteria::Facet_criteria(25, 0.8, 0.1),
                               Mesh_criteria::Cell_criteria(3, 0.8));
  Complex complex = CGAL::make_mesh_3<Complex>(mesh_domain, criteria);
  auto domain = CGAL::ARAP::make_complex_domain(complex);
  std::cout << faces.size() << " triangles in " << complex.number_of_cells() << " tetrahedra"
            << std::endl;

  // bind the surface to the volume, both in their rest shapes
  const CGAL::ARAP::Embedding embedding(domain, points);
  std::cout << embedding.outcome().message << std::endl;
  if(!embedding.outcome())
    return EXIT_FAILURE;
  std::size_t outside = 0;
  double farthest = 0;
  for(std::size_t k = 0; k < embedding.size(); ++k)
  {
    outside += embedding.distance(k) > 0;
    if(!(embedding.distance(k) <= 0.25)) // which is false of what is not a number
    {
      std::cerr << "point " << k << " is too far outside: " << embedding.distance(k) << std::endl;
      return EXIT_FAILURE;
    }
    farthest = (std::max)(farthest, embedding.distance(k));
  }
  std::cout << outside << " of " << embedding.size() << " points are outside, by at most "
            << farthest << std::endl;

  // the bottom of the volume stays, the top turns to the side by a right angle
  CGAL::ARAP_deformation<decltype(domain)> deformation(domain);
  for(auto v : domain.vertices())
  {
    const Point p = domain.point(v);
    deformation.insert_roi_vertex(v);
    if(p.z() > 1 && p.z() < 9)
      continue;
    deformation.insert_control_vertex(v);
    if(p.z() >= 9)
      deformation.set_target_position(v, Point(p.z() - 3, p.y(), 6 - p.x()));
  }
  const CGAL::ARAP::Report report = deformation.deform();
  if(!report)
  {
    std::cerr << "not deformed: " << report.message << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << report.iterations << " iterations, energy " << report.energy.front() << " -> "
            << report.final_energy() << std::endl;

  // the surface follows
  const std::vector<Point> rest = points;
  embedding.put_points(points);
  double sum_of_errors = 0, sum_of_lengths = 0;
  for(const auto& face : faces)
    for(int k = 0; k < 3; ++k)
    {
      const std::size_t a = face[k], b = face[(k + 1) % 3];
      const double length = std::sqrt(CGAL::squared_distance(rest[a], rest[b]));
      const double error = std::sqrt(CGAL::squared_distance(points[a], points[b])) - length;
      sum_of_errors += error * error;
      sum_of_lengths += length * length;
    }
  std::cout << "edge length error of the surface: " << std::sqrt(sum_of_errors / sum_of_lengths)
            << std::endl;

  std::ofstream out("embedded_surface.off");
  if(!CGAL::IO::write_OFF(out, points, faces) || !out.flush())
  {
    std::cerr << "embedded_surface.off cannot be written" << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
