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

#ifndef CGAL_ARAP_DEFORMATION_TEST_FAULTS_H
#define CGAL_ARAP_DEFORMATION_TEST_FAULTS_H

// Faults on purpose: each call of a kind, in one thing after another that is done with an object,
// is made to fail. What fails must change nothing, and must succeed when it is done again.

#include "check.h"
#include "length.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

// Which calls of one kind are to fail. What can fail asks it at each call.
class Faults
{
public:
  // From now on call `first` fails, counted from 0, or all from it on.
  void arm(std::size_t first, bool are_all_after)
  {
    m_first = first;
    m_are_all_after = are_all_after;
    m_calls = m_faults = 0;
    m_is_armed = true;
  }

  // ends this, and returns how many have failed
  std::size_t disarm()
  {
    m_is_armed = false;
    return m_faults;
  }

  // whether the call that asks is to fail
  bool is_hit()
  {
    if(!m_is_armed)
      return false;
    const std::size_t call = m_calls++;
    const bool fails = call == m_first || (m_are_all_after && call > m_first);
    m_faults += fails;
    return fails;
  }

private:
  bool m_is_armed = false, m_are_all_after = false;
  std::size_t m_first = 0, m_calls = 0, m_faults = 0;
};

// what is thrown by what is not an allocation
struct Fault {};

// What can be seen of a mesh and of an object that works on it, as numbers.
struct State
{
  std::vector<double> points, others;
};

inline bool are_same_bits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline bool are_close(const std::vector<double>& a, const std::vector<double>& b)
{
  const auto is_close = [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y)) ||
           std::abs(x - y) <= 1e-10 * (1 + std::abs(x));
  };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), is_close);
}

template <typename Point>
void append_point(std::vector<double>& numbers, const Point& p)
{
  for(int k = 0; k < 3; ++k)
    numbers.push_back(p[k]);
}

// What can be seen of a deformation, of any of the two classes, but for its points.
template <typename Deformation, typename Vertices>
void append_sets_and_targets(std::vector<double>& numbers, const Deformation& d,
                             const Vertices& vertices)
{
  for(const auto v : d.roi_vertices())
    numbers.push_back(static_cast<double>(std::size_t(v)));
  for(const auto v : vertices)
    if(d.is_control_vertex(v))
    {
      numbers.push_back(static_cast<double>(std::size_t(v)));
      append_point(numbers, d.target_position(v));
    }
}

// One thing that is done with a session, which is a mesh and an object that works on it.
template <typename Session>
struct Step
{
  std::string name;
  std::function<bool(Session&)> run; // returns whether it succeeded
  // of what is done vertex by vertex a part is done when it fails; the mesh is as it was then too
  bool is_atomic = true;
};

inline std::size_t& number_of_faults() { static std::size_t n = 0; return n; }

// Counts what became of the faults of a kind, and prints it in the end.
class Fault_statistics
{
public:
  explicit Fault_statistics(std::string kind) : m_kind(std::move(kind)) {}

  void add(bool is_done, bool has_thrown)
  {
    ++(has_thrown ? m_exceptions : is_done ? m_survived : m_refusals);
  }

  ~Fault_statistics()
  {
    const std::size_t n = m_exceptions + m_refusals + m_survived;
    CHECK(n > 0);
    number_of_faults() += n;
    std::cout << m_kind << ": " << n << " faults: " << m_exceptions << " exceptions, " << m_refusals
              << " statuses, " << m_survived << " successes all the same" << std::endl;
  }

private:
  std::string m_kind;
  std::size_t m_exceptions = 0, m_refusals = 0, m_survived = 0;
};

// Makes each call of a kind (in a short run every 17th) fail in each step of a story, from step
// `first_step` on.
template <typename Session>
class Fault_test
{
public:
  using Make_session = std::function<std::unique_ptr<Session>()>;

  // `is_mesh_written_whole`: unless it is the writing of the points that fails
  Fault_test(Faults& faults, Fault_statistics& statistics, bool is_mesh_written_whole = true)
    : m_faults(faults), m_statistics(statistics), m_is_mesh_written_whole(is_mesh_written_whole)
  {}

