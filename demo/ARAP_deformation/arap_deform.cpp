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

// The command arap_deform: deforms a mesh file as rigidly as possible. See arap_deform --help.

#include "Chosen_models.h"
#include "Command_line.h"
#include "Delayed_interruption.h"
#include "Film.h"
#include "Output_file.h"
#include "Scene.h"
#include "Shape_file.h"
#include "Task.h"
#include "mesh_panel.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/ARAP_deformation/self_intersections.h>
#include <CGAL/ARAP_deformation/target_sets.h>
#include <CGAL/Real_timer.h>
#include <CGAL/version.h>

#include <Eigen/Core>

#include <nlohmann/json.hpp>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace CGAL::ARAP::demo;
using CGAL::ARAP::Report;

using Traits =
  CGAL::ARAP_deformation_traits<Chosen_solver, CGAL::ARAP::Chosen_edge_weight, Chosen_rotation>;

// the report of the deformation, and what the command adds to it
struct Result
{
  Report report;             // of the last frame
  std::vector<CGAL::ARAP::Step_report> frames;
  std::size_t vertices = 0, simplices = 0; // of the whole shape
  CGAL::ARAP::Quality quality;
  std::optional<std::size_t> self_intersections; // if they were looked for
  double load_seconds = 0;
};

bool is_terminal()
{
#if defined(__unix__) || defined(__APPLE__)
  return isatty(STDERR_FILENO) != 0;
#else
  return false;
#endif
}

// Says on a terminal what is being done, in a line that is replaced by the next one.
class Progress
{
public:
  explicit Progress(const Command_line& line) : m_is_shown(!line.is_quiet && is_terminal()) {}

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  ~Progress() { show(""); }

  bool is_shown() const { return m_is_shown; }

  void show(const std::string& what)
  {
    m_timer = CGAL::Real_timer(); // it may be running
    m_timer.start();
    if(m_is_shown)
      std::cerr << '\r' << what << "\033[K" << std::flush;
  }

  // Replaces the line for good, with the seconds since it was shown.
  void done(const std::string& what)
  {
    if(m_is_shown)
      std::cerr << '\r' << what << " in " << m_timer.time() << " s\033[K\n" << std::flush;
  }

private:
  bool m_is_shown;
  CGAL::Real_timer m_timer;
};

std::optional<long long> peak_memory_bytes()
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

nlohmann::ordered_json seconds(const Report& report)
{
  return {{"preprocess", report.seconds.preprocess},
          {"deform", report.seconds.total - report.seconds.preprocess}};
}

void write_report(Output_file& file, const Result& result)
{
  const Report& report = result.report;
  nlohmann::ordered_json json;
  json["status"] = to_string(report.status);
  json["message"] = report.message;
  json["vertices"] = result.vertices;
  json["simplices"] = result.simplices;
  json["free_vertices"] = report.free_vertices;
  json["iterations"] = report.iterations;
  json["energy"] = report.energy;
  json["estimated_relative_gap"] = nullptr;
  if(std::isfinite(report.estimated_relative_gap))
    json["estimated_relative_gap"] = report.estimated_relative_gap;
  json["end"] = to_string(report.end);
  json["saddles_left"] = report.saddles_left;
  json["plateaus_left"] = report.plateaus_left;
  json["looking_iterations"] = report.looking_iterations;
  json["edge_length_error"] = result.quality.edge_length_error;
  json["area_change"] = result.quality.area_change;
  json["volume_change"] = nullptr;
  if(std::isfinite(result.quality.volume_change))
    json["volume_change"] = result.quality.volume_change;
  json["largest_angle_change"] = result.quality.largest_angle_change;
  json["largest_spike"] = result.quality.largest_spike;
  if(result.self_intersections)
    json["self_intersections"] = *result.self_intersections;
  json["inverted_simplices"] = report.inverted_simplices;
  json["unconstrained_components"] = report.unconstrained_components;
  json["seconds"] = {{"load", result.load_seconds}};
  json["seconds"].update(seconds(report));
  json["peak_memory_bytes"] = nullptr;
  if(const auto bytes = peak_memory_bytes())
    json["peak_memory_bytes"] = *bytes;
  if(result.frames.size() > 1)
    for(const CGAL::ARAP::Step_report& frame : result.frames)
    {
      json["frames"].push_back({{"iterations", frame.iterations},
                                {"energy", {frame.energy.front(), frame.final_energy()}},
                                {"factorized", frame.stages.factor},
                                {"seconds", seconds(frame)}});
      if(frame.mass > 0) // of a time step
        json["frames"].back().update({{"kinetic_energy", frame.kinetic_energy},
                                      {"elastic_energy", frame.elastic_energy},
                                      {"center_of_mass", frame.center_of_mass}});
    }
  file.write([&json](std::ostream& out) { out << std::setw(2) << json << '\n'; });
}

