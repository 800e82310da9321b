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

// The command arap_deform on surfaces and tetrahedra, run as a user runs it: results, report,
// formats, and what it says and leaves behind when it is given nonsense.
// usage: test_command PATH_OF_ARAP_DEFORM [FOLDER_OF_MODELS]

#include "include/check.h"
#include "include/command.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/of_simplices.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/version.h>

#include <Eigen/Geometry>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

fs::path models; // the folder of those that the help names

#if defined(__unix__) || defined(__APPLE__)
// The scene of which a run with these arguments makes a picture, or the first picture of a film: it
// is drawn by a program that copies it.
std::string scene(const std::string& arguments, const std::string& output = "--image scene.png")
{
  fs::create_directory(folder / "renderer");
  write("renderer/povray", "#!/bin/sh\ntest \"$1\" = --version || cp \"${1#+I}\" \"${2#+O}\"\n");
  fs::permissions(folder / "renderer/povray", fs::perms::owner_all);
  write("renderer/ffmpeg", "#!/bin/sh\ntest \"$1\" = -version || cp 0000.ppm film.webm\n");
  fs::permissions(folder / "renderer/ffmpeg", fs::perms::owner_all);
  const std::string shell_command = command;
  command = "/usr/bin/env\" \"PATH=" + (folder / "renderer").string() + ":/usr/bin:/bin\" \"" +
            command;
  CHECK(run(arguments + ' ' + output).exit_code == 0);
  command = shell_command;
  return content(folder / output.substr(output.find(' ') + 1));
}

#endif

// A run with these arguments makes a picture, which takes seconds to draw.
void check_picture(const std::string& arguments)
{
  if(std::system("povray --version > /dev/null 2>&1") != 0)
  {
    std::cout << "NOTICE: povray is not installed; no picture was tested" << std::endl;
    return;
  }
  CHECK(run(arguments + " --image picture.png").exit_code == 0);
  const std::string picture = content(folder / "picture.png");
  CHECK(picture.substr(0, 4) == "\x89PNG");
  CHECK(picture.size() > 10000);
}

std::string text_of(const Eigen::Matrix4d& map)
{
  std::ostringstream out;
  out.precision(17);
  out << map << '\n';
  return out.str();
}

// The command arap_deform on surfaces, run as a user runs it: results, report, formats, and what it
// says and leaves behind when it is given nonsense.
namespace surfaces {

Shape tube(int corners, int rings)
{
  return grid("tube", corners, rings, [](double u, double v) {
    const double angle = 2 * std::acos(-1.0) * u;
    return Eigen::Vector3d(std::cos(angle), std::sin(angle), 5 * v);
  }, true);
}

const Shape shape = tube(8, 12);

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
    if(status(shape.points[v]) == 1) // another program, and other roundings
      CHECK_AT_MOST(distance(vector(result.point(v)), vector(mesh.point(v))), 1e-13);
    else
      CHECK(result.point(v) == mesh.point(v)); // written to the last digit

  const auto json = nlohmann::json::parse(content(folder / "r.json"));
  CHECK(json["status"] == "iteration_limit");
  CHECK(!json["message"].get<std::string>().empty());
  CHECK(json["vertices"] == mesh.number_of_vertices());
  CHECK(json["simplices"] == mesh.number_of_faces());
  CHECK(json["free_vertices"] == report.free_vertices);
  CHECK(json["initial_guess"] == to_string(report.initial_guess));
  CHECK(json["iterations"] == 30);
  const auto energy = json["energy"].get<std::vector<double>>();
  if(CHECK(energy.size() == report.energy.size()))
    for(std::size_t k = 0; k < energy.size(); ++k)
      CHECK_AT_MOST(std::abs(energy[k] / report.energy[k] - 1), 1e-12);
  CHECK_AT_MOST(std::abs(json["estimated_relative_gap"].get<double>() /
                         report.estimated_relative_gap - 1), 1e-6);
  CHECK(json["end"] == "unknown" && json["saddles_left"] == 0 && json["plateaus_left"] == 0);
  CHECK_AT_MOST(std::abs(json["edge_length_error"].get<double>() -
                         CGAL::ARAP::quality(mesh, rest.points()).edge_length_error),
                1e-14);
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
  degenerate.triangles.pop_back();
  write("degenerate.off", off(degenerate));
  const Run strays = run("degenerate.off --selection degenerate.sel --transform in.def -o new.off");
  CHECK(strays.out.find("\nfree vertices that are in no face, and stay: 3\n") !=
        std::string::npos);
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
  const Run with_summary = run(call + "-o new.off --report /dev/stdout");
  CHECK(nlohmann::json::parse(with_summary.out, nullptr, false)["status"] == "iteration_limit");
  CHECK(with_summary.err.find("1 iterations") != std::string::npos);
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
    ("cd \"" + folder.string() + "\" && (timeout -s INT -k 20 1 \"" + command +
     "\" in.off --selection in.sel --transform in.def -o new2.off --iterations 100000000 "
     "--tolerance 0 > /dev/null 2>&1; exit $?)").c_str());
  CHECK(WIFEXITED(interrupted) && WEXITSTATUS(interrupted) == 124); // so says timeout
  CHECK(files() == names);

  test_case() = "picture";
  check_picture(call + "-o new.off");
  const std::string shell_command = command;
  command = "/usr/bin/env\" PATH=/nonexistent \"" + shell_command; // where there is no povray
  // it is missed before anything else is looked at
  const Run no_povray = run("missing.off --selection in.sel --transform in.def -o other.off "
                            "--image other.png");
  CHECK(no_povray.exit_code == 1);
  CHECK(no_povray.err.find("povray") != std::string::npos);
  CHECK(!fs::exists(folder / "other.off") && !fs::exists(folder / "other.png"));
  command = "/usr/bin/env\" TMPDIR=/nonexistent \"" + shell_command;
  const Run no_folder = run(call + "-o other.off --image other.png");
  CHECK(no_folder.exit_code == 1);
  CHECK(no_folder.err.find("there is no folder for temporary files") != std::string::npos);
  command = shell_command;

  test_case() = "view and colors of a picture";
  const std::string from_x = scene(call + "-o new.off --view 0,0");
  CHECK(from_x == scene(call + "-o new.off --view 2,0,0"));
  for(const std::string length : {"1e-200", "1e200"})
    CHECK(from_x == scene(call + "-o new.off --view " + length + ",0,0"));
  CHECK(from_x != scene(call + "-o new.off"));
  for(const std::string axis : {"1,0,0", "0,1,0", "0,0,-1"}) // also where it points upwards
    CHECK(scene(call + "-o new.off --view " + axis).find("nan") == std::string::npos);
  CHECK(from_x.find("\"after\"") != std::string::npos);
  const std::string colored = scene(call + "-o new.off --view 0,0 --color edge_error");
  CHECK(colored.find("\"edge_error up to ") != std::string::npos);
  const auto faces_of = [](const std::string& text) {
    return text.substr(0, text.find("Caption"));
  };
  CHECK(faces_of(colored) == faces_of(from_x)); // before the run all is as without colors
  const auto spheres_of = [&](const std::string& color) { // where no face shows a handle
    const std::string text =
      scene("in.off --fix z:..1 --handle list:100 --move 0,0,0.1 -o new.off" + color);
    int number = 0;
    for(std::size_t place = 0; (place = text.find("sphere {", place)) != std::string::npos; ++place)
      ++number;
    return number;
  };
  CHECK(spheres_of("") == 2 && spheres_of(" --color edge_error") == 1);
  for(const std::string height : {"1", "4"}) // of a bend of 45 degrees, and of one of 76
  {
    write("bend.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 " + height +
                        "\n3 0 1 2\n3 1 0 3\n");
    const std::string bent = scene("bend.off --handle x:0.. --move 0,0,1 -o new.off");
    const std::string normals = height == "4" ? "8,\n" : "4,\n"; // of vertices; of sharp corners
    CHECK(bent.find("normal_vectors { " + normals) != std::string::npos);
  }
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
  write("large.off", off(tube(60, 50))); // several blocks of vertices
  std::set<std::string> results;
  for(const std::string threads : {"0", "1", "2"})
  {
    CHECK(run("large.off --fix z:..0.5 --handle z:4.5.. --rotate z 90 -o out.off --threads " +
              threads).exit_code == 0);
    results.insert(content(folder / "out.off"));
  }
  fs::remove(folder / "large.off");
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
    // not the same bits: the command is optimized in another way, with other fused operations
    for(auto v : mesh.vertices())
      CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(result.point(v), mesh.point(v))), 1e-14);
    const auto json = nlohmann::json::parse(content(folder / "r.json"));
    CHECK(json["simplices"] == faces.size());
    const auto energy = json["energy"].get<std::vector<double>>();
    CHECK(energy.size() == report.energy.size());
    for(std::size_t k = 0; k < energy.size() && k < report.energy.size(); ++k)
      CHECK_AT_MOST(std::abs(energy[k] - report.energy[k]), 1e-13 * report.energy[0]);
    CHECK_AT_MOST(std::abs(json["edge_length_error"].get<double>() -
                           CGAL::ARAP::quality(mesh, rest.points()).edge_length_error),
                  1e-14);
  }
  if(is_long_run())
    check_picture("tube.off" + call + "off");
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
  for(const std::string file : {".", "volume.meshb"})
    check_refused(file + rest, 2, "ends in .off, .obj, .ply, .stl, .gltf, .glb, .mesh");
  for(const std::string extension : {"off", "obj", "ply", "stl"})
  {
    write("empty." + extension, "");
    mesh("empty." + extension, "is empty");
    write("garbage." + extension, "this is no mesh\n1 2 3\n");
    mesh("garbage." + extension, "garbage." + extension +
                                   (extension == "obj" ? ", line 1: 'this' is not a" : ": "));
  }
  const std::string text = off(shape);
  write("half.off", text.substr(0, text.size() / 2));
  mesh("half.off", "half.off: vertex 77 does not have three finite coordinates");
  write("nothing.off", "OFF\n0 0 0\n");
  mesh("nothing.off", "has no faces");
  for(const std::string bad : {"nan", "inf", "NaN"})
  {
    write("bad.off", "OFF\n" + text.substr(4, text.find('\n', 4) - 3) + bad +
                       text.substr(text.find(' ', text.find('\n', 4))));
    mesh("bad.off", "bad.off: vertex 0 does not have three finite coordinates");
  }
  Shape wrong = shape;
  wrong.triangles[5][0] = 9999;
  write("index.off", off(wrong));
  mesh("index.off", "index.off: ");
  wrong.triangles[5] = wrong.triangles[6];
  write("doubled.off", off(wrong));
  mesh("doubled.off", "doubled.off: face 6 has an edge, from vertex ");
  write("line.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n");
  mesh("line.off", "line.off: face 1 has fewer than three vertices");

  const auto select = [&](const std::string& file, const std::string& phrase) {
    check_refused("in.off --selection " + file + " --transform in.def -o precious.off", 1, phrase);
  };
  const std::string good = selection();
  select("missing.sel", "missing.sel: there is no such file");
  write("bad.sel", good + "1\n");
  select("bad.sel", "has 105 statuses, but the mesh has 104 vertices");
  write("bad.sel", good.substr(0, good.size() - 16));
  select("bad.sel", "has 103 statuses, but the mesh has 104 vertices");
  std::string largest = "105\n"; // each vertex may be a handle of its own
  for(std::size_t v = 1; v < shape.points.size(); ++v)
    largest += "0\n";
  write("largest.sel", largest);
  CHECK(run("in.off --selection largest.sel --move 0,0,0 -o largest.off").exit_code == 0);
  for(const std::string status : {"-1", "106", "2147483647", "99999999999999999999"})
  {
    write("bad.sel", "1\n1\n" + status + "\n" + good);
    select("bad.sel", "bad.sel, line 3: unknown status " + status + "; use 0 (fixed), 1 (free), or "
                        "the number of a handle, from 2 to 105");
  }
  write("bad.sel", "1 1\n" + good);
  select("bad.sel", "bad.sel, line 1: expected one integer");
  write("bad.sel", "1\none\n" + good);
  select("bad.sel", "bad.sel, line 2: expected one integer");
  write("bad.sel", "1.5\n" + good);
  select("bad.sel", "bad.sel, line 1: expected one integer");
  std::string free_text;
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    free_text += "1\n";
  write("bad.sel", free_text);
  select("bad.sel", "nothing moves: no vertex belongs to a handle of bad.sel");

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
  write("sheared.def", "1 1 0 0\n0 1e-10 0 0\n0 0 1 0\n0 0 0 1\n"); // can be undone
  CHECK(run("in.off --selection in.sel --transform sheared.def -o sheared.off").exit_code == 0);

  const std::string good_call = "in.off --selection in.sel --transform in.def ";
  check_refused(good_call + "-o no/such/folder/out.off", 1, "no/such/folder/out.off: cannot be");
  check_refused(good_call + "-o out.xyz", 2, "out.xyz: the name of a mesh file ends in");
  check_refused(good_call + "-o new.off --report no/such/folder/r.json", 1, "cannot be written");
  check_refused(good_call + "-o out.mesh", 2, "--output out.mesh: the surface of in.off can only");
  fs::create_directory(folder / "folder.off");
  check_refused(good_call + "-o folder.off", 1, "folder.off: cannot be written");

  check_refused(good_call + "-o new.off --report new.off", 2, "new.off is given for two things");
  check_refused(good_call + "-o new.off --report ./in.off", 2, "is given for two things");
  check_refused(good_call + "-o new.off --report in.sel", 2, "is given for two things");
  check_refused(good_call + "-o new.off --image picture.jpg", 2, ".png");
  const std::string lists = "in.off --fix list:@list.txt --stiffness list:@stiff.txt 2 --handle "
                            "z:4.. --move 0,0,1 -o new.off ";
  check_refused(lists + "--report ./list.txt", 2, "is given for two things");
  check_refused(lists + "--save-selection stiff.txt", 2, "is given for two things");
  check_refused("", 2, "no mesh is given");
  check_refused(good_call, 2, "output");
  check_refused("in.off -o new.off --transform in.def", 2, "selection");
  check_refused("in.off -o new.off --selection in.sel", 2, "transform");
  check_refused("in.off in.off" + rest, 2, "'in.off' is a second mesh, or a second value");
  check_refused("in.off --frobnicate" + rest, 2, "frobnicate");
  check_refused("in.off --cells dinner" + rest, 2, "spokes, spokes_and_rims, elements");
  check_refused("in.off --weights none" + rest, 2, "cotangent, clamped_cotangent, uniform");
  check_refused("in.off --minimizer newton" + rest, 2, "automatic, local_global, quasi_newton");
  check_refused("in.off --initial_guess none" + rest, 2, "rotations, laplacian");
  check_refused("in.off --initial-guess none" + rest, 2, "rotations, laplacian");
  check_refused("-o new.off -- --initial-guess", 2, "nothing moves: give a --handle");
  check_refused("in.off --=1" + rest, 2, "'1' is a second mesh");
  check_refused("in.off --iterations -3" + rest, 2, "--iterations");
  check_refused("in.off --iterations many" + rest, 2, "iterations");
  check_refused("in.off --threads -1" + rest, 2, "--threads");
  check_refused("in.off --tolerance -1" + rest, 2, "--tolerance must be finite and not negative");
  check_refused("in.off --cells k_ring:101" + rest, 2, "--cells is k_ring:101");
  check_refused("in.off --tolerance nan" + rest, 2, "tolerance");
}

