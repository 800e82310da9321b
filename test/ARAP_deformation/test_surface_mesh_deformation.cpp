// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

// CGAL::ARAP::Surface_mesh_deformation against CGAL::Surface_mesh_deformation.
// usage: test_surface_mesh_deformation [FIRST_SEED]

// script/test --all compiles this file with CGAL's header before ours as well
#ifdef CGAL_ARAP_TEST_CGAL_FIRST
#include <CGAL/Surface_mesh_deformation.h>
#endif
#include <CGAL/ARAP_deformation/Surface_mesh_deformation.h>
#include <CGAL/Surface_mesh_deformation.h>

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>

#include <CGAL/assertions_behaviour.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/number_utils.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>

#include <boost/property_map/function_property_map.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef CGAL_ARAP_TEST_ALL // dear to compile
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#endif

// CGAL::ARAP::Surface_mesh_deformation against CGAL::Surface_mesh_deformation, side by side on
// copies of one mesh: random sequences of all their functions, and after each deform() the same
// points.
//
// Kept out, as CGAL's class has no defined result there: covariances of rank one, whose closest
// rotation is not unique; systems with a part that nothing holds, which LU may factorize; and an
// empty region of interest, where a precondition of its matrix fails.
namespace side_by_side {

using CGAL::Default;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Polyhedron_with_ids = CGAL::Polyhedron_3<Kernel, CGAL::Polyhedron_items_with_id_3>;
using Tag = CGAL::Deformation_algorithm_tag;

constexpr double bound = 1e-8; // of the diagonal of the bounding box

std::mt19937 generator;

double uniform(double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(generator);
}

std::size_t below(std::size_t n)
{
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(generator);
}

Eigen::Vector3d random_vector(double size)
{
  return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
}

// A point with no more than what CGAL's class asks for, and a map to points outside the mesh
struct Bare_point
{
  Bare_point() = default;
  Bare_point(double x, double y, double z) : coordinates{x, y, z} {}
  double operator[](int i) const { return coordinates[i]; }
  double coordinates[3];
};

struct Bare_point_map
{
  using key_type = Mesh::Vertex_index;
  using value_type = Bare_point;
  using reference = const Bare_point&;
  using category = boost::read_write_property_map_tag;
  std::vector<Bare_point>* points;
  friend const Bare_point& get(const Bare_point_map& map, key_type v) { return (*map.points)[v]; }
  friend void put(const Bare_point_map& map, key_type v, const Bare_point& p)
  {
    (*map.points)[v] = p;
  }
};

// a weight for each halfedge, different from that of its opposite, and a function of the shape
struct Halfedge_weight
{
  template <typename VertexPointMap>
  double operator()(Mesh::Halfedge_index h, Mesh& mesh, VertexPointMap points) const
  {
    const double length = std::sqrt(CGAL::squared_distance(get(points, mesh.source(h)),
                                                           get(points, mesh.target(h))));
    return factor * (1 + (7919u * (std::size_t(h) + 1)) % 101 / 25.0) / length;
  }
  double factor = 1;
};

// How an object is made for a mesh, and where its points are.
struct Own_points
{
  template <typename Deformation, typename TriangleMesh>
  std::unique_ptr<Deformation> make(TriangleMesh& mesh)
  {
    return std::make_unique<Deformation>(mesh);
  }

  template <typename TriangleMesh, typename Vertex>
  Eigen::Vector3d point(const TriangleMesh& mesh, Vertex v) const
  {
    return vector(get(CGAL::vertex_point, mesh, v));
  }

  template <typename TriangleMesh, typename Vertex>
  void set_point(TriangleMesh& mesh, Vertex v, const Eigen::Vector3d& p) const
  {
    put(CGAL::vertex_point, mesh, v, Point(p.x(), p.y(), p.z()));
  }
};

struct Other_points
{
  std::vector<Bare_point> points;

  template <typename Deformation>
  std::unique_ptr<Deformation> make(Mesh& mesh)
  {
    for(auto v : mesh.vertices())
      points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
    return std::make_unique<Deformation>(mesh, get(boost::vertex_index, mesh),
                                         get(boost::halfedge_index, mesh),
                                         Bare_point_map{&points}, Halfedge_weight{0.3});
  }

  Eigen::Vector3d point(const Mesh&, Mesh::Vertex_index v) const
  {
    return {points[v][0], points[v][1], points[v][2]};
  }
};

// with smoothed rotations
struct Smoothed : Own_points
{
  inline static double alpha = 1;

  template <typename Deformation, typename TriangleMesh>
  std::unique_ptr<Deformation> make(TriangleMesh& mesh)
  {
    auto deformation = Own_points::make<Deformation>(mesh);
    deformation->set_sre_arap_alpha(alpha);
    return deformation;
  }
};

void set_ids(Mesh&) {}
void set_ids(Polyhedron&) {}
void set_ids(Polyhedron_with_ids& mesh) { CGAL::set_halfedgeds_items_id(mesh); }

// one of the two objects, with its own mesh; vertices are named by their places in the shape
template <typename Deformation, typename Setup>
class Side
{
public:
  explicit Side(const Shape& shape)
    : m_mesh(make_mesh<typename Deformation::Triangle_mesh>(shape)),
      m_vertices(::all_vertices(m_mesh))
  {
    set_ids(m_mesh);
    m_deformation = m_setup.template make<Deformation>(m_mesh);
    for(std::size_t k = 0; k < m_vertices.size(); ++k)
      m_places.emplace_back(m_vertices[k], k);
    std::sort(m_places.begin(), m_places.end());
  }

  Deformation* operator->() { return m_deformation.get(); }
  auto vertex(std::size_t k) const { return m_vertices[k]; }
  Eigen::Vector3d point(std::size_t k) const { return m_setup.point(m_mesh, m_vertices[k]); }