void expect_success(const Command_line& line, const CGAL::ARAP::Outcome& outcome)
{
  check_interrupted();
  if(!outcome)
    throw std::runtime_error(line.mesh + ": " + with_options(outcome.message));
}

// A point inside a simplex that is picked, with its status.
template <typename Domain>
struct Held_point
{
  int status;
  CGAL::ARAP::Location<typename Domain::simplex_descriptor> location;
};

template <typename Domain>
std::vector<Held_point<Domain>> held_points(const Command_line& line, const Domain& domain,
                                            const std::vector<Kernel::Point_3>& points)
{
  std::vector<Held_point<Domain>> held;
  std::optional<CGAL::ARAP::Locator<Domain>> locator;
  for(const auto& [status, pick] : line.picks)
    if(pick.is_point())
    {
      if(!locator)
        locator.emplace(domain);
      const auto location = locator->locate(pick.point(points));
      if(!location)
        throw std::runtime_error(pick.name() + ": there is no place for it in the mesh");
      held.push_back({status, *location});
    }
  return held;
}

// with their places
template <typename Domain>
std::vector<std::pair<int, Kernel::Point_3>> places(const std::vector<Held_point<Domain>>& held,
                                                    const Domain& domain)
{
  std::vector<std::pair<int, Kernel::Point_3>> result;
  for(const auto& point : held)
  {
    Kernel::Vector_3 place(0, 0, 0);
    std::size_t k = 0;
    for(auto v : domain.simplex_vertices(point.location.simplex))
      place += point.location.coordinates[k++] * (domain.point(v) - CGAL::ORIGIN);
    result.emplace_back(point.status, CGAL::ORIGIN + place);
  }
  return result;
}

// Which of some picks has a cell: the last one with its vertex, or with all corners of its simplex.
template <typename Domain>
class Cell_picks
{
public:
  // Throws if a pick has no cell.
  Cell_picks(const std::vector<Pick>& picks, bool is_at_vertices, const Domain& domain,
             const std::vector<Kernel::Point_3>& points)
    : m_domain(domain)
  {
    for(const Pick& pick : picks)
    {
      m_is_picked.emplace_back(points.size());
      for(std::size_t v : pick.vertices(points))
        m_is_picked.back()[v] = true;
      bool has_cell = is_at_vertices;
      for(auto v = domain.vertices().begin(); v != domain.vertices().end() && !has_cell; ++v)
        domain.for_each_incident_simplex(*v, [&](const auto&, const auto& corners) {
          has_cell = has_cell || has_all(m_is_picked.back(), corners);
        });
      if(!has_cell)
        throw std::runtime_error(pick.name() + ": has no cell: none has all its corners there");
    }
  }

  // -1 for none
  int of_vertex(typename Domain::vertex_descriptor v) const
  {
    return last([&](const auto& is_picked) { return is_picked[m_domain.index(v)]; });
  }

  int of_simplex(typename Domain::simplex_descriptor s) const
  {
    return last([&](const auto& is_picked) {
      return has_all(is_picked, m_domain.simplex_vertices(s));
    });
  }

private:
  template <typename Corners>
  bool has_all(const std::vector<bool>& is_picked, const Corners& corners) const
  {
    return std::all_of(corners.begin(), corners.end(),
                       [&](auto v) { return is_picked[m_domain.index(v)]; });
  }

