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

// The command arap_deform on surfaces, run as a user runs it: results, report, formats, and what it
// says and leaves behind when it is given nonsense. Its path is the argument; without it nothing is
// tested.

#include "include/check.h"
#include "include/command.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// a tube of about a hundred vertices, twisted
const Shape shape = grid("tube", 8, 12, [](double u, double v) {
  const double angle = 2 * std::acos(-1.0) * u;
  return Eigen::Vector3d(std::cos(angle), std::sin(angle), 5 * v);
}, true);

std::string off(const Shape& s)
{
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n" << s.points.size() << ' ' << s.triangles.size() << " 0\n";
  for(const auto& p : s.points)
    out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for(const auto& t : s.triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

int status(const Eigen::Vector3d& p) { return p.z() < 0.5 ? 0 : p.z() > 4.5 ? 2 : 1; }

std::string selection()
{
  std::string text = "# one status a vertex\n\n";
  for(const auto& p : shape.points)
    text += std::to_string(status(p)) + " # a comment\n";
  return text;
}

const std::string quarter_turn = "# about the z axis\n0 -1 0 0\n1 0 0 0\n0 0 1 0.5\n0 0 0 1\n";

void test_success()
{
  test_case() = "a run";
  Mesh mesh = make_mesh<Mesh>(shape);
  const Mesh rest = mesh;
  CGAL::ARAP_deformation<Mesh> d(mesh);
  for(auto v : mesh.vertices())
  {
    const auto& p = shape.points[v];
    if(status(p) != 0)
      d.insert_roi_vertex(v);
    if(status(p) == 2)
    {
      d.insert_control_vertex(v);
      d.set_target_position(v, Point(-p.y(), p.x(), p.z() + 0.5));
    }
  }
  const auto report = d.deform(30, 0);

  const Run done = run("in.off --selection in.sel --transform in.def -o out.off --report r.json "
                       "--iterations 30 --tolerance 0");
  CHECK(done.exit_code == 0);
  CHECK(done.err.empty()); // no progress where there is no terminal
  CHECK(done.out.find("30 iterations") != std::string::npos);
  Mesh result;
  CHECK(CGAL::IO::read_polygon_mesh((folder / "out.off").string(), result));
  CHECK(result.number_of_faces() == mesh.number_of_faces());
  for(auto v : mesh.vertices())
    CHECK(result.point(v) == mesh.point(v)); // written to the last digit

  const auto json = nlohmann::json::parse(content(folder / "r.json"));
  CHECK(json["status"] == "iteration_limit");
  CHECK(!json["message"].get<std::string>().empty());
  CHECK(json["vertices"] == mesh.number_of_vertices());
  CHECK(json["simplices"] == mesh.number_of_faces());
  CHECK(json["free_vertices"] == report.free_vertices);
  CHECK(json["iterations"] == 30);
  CHECK(json["energy"].get<std::vector<double>>() == report.energy);
  CHECK(json["estimated_relative_gap"] == report.estimated_relative_gap);
  CHECK_AT_MOST(std::abs(json["edge_length_error"].get<double>() -
                         CGAL::ARAP::relative_edge_length_error(mesh, rest.points(),
                                                                mesh.points())), 1e-14);
  CHECK(json["inverted_simplices"] == 0);
  for(const char* phase : {"load", "preprocess", "deform"})
    CHECK(json["seconds"][phase].get<double>() >= 0);
  CHECK(json["peak_memory_bytes"].get<long long>() > 1000000);

  test_case() = "a degenerate triangle, and a part that nothing holds";
  Shape degenerate = shape;
  degenerate.points[40] = degenerate.points[41];
  degenerate.points.insert(degenerate.points.end(), {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}});
  degenerate.triangles.push_back({degenerate.points.size() - 3, degenerate.points.size() - 2,
                                  degenerate.points.size() - 1});
  write("degenerate.off", off(degenerate));
  write("degenerate.sel", content(folder / "in.sel") + "1\n1\n1\n");
  const Run unconstrained = run(
    "degenerate.off --selection degenerate.sel --transform in.def -o new.off "
    "--report new.json");
  CHECK(unconstrained.exit_code == 0);
  CHECK(unconstrained.out.find("unconstrained component") != std::string::npos);
  CHECK(nlohmann::json::parse(content(folder / "new.json"))["unconstrained_components"] ==
        std::vector<std::size_t>(1, shape.points.size()));
  for(const std::string file : {"degenerate.off", "degenerate.sel", "new.off", "new.json"})
    fs::remove(folder / file);

  test_case() = "quiet";
  const std::string before = content(folder / "out.off");
  const Run quiet = run("in.off --selection in.sel --transform in.def -o out.off --quiet "
                        "--iterations 30 --tolerance 0");
  CHECK(quiet.exit_code == 0 && quiet.out.empty() && quiet.err.empty());
  CHECK(content(folder / "out.off") == before);

  test_case() = "formats";
  for(const std::string from : {"in.off", "copy.obj", "copy.ply", "copy.stl"})
    for(const std::string to : {"copy.off", "copy.obj", "copy.ply", "copy.stl"})
    {
      if(from == "in.off")
        CHECK(CGAL::IO::write_polygon_mesh((folder / to).string(), rest,
                                           CGAL::parameters::stream_precision(17)));
      const Run converted = run(from + " --selection in.sel --transform in.def -o new." +
                                to.substr(5) + " --iterations 3");
      // an .stl file numbers the vertices as they appear: the selection may not fit, but it is read
      CHECK(converted.exit_code == 0);
      Mesh copy;
      CHECK(CGAL::IO::read_polygon_mesh((folder / ("new." + to.substr(5))).string(), copy));
      CHECK(copy.number_of_faces() == mesh.number_of_faces());
    }

#if defined(__unix__) || defined(__APPLE__)
  test_case() = "links, permissions, devices";
  const std::string call = "in.off --selection in.sel --transform in.def --iterations 1 ";
  write("target.off", "old");
  fs::permissions(folder / "target.off", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target.off", folder / "link.off");
  CHECK(run(call + "-o link.off").exit_code == 0);
  CHECK(fs::is_symlink(folder / "link.off"));
  CHECK(content(folder / "target.off").substr(0, 3) == "OFF");
  CHECK(fs::status(folder / "target.off").permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write));
  const Run to_device = run(call + "-o new.off --quiet --report /dev/stdout");
  CHECK(to_device.exit_code == 0);
  CHECK(nlohmann::json::parse(to_device.out)["status"] == "iteration_limit");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(run(call + "-o new.off --report /dev/null").exit_code == 0);
  CHECK(fs::is_character_file("/dev/null"));
  for(const std::string extension : {"off", "obj", "ply", "stl"}) // a full disk
  {
    const auto names = files();
    const int full = std::system(
      ("cd \"" + folder.string() + "\" && (ulimit -f 4; \"" + command + "\" " + call +
       "-o full." + extension + " > /dev/null 2>&1)").c_str());
    CHECK(WIFEXITED(full) && WEXITSTATUS(full) == 1);
    CHECK(files() == names);
  }
  const auto names = files();
  const int interrupted = std::system(
    ("cd \"" + folder.string() + "\" && (timeout -s INT 0.5 \"" + command + "\" in.off --selection "
     "in.sel --transform in.def -o new2.off --iterations 100000000 --tolerance 0 > /dev/null 2>&1; "
     "exit $?)").c_str());
  CHECK(WIFEXITED(interrupted) && WEXITSTATUS(interrupted) != 0);
  CHECK(files() == names);

  test_case() = "picture";
  if(std::system("povray --version > /dev/null 2>&1") == 0)
  {
    CHECK(run(call + "-o new.off --image picture.png").exit_code == 0);
    CHECK(content(folder / "picture.png").substr(1, 3) == "PNG");
    CHECK(content(folder / "picture.png").size() > 10000);
  }
  else
    std::cout << "NOTICE: povray is not installed; no picture was tested" << std::endl;
  const std::string shell_command = command;
  command = "/usr/bin/env\" PATH=/nonexistent \"" + shell_command; // where there is no povray
  // it is missed before anything else is looked at
  const Run no_povray = run("missing.off --selection in.sel --transform in.def -o other.off "
                            "--image other.png");
  CHECK(no_povray.exit_code == 1);
  CHECK(no_povray.err.find("povray") != std::string::npos);
  CHECK(!fs::exists(folder / "other.off") && !fs::exists(folder / "other.png"));
  command = shell_command;
#endif

  test_case() = "choices";
  std::set<std::string> energies;
  for(const std::string choice :
      {"--cells spokes", "--cells elements", "--cells spokes_and_rims", "--weights uniform",
       "--initial_guess laplacian", "--cells spokes --weights uniform"})
  {
    CHECK(run("in.off --selection in.sel --transform in.def -o out.off --report r.json "
              "--minimizer local_global --iterations 2 " + choice).exit_code == 0);
    energies.insert(nlohmann::json::parse(content(folder / "r.json"))["energy"].dump());
  }
  CHECK(energies.size() == 6);

  test_case() = "threads";
  std::set<std::string> results;
  for(const std::string threads : {"0", "1", "2"})
  {
    CHECK(run("in.off --selection in.sel --transform in.def -o out.off --threads " + threads)
            .exit_code == 0);
    results.insert(content(folder / "out.off"));
  }
  CHECK(results.size() == 1);
}

// A tube of quads with two octagons as lids: polygons are deformed, and stay what they are.
void test_polygons()
{
  test_case() = "polygons";
  const int rings = 6, corners = 8;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces(2);
  std::string statuses;
  for(int i = 0; i < rings; ++i)
    for(int j = 0; j < corners; ++j)
    {
      const double angle = 2 * std::acos(-1.0) * j / corners;
      points.emplace_back(std::cos(angle), std::sin(angle), i);
      statuses += i == 0 ? "0\n" : i == rings - 1 ? "2\n" : "1\n";
    }
  for(int j = 0; j < corners; ++j)
  {
    faces[0].push_back(corners - 1 - j);
    faces[1].push_back((rings - 1) * corners + j);
    for(int i = 0; i + 1 < rings; ++i)
    {
      const std::size_t a = i * corners + j, b = i * corners + (j + 1) % corners;
      faces.push_back({a, b, b + corners, a + corners});
    }
  }
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, mesh);
  const Mesh rest = mesh;
  write("tube.sel", statuses);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  for(auto v : mesh.vertices())
  {
    const Point& p = rest.point(v);
    if(p.z() > 0)
      d.insert_roi_vertex(v);
    if(p.z() == rings - 1)
    {
      d.insert_control_vertex(v);
      d.set_target_position(v, Point(-p.y(), p.x(), p.z() + 0.5));
    }
  }
  const auto report = d.deform(10, 0);
  CHECK(report);

  const std::string call = " --selection tube.sel --transform in.def --iterations 10 "
                           "--tolerance 0 --report r.json -o new.";
  for(const std::string extension : {"off", "obj", "ply"})
  {
    CHECK(CGAL::IO::write_polygon_mesh((folder / ("tube." + extension)).string(), rest,
                                       CGAL::parameters::stream_precision(17)));
    CHECK(run("tube." + extension + call + extension).exit_code == 0);
    Mesh result;
    CHECK(CGAL::IO::read_polygon_mesh((folder / ("new." + extension)).string(), result));
    CHECK(result.number_of_faces() == mesh.number_of_faces());
    for(auto f : result.faces())
      CHECK(result.degree(f) == (std::size_t(f) < 2 ? 8 : 4));
    if(extension == "ply")
      continue; // CGAL writes points there as float or as double, depending on the version
    for(auto v : mesh.vertices())
      CHECK(result.point(v) == mesh.point(v));
    const auto json = nlohmann::json::parse(content(folder / "r.json"));
    CHECK(json["simplices"] == faces.size());
    CHECK(json["energy"].get<std::vector<double>>() == report.energy);
    CHECK_AT_MOST(std::abs(json["edge_length_error"].get<double>() -
                           CGAL::ARAP::relative_edge_length_error(mesh, rest.points(),
                                                                  mesh.points())), 1e-14);
  }
  if(std::system("povray --version > /dev/null 2>&1") == 0)
    CHECK(run("tube.off" + call + "off --image tube.png").exit_code == 0);
  write("precious.off", "precious");
  check_refused("tube.off" + call + "stl", 1,
                "new.stl: an .stl file holds triangles only, but face");
}

