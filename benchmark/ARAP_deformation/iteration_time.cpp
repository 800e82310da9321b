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

// Compares the time of one local/global iteration of CGAL::ARAP_deformation with that of
// CGAL::Surface_mesh_deformation. Before anything is timed, both run from the same state, and their
// iterates must agree to rounding: they solve the same problem by the same steps.

#include <CGAL/ARAP_deformation.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/config.h>

#include <boost/config.hpp>
#include <boost/program_options.hpp>

#include <Eigen/Geometry>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#ifndef ARAP_DEFORMATION_COMPILER_FLAGS // CMakeLists.txt defines it
#define ARAP_DEFORMATION_COMPILER_FLAGS "unknown flags"
#endif

namespace {

namespace ARAP = CGAL::ARAP;

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using vertex_descriptor = Mesh::Vertex_index;

const unsigned int checked_iterations = 10;
const double largest_difference = 1e-8; // of the iterates, relative to the bounding box

// something that makes a comparison impossible, or wrong; what() is for the user
struct Failure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

class Stopwatch
{
  using Clock = std::chrono::steady_clock;

public:
  double seconds() const
  {
    return std::chrono::duration<double>(Clock::now() - m_start).count();
  }

private:
  Clock::time_point m_start = Clock::now();
};

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

// What is deformed: along the longest axis of the bounding box, the lowest 3% of the mesh are fixed
// and the highest 3% are rotated by 1.5 rad about that axis.
struct Scenario
{
  Mesh mesh;
  std::vector<std::pair<vertex_descriptor, Point>> targets; // of all control vertices
  double diagonal;                                          // of the bounding box
};

Mesh read_mesh(const std::string& file)
{
  Mesh mesh;
  if(!std::ifstream(file))
    throw Failure("cannot read the mesh " + file +
                  "\nFor CGAL's meshes, set the environment variable CGAL_DATA_DIR to their folder "
                  "(script/setup gets them), or name another mesh.");
  if(!CGAL::IO::read_polygon_mesh(file, mesh) || !CGAL::is_triangle_mesh(mesh))
    throw Failure(file + " is not a triangulated surface");
  return mesh;
}

Scenario make_scenario(const std::string& file)
{
  const double share = 0.03, angle = 1.5;
  Scenario scenario;
  scenario.mesh = read_mesh(file);
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(scenario.mesh);
  const Eigen::Vector3d low(box.xmin(), box.ymin(), box.zmin());
  const Eigen::Vector3d high(box.xmax(), box.ymax(), box.zmax());
  scenario.diagonal = (high - low).norm();

  int axis = 0;
  const double extent = (high - low).maxCoeff(&axis);
  const Eigen::Vector3d middle = (low + high) / 2;
  const Eigen::AngleAxisd rotation(angle, Eigen::Vector3d::Unit(axis));
  for(vertex_descriptor v : vertices(scenario.mesh))
  {
    const Point& p = scenario.mesh.point(v);
    if(p[axis] <= low[axis] + share * extent)
      scenario.targets.emplace_back(v, p);
    else if(p[axis] >= high[axis] - share * extent)
    {
      const Eigen::Vector3d q = middle + rotation * (Eigen::Vector3d(p[0], p[1], p[2]) - middle);
      scenario.targets.emplace_back(v, Point(q[0], q[1], q[2]));
    }
  }
  if(scenario.targets.size() == num_vertices(scenario.mesh))
    throw Failure(file + " has no vertices between its two ends: nothing is free to move");
  return scenario;
}

// Makes all vertices free but the control vertices.
template <typename Deformation>
void insert_vertices(const Scenario& scenario, Deformation& deformation)
{
  deformation.insert_roi_vertices(vertices(scenario.mesh).begin(), vertices(scenario.mesh).end());
  for(const auto& [v, target] : scenario.targets)
    deformation.insert_control_vertex(v);
}

// Goes back to the rest shape with all targets set.
template <typename Deformation>
void restart(const Scenario& scenario, Deformation& deformation)
{
  deformation.reset();
  for(const auto& [v, target] : scenario.targets)
    deformation.set_target_position(v, target);
}

// The weights of CGAL's ORIGINAL_ARAP: the cotangent of each angle is clamped, and not the sum of
// both at an edge.
class Clamped_angle_weight : public ARAP::Cotangent_weight
{
public:
  std::array<double, 3> simplex_weights(const std::array<ARAP::Coordinates, 3>& triangle) const
  {
    std::array<double, 3> weights = ARAP::Cotangent_weight::simplex_weights(triangle);
    for(double& w : weights)
      w = (std::max)(w, 0.0);
    return weights;
  }
};

// CGAL's class starts with the global step, with identities for rotations, where ours starts with
// the local step. This fitting leaves the identities where they are as long as it is told to, and
// so gives our class the same start; afterwards it is the default one.
class Rotation_after_identity
{
  using Rotation = CGAL::ARAP_deformation_traits_3<>::Closest_rotation;

public:
  explicit Rotation_after_identity(const bool& is_identity) : m_is_identity(&is_identity) {}

