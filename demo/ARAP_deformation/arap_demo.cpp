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

// The demo around the command arap_deform: writes the models to deform, and draws the results.
// script/demo runs it before and after the command.
//
//   arap_demo models FOLDER [MESHES]   writes NAME.off or NAME.mesh, NAME.sel and NAME.def, and
//                                      prints the names of the meshes; includes models from CGAL's
//                                      data folder MESHES if it is given
//   arap_demo pictures FOLDER [MESHES] draws NAME.png from NAME_deformed.off or .mesh, and the
//                                      pictures of the manual; prints a table
//   arap_demo figures FOLDER           draws Figure 2 of the paper, and the figures of the manual
//                                      from what figures.sh has computed; prints a table
//   arap_demo table FOLDER             prints Table 1 of the paper beside our errors; reads lines
//                                      of FIGURE MODEL ERROR

#include "Command_line.h"
#include "Task.h"
#include "demo_shapes.h"
#include "embedded_shape.h"
#include "mesh_panel.h"
#include "read_mesh.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Embedding.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace CGAL::ARAP::demo;
namespace fs = std::filesystem;

std::vector<Demo_shape> models(const fs::path& meshes)
{
  std::vector<Demo_shape> all = {make_bar(), make_cactus(), make_spiky_plane()};
  if(!meshes.empty())
  {
    all.push_back(armadillo((meshes / "armadillo.off").string()));
    all.push_back(dino((meshes / "dino.off").string()));
    all.push_back(camel((meshes / "camel.off").string()));
  }
  return all;
}

std::string file_name(const Demo_shape& model) { return model.name + ".off"; }
std::string file_name(const Demo_volume& model) { return model.name + ".mesh"; }

template <typename Shape>
void write_model(const fs::path& folder, const Demo_model<Shape>& model)
{
  Output_file mesh((folder / file_name(model)).string());
  write_mesh(mesh, model.mesh);
  mesh.replace();
  mesh.keep();
  std::ofstream selection(folder / (model.name + ".sel"));
  std::ofstream transform(folder / (model.name + ".def"));
  write_selection(selection, model.selection);
  write_transform(transform, model.transform);
  if(!selection.flush() || !transform.flush())
    throw std::runtime_error(folder.string() + ": cannot be written to");
  std::cout << file_name(model) << '\n';
}

void write_models(const fs::path& folder, const fs::path& meshes)
{
  for(const Demo_shape& model : models(meshes))
    write_model(folder, model);
  write_model(folder, make_filled_bar());
}

void draw(const std::vector<Panel>& panels, const View& view, const fs::path& picture)
{
  Output_file output(picture.string());
  output.write([&](std::ostream& out) { render(panels, view, out); });
  output.replace();
  output.keep();
  std::cout << picture.string() << std::endl;
}

Panel deformed_panel(const fs::path& folder, const Demo_shape& model)
{
  const std::string file = (folder / (model.name + "_deformed.off")).string();
  return panel(read_mesh(file), model.selection, "deformed");
}

Panel deformed_panel(const fs::path& folder, const Demo_volume& model)
{
  const std::string file = (folder / (model.name + "_deformed.mesh")).string();
  return panel(Medit_file(file).mesh(), model.selection, "deformed");
}

template <typename Shape>
void draw_model(const fs::path& folder, const Demo_model<Shape>& model)
{
  draw({panel(model.mesh, model.selection, "original"), deformed_panel(folder, model)},
       model.view, folder / (model.name + ".png"));
}

void expect_success(const CGAL::ARAP::Outcome& outcome)
{
  if(!outcome)
    throw std::runtime_error(outcome.message);
}

// Passes the selection to a deformation, with the targets of the handles.
template <typename Deformation>
void insert_selection(Deformation& deformation, const std::vector<int>& selection,
                      const Transform& transform)
{
  const auto& domain = deformation.domain();
  for(auto v : domain.vertices())
  {
    const int status = selection[domain.index(v)];
    if(status != FIXED)
      deformation.insert_roi_vertex(v);
    if(status >= HANDLE)
      deformation.insert_control_vertex(v, transformed(transform, domain.point(v)));
  }
}