  // moves a point of the mesh, without the object
  void set_point(std::size_t k, const Eigen::Vector3d& p)
  {
    m_setup.set_point(m_mesh, m_vertices[k], p);
  }

  const auto& all_vertices() const { return m_vertices; }

  template <typename Places>
  auto vertices(const Places& places) const
  {
    std::vector<typename Deformation::vertex_descriptor> result;
    for(std::size_t k : places)
      result.push_back(m_vertices[k]);
    return result;
  }

  std::vector<std::size_t> roi()
  {
    std::vector<std::size_t> result;
    for(auto v : m_deformation->roi_vertices())
      result.push_back(std::lower_bound(m_places.begin(), m_places.end(),
                                        std::make_pair(v, std::size_t(0)))->second);
    return result;
  }

  void set_target(std::size_t k, const Eigen::Vector3d& p)
  {
    m_deformation->set_target_position(
      m_vertices[k], typename Deformation::Point(p.x(), p.y(), p.z()));
  }

  Eigen::Vector3d target(std::size_t k)
  {
    const auto p = m_deformation->target_position(m_vertices[k]);
    return {p[0], p[1], p[2]};
  }

private:
  using Vertex = typename Deformation::vertex_descriptor;

  typename Deformation::Triangle_mesh m_mesh;
  std::vector<Vertex> m_vertices;
  std::vector<std::pair<Vertex, std::size_t>> m_places;
  Setup m_setup;
  std::unique_ptr<Deformation> m_deformation;
};

template <typename Ours, typename Cgal, typename Setup = Own_points>
class Side_by_side
{
public:
  explicit Side_by_side(const Shape& shape)
    : m_size(shape.points.size()), m_diameter(shape.diameter()), m_ours(shape), m_cgal(shape)
  {}

  double diameter() const { return m_diameter; }
  std::size_t size() const { return m_size; }
  Side<Ours, Setup>& ours() { return m_ours; }

  // calls f for both, and compares what it returns
  template <typename Function>
  void same(const Function& f)
  {
    const auto ours = f(m_ours), cgals = f(m_cgal);
    CHECK(ours == cgals);
  }

  template <typename Function>
  void both(const Function& f)
  {
    f(m_ours);
    f(m_cgal);
  }

  std::vector<std::size_t> controls()
  {
    std::vector<std::size_t> result;
    for(std::size_t k : m_ours.roi())
      if(m_ours->is_control_vertex(m_ours.vertex(k)))
        result.push_back(k);
    return result;
  }

  // makes vertices controls until each free one hangs on something
  void tie()
  {
    while(m_ours->roi_vertices().empty() || !m_ours->preprocess())
    {
      CHECK(m_ours->roi_vertices().empty() ||
            m_ours->outcome().status == CGAL::ARAP::Status::no_fixed_vertex);
      const std::size_t k = below(m_size);
      same([k](auto& side) { return side->insert_control_vertex(side.vertex(k)); });
    }
    CHECK(m_ours->outcome());
    same([](auto& side) { return side->preprocess(); });
  }

  void deform(unsigned int iterations, double tolerance)
  {
    tie();
    const CGAL::ARAP::Report report = m_ours->deform(iterations, tolerance);
    m_cgal->deform(iterations, tolerance);
    CHECK(report);
    CHECK(report.energy.size() == report.iterations + 1);
    CHECK(tolerance > 0 || report.iterations == iterations);
    compare();
  }

  void compare()
  {
    for(std::size_t k = 0; k < m_size; ++k)
      m_largest_difference = larger(m_largest_difference,
                                        (m_ours.point(k) - m_cgal.point(k)).norm() / m_diameter);
    ++m_number_of_comparisons;
    CHECK_AT_MOST(m_largest_difference, bound);
    same([](auto& side) { return side.roi(); });
    for(std::size_t k : controls())
    {
      CHECK_AT_MOST((m_ours.target(k) - m_cgal.target(k)).norm(), bound * m_diameter);
      // CGAL's target_position() puts back what has left the region of interest, ours is const
      m_ours.set_target(k, m_ours.target(k));
    }
  }

  double largest_difference() const { return m_largest_difference; }
  std::size_t number_of_comparisons() const { return m_number_of_comparisons; }

private:
  std::size_t m_size;
  double m_diameter;
  Side<Ours, Setup> m_ours;
  Side<Cgal, Setup> m_cgal;
  double m_largest_difference = 0; // relative to the bounding box
  std::size_t m_number_of_comparisons = 0;
};

// a random function of the class
template <typename Pair>
void step(Pair& pair)
{
  const double d = pair.diameter();
  const std::size_t k = below(pair.size());
  const auto controls = pair.controls();
  const auto t = random_vector(0.03 * d);
  switch(below(16))
  {
  case 0:
    return pair.same([k](auto& side) { return side->insert_roi_vertex(side.vertex(k)); });
  case 1:
  {
    std::vector<std::size_t> places;
    for(std::size_t i = k; i < (std::min)(k + 10, pair.size()); ++i)
      places.push_back(i);
    return pair.both([&](auto& side) {
      const auto range = side.vertices(places);
      side->insert_roi_vertices(range.begin(), range.end());
    });
  }
  case 2:
  case 3:
    return pair.same([k](auto& side) { return side->erase_roi_vertex(side.vertex(k)); });
  case 4:
    return pair.same([k](auto& side) { return side->insert_control_vertex(side.vertex(k)); });
  case 5:
    if(controls.size() > 2)
      return pair.same([&](auto& side) {
        return side->erase_control_vertex(side.vertex(controls[k % controls.size()]));
      });
    return;
  case 6:
    // a control vertex or not
    return pair.both([&](auto& side) {
      side.set_target(k, side.point(k) + t);
    });
  case 7:
    return pair.both([&](auto& side) {
      const auto range = side.vertices(controls);
      side->translate(range.begin(), range.end(), t);
    });
  case 8:
    if(!controls.empty())
      return pair.both([&](auto& side) {
        side->translate(side.vertex(controls[k % controls.size()]), t);
      });
    return;
  case 9:
  {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(uniform(-0.3, 0.3), t.normalized()));
    return pair.both([&](auto& side) {
      const auto range = side.vertices(controls);
      side->rotate(range.begin(), range.end(), Eigen::Vector3d(20 * t), q);
      if(!controls.empty())
        side->rotate(side.vertex(controls.back()), t, q);
    });
  }
  case 10:
    if(below(3) == 0)
      pair.both([](auto& side) { side->reset(); });
    return pair.compare();
  case 11:
    if(below(3) == 0)
      pair.both([](auto& side) { side->overwrite_initial_geometry(); });
    return pair.compare();
  case 12:
    if(below(8) == 0)
      pair.both([](auto& side) { side->clear_control_vertices(); });
    return;
  case 13:
    if(below(15) == 0)
      pair.both([](auto& side) { side->clear_roi_vertices(); });
    return;
  case 14:
    return pair.deform(30, uniform(1e-3, 0.1));
  default:
    return pair.deform(static_cast<unsigned int>(below(6)), 0);
  }
}

