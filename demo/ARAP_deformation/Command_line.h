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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_COMMAND_LINE_H
#define CGAL_ARAP_DEFORMATION_DEMO_COMMAND_LINE_H

#include "Output_file.h"
#include "Pick.h"
#include "arguments.h"

#include <CGAL/ARAP_deformation/Chosen_edge_weight.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/ARAP_deformation/set_option.h>

#include <boost/lexical_cast.hpp>
#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <ostream>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

enum class Solver_choice { automatic, single_precision, eigen, cholmod, petsc, petsc_cg };

enum class Rotation_choice { newton, svd };

// --move or --rotate
struct Motion_step
{
  bool is_rotation;
  Measures place; // of a move, its vector; of a rotation, its center, empty for that of the handle
  std::array<double, 3> axis = {};
  double angle = 0; // in degrees
};

// what the options after a --handle say of it
struct Handle_options
{
  std::vector<Motion_step> steps;
  std::optional<double> weight;
  std::optional<Pick> plane; // to which its targets pull, and not to points
  bool is_frame = false; // it turns the cells at its vertices, too
  bool is_point = false; // it is a point inside a simplex
};

struct Command_line
{
  bool is_help = false;
  bool is_version = false;
  bool is_quiet = false;
  std::string mesh, selection, output; // files; there may be no selection
  std::vector<std::string> transforms; // files, one for each key frame
  // files, empty if not asked for
  std::string report, image, animation, save_selection, save_transform;
  std::vector<std::pair<int, Pick>> picks; // with the status; later ones win
  std::vector<Pick> region;
  std::vector<Pick> rigid;             // the cells in each share a rotation
  std::vector<Pick> stiff;             // the cells in each have the stiffness
  std::vector<double> stiffness;       // of the same number; later ones win
  std::optional<Dynamics> dynamics;    // if each frame is a time step
  std::vector<Handle_options> handles; // of each --handle
  Handle_options all_handles;          // where there is none
  int frames = 1;
  bool is_sequence = false;            // a mesh is written for each frame, not only for the last
  std::vector<double> view;            // azimuth and elevation, or a direction; empty if not given
  bool has_quality = false;            // self-intersections are looked for
  std::string color;                   // what is measured at the vertices, or empty
  Chosen_edge_weight weights;
  Solver_choice solver = Solver_choice::automatic;
  Rotation_choice rotation = Rotation_choice::newton;
  Options options;
};