  void operator()(std::size_t n, const ARAP::Matrix_3x3* covariances,
                  ARAP::Matrix_3x3* rotations) const
  {
    if(*m_is_identity)
      std::fill_n(rotations, n, ARAP::Matrix_3x3{1, 0, 0, 0, 1, 0, 0, 0, 1});
    else
      m_rotation(n, covariances, rotations);
  }

private:
  const bool* m_is_identity;
  Rotation m_rotation;
};

struct Seconds
{
  double total = 0, local_steps = 0, global_steps = 0;
};

// our class on its own copy of the mesh
template <typename Weight>
class Our_deformation
{
  using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, Weight, Rotation_after_identity>;

public:
  Our_deformation(const Scenario& scenario, ARAP::Cell_scheme cells)
    : m_scenario(scenario), m_mesh(scenario.mesh),
      m_deformation(m_mesh, Traits(typename Traits::Sparse_solver(), Weight(),
                                   Rotation_after_identity(m_is_identity)))
  {
    ARAP::Options options;
    options.cells = cells;
    m_deformation.set_options(options);
    insert_vertices(scenario, m_deformation);
    if(const ARAP::Outcome outcome = m_deformation.preprocess(); !outcome)
      throw Failure("CGAL::ARAP_deformation: " + outcome.message);
    m_preprocess_seconds = m_stopwatch.seconds();
  }

  double preprocess_seconds() const { return m_preprocess_seconds; }
  std::size_t number_of_free_vertices() const { return m_number_of_free_vertices; }
  const Mesh& mesh() const { return m_mesh; }

  Seconds run(unsigned int iterations)
  {
    restart(m_scenario, m_deformation);
    m_is_identity = true;
    const Stopwatch stopwatch;
    const ARAP::Report report = m_deformation.deform(iterations, 0, [this](const auto&) {
      m_is_identity = false;
      return ARAP::Visitor_action::proceed;
    });
    const double total = stopwatch.seconds();
    if(!report || report.iterations != iterations)
      throw Failure("CGAL::ARAP_deformation: " + report.message);
    m_number_of_free_vertices = report.free_vertices;
    return {total, report.seconds.local_steps, report.seconds.global_steps};
  }

private:
  const Scenario& m_scenario;
  Mesh m_mesh;
  bool m_is_identity = true;
  Stopwatch m_stopwatch; // starts before m_deformation is constructed
  CGAL::ARAP_deformation<Mesh, Traits> m_deformation;
  double m_preprocess_seconds = 0;
  std::size_t m_number_of_free_vertices = 0;
};

// CGAL's class on its own copy of the mesh
template <CGAL::Deformation_algorithm_tag Tag>
class Cgal_deformation
{
public:
  explicit Cgal_deformation(const Scenario& scenario)
    : m_scenario(scenario), m_mesh(scenario.mesh), m_deformation(m_mesh)
  {
    insert_vertices(scenario, m_deformation);
    if(!m_deformation.preprocess())
      throw Failure("CGAL::Surface_mesh_deformation: preprocess() failed");
    m_preprocess_seconds = m_stopwatch.seconds();
  }

