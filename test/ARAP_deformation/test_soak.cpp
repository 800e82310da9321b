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

// Load: ten thousand drags with changing handles, weights and regions, after which a session is as
// good as a new one and the process has not grown; and two sessions in two threads at once.

#include "include/check.h"
#include "include/sanitizer.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

using Deformation = CGAL::ARAP_deformation<Mesh>;
using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;

const double infinity = std::numeric_limits<double>::infinity();

// what the process has in memory, in bytes; 0 where that is not known, and under sanitizers, which
// keep what is freed
double resident_bytes()
{
#ifdef CGAL_ARAP_TEST_HAS_OWN_MALLOC
  return 0;
#endif
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return 4096 * resident;
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
  const std::vector<Point> m_rest = {m_mesh.points().begin(), m_mesh.points().end()};
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
  return {mesh.points().begin(), mesh.points().end()};
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
      warm = resident_bytes();
    dragging.drag();
  }
  const double growth = resident_bytes() - warm;
  std::cout << number_of_drags << " drags: " << warm / 1e6 << " MB after a fifth of them, "
            << growth / 1e6 << " MB more at the end" << std::endl;
  CHECK_AT_MOST(growth, 1000.0 * number_of_drags); // less than anything that a drag allocates

  // the session that has seen all this does what a new one does
  dragging.deformation().reset();
  CHECK(same_points(mesh, rest));
  Mesh other = rest;
  Deformation fresh(other);
  for(Deformation* d : {&fresh, &dragging.deformation()})
  {
    d->clear_roi_vertices();
    prepare(*d, scenario(bar()), all_vertices(mesh));
    CHECK(d->set_options(Options()));
    CHECK(d->deform(10, 0));
  }
  for(Vertex v : mesh.vertices())
    CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(mesh.point(v), other.point(v))), 1e-10);
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

int main(int argc, char* argv[])
{
  test_soak(argc > 1 ? std::atoi(argv[1]) : 10000);
  test_two_threads();
  return checks_result();
}