inline boost::program_options::options_description described_options()
{
  using boost::program_options::value;
  const Options defaults;
  boost::program_options::options_description task("What is held and moved"), output("Output"),
    run("The deformation"), dynamics("Time steps with inertia, instead of a shape at rest"),
    other("Other");
  // an option that picks or moves vertices: what it says depends on those before it
  const auto in_order = [] { return value<std::vector<std::string>>()->composing(); };
  task.add_options()
    ("fix", in_order()->value_name("WHAT"), "these vertices stay")
    ("handle", in_order()->value_name("WHAT"),
     "these are a handle, for the next five options; each --handle is a new one")
    ("move", in_order()->value_name("DX,DY,DZ"), "move the handle")
    ("rotate", in_order()->value_name("AXIS ANGLE [X,Y,Z]"),
     "turn it about x, y, z or a vector, by degrees; about a point or else its own center")
    ("soft", in_order()->value_name("WEIGHT"),
     "its targets pull with this weight, instead of being met; an edge weighs about 1 on a "
     "surface, and about its length in a volume")
    ("onto", in_order()->value_name("PLANE"),
     "to this plane, plane:X,Y,Z,NX,NY,NZ, along which they glide; the plane moves as the handle")
    ("turn",
     "its rotation is prescribed to the cells at it: even one vertex turns its surroundings")
    ("region", in_order()->value_name("WHAT"), "of the free vertices only these may move")
    ("stiffness", in_order()->value_name("WHAT K"), "these cells are K times as stiff")
    ("rigid", in_order()->value_name("WHAT"),
     "these cells share a rotation; each --rigid is a part of its own")
    ("selection", value<std::string>()->default_value("", "")->value_name("S.sel"),
     "instead of --handle: a status per line and vertex: 0 fixed, 1 free, k >= 2 handle k; # is a "
     "comment; what --fix picks is fixed, whatever the file says")
    ("transform", value<std::vector<std::string>>()->composing()->value_name("T.def"),
     "instead of moves: a 4 x 4 matrix, row by row, for each handle or one for all; given "
     "several times: key frames, and without --frames and --animation OUT-0001 is written for the "
     "first, OUT-0002 for the second and so on, and no OUT")
    ("save-selection", value<std::string>()->default_value("", "")->value_name("S.sel"),
     "write the selection that was picked")
    ("save-transform", value<std::string>()->default_value("", "")->value_name("T.def"),
     "write the matrices of the handles at the end");
  output.add_options()
    ("output,o", value<std::string>()->value_name("OUT")->required(),
     "the deformed mesh; for tetrahedra .mesh or the format of MESH")
    ("frames", value<std::string>()->value_name("N"),
     "write OUT-0001, OUT-0002 and so on, the number before the ending: the way to the end in N "
     "frames, each from the one before")
    ("animation", value<std::string>()->default_value("", "")->value_name("FILM"),
     "of the frames: .gif, .mp4 or .webm (needs ffmpeg), .gltf or .glb")
    ("report", value<std::string>()->default_value("", "")->value_name("R.json"),
     "write a report as JSON")
    ("quality", "look for self-intersections, too, for the report")
    ("color", value<std::string>()->default_value("", "")->value_name("NAME"),
     "color the picture, and add a property to a .ply file: edge_error, area or volume (two "
     "names for one measure, of faces or of tetrahedra), angle, spike (how far a vertex is from "
     "its neighbors)")
    ("image", value<std::string>()->default_value("", "")->value_name("PICTURE.png"),
     "draw the shape before and after, fixed red, handles yellow; needs povray")
    ("view", value<std::string>()->value_name("A,E"),
     "of --image and of a film: azimuth and elevation of the eye in degrees, or its direction "
     "X,Y,Z");
  run.add_options()
    ("cells", value<std::string>()->default_value("spokes_and_rims")->value_name("NAME"),
     "which edges share a rotation: spokes, spokes_and_rims, elements, or k_ring:K, the spokes of "
     "all vertices within K rings")
    ("bending", value<std::string>()->default_value("0")->value_name("B"),
     "the length over which a sharp bend is spread, as a share of the bounding box's diagonal; "
     "0.02 to 0.1 keep a pulled vertex from being a spike, except on a border")
    ("smoothing", value<std::string>()->default_value("0")->value_name("S"),
     "the length over which rotations are made smooth, as a share of the bounding box's diagonal")
    ("weights", value<std::string>()->default_value("safe_cotangent")->value_name("NAME"),
     "cotangent (with spokes the energy can be negative), clamped_cotangent, uniform, or "
     "safe_cotangent: clamped for stars (spokes, k_ring) only")
    ("minimizer", value<std::string>()->default_value("automatic")->value_name("NAME"),
     "local_global, that of the paper; quasi_newton, with fewer iterations; or automatic: "
     "quasi_newton unless the tolerance is 0")
    ("solver", value<std::string>()->default_value("default")->value_name("NAME"),
     "of linear systems: default, single_precision (its factor takes half the memory), eigen, and "
     "where the command is linked with them cholmod, petsc (its factor is distributed over the "
     "processes that mpirun starts) or petsc_cg (without a factor, for the largest shapes)")
    ("rotation", value<std::string>()->default_value("newton")->value_name("NAME"),
     "how rotations are fitted: newton, or svd")
    ("initial_guess", value<std::string>()->default_value("automatic")->value_name("NAME"),
     "where to start: previous (the input with the handles moved), rotations (Poisson editing), "
     "laplacian, or automatic: previous, or rotations where a handle is torn away by over a "
     "tenth of the diagonal and that is better, and on large surfaces then a run on a coarser one")
    ("iterations", value<std::string>()->default_value(std::to_string(defaults.iterations))
       ->value_name("N"), "run at most N iterations")
    ("tolerance", value<std::string>()->value_name("T")
       ->default_value(boost::lexical_cast<std::string>(defaults.tolerance)),
     "stop when the estimated relative gap to the minimum is at most T; 0: run all N")
    ("verify_minimum", value<std::string>()->default_value("true")->value_name("true|false"),
     "look at the second derivative before the end, and go on if that is not at a minimum")
    ("coarse_metric", value<std::string>()->default_value("true")->value_name("true|false"),
     "complete the metric of quasi-Newton runs where 30,000 vertices or more are free: fewer "
     "iterations, more memory")
    ("threads", value<std::string>()->default_value(std::to_string(defaults.threads))
       ->value_name("N"),
     "use at most N threads; 0: as many as processors");
  dynamics.add_options()
    ("gravity", value<std::string>()->value_name("X,Y,Z"),
     "each of the --frames is a time step under this acceleration, in any consistent units")
    ("time_step", value<std::string>()->value_name("H"), "the time of a step; default 1/60")
    ("modulus", value<std::string>()->default_value("1")->value_name("M"),
     "how stiff a body of density 1 is: its elastic energy is M times the energy")
    ("damping", value<std::string>()->default_value("0")->value_name("D"),
     "the rate at which velocities decay");
  other.add_options()
    ("quiet", "print only errors: no summary, no notes, no progress")
    ("help,h", "print this and exit")
    ("version", "print the version, and what it was built with, and exit");
  return task.add(output).add(run).add(dynamics).add(other);
}

