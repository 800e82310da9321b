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

#include "Cell_picks.h"
#include "Chosen_models.h"
#include "Command_line.h"
#include "Delayed_interruption.h"
#include "Film.h"
#include "Held_point.h"
#include "Output_file.h"
#include "Progress.h"
#include "Result.h"
#include "Scene.h"
#include "Shape_file.h"
#include "Task.h"
#include "mesh_panel.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/ARAP_deformation/self_intersections.h>
#include <CGAL/ARAP_deformation/target_sets.h>
#include <CGAL/Real_timer.h>
#include <CGAL/version.h>

#include <Eigen/Core>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <new>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace CGAL::ARAP::demo;
using CGAL::ARAP::Report;

using Traits =
  CGAL::ARAP_deformation_traits<Chosen_solver, CGAL::ARAP::Chosen_edge_weight, Chosen_rotation>;

void expect_success(const Command_line& line, const CGAL::ARAP::Outcome& outcome)
{
  check_interrupted();
  if(!outcome)
    throw std::runtime_error(line.mesh + ": " + with_options(outcome.message));
}

// How many free vertices are in no simplex: nothing moves them, whatever else in the file has them.
template <typename Domain>
std::size_t number_of_strays(const Domain& domain, const std::vector<int>& selection)
{
  std::size_t result = 0;
  for(auto v : domain.vertices())
    result += selection[domain.index(v)] == FREE && domain.is_isolated(v);
  return result;
}

// What a handle holds: vertices, and points inside simplices.
template <typename Deformation>
struct Controls
{
  std::vector<typename Deformation::vertex_descriptor> vertices;
  std::vector<CGAL::ARAP::Control_point> points;
};

// Inserts what is free and what is held, and returns the controls of each handle.
template <typename Deformation, typename Domain>
std::vector<Controls<Deformation>>
insert_controls(Deformation& deformation, const Command_line& line, const Domain& domain,
                const Task& task, const std::vector<Held_point<Domain>>& held)
{
  std::vector<Controls<Deformation>> controls(task.handles.size());
  const auto set_weight = [&](int status, const auto& control) {
    if(const auto& weight = task.handles[status - HANDLE].weight)
      expect_success(line, deformation.set_target_weight(control, *weight));
  };
  for(auto v : domain.vertices())
  {
    const int status = task.selection[domain.index(v)];
    if(status != FIXED)
      deformation.insert_roi_vertex(v);
    if(status < HANDLE)
      continue;
    deformation.insert_control_vertex(v);
    controls[status - HANDLE].vertices.push_back(v);
    set_weight(status, v);
  }
  for(const auto& [status, name, location] : held)
  {
    const auto inserted = deformation.insert_control_point(location);
    expect_success(line, inserted);
    for(auto v : domain.simplex_vertices(location.simplex))
      if(task.selection[domain.index(v)] == FIXED)
        deformation.erase_roi_vertex(v); // it has been inserted, and is not free
    if(status < HANDLE)
      continue;
    controls[status - HANDLE].points.push_back(inserted.point);
    set_weight(status, inserted.point);
  }
  return controls;
}

// Moves a handle to where it is at a time.
template <typename Deformation>
void move_handle(Deformation& deformation, const Command_line& line, const Handle& handle,
                 const Controls<Deformation>& controls, double time)
{
  const auto map = handle.transform(time);
  const auto set_targets = [&](const auto& of) {
    if(handle.plane)
      expect_success(line, deformation.set_target_set(
        of, CGAL::ARAP::projection_onto(transformed(map, *handle.plane))));
    else
      expect_success(line, deformation.transform(
        of, [&map](const auto& p) { return transformed(map, p); },
        CGAL::ARAP::Transformed::rest_shape));
  };
  set_targets(controls.vertices);
  set_targets(controls.points);
  if(handle.is_frame)
    for(auto v : controls.vertices)
      expect_success(line, deformation.set_target_rotation(
        v, CGAL::ARAP::demo::internal::affine(map).rotation()));
}

