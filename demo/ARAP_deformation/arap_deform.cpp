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

#include "Command_line.h"
#include "Delayed_interruption.h"
#include "Output_file.h"
#include "Scene.h"
#include "Shape_file.h"
#include "mesh_panel.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/Real_timer.h>

#include <nlohmann/json.hpp>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <new>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace CGAL::ARAP::demo;
using CGAL::ARAP::Report;

// edge weights chosen at run time, so that a single instantiation of the deformation suffices
class Chosen_weight
{
public:
  explicit Chosen_weight(Weight_choice choice)
  {
    switch(choice)
    {
    case Weight_choice::safe_cotangent: break;
    case Weight_choice::cotangent: m_weight = CGAL::ARAP::Cotangent_weight(); break;
    case Weight_choice::clamped_cotangent: m_weight = CGAL::ARAP::Clamped_cotangent_weight(); break;
    case Weight_choice::uniform: m_weight = CGAL::ARAP::Uniform_weight(); break;
    }
  }

  template <std::size_t N>
  auto simplex_weights(const std::array<CGAL::ARAP::Coordinates, N>& simplex) const
  {
    return std::visit([&](const auto& w) { return w.simplex_weights(simplex); }, m_weight);
  }

  double edge_weight(CGAL::ARAP::Edge_set edge_set, std::size_t i, std::size_t j, double sum) const
  {
    return std::visit([&](const auto& w) { return w.edge_weight(edge_set, i, j, sum); }, m_weight);
  }

private:
  std::variant<CGAL::ARAP::Safe_cotangent_weight, CGAL::ARAP::Cotangent_weight,
               CGAL::ARAP::Clamped_cotangent_weight, CGAL::ARAP::Uniform_weight> m_weight;
};

using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Chosen_weight>;

// the report of the deformation, and what the command adds to it
struct Result
{
  Report report;
  std::size_t vertices = 0, simplices = 0; // of the whole shape
  double edge_length_error = 0;
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
    m_timer.reset();
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
  json["edge_length_error"] = result.edge_length_error;
  json["inverted_simplices"] = report.inverted_simplices;
  json["unconstrained_components"] = report.unconstrained_components;
  json["seconds"] = {{"load", result.load_seconds},
                     {"preprocess", report.seconds.preprocess},
                     {"deform", report.seconds.total - report.seconds.preprocess}};
  json["peak_memory_bytes"] = nullptr;
  if(const auto bytes = peak_memory_bytes())
    json["peak_memory_bytes"] = *bytes;
  file.write([&json](std::ostream& out) { out << std::setw(2) << json << '\n'; });
}

// Deforms the shape of a domain.
template <typename Domain>
Report deform(const Command_line& line, const Domain& domain, const std::vector<int>& selection,
              const Transform& transform, Progress& progress)
{
  using Deformation = CGAL::ARAP_deformation<Domain, Traits>;
  Deformation deformation(domain, Traits({}, Chosen_weight(line.weights)));
  Report report;
  static_cast<CGAL::ARAP::Outcome&>(report) = deformation.set_options(line.options);
  if(!report)
    return report;
  insert_selection(deformation, selection, transform);

  progress.show("preprocessing ...");
  report = deformation.deform([&](const typename Deformation::Iterate& iterate) {
    if(iterate.iteration() == 0)
      progress.done("preprocessed");
    if(progress.is_shown())
    {
      std::ostringstream text;
      text << "iteration " << iterate.iteration() << " of at most " << line.options.iterations
           << ", energy " << iterate.energy();
      progress.show(text.str());
    }
    return is_interrupted ? CGAL::ARAP::Visitor_action::cancel
                          : CGAL::ARAP::Visitor_action::proceed;
  });
  progress.show("");
  check_interrupted();
  if(!report)
    throw std::runtime_error(line.mesh + ": " + report.message);
  return report;
}

// Throws if not all that was printed has reached the standard output.
void flush_output()
{
  if(!std::cout.flush())
    throw std::runtime_error("the standard output could not be written to the end");
}

// Where the summary goes: not into an output.
std::ostream& summary_stream(const Command_line& line)
{
  const std::string standard_output = "/dev/stdout";
  const bool is_taken = is_same_file(line.output, standard_output) ||
                        (!line.image.empty() && is_same_file(line.image, standard_output));
  return is_taken ? std::cerr : std::cout;
}