// the controls of the scenario, and most other vertices free
template <typename Pair>
void start(Pair& pair, const Shape& shape)
{
  const Scenario s = scenario(shape, 0.4);
  for(std::size_t k = 0; k < pair.size(); ++k)
    if(s.selection[k] != 0 || k % 2 == 0)
      pair.same([k](auto& side) { return side->insert_roi_vertex(side.vertex(k)); });
  for(std::size_t k = 0; k < pair.size(); ++k)
    if(s.selection[k] == 2)
      pair.same([k](auto& side) { return side->insert_control_vertex(side.vertex(k)); });
}

struct Largest
{
  double difference = 0;
  std::size_t comparisons = 0;
};

template <typename Pair>
void run_sequences(const std::string& name, unsigned int first_seed, int number_of_seeds)
{
  Largest largest;
  for(const Shape& shape : shapes())
    for(unsigned int seed = first_seed; seed < first_seed + number_of_seeds; ++seed)
    {
      test_case() = name + ", " + shape.name + ", seed " + std::to_string(seed);
      generator.seed(seed);
      Pair pair(shape);
      start(pair, shape);
      for(int k = 0; k < 60; ++k)
        step(pair);
      largest.difference = larger(largest.difference, pair.largest_difference());
      largest.comparisons += pair.number_of_comparisons();
    }
  std::cout << name << ": " << largest.comparisons << " comparisons, largest difference "
            << largest.difference << " of the bounding box" << std::endl;
}

template <typename TriangleMesh, Tag tag, typename WC = Default, typename ST = Default,
          typename CR = Default, typename VPM = Default>
using Our_class =
  CGAL::ARAP::Surface_mesh_deformation<TriangleMesh, Default, Default, tag, WC, ST, CR, VPM>;

template <typename TriangleMesh, Tag tag, typename WC = Default, typename VPM = Default>
using Cgal_class = CGAL::Surface_mesh_deformation<TriangleMesh, Default, Default, tag, WC, Default,
                                                  Default, VPM>;

template <typename TriangleMesh, Tag tag>
using Pair_of = Side_by_side<Our_class<TriangleMesh, tag>, Cgal_class<TriangleMesh, tag>>;

template <Tag tag>
using Pair_with_maps =
  Side_by_side<Our_class<Mesh, tag, Halfedge_weight, Default, Default, Bare_point_map>,
               Cgal_class<Mesh, tag, Halfedge_weight, Bare_point_map>, Other_points>;

using Smoothed_pair = Side_by_side<Our_class<Mesh, CGAL::SRE_ARAP>,
                                   Cgal_class<Mesh, CGAL::SRE_ARAP>, Smoothed>;

constexpr double alphas[] = {0.02, 1, 50};

void test_sequences(unsigned int seed)
{
  using CGAL::ORIGINAL_ARAP;
  for(double alpha : alphas)
  {
    Smoothed::alpha = alpha;
    run_sequences<Smoothed_pair>("SRE_ARAP, alpha " + std::to_string(alpha), seed, 2);
  }
  using CGAL::SPOKES_AND_RIMS;
  run_sequences<Pair_of<Mesh, ORIGINAL_ARAP>>("ORIGINAL_ARAP", seed, 5);
  run_sequences<Pair_of<Mesh, SPOKES_AND_RIMS>>("SPOKES_AND_RIMS", seed, 5);
#ifdef CGAL_ARAP_TEST_ALL // dear to compile
  run_sequences<Pair_with_maps<ORIGINAL_ARAP>>("ORIGINAL_ARAP, weights and points of a user",
                                               seed, 3);
  run_sequences<Pair_of<Polyhedron, SPOKES_AND_RIMS>>("SPOKES_AND_RIMS, Polyhedron_3", seed, 1);
  run_sequences<Pair_with_maps<SPOKES_AND_RIMS>>("SPOKES_AND_RIMS, weights and points of a user",
                                                 seed, 3);
  run_sequences<Pair_of<Polyhedron_with_ids, ORIGINAL_ARAP>>("ORIGINAL_ARAP, Polyhedron_3 with ids",
                                                             seed, 1);
#endif
}