inline void print_help(std::ostream& out)
{
  out << "usage: arap_deform MESH -o OUT --handle WHAT --rotate AXIS ANGLE ... [options]\n\n"
         "  arap_deform cactus.off -o bent.off --fix z:..5% --handle z:90%.. \\\n"
         "    --rotate x 60 50%,50%,40%\n\n"
         "holds the lowest twentieth of the shape, turns the top by 60 degrees about a\n"
         "point at two fifths of the height, and lets the rest follow so that every small\n"
         "part of it turns and moves, but stretches as little as possible (Sorkine and\n"
         "Alexa 2007).\n\n"
         "MESH is a surface in an .off, .obj, .ply, .stl, .gltf or .glb file, or tetrahedra\n"
         "in a .mesh (Medit), .msh (Gmsh, text or binary), .vtk (text) or .vtu file. OUT is\n"
         "of the same kind; a pipe gets the format of MESH. A note says what OUT does not\n"
         "keep of MESH.\n\n"
         "WHAT picks vertices; later options win. It is one of\n"
         "  z:90%..  y:..0.2  x:-1..1          between two x, y or z, or beyond one\n"
         "  box:X0,Y0,Z0,X1,Y1,Z1  sphere:X,Y,Z,R  inside a box, inside a ball\n"
         "  plane:X,Y,Z,NX,NY,NZ               the side to which the normal N points\n"
         "  near:X,Y,Z                         the nearest vertex\n"
         "  point:X,Y,Z                        for --fix and --handle: no vertex, but the\n"
         "                                     nearest point in a face, or in a tetrahedron\n"
         "  list:0,7,12  list:@FILE            numbers of vertices, from 0\n"
         "A coordinate N% goes from 0% to 100% of the bounding box; a length N% is of its\n"
         "diagonal. Cells are those of vertices, or with --cells elements of simplices all\n"
         "of whose corners are picked.\n\n"
      << described_options()
      << "\nBetween key frames the center of a handle moves along a straight line, its\n"
         "rotation turns at constant speed, and its stretch is interpolated linearly. This\n"
         "makes two key frames, a way through them, and a film of a body under gravity:\n\n"
         "  arap_deform cactus.off -o bent.off --fix z:..5% --handle z:90%.. \\\n"
         "    --rotate x 60 50%,50%,40% --save-transform bent.def\n"
         "  arap_deform cactus.off -o turned.off --fix z:..5% --handle z:90%.. \\\n"
         "    --rotate z 90 --save-transform turned.def\n"
         "  arap_deform cactus.off -o film.off --fix z:..5% --handle z:90%.. \\\n"
         "    --transform bent.def --transform turned.def --frames 24\n"
         "  arap_deform cactus.off -o hanging.off --fix z:..5% --gravity 1,0,0 \\\n"
         "    --modulus 20 --frames 60 --animation hanging.gif\n\n"
         "The report tells status, message, iterations, energy (initial, and after each),\n"
         "estimated_relative_gap to the minimum, the kind of end (minimum, flat, undecided,\n"
         "unknown), saddles_left, plateaus_left, edge_length_error (relative root mean\n"
         "square), area_change and volume_change (relative), largest_angle_change (degrees),\n"
         "largest_spike, inverted_simplices (tetrahedra), unconstrained_components (by their\n"
         "first vertex; nothing holds them, and they stay), seconds, and more.\n\n"
         "Exit status: 0 success, 1 failure, 2 wrong usage. If it is not 0, no output file\n"
         "is written, and existing files are unchanged.\n";
}

