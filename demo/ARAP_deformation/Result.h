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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_RESULT_H
#define CGAL_ARAP_DEFORMATION_DEMO_RESULT_H

// What a run of the command tells: as JSON, and in a few lines.

#include "Command_line.h"
#include "Output_file.h"

#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/quality.h>

#include <nlohmann/json.hpp>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#endif

#include <cstddef>
#include <iomanip>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

// the report of the deformation, and what the command adds to it
struct Result
{
  std::vector<Step_report> frames;
  std::size_t vertices = 0, simplices = 0; // of the whole shape
  std::size_t strays = 0;                  // free vertices in no simplex
  Quality quality;
  std::optional<std::size_t> self_intersections; // if they were looked for
  double load_seconds = 0;
};

inline std::optional<long long> peak_memory_bytes()
{
#if defined(__unix__) || defined(__APPLE__)
  rusage usage;
  if(getrusage(RUSAGE_SELF, &usage) == 0)
#if defined(__APPLE__)
    return usage.ru_maxrss;
#else
    return 1024LL * usage.ru_maxrss;
#endif
#endif
  return std::nullopt;
}

// of all frames together
inline Phase_seconds seconds(const Result& result)
{
  Phase_seconds sum;
  for(const Report& frame : result.frames)
  {
    sum.preprocess += frame.seconds.preprocess;
    sum.total += frame.seconds.total;
  }
  return sum;
}

inline nlohmann::ordered_json to_json(const Phase_seconds& seconds)
{
  return {{"preprocess", seconds.preprocess}, {"deform", seconds.total - seconds.preprocess}};
}

inline void write_report(Output_file& file, const Result& result)
{
  const Report& report = result.frames.back();
  nlohmann::ordered_json json;
  json["status"] = to_string(report.status);
  json["message"] = report.message;
  json["vertices"] = result.vertices;
  json["simplices"] = result.simplices;
  json["free_vertices"] = report.free_vertices;
  json["initial_guess"] = to_string(report.initial_guess);
  json["iterations"] = report.iterations;
  json["energy"] = report.energy;
  json["estimated_relative_gap"] = report.estimated_relative_gap; // null if it is not finite
  json["end"] = to_string(report.end);
  json["saddles_left"] = report.saddles_left;
  json["plateaus_left"] = report.plateaus_left;
  json["looking_iterations"] = report.looking_iterations;
  json["edge_length_error"] = result.quality.edge_length_error;
  json["area_change"] = result.quality.area_change;
  json["volume_change"] = result.quality.volume_change; // null, as above
  json["largest_angle_change"] = result.quality.largest_angle_change;
  json["largest_spike"] = result.quality.largest_spike;
  if(result.self_intersections)
    json["self_intersections"] = *result.self_intersections;
  json["inverted_simplices"] = result.quality.inverted_simplices;
  json["unconstrained_components"] = report.unconstrained_components;
  json["vertices_in_no_simplex"] = result.strays;
  json["seconds"] = {{"load", result.load_seconds}};
  json["seconds"].update(to_json(seconds(result)));
  json["peak_memory_bytes"] = nullptr;
  if(const auto bytes = peak_memory_bytes())
    json["peak_memory_bytes"] = *bytes;
  if(result.frames.size() > 1 || result.frames[0].mass > 0)
    for(const Step_report& frame : result.frames)
    {
      json["frames"].push_back({{"iterations", frame.iterations},
                                {"energy", {frame.energy.front(), frame.final_energy()}},
                                {"factorized", frame.stages.factor},
                                {"seconds", to_json(frame.seconds)}});
      if(frame.mass > 0) // of a time step
        json["frames"].back().update({{"kinetic_energy", frame.kinetic_energy},
                                      {"elastic_energy", frame.elastic_energy},
                                      {"center_of_mass", frame.center_of_mass}});
    }
  file.write([&json](std::ostream& out) { out << std::setw(2) << json << '\n'; });
}

// The last lines of a run.
inline void print_summary(std::ostream& out, const Command_line& line, const Result& result)
{
  const Report& report = result.frames.back();
  out << line.mesh << ": " << result.vertices << " vertices, "
      << report.free_vertices << " free\n"
      << (result.frames.size() > 1 ? "last frame: " : "")
      << report.iterations << " iterations: " << report.message << '\n'
      << "energy ";
  if(line.dynamics) // the energy that a step minimizes has its inertia, too
    out << result.frames.back().kinetic_energy << " kinetic, "
        << result.frames.back().elastic_energy << " elastic";
  else
    out << report.energy.front() << " -> " << report.final_energy();
  out << ", edge length error " << result.quality.edge_length_error << '\n';
  if(result.self_intersections)
    out << *result.self_intersections << " pairs of faces intersect\n";
  if(result.quality.inverted_simplices > 0)
    out << result.quality.inverted_simplices << " of " << result.simplices
        << " tetrahedra are inside out\n";
  if(result.strays > 0)
    out << "free vertices that are in no "
        << (is_tetrahedra_format(lower_case_extension(line.mesh)) ? "tetrahedron" : "face")
        << ", and stay: " << result.strays << '\n';
  const Phase_seconds of_frames = seconds(result);
  out << "seconds: load " << result.load_seconds << ", preprocess " << of_frames.preprocess
      << ", deform " << of_frames.total - of_frames.preprocess << '\n'
      << "written: " << mesh_files(line).front();
  if(line.is_sequence && line.frames > 1)
    out << " to " << mesh_files(line).back();
  for(const std::string& file : other_files(line))
    out << ", " << file;
  out << '\n';
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_RESULT_H