// The panel of a shape that is deformed here. `change` may say more of the deformation than the
// options do; prints what the run has come to.
template <typename Change>
Panel deformed_panel(const Demo_shape& shape, const std::string& caption,
                     const CGAL::ARAP::Options& options, const Change& change)
{
  Mesh mesh = shape.mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  expect_success(deformation.set_options(options));
  insert_selection(deformation, shape.selection, shape.transform);
  change(deformation);
  const auto report = deformation.deform();
  expect_success(report);
  std::cout << "  " << shape.name << ", " << caption << ": " << report.iterations
            << " iterations, energy " << report.final_energy() << ", edge error "
            << CGAL::ARAP::quality(mesh, shape.mesh.points()).edge_length_error << '\n';
  return panel(mesh, shape.selection, caption);
}

Panel deformed_panel(const Demo_shape& shape, const std::string& caption,
                     const CGAL::ARAP::Options& options)
{
  return deformed_panel(shape, caption, options, [](const auto&) {});
}

using Domain =
  CGAL::ARAP::Simplex_soup_domain<3, std::vector<Point>, std::vector<std::array<int, 4>>>;
using Traits = CGAL::ARAP_deformation_traits<>;
using Uniform_traits =
  CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Uniform_weight>;

// The largest difference in height between the two halves of a symmetric sheet, at each vertex of
// the coarse right half and its mirror image in the fine left half.
double asymmetry(const Mesh& rest, const Mesh& mesh)
{
  double largest = 0;
  for(Mesh::Vertex_index v : rest.vertices())
    for(Mesh::Vertex_index w : rest.vertices())
    {
      const auto &p = rest.point(v), &q = rest.point(w);
      if(p.x() > 0 && std::abs(p.x() + q.x()) < 1e-9 && std::abs(p.y() - q.y()) < 1e-9)
      {
        const double difference = std::abs(mesh.point(v).z() - mesh.point(w).z());
        if(std::isnan(difference)) // std::max() would lose it
          return difference;
        largest = (std::max)(largest, difference);
      }
    }
  return largest;
}

template <typename Deformation_traits>
Panel deformed_sheet(const Demo_shape& sheet, const std::string& caption)
{
  Mesh mesh = sheet.mesh;
  CGAL::ARAP_deformation<Mesh, Deformation_traits> deformation(mesh);
  CGAL::ARAP::Options options;
  options.cells = CGAL::ARAP::Cell_scheme::spokes();
  expect_success(deformation.set_options(options));
  insert_selection(deformation, sheet.selection, sheet.transform);
  const auto report = deformation.deform(2000, 1e-4);
  expect_success(report);
  std::cout << "  " << caption << ": left and right differ by at most "
            << asymmetry(sheet.mesh, mesh) << " (the handle is lifted by "
            << sheet.transform[11] << ")\n";
  return panel(mesh, sheet.selection, caption);
}

// Figure 2 of the paper: a sheet with a finer mesh on the left.
void draw_weights(const fs::path& folder)
{
  const Demo_shape sheet = make_biased_plane();
  draw({panel(sheet.mesh, sheet.selection, "original"),
        deformed_sheet<Uniform_traits>(sheet, "uniform weights"),
        deformed_sheet<Traits>(sheet, "cotangent weights")},
       sheet.view, folder / "weights.png");
}

// Draws points without a vertex as balls.
void add_balls(Panel& panel, const std::vector<Point>& points)
{
  for(const Point& p : points)
  {
    panel.points.push_back({p.x(), p.y(), p.z()});
    panel.selection.push_back(HANDLE);
  }
}

// A pulled vertex is a spike without bending, and with smooth rotations, too.
void draw_bending(const fs::path& folder)
{
  const Demo_shape sheet = make_pulled_sheet();
  CGAL::ARAP::Options bending, smooth;
  bending.bending_length = smooth.smoothing_length = 0.05 * std::sqrt(2.0); // of the diagonal
  draw({deformed_panel(sheet, "without bending", {}),
        deformed_panel(sheet, "with bending", bending),
        deformed_panel(sheet, "with smooth rotations", smooth)},
       sheet.view, folder / "bending.png");
}