// one iteration more each time, from the beginning, and one run after the other: the same points
template <typename Pair>
void test_iterates()
{
  const auto prepare_both = [](Pair& pair, const Shape& shape) {
    const Scenario s = scenario(shape, 0.8);
    pair.both([&](auto& side) { prepare(*side.operator->(), s, side.all_vertices()); });
  };
  for(const Shape& shape : shapes())
  {
    test_case() = "iterates, " + shape.name;
    Pair many_runs(shape);
    prepare_both(many_runs, shape);
    for(unsigned int k = 1; k <= 8; ++k)
    {
      Pair pair(shape);
      prepare_both(pair, shape);
      pair.deform(k, 0);
      many_runs.deform(1, 0); // the rotations are kept
      for(std::size_t v = 0; v < pair.size(); ++v)
        CHECK_AT_MOST((pair.ours().point(v) - many_runs.ours().point(v)).norm(),
                      1e-12 * pair.diameter());
    }
    many_runs.deform(2, std::nan("")); // is no tolerance
    many_runs.both([](auto& side) { side->set_sre_arap_alpha(3); });
    many_runs.deform(2, 0);
    many_runs.same([](auto& side) { return side->iterations(); });
    many_runs.same([](auto& side) { return side->tolerance(); });
    for(bool are_set : {false, true})
    {
      Pair pair(shape);
      prepare_both(pair, shape);
      pair.both([&](auto& side) {
        if(are_set)
        {
          side->set_iterations(7);
          side->set_tolerance(0.02);
        }
        side->deform();
      });
      pair.compare();
    }
  }
}

// Vertices that have left the region of interest, and return to it after it was used: they start
// from the rest shape, without rotations.
template <typename Pair>
void test_returns()
{
  for(const Shape& shape : shapes())
  {
    test_case() = "returns, " + shape.name;
    const Scenario s = scenario(shape, 0.8);
    Pair pair(shape);
    pair.both([&](auto& side) { prepare(*side.operator->(), s, side.all_vertices()); });
    pair.deform(5, 0);
    pair.both([&](auto& side) {
      side->clear_roi_vertices();
      side->insert_control_vertex(side.vertex(0));
      side.set_target(0, shape.points[0]);
      side->clear_roi_vertices();
      prepare(*side.operator->(), s, side.all_vertices());
    });
    pair.deform(1, 0);
  }
}

// A new rest shape leaves the solution alone: targets that no run has reached, and what others have
// not moved.
template <typename Pair>
void test_overwritten()
{
  for(const Shape& shape : shapes())
  {
    test_case() = "overwritten, " + shape.name;
    const Scenario s = scenario(shape, 0.8);
    Pair pair(shape);
    pair.both([&](auto& side) { prepare(*side.operator->(), s, side.all_vertices()); });
    pair.deform(3, 0);
    const std::vector<std::size_t> controls = pair.controls();
    const std::size_t erased = controls.front();
    const std::size_t moved = static_cast<std::size_t>(
      std::find(s.selection.begin(), s.selection.end(), 1) - s.selection.begin());
    const Eigen::Vector3d p = random_vector(pair.diameter()), q = random_vector(pair.diameter());
    pair.both([&](auto& side) {
      side.set_target(erased, p);
      side->erase_control_vertex(side.vertex(erased));
      side.set_point(moved, q);
      side->overwrite_initial_geometry();
    });
    pair.deform(0, 0);
    CHECK_AT_MOST((pair.ours().point(erased) - p).norm(), 0.0);
    CHECK((pair.ours().point(moved) - q).norm() > 0);
    pair.both([&](auto& side) { side->insert_control_vertex(side.vertex(erased)); });
    pair.deform(2, 0);
    CHECK_AT_MOST((pair.ours().point(erased) - p).norm(), 0.0);
    // an empty region has no rest shape to overwrite
    pair.both([&](auto& side) {
      side->clear_roi_vertices();
      side->overwrite_initial_geometry();
      prepare(*side.operator->(), s, side.all_vertices());
    });
    pair.deform(2, 0);
  }
}

// A vertex that has left the region, and that others move, is at rest where the next region finds
// it: after reset() all is at rest. (CGAL's class does not see that it was moved.)
void test_reset_beside_others()
{
  test_case() = "reset beside what others have moved";
  const Shape shape = shapes()[2];
  Mesh mesh = make_mesh<Mesh>(shape);
  Our_class<Mesh, CGAL::ORIGINAL_ARAP> d(mesh);
  prepare(d, scenario(shape, 0.8), all_vertices(mesh));
  CHECK(d.deform(3, 0));
  std::vector<Mesh::Vertex_index> free;
  for(const auto v : mesh.vertices())
    if(d.is_roi_vertex(v) && !d.is_control_vertex(v))
      free.push_back(v);
  CHECK(d.erase_roi_vertex(free.front()) && d.deform(1, 0));
  const Point moved = mesh.point(free.front()) + Kernel::Vector_3(0.1, 0.2, 0.3);
  mesh.point(free.front()) = moved;
  CHECK(d.erase_roi_vertex(free.back()) && d.insert_roi_vertex(free.back()) && d.deform(1, 0));
  d.reset();
  const Mesh rest = mesh;
  CHECK(rest.point(free.front()) == moved);
  CHECK(d.deform(3, 0));
  CHECK_AT_MOST(largest_distance(points_of(mesh), points_of(rest)), 1e-12);
}