  template <typename Predicate>
  int last(const Predicate& has_cell) const
  {
    int k = static_cast<int>(m_is_picked.size()) - 1;
    while(k >= 0 && !has_cell(m_is_picked[k]))
      --k;
    return k;
  }

  Domain m_domain;
  std::vector<std::vector<bool>> m_is_picked;
};

// Sets the stiffness and the rigid parts.
template <typename Deformation>
void set_cell_values(Deformation& deformation, const Command_line& line,
                     const std::vector<Kernel::Point_3>& points)
{
  using Vertex = typename Deformation::vertex_descriptor;
  using Simplex = typename Deformation::simplex_descriptor;
  const auto& domain = deformation.domain();
  const bool is_at_vertices = line.options.cells.has_vertex_cells();
  const Cell_picks stiff(line.stiff, is_at_vertices, domain, points),
    rigid(line.rigid, is_at_vertices, domain, points);
  const auto value = [line](int k) { return k < 0 ? 1.0 : line.stiffness[k]; };
  if(!line.stiff.empty() && is_at_vertices)
    deformation.set_stiffness([=](Vertex v) { return value(stiff.of_vertex(v)); });
  else if(!line.stiff.empty())
    deformation.set_stiffness([=](Simplex s) { return value(stiff.of_simplex(s)); });
  if(!line.rigid.empty() && is_at_vertices)
    deformation.set_groups([rigid](Vertex v) { return rigid.of_vertex(v); });
  else if(!line.rigid.empty())
    deformation.set_groups([rigid](Simplex s) { return rigid.of_simplex(s); });
}

// Deforms the shape of a domain, each frame from the one before; after_frame(report) follows each.
template <typename Domain>
void deform(const Command_line& line, const Chosen_solver& solver, const Domain& domain,
            const Task& task,
            const std::vector<Held_point<Domain>>& held,
            const std::vector<Kernel::Point_3>& rest_points, Progress& progress,
            const std::function<void(const CGAL::ARAP::Step_report&)>& after_frame)
{
  using Deformation = CGAL::ARAP_deformation<Domain, Traits>;
  Deformation deformation(domain, Traits(solver, line.weights, chosen_rotation(line.rotation)));
  CGAL::ARAP::Options options = line.options;
  options.bending_length *= task.diagonal;
  options.smoothing_length *= task.diagonal;
  expect_success(line, deformation.set_options(options));
  set_cell_values(deformation, line, rest_points);
  std::vector<std::vector<typename Deformation::vertex_descriptor>> handles(task.handles.size());
  for(auto v : domain.vertices())
  {
    const int status = task.selection[domain.index(v)];
    if(status != FIXED)
      deformation.insert_roi_vertex(v);
    if(status < HANDLE)
      continue;
    deformation.insert_control_vertex(v);
    handles[status - HANDLE].push_back(v);
    if(const auto& weight = task.handles[status - HANDLE].weight)
      expect_success(line, deformation.set_target_weight(v, *weight));
  }
  std::vector<std::vector<CGAL::ARAP::Control_point>> points(task.handles.size());
  for(const auto& [status, location] : held)
  {
    const auto inserted = deformation.insert_control_point(location);
    expect_success(line, inserted);
    for(auto v : domain.simplex_vertices(location.simplex))
      if(task.selection[domain.index(v)] == FIXED)
        deformation.erase_roi_vertex(v); // it has been inserted, and is not free
    if(status < HANDLE)
      continue;
    points[status - HANDLE].push_back(inserted.point);
    if(const auto& weight = task.handles[status - HANDLE].weight)
      expect_success(line, deformation.set_target_weight(inserted.point, *weight));
  }
  for(int frame = 1; frame <= line.frames; ++frame)
  {
    const double time = static_cast<double>(task.key_frames) * frame / line.frames;
    for(std::size_t k = 0; k < handles.size(); ++k)
    {
      const auto map = task.handles[k].transform(time);
      const auto move = [&](const auto& targets) {
        if(const auto& plane = task.handles[k].plane)
          expect_success(line, deformation.set_target_set(
            targets, CGAL::ARAP::projection_onto(transformed(map, *plane))));
        else
          expect_success(line, deformation.transform(
            targets, [&map](const auto& p) { return transformed(map, p); },
            CGAL::ARAP::Transformed::rest_shape));
      };
      move(handles[k]);
      move(points[k]);
      for(auto v = handles[k].begin(); v != handles[k].end() && task.handles[k].is_frame; ++v)
        expect_success(line, deformation.set_target_rotation(
          *v, CGAL::ARAP::demo::internal::rotation_of(map)));
    }
    const std::string which = line.frames == 1 ? "" : "frame " + std::to_string(frame) + " of " +
                                                      std::to_string(line.frames) + ", ";
    progress.show(which + "preprocessing ...");
    const auto visitor = [&](const typename Deformation::Iterate& iterate) {
      if(iterate.iteration() == 0 && frame == 1)
        progress.done("preprocessed");
      if(progress.is_shown())
      {
        std::ostringstream text;
        text << which << "iteration " << iterate.iteration() << " of at most "
             << line.options.iterations << ", energy " << iterate.energy();
        progress.show(text.str());
      }
      return is_interrupted ? CGAL::ARAP::Visitor_action::cancel
                            : CGAL::ARAP::Visitor_action::proceed;
    };
    CGAL::ARAP::Step_report report;
    if(line.dynamics)
      report = deformation.advance(
        *line.dynamics,
        std::map<typename Deformation::vertex_descriptor, CGAL::ARAP::Coordinates>(),
        visitor);
    else
      static_cast<Report&>(report) = deformation.deform(visitor);
    progress.show("");
    expect_success(line, report);
    after_frame(report);
  }
}