// One vertex that turns what is around it.
void draw_frame(const fs::path& folder)
{
  const Demo_shape strip = make_strip();
  const auto turn = [&](auto& deformation) {
    const auto handle = std::find(strip.selection.begin(), strip.selection.end(), HANDLE);
    const Mesh::Vertex_index v(unsigned(handle - strip.selection.begin()));
    const Eigen::AngleAxisd rotation(-CGAL_PI / 2, Eigen::Vector3d::UnitY());
    expect_success(deformation.set_target_rotation(v, rotation));
  };
  draw({panel(strip.mesh, strip.selection, "original"),
        deformed_panel(strip, "one vertex, moved", {}),
        deformed_panel(strip, "moved and turned", {}, turn)},
       strip.view, folder / "frame.png");
}

// What stiffness, groups and larger cells make of a bent bar; the edges of its middle are drawn.
void draw_stiffness(const fs::path& folder)
{
  Demo_shape bar = make_bar(2);
  bar.transform = motion(0, 120, Point(0, 0, 71), Vector(0, -38, -24));
  const auto is_middle = [&](Mesh::Vertex_index v) {
    return std::abs(bar.mesh.point(v).z() - 37.5) < 9;
  };
  const auto stiff = [&](auto& deformation) {
    expect_success(deformation.set_stiffness([=](Mesh::Vertex_index v) {
      return is_middle(v) ? 100.0 : 1.0;
    }));
  };
  const auto rigid = [&](auto& deformation) {
    expect_success(deformation.set_groups([=](Mesh::Vertex_index v) {
      return is_middle(v) ? 0 : -1;
    }));
  };
  CGAL::ARAP::Options spokes, rings;
  spokes.cells = CGAL::ARAP::Cell_scheme::spokes();
  rings.cells = CGAL::ARAP::Cell_scheme::k_ring(3);
  std::vector<Panel> panels = {deformed_panel(bar, "all cells alike", spokes),
                               deformed_panel(bar, "stiff middle", spokes, stiff),
                               deformed_panel(bar, "one group", spokes, rigid),
                               deformed_panel(bar, "3-ring cells", rings)};
  for(Panel& p : panels)
    for(Mesh::Edge_index e : bar.mesh.edges())
      if(const auto v = bar.mesh.vertex(e, 0), w = bar.mesh.vertex(e, 1);
         is_middle(v) && is_middle(w))
        p.lines.push_back({int(v), int(w)});
  draw(panels, View{Vector(1, -0.25, 0.2), Vector(0, 0, 1), 400, 420}, folder / "stiffness.png");
}

// A handle inside a face, which is hard or soft. The handle is drawn as a ball.
void draw_control_point(const fs::path& folder)
{
  const Mesh rest = make_sheet(20, 10, [](const std::array<int, 3>& n) {
    return Point(0.1 * n[0], 0.1 * n[1], 0);
  });
  const std::vector<int> selection = select(rest, [](const Point& p) { return p.x() < 0.01; },
                                            [](const Point&) { return false; });
  Mesh mesh = rest;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  insert_selection(deformation, selection, translation(CGAL::NULL_VECTOR));
  const auto location = CGAL::ARAP::locate(mesh, Point(1.73, 0.52, 0));
  const auto handle = deformation.insert_control_point(*location);
  expect_success(handle);
  const auto panel_with_handle = [&](const std::string& caption) {
    Panel result = panel(mesh, selection, caption);
    add_balls(result, {deformation.control_point_position(handle.point)});
    return result;
  };
  std::vector<Panel> panels = {panel_with_handle("original")};
  deformation.translate(handle.point, Vector(-0.5, 0, 0.8));
  expect_success(deformation.deform());
  panels.push_back(panel_with_handle("a handle inside a face"));
  expect_success(deformation.set_target_weight(handle.point, 0.05));
  expect_success(deformation.deform());
  panels.push_back(panel_with_handle("soft"));
  draw(panels, View{Vector(-0.3, -1, 0.5), Vector(0, 0, 1), 360, 300, true},
       folder / "control_point.png");
}

