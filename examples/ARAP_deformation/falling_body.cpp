#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Tetrahedron = std::array<int, 4>;

// writes the points as a .mesh file; returns whether that succeeded
bool write(const std::string& name, const std::vector<Point>& points,
           const std::vector<Tetrahedron>& tetrahedra)
{
  std::ofstream file(name);
  file << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << points.size() << '\n';
  for(const Point& p : points)
    file << p << " 0\n";
  file << "Tetrahedra\n" << tetrahedra.size() << '\n';
  for(const Tetrahedron& t : tetrahedra)
    file << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << ' ' << t[3] + 1 << " 0\n";
  file << "End\n";
  return bool(file.flush());
}

// usage: falling_body [PREFIX]    with a prefix, every tenth step is written to PREFIX1.mesh, ...
int main(int argc, char** argv)
{
  // a bar of 24 x 4 x 4 cubes of 5 cm, each cut into six tetrahedra around its diagonal
  const int length = 24, n = 4;
  const double side = 0.05;
  const auto vertex = [=](int x, int y, int z) { return (z * (n + 1) + y) * (length + 1) + x; };
  std::vector<Point> points;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<std::size_t> handles; // in the middle of the bar, which stay where they are
  for(int z = 0; z <= n; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= length; ++x)
      {
        if(std::abs(x - length / 2) <= 1 && 0 < y && y < n && 0 < z && z < n)
          handles.push_back(points.size());
        points.emplace_back(side * x, side * y, side * z);
        if(x == length || y == n || z == n)
          continue;
        std::array<int, 3> path = {0, 1, 2}; // the axes in each order
        do
        {
          std::array<int, 3> corner = {x, y, z};
          Tetrahedron tetrahedron = {vertex(x, y, z)};
          for(int k = 0; k < 3; ++k)
          {
            ++corner[path[k]];
            tetrahedron[k + 1] = vertex(corner[0], corner[1], corner[2]);
          }
          tetrahedra.push_back(tetrahedron);
        }
        while(std::next_permutation(path.begin(), path.end()));
      }

  CGAL::ARAP_deformation deformation(
    CGAL::ARAP::make_tetrahedron_soup_domain(points, tetrahedra));
  for(std::size_t v = 0; v < points.size(); ++v)
    deformation.insert_roi_vertex(v);
  deformation.insert_control_vertices(handles);

  CGAL::ARAP::Dynamics dynamics; // in kilograms, meters, and seconds: soft rubber
  dynamics.time_step = 0.01;
  dynamics.density = 1000;
  dynamics.modulus = 5000;
  dynamics.damping = 0.5;
  dynamics.acceleration = {0, 0, -9.81};
  std::cout << "  time  kinetic  elastic  potential energy [J]  momentum [kg m/s]  lowest [m]\n"
            << std::fixed << std::setprecision(3);
  for(int step = 1; step <= 120; ++step)
  {
    const CGAL::ARAP::Step_report report = deformation.advance(dynamics);
    if(!report)
    {
      std::cerr << "no step: " << report.message << std::endl;
      return EXIT_FAILURE;
    }
    if(step % 10 != 0)
      continue;
    const auto lowest = std::min_element(points.begin(), points.end(), [](auto& p, auto& q) {
      return p.z() < q.z();
    });
    std::cout << std::setw(6) << step * dynamics.time_step << std::setw(9) << report.kinetic_energy
              << std::setw(9) << report.elastic_energy << std::setw(22)
              << -dynamics.acceleration[2] * report.mass * report.center_of_mass[2]
              << std::setw(19) << report.momentum[2] << std::setw(12) << lowest->z() << std::endl;
    if(argc > 1 && !write(argv[1] + std::to_string(step / 10) + ".mesh", points, tetrahedra))
    {
      std::cerr << "a file with the prefix " << argv[1] << " cannot be written" << std::endl;
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
