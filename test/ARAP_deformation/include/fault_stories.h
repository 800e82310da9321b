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

#ifndef CGAL_ARAP_DEFORMATION_TEST_FAULT_STORIES_H
#define CGAL_ARAP_DEFORMATION_TEST_FAULT_STORIES_H

// What is done with a CGAL::ARAP_deformation, and with the class that replaces CGAL's own, while
// things fail, on a small surface or solid.

#include "domains.h"
#include "faults.h"
#include "shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/Surface_mesh_deformation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

inline Shape small_sheet(int nu = 5, int nv = 3)
{
  return grid("sheet", nu, nv, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.2 * std::sin(5 * u) * std::cos(3 * v));
  });
}

// a mesh with its domain, and where its vertices are fixed
struct Surface
{
  using Domain = CGAL::ARAP::Face_graph_domain<Mesh>;

  Mesh mesh;
  Scenario fixed;

  Surface() : Surface(small_sheet()) {}
  explicit Surface(const Shape& shape)
    : mesh(make_mesh<Mesh>(shape)), fixed(scenario(shape))
  {}

  Domain domain() { return Domain(mesh); }
  std::vector<Mesh::Vertex_index> vertices() const { return all_vertices(mesh); }
  const Point& point(Mesh::Vertex_index v) const { return mesh.point(v); }
};

struct Solid
{
  using Tetrahedra = std::vector<std::array<std::size_t, 4>>;
  using Domain = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, Tetrahedra>;

  std::vector<Point> points;
  Tetrahedra tetrahedra;
  Scenario fixed;

  Solid() : Solid(block(3, 1, 1)) {}
  explicit Solid(const Block& b)
    : points(points_of(b.points)), tetrahedra(b.tetrahedra), fixed(scenario(b))
  {}

  Domain domain() { return Domain(points, tetrahedra); }
  std::vector<std::size_t> vertices() const { return numbers(points.size()); }
  const Point& point(std::size_t v) const { return points[v]; }
};

// what can be seen of a mesh alone
template <typename Deformed>
State state_of_points(const Deformed& deformed)
{
  State state;
  for(const auto v : deformed.vertices())
    append_point(state.points, deformed.point(v));
  return state;
}

template <typename Deformed_, typename Traits_ = CGAL::Default,
          typename Domain_ = typename Deformed_::Domain>
struct Session
{
  using Deformation = CGAL::ARAP_deformation<Domain_, Traits_>;
  using Traits = typename Deformation::Deformation_traits;

  Deformed_ deformed;
  Traits traits;
  std::optional<Deformation> deformation;
  std::optional<typename Deformation::State> kept;

  explicit Session(const Traits& t = Traits(), const Deformed_& d = Deformed_())
    : deformed(d), traits(t)
  {}

  State state() const
  {
    State state = state_of_points(deformed);
    if(!deformation)
      return state;
    const Deformation& d = *deformation;
    append_sets_and_targets(state.others, d, deformed.vertices());
    for(const auto v : d.control_vertices())
      state.others.push_back(d.target_weight(v));
    for(const auto p : d.control_points())
    {
      append_point(state.others, d.target_position(p));
      state.others.push_back(d.target_weight(p));
    }
    const CGAL::ARAP::Options& options = d.options();
    state.others.insert(state.others.end(), {d.energy(), double(options.iterations),
                                             double(options.cells == Cell_scheme::spokes()),
                                             double(options.cells == Cell_scheme::elements())});
    return state;
  }
};

// The steps that stories are made of.
template <typename Session>
struct Steps
{
  using Step_ = Step<Session>;

  static Step_ construct()
  {
    return {"construct", [](Session& s) {
      using Domain = typename Session::Deformation::Deformation_domain;
      s.deformation.emplace(Domain(s.deformed.domain()), s.traits);
      return true;
    }};
  }

  static Step_ insert()
  {
    return {"insert vertices", [](Session& s) {
      prepare(*s.deformation, s.deformed.fixed, s.deformed.vertices());
      return true;
    }, false};
  }

  static Step_ set_options(Cell_scheme cells, CGAL::ARAP::Minimizer minimizer,
                           CGAL::ARAP::Initial_guess guess)
  {
    CGAL::ARAP::Options options = options_for(cells, minimizer, guess);
    options.iterations = 3;
    options.tolerance = 0;
    return {"set options", [options](Session& s) {
      return bool(s.deformation->set_options(options));
    }};
  }