// A sheet whose sides are pushed together arches, or folds if its cells are single triangles.
void draw_membrane(const fs::path& folder)
{
  const Mesh mesh = make_sheet(40, 20, [](const std::array<int, 3>& n) {
    return Point(0.05 * n[0], 0.05 * n[1], 0);
  });
  const Demo_shape sheet{"sheet", mesh,
                         select(mesh, [](const Point& p) { return p.x() < 0.01; },
                                [](const Point& p) { return p.x() > 0.99; }),
                         translation(Vector(-0.5, 0, 0)),
                         View{Vector(-0.35, -1, 0.5), Vector(0, 0, 1), 360, 260, true}};
  CGAL::ARAP::Options elements;
  elements.cells = CGAL::ARAP::Cell_scheme::elements();
  draw({panel(sheet.mesh, sheet.selection, "original"),
        deformed_panel(sheet, "spokes and rims", {}), deformed_panel(sheet, "elements", elements)},
       sheet.view, folder / "membrane.png");
}

// A sheet that is pulled to noisy points of a cylinder, which are drawn as balls, by hard targets
// and by soft ones of two weights.
void draw_soft_targets(const fs::path& folder)
{
  const Demo_shape sheet{"sheet", make_sheet(40, 20, [](const std::array<int, 3>& n) {
                           return Point(0.1 * n[0], 0.1 * n[1], 0);
                         }),
                         {}, {}, View{Vector(0.3, -1, 0.6), Vector(0, 0, 1), 350, 250, true}};
  std::vector<Panel> panels;
  for(const auto& [caption, weight] :
      {std::pair{"hard", std::numeric_limits<double>::infinity()}, {"weight 0.1", 0.1},
       {"weight 0.001", 0.001}})
  {
    Mesh mesh = sheet.mesh;
    CGAL::ARAP_deformation<Mesh> deformation(mesh);
    deformation.insert_roi_vertices(mesh.vertices());
    CGAL::Random random(1);
    const auto noise = [&random] { return random.get_double(-0.1, 0.1); };
    std::vector<Point> targets;
    for(Mesh::Vertex_index v : mesh.vertices())
      if(const Point& p = sheet.mesh.point(v); v.idx() % 7 == 0)
      {
        const double x = 2 * std::sin((p.x() - 2) / 2), z = 2 * std::cos((p.x() - 2) / 2);
        targets.emplace_back(x + noise(), p.y() + noise(), z + noise());
        deformation.insert_control_vertex(v, targets.back());
      }
    expect_success(deformation.set_target_weight(deformation.control_vertices(), weight));
    expect_success(deformation.deform());
    panels.push_back(panel(mesh, std::vector<int>(mesh.num_vertices(), FREE), caption));
    add_balls(panels.back(), targets);
  }
  draw(panels, sheet.view, folder / "soft.png");
}

// A bar that is hollow, and one that is filled with tetrahedra, are bent.
void draw_volume(const fs::path& folder)
{
  Demo_shape hollow = make_bar(1.5);
  hollow.transform = motion(0, 120, Point(0, 0, 71), Vector(0, -38, -24));
  Demo_volume filled = make_filled_bar();
  CGAL::ARAP_deformation<Domain> deformation(Domain(filled.mesh.points, filled.mesh.tetrahedra));
  insert_selection(deformation, filled.selection, hollow.transform);
  expect_success(deformation.deform());
  draw({panel(hollow.mesh, hollow.selection, "original"),
        deformed_panel(hollow, "a surface", {}),
        panel(filled.mesh, filled.selection, "tetrahedra")},
       View{Vector(1, -0.25, 0.2), Vector(0, 0, 1), 300, 420}, folder / "volume.png");
}