// The rest shape is that of the first use of a vertex.
template <typename Pair>
void test_moved_points()
{
  for(const Shape& shape : shapes())
  {
    test_case() = "moved points, " + shape.name;
    const Scenario s = scenario(shape, 0.8);
    Pair pair(shape);
    pair.both([&](auto& side) {
      for(std::size_t k = 0; k < shape.points.size(); ++k)
        if(s.selection[k] != 0)
          side->insert_roi_vertex(side.vertex(k));
      for(std::size_t k = 0; k < shape.points.size(); ++k)
        if(s.selection[k] == 2)
          side->insert_control_vertex(side.vertex(k));
      for(std::size_t k = 0; k < shape.points.size(); ++k)
        side.set_point(k, Eigen::Vector3d(1.5 * shape.points[k] + Eigen::Vector3d(1, 2, 3)));
    });
    const std::vector<std::size_t> controls = pair.controls();
    CHECK((pair.ours().point(controls[0]) - shape.points[controls[0]]).norm() > 0);
    for(std::size_t k : controls)
      CHECK_AT_MOST((pair.ours().target(k) - pair.ours().point(k)).norm(), 0.0);
    pair.tie();
    for(std::size_t k : std::set<std::size_t>{controls.front(), controls.back()})
    {
      CHECK_AT_MOST((pair.ours().target(k) - pair.ours().point(k)).norm(), 0.0);
      const Eigen::Vector3d target = pair.ours().point(k) + 0.1 * random_vector(pair.diameter());
      pair.both([&](auto& side) { side.set_target(k, target); });
    }
    pair.deform(3, 0);
    pair.both([](auto& side) { side->reset(); });
    pair.compare();
  }
}

// a function that names the type of the point map
double uniform_weight(Mesh::Halfedge_index, Mesh&, Mesh::Property_map<Mesh::Vertex_index, Point>)
{
  return 1;
}

// a function object that indexes the point map
struct Length_weight
{
  template <typename Points>
  double operator()(Mesh::Halfedge_index h, Mesh& mesh, const Points& points) const
  {
    return CGAL::squared_distance(points[mesh.source(h)], points[mesh.target(h)]);
  }
};

template <typename Weight>
void test_function_as_weight(const Weight& weight)
{
  test_case() = "function as weight";
  Mesh mesh = make_mesh<Mesh>(shapes()[0]), other = mesh;
  const auto deformed = [](auto& deformation, Mesh& m) {
    prepare(deformation, scenario(shapes()[0], 0.8), all_vertices(m));
    deformation.deform(3, 0);
    return points_of(m);
  };
  Our_class<Mesh, CGAL::ORIGINAL_ARAP, Weight> ours(
    mesh, get(boost::vertex_index, mesh), get(boost::halfedge_index, mesh),
    get(CGAL::vertex_point, mesh), weight);
  Cgal_class<Mesh, CGAL::ORIGINAL_ARAP, Weight> cgals(
    other, get(boost::vertex_index, other), get(boost::halfedge_index, other),
    get(CGAL::vertex_point, other), weight);
  CHECK_AT_MOST(largest_distance(deformed(ours, mesh), deformed(cgals, other)),
                bound * shapes()[0].diameter());
}

// the points after four iterations of our class on a shape
template <typename Deformation, typename Prepare>
std::vector<Point> run(const Shape& shape, const Prepare& prepare_deformation)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation deformation(mesh);
  prepare_deformation(deformation);
  prepare(deformation, scenario(shape, 0.6), all_vertices(mesh));
  CHECK(deformation.deform(4, 0));
  return points_of(mesh);
}

// solvers and rotations of this package and of CGAL's give the same
void test_models()
{
  using CGAL::ORIGINAL_ARAP;
  using LU = CGAL::Eigen_solver_traits<Eigen::SparseLU<
    CGAL::Eigen_sparse_matrix<double>::EigenType, Eigen::COLAMDOrdering<int>>>;
  using SVD = CGAL::Deformation_Eigen_closest_rotation_traits_3;
  using Polar = CGAL::Deformation_Eigen_polar_closest_rotation_traits_3;
  using CGAL::ARAP::Multifrontal_cholesky_solver;
  using CGAL::ARAP::Newton_closest_rotation;
  const auto nothing = [](auto&) {};
  for(const Shape& shape : shapes())
  {
    test_case() = "models, " + shape.name;
    const double d = bound * shape.diameter();
    const auto result = run<Our_class<Mesh, ORIGINAL_ARAP>>(shape, nothing);
    CHECK(largest_distance(result, shape.points) > 0.01 * shape.diameter());
    CHECK_AT_MOST(largest_distance(result, run<Our_class<Mesh, ORIGINAL_ARAP, Default, LU, Polar>>(
                                             shape, nothing)), d);
    CHECK_AT_MOST(largest_distance(result, run<Our_class<Mesh, ORIGINAL_ARAP, Default, Default,
                                                         SVD>>(shape, nothing)), d);
    CHECK(result == (run<Our_class<Mesh, ORIGINAL_ARAP, Default, Multifrontal_cholesky_solver,
                                   Newton_closest_rotation>>(shape, nothing)));

    // without smoothing
    const auto no_smoothing = [](auto& deformation) { deformation.set_sre_arap_alpha(0); };
    CHECK(result == (run<Our_class<Mesh, CGAL::SRE_ARAP>>(shape, no_smoothing)));
  }
}

