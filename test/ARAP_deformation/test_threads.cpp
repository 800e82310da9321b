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

// Threads, and load.
// usage: test_threads [NUMBER_OF_DRAGS]

#include "include/check.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/sanitizer.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

// The results are the same to the last bit for any number of threads.
namespace threads {

using Parallel_tag = CGAL::Parallel_if_available_tag;

// what is compared
struct Bits
{
  std::vector<double> energy;
  std::vector<Point> points;
};

template <int Dimension, typename ConcurrencyTag, typename Simplices>
Bits run(const std::vector<Eigen::Vector3d>& vectors, const Simplices& simplices,
         CGAL::ARAP::Options options, unsigned int threads)
{
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::Default, CGAL::Default,
                                                 ConcurrencyTag>;
  Bits bits{{}, points_of(vectors)};
  CGAL::ARAP_deformation<Domain, Traits> deformation(Domain(bits.points, simplices));
  options.threads = threads;
  CHECK(deformation.set_options(options));
  prepare(deformation, scenario(Shape{"", vectors, {}}), numbers(vectors.size()));
  const CGAL::ARAP::Report first = deformation.deform();

  // once more with other control vertices, and most of them soft
  deformation.erase_control_vertex(deformation.control_vertices().front());
  deformation.insert_control_vertex(vectors.size() / 2);
  const auto controls = deformation.control_vertices();
  CHECK(deformation.set_target_weight(CGAL::make_range(controls.begin() + 1, controls.end()), 2));
  const CGAL::ARAP::Report second = deformation.deform();
  CHECK(first && second);
  for(const CGAL::ARAP::Report* report : {&first, &second})
    bits.energy.insert(bits.energy.end(), report->energy.begin(), report->energy.end());
  return bits;
}

template <int Dimension, typename Simplices>
void test(const std::string& name, const std::vector<Eigen::Vector3d>& points,
          const Simplices& simplices)
{
  for(Cell_scheme cells : all_cell_schemes)
    for(double tolerance : {0.0, 1e-3}) // local/global and quasi-Newton
    {
      test_case() = name;
      CGAL::ARAP::Options options;
      options.cells = cells;
      options.iterations = 6;
      options.tolerance = tolerance;
      const Bits one = run<Dimension, CGAL::Sequential_tag>(points, simplices, options, 0);
      for(unsigned int threads : {0u, 1u, 2u, 3u, 8u})
      {
        const Bits many = run<Dimension, Parallel_tag>(points, simplices, options, threads);
        CHECK(many.energy == one.energy);
        CHECK(many.points == one.points);
      }
    }
}

// notes the threads that it is called in, and throws when it is told to
struct Watching_rotation : CGAL::ARAP::Newton_closest_rotation
{
  struct Notes
  {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    int calls = 0, throws_at = -1;
    int calls_at_a_time = 0, most_at_a_time = 0;
    std::thread::id owner = std::this_thread::get_id();
    bool throws_elsewhere = false;
  };
  std::shared_ptr<Notes> notes = std::make_shared<Notes>();