// A bar of soft rubber, in centimeters, that is held in its middle and falls in the direction -x.
void draw_fall(const fs::path& folder)
{
  Demo_volume bar = make_filled_bar(2);
  bar.selection = select(bar.mesh, [](const Point& p) { return std::abs(p.z() - 0.5) < 0.06; },
                         [](const Point&) { return false; });
  CGAL::ARAP_deformation<Domain> deformation(Domain(bar.mesh.points, bar.mesh.tetrahedra));
  insert_selection(deformation, bar.selection, translation(CGAL::NULL_VECTOR));
  CGAL::ARAP::Dynamics dynamics;
  dynamics.time_step = 0.01;
  dynamics.density = 0.001;
  dynamics.modulus = 20;
  dynamics.damping = 0.5;
  dynamics.acceleration = {-981, 0, 0};
  std::vector<Panel> panels = {panel(bar.mesh, bar.selection, "0 s")};
  for(int step = 1; step <= 30; ++step)
  {
    expect_success(deformation.advance(dynamics));
    if(step % 10 == 0)
      panels.push_back(panel(bar.mesh, bar.selection, "0." + std::to_string(step / 10) + " s"));
  }
  draw(panels, View{Vector(0.25, 1, 0.2), Vector(1, 0, 0), 300, 240}, folder / "fall.png");
}

// A sphere that is pulled to the points of a scan, which are drawn as balls.
void draw_registration(const fs::path& folder)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh,
                                               CGAL::parameters::number_of_iterations(4));
  const auto scanned = [](double x, double y, double z) {
    const double bumps = 1 + 0.1 * std::sin(5 * x) * std::cos(4 * y) * std::sin(3 * z);
    return Point(1.4 * bumps * x, bumps * y, 0.8 * bumps * z);
  };
  std::vector<Point> scan;
  for(int k = 0; k < 400; ++k) // on a spiral from pole to pole
  {
    const double z = 1 - (2 * k + 1) / 400.0, r = std::sqrt(1 - z * z), angle = 2.4 * k;
    scan.push_back(scanned(r * std::cos(angle), r * std::sin(angle), z));
  }
  const auto panel_with_scan = [&](const std::string& caption) {
    Panel result = panel(mesh, std::vector<int>(mesh.num_vertices(), FREE), caption);
    add_balls(result, scan);
    return result;
  };
  const Panel before = panel_with_scan("a sphere and a scan");
  using Deformation = CGAL::ARAP_deformation<Mesh>;
  Deformation deformation(mesh);
  deformation.insert_roi_vertices(mesh.vertices());
  for(int round = 0; round < 6; ++round)
  {
    const CGAL::ARAP::Locator<Deformation::Deformation_domain> locator(deformation.domain());
    deformation.clear_control_points();
    for(const Point& p : scan)
    {
      const auto inserted = deformation.insert_control_point(*locator.locate(p));
      expect_success(inserted);
      expect_success(deformation.set_target_weight(inserted.point, 20));
      expect_success(deformation.set_target_position(inserted.point, p));
    }
    expect_success(deformation.deform(20, 0));
  }
  draw({before, panel_with_scan("after six rounds")},
       View{Vector(0.4, -1, 0.3), Vector(0, 0, 1), 360, 300}, folder / "registration.png");
}

void print_title()
{
  std::cout << "\nresult                    vertices   free  iterations    energy  edge error"
               "   seconds\n";
}

nlohmann::json report_of(const fs::path& folder, const std::string& name)
{
  std::ifstream in(folder / (name + ".json"));
  return nlohmann::json::parse(in);
}

// a row of the table, from the report of the command
void print_row(const fs::path& folder, const std::string& name)
{
  const nlohmann::json report = report_of(folder, name);
  std::cout << std::left << std::setw(25) << name << std::right << std::setw(9)
            << report["vertices"].get<int>() << std::setw(7)
            << report["free_vertices"].get<int>() << std::setw(12)
            << report["iterations"].get<int>() << std::setprecision(4) << std::setw(10)
            << report["energy"].back().get<double>() << std::setprecision(3) << std::setw(12)
            << report["edge_length_error"].get<double>() << std::setw(10)
            << report["seconds"]["deform"].get<double>() << '\n';
}