void print_summary(std::ostream& out, const Command_line& line, const Result& result)
{
  const Report& report = result.report;
  out << line.mesh << ": " << result.vertices << " vertices, "
            << report.free_vertices << " free\n"
            << report.iterations << " iterations: " << report.message << '\n'
            << "energy " << report.energy.front() << " -> " << report.final_energy()
            << ", edge length error " << result.edge_length_error << '\n';
  if(report.inverted_simplices > 0)
    out << report.inverted_simplices << " of " << result.simplices
        << " tetrahedra are inside out\n";
  out << "seconds: load " << result.load_seconds << ", preprocess "
      << report.seconds.preprocess << ", deform "
      << report.seconds.total - report.seconds.preprocess << '\n'
      << "written: " << line.output;
  for(const std::string& file : {line.report, line.image})
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
      throw std::runtime_error(file + ": the name of a mesh file ends in .off, .obj, .ply, .stl or "
                                      ".mesh");
  };
  check(line.mesh, mesh_format);
  check(line.output, format);
  if(is_tetrahedra_format(mesh_format) && !is_tetrahedra_format(format))
    throw std::runtime_error("--output " + line.output + ": the tetrahedra of " + line.mesh +
                             " can only be written to a .mesh file");
  if(is_surface_format(mesh_format) && !is_surface_format(format))
    throw std::runtime_error("--output " + line.output + ": the surface of " + line.mesh +
                             " can only be written to an .off, .obj, .ply or .stl file");
}

// Shape is the class of the contents of the mesh file.
template <typename Shape>
void run(const Command_line& line, const std::string& format)
{
  Progress progress(line);
  progress.show("loading " + line.mesh + " ...");
  CGAL::Real_timer load_timer;
  load_timer.start();
  Shape shape(line.mesh);
  const std::vector<int> selection = read_selection(line.selection, shape.number_of_vertices());
  const Transform transform = read_transform(line.transform);
  load_timer.stop();
  progress.done("loaded " + line.mesh + ", " + std::to_string(shape.number_of_vertices()) +
                " vertices and " + std::to_string(shape.number_of_simplices()) + ' ' +
                Shape::simplices + ',');

  // opened first, so that nothing is computed in vain
  shape.check_output(line.output, format);
  const Delayed_interruption until_files_are_closed;
  Output_file output(line.output);
  std::optional<Output_file> report, image;
  if(!line.report.empty())
    report.emplace(line.report);
  if(!line.image.empty())
    image.emplace(line.image);

  const std::vector<Kernel::Point_3> rest_points = points_of(shape.mesh());
  const Skin drawn = image ? skin(shape.mesh()) : Skin();
  const typename Shape::Domain domain = shape.domain();
  Result result;
  result.vertices = shape.number_of_vertices();
  result.simplices = shape.number_of_simplices();
  result.load_seconds = load_timer.time();
  result.report = deform(line, domain, selection, transform, progress);
  result.edge_length_error = CGAL::ARAP::relative_edge_length_error(domain, rest_points);

  shape.write(output, format);
  if(image)
  {
    const std::vector<Panel> panels = {
      panel(drawn, rest_points, selection, "before"),
      panel(drawn, points_of(shape.mesh()), selection, "after")};
    image->write([&](std::ostream& out) {
      render(panels, default_view(panels[0].points), out);
    });
  }
  if(report)
    write_report(*report, result);
  if(!line.is_quiet)
  {
    print_summary(summary_stream(line), line, result);
    print_note(line, shape.dropped(format));
  }
  check_interrupted();

  // when nothing else can fail
  output.commit();
  if(report)
    report->commit();
  if(image)
    image->commit();
}

void run(const Command_line& line)
{
  const std::string format = output_format(line.output, line.mesh);
  check_mesh_files(line, format);
  if(!line.image.empty())
  {
    const Delayed_interruption until_folder_is_removed;
    check_renderer();
  }
  check_interrupted();
  if(is_tetrahedra_format(format))
    run<Tetrahedra_file>(line, format);
  else
    run<Surface_file>(line, format);
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
    if(line.is_help)
    {
      print_help(std::cout);
      flush_output();
    }
    else
      run(line);
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