  static Step_ preprocess()
  {
    return {"preprocess", [](Session& s) { return bool(s.deformation->preprocess()); }};
  }

  static Step_ deform(const std::string& how = "")
  {
    return {"deform" + how, [](Session& s) { return bool(s.deformation->deform()); }};
  }

  // the first handle becomes free, and a free vertex a handle
  static Step_ change_control_vertices()
  {
    return {"change control vertices", [](Session& s) {
      const auto vertices = s.deformed.vertices();
      for(int selected : {1, 2})
      {
        std::size_t k = 0;
        while(s.deformed.fixed.selection[k] != selected)
          ++k;
        if(selected == 1)
          s.deformation->insert_control_vertex(vertices[k]);
        else
          s.deformation->erase_control_vertex(vertices[k]);
      }
      return true;
    }, false};
  }

  // of at most the first n control vertices
  static Step_ set_weights(double weight, std::size_t n)
  {
    return {"set weights of targets", [weight, n](Session& s) {
      auto controls = s.deformation->control_vertices();
      controls.resize((std::min)(n, controls.size()), controls.front());
      return bool(s.deformation->set_target_weight(controls, weight));
    }, false};
  }

  // in the first simplex at the first free vertex
  static Step_ insert_control_point()
  {
    return {"insert a control point", [](Session& s) {
      std::size_t k = 0;
      while(s.deformed.fixed.selection[k] != 1)
        ++k;
      const auto domain = s.deformed.domain();
      std::optional<typename Session::Deformation::simplex_descriptor> first;
      std::vector<double> coordinates;
      domain.for_each_incident_simplex(
        s.deformed.vertices()[k], [&](const auto& simplex, const auto& corners) {
          first = simplex;
          const auto n = std::distance(std::begin(corners), std::end(corners));
          coordinates.assign(std::size_t(n), 1 / double(n));
        });
      s.deformation->clear_control_points(); // of an attempt that failed after its insertion
      const auto inserted = s.deformation->insert_control_point(*first, coordinates);
      return inserted && s.deformation->translate(inserted.point, Eigen::Vector3d(0, 0, 0.1));
    }, false};
  }

  // stiffness, groups, a frame, bending and smooth rotations
  static Step_ set_terms()
  {
    return {"set terms", [](Session& s) {
      using Vertex = typename Session::Deformation::vertex_descriptor;
      auto& d = *s.deformation;
      d.set_stiffness([](Vertex v) { return 1 + double(std::size_t(v) % 3); });
      d.set_groups([](Vertex v) { return std::size_t(v) < 3 ? 0 : -1; });
      CGAL::ARAP::Options options = d.options();
      options.bending_length = options.smoothing_length = 0.1;
      const Eigen::AngleAxisd turn(0.3, Eigen::Vector3d::UnitX());
      return d.set_options(options) &&
             d.set_target_rotation(d.control_vertices().front(), turn.toRotationMatrix());
    }, false};
  }

  // of the first control vertex
  static Step_ set_target_set()
  {
    return {"set a target that is a set", [](Session& s) {
      auto& d = *s.deformation;
      const auto v = d.control_vertices().front();
      return d.set_target_weight(v, 2) &&
             d.set_target_set(v, [](const Point& p) { return Point(p.x(), p.y(), 0.5); });
    }, false};
  }

  static Step_ advance()
  {
    return {"advance", [](Session& s) {
      return bool(s.deformation->advance(CGAL::ARAP::Dynamics()));
    }};
  }

  static Step_ keep_state()
  {
    return {"keep the state", [](Session& s) {
      s.kept.emplace(s.deformation->state());
      return true;
    }};
  }

  static Step_ restore()
  {
    return {"restore the state", [](Session& s) {
      return bool(s.deformation->restore(*s.kept));
    }};
  }

  static Step_ overwrite()
  {
    return {"overwrite the rest shape", [](Session& s) {
      s.deformation->overwrite_initial_geometry();
      return true;
    }};
  }

  static Step_ reset()
  {
    return {"reset", [](Session& s) {
      s.deformation->reset();
      return true;
    }};
  }
};

