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

// Random shapes of triangles and tetrahedra, with random regions, handles, weights of targets and
// options: what holds for all of them. The seed of each is printed with what fails.
// usage: test_random_shapes [NUMBER_OF_SHAPES [FIRST_SEED]]

#include "include/nasty_shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;
using CGAL::ARAP::Visitor_action;

class Random
{
public:
  explicit Random(unsigned int seed) : m_engine(seed) {}

  double number(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(m_engine);
  }

  std::size_t index(std::size_t n)
  {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(m_engine);
  }

  Eigen::Vector3d vector()
  {
    const double x = number(-1, 1), y = number(-1, 1); // in the order of these lines everywhere
    return {x, y, number(-1, 1)};
  }

  Eigen::Isometry3d rigid_motion()
  {
    const double angle = number(-3, 3);
    const Eigen::Vector3d axis = vector() + Eigen::Vector3d(2, 0, 0);
    return ::rigid_motion(angle, axis, 3 * vector());
  }

  template <typename Range>
  void shuffle(Range& range) { std::shuffle(range.begin(), range.end(), m_engine); }

private:
  std::mt19937 m_engine;
};

// a vertex is in no region, free, or a control vertex with a target
struct Role
{
  bool is_roi = true, is_control = false;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double weight = std::numeric_limits<double>::infinity();
};

template <std::size_t N>
struct Problem
{
  Nasty_shape<N> shape;
  std::vector<Role> roles; // of the vertices
  Options options;
  double diameter;
};

// Triangles of a sheet or tetrahedra of a block, with some of them missing, and jittered by up to a
// fifth of their size. Those who look for worse shapes find them in test_nasty_shapes.
template <std::size_t N>
Problem<N> random_problem(Random& random)
{
  Problem<N> problem;
  if constexpr(N == 3)
    problem.shape = sheet_of(4 + int(random.index(6)), 3 + int(random.index(5)));
  else
    problem.shape = block_of(2 + int(random.index(3)), 1 + int(random.index(3)), 2);
  auto& points = problem.shape.points;
  auto& simplices = problem.shape.simplices;
  const double size = (points[simplices[0][1]] - points[simplices[0][0]]).norm();
  for(auto& p : points)
    p += 0.2 * size * random.vector();
  random.shuffle(simplices);
  simplices.resize(simplices.size() - random.index(simplices.size() / 4));

  problem.diameter = diameter_of(points);
  for(const auto& p : points)
  {
    Role role;
    switch(random.index(6))
    {
    case 0: role.is_roi = false; break;
    case 1:
      role.is_control = true;
      if(random.index(2) == 0)
        role.weight = std::pow(10, random.number(-2, 3));
    }
    role.target = p + 0.1 * problem.diameter * random.vector();
    problem.roles.push_back(role);
  }
  for(std::size_t corner : {0, 1}) // there is something to hold on to
    problem.roles[simplices[0][corner]] = {true, true, points[simplices[0][corner]]};
  problem.options.cells = all_cell_schemes[random.index(3)];
  problem.options.minimizer = random.index(2) ? Minimizer::local_global : Minimizer::quasi_newton;
  problem.options.initial_guess = random.index(2) ? Initial_guess::previous
                                                  : Initial_guess::laplacian;
  problem.options.iterations = 10;
  problem.options.tolerance = 0;
  return problem;
}

template <std::size_t N>
class Random_test
{
  using Simplices = std::vector<std::array<std::size_t, N>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<int(N) - 1, std::vector<Point>, Simplices>;
  using Deformation = CGAL::ARAP_deformation<Domain>;

  // a problem with its points, and what deforms them
  struct Session
  {
    const Problem<N> problem;
    std::vector<Point> points;
    Deformation deformation;

    explicit Session(const Problem<N>& p)
      : problem(p), points(points_of(p.shape.points)),
        deformation(Domain(points, problem.shape.simplices))
    {
      CHECK(deformation.set_options(problem.options));
      for(std::size_t v = 0; v < points.size(); ++v)
      {
        const Role& role = problem.roles[v];
        if(role.is_roi)
          deformation.insert_roi_vertex(v);
        if(!role.is_control)
          continue;
        deformation.insert_control_vertex(v);
        CHECK(deformation.set_target_position(v, point(role.target)));
        CHECK(deformation.set_target_weight(v, role.weight));
      }
    }

    Session(const Session&) = delete;
  };

public:
  explicit Random_test(unsigned int seed) : m_random(seed), m_problem(random_problem<N>(m_random))
  {}

  void operator()()
  {
    Session session(m_problem);
    check_cancelled(session);
    const Report report = session.deformation.deform();
    if(!CHECK(report))
    {
      std::cerr << "    " << report.message << std::endl;
      return;
    }
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK(report.energy.back() >= -1e-14 * report.energy_scale);
    CHECK(report.energy.back() == session.deformation.energy());
    check_fixed(session);
    check_rotations(session);
    check_again(session, report);
    check_moved(session, report);
    check_reordered(session, report);
    check_rigid_targets();
  }

private:
  // What a visitor cancels has not been.
  void check_cancelled(Session& session)
  {
    const std::vector<Point> before = session.points;
    const std::size_t last = m_random.index(5);
    const Report report = session.deformation.deform([&](const auto& iterate) {
      return iterate.iteration() == last ? Visitor_action::cancel : Visitor_action::proceed;
    });
    CHECK(report.status == Status::cancelled);
    CHECK(session.points == before);
  }

