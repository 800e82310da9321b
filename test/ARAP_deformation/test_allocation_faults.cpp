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

// Memory that runs out, at every allocation of everything that is done with an object: what fails
// leaves the mesh and the object as they were. (Not with CHOLMOD, whose OpenMP ends the program.)

// The allocations of TBB are not ours: it makes some of them once for a thread, at any time.
#undef CGAL_LINKED_WITH_TBB

#include "include/Single_precision_solver.h"
#include "include/check.h"
#include "include/fault_stories.h"

#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Embedding.h>
#include <CGAL/arap_deform.h>

#include <boost/property_map/function_property_map.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// last: a header of clang++ declares one of its functions without noexcept, and may do so first
#include "include/allocation_faults.h"

using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;

template <typename Session>
Fault_test<Session> fault_test(Fault_statistics& statistics)
{
  return Fault_test<Session>(allocation_faults, statistics);
}

void test_cell_schemes()
{
  Fault_statistics statistics("ARAP_deformation");
  for(Cell_scheme cells : all_cell_schemes)
  {
    test_stories(fault_test<Session<Surface>>(statistics), "surface", cells);
    test_stories(fault_test<Session<Solid>>(statistics), "solid", cells);
  }
  test_story_of_terms(fault_test<Session<Surface>>(statistics), "surface, terms");
  test_story_of_terms(fault_test<Session<Solid>>(statistics), "solid, terms");
  test_story_of_undo(fault_test<Session<Surface>>(statistics), "surface, undo");
}

template <typename Solver>
void test_solver(const std::string& name)
{
  using Traits = CGAL::ARAP_deformation_traits<Solver>;
  Fault_statistics statistics(name);
  test_stories(fault_test<Session<Surface, Traits>>(statistics), name,
               Cell_scheme::spokes_and_rims());
}

// More weights of targets change than a border takes: the matrix is factorized again, with the
// analysis of the last one.
void test_many_weights()
{
  using Session_ = Session<Surface>;
  using S = Steps<Session_>;
  Fault_statistics statistics("many weights of targets");
  const auto make = [] {
    Surface surface(small_sheet(11, 11));
    surface.fixed.selection.assign(surface.fixed.selection.size(), 2);
    surface.fixed.selection[0] = 0;
    return std::make_unique<Session_>(Session_::Traits(), surface);
  };
  fault_test<Session_>(statistics)(
    "many weights", make,
    {S::construct(), S::insert(),
     S::set_options(Cell_scheme::spokes(), Minimizer::local_global, Initial_guess::previous),
     S::set_weights(1, 1000), S::deform(), S::set_weights(3, 1000), S::deform()}, 5);
}

struct Call
{
  Surface surface;

  State state() const { return state_of_points(surface); }
};

void test_arap_deform()
{
  Fault_statistics statistics("arap_deform()");
  fault_test<Call>(statistics)("arap_deform()", [] { return std::make_unique<Call>(); }, {{
    "deform", [](Call& call) {
      const Scenario& fixed = call.surface.fixed;
      using Vertex = Mesh::Vertex_index;
      CGAL::ARAP::Options options;
      options.iterations = 3;
      return bool(CGAL::arap_deform(
        call.surface.mesh,
        boost::make_function_property_map<Vertex>([&](Vertex v) {
          return fixed.selection[v] != 1;
        }),
        boost::make_function_property_map<Vertex>([&](Vertex v) {
          return point(fixed.targets[v]);
        }), options));
    }}});
}

void test_drop_in_class()
{
  using Deformation = CGAL::ARAP::Surface_mesh_deformation<Mesh>;
  using Session_ = Drop_in_session<Deformation>;
  Fault_statistics statistics("Surface_mesh_deformation");
  test_drop_in_story(fault_test<Session_>(statistics), "drop-in class", [](Session_& s) {
    s.deformation.emplace(s.deformed.mesh);
    return true;
  });
}