// The sizes of the pictures that figures.sh computes, in pixels for each panel.
const std::map<std::string, std::array<int, 2>> figure_sizes = {
  {"figure_1", {320, 340}},        {"figure_3", {220, 290}},        {"figure_4", {340, 280}},
  {"figure_5_sheet", {280, 230}},  {"figure_5_cactus", {280, 280}}, {"figure_6", {270, 330}},
  {"figure_7", {220, 290}},        {"figure_7_side", {270, 290}},   {"figure_8_front", {330, 320}},
  {"figure_8_back", {330, 320}},   {"terms", {250, 330}},           {"quality", {280, 330}},
  {"frames", {200, 290}}};

// The commands that figures.sh has run: a line for each argument, and an empty one at the end.
std::vector<Command_line> read_commands(const fs::path& list)
{
  std::ifstream in(list);
  if(!in)
    throw std::runtime_error(list.string() + ": is missing; figures.sh writes it");
  std::vector<Command_line> commands;
  std::vector<std::string> arguments = {"arap_deform"};
  for(std::string argument; std::getline(in, argument);)
  {
    if(!argument.empty())
    {
      arguments.push_back(argument);
      continue;
    }
    std::vector<char*> argv;
    for(std::string& a : arguments)
      argv.push_back(a.data());
    commands.push_back(parse_command_line(static_cast<int>(argv.size()), argv.data()));
    arguments.resize(1);
  }
  return commands;
}

// A panel of what a command has computed, or of one of its frames.
Panel result_panel(const Command_line& line, const Mesh& rest, const std::string& file,
                   const std::string& caption)
{
  Mesh mesh = read_mesh(file);
  Panel result = panel(mesh, make_task(line, points_of(rest)).selection, caption);
  if(!line.color.empty())
    color(result, line.color, skin(mesh),
          CGAL::ARAP::quality_at_vertices(mesh, vertex_measure(line.color), rest.points()));
  return result;
}

// The figures of the commands in the manual, from their results: PICTURE_CAPTION.off is a panel of
// PICTURE.png, after the original; each of several frames is one.
void draw_figures(const fs::path& folder)
{
  check_renderer();
  draw_weights(folder);
  fs::current_path(folder); // where the commands were run
  const std::vector<Command_line> commands = read_commands("figures.txt");
  const auto name = [](const Command_line& line) { return fs::path(line.output).stem().string(); };
  const auto picture = [&](const Command_line& line) {
    return name(line).substr(0, name(line).rfind('_'));
  };
  std::vector<std::string> results;
  for(auto line = commands.begin(); line != commands.end();)
  {
    const std::string file = picture(*line);
    if(line->image.empty() && !line->is_sequence) // it only prepares another one
    {
      ++line;
      continue;
    }
    const Mesh rest = read_mesh(line->mesh);
    std::vector<Panel> panels = {panel(rest, std::vector<int>(rest.num_vertices(), FREE),
                                       "original")};
    View view = default_view(panels[0].points);
    if(!line->view.empty())
      view = turned(view, line->view);
    view.width = figure_sizes.at(file)[0];
    view.height = figure_sizes.at(file)[1];
    for(; line != commands.end() && picture(*line) == file; ++line)
    {
      results.push_back(name(*line));
      if(line->is_sequence)
        for(const std::string& frame : mesh_files(*line))
          panels.push_back(result_panel(*line, rest, frame, "frame " + std::to_string(
                                                              panels.size())));
      else
        panels.push_back(result_panel(*line, rest, line->output,
                                      name(*line).substr(file.size() + 1)));
    }
    draw(panels, view, file + ".png");
  }
  print_title();
  for(const std::string& result : results)
    print_row("", result);
}

