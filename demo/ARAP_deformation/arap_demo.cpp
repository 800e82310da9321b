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
//                                      figures of the paper that take more than one run; prints a
//                                      table

#include "demo_shapes.h"
#include "embedded_shape.h"
#include "mesh_panel.h"
#include "read_mesh.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Embedding.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <set>
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
  mesh.commit();
  std::ofstream selection(folder / (model.name + ".sel"));
  std::ofstream transform(folder / (model.name + ".def"));
  for(int status : model.selection)
    selection << status << '\n';
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
  output.commit();
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
            << CGAL::ARAP::relative_edge_length_error(mesh, shape.mesh.points(), mesh.points())
            << '\n';
  return panel(mesh, shape.selection, caption);
}

Panel deformed_panel(const Demo_shape& shape, const std::string& caption,
                     const CGAL::ARAP::Options& options)
{
  return deformed_panel(shape, caption, options, [](const auto&) {});
}

using Traits = CGAL::ARAP_deformation_traits<>;
using Uniform_traits =
  CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Uniform_weight>;

// Figure 3 of the paper: iterations on a bent bar, from the distorted guess of naive Laplacian
// editing.
void draw_iterations(const fs::path& folder)
{
  Demo_shape bar = make_bar(2);
  bar.transform = motion(0, 120, Point(0, 0, 71), Vector(0, -38, -24));
  Mesh mesh = bar.mesh, iterate_mesh = bar.mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  CGAL::ARAP::Options options;
  options.cells = CGAL::ARAP::Cell_scheme::spokes();
  options.initial_guess = CGAL::ARAP::Initial_guess::laplacian;
  expect_success(deformation.set_options(options));
  insert_selection(deformation, bar.selection, bar.transform);

  const std::set<unsigned int> shown = {0, 1, 2, 5, 10, 100};
  std::vector<Panel> panels;
  const auto report = deformation.deform(*shown.rbegin(), 0, [&](const auto& iterate) {
    if(shown.count(iterate.iteration()))
    {
      iterate.put_points(iterate_mesh.points());
      panels.push_back(panel(iterate_mesh, bar.selection,
                             iterate.iteration() == 0 ? "initial guess"
                                                      : std::to_string(iterate.iteration())));
    }
    return CGAL::ARAP::Visitor_action::proceed;
  });
  expect_success(report);
  draw(panels, View{Vector(1, -0.25, 0.2), Vector(0, 0, 1), 300, 420},
       folder / "iterations.png");
}

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

// A pulled vertex is a spike without bending.
void draw_bending(const fs::path& folder)
{
  const Demo_shape sheet = make_pulled_sheet();
  CGAL::ARAP::Options bending;
  bending.bending_length = 0.05 * std::sqrt(2.0); // a share of the diagonal
  draw({deformed_panel(sheet, "without bending", {}),
        deformed_panel(sheet, "with bending", bending)},
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

// Figure 5 of the paper: a handle is only translated. Previews, which have no iteration, fail.
void draw_previews(const fs::path& folder)
{
  const Demo_shape plane = make_spiky_plane();
  CGAL::ARAP::Options poisson, laplacian;
  poisson.initial_guess = CGAL::ARAP::Initial_guess::rotations;
  laplacian.initial_guess = CGAL::ARAP::Initial_guess::laplacian;
  poisson.iterations = laplacian.iterations = 0;
  draw({panel(plane.mesh, plane.selection, "original"),
        deformed_panel(plane, "Poisson editing", poisson),
        deformed_panel(plane, "Laplacian editing", laplacian),
        deformed_panel(plane, "as rigid as possible", {})},
       View{plane.view.from, plane.view.up, 420, 330}, folder / "previews.png");
}

// a row of the table, from the report of the command
void print_row(const fs::path& folder, const std::string& name)
{
  std::ifstream in(folder / (name + ".json"));
  const auto report = nlohmann::json::parse(in);
  std::cout << std::left << std::setw(13) << name << std::right << std::setw(9)
            << report["vertices"].get<int>() << std::setw(7)
            << report["free_vertices"].get<int>() << std::setw(12)
            << report["iterations"].get<int>() << std::setprecision(4) << std::setw(10)
            << report["energy"].back().get<double>() << std::setprecision(3) << std::setw(12)
            << report["edge_length_error"].get<double>() << std::setw(10)
            << report["seconds"]["deform"].get<double>() << '\n';
}

// Section 5 of the paper: a surface in many pieces follows a coarse volume around it.
void draw_embedding(const fs::path& folder)
{
  Soup<3> palm = make_palm();
  Soup<4> volume = make_lattice_around(palm, 0.17, 0.17);
  using Domain =
    CGAL::ARAP::Simplex_soup_domain<3, std::vector<Point>, std::vector<std::array<int, 4>>>;
  const Domain domain(volume.points, volume.simplices);
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
  std::cout << "  " << palm.points.size() << " points in " << volume.simplices.size()
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
  draw_iterations(folder);
  draw_weights(folder);
  draw_embedding(folder);
  draw_bending(folder);
  draw_frame(folder);
  draw_stiffness(folder);
  draw_previews(folder);

  std::cout << "\nmodel         vertices   free  iterations    energy  edge error   seconds\n";
  for(const Demo_shape& model : all)
    print_row(folder, model.name);
  print_row(folder, volume.name);
}

} // namespace

int main(int argc, char** argv)
{
  const std::string action = argc > 1 ? argv[1] : "";
  if(argc < 3 || argc > 4 || (action != "models" && action != "pictures"))
  {
    std::cerr << "usage: arap_demo models|pictures FOLDER [MESHES]\n";
    return 2;
  }
  try
  {
    const fs::path folder = argv[2], meshes = argc > 3 ? argv[3] : "";
    if(action == "models")
      write_models(folder, meshes);
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