// Deforms the shape of a domain, each frame from the one before; after_frame(report) follows each.
template <typename Domain>
void deform(const Command_line& line, const Chosen_solver& solver, const Domain& domain,
            const Task& task, const std::vector<Held_point<Domain>>& held,
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
  const auto controls = insert_controls(deformation, line, domain, task, held);
  for(int frame = 1; frame <= line.frames; ++frame)
  {
    for(std::size_t k = 0; k < controls.size(); ++k)
      move_handle(deformation, line, task.handles[k], controls[k],
                  static_cast<double>(task.key_frames) * frame / line.frames);
    const std::string which = line.frames == 1 ? "" : "frame " + std::to_string(frame) + " of " +
                                                      std::to_string(line.frames) + ", ";
    progress.show(which + "preprocessing ...");
    const auto visitor = [&](const typename Deformation::Iterate& iterate) {
      if(iterate.iteration() == 0 && frame == 1)
        progress.done("preprocessed");
      progress.show(which, iterate, line.options.iterations);
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
    report.message = with_names(report.message, held);
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
  const auto is_taken = [](const std::vector<std::string>& files) {
    return std::any_of(files.begin(), files.end(), [](const std::string& file) {
      return is_same_file(file, "/dev/stdout");
    });
  };
  return is_taken(mesh_files(line)) || is_taken(other_files(line)) ? std::cerr : std::cout;
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
      throw Usage_error(file + ": the name of a mesh file ends in .off, .obj, .ply, .stl, .gltf, "
                               ".glb, .mesh, .msh, .vtk or .vtu");
  };
  check(line.mesh, mesh_format);
  check(line.output, format);
  if(is_tetrahedra_format(mesh_format) && format != mesh_format && format != ".mesh")
    throw Usage_error("--output " + line.output + ": the tetrahedra of " + line.mesh +
                      " can only be written to a .mesh file" +
                      (mesh_format == ".mesh" ? "" : ", or to a " + mesh_format + " file"));
  if(is_surface_format(mesh_format) && !is_surface_format(format))
    throw Usage_error("--output " + line.output + ": the surface of " + line.mesh +
                      " can only be written to an .off, .obj, .ply, .stl, .gltf or .glb file");
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

  // Calls f() when they are in their places; they stay there unless something fails until then.
  template <typename Function>
  void replace(const Function& f)
  {
    for(const auto& file : m_files)
      file->replace();
    f();
    for(const auto& file : m_files)
      file->keep();
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

  const bool needs_skin =
    !line.image.empty() || !line.animation.empty() || shape.writes_skin(format);
  const Skin boundary = needs_skin ? skin(shape.mesh()) : Skin(); // at rest
  if(needs_skin && boundary.triangles.empty())
    throw std::runtime_error(line.mesh + ": has nothing to draw, as each face is in several "
                             "tetrahedra");
  shape.check_output(line.output, format, other_files(line));
  const Delayed_interruption until_files_are_closed;
  Outputs outputs(line);
  write_task(outputs, task);

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
  result.strays = number_of_strays(domain, task.selection);
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
      shape.write(*file, format, boundary);
    if(outputs.film)
      film.add_frame(panel_of(points_of(shape.mesh()), ""));
  });
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
  check_interrupted();
  std::ostream& summary = summary_stream(line); // before an output that it avoids is replaced
  outputs.replace([&] {
    if(line.is_quiet)
      return;
    print_summary(summary, line, result);
    flush_output();
    print_note(line, shape.dropped(format));
  });
}

void run(const Command_line& line, const Chosen_solver& solver)
{
  const std::string format = output_format(line.output, line.mesh);
  check_mesh_files(line, format);
  if(!line.color.empty() && line.image.empty() && format != ".ply")
    throw Usage_error("--color " + line.color + ": needs --image, or for a surface a .ply file as "
                      "output");
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