// Table 1 of the paper, in Markdown. The reports are those at the minimum and after dragging.
void print_table(const fs::path& folder, std::istream& rows)
{
  std::cout << "\n| figure | model | vertices | the paper's error | ours, dragged "
            << "| ours, at the minimum | one of 3 iterations [ms] |\n"
            << "|:--|:--|--:|--:|--:|--:|--:|\n" << std::setprecision(2) << std::showpoint;
  std::string figure, model, error;
  while(rows >> figure >> model >> error)
    if(fs::exists(folder / ("dragged_" + figure + ".json"))) // else the model is missing
    {
      const auto dragged = report_of(folder, "dragged_" + figure);
      const auto at_minimum = report_of(folder, "figure_" + figure);
      std::cout << "| " << figure << " | " << model << " | " << dragged["vertices"].get<int>()
                << " | " << error << " | " << dragged["edge_length_error"].get<double>() << " | "
                << at_minimum["edge_length_error"].get<double>() << " | "
                << 1000 * dragged["seconds"]["deform"].get<double>() / 3 << " |\n";
    }
}

// Section 5 of the paper: a surface in many pieces follows a coarse volume around it.
void draw_embedding(const fs::path& folder)
{
  Soup palm = make_palm();
  Tetrahedral_mesh volume = make_lattice_around(palm, 0.17, 0.17);
  const Domain domain(volume.points, volume.tetrahedra);
  const CGAL::ARAP::Embedding embedding(domain, palm.points);
  if(!embedding.outcome())
    throw std::runtime_error(embedding.outcome().message);

  const Transform transform = motion(1, 50, Point(0, 0, 3.7), Vector(1.4, 0, -0.6));
  CGAL::ARAP_deformation<Domain> deformation(domain);
  std::vector<int> selection;
  for(const Point& p : volume.points)
  {
    const bool is_crown = p.z() > 3.5 && std::hypot(p.x(), p.y()) < 0.4;
    selection.push_back(p.z() < 0.3 ? FIXED : is_crown ? HANDLE : FREE);
  }
  insert_selection(deformation, selection, transform);
  const Panel before = panel(palm, volume, selection, "a surface in a coarse volume");
  const auto report = deformation.deform();
  expect_success(report);
  embedding.put_points(palm.points);
  std::cout << "  " << palm.points.size() << " points in " << volume.tetrahedra.size()
            << " tetrahedra\n";
  draw({before, panel(palm, volume, selection, "deformed")},
       View{Vector(0.3, -1, 0.3), Vector(0, 0, 1), 480, 480}, folder / "embedding.png");
}

void draw_pictures(const fs::path& folder, const fs::path& meshes)
{
  std::cout << "Pictures:\n";
  check_renderer();
  const std::vector<Demo_shape> all = models(meshes);
  const Demo_volume volume = make_filled_bar();
  for(const Demo_shape& model : all)
    draw_model(folder, model);
  draw_model(folder, volume);
  draw_embedding(folder);
  draw_bending(folder);
  draw_frame(folder);
  draw_stiffness(folder);
  draw_control_point(folder);
  draw_membrane(folder);
  draw_soft_targets(folder);
  draw_volume(folder);
  draw_fall(folder);
  draw_registration(folder);

  print_title();
  for(const Demo_shape& model : all)
    print_row(folder, model.name);
  print_row(folder, volume.name);
}

} // namespace

int main(int argc, char** argv)
{
  const std::string action = argc > 1 ? argv[1] : "";
  if(argc < 3 || argc > 4 ||
     (action != "models" && action != "pictures" && action != "figures" && action != "table"))
  {
    std::cerr << "usage: arap_demo models|pictures|figures|table FOLDER [MESHES]\n";
    return 2;
  }
  try
  {
    const fs::path folder = argv[2], meshes = argc > 3 ? argv[3] : "";
    if(action == "models")
      write_models(folder, meshes);
    else if(action == "figures")
      draw_figures(folder);
    else if(action == "table")
      print_table(folder, std::cin);
    else
      draw_pictures(folder, meshes);
    return EXIT_SUCCESS;
  }
  catch(const std::exception& error)
  {
    std::cerr << "arap_demo: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