// A mesh with removed elements, and halfedges numbered in any order: the same points.
void test_indices()
{
  for(const Shape& shape : shapes())
  {
    test_case() = "indices, " + shape.name;
    const Scenario s = scenario(shape, 0.6);
    const auto expected = run<Our_class<Mesh, CGAL::SPOKES_AND_RIMS>>(shape, [](auto&) {});

    Mesh mesh = make_mesh<Mesh>(shape);
    std::vector<std::size_t> numbers(num_halfedges(mesh));
    std::iota(numbers.begin(), numbers.end(), std::size_t(0));
    std::shuffle(numbers.begin(), numbers.end(), generator);
    const auto number = boost::make_function_property_map<Mesh::Halfedge_index>(
      [&numbers](Mesh::Halfedge_index h) { return numbers[h]; });
    using Number_map = std::decay_t<decltype(number)>;
    CGAL::ARAP::Surface_mesh_deformation<Mesh, Default, Number_map> shuffled(
      mesh, get(boost::vertex_index, mesh), number);
    prepare(shuffled, s, all_vertices(mesh));
    CHECK(shuffled.deform(4, 0));
    CHECK(expected == points_of(mesh));

    Mesh holes;
    const auto nowhere = [&holes] { return holes.add_vertex(Point(0, 0, 0)); };
    holes.add_face(nowhere(), nowhere(), nowhere());
    holes += make_mesh<Mesh>(shape);
    CGAL::Euler::remove_face(halfedge(*faces(holes).first, holes), holes);
    CHECK(holes.has_garbage());
    Our_class<Mesh, CGAL::SPOKES_AND_RIMS> with_holes(holes);
    prepare(with_holes, s, all_vertices(holes));
    CHECK(with_holes.deform(4, 0));
    std::vector<Point> points;
    for(auto v : holes.vertices())
      points.push_back(holes.point(v));
    CHECK_AT_MOST(largest_distance(expected, points), 1e-12 * shape.diameter());
  }
}

// a weight that is `value` at one halfedge and 1 at the others
struct One_weight
{
  template <typename VertexPointMap>
  double operator()(Mesh::Halfedge_index h, Mesh&, VertexPointMap) const
  {
    return h == halfedge ? value : 1;
  }
  Mesh::Halfedge_index halfedge;
  double value = 1;
};

