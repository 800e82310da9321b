#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Tetrahedron = std::array<int, 4>;

int main()
{
  // a bar of 4 x 4 x 30 cubes, each cut into six tetrahedra around its diagonal
  const int n = 4, length = 30;
  const auto vertex = [=](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };
  std::vector<Point> points;
  std::vector<Tetrahedron> tetrahedra;
  for(int z = 0; z <= length; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= n; ++x)
      {
        points.emplace_back(x - 2, y - 2, z);
        if(x == n || y == n || z == length)
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
  std::vector<std::size_t> top;
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    if(points[v].z() > 0) // the bottom is fixed
      deformation.insert_roi_vertex(v);
    if(points[v].z() == length)
      top.push_back(v);
  }
  deformation.insert_control_vertices(top.begin(), top.end());

  // In small steps, so that the bar twists and bends in the intended direction.
  CGAL::ARAP::Report report;
  for(int step = 0; step < 9; ++step)
  {
    const Eigen::Vector3d axis(0.3, 0, 1), center(0, -8, 15);
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(CGAL_PI / 18, axis.normalized()));
    deformation.rotate(top, center, rotation);
    report = deformation.deform();
    if(!report)
    {
      std::cerr << "not deformed: " << report.message << std::endl;
      return EXIT_FAILURE;
    }
    std::cout << "step " << step << ": " << report.iterations << " iterations, energy "
              << report.energy.front() << " -> " << report.final_energy() << ", "
              << report.inverted_simplices << " of " << report.simplices
              << " tetrahedra are inverted" << std::endl;
  }
  return EXIT_SUCCESS;
}