  double preprocess_seconds() const { return m_preprocess_seconds; }
  const Mesh& mesh() const { return m_mesh; }

  Seconds run(unsigned int iterations)
  {
    restart(m_scenario, m_deformation);
    const Stopwatch stopwatch;
    m_deformation.deform(iterations, 0);
    return {stopwatch.seconds()};
  }

private:
  const Scenario& m_scenario;
  Mesh m_mesh;
  Stopwatch m_stopwatch; // starts before m_deformation is constructed
  CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, Tag> m_deformation;
  double m_preprocess_seconds = 0;
};

double largest_distance(const Mesh& a, const Mesh& b)
{
  double largest = 0;
  for(vertex_descriptor v : vertices(a))
    largest = (std::max)(largest, CGAL::squared_distance(a.point(v), b.point(v)));
  return std::sqrt(largest);
}

// the seconds of one iteration, without what a run needs before and after its iterations
template <typename Deformation>
Seconds seconds_per_iteration(Deformation& deformation, unsigned int iterations)
{
  const Seconds longer = deformation.run(iterations + 1), shorter = deformation.run(1);
  return {(longer.total - shorter.total) / iterations,
          (longer.local_steps - shorter.local_steps) / iterations,
          (longer.global_steps - shorter.global_steps) / iterations};
}

// the numbers of one of the two classes, one of each for each repetition
struct Measurements
{
  std::vector<double> preprocess, iteration, local_step, global_step;

  template <typename Deformation>
  void measure(Deformation& deformation, unsigned int iterations)
  {
    const Seconds seconds = seconds_per_iteration(deformation, iterations);
    preprocess.push_back(deformation.preprocess_seconds());
    iteration.push_back(seconds.total);
    local_step.push_back(seconds.local_steps);
    global_step.push_back(seconds.global_steps);
  }
};

struct Comparison
{
  std::string ours_name, cgal_name;
  std::size_t number_of_free_vertices = 0;
  double first_difference = 0, last_difference = 0; // relative to the bounding box
  Measurements ours, cgal;