  void operator()(std::size_t n, const CGAL::ARAP::Matrix_3x3* covariances,
                  CGAL::ARAP::Matrix_3x3* rotations) const
  {
    {
      const std::lock_guard<std::mutex> lock(notes->mutex);
      notes->threads.insert(std::this_thread::get_id());
      if(notes->calls++ == notes->throws_at)
        throw std::runtime_error("no rotation");
      if(notes->throws_elsewhere && std::this_thread::get_id() != notes->owner)
        throw std::runtime_error("no rotation in another thread");
      notes->most_at_a_time = (std::max)(notes->most_at_a_time, ++notes->calls_at_a_time);
    }
    std::this_thread::yield(); // to the others, where processors are few
    CGAL::ARAP::Newton_closest_rotation::operator()(n, covariances, rotations);
    const std::lock_guard<std::mutex> lock(notes->mutex);
    --notes->calls_at_a_time;
  }
};

template <typename ConcurrencyTag>
using Watching_traits = CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::Default,
                                                        Watching_rotation, ConcurrencyTag>;

template <typename ConcurrencyTag>
Watching_traits<ConcurrencyTag> traits(const Watching_rotation& rotation)
{
  return Watching_traits<ConcurrencyTag>({}, {}, rotation);
}

template <typename ConcurrencyTag>
using Watched = CGAL::ARAP_deformation<
  CGAL::ARAP::Simplex_soup_domain<2, std::vector<Point>, decltype(Shape::triangles)>,
  Watching_traits<ConcurrencyTag>>;

// what a rotation noted while a shape deformed
template <typename ConcurrencyTag>
std::shared_ptr<Watching_rotation::Notes> notes(const Shape& shape, unsigned int threads)
{
  const Watching_rotation rotation;
  std::vector<Point> points = points_of(shape.points);
  Watched<ConcurrencyTag> deformation({points, shape.triangles}, traits<ConcurrencyTag>(rotation));
  CGAL::ARAP::Options options;
  options.threads = threads;
  CHECK(deformation.set_options(options));
  prepare(deformation, scenario(shape), numbers(points.size()));
  CHECK(deformation.deform(20, 0));
  return rotation.notes;
}

// No more threads at a time than allowed, and more than one where that is possible. Over a run
// there may be more: TBB may replace a thread by another one that waits.
void test_number_of_threads(const Shape& shape)
{
  test_case() = "the number of threads";
  CHECK(notes<CGAL::Sequential_tag>(shape, 0)->threads.size() == 1);
  CHECK(notes<Parallel_tag>(shape, 1)->threads.size() == 1);
  for(int attempt = 0; attempt < 5; ++attempt)
    CHECK(notes<Parallel_tag>(shape, 2)->most_at_a_time <= 2);
#ifdef CGAL_LINKED_WITH_TBB
  int most = 1;
  for(int attempt = 0; attempt < 100 && most == 1; ++attempt) // the machine may be busy
    most = notes<Parallel_tag>(shape, 0)->most_at_a_time;
  CHECK(most > 1);
#else
  CHECK(notes<Parallel_tag>(shape, 0)->threads.size() == 1);
#endif
}

#ifdef CGAL_LINKED_WITH_TBB
// An exception of another thread arrives here, and nothing has changed.
void test_exception_elsewhere(const Shape& shape)
{
  test_case() = "an exception in another thread";
  const Watching_rotation rotation;
  rotation.notes->throws_elsewhere = true;
  bool is_caught = false;
  for(int attempt = 0; attempt < 100 && !is_caught; ++attempt) // the machine may be busy
  {
    std::vector<Point> points = points_of(shape.points);
    const std::vector<Point> before = points;
    Watched<Parallel_tag> deformation({points, shape.triangles}, traits<Parallel_tag>(rotation));
    prepare(deformation, scenario(shape), numbers(points.size()));
    try { CHECK(deformation.deform(20, 0)); } catch(const std::runtime_error&)
    {
      is_caught = true;
      CHECK(points == before);
    }
  }
  CHECK(is_caught);
}
#endif

// An exception leaves all as it was.
void test_exception(const Shape& shape)
{
  test_case() = "an exception";
  const Watching_rotation rotation;
  std::vector<Point> points = points_of(shape.points);
  Watched<Parallel_tag> deformation({points, shape.triangles}, traits<Parallel_tag>(rotation));
  prepare(deformation, scenario(shape), numbers(points.size()));
  CHECK(deformation.preprocess());
  const std::vector<Point> before = points;
  for(int calls : {0, 3, 17})
  {
    rotation.notes->calls = 0;
    rotation.notes->throws_at = calls;
    bool is_caught = false;
    try { CHECK(!deformation.deform(20, 0)); }
    catch(const std::runtime_error&) { is_caught = true; }
    CHECK(is_caught);
    CHECK(points == before);
  }
  rotation.notes->throws_at = -1;
  CHECK(deformation.deform(3, 0));
  std::vector<Point> other_points = before;
  Watched<Parallel_tag> other({other_points, shape.triangles});
  prepare(other, scenario(shape), numbers(points.size()));
  CHECK(other.deform(3, 0));
  CHECK(points == other_points);
}

void test_in_arena()
{
  const Shape sheet = grid("sheet", 110, 60, [](double u, double v) { // several blocks of each loop
    return Eigen::Vector3d(3 * u, 2 * v, 0.2 * std::sin(9 * u) * std::cos(7 * v));
  });
  test<2>("triangles", sheet.points, sheet.triangles);
#ifndef CGAL_ARAP_TEST_THREAD_SANITIZER
  test_number_of_threads(sheet);
#endif
  test_exception(sheet);
#ifdef CGAL_LINKED_WITH_TBB
  test_exception_elsewhere(sheet);
#endif
  Polygons polygons;
  const Shape pipe = tube(polygons);
  test<2>("polygons", pipe.points, polygons);
  const Block solid = block(25, 10, 10);
  test<3>("tetrahedra", solid.points, solid.tetrahedra);
}

void test_all()
{
#ifdef CGAL_LINKED_WITH_TBB
  // more threads than there may be processors, also where the number is left to TBB
  constexpr int most = 8;
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, most);
  tbb::task_arena(most).execute(test_in_arena);
#else
  std::cout << "TBB is not linked: there is one thread" << std::endl;
  test_in_arena();
#endif
}

} // namespace threads