// what --color measures
inline Vertex_measure vertex_measure(const std::string& name)
{
  return chosen<Vertex_measure>("color", name,
                                {{"edge_error", Vertex_measure::edge_length_error},
                                 {"area", Vertex_measure::size_change},
                                 {"volume", Vertex_measure::size_change},
                                 {"angle", Vertex_measure::angle_change},
                                 {"spike", Vertex_measure::spike}});
}

// OUT with the number of a frame before its ending
inline std::string frame_file(const std::string& output, int frame)
{
  const std::filesystem::path path(output);
  return (path.parent_path() / (path.stem().string() + '-' + four_digits(frame) +
                                path.extension().string())).string();
}

// the meshes that are written
inline std::vector<std::string> mesh_files(const Command_line& line)
{
  if(!line.is_sequence)
    return {line.output};
  std::vector<std::string> files;
  for(int frame = 1; frame <= line.frames; ++frame)
    files.push_back(frame_file(line.output, frame));
  return files;
}

// Outputs must be different files and must not be inputs; only the mesh may be deformed in place.
inline void check_outputs(const Command_line& line)
{
  const auto check = [](const std::string& a, const std::string& b) {
    if(!a.empty() && !b.empty() && is_same_file(a, b))
      throw Usage_error("the file " + a + " is given for two things");
  };
  std::vector<std::string> outputs = mesh_files(line), inputs = line.transforms;
  inputs.push_back(line.selection);
  if(line.is_sequence)
    for(const std::string& output : outputs)
      check(output, line.mesh);
  for(const std::string& other : {line.report, line.image, line.animation, line.save_selection,
                                  line.save_transform})
  {
    check(other, line.mesh);
    for(const std::string& output : outputs)
      check(output, other);
    outputs.push_back(other);
  }
  for(const std::string& output : outputs)
    for(const std::string& input : inputs)
      check(output, input);
}

// Throws if --rotate or --stiffness has not enough values.
inline void check_several(const std::string& option, std::size_t values)
{
  if(values < 2)
    throw Usage_error(option == "rotate" ? "--rotate: expected AXIS ANGLE, such as z 90"
                                         : "--stiffness: expected WHAT K, such as z:..20% 10");
}

// Reads --rotate AXIS ANGLE [X,Y,Z] or --stiffness WHAT K as one option, however the next arguments
// look.
inline std::vector<boost::program_options::option>
parse_several(std::vector<std::string>& arguments)
{
  if(arguments.empty() || (arguments[0] != "--rotate" && arguments[0] != "--stiffness"))
    return {};
  const std::string name = arguments[0].substr(2);
  const bool has_center = name == "rotate" && arguments.size() > 3 &&
                          split(arguments[3]).size() == 3;
  const std::size_t n = (std::min)(arguments.size(), std::size_t(has_center ? 4 : 3));
  check_several(name, n - 1);
  boost::program_options::option result(
    name, std::vector<std::string>(arguments.begin() + 1, arguments.begin() + n));
  arguments.erase(arguments.begin(), arguments.begin() + n);
  return {result};
}