  void operator()(const std::string& name, const Make_session& make,
                  const std::vector<Step<Session>>& steps, std::size_t first_step = 0)
  {
    test_case() = name + ", without faults";
    std::vector<State> expected; // which also initializes what is static
    const std::unique_ptr<Session> faultless = make();
    for(const Step<Session>& step : steps)
    {
      CHECK(step.run(*faultless));
      expected.push_back(faultless->state());
    }
    const auto session_at = [&](std::size_t k) {
      std::unique_ptr<Session> session = make();
      for(std::size_t before = 0; before < k; ++before)
        CHECK(steps[before].run(*session));
      return session;
    };
    const auto end_after = [&](std::size_t k) { return (std::min)(k + 3, steps.size()); };
    const auto state_after = [&](Session& session, std::size_t k) {
      for(std::size_t next = k + 1; next < end_after(k); ++next)
        CHECK(steps[next].run(session));
      return session.state();
    };
    // what comes next is as it is without a fault
    const auto check_further = [&](Session& session, std::size_t k) {
      check_close(session.state(), expected[k]);
      check_close(state_after(session, k), expected[end_after(k) - 1]);
    };
    for(std::size_t k = first_step; k < steps.size(); ++k)
    {
      const Step<Session>& step = steps[k];
      const std::string what = name + ", " + step.name;
      for(bool are_all_after : {false, true})
        for(std::size_t call = 0;; call += m_stride)
        {
          const std::unique_ptr<Session> session = session_at(k);
          test_case() = what + ", call " + std::to_string(call) + (are_all_after ? " and all" : "");
          const Result result = attempt(*session, step, call, are_all_after);
          if(result == no_fault)
            break;
          if(result == failed)
            CHECK(step.run(*session));
          check_further(*session, k);
        }
      if(step.is_atomic && m_is_mesh_written_whole && k > 0)
      {
        // what fails and is not done again is as if it had never been tried
        const State skipped = state_after(*session_at(k), k);
        for(std::size_t call = 0;; call += m_stride)
        {
          const std::unique_ptr<Session> session = session_at(k);
          test_case() = what + ", skipped at call " + std::to_string(call);
          const Result result = attempt(*session, step, call, false);
          if(result == no_fault)
            break;
          if(result == failed)
            check_close(state_after(*session, k), skipped);
        }
      }
      const std::unique_ptr<Session> session = session_at(k); // fails again and again
      for(std::size_t call = 0;; call += m_stride)
      {
        test_case() = what + ", calls to " + std::to_string(call);
        if(attempt(*session, step, call, false) != failed)
          break;
      }
      check_further(*session, k);
    }
  }

private:
  enum Result { no_fault, failed, survived };

  Result attempt(Session& session, const Step<Session>& step, std::size_t call, bool are_all_after)
  {
    const State before = session.state();
    bool is_done = false, has_thrown = false;
    m_faults.arm(call, are_all_after);
    try
    {
      is_done = step.run(session);
    }
    catch(const std::bad_alloc&) { has_thrown = true; }
    catch(const Fault&) { has_thrown = true; }
    const bool is_hit = m_faults.disarm() > 0;
    if(is_hit)
      m_statistics.add(is_done, has_thrown);
    if(is_done)
      return is_hit ? survived : no_fault;
    if(!CHECK(is_hit)) // or it would never end
      return no_fault;
    const State after = session.state();
    if(m_is_mesh_written_whole)
      CHECK(are_same_bits(after.points, before.points));
    if(step.is_atomic)
      CHECK(are_same_bits(after.others, before.others));
    return failed;
  }

  static void check_close(const State& state, const State& expected)
  {
    CHECK(are_close(state.points, expected.points));
    CHECK(are_close(state.others, expected.others));
  }

  Faults& m_faults;
  Fault_statistics& m_statistics;
  bool m_is_mesh_written_whole;
  std::size_t m_stride = is_long_run() ? 1 : 17;
};

inline int faults_result()
{
  std::cout << number_of_faults() << " faults in all" << std::endl;
  CHECK(number_of_faults() > 0);
  return checks_result();
}

#endif // CGAL_ARAP_DEFORMATION_TEST_FAULTS_H
