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

// Frames per second while a handle is dragged, with three iterations per frame, compared with
// CGAL's Surface_mesh_deformation.

#include "include/deformations.h"
#include "include/run_benchmark.h"
#include "include/star_energy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace benchmark;

// Drags the handle of a mesh: it moves in a circle and turns back and forth.
class Drag
{
public:
  explicit Drag(const Scenario& scenario)
    : m_scenario(scenario), m_size(0.1 * scenario.diagonal)
  {
    for(const auto& [v, target] : scenario.targets)
      if(scenario.mesh.point(v) != target) // those of the twist that do not stay
        m_handle.push_back(v);
    for(vertex_descriptor v : m_handle)
      m_center += to_vector(scenario.mesh.point(v)) / static_cast<double>(m_handle.size());
  }

  // Sets the targets of a frame.
  template <typename Deformation>
  void operator()(unsigned int frame, Deformation& deformation) const
  {
    const double t = frame * 0.02;
    const Eigen::Vector3d shift =
      m_size * Eigen::Vector3d(std::sin(t), 1 - std::cos(t), std::sin(2 * t) / 2);
    const Eigen::AngleAxisd turn(0.5 * std::sin(t), Eigen::Vector3d(1, 1, 1).normalized());
    for(vertex_descriptor v : m_handle)
    {
      const Eigen::Vector3d p = to_vector(m_scenario.mesh.point(v));
      deformation.set_target_position(v, to_point(m_center + turn * (p - m_center) + shift));
    }
  }

private:
  const Scenario& m_scenario;
  double m_size;
  std::vector<vertex_descriptor> m_handle;
  Eigen::Vector3d m_center = Eigen::Vector3d::Zero();
};

// adds the seconds of each frame: targets and three iterations
template <typename Deformation>
void measure_frames(const Drag& drag, Deformation& deformation, unsigned int frames,
                    std::vector<double>& seconds)
{
  deformation.deformation().reset();
  for(unsigned int frame = 0; frame < frames; ++frame)
  {
    const Stopwatch stopwatch;
    drag(frame, deformation.deformation());
    deformation.proceed(3);
    seconds.push_back(stopwatch.seconds());
  }
}

// The iterates of the two classes differ, because their steps are in another order. Fails unless
// both converge to the same minimum after a drag.
void verify_drag(const Scenario& scenario, const Drag& drag)
{
  Our_deformation<Default_traits> ours(scenario);
  Cgal_deformation<CGAL::ORIGINAL_ARAP> cgal(scenario);
  for(unsigned int frame = 0; frame < 20; ++frame)
  {
    drag(frame, ours.deformation());
    ours.proceed(3);
    drag(frame, cgal.deformation());
    cgal.proceed(3);
  }
  ours.proceed(400);
  cgal.proceed(400);
  const Star_energy energy(scenario);
  const double our_energy = energy(ours.mesh()).energy, cgal_energy = energy(cgal.mesh()).energy;
  verify_at_most(std::abs(our_energy - cgal_energy) / cgal_energy, 1e-3,
                 "the relative difference between the energies after the same drag");
  verify_at_most(largest_distance(ours.mesh(), cgal.mesh()) / scenario.diagonal, 1e-3,
                 "the difference of the shapes after the same drag, relative to the bounding box,");
}

Json run(const Settings& settings)
{
  const Scenario scenario = make_scenario(read_mesh(settings.file_or("camel.off")));
  const Drag drag(scenario);
  verify_drag(scenario, drag);

  Json section = make_section(
    "Dragging a handle",
    "Frames of three iterations, from setting the targets to the moved mesh. CGAL: "
    "Surface_mesh_deformation, ORIGINAL_ARAP, on the first quarter of the path.",
    {{"vertices", "vertices"}, {"deformation", "class"}, {"threads", "threads"},
     {"frames", "frames"}, {"frames_per_second", "frames / s"}, {"median_ms", "median [ms]"},
     {"p99_ms", "99% [ms]"}, {"p99_ratio", "99% / median"}, {"ratio", "CGAL / ours"}});
  const unsigned int rounds = 4, frames = settings.quick ? 50 : 250;
  const std::vector<unsigned int> threads = thread_counts();
  Cgal_deformation<CGAL::ORIGINAL_ARAP> cgal(scenario);
  std::vector<double> cgal_seconds;
  std::vector<std::vector<double>> our_seconds(threads.size());
  for(unsigned int round = 0; round < rounds; ++round)
  {
    measure_frames(drag, cgal, frames / 4, cgal_seconds);
    for(std::size_t k = 0; k < threads.size(); ++k)
    {
      const Thread_limit limit(threads[k]);
      Our_deformation<Default_traits> ours(scenario);
      measure_frames(drag, ours, frames, our_seconds[k]);
    }
  }
  const auto add = [&](const std::string& name, unsigned int number_of_threads,
                       const std::vector<double>& seconds) {
    double total = 0;
    for(double s : seconds)
      total += s;
    section["rows"].push_back({{"vertices", scenario.number_of_vertices()},
                               {"deformation", name},
                               {"threads", number_of_threads},
                               {"frames", seconds.size()},
                               {"frames_per_second", static_cast<double>(seconds.size()) / total},
                               {"median_ms", 1e3 * median(seconds)},
                               {"p99_ms", 1e3 * quantile(seconds, 0.99)},
                               {"p99_ratio", quantile(seconds, 0.99) / median(seconds)},
                               {"cgal_median_ms", 1e3 * median(cgal_seconds)},
                               {"ratio", median(cgal_seconds) / median(seconds)}});
  };
  for(std::size_t k = 0; k < threads.size(); ++k)
    add("ours", threads[k], our_seconds[k]);
  add("CGAL", 1, cgal_seconds);
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "frame_rate",
                       "usage: frame_rate [options]\n\n"
                       "Measures the frames per second while a handle is dragged.", run, {"mesh"});
}
