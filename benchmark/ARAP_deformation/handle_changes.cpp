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

// The time until a session is ready again after some of its control vertices were replaced by
// others, compared with full preprocessing and with CGAL's Surface_mesh_deformation.

#include "include/deformations.h"
#include "include/run_benchmark.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace benchmark;

const std::ptrdiff_t number_of_changes = 100; // half of them erased, half of them inserted

// Two sets of vertices, one of which is controlled at a time: the control vertices next to the free
// vertices, and the free vertices next to those.
struct Exchange
{
  std::vector<vertex_descriptor> first, second;
};

Exchange make_exchange(const Scenario& scenario)
{
  const Twist twist(bounding_box(scenario.mesh));
  std::vector<vertex_descriptor> all(vertices(scenario.mesh).begin(),
                                     vertices(scenario.mesh).end());
  const auto height = [&](vertex_descriptor v) { return scenario.mesh.point(v)[twist.axis()]; };
  std::sort(all.begin(), all.end(), [&](vertex_descriptor a, vertex_descriptor b) {
    return height(a) < height(b);
  });
  const auto first_of_handle = std::find_if(all.begin(), all.end(), [&](vertex_descriptor v) {
    return twist.is_handle(to_vector(scenario.mesh.point(v)));
  });
  const std::ptrdiff_t n = number_of_changes / 2;
  if(all.end() - first_of_handle <= n ||
     scenario.number_of_free_vertices() < static_cast<std::size_t>(n))
    throw Failure("the mesh is too small to change " + std::to_string(number_of_changes) +
                  " control vertices");
  return {{first_of_handle, first_of_handle + n}, {first_of_handle - n, first_of_handle}};
}

// Erases the control vertices of one set and inserts those of the other; returns the seconds until
// all is preprocessed.
template <typename Deformation>
double exchange(Deformation& deformation, const std::vector<vertex_descriptor>& erased,
                const std::vector<vertex_descriptor>& inserted)
{
  const Stopwatch stopwatch;
  for(vertex_descriptor v : erased)
    deformation.deformation().erase_control_vertex(v);
  deformation.deformation().insert_control_vertices(inserted.begin(), inserted.end());
  deformation.preprocess();
  return stopwatch.seconds();
}

// The targets of `scenario`; the second set stays where it is when controlled.
Scenario scenario_after(const Scenario& scenario, const Exchange& sets)
{
  Scenario result = scenario;
  auto& targets = result.targets;
  targets.erase(std::remove_if(targets.begin(), targets.end(), [&](const auto& target) {
    return std::find(sets.first.begin(), sets.first.end(), target.first) != sets.first.end();
  }), targets.end());
  for(vertex_descriptor v : sets.second)
    targets.emplace_back(v, result.mesh.point(v));
  return result;
}

// Fails unless a changed session deforms as a new one does; returns the largest difference.
double verify_exchange(const Scenario& scenario, const Exchange& sets)
{
  const unsigned int iterations = 5;
  const Scenario after = scenario_after(scenario, sets);
  Our_deformation<Default_traits> changed(scenario), fresh(after);
  changed.run(iterations);
  exchange(changed, sets.first, sets.second);
  restart(after, changed.deformation());
  changed.proceed(iterations);
  fresh.run(iterations);
  const double difference = largest_distance(changed.mesh(), fresh.mesh()) / scenario.diagonal;
  verify_at_most(difference, 1e-9, "the difference between a session with changed control vertices "
                                   "and a new one, relative to the bounding box,");
  return difference;
}

struct Seconds
{
  std::vector<double> full, change;

  template <typename Deformation>
  void measure(Deformation& deformation, const Exchange& sets)
  {
    full.push_back(deformation.preprocess_seconds());
    change.push_back(exchange(deformation, sets.first, sets.second));
  }
};

Json run(const Settings& settings)
{
  const Mesh mesh = read_mesh(settings.file_or("armadillo.off"));
  Json section = make_section(
    "Other control vertices in the same region",
    "Milliseconds for full preprocessing, and after " + std::to_string(number_of_changes) +
    " vertices were changed: half were control vertices before, the other half are now.",
    {{"vertices", "vertices"}, {"threads", "threads"}, {"full_ms", "full preprocessing"},
     {"change_ms", "after a change"}, {"ratio", "full / change"},
     {"cgal_full_ms", "CGAL, full"}, {"cgal_change_ms", "CGAL, after a change"},
     {"cgal_ratio", "CGAL / ours, change"}});
  for(unsigned int parts : settings.quick ? std::vector<unsigned int>{1}
                                          : std::vector<unsigned int>{1, 2, 4})
  {
    const Scenario scenario = make_scenario(subdivided(mesh, parts));
    const Exchange sets = make_exchange(scenario);
    const double difference = verify_exchange(scenario, sets);
    std::vector<Seconds> ours(thread_counts().size());
    Seconds cgal;
    for(unsigned int repetition = 0; repetition < settings.few_repetitions; ++repetition)
    {
      for(std::size_t k = 0; k < ours.size(); ++k)
      {
        const Thread_limit limit(thread_counts()[k]);
        Our_deformation<Default_traits> deformation(scenario);
        ours[k].measure(deformation, sets);
      }
      Cgal_deformation<CGAL::ORIGINAL_ARAP> deformation(scenario);
      cgal.measure(deformation, sets);
    }
    for(std::size_t k = 0; k < ours.size(); ++k)
      section["rows"].push_back({{"vertices", scenario.number_of_vertices()},
                                 {"threads", thread_counts()[k]},
                                 {"full_ms", 1e3 * median(ours[k].full)},
                                 {"change_ms", 1e3 * median(ours[k].change)},
                                 {"ratio", median(ours[k].full) / median(ours[k].change)},
                                 {"cgal_full_ms", 1e3 * median(cgal.full)},
                                 {"cgal_change_ms", 1e3 * median(cgal.change)},
                                 {"cgal_ratio", median(cgal.change) / median(ours[k].change)},
                                 {"largest_difference", difference}});
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "handle_changes",
                       "usage: handle_changes [options]\n\n"
                       "Measures the preprocessing after some control vertices were changed.", run);
}