void test_refusals()
{
  write("precious.off", "precious");
  const std::string rest = " --selection in.sel --transform in.def -o precious.off";
  const auto mesh = [&](const std::string& file, const std::string& phrase) {
    check_refused(file + rest, 1, phrase);
  };
  mesh("missing.off", "missing.off: there is no such file");
  mesh(".", "ends in .off, .obj, .ply, .stl or .mesh");
  mesh("volume.meshb", "ends in .off, .obj, .ply, .stl or .mesh");
  for(const std::string extension : {"off", "obj", "ply", "stl"})
  {
    write("empty." + extension, "");
    mesh("empty." + extension, "is empty");
    write("garbage." + extension, "this is no mesh\n1 2 3\n");
    mesh("garbage." + extension, "garbage." + extension + ": ");
  }
  const std::string text = off(shape);
  write("half.off", text.substr(0, text.size() / 2));
  mesh("half.off", "half.off: vertex 78 is missing");
  write("nothing.off", "OFF\n0 0 0\n");
  mesh("nothing.off", "has no faces");
  for(const std::string bad : {"nan", "inf", "NaN"})
  {
    write("bad.off", "OFF\n" + text.substr(4, text.find('\n', 4) - 3) + bad +
                       text.substr(text.find(' ', text.find('\n', 4))));
    mesh("bad.off", "bad.off: ");
  }
  Shape wrong = shape;
  wrong.triangles[5][0] = 9999;
  write("index.off", off(wrong));
  mesh("index.off", "index.off: ");
  wrong.triangles[5] = wrong.triangles[6];
  write("doubled.off", off(wrong));
  mesh("doubled.off", "doubled.off: face 6 has a vertex twice, or is no oriented manifold");
  write("line.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n");
  mesh("line.off", "line.off: ");

  const auto select = [&](const std::string& file, const std::string& phrase) {
    check_refused("in.off --selection " + file + " --transform in.def -o precious.off", 1, phrase);
  };
  const std::string good = selection();
  select("missing.sel", "missing.sel: there is no such file");
  write("bad.sel", good + "1\n");
  select("bad.sel", "has 105 statuses, but the mesh has 104 vertices");
  write("bad.sel", good.substr(0, good.size() - 16));
  select("bad.sel", "has 103 statuses, but the mesh has 104 vertices");
  write("bad.sel", "1\n1\n3\n" + good);
  select("bad.sel", "bad.sel, line 3: unknown status 3");
  write("bad.sel", "1\none\n" + good);
  select("bad.sel", "bad.sel, line 2: expected one integer");
  write("bad.sel", "1.5\n" + good);
  select("bad.sel", "bad.sel, line 1: expected one integer");
  std::string free_text;
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    free_text += "1\n";
  write("bad.sel", free_text);
  select("bad.sel", "fix a vertex of its component");

  const auto transform = [&](const std::string& matrix, const std::string& phrase) {
    write("bad.def", matrix);
    check_refused("in.off --selection in.sel --transform bad.def -o precious.off", 1, phrase);
  };
  transform("", "bad.def: is empty");
  transform("# 1 2 3\n", "bad.def: has 0 numbers");
  transform("1 0 0 0\n0 1 0 0\n0 0 1 0\n", "bad.def: has 12 numbers");
  transform("1 0 0 0\n0 1 0 nan\n0 0 1 0\n0 0 0 1\n", "bad.def, line 2: 'nan' is not a finite");
  transform("1 0 0 0\n0 1 0 1e999\n0 0 1 0\n0 0 0 1\n", "bad.def, line 2: '1e999'");
  transform("1 0 0 0\n0 1 0 x2\n0 0 1 0\n0 0 0 1\n", "bad.def, line 2: 'x2'");
  transform("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 2\n", "the last row of the transform");
  transform("1 0 0 1e200\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "overflow");

  transform("0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 1\n", "the transform is singular");
  transform("1 2 3 0\n2 4 6 0\n0 0 1 0\n0 0 0 1\n", "the transform is singular");

  const std::string good_call = "in.off --selection in.sel --transform in.def ";
  check_refused(good_call + "-o no/such/folder/out.off", 1, "no/such/folder/out.off: cannot be");
  check_refused(good_call + "-o out.xyz", 1, "out.xyz: the name of a mesh file ends in");
  check_refused(good_call + "-o new.off --report no/such/folder/r.json", 1, "cannot be written");
  check_refused(good_call + "-o out.mesh", 1, "--output out.mesh: the surface of in.off can only");
  fs::create_directory(folder / "folder.off");
  check_refused(good_call + "-o folder.off", 1, "folder.off: cannot be written");

  check_refused(good_call + "-o new.off --report new.off", 2, "new.off is given for two things");
  check_refused(good_call + "-o new.off --report ./in.off", 2, "is given for two things");
  check_refused(good_call + "-o new.off --report in.sel", 2, "is given for two things");
  check_refused(good_call + "-o new.off --image picture.jpg", 2, ".png");
  check_refused("", 2, "no mesh is given");
  check_refused(good_call, 2, "output");
  check_refused("in.off -o new.off --transform in.def", 2, "selection");
  check_refused("in.off -o new.off --selection in.sel", 2, "transform");
  check_refused("in.off in.off" + rest, 2, "positional");
  check_refused("in.off --frobnicate" + rest, 2, "frobnicate");
  check_refused("in.off --cells dinner" + rest, 2, "spokes, spokes_and_rims, elements");
  check_refused("in.off --weights none" + rest, 2, "cotangent, clamped_cotangent, uniform");
  check_refused("in.off --minimizer newton" + rest, 2, "automatic, local_global, quasi_newton");
  check_refused("in.off --initial_guess none" + rest, 2, "previous, laplacian");
  check_refused("in.off --iterations -3" + rest, 2, "--iterations");
  check_refused("in.off --iterations many" + rest, 2, "iterations");
  check_refused("in.off --threads -1" + rest, 2, "--threads");
  check_refused("in.off --tolerance -1" + rest, 2, "tolerance");
  check_refused("in.off --tolerance nan" + rest, 2, "tolerance");
}

void test_help()
{
  test_case() = "help";
  const Run help = run("--help");
  CHECK(help.exit_code == 0 && help.err.empty());
  for(const char* option :
      {"--selection", "--transform", "--output", "--report", "--image", "--cells", "--weights",
       "--minimizer", "--initial_guess", "--iterations", "--tolerance", "--threads",
       "--quiet"})
    CHECK(help.out.find(option) != std::string::npos);
}

int main(int argc, char** argv)
{
  return test_command(argc, argv, [] {
    write("in.off", off(shape));
    write("in.sel", selection());
    write("in.def", quarter_turn);
    test_help();
    test_success();
    test_polygons();
    test_refusals();
  });
}