// Load: ten thousand drags with changing handles, weights and regions, after which a session is as
// good as a new one and the process has not grown; and two sessions in two threads at once.
namespace load {

using Deformation = CGAL::ARAP_deformation<Mesh>;
using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;

const double infinity = std::numeric_limits<double>::infinity();

// What is allocated, in bytes; 0 where that is not known, and under sanitizers, which keep what is
// freed. What the process has in memory depends on the system, too, which may take larger pages.
double allocated_bytes()
{
#if defined(__GLIBC__) && !defined(CGAL_ARAP_TEST_HAS_OWN_MALLOC)
#if __GLIBC_PREREQ(2, 33)
  const auto memory = mallinfo2();
  return static_cast<double>(memory.uordblks) + static_cast<double>(memory.hblkhd);
#endif
#endif
  return 0;
}

Shape bar()
{
  const double pi = std::acos(-1.0);
  return grid("bar", 30, 20, [pi](double u, double v) {
    return Eigen::Vector3d(6 * u, std::cos(2 * pi * v), std::sin(2 * pi * v));
  }, false, true);
}

// Drags handles about: a few iterations each, and now and then other handles, weights, options, or
// another region. All is random, and the same for the same seed.
class Dragging
{
public:
  Dragging(Mesh& mesh, unsigned int seed) : m_mesh(mesh), m_deformation(mesh), m_random(seed)
  {
    change_region();
  }

  void drag()
  {
    if(++m_number_of_drags % 50 == 0)
      change_region();
    else if(m_number_of_drags % 7 == 0)
      change_handles();
    for(Vertex v : m_deformation.control_vertices())
      if(number(0, 1) < 0.3)
        CHECK(m_deformation.set_target_position(v, near_rest(v)));
    const Report report = m_deformation.deform(3, m_number_of_drags % 2 == 0 ? 1e-3 : 0);
    CHECK(report);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  }

  Deformation& deformation() { return m_deformation; }

private:
  double number(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(m_random);
  }

  Vertex any_vertex()
  {
    return Vertex(std::uniform_int_distribution<Mesh::size_type>(
      0, static_cast<Mesh::size_type>(m_mesh.number_of_vertices() - 1))(m_random));
  }

  Point near_rest(Vertex v)
  {
    const Point& p = m_rest[v.idx()];
    return {p.x() + number(-0.3, 0.3), p.y() + number(-0.3, 0.3), p.z() + number(-0.3, 0.3)};
  }