// the points of an .off file that the command has written
std::vector<Eigen::Vector3d> read_points(const std::string& file)
{
  Mesh mesh;
  CHECK(CGAL::IO::read_polygon_mesh((folder / file).string(), mesh));
  std::vector<Eigen::Vector3d> points;
  for(auto v : mesh.vertices())
    points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  return points;
}

// Several handles, each with its own matrix; hard and soft; against the library.
void test_handles()
{
  test_case() = "handles";
  const auto handle = [](const Eigen::Vector3d& p) {
    return p.z() < 0.5 ? 0 : p.z() > 4.5 ? 3 : std::abs(p.z() - 2.5) < 0.3 && p.x() > 0 ? 2 : 1;
  };
  std::string statuses;
  for(const auto& p : shape.points)
    statuses += std::to_string(handle(p)) + '\n';
  write("two.sel", statuses);
  const Affine_map maps[2] = {rigid_motion(0.4, {1, 2, 3}, {0.2, 0, 0.1}),
                          rigid_motion(1.1, {1, 0, 0.3}, {0.5, 0.5, 0})};
  const std::string first = text_of(maps[0].matrix()), second = text_of(maps[1].matrix());
  write("two.def", first + "# the other\n" + second);
  for(const std::string soft : {"", " --soft 2.5"})
  {
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    for(auto v : mesh.vertices())
    {
      const int k = handle(shape.points[v]);
      if(k != 0)
        d.insert_roi_vertex(v);
      if(k < 2)
        continue;
      const Eigen::Vector3d target = maps[k - 2] * shape.points[v];
      d.insert_control_vertex(v, Point(target.x(), target.y(), target.z()));
      if(!soft.empty())
        CHECK(d.set_target_weight(v, 2.5));
    }
    CHECK(d.deform(30, 0));
    CHECK(run("in.off --selection two.sel --transform two.def -o two.off --tolerance 0 "
              "--iterations 30" + soft).exit_code == 0);
    const auto result = read_points("two.off");
    for(auto v : mesh.vertices())
      CHECK_AT_MOST((result[v] - Eigen::Vector3d(mesh.point(v).x(), mesh.point(v).y(),
                                                 mesh.point(v).z())).norm(), 1e-12);
  }

  test_case() = "two handles that turn what is around them";
  const auto energy = [](const std::string& lower, const std::string& upper) {
    CHECK(run("in.off --fix z:..0.5 --handle list:50" + lower + " --rotate z 40 --handle list:101" +
              upper + " --rotate z -40 --minimizer local_global --iterations 1 -o two.off "
              "--report r.json").exit_code == 0);
    return nlohmann::json::parse(content(folder / "r.json"))["energy"].dump();
  };
  CHECK((std::set<std::string>{energy("", ""), energy(" --turn", ""), energy("", " --turn"),
                               energy(" --turn", " --turn")}.size() == 4));

  test_case() = "targets that glide along a plane";
  const std::string glide = "in.off --fix z:..0.1 --handle z:4.5.. --soft 1e6 --onto "
                            "plane:0,0,110%,0,0,2 --iterations 100 -o ";
  CHECK(run(glide + "up.off").exit_code == 0);
  CHECK(run(glide + "turned.off --rotate z 90").exit_code == 0); // the plane is the same
  CHECK(run(glide + "tilted.off --rotate x 30 0,0,5").exit_code == 0);
  CHECK(content(folder / "up.off") == content(folder / "turned.off"));
  const auto up = read_points("up.off"), tilted = read_points("tilted.off");
  const double s = std::sin(std::acos(-1.0) / 6), c = std::cos(std::acos(-1.0) / 6);
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(shape.points[v].z() >= 4.5)
    {
      CHECK_AT_MOST(std::abs(up[v].z() - 5.5), 1e-4);
      CHECK_AT_MOST(std::abs(c * (tilted[v].z() - 5) - s * tilted[v].y() - 0.5), 1e-4);
    }
  const std::string onto = "in.off --handle z:4.5.. -o new.off --onto ";
  check_refused(onto + "plane:0,0,6,0,0,1", 2, "only soft targets glide; give --soft");
  check_refused(onto + "plane:0,0,6,0,0,0 --soft 1", 2, "the normal 0,0,0 has no direction");
  check_refused(onto + "z:4.. --soft 1", 2, "expected plane:X,Y,Z,NX,NY,NZ");

  // one matrix for all handles turns them about their common center, however they are picked
  std::string picks;
  for(int k : {2, 3})
  {
    picks += " --handle list:";
    for(std::size_t v = 0; v < shape.points.size(); ++v)
      if(handle(shape.points[v]) == k)
        picks += std::to_string(v) + ',';
    picks.pop_back();
  }
  write("one.def", first);
  const std::string way = " --transform one.def --frames 2 --tolerance 0 --iterations 5 -o ";
  CHECK(run("in.off --selection two.sel" + way + "a.off").exit_code == 0);
  CHECK(run("in.off --fix z:..0.49" + picks + way + "b.off").exit_code == 0);
  CHECK(content(folder / "a-0001.off") == content(folder / "b-0001.off"));
  std::string at_vertices, at_points;
  std::vector<std::size_t> held;
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(shape.points[v].z() > 4.5)
      held.push_back(v);
  held = {held.front(), held.back()};
  for(std::size_t v : held)
  {
    std::ostringstream place;
    place.precision(17);
    place << shape.points[v].x() << ',' << shape.points[v].y() << ',' << shape.points[v].z();
    at_vertices += " --handle list:" + std::to_string(v);
    at_points += " --handle point:" + place.str();
  }
  CHECK(run("in.off --fix z:..0.49" + at_vertices + way + "a.off").exit_code == 0);
  CHECK(run("in.off --fix z:..0.49" + at_points + way + "b.off").exit_code == 0);
  const auto as_vertices = read_points("a-0001.off"), as_points = read_points("b-0001.off");
  for(std::size_t v : held)
    CHECK_AT_MOST((as_vertices[v] - as_points[v]).norm(), 1e-9);

  write("three.def", first + first + second);
  check_refused("in.off --selection two.sel --transform three.def -o new.off", 1,
                "three.def: has 3 matrices, but the number of handles is 2");
  for(int k : {2, 3}) // also if one of them is left without vertices
  {
    std::string all_of_one;
    for(std::size_t v = 0; v < shape.points.size(); ++v)
      if(handle(shape.points[v]) == k)
        all_of_one += (all_of_one.empty() ? " --fix list:" : ",") + std::to_string(v);
    CHECK(run("in.off --selection two.sel --transform two.def -o new.off" + all_of_one +
              " --save-selection new.sel --save-transform new.def").exit_code == 0);
    CHECK(run("in.off --selection new.sel --transform new.def -o again.off").exit_code == 0);
    CHECK(content(folder / "again.off") == content(folder / "new.off"));
  }
  for(const char* file : {"new.off", "again.off", "new.sel", "new.def"})
    fs::remove(folder / file);
  write("three.def", first + "1 0 0 0\n0 1 0 0\n0 0 0 0\n0 0 0 1\n");
  check_refused("in.off --selection two.sel --transform three.def -o new.off", 1,
                "three.def, matrix 2: the transform is singular");
}

void test_frames()
{
  test_case() = "frames";
  const std::string call = "in.off --selection in.sel --transform in.def --quiet -o ";
  CHECK(run(call + "plain.off").exit_code == 0);
  CHECK(run(call + "one.off --frames 1").exit_code == 0);
  CHECK(!fs::exists(folder / "one.off"));
  CHECK(content(folder / "one-0001.off") == content(folder / "plain.off"));

  // two key frames, the second a stretch, in six frames
  const Affine_map first = rigid_motion(2, {1, 0.5, 0.3}, {3, 0, 1});
  Affine_map second = first; // is no rigid one
  second.linear.col(2) *= 1.5;
  write("first.def", text_of(first.matrix()));
  write("second.def", text_of(second.matrix()));
  CHECK(run("in.off --selection in.sel --transform first.def --transform second.def --frames 6 "
            "-o six.off --report r.json").exit_code == 0);
  CHECK(!fs::exists(folder / "six.off") && !fs::exists(folder / "six-0007.off"));
  Eigen::Vector3d center(0, 0, 0);
  std::vector<std::size_t> handle;
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(status(shape.points[v]) == 2)
    {
      handle.push_back(v);
      center += shape.points[v];
    }
  center /= static_cast<double>(handle.size());
  for(int frame = 1; frame <= 6; ++frame)
  {
    const auto points = read_points("six-000" + std::to_string(frame) + ".off");
    Affine_map map = first;
    if(frame <= 3) // turns at constant speed, and the center moves along a straight line
    {
      const double share = frame / 3.;
      const Eigen::AngleAxisd turn(first.linear);
      map = rigid_motion(share * turn.angle(), turn.axis(), {0, 0, 0});
      map.translation = (1 - share) * center + share * (first * center) - map * center;
    }
    else // only the stretch changes
    {
      const double share = (frame - 3) / 3.;
      map.linear.col(2) *= 1 + 0.5 * share;
    }
    for(std::size_t v : handle)
      if(frame % 3 == 0) // exactly
      {
        const Eigen::Matrix4d m = (frame == 3 ? first : second).matrix();
        const auto& p = shape.points[v];
        for(int k = 0; k < 3; ++k)
          CHECK(points[v][k] == m(k, 0) * p.x() + m(k, 1) * p.y() + m(k, 2) * p.z() + m(k, 3));
      }
      else
        CHECK_AT_MOST((points[v] - map * shape.points[v]).norm(), 1e-12);
    for(std::size_t v = 0; v < points.size(); ++v)
      if(status(shape.points[v]) == 0)
        CHECK(points[v] == shape.points[v]);
  }
  // two handles that move as one, and then do not, turn about their own centers
  std::string two_handles, one_handle;
  for(const auto& p : shape.points)
  {
    two_handles += p.z() > 4 ? p.x() > 0 ? "2\n" : "3\n" : p.z() < 1 ? "0\n" : "1\n";
    one_handle += p.z() > 4 ? p.x() > 0 ? "2\n" : "1\n" : p.z() < 1 ? "0\n" : "1\n";
  }
  write("two.sel", two_handles);
  write("one.sel", one_handle);
  write("stay.def", text_of(Eigen::Matrix4d::Identity()));
  write("two.def", text_of(first.matrix()) + text_of(Eigen::Matrix4d::Identity()));
  const std::string keys = "in.off --transform stay.def --frames 4 -o apart.off --transform ";
  CHECK(run(keys + "two.def --selection two.sel").exit_code == 0);
  const auto two_points = read_points("apart-0003.off");
  CHECK(run(keys + "first.def --selection one.sel").exit_code == 0);
  const auto one_points = read_points("apart-0003.off");
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(shape.points[v].z() > 4 && shape.points[v].x() > 0)
      CHECK_AT_MOST((two_points[v] - one_points[v]).norm(), 1e-12);

  const auto json = nlohmann::json::parse(content(folder / "r.json"));
  CHECK(json["frames"].size() == 6);
  for(int frame = 0; frame < 6; ++frame)
    CHECK(json["frames"][frame]["factorized"] == (frame == 0)); // the factor is kept
  CHECK(json["energy"].back() == json["frames"][5]["energy"][1]);

  test_case() = "frames start from the one before";
  CHECK(run(call + "a.off --frames 2 --iterations 3 --tolerance 0").exit_code == 0);
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  const auto rest = read_points("in.off"), middle = read_points("a-0001.off");
  for(auto v : mesh.vertices())
  {
    if(status(rest[v]) != 0)
      d.insert_roi_vertex(v);
    if(status(rest[v]) == 2)
      d.insert_control_vertex(v, Point(middle[v].x(), middle[v].y(), middle[v].z()));
  }
  CHECK(d.deform(3, 0));
  for(auto v : d.control_vertices())
    d.set_target_position(v, Point(-rest[v].y(), rest[v].x(), rest[v].z() + 0.5));
  CHECK(d.deform(3, 0));
  const auto end = read_points("a-0002.off");
  for(auto v : mesh.vertices())
    CHECK_AT_MOST((end[v] - Eigen::Vector3d(mesh.point(v).x(), mesh.point(v).y(),
                                            mesh.point(v).z())).norm(), 1e-12);

  test_case() = "key frames without --frames are the frames";
  const std::string two_keys = "in.off --selection in.sel --transform first.def --transform "
                               "second.def ";
  CHECK(run(two_keys + "--fix list:50 --quiet -o keys.off").exit_code == 0);
  CHECK(!fs::exists(folder / "keys.off") && !fs::exists(folder / "keys-0003.off"));
  CHECK(read_points("keys-0001.off")[50] == shape.points[50]); // --fix wins over the selection
  CHECK(read_points("keys-0002.off")[handle[0]] == read_points("six-0006.off")[handle[0]]);

  write("precious.off", "precious");
  check_refused(two_keys + "--frames 1 -o new.off", 2, "--frames 1: --frames is from 2 (one for");
  check_refused(call + "new.off --frames 10000", 2, "--frames 10000");
  check_refused(call + "new.off --frames x", 2, "--frames 'x' is not a whole number");
  write("in-0002.off", content(folder / "in.off"));
  check_refused("in-0002.off --selection in.sel --transform in.def -o in.off --frames 3", 2,
                "in-0002.off is given for two things");
  check_refused(call + "new.off --frames 3 --report new-0002.off", 2, "is given for two things");
#if defined(__unix__) || defined(__APPLE__)
  check_refused(call + "/dev/stdout --frames 3", 2, "frames need a file each");
  fs::create_symlink("linked-0002.off", folder / "linked-0001.off");
  check_refused(call + "linked.off --frames 3", 2, "linked-0002.off is given for two things");
#endif

  test_case() = "films";
  check_refused(call + "new.off --animation film.avi", 2, "a film ends in .gif");
  for(const auto& [file, start] : std::map<std::string, std::string>{
        {"film.gif", "GIF89a"}, {"film.glb", "glTF"}, {"film.gltf", "{"},
        {"film.webm", "\x1A\x45\xDF\xA3"}})
  {
    if(file == "film.gif" && !is_long_run()) // drawn frame by frame
      continue;
    const Run done = run(call + "new.off --frames 2 --animation " + file);
    const bool needs_programs = file == "film.gif" || file == "film.webm";
    if(needs_programs && done.exit_code == 1 &&
       done.err.find("--animation " + file) != std::string::npos)
      std::cout << "NOTICE: not tested: " << done.err; // something is not installed
    else
    {
      CHECK(done.exit_code == 0);
      CHECK(content(folder / file).rfind(start, 0) == 0);
    }
  }
  const auto gltf = nlohmann::json::parse(content(folder / "film.gltf"));
  CHECK(gltf["meshes"][0]["primitives"][0]["targets"].size() == 2);
  CHECK(gltf["accessors"][0]["count"] == shape.points.size());
  CHECK(gltf["animations"][0]["channels"][0]["target"]["path"] == "weights");
  const std::string shell_command = command;
  command = "/usr/bin/env\" PATH=/nonexistent \"" + shell_command;
  check_refused("missing.off --selection in.sel --transform in.def -o other.off --animation a.mp4",
                1, "--animation a.mp4: needs the program ffmpeg");
  command = shell_command;
#if defined(__unix__) || defined(__APPLE__)
  Eigen::Matrix4d far = Eigen::Matrix4d::Identity();
  far(2, 3) = 100;
  write("far.def", text_of(far));
  const auto first_picture = [](const std::string& key) { // is of all frames
    return scene("in.off --selection in.sel -o new.off --transform stay.def --transform " + key,
                 "--animation scene.webm");
  };
  CHECK(first_picture("far.def") != first_picture("stay.def"));
#endif
}