  // Control vertices are at hard targets, and what is in no region or no simplex is where it was.
  void check_fixed(const Session& session)
  {
    std::vector<char> is_used(session.points.size(), false);
    for(const auto& simplex : m_problem.shape.simplices)
      for(std::size_t corner : simplex)
        is_used[corner] = true;
    for(std::size_t v = 0; v < session.points.size(); ++v)
    {
      const Role& role = m_problem.roles[v];
      if(role.is_control && !std::isfinite(role.weight))
        CHECK(session.points[v] == point(role.target));
      else if(!role.is_roi || (!is_used[v] && !role.is_control))
        CHECK(session.points[v] == point(m_problem.shape.points[v]));
    }
  }

  void check_rotations(const Session& session)
  {
    const bool has_vertex_cells = m_problem.options.cells.has_vertex_cells();
    const std::size_t n = has_vertex_cells ? session.points.size()
                                           : m_problem.shape.simplices.size();
    for(std::size_t k = 0; k < n; ++k)
      CHECK(CGAL::ARAP::is_rotation(has_vertex_cells ? session.deformation.rotation(k)
                                                     : session.deformation.simplex_rotation(k)));
  }

  // The same has the same bits.
  void check_again(const Session& session, const Report& report)
  {
    Session again(m_problem);
    CHECK(again.deformation.deform().energy == report.energy);
    CHECK(again.points == session.points);
  }

  // A rigid motion of the rest shape and the targets moves the result.
  void check_moved(const Session& session, const Report& report)
  {
    const Eigen::Isometry3d motion = m_random.rigid_motion();
    Problem<N> problem = m_problem;
    for(auto& p : problem.shape.points)
      p = motion * p;
    for(Role& role : problem.roles)
      role.target = motion * role.target;
    Session moved(problem);
    check_energies(moved.deformation.deform(), report);
    for(std::size_t v = 0; v < session.points.size(); ++v)
      CHECK_AT_MOST((vector(moved.points[v]) - motion * vector(session.points[v])).norm(),
                    accuracy() * m_problem.diameter);
  }

  // Vertices, simplices and corners in another order give the same.
  void check_reordered(const Session& session, const Report& report)
  {
    std::vector<std::size_t> places = numbers(session.points.size());
    m_random.shuffle(places);
    Problem<N> problem = m_problem;
    for(std::size_t v = 0; v < places.size(); ++v)
    {
      problem.shape.points[places[v]] = m_problem.shape.points[v];
      problem.roles[places[v]] = m_problem.roles[v];
    }
    for(auto& simplex : problem.shape.simplices)
    {
      for(std::size_t& corner : simplex)
        corner = places[corner];
      m_random.shuffle(simplex);
    }
    m_random.shuffle(problem.shape.simplices);
    Session reordered(problem);
    check_energies(reordered.deformation.deform(), report);
    for(std::size_t v = 0; v < places.size(); ++v)
      CHECK_AT_MOST((vector(reordered.points[places[v]]) - vector(session.points[v])).norm(),
                    accuracy() * m_problem.diameter);
  }

  // A guess that is a rigid motion of the rest shape, and targets that agree with it: there it
  // stays, at energy zero.
  void check_rigid_targets()
  {
    const Eigen::Isometry3d motion = m_random.rigid_motion();
    Problem<N> problem = m_problem;
    problem.options.initial_guess = Initial_guess::previous;
    for(std::size_t v = 0; v < problem.roles.size(); ++v)
      problem.roles[v] = {true, true, motion * problem.shape.points[v]};
    Session session(problem);
    CHECK(session.deformation.deform());
    for(std::size_t v = 0; v < problem.roles.size(); ++v)
      if(!m_problem.roles[v].is_control)
        session.deformation.erase_control_vertex(v);
      else
        CHECK(session.deformation.set_target_weight(v, m_problem.roles[v].weight));
    const Report report = session.deformation.deform();
    CHECK(report);
    for(double energy : report.energy)
      CHECK_AT_MOST(energy, 1e-14 * report.energy_scale);
    for(std::size_t v = 0; v < session.points.size(); ++v)
      CHECK_AT_MOST((vector(session.points[v]) - motion * problem.shape.points[v]).norm(),
                    1e-9 * m_problem.diameter);
  }

  // The memory of the quasi-Newton method is in single precision.
  double accuracy() const
  {
    return m_problem.options.minimizer == Minimizer::local_global ? 1e-8 : 1e-3;
  }

  void check_energies(const Report& report, const Report& expected)
  {
    if(!CHECK(report.energy.size() == expected.energy.size()))
      return;
    for(std::size_t k = 0; k < report.energy.size(); ++k)
      CHECK_AT_MOST(std::abs(report.energy[k] - expected.energy[k]),
                    accuracy() * expected.energy[0] + 1e-14 * expected.energy_scale);
  }

  Random m_random;
  const Problem<N> m_problem;
};

int main(int argc, char* argv[])
{
  const int number_of_shapes = argc > 1 ? std::atoi(argv[1]) : 200;
  const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
  for(int seed = first_seed; seed < first_seed + number_of_shapes; ++seed)
  {
    test_case() = "surface, seed " + std::to_string(seed);
    Random_test<3>(static_cast<unsigned int>(seed))();
    test_case() = "volume, seed " + std::to_string(seed);
    Random_test<4>(static_cast<unsigned int>(seed))();
  }
  std::cout << "surfaces and volumes with seeds " << first_seed << " to "
            << first_seed + number_of_shapes - 1 << std::endl;
  return checks_result();
}