// What fails says why and which vertex is to blame, and leaves mesh and object as they were.
void test_failures()
{
  using CGAL::ARAP::Status;
  using Deformation = Our_class<Mesh, CGAL::SPOKES_AND_RIMS>;
  static_assert(!std::is_copy_constructible_v<Deformation>);
  static_assert(!std::is_copy_constructible_v<
                Our_class<Mesh, CGAL::ORIGINAL_ARAP, Halfedge_weight, Default, Default,
                          Bare_point_map>>);
  static_assert(!std::is_copy_assignable_v<Deformation>);
  const auto names = [](const CGAL::ARAP::Outcome& outcome, std::size_t v) {
    return (outcome.message + " ").find("vertex " + std::to_string(v) + " ") != std::string::npos;
  };
  const Shape sphere = shapes()[2];
  Mesh mesh = make_mesh<Mesh>(sphere);
  Deformation deformation(mesh);
  const Mesh::Vertex_index a(7), b(20), c(60);

  test_case() = "nothing to do";
  CHECK(deformation.outcome().status == Status::not_run);
  CHECK(deformation.preprocess() && deformation.outcome().status == Status::success);
  CHECK(deformation.deform().status == Status::iteration_limit ||
        deformation.deform().status == Status::converged);

  test_case() = "no control vertex";
  for(auto v : mesh.vertices())
    deformation.insert_roi_vertex(v);
  CHECK(!deformation.preprocess());
  CHECK(deformation.outcome().status == Status::no_fixed_vertex);
  CHECK(names(deformation.outcome(), 0));
  CHECK(deformation.deform().status == Status::no_fixed_vertex);
  CHECK(same_points(mesh, make_mesh<Mesh>(sphere)));

  test_case() = "no control vertex";
  CHECK(deformation.set_target_position(a, Point(0, 0, 0)).status == Status::not_a_control_vertex);
  CHECK(names(deformation.set_target_position(a, Point(0, 0, 0)), 7));
  CHECK(!deformation.translate(a, Eigen::Vector3d(1, 0, 0)));
  CHECK(!deformation.rotate(a, Eigen::Vector3d(1, 0, 0), Eigen::Quaterniond::Identity()));
  for(auto v : {a, b, c})
    deformation.insert_control_vertex(v);
  const std::vector<Mesh::Vertex_index> some = {a, Mesh::Vertex_index(8), b};
  const auto moved = deformation.translate(some.begin(), some.end(), Eigen::Vector3d(0.2, 0, 0));
  CHECK(moved.status == Status::not_a_control_vertex && names(moved, 8));
  CHECK(deformation.target_position(b) == mesh.point(b) + Kernel::Vector_3(0.2, 0, 0));

  // what left the region of interest comes back to its rest position, but not if a call fails
  const Mesh::Vertex_index left(30);
  CHECK(deformation.deform(3, 0));
  CHECK(mesh.point(b) == deformation.target_position(b));
  CHECK(mesh.point(left) != point(sphere.points[left]));
  deformation.erase_roi_vertex(left);
  const Mesh before = mesh;

  test_case() = "a target that is not finite";
  const Point target = deformation.target_position(b);
  deformation.insert_roi_vertex(left);
  CHECK(deformation.set_target_position(b, Point(0, std::nan(""), 0)));
  CHECK(std::isnan(deformation.target_position(b).y()));
  deformation.erase_roi_vertex(left);
  const auto report = deformation.deform();
  CHECK(report.status == Status::non_finite_point && names(report, 20));
  CHECK(same_points(mesh, before));
  CHECK(deformation.roi_vertices().size() == sphere.points.size() - 1);

  test_case() = "nothing fixed";
  deformation.insert_roi_vertex(left);
  deformation.set_target_position(b, target);
  deformation.erase_roi_vertex(left);
  deformation.clear_control_vertices();
  deformation.insert_roi_vertex(left);
  CHECK(deformation.deform().status == Status::no_fixed_vertex);
  CHECK(same_points(mesh, before));

  test_case() = "afterwards";
  deformation.erase_roi_vertex(left);
  CHECK(deformation.deform());
  CHECK(mesh.point(left) == point(sphere.points[left]));

  test_case() = "a point that is not finite, and is mended";
  const Mesh::Vertex_index broken(30);
  const Point whole = mesh.point(broken);
  mesh.point(broken) = Point(0, std::nan(""), 0);
  deformation.overwrite_initial_geometry();
  CHECK(names(deformation.deform(), 30));
  deformation.reset();
  mesh.point(broken) = whole;
  deformation.overwrite_initial_geometry();
  CHECK(deformation.deform());

  test_case() = "an erased control vertex whose target was not finite";
  const Mesh::Vertex_index pulled(40);
  deformation.insert_control_vertex(pulled);
  CHECK(deformation.set_target_position(pulled, Point(0, std::nan(""), 0)));
  CHECK(names(deformation.deform(), 40));
  deformation.erase_control_vertex(pulled);
  CHECK(deformation.deform());

  test_case() = "smoothed rotations";
  Mesh smooth = make_mesh<Mesh>(sphere);
  Our_class<Mesh, CGAL::SRE_ARAP> smoothed(smooth);
  prepare(smoothed, scenario(sphere), all_vertices(smooth));
  smoothed.set_sre_arap_alpha(std::nan(""));
  CHECK(!smoothed.preprocess() && smoothed.outcome().status == Status::invalid_option);
  CHECK(smoothed.deform().status == Status::invalid_option);
  CHECK(same_points(smooth, make_mesh<Mesh>(sphere)));
  smoothed.set_sre_arap_alpha(0);
  CHECK(smoothed.deform());

  test_case() = "edges without faces, to vertices without cells";
  Shape strip = {"strip", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}},
                 {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}};
  Mesh emptied = make_mesh<Mesh>(strip);
  for(const Mesh::Face_index face : {Mesh::Face_index(1), Mesh::Face_index(2)})
  {
    for(Mesh::Halfedge_index h : emptied.halfedges_around_face(emptied.halfedge(face)))
      emptied.set_face(h, Mesh::null_face());
    emptied.remove_face(face);
  }
  strip.triangles = {strip.triangles[0], strip.triangles[3]};
  Mesh apart = make_mesh<Mesh>(strip);
  for(Mesh* cut : {&emptied, &apart})
  {
    Our_class<Mesh, CGAL::SRE_ARAP> at_edges(*cut);
    for(const Mesh::Vertex_index v : {Mesh::Vertex_index(0), Mesh::Vertex_index(1)})
      CHECK(at_edges.insert_control_vertex(v));
    CHECK(at_edges.insert_roi_vertex(Mesh::Vertex_index(2)));
    at_edges.set_target_position(Mesh::Vertex_index(1), Point(0.8, 0.6, 0));
    CHECK(at_edges.deform(3, 0));
    CHECK(cut->point(Mesh::Vertex_index(2)) != point(strip.points[2]));
  }
  CHECK(same_points(emptied, apart));

  for(const double value : {std::nan(""), HUGE_VAL, -1000.0})
  {
    test_case() = "the weight " + std::to_string(value);
    const Mesh::Halfedge_index h = mesh.halfedge(b, *mesh.vertices_around_target(
                                                      mesh.halfedge(b)).first);
    Mesh copy = make_mesh<Mesh>(sphere);
    Our_class<Mesh, CGAL::ORIGINAL_ARAP, One_weight> weighted(
      copy, get(boost::vertex_index, copy), get(boost::halfedge_index, copy),
      get(CGAL::vertex_point, copy), One_weight{h, value});
    for(auto v : copy.vertices())
      weighted.insert_roi_vertex(v);
    weighted.insert_control_vertex(Mesh::Vertex_index(50));
    CHECK(!weighted.preprocess());
    CHECK(weighted.outcome().status ==
          (value < 0 ? Status::singular_matrix : Status::non_finite_weight));
    // the face of the halfedge, or one of its ends
    CHECK(names(weighted.outcome(), 20) ||
          names(weighted.outcome(), static_cast<std::size_t>(copy.target(h))) ||
          weighted.outcome().message.find("the face with the vertices") == 0);
    weighted.set_target_position(Mesh::Vertex_index(50), Point(3, 3, 3));
    CHECK(!weighted.deform());
    CHECK(same_points(copy, make_mesh<Mesh>(sphere)));
  }

  test_case() = "a face that is not a triangle";
  Mesh quad;
  const auto p = quad.add_vertex(Point(0, 0, 0)), q = quad.add_vertex(Point(1, 0, 0)),
             r = quad.add_vertex(Point(1, 1, 0)), t = quad.add_vertex(Point(0, 1, 0));
  quad.add_face(p, q, r, t);
  Deformation on_quad(quad);
  on_quad.insert_roi_vertex(p);
  CHECK(!on_quad.preprocess() && on_quad.outcome().status == Status::not_a_simplex);
}

#ifdef CGAL_NDEBUG
// a rotation that makes a call, and then fails
struct Calling_rotation : CGAL::ARAP::Newton_closest_rotation
{
  static std::function<void()> call;

  void operator()(std::size_t n, const CGAL::ARAP::Matrix_3x3* covariances,
                  CGAL::ARAP::Matrix_3x3* rotations) const
  {
    if(call)
    {
      call();
      throw std::runtime_error("as it is told to");
    }
    Newton_closest_rotation::operator()(n, covariances, rotations);
  }
};

std::function<void()> Calling_rotation::call;