inline Motion_step rotation_step(const std::vector<std::string>& values)
{
  Motion_step step{true, {}};
  const std::string& axis = values[0];
  if(axis == "x" || axis == "y" || axis == "z")
    step.axis[axis[0] - 'x'] = 1;
  else if(split(axis).size() != 3)
    throw Usage_error("--rotate " + axis + ": the axis must be x, y, z or a vector X,Y,Z");
  else
  {
    const std::vector<double> v = numbers("--rotate", axis, "x,y,z");
    std::copy(v.begin(), v.end(), step.axis.begin());
    if(step.axis == std::array<double, 3>())
      throw Usage_error("--rotate: the axis 0,0,0 has no direction");
  }
  step.angle = numbers("--rotate", values[1], "angle")[0];
  if(values.size() > 2)
    step.place = measures("--rotate", values[2], "x,y,z");
  return step;
}

// A message of the library, with the names that options have here.
inline std::string with_options(const std::string& message)
{
  static const std::regex length("(the option )?(bending|smoothing)_length"),
    member("the option (\\w+)|(\\w+) of the dynamics");
  return std::regex_replace(std::regex_replace(message, length, "--$2"), member, "--$1$2");
}

inline Chosen_edge_weight chosen_weight(const std::string& name)
{
  try
  {
    return Chosen_edge_weight(name);
  }
  catch(const std::invalid_argument& error)
  {
    throw Usage_error(std::string("--") + error.what());
  }
}

inline Handle_options& handle_before(const std::string& option, Command_line& line)
{
  if(line.handles.empty() && line.selection.empty())
    throw Usage_error("--" + option + " is for the --handle before it, but there is none");
  return line.handles.empty() ? line.all_handles : line.handles.back();
}

// Reads the options that pick or move vertices, in their order.
inline void read_picks(const std::vector<boost::program_options::option>& given, Command_line& line)
{
  for(const auto& option : given)
  {
    const std::string& name = option.string_key;
    if(name == "turn")
    {
      if(handle_before(name, line).is_point)
        throw Usage_error("--turn: the handle is a point, which turns nothing around it");
      handle_before(name, line).is_frame = true;
    }
    if(option.value.empty())
      continue;
    if(name == "rotate" || name == "stiffness") // after = there is one value only
      check_several(name, option.value.size());
    if(const std::string& value = option.value[0]; name == "fix")
      line.picks.emplace_back(FIXED, Pick(name, value));
    else if(name == "region")
      line.region.emplace_back(name, value);
    else if(name == "rigid")
      line.rigid.emplace_back(name, value);
    else if(name == "stiffness")
    {
      line.stiff.emplace_back(name, value);
      line.stiffness.push_back(numbers("--stiffness", option.value[1], "k")[0]);
      if(line.stiffness.back() < 0)
        throw Usage_error("--stiffness " + option.value[1] + ": a stiffness is not negative");
    }
    else if(name == "handle")
    {
      line.picks.emplace_back(static_cast<int>(HANDLE + line.handles.size()), Pick(name, value));
      line.handles.emplace_back();
      line.handles.back().is_point = line.picks.back().second.is_point();
    }
    else if(name == "onto")
      handle_before(name, line).plane = Pick(name, value);
    else if(name == "move" || name == "rotate" || name == "soft")
    {
      Handle_options& handle = handle_before(name, line);
      if(name == "soft")
        handle.weight = numbers("--soft", value, "weight")[0];
      else
        handle.steps.push_back(name == "rotate" ? rotation_step(option.value)
                                                : Motion_step{false, measures("--move", value,
                                                                              "dx,dy,dz")});
      if(name == "soft" && *handle.weight < 0)
        throw Usage_error("--soft " + value + ": a weight is not negative");
    }
  }
}