// What is picked, against the same conditions here.
void test_picks()
{
  using P = Eigen::Vector3d;
  const P low(-1, -1, 0), size(2, 2, 5); // of the bounding box
  const auto check_picked = [&](const std::string& what, const auto& is_picked) {
    test_case() = what;
    std::string expected;
    for(std::size_t v = 0; v < shape.points.size(); ++v)
      expected += is_picked(v, shape.points[v]) ? "2\n" : "0\n";
    CHECK(expected.find('2') != std::string::npos);
    const Run done = run("in.off --fix x:-9.. --handle '" + what + "' --move 0,0,1 -o new.off "
                         "--save-selection new.sel --quiet");
    if(!CHECK(done.exit_code == 0))
      std::cerr << "    " << done.err;
    CHECK(content(folder / "new.sel") == expected);
  };
  check_picked("z:90%..", [&](auto, const P& p) { return p.z() >= low.z() + 0.9 * size.z(); });
  check_picked("z:100%..", [&](auto, const P& p) { return p.z() == 5; });
  check_picked("y:..0.25", [&](auto, const P& p) { return p.y() <= 0.25; });
  check_picked("x:-0.5..60%", [&](auto, const P& p) { return p.x() >= -0.5 && p.x() <= 0.2; });
  check_picked("box:-2,0,0%,2,2,50%", [&](auto, const P& p) { return p.y() >= 0 && p.z() <= 2.5; });
  check_picked("sphere:1,0,0,2", [&](auto, const P& p) { return (p - P(1, 0, 0)).norm() <= 2; });
  check_picked("sphere:50%,50%,50%,30%", [&](auto, const P& p) {
    return (p - P(0, 0, 2.5)).norm() <= 0.3 * size.norm();
  });
  check_picked("plane:0,0,5,0,0,1", [&](auto, const P& p) { return p.z() == 5; });
  check_picked("plane:0,0,2.4,1,0,-1", [&](auto, const P& p) { return p.x() - p.z() + 2.4 >= 0; });
  check_picked("near:0,1.2,100%", [&](auto v, const P&) {
    const auto nearest = std::min_element(
      shape.points.begin(), shape.points.end(), [](const P& p, const P& q) {
        return (p - P(0, 1.2, 5)).norm() < (q - P(0, 1.2, 5)).norm();
      });
    return int(v) == nearest - shape.points.begin();
  });
  write("list", "7 # a comment\n# none\n9 11\n");
  const auto is_listed = [](auto v, const P&) { return v == 7 || v == 9 || v == 11; };
  check_picked("list:7,11,9", is_listed);
  check_picked("list:@list", is_listed);

  test_case() = "one line, and the same from files";
  const std::string picks = "in.off --fix z:..0.5 --handle z:4.5.. --rotate z 90 0,0,7 "
                            "--move 0,0,0.5 --handle near:1,0,2.5 --move -10%,0,0 ";
  CHECK(run(picks + "-o picked.off --save-selection s.sel --save-transform s.def").exit_code == 0);
  CHECK(run("in.off --selection s.sel --transform s.def -o read.off --save-selection t.sel "
            "--save-transform t.def").exit_code == 0);
  CHECK(content(folder / "picked.off") == content(folder / "read.off"));
  CHECK(content(folder / "s.sel") == content(folder / "t.sel"));
  CHECK(content(folder / "s.def") == content(folder / "t.def"));
  auto points = read_points("picked.off");
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    const P& p = shape.points[v];
    if(p.z() >= 4.5)
      CHECK_AT_MOST((points[v] - P(-p.y(), p.x(), p.z() + 0.5)).norm(), 1e-14);
    if(p.z() <= 0.5)
      CHECK(points[v] == p);
  }

  test_case() = "a full turn about the handle's own center, in frames";
  CHECK(run("in.off --fix z:..0.5 --handle z:4.5.. --rotate 0,0,2 360 --frames 4 -o t.off")
          .exit_code == 0);
  points = read_points("t-0001.off");
  P center(0, 0, 0); // the seam of the tube is there
  int n = 0;
  for(const P& p : shape.points)
    if(p.z() >= 4.5)
    {
      center += p;
      ++n;
    }
  center /= n;
  for(std::size_t v = 0; v < points.size(); ++v)
    if(const P p = shape.points[v] - center; shape.points[v].z() >= 4.5)
      CHECK_AT_MOST((points[v] - center - P(-p.y(), p.x(), p.z())).norm(), 1e-14);

  test_case() = "region, soft";
  CHECK(run("in.off --region z:2..4 --handle z:2.9..3.1 --move 0.2,0,0 --soft 3 -o region.off "
            "--save-selection region.sel").exit_code == 0);
  points = read_points("region.off");
  bool is_soft = false;
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    const P& p = shape.points[v];
    if(p.z() < 2 || p.z() > 4)
      CHECK(points[v] == p);
    else if(p.z() > 2.9 && p.z() < 3.1)
      is_soft = is_soft || (points[v] - p - P(0.2, 0, 0)).norm() > 1e-3;
  }
  CHECK(is_soft);

  test_case() = "bending, cells, one vertex that turns";
  const std::string pull = "in.off --fix z:..10% --handle near:1,0,5 --move 0.5,0,0 -o ";
  const auto result = [&](const std::string& options) {
    CHECK(run(pull + "terms.off " + options).exit_code == 0);
    return read_points("terms.off");
  };
  CHECK(result("--bending 0 --smoothing 0") == result(""));
  CHECK(result("--cells k_ring:0") == result("--cells spokes"));
  CHECK(result("--cells k_ring:1") != result("--cells spokes"));
  CHECK(result("--smoothing 0.1") != result(""));
  CGAL::ARAP::Options bent; // as by the library, with a length
  bent.bending_length = 0.1 * Eigen::Vector3d(2, 2, 5).norm();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation d(mesh);
  CHECK(d.set_options(bent));
  const std::vector<P> by_command = result("--bending 0.1");
  std::size_t pulled = 0;
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if((shape.points[v] - P(1, 0, 5)).norm() < (shape.points[pulled] - P(1, 0, 5)).norm())
      pulled = v;
  for(auto v : mesh.vertices())
  {
    d.insert_roi_vertex(v);
    if(shape.points[v].z() <= 0.5)
      d.insert_control_vertex(v);
  }
  const P end = shape.points[pulled] + P(0.5, 0, 0);
  d.insert_control_vertex(Mesh::Vertex_index(pulled), Point(end.x(), end.y(), end.z()));
  CHECK(d.deform());
  CHECK_AT_MOST(largest_distance(points_of(mesh), by_command), 1e-9);
  CHECK(run("in.off --handle near:1,0,5 --rotate z 90 --turn -o turned.off").exit_code == 0);
  points = read_points("turned.off");
  const P pivot = shape.points[pulled];
  for(std::size_t v = 0; v < points.size(); ++v)
    if(const P p = shape.points[v] - pivot; points[v] != shape.points[v])
      CHECK_AT_MOST((points[v] - pivot - P(-p.y(), p.x(), p.z())).norm(), 1e-9);
  CHECK(points[pulled] == pivot);

  write("precious.off", "precious");
  const std::string rest = " --move 0,0,1 -o precious.off";
  const auto refuse = [&](const std::string& arguments, int exit_code, const std::string& phrase) {
    check_refused("in.off " + arguments + rest, exit_code, phrase);
  };
  refuse("--handle near:1e200,0,0", 1, "--handle near:1e200,0,0: picks no vertex");
  refuse("--handle z:7..", 1, "--handle z:7..: picks no vertex; the bounding box of the mesh is "
                              "box:-1,-1,0,1,1,5");
  refuse("--fix sphere:9,9,9,1 --handle z:..1", 1, "--fix sphere:9,9,9,1: picks no vertex");
  write("far.off", "OFF\n3 1 0\n1234567.125 0 0\n1234568.875 0 0\n0 1 0\n3 0 1 2\n");
  check_refused("far.off --handle z:7.." + rest, 1, "box:0,0,0,1234568.875,1,0");
  check_refused("in.off --fix z:..5% --gravity 1,0,0 --frames 2 -o new.off "
                "--save-transform new.def", 1, "--save-transform: there is no handle");
  refuse("--handle z:4.5.. --move 0,0,1 --handle z:4..", 1, "--handle z:4.5..: a later --fix or");
  refuse("--handle list:104", 1, "there is no vertex 104; they are numbered from 0 to 103");
  refuse("--handle list:@missing", 1, "missing: there is no such file");
  refuse("--handle list:@in.off", 1, "in.off, line 1: 'OFF' is not the number of a vertex");
  refuse("--handle list:-1", 2, "'-1' is not a whole number");
  refuse("--handle z", 2, "expected a range such as z:90%..");
  refuse("--handle z:90%", 2, "expected a range");
  refuse("--handle cube:1", 2, "--handle cube:1: expected box:, sphere:");
  refuse("--handle box:1,2,3", 2, "expected the numbers x0,y0,z0,x1,y1,z1");
  refuse("--handle box:1,2,3,4,5,x", 2, "'x' is not a finite number");
  refuse("--handle sphere:0,0,0,-9 --move 0,0,1", 1, "sphere:0,0,0,-9");
  refuse("--fix plane:0,0,0,0,0,0 --handle z:4.5..", 2, "the normal 0,0,0 has no direction");
  refuse("--handle near:nan,0,0", 2, "'nan' is not a finite number");
  refuse("--handle z:0.. --rotate w 90", 2,
         "--rotate w: the axis must be x, y, z or a vector X,Y,Z");
  refuse("--handle z:0.. --rotate 0,0,0 90", 2, "has no direction");
  refuse("--handle z:0.. --rotate z up", 2, "--rotate: 'up' is not a finite number");
  refuse("--handle z:0.. --move 1,2", 2, "--move: expected the numbers dx,dy,dz");
  refuse("--handle z:0.. --bending -1", 2, "--bending must be finite and not negative");
  refuse("--handle z:0.. --smoothing -1", 2, "--smoothing must be finite and not negative");
  refuse("--handle z:0.. --bending 1 --cells elements", 2,
         "--bending needs cells at vertices; choose spokes, k_ring or spokes_and_rims for --cells");
  refuse("--fix z:..0.5 --handle z:4.5.. --bending 1e9", 1,
         "--bending or --smoothing is more than a million");
  refuse("--handle z:0.. --cells k_ring:-1", 2, "is not a whole number");
  check_refused("in.off --turn -o precious.off", 2, "--turn is for the --handle before it");
  refuse("--handle z:0.. --soft -1", 2, "--soft -1: a weight is not negative");
  refuse("--handle z:0.. --transform in.def", 2, "leave out --move and --rotate");
  refuse("--handle z:0.. --selection in.sel", 2, "leave out --handle");
  refuse("--fix z:0..", 2, "--move is for the --handle before it");
  refuse("--selection in.sel --fix z:4..", 1, "nothing moves: no vertex belongs to a handle of "
                                              "in.sel");
  check_refused("in.off --fix z:..1 --gravity 0,0,1 --frames 2 --transform in.def -o precious.off",
                2, "--transform moves handles: give a --handle");
  refuse("--handle list:@", 2, "--handle list:@: expected the name of a file");
  check_refused("in.off --handle z:0.. --soft 1 --onto plane:0,0,0,1%,0,0 -o precious.off", 2,
                "a percentage makes no sense in a normal");
  refuse("--handle z:0.. --view 1", 2, "--view: expected the numbers azimuth,elevation");
  refuse("--handle z:0.. --view 0,0,0", 2, "--view 0,0,0 is no direction");
  for(const std::string option : {"", " --animation film.glb", " --animation film.GLTF"})
    refuse("--handle z:0.. --view 0,0,1" + option, 2,
           "--view is for pictures: give --image, or an --animation that is not glTF");
  check_refused("in.off --handle z:0.. -o precious.off", 2, "nothing moves: give --move");
  check_refused("in.off --handle z:0.. -o precious.off --rotate z", 2, "expected AXIS ANGLE");
  check_refused("in.off --handle z:0.. --rotate z -o precious.off", 2, "expected AXIS ANGLE");
  check_refused("in.off --handle z:0.. -o precious.off --rotate=z", 2, "expected AXIS ANGLE");
  check_refused("in.off --handle z:0.. -o precious.off --rotate=z 30", 2, "expected AXIS ANGLE");
  for(const std::string option : {"--handle", "--fix", "--soft", "--rotate", "--stiffness"})
    for(const char* next : {"", " --rotate z 90", " --move 0,0,1", " --stiffness z:0.. 2", " -h"})
      check_refused("in.off -o precious.off " + option + next, 2,
                    option + ": its value is missing");
  check_refused("in.off --handle z:0.. -o --move 0,0,1", 2, "-o: its value is missing");

  test_case() = "an option has one value, and the mesh may follow it";
  check_refused("in.off --handle list:1,2 list:3" + rest, 2,
                "'list:3' is a second mesh, or a second value of an option");
  check_refused("in.off --handle z:0.. -o precious.off --move 0,0,1 0,1,0", 2,
                "'0,1,0' is a second");
  const std::string lift = "--quiet --fix z:..0.5 --handle z:4.5.. --move 0,0,1 ";
  CHECK(run("in.off -o first.off " + lift).exit_code == 0);
  CHECK(run("-o last.off " + lift + "in.off").exit_code == 0);
  CHECK(content(folder / "last.off") == content(folder / "first.off"));
}

struct Glb
{
  nlohmann::json json;
  std::vector<float> numbers; // in its buffer
};

Glb read_glb(const std::string& file)
{
  const std::string bytes = content(folder / file);
  std::uint32_t size = 0;
  CHECK(bytes.size() > 20 && bytes.substr(0, 4) == "glTF");
  std::memcpy(&size, bytes.data() + 12, 4);
  Glb result{nlohmann::json::parse(bytes.substr(20, size)), {}};
  CHECK(bytes.substr(24 + size, 4) == std::string("BIN\0", 4));
  result.numbers.resize((bytes.size() - 28 - size) / 4);
  std::memcpy(result.numbers.data(), bytes.data() + 28 + size, 4 * result.numbers.size());
  return result;
}