// What a run calls must not change the object; where preconditions are not checked, such calls do
// nothing.
void test_calls_in_a_run()
{
  test_case() = "calls in a run";
  using CGAL::ARAP::Status;
  using Deformation = Our_class<Mesh, CGAL::ORIGINAL_ARAP, Default, Default, Calling_rotation>;
  const Shape sphere = shapes()[2];
  const Mesh::Vertex_index pulled(50), erased(7), other(20);
  std::vector<std::vector<Point>> results;
  for(const bool has_calls : {false, true})
  {
    Mesh mesh = make_mesh<Mesh>(sphere);
    Deformation d(mesh);
    prepare(d, scenario(sphere), all_vertices(mesh));
    d.insert_control_vertex(pulled);
    d.set_target_position(pulled, Point(3, 2, 1));
    CHECK(d.deform(3, 0));
    d.set_target_position(pulled, Point(3, 2, 2));
    CHECK(d.erase_roi_vertex(erased)); // goes back to its rest position when the run ends
    const Mesh before = mesh;
    int calls = 0;
    const std::vector<Mesh::Vertex_index> none;
    if(has_calls)
    {
      Calling_rotation::call = [&] {
        ++calls;
        CHECK(d.set_target_position(pulled, Point(0, 0, 0)).status == Status::in_a_run);
        CHECK(d.translate(pulled, Eigen::Vector3d(1, 0, 0)).status == Status::in_a_run);
        CHECK(d.translate(none.begin(), none.end(), Eigen::Vector3d(1, 0, 0)));
        CHECK(!d.erase_control_vertex(pulled) && !d.erase_roi_vertex(other));
        CHECK(!d.preprocess() && d.deform().status == Status::in_a_run);
        d.clear_roi_vertices();
        d.clear_control_vertices();
        d.reset();
        d.overwrite_initial_geometry();
      };
      try
      {
        d.deform(3, 0);
        CHECK(!"the rotation throws");
      }
      catch(const std::runtime_error&)
      {}
      Calling_rotation::call = nullptr;
    }
    CHECK((calls > 0) == has_calls && same_points(mesh, before));
    d.erase_control_vertex(pulled);
    CHECK(d.deform(3, 0));
    d.insert_roi_vertex(erased);
    CHECK(d.deform(3, 0));
    results.push_back(points_of(mesh));
  }
  CHECK_AT_MOST(largest_distance(results[0], results[1]), 1e-12);
}
#endif

void test_all(unsigned int first_seed)
{
  // a zero energy that is rounded to less is nothing to warn of
  CGAL::set_warning_handler([](const char*, const char*, const char*, int, const char*) {});
  test_sequences(first_seed);
  test_iterates<Pair_of<Mesh, CGAL::SPOKES_AND_RIMS>>();
  for(double alpha : alphas)
  {
    Smoothed::alpha = alpha;
    test_iterates<Smoothed_pair>();
  }
  test_iterates<Pair_of<Mesh, CGAL::SRE_ARAP>>(); // the default
  test_returns<Pair_of<Mesh, CGAL::ORIGINAL_ARAP>>();
  test_overwritten<Pair_of<Mesh, CGAL::ORIGINAL_ARAP>>();
  test_reset_beside_others();
  test_moved_points<Pair_of<Mesh, CGAL::SPOKES_AND_RIMS>>();
  test_function_as_weight(&uniform_weight);
  test_function_as_weight(Length_weight());
  test_models();
  test_indices();
  test_failures();
#ifdef CGAL_NDEBUG
  test_calls_in_a_run();
#endif
}

} // namespace side_by_side

// The drop-in class with its header first and CGAL's second; points of `float` and of an exact
// kernel.
namespace kernels {

#ifdef CGAL_ARAP_TEST_ALL
using Float_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;
using Exact_mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
#endif

// the coordinates of all points after a run
template <typename Deformation>
std::vector<Eigen::Vector3d> run(const Shape& shape)
{
  typename Deformation::Triangle_mesh mesh =
    make_mesh<typename Deformation::Triangle_mesh>(shape);
  Deformation deformation(mesh);
  prepare(deformation, scenario(shape), all_vertices(mesh));
  deformation.deform(5, 0);
  std::vector<Eigen::Vector3d> points;
  for(auto v : vertices(mesh))
  {
    const auto& p = mesh.point(v);
    points.emplace_back(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  }
  return points;
}

void test_all()
{
  using Ours = CGAL::ARAP::Surface_mesh_deformation<Mesh>;
  using Cgals = CGAL::Surface_mesh_deformation<Mesh>;
  static_assert(std::is_same_v<Ours::Point, Cgals::Point>);
  static_assert(std::is_same_v<Ours::Weight_calculator, Cgals::Weight_calculator>);
  static_assert(std::is_same_v<Ours::Vertex_index_map, Cgals::Vertex_index_map>);
  static_assert(std::is_same_v<Ours::Hedge_index_map, Cgals::Hedge_index_map>);
  static_assert(std::is_same_v<Ours::Roi_vertex_range, Cgals::Roi_vertex_range>);
  for(const Shape& shape : {shapes()[2], shapes()[7]})
  {
    test_case() = shape.name;
    const auto ours = run<Ours>(shape);
    CHECK(largest_distance(ours, shape.points) > 0.01 * shape.diameter());
    CHECK_AT_MOST(largest_distance(ours, run<Cgals>(shape)), 1e-8 * shape.diameter());
#ifdef CGAL_ARAP_TEST_ALL
    CHECK_AT_MOST(largest_distance(
                    ours, run<CGAL::ARAP::Surface_mesh_deformation<Float_mesh>>(shape)),
                  1e-5 * shape.diameter());
    CHECK_AT_MOST(largest_distance(
                    ours, run<CGAL::ARAP::Surface_mesh_deformation<Exact_mesh>>(shape)),
                  1e-12 * shape.diameter());
#endif
  }
}

} // namespace kernels

int main(int argc, char** argv)
{
  side_by_side::test_all(argc > 1 ? static_cast<unsigned int>(std::stoul(argv[1])) : 1);
  kernels::test_all();
  return checks_result();
}