// Everything that fails with `faults` in two stories: of what is done first, by each minimizer and
// from each initial guess, and of what is done when vertices, weights and the rest shape change.
template <typename Session>
void test_stories(Fault_test<Session> test, const std::string& name, Cell_scheme cells,
                  const typename Session::Traits& traits = typename Session::Traits())
{
  using S = Steps<Session>;
  using CGAL::ARAP::Initial_guess;
  using CGAL::ARAP::Minimizer;
  const auto make = [&traits] { return std::make_unique<Session>(traits); };
  const auto start = S::set_options(cells, Minimizer::local_global, Initial_guess::previous);
  test(name, make,
       {S::construct(), S::insert(), start, S::preprocess(), S::deform(),
        S::set_options(cells, Minimizer::quasi_newton, Initial_guess::laplacian),
        S::deform(" from the Laplacian guess")});
  test(name, make,
       {S::construct(), S::insert(), start, S::deform(), S::change_control_vertices(),
        S::deform(" with other control vertices"), S::set_weights(2, 3),
        S::deform(" with soft targets"), S::insert_control_point(),
        S::deform(" with a control point"), S::overwrite(), S::deform(" again"), S::reset(),
        S::deform(" after a reset")}, 4);
}

// The same for all that the energy can have, and for time steps.
template <typename Session>
void test_story_of_terms(Fault_test<Session> test, const std::string& name)
{
  using S = Steps<Session>;
  test(name, [] { return std::make_unique<Session>(); },
       {S::construct(), S::insert(),
        S::set_options(Cell_scheme::spokes_and_rims(), CGAL::ARAP::Minimizer::local_global,
                       CGAL::ARAP::Initial_guess::previous),
        S::set_terms(), S::deform(" with all terms"), S::set_target_set(),
        S::deform(" with a set"), S::advance()}, 3);
}

// The same for the return to a state with another region, other control vertices and rest shape.
template <typename Session>
void test_story_of_undo(Fault_test<Session> test, const std::string& name)
{
  using S = Steps<Session>;
  test(name, [] { return std::make_unique<Session>(); },
       {S::construct(), S::insert(),
        S::set_options(Cell_scheme::spokes_and_rims(), CGAL::ARAP::Minimizer::local_global,
                       CGAL::ARAP::Initial_guess::previous),
        S::deform(), S::keep_state(), S::overwrite(), S::change_control_vertices(),
        S::insert_control_point(), S::deform(" otherwise"), S::restore(),
        S::deform(" after the return")}, 9);
}

// with the class that replaces CGAL's
template <typename Deformation_>
struct Drop_in_session
{
  using Deformation = Deformation_;

  Surface deformed;
  std::optional<Deformation> deformation;

  State state() const
  {
    State state = state_of_points(deformed);
    if(deformation)
      append_sets_and_targets(state.others, *deformation, deformed.vertices());
    return state;
  }

  // the k-th of the vertices that are free at first
  Mesh::Vertex_index free_vertex(std::size_t k) const
  {
    const auto vertices = deformed.vertices();
    auto v = vertices.begin();
    while(deformed.fixed.selection[*v] != 1 || k-- > 0)
      ++v;
    return *v;
  }
};

// The same for that class, which `construct` constructs.
template <typename Session, typename Function>
void test_drop_in_story(Fault_test<Session> test, const std::string& name,
                        const Function& construct)
{
  using S = Steps<Session>;
  const Step<Session> change = {"change vertices", [](Session& s) {
    s.deformation->erase_roi_vertex(s.free_vertex(0));
    s.deformation->insert_control_vertex(s.free_vertex(3));
    return true;
  }, false};
  const Step<Session> change_back = {"change vertices back", [](Session& s) {
    s.deformation->insert_roi_vertex(s.free_vertex(0));
    s.deformation->erase_control_vertex(s.free_vertex(3));
    return true;
  }, false};
  const Step<Session> translate = {"translate", [](Session& s) {
    return bool(s.deformation->translate(s.free_vertex(3), Kernel::Vector_3(0.1, 0.2, 0.3)));
  }};
  test(name, [] { return std::make_unique<Session>(); },
       {{"construct", construct}, S::insert(), S::preprocess(), S::deform(), change,
        S::deform(" with other vertices"), translate, S::deform(" to another target"),
        S::overwrite(), change_back, S::deform(" again"), S::reset(), S::deform(" after a reset")});
}

#endif // CGAL_ARAP_DEFORMATION_TEST_FAULT_STORIES_H