// Throws if not all that was printed has reached the standard output.
void flush_output()
{
  if(!std::cout.flush())
    throw std::runtime_error("the standard output could not be written to the end");
}

#ifndef CGAL_ARAP_DEMO_VERSION
#define CGAL_ARAP_DEMO_VERSION "without a version"
#endif

// What a report of an error should tell.
void print_version(std::ostream& out)
{
  out << "arap_deform " CGAL_ARAP_DEMO_VERSION "\nwith CGAL " CGAL_VERSION_STR ", Eigen "
      << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.' << EIGEN_MINOR_VERSION;
#ifdef CGAL_LINKED_WITH_TBB
  out << ", TBB";
#endif
#ifdef CGAL_LINKED_WITH_CHOLMOD
  out << ", CHOLMOD";
#endif
#ifdef CGAL_METIS_ENABLED
  out << ", METIS";
#endif
#ifdef CGAL_LINKED_WITH_PETSC
  out << ", PETSc";
#endif
#ifdef CGAL_ARAP_DEMO_WITH_GIFLIB
  out << ", giflib";
#endif
#ifdef CGAL_ARAP_DEMO_WITH_ZLIB
  out << ", zlib";
#endif
  out << '\n';
}

// Where the summary goes: not into an output.
std::ostream& summary_stream(const Command_line& line)
{
  const std::string standard_output = "/dev/stdout";
  bool is_taken = false;
  for(const std::string& file : {line.output, line.image, line.animation, line.save_selection,
                                 line.save_transform})
    is_taken = is_taken || (!file.empty() && is_same_file(file, standard_output));
  return is_taken ? std::cerr : std::cout;
}

void print_summary(std::ostream& out, const Command_line& line, const Result& result)
{
  const Report& report = result.report;
  out << line.mesh << ": " << result.vertices << " vertices, "
            << report.free_vertices << " free\n"
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
  if(report.inverted_simplices > 0)
    out << report.inverted_simplices << " of " << result.simplices
        << " tetrahedra are inside out\n";
  out << "seconds: load " << result.load_seconds << ", preprocess "
      << report.seconds.preprocess << ", deform "
      << report.seconds.total - report.seconds.preprocess << '\n'
      << "written: " << mesh_files(line).front();
  if(line.is_sequence && line.frames > 1)
    out << " to " << mesh_files(line).back();
  for(const std::string& file : {line.report, line.image, line.animation, line.save_selection,
                                 line.save_transform})
    if(!file.empty())
      out << ", " << file;
  out << '\n';
  flush_output();
}

