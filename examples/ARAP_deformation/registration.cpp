#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/target_sets.h>
#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/point_generators_3.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Deformation = CGAL::ARAP_deformation<Mesh>;

// maps a direction to the scanned object, an ellipsoid with bumps
Point scanned(const Point& d)
{
  const double bumps = 1 + 0.1 * std::sin(5 * d.x()) * std::cos(4 * d.y()) * std::sin(3 * d.z());
  return Point(1.4 * bumps * d.x(), bumps * d.y(), 0.8 * bumps * d.z());
}

// a point of the scan, and the plane that touches the object there
struct Sample
{
  Point point;
  Kernel::Plane_3 plane;
};

std::vector<Sample> scan(std::size_t n)
{
  CGAL::Random random(1);
  CGAL::Random_points_on_sphere_3<Point> direction(1, random);
  std::vector<Sample> samples;
  for(std::size_t k = 0; k < n; ++k, ++direction)
  {
    const auto moved = [d = *direction](double x, double y, double z) {
      const Vector v(d.x() + x, d.y() + y, d.z() + z);
      return scanned(CGAL::ORIGIN + v / std::sqrt(v.squared_length()));
    };
    // two tangents, across the direction
    const Vector d = *direction - CGAL::ORIGIN;
    const Vector s = std::abs(d.x()) < 0.7 ? CGAL::cross_product(d, Vector(1, 0, 0))
                                           : CGAL::cross_product(d, Vector(0, 1, 0));
    const Vector t = CGAL::cross_product(d, s), a = 1e-4 * s, b = 1e-4 * t;
    const Vector normal = CGAL::cross_product(
      moved(a.x(), a.y(), a.z()) - moved(-a.x(), -a.y(), -a.z()),
      moved(b.x(), b.y(), b.z()) - moved(-b.x(), -b.y(), -b.z()));
    samples.push_back({moved(0, 0, 0), Kernel::Plane_3(moved(0, 0, 0), normal)});
  }
  return samples;
}

// Fits a sphere to the scan. In each round the points of the scan pull the points of the mesh that
// are nearest to them then: toward the point of the scan, or only toward its plane.
bool fit(const std::vector<Sample>& samples, bool is_to_planes)
{
  std::cout << (is_to_planes ? "point to plane" : "point to point") << '\n';
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  CGAL::Subdivision_method_3::Loop_subdivision(
    mesh, CGAL::parameters::number_of_iterations(4));
  for(Mesh::Vertex_index v : mesh.vertices())
  {
    const Vector d = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = CGAL::ORIGIN + d / std::sqrt(d.squared_length());
  }

  Deformation deformation(mesh);
  deformation.insert_roi_vertices(mesh.vertices());
  CGAL::ARAP::Options options;
  options.minimizer = CGAL::ARAP::Minimizer::quasi_newton;
  const CGAL::ARAP::Outcome chosen = deformation.set_options(options);
  if(!chosen)
  {
    std::cerr << chosen.message << std::endl;
    return false;
  }
  for(int round = 0;; ++round)
  {
    const CGAL::ARAP::Locator<Deformation::Deformation_domain> locator(deformation.domain());
    deformation.clear_control_points();
    double sum = 0;
    for(const Sample& sample : samples)
    {
      const auto nearest = locator.locate(sample.point);
      if(!nearest)
      {
        std::cerr << "no face of the mesh has an area" << std::endl;
        return false;
      }
      sum += nearest->distance * nearest->distance;
      const auto inserted = deformation.insert_control_point(*nearest);
      CGAL::ARAP::Outcome outcome = inserted;
      if(outcome)
        outcome = deformation.set_target_weight(inserted.point, 20);
      if(outcome)
        outcome = is_to_planes
                    ? deformation.set_target_set(inserted.point,
                                                 CGAL::ARAP::projection_onto(sample.plane))
                    : deformation.set_target_position(inserted.point, sample.point);
      if(!outcome)
      {
        std::cerr << outcome.message << std::endl;
        return false;
      }
    }
    std::cout << "  round " << round << ": RMS distance "
              << std::sqrt(sum / static_cast<double>(samples.size()));
    if(round == 6)
      break;
    const CGAL::ARAP::Report report = deformation.deform(20, 0);
    if(!report)
    {
      std::cerr << report.message << std::endl;
      return false;
    }
    std::cout << (report.stages.order ? ", an order and" : ",")
              << (report.stages.factor ? " one factorization" : " no factorization") << '\n';
  }
  std::cout << std::endl;
  return true;
}

int main()
{
  const std::vector<Sample> samples = scan(500);
  return fit(samples, false) && fit(samples, true) ? EXIT_SUCCESS : EXIT_FAILURE;
}