  void change_region()
  {
    Options options;
    options.cells = number(0, 1) < 0.5 ? CGAL::ARAP::Cell_scheme::spokes()
                                       : CGAL::ARAP::Cell_scheme::spokes_and_rims();
    CHECK(m_deformation.set_options(options));
    m_deformation.clear_roi_vertices();
    const double begin = number(0, 3), end = begin + number(1, 4);
    for(Vertex v : m_mesh.vertices())
      if(m_rest[v.idx()].x() >= begin && m_rest[v.idx()].x() <= end)
        m_deformation.insert_roi_vertex(v);
    for(int k = 0; k < 4; ++k)
      change_handles();
    if(number(0, 1) < 0.2)
      m_deformation.reset();
  }

  // only those of the region: a vertex that is inserted here would be its own region
  void change_handles()
  {
    const Vertex in = any_vertex(), out = any_vertex();
    m_deformation.erase_control_vertex(out);
    if(!m_deformation.is_roi_vertex(in) || !m_deformation.insert_control_vertex(in))
      return;
    CHECK(m_deformation.set_target_weight(in, number(0, 1) < 0.5 ? infinity : number(0.1, 10)));
  }

  Mesh& m_mesh;
  const std::vector<Point> m_rest = points_of(m_mesh);
  Deformation m_deformation;
  std::mt19937 m_random;
  int m_number_of_drags = 0;
};

std::vector<Point> points_after(unsigned int seed, int number_of_drags)
{
  Mesh mesh = make_mesh<Mesh>(bar());
  Dragging dragging(mesh, seed);
  for(int k = 0; k < number_of_drags; ++k)
    dragging.drag();
  return points_of(mesh);
}

// What was allocated by a session that does the same after whatever it has done before.
double settled_bytes(Deformation& d, const Mesh& mesh)
{
  d.reset();
  d.clear_roi_vertices();
  prepare(d, scenario(bar()), all_vertices(mesh));
  CHECK(d.set_options(Options()));
  CHECK(d.deform(10, 0));
  return allocated_bytes();
}

void test_soak(int number_of_drags)
{
  test_case() = "soak";
  Mesh mesh = make_mesh<Mesh>(bar());
  const Mesh rest = mesh;
  Dragging dragging(mesh, 1);
  double warm = 0;
  for(int k = 0; k < number_of_drags; ++k)
  {
    if(k == number_of_drags / 5)
      warm = settled_bytes(dragging.deformation(), mesh);
    dragging.drag();
  }
  const double growth = settled_bytes(dragging.deformation(), mesh) - warm;
  std::cout << number_of_drags << " drags: " << warm / 1e6 << " MB after a fifth of them, "
            << growth / 1e6 << " MB more at the end" << std::endl;
  if(warm == 0)
    std::cout << "NOTICE: not tested: what is allocated is not known here" << std::endl;
  CHECK_AT_MOST(growth, 1e5); // of the mesh's 620 vertices one array of rotations has 45,000

  // the session that has seen all this does what a new one does
  Mesh other = rest;
  Deformation fresh(other);
  settled_bytes(fresh, other);
  CHECK_AT_MOST(largest_distance(points_of(mesh), points_of(other)), 1e-10);
  dragging.deformation().reset();
  CHECK(same_points(mesh, rest));
}

// Two sessions know nothing of each other: in two threads they do to the last bit what each does
// alone, and so does a second run.
void test_two_threads()
{
  test_case() = "two threads";
  const int n = 200;
  const std::vector<Point> a = points_after(2, n), b = points_after(3, n);
  CHECK(points_after(2, n) == a);
  std::vector<Point> in_thread;
  std::thread thread([&] { in_thread = points_after(2, n); });
  const std::vector<Point> here = points_after(3, n);
  thread.join();
  CHECK(in_thread == a);
  CHECK(here == b);
  CHECK(a != b);
}

void test_all(int number_of_drags)
{
  test_soak(number_of_drags);
  test_two_threads();
}

} // namespace load

int main(int argc, char* argv[])
{
  threads::test_all();
  load::test_all(argc > 1 ? std::atoi(argv[1]) : short_or_long(1000, 10000));
  return checks_result();
}