// Says what of the input the output does not keep.
void print_note(const Command_line& line, const std::set<std::string>& dropped)
{
  std::string list;
  for(const std::string& what : dropped)
    list += (list.empty() ? "" : ", ") + what;
  if(!dropped.empty())
    std::cerr << "note: " << line.output << " does not keep: " << list << '\n';
}

// Throws if the mesh or the output is not a mesh file, or if they are of different kinds.
void check_mesh_files(const Command_line& line, const std::string& format)
{
  const std::string mesh_format = lower_case_extension(line.mesh);
  const auto check = [](const std::string& file, const std::string& its_format) {
    if(!is_mesh_format(its_format))
      throw std::runtime_error(file + ": the name of a mesh file ends in .off, .obj, .ply, .stl, "
                                      ".gltf, .glb, .mesh, .msh, .vtk or .vtu");
  };
  check(line.mesh, mesh_format);
  check(line.output, format);
  if(is_tetrahedra_format(mesh_format) && format != mesh_format && format != ".mesh")
    throw std::runtime_error("--output " + line.output + ": the tetrahedra of " + line.mesh +
                             " can only be written to a .mesh file" +
                             (mesh_format == ".mesh" ? "" : ", or to a " + mesh_format + " file"));
  if(is_surface_format(mesh_format) && !is_surface_format(format))
    throw std::runtime_error("--output " + line.output + ": the surface of " + line.mesh +
                             " can only be written to an .off, .obj, .ply, .stl, .gltf or .glb "
                             "file");
}

// The outputs: opened before the run, so that nothing is computed in vain, and kept only after all
// have been written.
class Outputs
{
public:
  explicit Outputs(const Command_line& line)
  {
    for(const std::string& file : mesh_files(line))
      m_meshes.push_back(open(file));
    report = open(line.report);
    image = open(line.image);
    film = open(line.animation);
    selection = open(line.save_selection);
    transform = open(line.save_transform);
  }

  // of a frame; null if it is not written
  Output_file* mesh(const Command_line& line, int frame) const
  {
    return line.is_sequence ? m_meshes[frame - 1] : frame == line.frames ? m_meshes[0] : nullptr;
  }

  void commit()
  {
    for(const auto& file : m_files)
      file->commit();
  }

  Output_file *report, *image, *film, *selection, *transform; // null if not asked for

private:
  Output_file* open(const std::string& name)
  {
    return name.empty() ? nullptr
                        : m_files.emplace_back(std::make_unique<Output_file>(name)).get();
  }

  std::vector<std::unique_ptr<Output_file>> m_files;
  std::vector<Output_file*> m_meshes;
};

void write_task(const Outputs& outputs, const Task& task)
{
  if(outputs.selection)
    outputs.selection->write([&](std::ostream& out) { write_selection(out, task.selection); });
  if(outputs.transform)
    outputs.transform->write([&](std::ostream& out) {
      for(const Handle& handle : task.handles)
        write_transform(out, handle.transform(static_cast<double>(task.key_frames)));
    });
}