// Two triangles, of two vertices each at their common edge, since their texture coordinates differ
// there; in a node that is turned, stretched and moved.
void test_gltf()
{
  test_case() = "glTF";
  using P = Eigen::Vector3d;
  const std::vector<P> local = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  const P normal(0, 0, 1), tangent(0.8f, 0.6f, 0);
  std::vector<float> numbers;
  for(const P& p : local)
    numbers.insert(numbers.end(), {float(p.x()), float(p.y()), float(p.z())});
  for(std::size_t i = 0; i < local.size(); ++i)
    numbers.insert(numbers.end(), {0, 0, 1});
  for(std::size_t i = 0; i < local.size(); ++i)
    numbers.insert(numbers.end(), {float(i), 0.5f});
  for(std::size_t i = 0; i < local.size(); ++i)
    numbers.insert(numbers.end(), {0.8f, 0.6f, 0, -1});
  write("part.bin", std::string(reinterpret_cast<const char*>(numbers.data()),
                                4 * numbers.size()));
  auto json = nlohmann::json::parse(R"({
    "asset": {"version": "2.0", "extras": {"by": "hand"}},
    "buffers": [{"uri": "part.bin", "byteLength": 288}],
    "bufferViews": [{"buffer": 0, "byteLength": 144},
                    {"buffer": 0, "byteOffset": 144, "byteLength": 144}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                  {"bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 6,
                   "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"},
                  {"bufferView": 1, "byteOffset": 48, "componentType": 5126, "count": 6,
                   "type": "VEC4"}],
    "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2,
                                               "TANGENT": 3}, "material": 0}]}],
    "nodes": [{"children": [1], "translation": [1, 2, 3]},
              {"mesh": 0, "rotation": [0.6, 0, 0, 0.8], "scale": [2, 1, 3]}],
    "scenes": [{"nodes": [0]}]})");
  write("in.gltf", json.dump());
  CHECK(run("in.gltf --handle x:0.. --rotate 1,2,3 50 0,1,0 -o out.glb --quiet").exit_code == 0);
  const Glb glb = read_glb("out.glb");
  const Affine_map to_scene = {Eigen::Quaterniond(0.8, 0.6, 0, 0).toRotationMatrix() *
                                 P(2, 1, 3).asDiagonal(), P(1, 2, 3)};
  const Affine_map turn =
    motion_about(P(0, 1, 0), rigid_motion(50 * std::acos(-1.0) / 180, P(1, 2, 3), P(0, 0, 0)));
  const Affine_map expected = to_scene.inverse() * turn * to_scene;
  const P turned_normal = (expected.linear.inverse().transpose() * normal).normalized(),
          turned_tangent = (expected.linear * tangent).normalized();
  const auto check_vector = [&](std::size_t begin, const P& v) {
    for(std::size_t k = 0; k < 3; ++k)
      CHECK_AT_MOST(std::abs(glb.numbers[begin + k] - v[static_cast<int>(k)]), 1e-6);
  };
  for(std::size_t i = 0; i < 6; ++i)
  {
    check_vector(3 * i, expected * local[i]);
    check_vector(18 + 3 * i, turned_normal);
    check_vector(48 + 4 * i, turned_tangent);
    CHECK(glb.numbers[51 + 4 * i] == -1);
  }
  for(std::size_t i = 36; i < 48; ++i)
    CHECK(glb.numbers[i] == numbers[i]);
  auto rest = glb.json;
  for(const char* bound : {"min", "max"})
  {
    CHECK(rest["accessors"][0][bound].size() == 3);
    rest["accessors"][0].erase(bound);
  }
  rest["buffers"] = json["buffers"];
  CHECK(rest == json); // all else is kept

  test_case() = "bounds of normals and tangents of glTF";
  auto bounded = json;
  for(const auto& [accessor, vector] :
      {std::pair(1, nlohmann::json{0, 0, 1}), std::pair(3, nlohmann::json{0.8f, 0.6f, 0, -1})})
    bounded["accessors"][accessor].update({{"min", vector}, {"max", vector}});
  write("bounded.gltf", bounded.dump());
  CHECK(run("bounded.gltf --handle x:0.. --rotate 1,2,3 50 0,1,0 -o bounded.glb --quiet")
          .exit_code == 0);
  const Glb bounds = read_glb("bounded.glb");
  CHECK(bounds.numbers == glb.numbers);
  for(const auto& [accessor, begin, size] : {std::tuple(1, 18, 3), std::tuple(3, 48, 4)})
    for(const char* bound : {"min", "max"})
    {
      const auto& vector = bounds.json["accessors"][accessor][bound];
      CHECK(vector.size() == std::size_t(size));
      for(int k = 0; k < size; ++k)
      {
        float expected_bound = glb.numbers[begin + k];
        for(int i = 1; i < 6; ++i)
        {
          const float value = glb.numbers[begin + size * i + k];
          expected_bound = bound[1] == 'i' ? (std::min)(expected_bound, value)
                                           : (std::max)(expected_bound, value);
        }
        CHECK(vector[k].get<float>() == expected_bound);
      }
    }

  test_case() = "two glTF accessors of the same positions";
  auto alias = json; // a primitive for each triangle
  alias["buffers"].push_back({{"byteLength", 12},
                              {"uri", "data:application/octet-stream;base64,AAABAAIAAwAEAAUA"}});
  alias["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 12}});
  alias["accessors"].push_back(json["accessors"][0]);
  auto& primitives = alias["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["attributes"]["POSITION"] = 4;
  for(std::size_t k = 0; k < 2; ++k)
  {
    alias["accessors"].push_back({{"bufferView", 2}, {"byteOffset", 6 * k}, {"count", 3},
                                  {"componentType", 5123}, {"type", "SCALAR"}});
    primitives[k]["indices"] = 5 + k;
  }
  write("alias.gltf", alias.dump());
  CHECK(run("alias.gltf --handle x:0.. --rotate 1,2,3 50 0,1,0 -o alias.glb --quiet").exit_code ==
        0);
  const Glb twice_named = read_glb("alias.glb");
  CHECK(twice_named.numbers == glb.numbers);
  for(const char* bound : {"min", "max"})
    for(std::size_t k : {std::size_t(0), std::size_t(4)})
      CHECK(twice_named.json["accessors"][k][bound] == glb.json["accessors"][0][bound]);

  test_case() = "parts of a glTF input are no outputs";
  write("red.png", "a picture");
  auto with_image = json;
  with_image["images"] = {{{"uri", "red.png"}}};
  write("image.gltf", with_image.dump());
  const std::string bytes = content(folder / "part.bin");
  for(const std::string part : {"part.bin", "red.png"})
    for(const std::string option : {" --report ", " --save_selection "})
      check_refused("image.gltf --handle x:0.. --move 0,0,1 -o precious.off" + option + part, 2,
                    part + " is a part of the input");
  CHECK(content(folder / "part.bin") == bytes && content(folder / "red.png") == "a picture");

  test_case() = "glTF to another folder";
  const std::string all = " --handle x:-99.. --move 0,0,0 -o ", stay = " --quiet" + all;
  const auto uri = [](const std::string& file) {
    return nlohmann::json::parse(content(folder / file))["buffers"][0]["uri"].get<std::string>();
  };
  fs::create_directory(folder / "apart");
  CHECK(run("image.gltf" + all + "beside.gltf").err.empty());
  CHECK(uri("beside.gltf") == "part.bin");
  CHECK(run("image.gltf" + all + "apart/out.gltf").err ==
        "note: apart/out.gltf does not keep: images, which stay in the folder of the input\n");
  CHECK(uri("apart/out.gltf").rfind("data:", 0) == 0);
  CHECK(run("apart/out.gltf" + stay + "apart.off").exit_code == 0);
  CHECK(read_points("apart.off").size() == 4);
#if defined(__unix__) || defined(__APPLE__)
  fs::create_symlink("apart/linked.gltf", folder / "link.gltf");
  CHECK(run("in.gltf" + stay + "link.gltf").exit_code == 0);
  CHECK(uri("apart/linked.gltf").rfind("data:", 0) == 0);
#endif

  test_case() = "a polygon that is not convex, as triangles";
  write("angle.off", "OFF\n6 1 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n6 0 1 2 3 4 5\n");
  CHECK(run("angle.off" + stay + "angle.glb").exit_code == 0);
  CHECK(run("angle.glb" + stay + "angle2.off").exit_code == 0);
  {
    const auto p = read_points("angle2.off");
    std::istringstream faces(content(folder / "angle2.off"));
    std::string line;
    int number_of_triangles = 0;
    while(std::getline(faces, line))
      if(std::size_t n, a, b, c; std::istringstream(line) >> n >> a >> b >> c && n == 3 &&
                                 line[0] == '3')
      {
        ++number_of_triangles;
        CHECK((p.at(b) - p.at(a)).cross(p.at(c) - p.at(a)).z() > 0.1);
      }
    CHECK(number_of_triangles == 4);
  }

  test_case() = "too many frames";
  std::string transforms;
  for(int k = 0; k < 417; ++k)
    transforms += " --transform in.def";
  check_refused("in.off --selection in.sel -o out.off --animation film.glb" + transforms, 2,
                "417 times --transform gives 10008 frames: ");

  test_case() = "numbers that are too large for single precision";
  for(const std::string file : {"large.glb", "large.gltf", "large.stl"})
    check_refused("in.off --fix z:..1 --handle z:4.. --move 1e39,0,0 -o " + file, 1,
                  file + ": the number ");
  check_refused("in.gltf --fix x:..1 --handle near:9,9,9 --move 2e39,0,0 -o in.gltf", 1,
                "in.gltf: the number ");
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"; // in text, too
  write("single.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                      "property float y\nproperty float z\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n" + corners +
                      "3 0 1 3\n");
  write("single.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                      "POINTS 4 float\n" + corners + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  const auto array = [](const std::string& attributes, const std::string& values) {
    return "<DataArray format=\"ascii\" " + attributes + ">\n" + values + "</DataArray>\n";
  };
  write("single.vtu", "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n"
                      "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>\n" +
                      array("type=\"Float32\" NumberOfComponents=\"3\"", corners) +
                      "</Points>\n<Cells>\n" +
                      array("type=\"Int32\" Name=\"connectivity\"", "0 1 2 3\n") +
                      array("type=\"Int32\" Name=\"offsets\"", "4\n") +
                      array("type=\"UInt8\" Name=\"types\"", "10\n") +
                      "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  write("quad.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                    "POINTS 4 float\n" + corners + "CELLS 2 10\n4 0 1 2 3\n4 0 1 3 2\n"
                    "CELL_TYPES 2\n10\n9\n"); // a quadrilateral beside it
  CHECK(run("quad.vtk --fix list:0,1 --handle list:3 --move 1,0,0 -o quad.vtk").exit_code == 0);
  for(const std::string file : {"single.ply", "single.vtk", "single.vtu"})
  {
    const std::string hold = file + " --fix list:0,1 --handle list:3 --move ";
    CHECK(run(hold + "2e38,0,0 --iterations 0 -o large" + file.substr(6)).exit_code == 0);
    check_refused(hold + "4e38,0,0 -o " + file, 1, file + ": the number ");
  }
  check_refused("in.off --fix z:..1 --handle z:4.. --move 1e39,0,0 -o new.off "
                "--animation film.glb", 1, "film.glb: the number ");

  test_case() = "glTF to other formats and back";
  CHECK(run("out.glb" + stay + "out.gltf").exit_code == 0);
  CHECK(run("out.gltf" + stay + "out2.glb").exit_code == 0);
  CHECK(content(folder / "out2.glb") == content(folder / "out.glb"));
  CHECK(run("in.gltf" + stay + "out.off").exit_code == 0);
  auto other = json;
  other.erase("scenes");
  other["buffers"][0]["uri"] = "%70art%2Ebin";
  write("other.gltf", other.dump());
  CHECK(run("other.gltf" + stay + "other.off").exit_code == 0);
  CHECK(content(folder / "other.off") == content(folder / "out.off"));
  other["scenes"] = {{{"nodes", {1}}}, {{"nodes", {0}}}}; // the second one, of which it is
  other["scene"] = 1;
  write("other.gltf", other.dump());
  CHECK(run("other.gltf" + stay + "other.off").exit_code == 0);
  CHECK(content(folder / "other.off") == content(folder / "out.off"));
  other["scene"] = 1.0; // integers may be written so
  other["scenes"][1]["nodes"][0] = 0.0;
  other["nodes"][1]["mesh"] = 0.0;
  other["accessors"][0]["count"] = 6.0;
  other["accessors"][0]["componentType"] = 5126.0;
  write("other.gltf", replaced(other.dump(), "5126.0", "5.126e3"));
  CHECK(run("other.gltf" + stay + "other.off").exit_code == 0);
  CHECK(content(folder / "other.off") == content(folder / "out.off"));
  const auto points = read_points("out.off");
  CHECK(points.size() == 4); // the seam is closed
  CHECK_AT_MOST((points[1] - to_scene * local[1]).norm(), 1e-12);
  auto mirrored = json;
  mirrored["nodes"][1]["scale"] = {-2, 1, 3};
  write("mirrored.gltf", mirrored.dump());
  CHECK(run("mirrored.gltf" + stay + "mirrored.off").exit_code == 0);
  const Affine_map mirror = {Eigen::Quaterniond(0.8, 0.6, 0, 0).toRotationMatrix() *
                               P(-2, 1, 3).asDiagonal(), P(1, 2, 3)};
  for(const auto& [file, map] : {std::pair("out.off", to_scene), {"mirrored.off", mirror}})
  {
    const std::string text = content(folder / file);
    std::istringstream face(text.substr(text.rfind("\n3 ") + 3));
    std::size_t a = 0, b = 0, c = 0;
    face >> a >> b >> c;
    const auto p = read_points(file);
    const P outwards = map.linear.inverse().transpose() * normal;
    CHECK((p.at(b) - p.at(a)).cross(p.at(c) - p.at(a)).dot(outwards) > 0);
  }
  CHECK(run("in.off --selection in.sel --transform in.def -o tube.off --quiet").exit_code == 0);
  CHECK(run("in.off --selection in.sel --transform in.def -o tube.glb --quiet").exit_code == 0);
  CHECK(run("tube.glb" + stay + "tube2.off").exit_code == 0);
  const auto tube = read_points("tube.off"), tube2 = read_points("tube2.off");
  CHECK(tube.size() == tube2.size());
  for(std::size_t v = 0; v < tube.size() && v < tube2.size(); ++v)
    CHECK_AT_MOST((tube[v] - tube2[v]).norm(), 1e-6);
  CHECK(run("in.off --selection in.sel --transform in.def -o tube.glb").err ==
        "note: tube.glb does not keep: double precision\n");

  write("precious.off", "precious");
  const auto refuse = [&](const std::string& pointer, const nlohmann::json& value,
                          const std::string& phrase) {
    auto bad = json;
    bad[nlohmann::json::json_pointer(pointer)] = value;
    write("bad.gltf", bad.dump());
    check_refused("bad.gltf" + stay + "precious.off", 1, "bad.gltf: " + phrase);
  };
  refuse("/nodes/1/skin", 0, "the node 1 has a skin");
  refuse("/nodes/1/extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", 0}}}},
         "has a node that is repeated by EXT_mesh_gpu_instancing");
  for(const std::string name : {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression", "MY_own"})
    refuse("/extensionsRequired", {name}, "needs the extension '" + name + "', which is not");
  auto textured = json; // extensions that change only how it looks
  textured["extensionsRequired"] = {"KHR_texture_transform", "KHR_materials_unlit"};
  write("textured.gltf", textured.dump());
  CHECK(run("textured.gltf" + stay + "textured.gltf").exit_code == 0);
  refuse("/nodes/0/children/0", 0, "the node 0 occurs twice");
  refuse("/nodes/0/mesh", 0, "the mesh 0 is used by two nodes");
  auto scenes = json; // another scene has the mesh, too
  scenes["nodes"].push_back({{"mesh", 0}});
  scenes["scenes"].push_back({{"nodes", {2}}});
  write("bad.gltf", scenes.dump());
  check_refused("bad.gltf" + stay + "new.glb", 1,
                "new.glb: the mesh 0 is used by the node 2, too, which is not in the scene");
  CHECK(run("bad.gltf" + stay + "scenes.off").exit_code == 0);
  CHECK(content(folder / "scenes.off") == content(folder / "out.off"));
  scenes["nodes"][2]["mesh"] = 1;
  scenes["accessors"].push_back(json["accessors"][0]); // the same positions by another name
  for(const auto& [use, accessor] :
      {std::pair("POSITION", 0), std::pair("NORMAL", 1), std::pair("POSITION", 4)})
  {
    scenes["meshes"][1] = {{"primitives", {{{"attributes", {{use, accessor}}}}}}};
    write("bad.gltf", scenes.dump());
    check_refused("bad.gltf" + stay + "new.glb", 1,
                  "new.glb: the accessor " + std::to_string(accessor) +
                    " is used by the mesh 1, too, which is not in the scene");
  }
  for(const nlohmann::json& odd : {nlohmann::json{{"primitives", {{{"attributes", {{"A", -1}}}}}}},
                                   nlohmann::json(7)}) // nobody reads it
  {
    scenes["meshes"][1] = odd;
    write("odd.gltf", scenes.dump());
    for(const std::string file : {"scenes.off", "scenes.glb"})
      CHECK(run("odd.gltf" + stay + file).exit_code == 0);
  }
  scenes["scenes"][0].erase("nodes");
  write("bad.gltf", scenes.dump());
  check_refused("bad.gltf" + stay + "new.off", 1, "bad.gltf: has no faces");
  scenes.erase("scenes");
  scenes.erase("nodes");
  write("bad.gltf", scenes.dump());
  check_refused("bad.gltf" + stay + "new.off", 1, "bad.gltf: has no faces");
  refuse("/nodes/1/scale/1", 0, "the node 1 is flattened");
  refuse("/nodes/0/children/0", 7, "is no glTF that can be read");
  for(double number : {0.5, 1e308}) // where an index must be
    for(const char* pointer : {"/nodes/0/children/0", "/meshes/0/primitives/0/attributes/POSITION",
                               "/accessors/0/bufferView", "/bufferViews/0/buffer"})
      refuse(pointer, number, "is no glTF that can be read");
  auto twice = json; // another mesh with these positions, in the node of the scene
  twice["meshes"].push_back(json["meshes"][0]);
  twice["nodes"][0]["mesh"] = 1;
  twice["accessors"].push_back(json["accessors"][0]);
  auto& attributes = twice["meshes"][1]["primitives"][0]["attributes"];
  for(const bool has_normals : {true, false})
  {
    if(!has_normals)
      attributes.erase("NORMAL");
    for(const std::size_t positions : {std::size_t(0), twice["accessors"].size() - 1}) // the same
    {
      attributes["POSITION"] = positions;
      write("bad.gltf", twice.dump());
      check_refused("bad.gltf" + stay + "precious.off", 1,
                    " has the positions of two nodes in different places");
    }
  }
  refuse("/meshes/0/primitives/0/mode", 1, "has a primitive that is no list of triangles");
  refuse("/meshes/0/primitives/0/attributes", {{"NORMAL", 1}}, "has a primitive without positions");
  refuse("/meshes/0/primitives/0/indices", 2, "has an accessor that is sparse, compressed, or not");
  refuse("/meshes/0/primitives/0/targets", nlohmann::json::array(), "has morph targets");
  refuse("/meshes/0/primitives/0/extensions", {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}},
         "has triangles that are compressed by KHR_draco");
  refuse("/bufferViews/0/extensions", {{"EXT_meshopt_compression", {{"buffer", 0}}}},
         "has arrays that are compressed by EXT_meshopt");
  auto shared = json; // the normals of one mesh are those of another
  shared["accessors"].push_back(json["accessors"][0]);
  shared["accessors"][4]["bufferView"] = json["bufferViews"].size();
  shared["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 72}});
  shared["buffers"].push_back({{"byteLength", 72}});
  const std::string zeros(96, 'A'); // in base64
  shared["buffers"][1]["uri"] = "data:application/octet-stream;base64," + zeros;
  shared["meshes"].push_back(json["meshes"][0]);
  shared["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 4;
  shared["nodes"][0]["mesh"] = 1;
  write("shared.gltf", shared.dump());
  check_refused("shared.gltf" + stay + "new.glb", 1,
                "new.glb: the accessor 3 has the normals or tangents of two sets of positions");
  CHECK(run("shared.gltf" + stay + "shared.off").exit_code == 0);
  write("cut.gltf", json.dump() + "\"" + std::string(1000000, 'A'));
  check_refused("cut.gltf" + stay + "new.off", 1, "cut.gltf: is no glTF that can be read: ");
  CHECK(run("cut.gltf" + stay + "new.off").err.size() < 200);
  refuse("/accessors/0/count", 7000, "has an accessor that does not fit into its buffer");
  for(const char* pointer : {"/accessors/0/count", "/bufferViews/0/byteOffset"})
    refuse(pointer, -1, "is no glTF that can be read");
  auto indexed = json;
  indexed["accessors"].push_back(
    {{"bufferView", 1}, {"componentType", 5125}, {"count", 4}, {"type", "SCALAR"}});
  indexed["meshes"][0]["primitives"][0]["indices"] = 4;
  for(const auto& [component, phrase] : std::map<int, std::string>{
        {5125, "has a list of triangles whose last one is incomplete"},
        {5122, "has indices that are no unsigned integers"},
        {5126, "has indices that are no unsigned integers"}})
  {
    indexed["accessors"][4]["componentType"] = component;
    write("bad.gltf", indexed.dump());
    check_refused("bad.gltf" + stay + "precious.off", 1, "bad.gltf: " + phrase);
  }
  for(const char* accessor : {"0", "1", "3"})
    for(const int component : {5120, 5121, 5122, 5123})
      refuse("/accessors/" + std::string(accessor) + "/componentType", component,
             "has positions, normals or tangents that are quantized");
  auto short_normals = json; // at the end of a buffer
  short_normals["accessors"][1].update({{"byteOffset", 252}, {"componentType", 5122}});
  short_normals["bufferViews"][0]["byteLength"] = 288;
  write("bad.gltf", short_normals.dump());
  check_refused("bad.gltf" + stay + "precious.off", 1, "tangents that are quantized");
  refuse("/bufferViews/0/buffer", 1, "has an accessor in a buffer that does not exist");
  refuse("/buffers/0/uri", "missing.bin", "a buffer has less than its 288 bytes");
  refuse("/buffers/0/uri", (folder / "part.bin").string(), "has a buffer whose place is not rel");
#if defined(__unix__) || defined(__APPLE__)
  fs::create_symlink("/dev/zero", folder / "zero.bin"); // has no end
  const std::string unlimited = command;
  limit_command();
  refuse("/buffers/0/uri", "zero.bin", "a buffer has less than its 288 bytes");
  command = unlimited;
#endif
  refuse("/buffers/0/uri", "data:;base64,=*=", "has a buffer that is not in base64");
  const std::string deep = std::string(300000, '[') + std::string(300000, ']');
  write("bad.gltf", "{\"extras\": " + deep + ',' + json.dump().substr(1));
  check_refused("bad.gltf" + stay + "precious.off", 1, "bad.gltf: nests lists and objects more");
  write("bad.gltf", "[]");
  check_refused("bad.gltf" + stay + "precious.off", 1, "is no glTF that can be read: cannot use");
  write("bad.glb", content(folder / "out.glb").substr(0, 300));
  check_refused("bad.glb" + stay + "precious.off", 1, "bad.glb: ");
}

// Measures of the result, where they are known.
void test_quality()
{
  const auto report = [](const std::string& file) {
    return nlohmann::json::parse(content(folder / file));
  };
  test_case() = "quality of an affine map of all";
  write("map.def", "0 -2 0 0\n2 0 0 0\n0 0 2 5\n0 0 0 1\n");
  CHECK(run("in.off --handle z:0.. --transform map.def -o new.off --report r.json --quality")
          .exit_code == 0);
  auto json = report("r.json");
  CHECK_AT_MOST(std::abs(json["area_change"].get<double>() - 3), 1e-12);
  CHECK(json["volume_change"].is_null()); // the tube is open
  CHECK_AT_MOST(json["largest_angle_change"].get<double>(), 1e-5);
  CHECK_AT_MOST(json["largest_spike"].get<double>(), 1e-12);
  CHECK(json["self_intersections"] == 0);

  test_case() = "a stretched tetrahedron, closed, as text";
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\n"
                             "property double y\nproperty double z\n";
  const std::string header_end = "element face 4\nproperty list uchar int vertex_indices\n"
                                 "end_header\n";
  write("corner.ply", header + header_end + corners + faces);
  write("stretch.def", "1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n");
  const std::string call = "corner.ply --handle z:0.. --transform stretch.def --report r.json "
                           "--quality -o ";
  CHECK(run(call + "new.ply --color edge_error").exit_code == 0);
  json = report("r.json");
  const double area = 1.5 + std::sqrt(3.) / 2, stretched = 0.5 + 2 + 1.5;
  CHECK_AT_MOST(std::abs(json["area_change"].get<double>() - (stretched / area - 1)), 1e-12);
  CHECK_AT_MOST(std::abs(json["volume_change"].get<double>() - 1), 1e-12);
  // from 45 to atan(2), and from 60 to the angles of an isosceles triangle with sides sqrt(5)
  const double degree = std::acos(-1.0) / 180;
  const double angle = (std::max)(std::atan(2) / degree - 45,
                                  60 - 2 * std::asin(std::sqrt(0.1)) / degree);
  CHECK_AT_MOST(std::abs(json["largest_angle_change"].get<double>() - angle), 1e-6);
  const std::string new_header = header + "property float edge_error\n" + header_end;
  const auto check_errors = [&](const std::string& file, const std::array<double, 4>& errors) {
    const std::string written = content(folder / file);
    CHECK(written.substr(0, new_header.size()) == new_header);
    std::istringstream in(written.substr((std::min)(new_header.size(), written.size())));
    for(const double expected : errors)
    {
      double x = 0, y = 0, z = 0, value = 7;
      CHECK(in >> x >> y >> z >> value);
      CHECK_AT_MOST(std::abs(value - expected), 1e-7);
    }
  };
  const double d = std::sqrt(5.) - std::sqrt(2.); // of a slanted edge
  check_errors("new.ply", {std::sqrt(1. / 3), std::sqrt(d * d / 5), std::sqrt(d * d / 5),
                           std::sqrt((1 + 2 * d * d) / 5)});
  CHECK(run(call + "new2.ply --color area").exit_code == 0);
  CHECK(content(folder / "new2.ply").find("property float area\n") != std::string::npos);
  CHECK(run("new.ply --handle z:0.. --move 0,0,1 -o new2.ply --color edge_error").exit_code == 0);
  check_errors("new2.ply", {0, 0, 0, 0}); // a rigid motion, over the errors that there are
  CHECK(run("in.off --handle z:..1 --rotate x 90 -o new2.ply --color spike").exit_code == 0);
  CHECK(content(folder / "new2.ply").find("property float spike\n") != std::string::npos);
  check_refused(call + "new3.off --color edge_error", 2, "needs --image, or for a surface");
  check_refused(call + "new3.ply --color red", 2, "use one of edge_error, area, volume, angle");

  test_case() = "one triangle through another";
  write("two.off", "OFF\n6 2 0\n0 0 0\n2 0 0\n0 2 0\n0 0 1\n2 0 1\n0 2 1\n3 0 1 2\n3 3 4 5\n");
  for(const auto& [step, pairs] : {std::pair("-0.5", 0), std::pair("-1", 1)})
  {
    CHECK(run("two.off --fix list:0,1,2 --handle list:3,4 --move 0,0,1 --handle list:5 --move "
              "0.5,-1," + std::string(step) + "5 -o new.off --report r.json --quality").exit_code ==
          0);
    CHECK(report("r.json")["self_intersections"] == pairs);
  }

  test_case() = "a spike";
  write("fan.off", "OFF\n5 4 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 2 3\n"
                   "3 0 3 4\n3 0 4 1\n");
  CHECK(run("fan.off --fix list:1,2,3,4 --handle list:0 --move 0,0,1 -o new.off --report r.json")
          .exit_code == 0);
  CHECK_AT_MOST(std::abs(report("r.json")["largest_spike"].get<double>() - std::sqrt(0.5)), 1e-12);
  CHECK(!report("r.json").contains("self_intersections"));
}

Eigen::Vector3d centroid(const std::vector<Eigen::Vector3d>& points, std::size_t triangle)
{
  const auto& [a, b, c] = shape.triangles[triangle];
  return (points[a] + points[b] + points[c]) / 3;
}

std::string numbers(const Eigen::Vector3d& p)
{
  std::ostringstream out;
  out.precision(17);
  out << p.x() << ',' << p.y() << ',' << p.z();
  return out.str();
}

// Points inside faces: held where they are, moved, or pulled; also where a corner is fixed, and
// where they are picked from a point near the surface.
void test_control_points()
{
  test_case() = "control points";
  const std::size_t held = 3, moved = 100, last = shape.triangles.size() - 1;
  const Eigen::Vector3d step(0.1, -0.2, 0.3);
  const auto near_face = [](std::size_t t) { // not on the surface
    const auto& [a, b, c] = shape.triangles[t];
    const auto& p = shape.points;
    return numbers(centroid(p, t) + 0.05 * (p[b] - p[a]).cross(p[c] - p[a]).normalized());
  };
  const std::string call = "in.off --fix z:..0.1 --fix point:" + near_face(last) +
                           " --handle point:" + near_face(moved) + " --move 0.1,-0.2,0.3 -o "
                           "points.off";
  CHECK(run(call).exit_code == 0);
  auto result = read_points("points.off");
  for(const auto& [triangle, way] : {std::pair(moved, step), {last, Eigen::Vector3d(0, 0, 0)}})
    CHECK_AT_MOST((centroid(result, triangle) - centroid(shape.points, triangle) - way).norm(),
                  1e-9);
  for(std::size_t v = 0; v < result.size(); ++v)
    if(shape.points[v].z() < 0.1)
      CHECK(result[v] == shape.points[v]);
  double gap = 0; // between targets and points that are pulled
  for(const std::string weight : {"0.1", "10", "1e9"})
  {
    CHECK(run(call + " --soft " + weight).exit_code == 0);
    const double before = gap;
    gap =
      (centroid(read_points("points.off"), moved) - centroid(shape.points, moved) - step).norm();
    CHECK(weight == "0.1" ? gap > 1e-3 : gap < before);
  }
  CHECK_AT_MOST(gap, 1e-6);

  test_case() = "a control point with fixed corners";
  const auto& corners = shape.triangles[held];
  CHECK(run("in.off --fix list:" + std::to_string(corners[0]) + ',' + std::to_string(corners[1]) +
            " --handle point:" + near_face(held) + " --move 0.1,-0.2,0.3 -o points.off")
          .exit_code == 0);
  result = read_points("points.off");
  CHECK_AT_MOST((centroid(result, held) - centroid(shape.points, held) - step).norm(), 1e-9);
  for(int k = 0; k < 2; ++k)
    CHECK(result[corners[k]] == shape.points[corners[k]]);

  test_case() = "a control point that turns about itself";
  CHECK(run("in.off --fix z:..0.1 --handle point:" + near_face(moved) + " --rotate 1,2,3 50 -o "
            "points.off").exit_code == 0);
  result = read_points("points.off");
  for(std::size_t v = 0; v < result.size(); ++v)
    CHECK_AT_MOST((result[v] - shape.points[v]).norm(), 1e-9);

  const std::string handle = "in.off --handle point:0,0,0 --move 1,0,0 -o new.off";
  check_refused(handle + " --turn", 2, "--turn: the handle is a point");
  check_refused("in.off --fix z:..0.1 --fix point:1,0,0 --handle z:4.. --move 0,0,1 -o new.off", 1,
                "in.off: --fix point:1,0,0: its position is determined by other hard targets, "
                "or all its corners are fixed; leave one of them out");
  check_refused(handle + " --region point:0,0,0", 2, "for --fix and --handle only");
  std::string many; // the twelfth is named
  for(std::size_t t = 0; t < 11; ++t)
    many += " --fix point:" + near_face(60 + 8 * t);
  check_refused("in.off --fix z:..0.1" + many + " --fix point:1,0,0 --handle near:0,0,9 "
                "--move 0,0,1 -o new.off", 1,
                "in.off: --fix point:1,0,0: its position is determined by other");
  check_refused(handle + " --save-selection new.sel", 2, "a selection has vertices only, not "
                                                         "--handle point:0,0,0");
  check_refused("in.off --handle point:0,0 --move 1,0,0 -o new.off", 2,
                "expected the numbers x,y,z");
  std::string all = "0";
  for(std::size_t v = 1; v < shape.points.size(); ++v)
    all += ',' + std::to_string(v);
  check_refused(handle + " --fix list:" + all, 1, "in.off: ");
}

// Stiff cells and rigid parts, against the library.
void test_cell_values()
{
  const auto z = [](std::size_t v) { return shape.points[v].z(); };
  const auto stiffness = [&](std::size_t v) { return z(v) < 1.1 ? 20. : z(v) < 2.1 ? 0.5 : 1.; };
  const auto group = [&](std::size_t v) { return z(v) < 2.1 ? -1 : z(v) < 3.1 ? 0 : 1; };
  for(const std::string cells : {"spokes", "elements"})
  {
    test_case() = "stiffness and rigid parts, " + cells;
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    CHECK(d.set_options(options_for(cells == "spokes" ? Cell_scheme::spokes()
                                                      : Cell_scheme::elements(),
                                    CGAL::ARAP::Minimizer::automatic,
                                    CGAL::ARAP::Initial_guess::automatic)));
    if(cells == "spokes")
    {
      d.set_stiffness([&](Mesh::Vertex_index v) { return stiffness(v); });
      d.set_groups([&](Mesh::Vertex_index v) { return group(v); });
    }
    else
    {
      const auto corner = [&](Mesh::Face_index f, bool is_highest) { // of a face
        std::size_t result = shape.triangles[f][0];
        for(std::size_t v : shape.triangles[f])
          if(is_highest == (z(v) > z(result)))
            result = v;
        return result;
      };
      // all its corners are picked: below something, or between two heights
      d.set_stiffness([=](Mesh::Face_index f) { return stiffness(corner(f, true)); });
      d.set_groups([=](Mesh::Face_index f) {
        return z(corner(f, false)) > 3.1 ? 1
               : z(corner(f, false)) > 2.1 && z(corner(f, true)) < 3.1 ? 0 : -1;
      });
    }
    const Affine_map map = rigid_motion(1.1, {1, 0, 0.3}, {0.5, 0.5, 0});
    write("bend.def", text_of(map.matrix()));
    for(auto v : mesh.vertices())
    {
      if(status(shape.points[v]) != 0)
        d.insert_roi_vertex(v);
      const Eigen::Vector3d target = map * shape.points[v];
      if(status(shape.points[v]) == 2)
        d.insert_control_vertex(v, Point(target.x(), target.y(), target.z()));
    }
    const CGAL::ARAP::Report report = d.deform(20, 0);
    CHECK(report);
    const std::string call = "in.off --selection in.sel --transform bend.def -o cells.off "
                             "--iterations 20 --tolerance 0 --cells " + cells;
    CHECK(run(call).exit_code == 0);
    const auto plain = read_points("cells.off");
    CHECK(run(call + " --stiffness z:..2.1 0.5 --stiffness z:..1.1 20 --rigid z:2.1..3.1 "
                     "--rigid z:3.1..").exit_code == 0);
    const auto result = read_points("cells.off");
    double difference = 0;
    for(auto v : mesh.vertices())
    {
      CHECK_AT_MOST((result[v] - vector(mesh.point(v))).norm(), 1e-9);
      difference = (std::max)(difference, (result[v] - plain[v]).norm());
    }
    CHECK(difference > 1e-2);
    check_refused(call + " --rigid list:999", 1, "there is no vertex 999");
    if(cells == "elements")
      check_refused(call + " --rigid near:0,0,0", 1, "has no cell: none has all its corners there");
  }
  const std::string call = "in.off --selection in.sel --transform in.def -o new.off ";
  check_refused(call + "--stiffness z:..1", 2, "--stiffness: expected WHAT K");
  check_refused(call + "--stiffness=z:..1", 2, "--stiffness: expected WHAT K");
  check_refused(call + "--stiffness z:..1 -2", 2, "a stiffness is not negative");
  check_refused(call + "--stiffness z:..1 stiff", 2, "'stiff' is not a finite number");
  check_refused(call + "--rigid everything", 2, "expected box:, sphere:");
}

// Time steps: free fall, against the sum of what implicit Euler adds; a body that hangs, against
// the library; and what makes no sense.
void test_dynamics()
{
  test_case() = "free fall";
  const std::string gravity = " --gravity 0,0,-9.5 --time_step 0.02 --modulus 300 ";
  const Run fall = run("in.off --frames 3 -o fall.off --report r.json" + gravity);
  CHECK(fall.exit_code == 0);
  auto json = nlohmann::json::parse(content(folder / "r.json"));
  std::ostringstream energies;
  energies << "energy " << json["frames"][2]["kinetic_energy"].get<double>() << " kinetic, "
           << json["frames"][2]["elastic_energy"].get<double>() << " elastic,";
  CHECK(fall.out.find(energies.str()) != std::string::npos);
  CHECK(json["frames"].size() == 3);
  for(int n = 1; n <= 3; ++n)
  {
    const auto points = read_points("fall-000" + std::to_string(n) + ".off");
    const double way = -9.5 * 0.02 * 0.02 * n * (n + 1) / 2;
    for(std::size_t v = 0; v < points.size(); ++v)
      CHECK_AT_MOST((points[v] - shape.points[v] - Eigen::Vector3d(0, 0, way)).norm(), 1e-9);
    const auto& frame = json["frames"][n - 1];
    CHECK_AT_MOST(std::abs(frame["center_of_mass"][2].get<double>() - 2.5 - way), 1e-9);
    CHECK_AT_MOST(frame["elastic_energy"].get<double>(), 1e-9);
  }

  CHECK(fall.out.find("last frame: ") != std::string::npos);
  double deform = 0;
  for(const auto& frame : json["frames"])
    deform += frame["seconds"]["deform"].get<double>();
  CHECK_AT_MOST(std::abs(json["seconds"]["deform"].get<double>() - deform), 1e-9);
  CHECK(run("in.off --frames 1 -o fall.off --report r.json" + gravity).exit_code == 0);
  json = nlohmann::json::parse(content(folder / "r.json"));
  CHECK(json["frames"].size() == 1 && json["frames"][0].contains("center_of_mass"));

  test_case() = "a body that hangs, and whose handle moves";
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  std::vector<Mesh::Vertex_index> handle;
  for(auto v : mesh.vertices())
  {
    if(status(shape.points[v]) != 0)
      d.insert_roi_vertex(v);
    if(status(shape.points[v]) != 2)
      continue;
    d.insert_control_vertex(v);
    handle.push_back(v);
  }
  CGAL::ARAP::Dynamics dynamics;
  dynamics.time_step = 0.02;
  dynamics.modulus = 300;
  dynamics.damping = 2;
  dynamics.acceleration = {-9.5, 0, 1};
  CHECK(run("in.off --selection in.sel --move 0,0,0.4 --frames 4 -o hang.off --gravity -9.5,0,1 "
            "--time_step 0.02 --modulus 300 --damping 2").exit_code == 0);
  for(int n = 1; n <= 4; ++n)
  {
    d.translate(handle, Eigen::Vector3d(0, 0, 0.1));
    CHECK(d.advance(dynamics));
    const auto points = read_points("hang-000" + std::to_string(n) + ".off");
    for(auto v : mesh.vertices())
      CHECK_AT_MOST((points[v] - vector(mesh.point(v))).norm(), 1e-7);
  }

  check_refused("in.off --fix z:..1 -o new.off" + gravity, 2, "give --frames, how many time steps");
  check_refused("in.off --fix z:..1 -o new.off --frames 3", 2, "nothing moves");
  check_refused("in.off --fix z:..1 -o new.off --frames 3 --damping 1", 2,
                "--damping is for time steps: give --gravity, too");
  const std::string call = "in.off --fix z:..1 -o new.off --frames 3 --gravity ";
  check_refused(call + "0,0", 2, "expected the numbers x,y,z");
  check_refused(call + "0,0,1 --time_step 0", 2, "--time_step must be positive");
  check_refused(call + "0,0,1 --time_step 1e300", 1, "--time_step, --modulus and --damping differ");
  check_refused(call + "0,0,1 --modulus x", 2, "--modulus 'x' is not a number");
}

void test_help()
{
  test_case() = "help";
  const Run help = run("--help");
  CHECK(help.exit_code == 0 && help.err.empty());
  for(const char* option :
      {"--selection", "--transform", "--output", "--report", "--image", "--cells", "--weights",
       "--minimizer", "--initial_guess", "--iterations", "--tolerance", "--threads",
       "--quiet", "--fix", "--handle", "--move", "--rotate", "--soft", "--region", "--frames",
       "--animation", "--view", "--quality", "--color", "--save-selection", "--save-transform",
       "--stiffness", "--rigid", "--gravity", "--time_step", "--modulus", "--damping", "--bending",
       "--smoothing", "--turn", "--onto", "--solver", "--rotation", "--version"})
    CHECK(help.out.find(option) != std::string::npos);

  test_case() = "version";
  const Run version = run("--version");
  CHECK(version.exit_code == 0 && version.err.empty());
  CHECK(version.out.rfind("arap_deform ", 0) == 0);
  CHECK(version.out.find("\nwith CGAL " CGAL_VERSION_STR ", Eigen ") != std::string::npos);

  test_case() = "the first command that the help shows";
  const std::string name = "\n  arap_deform ";
  std::string first = help.out.substr((std::min)(help.out.find(name) + name.size(),
                                                 help.out.size()));
  first.resize((std::min)(first.find("\n\n"), first.size()));
  const std::string mesh = first.substr(0, first.find(' '));
  if(!fs::exists(models / mesh))
  {
    std::cout << "NOTICE: the first command of the help was not tested without " << mesh
              << std::endl;
    return;
  }
  fs::copy(models / mesh, folder / mesh);
  CHECK(run(first + " --report r.json --quality").exit_code == 0);
  const auto json = nlohmann::json::parse(content(folder / "r.json"));
  if(json["vertices"] < 5000)
  {
    std::cout << "NOTICE: not tested on " << mesh << ", but on a stand-in" << std::endl;
    return;
  }
  CHECK_AT_MOST(json["edge_length_error"].get<double>(), 0.025); // there is no fold
  CHECK(json["self_intersections"] == 0);
}

void test_all()
{
  write("in.off", off(shape));
  write("in.sel", selection());
  write("in.def", quarter_turn);
  test_help();
  test_success();
  test_polygons();
  test_handles();
  test_frames();
  test_picks();
  test_gltf();
  test_quality();
  test_control_points();
  test_cell_values();
  test_dynamics();
  test_refusals();
}

} // namespace surfaces

// The command arap_deform on tetrahedra in .mesh files, run as a user runs it.
namespace volumes {

const Block shape = block(4, 2, 2);
const std::size_t number_of_vertices = shape.points.size();

// a row of coordinates, with as many digits as needed
std::string row(const Eigen::Vector3d& p)
{
  std::ostringstream out;
  out.precision(17);
  out << p.x() << ' ' << p.y() << ' ' << p.z();
  return out.str();
}

// The vertices of a .mesh file, with all that may be between them.
std::string vertices(const std::vector<Eigen::Vector3d>& points)
{
  std::string text = "Vertices # with references\r\n" + std::to_string(points.size()) + "\n";
  for(std::size_t v = 0; v < points.size(); ++v)
    text += row(points[v]) + '\t' + std::to_string(100 + v) + (v % 3 ? "\n" : " # one\n\n");
  return text;
}

std::string tetrahedra(const Block& block)
{
  std::string text = "Tetrahedra " + std::to_string(block.tetrahedra.size()) + '\n';
  int reference = 0;
  for(const auto& [a, b, c, d] : block.tetrahedra)
    text += std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) +
            "  " + std::to_string(d + 1) + ' ' + std::to_string(reference++ % 4) + '\n';
  return text;
}

const std::string head = "MeshVersionFormatted 2\n\n# a comment: Vertices 3\nDimension\n3\n";
const std::string before = "Corners 2\n1\n2\nMyOwnSection 3 4.5 1e3\n";
const std::string after = "Triangles 1 1 2 3 77 Ridges\n0\nNormals\n1\n0 0 1.50\n\nEnd\nVertices\n";

std::string mesh_file(const std::vector<Eigen::Vector3d>& points)
{
  return head + before + vertices(points) + tetrahedra(shape) + after;
}

std::string selection(const std::vector<int>& statuses)
{
  std::string text;
  for(int status : statuses)
    text += std::to_string(status) + '\n';
  return text;
}

// what is in the Vertices of a .mesh file of this test
std::vector<Eigen::Vector3d> read_points(const std::string& file)
{
  const std::string text = content(folder / file);
  std::istringstream in(text.substr((std::min)(text.find("references"), text.size())));
  std::string line;
  std::size_t n = 0;
  std::getline(in, line);
  in >> n;
  std::vector<Eigen::Vector3d> points(n);
  for(auto& p : points)
  {
    in >> p.x() >> p.y() >> p.z();
    std::getline(in, line);
  }
  CHECK(in);
  return points;
}

nlohmann::json report() { return nlohmann::json::parse(content(folder / "r.json")); }

// a scenario whose handle is moved by a rigid motion of all its vertices
struct Task
{
  std::vector<int> statuses;
  Affine_map motion;
};

Task make_task()
{
  Task task{{}, rigid_motion(1.2, {1, 0.4, -0.3}, {0.1, 0.2, 0.5})};
  for(const auto& p : shape.points)
    task.statuses.push_back(p.x() < 0.1 ? 0 : p.x() > 1.9 ? 2 : 1);
  return task;
}

void write_task(const Task& task)
{
  write("in.sel", selection(task.statuses));
  write("in.def", text_of(task.motion.matrix()));
}

const std::string call = "in.mesh --selection in.sel --transform in.def -o out.mesh "
                         "--report r.json --quiet ";

using Domain = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>,
                                                   std::vector<std::array<std::size_t, 4>>>;
template <typename Weight>
using Deformation =
  CGAL::ARAP_deformation<Domain, CGAL::ARAP_deformation_traits<CGAL::Default, Weight>>;

// `change(d)` follows when all else is set
template <typename Weight>
CGAL::ARAP::Report deform(const Task& task, std::vector<Point>& points, Cell_scheme cells,
                          const std::function<void(Deformation<Weight>&)>& change = {})
{
  Deformation<Weight> d(Domain(points, shape.tetrahedra));
  CHECK(d.set_options(options_for(cells, CGAL::ARAP::Minimizer::automatic,
                                  CGAL::ARAP::Initial_guess::automatic)));
  const Eigen::Matrix4d m = task.motion.matrix();
  for(std::size_t v = 0; v < number_of_vertices; ++v)
  {
    if(task.statuses[v] != 0)
      d.insert_roi_vertex(v);
    if(task.statuses[v] == 2)
    {
      d.insert_control_vertex(v);
      d.set_target_position(v, point((m * shape.points[v].homogeneous()).head<3>()));
    }
  }
  if(change)
    change(d);
  return d.deform(5, 0);
}

// every cell scheme with every weight, against the library
void test_choices()
{
  const Task task = make_task();
  write("in.mesh", mesh_file(shape.points));
  write_task(task);
  const std::vector<std::pair<std::string, Cell_scheme>> schemes = {
    {"spokes", Cell_scheme::spokes()}, {"spokes_and_rims", Cell_scheme::spokes_and_rims()},
    {"elements", Cell_scheme::elements()}};
  std::set<double> energies;
  for(const auto& [cells, scheme] : schemes)
    for(const std::string weights : {"cotangent", "clamped_cotangent", "safe_cotangent", "uniform"})
    {
      test_case() = cells + ", " + weights;
      std::vector<Point> points = points_of(shape.points);
      const CGAL::ARAP::Report expected =
        weights == "cotangent" ? deform<CGAL::ARAP::Cotangent_weight>(task, points, scheme)
        : weights == "clamped_cotangent"
          ? deform<CGAL::ARAP::Clamped_cotangent_weight>(task, points, scheme)
        : weights == "safe_cotangent"
          ? deform<CGAL::ARAP::Safe_cotangent_weight>(task, points, scheme)
          : deform<CGAL::ARAP::Uniform_weight>(task, points, scheme);
      const Run done = run(call + "--iterations 5 --tolerance 0 --cells " + cells + " --weights " +
                           weights);
      CHECK(bool(expected) == (done.exit_code == 0));
      if(!CHECK(done.exit_code == 0))
      {
        std::cerr << "    " << done.err;
        continue;
      }
      const auto json = report();
      const auto energy = json["energy"].get<std::vector<double>>();
      CHECK(energy.size() == expected.energy.size());
      for(std::size_t k = 0; k < energy.size() && k < expected.energy.size(); ++k)
        CHECK_AT_MOST(std::abs(energy[k] - expected.energy[k]), 1e-10 * expected.energy[0]);
      CHECK(json["vertices"] == number_of_vertices);
      CHECK(json["simplices"] == shape.tetrahedra.size());
      CHECK(json["free_vertices"] == expected.free_vertices);
      CHECK(json["inverted_simplices"] == expected.inverted_simplices);
      const std::vector<Eigen::Vector3d> result = read_points("out.mesh");
      CHECK(result.size() == number_of_vertices);
      for(std::size_t v = 0; v < result.size(); ++v)
        CHECK_AT_MOST((result[v] - vector(points[v])).norm(), 1e-10);

      // the edges of all tetrahedra, each once
      std::set<std::pair<std::size_t, std::size_t>> edges;
      for(const auto& t : shape.tetrahedra)
        for(int i = 0; i < 4; ++i)
          for(int j = 0; j < i; ++j)
            edges.insert(std::minmax(t[i], t[j]));
      double errors = 0, lengths = 0;
      for(const auto& [v, w] : edges)
      {
        const double length = (shape.points[v] - shape.points[w]).norm();
        errors += std::pow((result[v] - result[w]).norm() - length, 2);
        lengths += length * length;
      }
      CHECK_AT_MOST(std::abs(json["edge_length_error"].get<double>() - std::sqrt(errors / lengths)),
                    1e-12);
      energies.insert(energy.back());

      // all else is the same: the file is that of the new points
      CHECK(content(folder / "out.mesh") == mesh_file(result));
    }
  CHECK(energies.size() >= 9); // only safe ones agree with the clamped or the plain ones
}

// Everything else that changes the result, against the library.
void test_terms()
{
  using Deformation = volumes::Deformation<CGAL::ARAP::Safe_cotangent_weight>;
  const Task task = make_task();
  write("in.mesh", mesh_file(shape.points));
  write_task(task);
  const Eigen::AlignedBox3d box = bounding_box(shape.points);
  const auto x = [](std::size_t v) { return shape.points[v].x(); };
  const auto set = [](Deformation& d, auto CGAL::ARAP::Options::*option, auto value) {
    CGAL::ARAP::Options options = d.options();
    options.*option = value;
    CHECK(d.set_options(options));
  };
  using Options = CGAL::ARAP::Options;
  struct Term
  {
    std::string options;
    std::function<void(Deformation&)> change;
  };
  const Term terms[] = {
    {"", {}},
    {"--bending 0.3",
     [&](auto& d) { set(d, &Options::bending_length, 0.3 * box.diagonal().norm()); }},
    {"--smoothing 0.1",
     [&](auto& d) { set(d, &Options::smoothing_length, 0.1 * box.diagonal().norm()); }},
    {"--cells k_ring:1", [&](auto& d) { set(d, &Options::cells, Cell_scheme::k_ring(1)); }},
    {"--stiffness x:..0.6 20",
     [&](auto& d) { d.set_stiffness([=](std::size_t v) { return x(v) <= 0.6 ? 20. : 1.; }); }},
    {"--cells elements --stiffness x:..0.6 20",
     [&](auto& d) {
       set(d, &Options::cells, Cell_scheme::elements());
       d.set_stiffness(CGAL::ARAP::of_simplices([=](std::size_t t) {
         const auto& corners = shape.tetrahedra[t];
         return std::all_of(corners.begin(), corners.end(),
                            [=](std::size_t v) { return x(v) <= 0.6; }) ? 20. : 1.;
       }));
     }},
    {"--rigid x:0.9..",
     [&](auto& d) { d.set_groups([=](std::size_t v) { return x(v) >= 0.9 ? 0 : -1; }); }},
    {"--turn",
     [&](auto& d) {
       for(std::size_t v : d.control_vertices())
         CHECK(d.set_target_rotation(v, task.motion.linear));
     }},
    {"--soft 0.1", [&](auto& d) { CHECK(d.set_target_weight(d.control_vertices(), 0.1)); }},
    {"--solver eigen", {}}, {"--rotation svd", {}}, {"--solver single_precision", {}},
#ifdef CGAL_LINKED_WITH_CHOLMOD
    {"--solver cholmod", {}},
#endif
  };
  std::vector<Eigen::Vector3d> plain;
  for(const auto& [options, change] : terms)
  {
    test_case() = "tetrahedra, " + options;
    std::vector<Point> points = points_of(shape.points);
    CHECK(deform<CGAL::ARAP::Safe_cotangent_weight>(task, points, Cell_scheme::spokes_and_rims(),
                                                    change));
    const Run done = run(call + "--iterations 5 --tolerance 0 " + options);
    if(!CHECK(done.exit_code == 0))
      std::cerr << "    " << done.err;
    const auto result = read_points("out.mesh");
    if(plain.empty())
      plain = result;
    double difference = 0, change_by_option = 0;
    for(std::size_t v = 0; v < number_of_vertices; ++v)
    {
      difference = larger(difference, (result[v] - vector(points[v])).norm());
      change_by_option = (std::max)(change_by_option, (result[v] - plain[v]).norm());
    }
    CHECK_AT_MOST(difference, options == "--solver single_precision" ? 1e-4 : 1e-9);
    CHECK(change ? change_by_option > 1e-6
                 : (change_by_option > 0) == (!options.empty())); // other models round otherwise
  }
}

// Free fall in frames, with a film and all measures; and colors in a picture.
void test_frames()
{
  test_case() = "frames of tetrahedra";
  write("in.mesh", mesh_file(shape.points));
  CHECK(run("in.mesh --frames 2 --gravity 0,0,-9.5 --time_step 0.02 --modulus 300 -o fall.mesh "
            "--animation fall.gltf --quality --report r.json --quiet").exit_code == 0);
  for(int n = 1; n <= 2; ++n)
  {
    const auto points = read_points("fall-000" + std::to_string(n) + ".mesh");
    const Eigen::Vector3d way(0, 0, -9.5 * 0.02 * 0.02 * n * (n + 1) / 2);
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      CHECK_AT_MOST((points[v] - shape.points[v] - way).norm(), 1e-9);
    CHECK(content(folder / ("fall-000" + std::to_string(n) + ".mesh")) == mesh_file(points));
  }
  const auto json = report();
  CHECK(json["frames"].size() == 2);
  CHECK(json["self_intersections"] == 0);
  CHECK_AT_MOST(json["edge_length_error"].get<double>(), 1e-8);
  CHECK_AT_MOST(std::abs(json["volume_change"].get<double>()), 1e-8);
  const auto gltf = nlohmann::json::parse(content(folder / "fall.gltf"));
  CHECK(gltf["meshes"][0]["primitives"][0]["targets"].size() == 2);
}

void test_no_boundary()
{
  test_case() = "tetrahedra without a boundary";
  write("closed.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n"
                       "0 1 0 0\n0 0 1 0\nTetrahedra 2\n1 2 3 4 0\n1 2 3 4 0\nEnd\n");
  const std::string line = "closed.mesh --fix list:0,1 --handle list:2 --move 0,0,1 -o new.mesh";
  CHECK(run(line).exit_code == 0);
  fs::remove(folder / "new.mesh");
  write("precious.off", "precious");
  check_refused(line + " --animation film.glb", 1,
                "closed.mesh: has nothing to draw, as each face is in several tetrahedra");
}

void test_text()
{
  test_case() = "nothing moves";
  // ways to write numbers that a program would not choose
  const std::string odd = head + "Vertices 6\n0.0 -0 +0.000 1 1. 0 0e5 -2\n0 1.00 0 3 0 0 "
                          "1.0000000000000000001 4#x\n1 1 1 5\n50 60.0 7e1 6\n"
                          "Tetrahedra\n2\n1 2 3 4 0\n2 3 4 5 0\n" + after;
  write("odd.mesh", odd);
  write("all.sel", "0\n1\n1\n1\n2\n1\n");
  write("identity.def", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const std::string odd_call = "odd.mesh --selection all.sel --report r.json -o new.mesh ";
  CHECK(run(odd_call + "--transform identity.def").exit_code == 0);
  CHECK(content(folder / "new.mesh") == odd);
  CHECK(report()["energy"].back() == 0);
#if defined(__unix__) || defined(__APPLE__)
  CHECK(run("odd.mesh --selection all.sel --transform identity.def -o /dev/stdout").out == odd);
#endif
  write("fixed.sel", "0\n0\n0\n0\n0\n0\n");
  CHECK(run("odd.mesh --selection fixed.sel -o new.mesh --frames 1 --gravity 0,0,1")
          .exit_code == 0);
  CHECK(content(folder / "new-0001.mesh") == odd);
  fs::remove(folder / "new-0001.mesh");

  test_case() = "a vertex without a tetrahedron stays";
  write("shift.def", "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  CHECK(run(odd_call + "--transform shift.def").exit_code == 0);
  const std::string moved = content(folder / "new.mesh");
  CHECK(moved.find("\n1.25 1 1 5\n50 60.0 7e1 6\nTetrahedra\n2\n") != std::string::npos);
  CHECK(moved.find("Vertices 6\n0.0 -0 +0.000 1 ") != std::string::npos);
  CHECK(moved.substr(moved.find("Tetrahedra")) == odd.substr(odd.find("Tetrahedra")));
  const std::string note = "\nfree vertices that are in no tetrahedron, and stay: ";
  CHECK(run(odd_call + "--transform shift.def").out.find(note + "1\n") != std::string::npos);
  CHECK(report()["vertices_in_no_simplex"] == 1);
  const std::string fixed = odd_call + "--transform shift.def --fix list:5";
  CHECK(run(fixed).out.find(note) == std::string::npos); // it is not expected to move
  CHECK(report()["vertices_in_no_simplex"] == 0);

  test_case() = "in place, without an End, upper case";
  const std::string end = "\nEnd\nVertices\n";
  write("SELF.MESH", odd.substr(0, odd.size() - end.size()));
  CHECK(run("SELF.MESH --selection all.sel -o SELF.MESH --transform shift.def").exit_code == 0);
  CHECK(content(folder / "SELF.MESH") + end == moved);
}

// The same tetrahedra in the formats of Gmsh and VTK, with all that may be around them.
void test_other_formats()
{
  const Task task = make_task();
  write_task(task);
  write("in.mesh", mesh_file(shape.points));
  const std::string rest = " --selection in.sel --transform in.def --iterations 5 --tolerance 0 "
                           "--quiet -o ";
  CHECK(run("in.mesh" + rest + "out.mesh").exit_code == 0);
  const std::vector<Eigen::Vector3d> expected = read_points("out.mesh");
  const std::size_t n = shape.points.size(), m = shape.tetrahedra.size();
  using Points = std::vector<Eigen::Vector3d>;
  const auto cells = [m](const std::string& start, const std::string& end, std::size_t first) {
    std::string text;
    for(std::size_t i = 0; i < m; ++i)
    {
      text += start == "#" ? std::to_string(i + 7) + ' ' : start;
      for(std::size_t v : shape.tetrahedra[i])
        text += std::to_string(first + v) + ' ';
      text += end;
    }
    return text;
  };

  const auto msh2 = [&](const Points& points) {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"$Nodes\"\n"
                       "$EndPhysicalNames\n$Nodes\n" + std::to_string(n) + '\n';
    for(std::size_t v = 0; v < n; ++v)
      text += std::to_string(v + 100) + ' ' + row(points[v]) + '\n';
    text += "$EndNodes\n$Elements\n" + std::to_string(m + 1) + "\n1 2 2 1 -3 100 101 102\n";
    return text + cells("5 4 3 1 2 9 ", "\n", 100) + "$EndElements\n$NodeData\n1 2 3\n";
  };
  const auto msh4 = [&](const Points& points) {
    std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 0\n$EndEntities\n"
                       "$Nodes\n2 " + std::to_string(n) + " 1 " + std::to_string(n) + "\n1 -4 1 1\n"
                       "1\n" + row(points[0]) + " 0.5\n3 1 0 " + std::to_string(n - 1) + '\n';
    for(std::size_t v = 1; v < n; ++v)
      text += std::to_string(v + 1) + '\n';
    for(std::size_t v = 1; v < n; ++v)
      text += row(points[v]) + '\n';
    text += "$EndNodes\n$Elements\n2 " + std::to_string(m + 1) + " 1 9\n2 1 2 1\n5 1 2 3\n3 1 4 " +
            std::to_string(m) + '\n';
    return text + cells("#", "\n", 1) + "$EndElements\n";
  };
  const auto vtk = [&](const std::string& version, const Points& points) {
    std::string text = "# vtk DataFile Version " + version + "\nPOINTS of a title\nASCII\nDATASET "
                       "UNSTRUCTURED_GRID\nPOINTS " + std::to_string(n) + " double\n";
    for(const auto& p : points)
      text += row(p) + "  ";
    if(version == "3.0")
      text += "\n\nCELLS " + std::to_string(m + 1) + ' ' + std::to_string(5 * m + 4) +
              "\n3 0 1 2\n" + cells("4 ", "\n", 0);
    else
    {
      text += "\nMETADATA\nINFORMATION 0\n\nCELLS " + std::to_string(m + 2) + ' ' +
              std::to_string(4 * m + 3) + "\nOFFSETS vtktypeint64\n0 3 ";
      for(std::size_t i = 1; i <= m; ++i)
        text += std::to_string(3 + 4 * i) + ' ';
      text += "\nCONNECTIVITY vtktypeint64\n0 1 2 " + cells("", "", 0);
    }
    text += "\nCELL_TYPES " + std::to_string(m + 1) + "\n5\n";
    for(std::size_t i = 0; i < m; ++i)
      text += "10\n";
    return text + "POINT_DATA 1\nSCALARS a float\n";
  };
  const auto check_same = [&](const std::string& name, const std::string& file, const auto& text) {
    test_case() = name;
    write("in." + file, text(shape.points));
    const Run done = run("in." + file + rest + "out." + file);
    if(!CHECK(done.exit_code == 0))
      std::cerr << "    " << done.err;
    CHECK(content(folder / ("out." + file)) == text(expected));
    CHECK(run("in." + file + rest + "other.mesh").exit_code == 0);
    const std::string other = content(folder / "other.mesh");
    CHECK(other.find("Vertices " + std::to_string(n) + '\n' + row(expected[0]) + " 0\n") !=
          std::string::npos);
    write("precious.off", "precious");
    check_refused("in." + file + rest + "new.off", 2, "only be written to a .mesh file, or to a");
  };
  check_same("msh 2.2", "msh", msh2);
  check_same("msh 4.1", "msh", msh4);
  check_same("vtk 3.0", "vtk", [&](const Points& points) { return vtk("3.0", points); });
  check_same("vtk 5.1", "vtk", [&](const Points& points) { return vtk("5.1", points); });
  for(const std::string version : {"3.0", "5.1"}) // as free as other writers are
    check_same("vtk in lower case", "vtk", [&](const Points& points) {
      std::string text = vtk(version, points);
      for(const std::string word : {"ASCII", "DATASET", "UNSTRUCTURED_GRID\nPOINTS", "CELLS",
                                    "OFFSETS", "CONNECTIVITY", "CELL_TYPES"})
        if(const std::size_t place = text.find(word); place != std::string::npos)
          for(std::size_t i = place; i < place + word.size(); ++i)
            text[i] = text[i] == '\n' ? '\t' : static_cast<char>(std::tolower(text[i]));
      return replaced(text, "cell_types", "  cell_types");
    });

  const auto refuse = [&](const std::string& file, const std::string& text,
                          const std::string& phrase) {
    write("bad." + file, text);
    const bool is_start = phrase[0] == ':' || phrase[0] == ',';
    check_refused("bad." + file + rest + "out2." + file, 1,
                  (is_start ? "bad." + file : "") + phrase);
  };
  const std::string good = msh2(shape.points), good4 = msh4(shape.points),
                    grid = vtk("5.1", shape.points);
  refuse("msh", "OFF\n", ", line 1: a .msh file starts with '$MeshFormat', but this with 'OFF'");
  refuse("msh", replaced(good, "2.2 0", "4 0"), ", line 2: only the versions 2.2 and 4.1");
  refuse("msh", replaced(good, "2.2 0", "2.2 1"),
         ": is binary, but does not show its byte order by the number 1");
  refuse("msh", replaced(good, "\n$Nodes\n", "\n$Node\n"), ": has no $Nodes");
  refuse("msh", replaced(good, "\n101 ", "\n100 "), ", line 11: a node has the same number as");
  refuse("msh", replaced(good, "100 101 102", "100 101 7"), ", line 58: there is no node '7'");
  const std::string only = "only tetrahedra with four vertices can be deformed, but there are "
                           "elements of the type ";
  refuse("msh", replaced(good, "\n5 4 3", "\n5 5 3"), ", line 59: " + only + "5, after '9'");
  refuse("msh", replaced(good4, "3 1 4 ", "3 1 11 "), ", line 107: " + only + "11, after '7'");
  refuse("msh", replaced(good4, "3 1 4 ", "3 1 4 9"), ", line 187: expected an integer");
  for(std::size_t size = 100; size < good.find("$EndElements") - 20; size += 97)
    refuse("msh", good.substr(0, size), "");
  refuse("vtk", "vtk\n", ": does not start with '# vtk DataFile'");
  refuse("vtk", replaced(grid, "ASCII", "BINARY"), ", line 3: only ASCII files can be read, but");
  refuse("vtk", replaced(grid, "UNSTRUCTURED_GRID", "POLYDATA"), ", line 4: only an UNSTRUCTURED");
  refuse("vtk", replaced(grid, " double\n", " int\n"),
         ", line 5: expected POINTS of the type float or double, but found 'int'");
  refuse("vtk", replaced(grid, "\n10\n", "\n12\n"), "a cell of the type 12 with 4 vertices, after");
  refuse("vtk", replaced(grid, "0 1 2 ", "0 1 99999 "), "but found '99999'");
  refuse("vtk", replaced(grid, "\n0 3 7 ", "\n3 3 7 "), "an integer from 0 to 0, but found '3'");
  refuse("vtk", replaced(grid, "\n0 3 7 ", "\n0 3 2 "), "an integer from 3 to 2147483647, but");
  refuse("vtk", replaced(grid, "CELL_TYPES ", "CELL_TYPES 1"), "CELL_TYPES, but found");
  for(std::size_t size = 60; size < grid.find("CELL_TYPES"); size += 97)
    refuse("vtk", grid.substr(0, size), "");
}

// A point inside a tetrahedron, and one outside of all.
void test_control_points()
{
  test_case() = "control points";
  write("in.mesh", mesh_file(shape.points));
  const auto& t = shape.tetrahedra[17];
  const auto centroid = [&](const std::vector<Eigen::Vector3d>& p) {
    return Eigen::Vector3d((p[t[0]] + p[t[1]] + p[t[2]] + p[t[3]]) / 4);
  };
  std::string place = row(centroid(shape.points));
  std::replace(place.begin(), place.end(), ' ', ',');
  for(const std::string solver : {"default", "eigen"}) // with a border, and without
  {
    CHECK(run("in.mesh --fix x:..0.1 --handle point:" + place + " --move 0.25,0,0.5 -o out.mesh "
              "--solver " + solver).exit_code == 0);
    CHECK_AT_MOST((centroid(read_points("out.mesh")) - centroid(shape.points) -
                   Eigen::Vector3d(0.25, 0, 0.5)).norm(), 1e-9);
  }
  const Run done = run("in.mesh --fix x:..0.1 --handle point:9,9,9 --move 0,0,0 -o out.mesh");
  CHECK(done.exit_code == 0);
  const auto result = read_points("out.mesh");
  for(std::size_t v = 0; v < number_of_vertices; ++v)
    CHECK_AT_MOST((result[v] - shape.points[v]).norm(), 1e-9);
}

void test_rigid_motion()
{
  test_case() = "the boundary moves rigidly";
  Task task = make_task();
  const auto is_inside = [](std::size_t v) { // of block(4, 2, 2), from 0 to 4, 0 to 2 and 0 to 2
    const std::size_t z = v % 3, y = v / 3 % 3, x = v / 9;
    return z == 1 && y == 1 && x > 0 && x < 4;
  };
  for(std::size_t v = 0; v < number_of_vertices; ++v)
    task.statuses[v] = is_inside(v) ? 1 : 2;
  write("in.mesh", mesh_file(shape.points));
  write_task(task);
  for(const std::string cells : {"spokes", "spokes_and_rims", "elements"})
  {
    CHECK(run(call + "--tolerance 0 --iterations 200 --cells " + cells).exit_code == 0);
    const auto json = report();
    CHECK(json["free_vertices"] == 3);
    CHECK_AT_MOST(json["energy"].back().get<double>(), 1e-20);
    CHECK(json["inverted_simplices"] == 0);
    CHECK_AT_MOST(json["edge_length_error"].get<double>(), 1e-8);
    const auto result = read_points("out.mesh");
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      CHECK_AT_MOST((result[v] - task.motion * shape.points[v]).norm(), 1e-8);
  }
}

// One end of the block is pushed through the other: the volumes tell which tetrahedra are inside
// out.
void test_inside_out()
{
  test_case() = "inside out";
  Task task = make_task();
  task.motion = rigid_motion(0, {1, 0, 0}, {-4, 0, 0});
  write("in.mesh", mesh_file(shape.points));
  write_task(task);
  const Run done = run("in.mesh --selection in.sel --transform in.def -o out.mesh --report r.json "
                       "--iterations 3");
  CHECK(done.exit_code == 0);
  const auto result = read_points("out.mesh");
  const auto volume = [](const auto& t, const auto& points) {
    Eigen::Matrix3d edges;
    for(int k = 0; k < 3; ++k)
      edges.col(k) = points[t[k + 1]] - points[t[0]];
    return edges.determinant();
  };
  std::size_t inverted = 0;
  for(const auto& t : shape.tetrahedra)
    inverted += volume(t, shape.points) * volume(t, result) < 0;
  CHECK(inverted > 0);
  CHECK(report()["inverted_simplices"] == inverted);
  CHECK(done.out.find(std::to_string(inverted) + " of " + std::to_string(shape.tetrahedra.size()) +
                      " tetrahedra are inside out") != std::string::npos);

  test_case() = "inside out, and nothing is free";
  write("mirror.def", "-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  CHECK(run("in.mesh --handle x:-1e9.. --transform mirror.def -o out.mesh --report r.json")
          .exit_code == 0);
  CHECK(report()["inverted_simplices"] == shape.tetrahedra.size());

  test_case() = "picture";
  if(is_long_run())
    check_picture(call);
#if defined(__unix__) || defined(__APPLE__)
  CHECK(scene(call + "--view 0,0") == scene(call + "--view 0,1,0"));
  CHECK(scene(call + "--color volume").find("\"volume up to ") != std::string::npos);
#endif
}

void test_refusals()
{
  write("precious.off", "precious");
  write("precious.mesh", "precious");
  write("four.sel", "0\n1\n1\n2\n");
  write("in.def", "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const std::string rest = " --selection four.sel --transform in.def -o precious.mesh";
  const auto refuse = [&](const std::string& text, const std::string& phrase) {
    write("bad.mesh", text);
    check_refused("bad.mesh" + rest, 1, "bad.mesh" + phrase);
    CHECK(content(folder / "precious.mesh") == "precious");
  };
  const std::string good = "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 1\n1 0 0 1\n"
                           "0 1 0 1\n0 0 1 1\nTetrahedra\n1\n1 2 3 4 1\nEnd\n";
  const auto refuse_with = [&](const std::string& from, const std::string& to,
                               const std::string& phrase) {
    refuse(replaced(good, from, to), phrase);
  };

  write("other.mesh", replaced(good, "End", "Hexahedra\n0\nEnd")); // elements that are not there
  CHECK(run("other.mesh --selection four.sel --transform in.def -o other.mesh").exit_code == 0);
  refuse("", ": is empty");
  refuse("OFF\n4 4 0\n", ", line 1: a .mesh file starts with 'MeshVersionFormatted', but this with "
                         "'OFF'");
  refuse("\n# nothing\n", ", line 3: a .mesh file starts with 'MeshVersionFormatted', but this "
                          "with the end of the file");
  refuse(std::string("\1\0\0\0\3\0\0\0\24\0\0\0\3\0\0\0", 16), ": is binary; of Medit's formats");
  refuse_with("MeshVersionFormatted", "MeshVersionUnformatted", ", line 1: a .mesh file starts");
  refuse_with("Dimension 3", "", ": has no Dimension");
  refuse_with("Dimension 3", "Dimension 2", ", line 2: the Dimension of a mesh of tetrahedra is 3, "
                                            "but this is '2'");
  refuse_with("Dimension 3", "Dimension", ", line 3: the Dimension of a mesh of tetrahedra is 3");
  refuse_with("Vertices", "Points", ": has no Vertices");
  refuse_with("Tetrahedra\n1\n1 2 3 4 1\n", "", ": has no tetrahedra; surfaces are read from");
  refuse_with("Tetrahedra\n1\n1 2 3 4 1\n", "Tetrahedra 0\n", ": has no tetrahedra; surfaces");
  refuse_with("End", "Vertices\n0\nEnd", ", line 12: the file has a second section 'Vertices'");
  refuse_with("End", "Tetrahedra\n0\nEnd", ", line 12: the file has a second section 'Tetrahedra'");
  refuse_with("End", "Dimension 3\nEnd", ", line 12: the file has a second section 'Dimension'");
  for(const std::string element : {"TetrahedraP2", "TrianglesP2", "EdgesP2", "HexahedraQ2",
                                   "TetrahedraP3", "QuadrilateralsQ2", "Hexahedra", "Prisms",
                                   "Pyramids"})
    refuse_with("End", element + "\n1\n1 2 3 4 1 2 3 4 1 2 0\nEnd",
                ", line 12: only tetrahedra with four vertices can be deformed, but there are '" +
                  element + "'");

  const std::string sentence = "expected how many Vertices there are, but found '";
  for(const std::string count : {"-4", "four", "4.5", "2147483648", "9999999999999999999999", "4x"})
    refuse_with("4\n0 0", count + "\n0 0", ", line 4: " + sentence + count);
  refuse_with("1\n1 2 3", "-1\n1 2 3", ", line 10: expected how many Tetrahedra there are, but");
  refuse_with("4\n0 0", "5\n0 0", ", line 9: expected a finite number, a coordinate in row 5 of "
                                  "the 5 Vertices, but found 'Tetrahedra'");
  refuse_with("4\n0 0", "2147483647\n0 0", ", line 9: expected a finite number, a coordinate in "
                                           "row 5 of the 2147483647 Vertices");
  refuse_with("4\n0 0", "3\n0 0", ", line 8: expected the next section after 3 Vertices, but found "
                                  "'0'");
  refuse_with("1\n1 2 3", "2\n1 2 3", ", line 12: expected a vertex from 1 to 4, a corner in row 2 "
                                      "of the 2 Tetrahedra, but found 'End'");
  refuse_with("1\n1 2 3", "2000000000\n1 2 3", ", line 12: expected a vertex from 1 to 4");
  refuse_with("4 1\nEnd", "4 1\n2 1 3 4 1\nEnd", ", line 12: expected the next section after 1 "
                                                 "Tetrahedra, but found '2'");
  for(std::size_t size = 1; size < good.find("4 1\nEnd"); size += 7) // the end is lost
    refuse(good.substr(0, size), "");
  for(const std::string number : {"nan", "NaN", "inf", "-inf", "1e999", "x", "1,5", "1.5.2", "--1"})
    refuse_with("0 1 0 1", "0 " + number + " 0 1", ", line 7: expected a finite number, a "
                "coordinate in row 3 of the 4 Vertices, but found '" + number + "'");
  refuse_with("0 1 0 1", "0 1 0 one", ", line 7: expected an integer, the reference in row 3 of "
                                      "the 4 Vertices, but found 'one'");
  for(const std::string corner : {"0", "5", "-1", "4294967297", "2.5", "x"})
    refuse_with("1 2 3 4 1", "1 " + corner + " 3 4 1", ", line 11: expected a vertex from 1 to 4, "
                "a corner in row 1 of the 1 Tetrahedra, but found '" + corner + "'");
  refuse_with("1 2 3 4 1", "1 2 3 2 1", ", line 11: row 1 of the 1 Tetrahedra has a vertex twice; "
                                        "the last word is '2'");
  refuse_with("1 2 3 4 1", "1 2 3 4 1.5", ", line 11: expected an integer, the reference in row 1");

  write("good.mesh", good);
  const std::string good_call = "good.mesh --selection four.sel --transform in.def ";
  check_refused("missing.mesh" + rest, 1, "missing.mesh: there is no such file");
  check_refused(good_call + "-o out.off", 2,
                "--output out.off: the tetrahedra of good.mesh can only be written to a .mesh "
                "file");
  check_refused(good_call + "-o out.meshb", 2, "ends in .off, .obj, .ply, .stl, .gltf, .glb,");
  write("five.sel", "0\n1\n1\n2\n1\n");
  check_refused("good.mesh --selection five.sel --transform in.def -o new.mesh", 1,
                "has 5 statuses, but the mesh has 4 vertices");
  const Run done = run(good_call + "-o new.mesh");
  CHECK(done.exit_code == 0); // or all of the above would be in vain
}

void test_all()
{
  test_choices();
  test_terms();
  test_frames();
  test_no_boundary();
  test_text();
  test_other_formats();
  test_control_points();
  test_rigid_motion();
  test_inside_out();
  test_refusals();
}

} // namespace volumes

int main(int argc, char** argv)
{
  if(argc > 2)
    models = argv[2];
  return test_command(argc, argv, {surfaces::test_all, volumes::test_all});
}