// Throws if it is not said once what is held, and once how it moves.
inline void check_task(const Command_line& line)
{
  if(line.selection.empty() && line.handles.empty() && !line.dynamics)
    throw Usage_error("nothing moves: give a --handle, or a --selection");
  if(!line.selection.empty() && !line.handles.empty())
    throw Usage_error("--selection already tells the handles; leave out --handle");
  bool has_steps = false, has_planes = false;
  const auto look_at = [&](const Handle_options& handle) {
    has_steps = has_steps || !handle.steps.empty();
    has_planes = has_planes || handle.plane;
    if(handle.plane && !handle.weight)
      throw Usage_error(handle.plane->name() + ": only soft targets glide; give --soft, too");
  };
  look_at(line.all_handles);
  std::for_each(line.handles.begin(), line.handles.end(), look_at);
  if(has_steps && !line.transforms.empty())
    throw Usage_error("--transform already tells how handles move; leave out --move and --rotate");
  if(!has_steps && !has_planes && line.transforms.empty() && !line.dynamics)
    throw Usage_error("nothing moves: give --move, --rotate or --transform");
  for(const auto& pick : line.picks)
    if(pick.second.is_point() && !line.save_selection.empty())
      throw Usage_error("--save-selection: a selection has vertices only, not " +
                        pick.second.name());
}

// Reads the options of time steps.
inline std::optional<Dynamics> read_dynamics(const boost::program_options::variables_map& values)
{
  Dynamics dynamics;
  for(const auto& [name, member] : {std::pair("time_step", &Dynamics::time_step),
                                    std::pair("modulus", &Dynamics::modulus),
                                    std::pair("damping", &Dynamics::damping)})
    if(values.count(name) && !values[name].defaulted())
    {
      if(!values.count("gravity"))
        throw Usage_error("--" + std::string(name) + " is for time steps: give --gravity, too");
      dynamics.*member = number<double>(name, values[name].as<std::string>());
    }
  if(!values.count("gravity"))
    return std::nullopt;
  if(!values.count("frames") && values["animation"].defaulted())
    throw Usage_error("--gravity: give --frames, how many time steps there are, or --animation");
  const auto g = numbers("--gravity", values["gravity"].as<std::string>(), "x,y,z");
  dynamics.acceleration = {g[0], g[1], g[2]};
  if(const Outcome checked = dynamics.check(); !checked)
    throw Usage_error(with_options(checked.message));
  return dynamics;
}

// Reads --frames, --animation and --view.
inline void read_frames(const boost::program_options::variables_map& values, Command_line& line)
{
  const int keys = static_cast<int>((std::max)(line.transforms.size(), std::size_t(1)));
  line.frames = values.count("frames") ? number<int>("frames", values["frames"].as<std::string>())
                : line.animation.empty() ? keys : 24 * keys;
  line.is_sequence = values.count("frames") || (keys > 1 && line.animation.empty());
  if(line.frames < keys || line.frames > 9999)
    throw Usage_error("--frames " + std::to_string(line.frames) + ": there is at least one for "
                      "each --transform, and at most 9999");
  if(line.is_sequence && is_written_directly(line.output))
    throw Usage_error("--output " + line.output + ": frames need a file each");
  if(values.count("view"))
  {
    const std::string text = values["view"].as<std::string>();
    const bool is_direction = split(text).size() == 3;
    line.view = numbers("--view", text, is_direction ? "x,y,z" : "azimuth,elevation");
    if(is_direction && line.view == std::vector<double>(3, 0))
      throw Usage_error("--view 0,0,0 is no direction");
  }
}

// The arguments of the command, where the names of options may be written with - for _.
inline std::vector<std::string>
arguments_of(int argc, char** argv, const boost::program_options::options_description& all)
{
  std::vector<std::string> arguments(argv + (std::min)(argc, 1), argv + argc);
  for(std::string& argument : arguments)
  {
    if(argument == "--") // no options follow
      break;
    if(argument.rfind("--", 0) != 0 || argument[2] == '=')
      continue;
    const std::size_t length = (std::min)(argument.find('='), argument.size()) - 2;
    std::string name = argument.substr(2, length);
    std::replace(name.begin(), name.end(), '-', '_');
    if(all.find_nothrow(name, false))
      argument.replace(2, length, name);
  }
  return arguments;
}