// A vertex that could not be inserted is none that reset() writes.
void test_failed_insertion()
{
  test_case() = "a failed insertion";
  const Solid solid;
  const std::size_t v = 5;
  std::vector<Point> output(solid.points.size(), CGAL::ORIGIN);
  CGAL::ARAP_deformation<Solid::Domain> d(Solid::Domain(solid.points, solid.tetrahedra, output));
  for(std::size_t call = 0, faults = 1; faults > 0; ++call)
  {
    d.reset();
    CHECK(!d.is_control_vertex(v) && output[v] == CGAL::ORIGIN);
    allocation_faults.arm(call, false);
    try { d.insert_control_vertex(v); } catch(const std::bad_alloc&) {}
    faults = allocation_faults.disarm();
  }
  CHECK(d.is_control_vertex(v) && d.target_position(v) == solid.points[v]);
  d.reset();
  CHECK(output[v] == solid.points[v]);
}

// Constraints with which other cells count, which could not be taken, leave those before in force.
void test_cells_after_fault()
{
  test_case() = "cells that count after a fault";
  CGAL::ARAP::Report expected;
  std::size_t faults = 1;
  for(std::size_t call = 0; faults > 0; ++call)
  {
    Solid solid(block(6, 1, 1));
    const std::vector<Point> rest = solid.points;
    CGAL::ARAP_deformation<Solid::Domain> d(solid.domain());
    d.insert_roi_vertices(solid.vertices());
    d.insert_control_vertex(0);
    d.insert_control_vertex(rest.size() - 1, Point(6, 1, 2));
    const CGAL::ARAP::Report report = d.deform(2, 0);
    if(call == 0)
      expected = report;
    d.reset();
    CHECK(d.set_target_position(rest.size() - 1, Point(6, 1, 2)));
    for(std::size_t v = 1; v < rest.size(); ++v)
      if(rest[v].x() < 1.5)
        d.insert_control_vertex(v);
    allocation_faults.arm(call, false);
    try { [[maybe_unused]] const auto outcome = d.preprocess(); } catch(const std::bad_alloc&) {}
    faults = allocation_faults.disarm();
    for(std::size_t v = 1; v < rest.size(); ++v)
      if(rest[v].x() < 1.5)
        d.erase_control_vertex(v);
    const CGAL::ARAP::Report again = d.deform(2, 0);
    CHECK(!again.stages.region);
    CHECK_AT_MOST(std::abs(again.final_energy() / expected.final_energy() - 1), 1e-9);
  }
}

// points that allocate their coordinates
class Allocating_point
{
public:
  Allocating_point(double x, double y, double z) : m_coordinates{x, y, z} {}
  double operator[](int k) const { return m_coordinates[k]; }

private:
  std::vector<double> m_coordinates;
};

// The mesh here is what is embedded.
struct Embedding_session
{
  Solid solid;
  std::vector<Allocating_point> points = {{0.3, 0.2, 0.1}, {1.2, 0.3, 0.2}, {0.7, 0.1, 0.4}};
  std::optional<CGAL::ARAP::Embedding<Solid::Domain>> embedding;

  State state() const
  {
    State state;
    for(const Allocating_point& p : points)
      append_point(state.points, p);
    state.others.push_back(embedding ? double(embedding->size()) : -1);
    return state;
  }
};

#ifdef CGAL_ARAP_TEST_HAS_OWN_MALLOC
// CGAL's search tree loses a box where memory runs out while it is built.
extern "C" const char* __lsan_default_suppressions() { return "leak:CGAL::Kd_tree"; }
#endif

void test_embedding()
{
  using Step_ = Step<Embedding_session>;
  Fault_statistics statistics("Embedding");
  const Step_ bind = {"bind", [](Embedding_session& s) {
    s.embedding.emplace(s.solid.domain(), s.points);
    return bool(s.embedding->outcome());
  }};
  const Step_ put = {"put", [](Embedding_session& s) {
    for(std::size_t v = 0; v < s.solid.points.size(); ++v)
      s.solid.points[v] = point(s.solid.fixed.targets[v]);
    s.embedding->put_points(s.points);
    return true;
  }};
  fault_test<Embedding_session>(statistics)(
    "embedding", [] { return std::make_unique<Embedding_session>(); }, {bind, put});
}

int main()
{
  test_cell_schemes();
  test_solver<CGAL::ARAP::Eigen_LDLT_solver>("Eigen_LDLT_solver");
  test_solver<Single_precision_solver>("Single_precision_solver");
  test_many_weights();
  test_arap_deform();
  test_drop_in_class();
  test_embedding();
  test_failed_insertion();
  test_cells_after_fault();
  return faults_result();
}