  double ratio() const { return median(cgal.iteration) / median(ours.iteration); }
};

struct Settings
{
  std::string mesh_file, json_file;
  unsigned int iterations = 20, repetitions = 7;
};

template <typename Weight, CGAL::Deformation_algorithm_tag Tag>
Comparison compare(const Scenario& scenario, const Settings& settings, ARAP::Cell_scheme cells,
                   const std::string& ours_name, const std::string& cgal_name)
{
  Comparison comparison;
  comparison.ours_name = ours_name;
  comparison.cgal_name = cgal_name;
  {
    Our_deformation<Weight> ours(scenario, cells);
    Cgal_deformation<Tag> cgal(scenario);
    const auto difference_after = [&](unsigned int iterations) {
      ours.run(iterations);
      cgal.run(iterations);
      return largest_distance(ours.mesh(), cgal.mesh()) / scenario.diagonal;
    };
    comparison.first_difference = difference_after(1);
    comparison.last_difference = difference_after(checked_iterations);
    comparison.number_of_free_vertices = ours.number_of_free_vertices();
  }
  const double difference =
    (std::max)(comparison.first_difference, comparison.last_difference);
  if(!(difference <= largest_difference))
  {
    std::ostringstream message;
    message << ours_name << " and CGAL's " << cgal_name << " do not solve the same problem: after "
            << checked_iterations << " iterations from the same state the shapes differ by "
            << difference << " of the bounding box; at most " << largest_difference
            << " is expected";
    if(!CGAL::is_closed(scenario.mesh))
      message << ".\nThe mesh has a border, where the weights of ORIGINAL_ARAP depend on the "
                 "version of CGAL: take a closed mesh.";
    throw Failure(message.str());
  }

  for(unsigned int repetition = 0; repetition < settings.repetitions; ++repetition)
  {
    {
      Our_deformation<Weight> ours(scenario, cells);
      comparison.ours.measure(ours, settings.iterations);
    }
    Cgal_deformation<Tag> cgal(scenario);
    comparison.cgal.measure(cgal, settings.iterations);
  }
  return comparison;
}

std::string processor()
{
  std::ifstream cpuinfo("/proc/cpuinfo");
  for(std::string line; std::getline(cpuinfo, line);)
    if(line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown processor";
}

std::string eigen_version()
{
#ifdef EIGEN_VERSION_STRING // since Eigen 5
  return EIGEN_VERSION_STRING;
#else
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
#endif
}

void print_table(std::ostream& out, const Scenario& scenario, const Settings& settings,
                 const std::vector<Comparison>& comparisons)
{
  out << "machine      " << processor() << "\n"
      << "compiler     " << BOOST_COMPILER << "\n"
      << "flags        " << ARAP_DEFORMATION_COMPILER_FLAGS << "\n"
      << "libraries    CGAL " << CGAL_VERSION_STR << ", Eigen " << eigen_version() << "\n"
      << "mesh         " << settings.mesh_file << "\n"
      << "vertices     " << num_vertices(scenario.mesh) << ", free "
      << comparisons.front().number_of_free_vertices << "\n"
      << "runs         1 thread, medians of " << settings.repetitions << " repetitions of "
      << settings.iterations << " iterations\n";
#ifndef NDEBUG
  out << "NOTICE       assertions are on: these times are not those of a release\n";
#endif

  const auto ms = [](const std::vector<double>& seconds) { return 1e3 * median(seconds); };
  const auto row = [&out](const std::string& name) -> std::ostream& {
    return out << "  " << std::left << std::setw(34) << name << std::right;
  };
  for(const Comparison& c : comparisons)
  {
    out << "\n" << c.ours_name << ", compared with CGAL's " << c.cgal_name << "\n"
        << std::scientific << std::setprecision(1);
    row("difference after 1 iteration") << std::setw(10) << c.first_difference
                                        << "  of the bounding box\n";
    row("difference after " + std::to_string(checked_iterations) + " iterations")
      << std::setw(10) << c.last_difference << "  of the bounding box\n";
    out << std::fixed << std::setprecision(2);
    row("") << std::setw(10) << "ours" << std::setw(10) << "CGAL" << std::setw(12) << "CGAL/ours"
            << "\n";
    row("preprocess [ms]") << std::setw(10) << ms(c.ours.preprocess)
                           << std::setw(10) << ms(c.cgal.preprocess) << std::setw(12)
                           << ms(c.cgal.preprocess) / ms(c.ours.preprocess) << "\n";
    row("iteration [ms]") << std::setw(10) << ms(c.ours.iteration)
                          << std::setw(10) << ms(c.cgal.iteration)
                          << std::setw(12) << c.ratio() << "\n";
    row("  local step: rotations, gradient") << std::setw(10) << ms(c.ours.local_step) << "\n";
    row("  global step: solve") << std::setw(10) << ms(c.ours.global_step) << "\n";
  }
}

void write_json(const Scenario& scenario, const Settings& settings,
                const std::vector<Comparison>& comparisons)
{
  using Json = nlohmann::ordered_json;
  const auto summary = [](const std::vector<double>& seconds) {
    return Json{{"median", median(seconds)},
                {"minimum", *std::min_element(seconds.begin(), seconds.end())},
                {"all", seconds}};
  };
  Json results = Json::array();
  for(const Comparison& c : comparisons)
    results.push_back({{"ours", c.ours_name},
                       {"cgal", c.cgal_name},
                       {"difference_after_1_iteration", c.first_difference},
                       {"difference_after_" + std::to_string(checked_iterations) + "_iterations",
                        c.last_difference},
                       {"ratio", c.ratio()},
                       {"our_seconds", {{"preprocess", summary(c.ours.preprocess)},
                                        {"iteration", summary(c.ours.iteration)},
                                        {"local_step", summary(c.ours.local_step)},
                                        {"global_step", summary(c.ours.global_step)}}},
                       {"cgal_seconds", {{"preprocess", summary(c.cgal.preprocess)},
                                         {"iteration", summary(c.cgal.iteration)}}}});
  const Json report = {{"machine", processor()},
                       {"compiler", BOOST_COMPILER},
                       {"flags", ARAP_DEFORMATION_COMPILER_FLAGS},
                       {"cgal", CGAL_VERSION_STR},
                       {"eigen", eigen_version()},
                       {"threads", 1},
                       {"mesh", settings.mesh_file},
                       {"vertices", num_vertices(scenario.mesh)},
                       {"free_vertices", comparisons.front().number_of_free_vertices},
                       {"iterations", settings.iterations},
                       {"repetitions", settings.repetitions},
                       {"comparisons", results}};
  std::ofstream out(settings.json_file);
  out << report.dump(2) << "\n";
  if(!out.flush())
    throw Failure("cannot write " + settings.json_file);
}

// Returns false if only help was asked for.
bool parse_command_line(int argc, char** argv, Settings& settings)
{
  namespace po = boost::program_options;
  int iterations = static_cast<int>(settings.iterations);
  int repetitions = static_cast<int>(settings.repetitions);
  po::options_description visible("Options"), all;
  visible.add_options()
    ("iterations", po::value(&iterations)->default_value(iterations)->value_name("N"),
     "iterations of each timed run")
    ("repetitions", po::value(&repetitions)->default_value(repetitions)->value_name("N"),
     "timed runs of each class, of which the medians are printed")
    ("json", po::value(&settings.json_file)->value_name("FILE"), "write all numbers to FILE too")
    ("help,h", "print this and exit");
  all.add(visible).add_options()("mesh", po::value(&settings.mesh_file));

  po::variables_map values;
  po::store(po::command_line_parser(argc, argv)
              .options(all)
              .positional(po::positional_options_description().add("mesh", 1))
              .run(), values);
  po::notify(values);
  if(values.count("help"))
  {
    std::cout << "usage: iteration_time [MESH] [options]\n\n"
                 "Compares the time of an iteration with that of CGAL's package\n"
                 "Surface_mesh_deformation. The default MESH is CGAL's armadillo.\n\n"
              << visible;
    return false;
  }
  if(iterations < 1 || repetitions < 1)
    throw po::error("--iterations and --repetitions must be at least 1");
  settings.iterations = static_cast<unsigned int>(iterations);
  settings.repetitions = static_cast<unsigned int>(repetitions);
  return true;
}

} // namespace

int main(int argc, char** argv)
{
  Settings settings;
  try
  {
    if(!parse_command_line(argc, argv, settings))
      return EXIT_SUCCESS;
  }
  catch(const boost::program_options::error& error)
  {
    std::cerr << "iteration_time: " << error.what() << "\n";
    return 2;
  }

  try
  {
    if(settings.mesh_file.empty())
      settings.mesh_file = CGAL::data_file_path("meshes/armadillo.off");
    const Scenario scenario = make_scenario(settings.mesh_file);
    const std::vector<Comparison> comparisons = {
      compare<Clamped_angle_weight, CGAL::ORIGINAL_ARAP>(
        scenario, settings, ARAP::Cell_scheme::spokes(), "spokes", "ORIGINAL_ARAP"),
      compare<ARAP::Cotangent_weight, CGAL::SPOKES_AND_RIMS>(
        scenario, settings, ARAP::Cell_scheme::spokes_and_rims(), "spokes_and_rims",
        "SPOKES_AND_RIMS")};
    print_table(std::cout, scenario, settings, comparisons);
    if(!settings.json_file.empty())
      write_json(scenario, settings, comparisons);
  }
  catch(const std::exception& error)
  {
    std::cerr << "iteration_time: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