// Shape is the class of the contents of the mesh file.
template <typename Shape>
void run(const Command_line& line, const Chosen_solver& solver, const std::string& format)
{
  Progress progress(line);
  progress.show("loading " + line.mesh + " ...");
  CGAL::Real_timer load_timer;
  load_timer.start();
  Shape shape(line.mesh, format);
  const std::vector<Kernel::Point_3> rest_points = points_of(shape.mesh());
  const typename Shape::Domain domain = shape.domain();
  const auto held = held_points(line, domain, rest_points);
  const Task task = make_task(line, rest_points, places(held, domain));
  load_timer.stop();
  progress.done("loaded " + line.mesh + ", " + std::to_string(shape.number_of_vertices()) +
                " vertices and " + std::to_string(shape.number_of_simplices()) + ' ' +
                Shape::simplices + ',');

  shape.check_output(line.output, format);
  const Delayed_interruption until_files_are_closed;
  Outputs outputs(line);
  write_task(outputs, task);

  const Skin boundary = skin(shape.mesh()); // before tetrahedra are inverted
  const auto panel_of = [&](const std::vector<Kernel::Point_3>& points,
                            const std::string& caption) {
    return panel(boundary, points, task.selection, caption);
  };
  View view = default_view(panel_of(rest_points, "").points);
  if(!line.view.empty())
    view = turned(view, line.view);
  Film film(line.animation, view);
  if(outputs.film)
    film.add_frame(panel_of(rest_points, ""));

  Result result;
  result.vertices = shape.number_of_vertices();
  result.simplices = shape.number_of_simplices();
  result.load_seconds = load_timer.time();
  std::vector<double> measures; // of each vertex
  deform(line, solver, domain, task, held, rest_points, progress, [&](const auto& report) {
    result.frames.push_back(report);
    if(!line.color.empty())
    {
      measures = CGAL::ARAP::quality_at_vertices(domain, vertex_measure(line.color), rest_points);
      shape.set_property(line.color, measures);
    }
    if(Output_file* file = outputs.mesh(line, static_cast<int>(result.frames.size())))
      shape.write(*file, format);
    if(outputs.film)
      film.add_frame(panel_of(points_of(shape.mesh()), ""));
  });
  result.report = result.frames.back();
  result.quality = CGAL::ARAP::quality(domain, rest_points);
  if(line.has_quality)
    result.self_intersections = CGAL::ARAP::number_of_self_intersections(domain);

  if(outputs.image)
  {
    Panel after = panel_of(points_of(shape.mesh()), "after");
    if(!measures.empty())
      color(after, line.color, boundary, measures);
    outputs.image->write([&](std::ostream& out) {
      render({panel_of(rest_points, "before"), after}, view, out);
    });
  }
  if(outputs.film)
  {
    progress.show("making the film ...");
    outputs.film->write([&](std::ostream& out) { film.write(out); });
    progress.show("");
  }
  if(outputs.report)
    write_report(*outputs.report, result);
  if(!line.is_quiet)
  {
    print_summary(summary_stream(line), line, result);
    print_note(line, shape.dropped(format));
  }
  check_interrupted();
  outputs.commit(); // when nothing else can fail
}

void run(const Command_line& line, const Chosen_solver& solver)
{
  const std::string format = output_format(line.output, line.mesh);
  check_mesh_files(line, format);
  if(!line.color.empty() && line.image.empty() && format != ".ply")
    throw std::runtime_error("--color " + line.color + ": needs a .ply file as output, or --image");
  {
    const Delayed_interruption until_folder_is_removed;
    if(!line.image.empty())
      check_renderer();
    if(!line.animation.empty())
      Film::check(line.animation);
  }
  check_interrupted();
  if(is_tetrahedra_format(format))
    run<Tetrahedra_file>(line, solver, format);
  else if(is_gltf_format(lower_case_extension(line.mesh)))
    run<Gltf_file>(line, solver, format);
  else
    run<Surface_file>(line, solver, format);
}

} // namespace

int main(int argc, char** argv)
{
#if defined(__unix__) || defined(__APPLE__)
  std::signal(SIGXFSZ, SIG_IGN); // writing too large a file must fail, not end the program
#endif
  try
  {
    const Command_line line = parse_command_line(argc, argv);
    if(line.is_help || line.is_version)
    {
      (line.is_help ? print_help : print_version)(std::cout);
      flush_output();
    }
    else if(const Chosen_processes processes(line.solver); !processes.serve())
      run(line, Chosen_solver(line.solver, processes));
    return EXIT_SUCCESS;
  }
  catch(const Usage_error& error)
  {
    std::cerr << "arap_deform: " << error.what() << "\nTry arap_deform --help\n";
    return 2;
  }
  catch(const std::bad_alloc&)
  {
    std::cerr << "arap_deform: out of memory\n";
    return 1;
  }
  catch(const std::exception& error)
  {
    std::cerr << "arap_deform: " << error.what() << '\n';
    return 1;
  }
}