inline Command_line parse_command_line(int argc, char** argv)
{
  namespace po = boost::program_options;
  po::options_description all = described_options();
  all.add_options()("mesh", po::value<std::string>()->required());
  po::variables_map values;
  try
  {
    const auto parsed = po::command_line_parser(arguments_of(argc, argv, all))
      .options(all)
      .positional(po::positional_options_description().add("mesh", 1))
      .extra_style_parser(parse_several)
      .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
      .run();
    po::store(parsed, values);
    Command_line line;
    line.is_help = values.count("help") > 0;
    line.is_version = values.count("version") > 0;
    if(line.is_help || line.is_version)
      return line;
    if(!values.count("mesh"))
      throw Usage_error("no mesh is given");
    po::notify(values);

    line.is_quiet = values.count("quiet") > 0;
    line.mesh = values["mesh"].as<std::string>();
    line.output = values["output"].as<std::string>();
    line.selection = values["selection"].as<std::string>();
    if(values.count("transform"))
      line.transforms = values["transform"].as<std::vector<std::string>>();
    for(const char* name : {"output", "selection", "report", "image", "animation", "color",
                            "save-selection", "save-transform"})
      if(!values[name].defaulted() && values[name].as<std::string>().empty())
        throw Usage_error("the value of --" + std::string(name) + " is empty");
    if(std::count(line.transforms.begin(), line.transforms.end(), std::string()) > 0)
      throw Usage_error("the value of --transform is empty");
    if(line.mesh.empty())
      throw Usage_error("the name of the mesh is empty");
    line.report = values["report"].as<std::string>();
    line.image = values["image"].as<std::string>();
    line.animation = values["animation"].as<std::string>();
    line.save_selection = values["save-selection"].as<std::string>();
    line.save_transform = values["save-transform"].as<std::string>();
    line.dynamics = read_dynamics(values);
    read_picks(parsed.options, line);
    check_task(line);
    line.has_quality = values.count("quality") > 0;
    line.color = values["color"].as<std::string>();
    if(!line.color.empty())
      vertex_measure(line.color);
    line.weights = chosen_weight(values["weights"].as<std::string>());
#ifndef CGAL_LINKED_WITH_PETSC
    if(const std::string name = values["solver"].as<std::string>(); name.rfind("petsc", 0) == 0)
      throw Usage_error("--solver " + name + ": this arap_deform was built without PETSc");
#endif
    line.solver = chosen<Solver_choice>(
      "solver", values["solver"].as<std::string>(),
      {{"default", Solver_choice::automatic},
       {"single_precision", Solver_choice::single_precision},
#ifdef CGAL_LINKED_WITH_CHOLMOD
       {"cholmod", Solver_choice::cholmod},
#endif
#ifdef CGAL_LINKED_WITH_PETSC
       {"petsc", Solver_choice::petsc},
       {"petsc_cg", Solver_choice::petsc_cg},
#endif
       {"eigen", Solver_choice::eigen}});
    line.rotation = chosen<Rotation_choice>(
      "rotation", values["rotation"].as<std::string>(),
      {{"newton", Rotation_choice::newton}, {"svd", Rotation_choice::svd}});
    const auto text = [&values](const char* option) { return values[option].as<std::string>(); };
    for(const char* name :
        {"cells", "minimizer", "initial_guess", "iterations", "threads", "tolerance",
          "verify_minimum", "coarse_metric"})
      if(const Outcome set = set_option(line.options, name, text(name)); !set)
        throw Usage_error((set.message.find(name) == 0 ? "--" : "") + set.message);
    line.options.bending_length = number<double>("bending", text("bending"));
    line.options.smoothing_length = number<double>("smoothing", text("smoothing"));
    if(const Outcome checked = line.options.check(); !checked)
      throw Usage_error(with_options(checked.message));
    if(!line.image.empty() && std::filesystem::path(line.image).extension() != ".png" &&
       !is_written_directly(line.image))
      throw Usage_error("--image " + line.image + ": the picture must be a .png file");
    read_frames(values, line);
    check_outputs(line);
    return line;
  }
  catch(const po::unknown_option& error)
  {
    // not what(): there Boost replaces placeholders such as %canonical_option% by the option, and
    // endlessly if that contains the placeholder itself
    throw Usage_error("the option '" + error.get_option_name() + "' is not known");
  }
  catch(const po::too_many_positional_options_error&)
  {
    throw Usage_error("more than one mesh is given, or more than one value for an option");
  }
  catch(const po::error& error)
  {
    throw Usage_error(error.what());
  }
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_COMMAND_LINE_H
