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
#include "command_help.h"

#include <CGAL/ARAP_deformation/Chosen_edge_weight.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/ARAP_deformation/set_option.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
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

// the other outputs that were asked for
inline std::vector<std::string> other_files(const Command_line& line)
{
  std::vector<std::string> files;
  for(const std::string& file : {line.report, line.image, line.animation, line.save_selection,
                                 line.save_transform})
    if(!file.empty())
      files.push_back(file);
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
  for(const auto& pick : line.picks)
    inputs.push_back(pick.second.file());
  for(const auto* picks : {&line.region, &line.rigid, &line.stiff})
    for(const Pick& pick : *picks)
      inputs.push_back(pick.file());
  std::set<std::filesystem::path> places; // of the frames; links may lead to the same file
  for(const std::string& output : outputs)
  {
    if(line.is_sequence)
      check(output, line.mesh);
    const std::filesystem::path place = internal::location(output);
    if(!place.empty() && !places.insert(place).second)
      throw Usage_error("the file " + output + " is given for two things");
  }
  for(const std::string& other : other_files(line))
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

// --move or -o, but not -1,0,0, -x.off, -1 and -
inline bool is_option(const std::string& argument)
{
  return argument.rfind("--", 0) == 0 ||
         (argument.size() == 2 && argument[0] == '-' &&
          std::isalpha(static_cast<unsigned char>(argument[1])) != 0);
}

// Reads --rotate AXIS ANGLE [X,Y,Z] or --stiffness WHAT K as one option, also if a value begins
// with -, such as -1,0,0.
inline std::vector<boost::program_options::option>
parse_several(std::vector<std::string>& arguments)
{
  if(arguments.empty())
    return {};
  for(const std::string option : {"rotate", "stiffness"}) // after = there is one value only
    if(arguments[0].rfind("--" + option + '=', 0) == 0)
      check_several(option, 1);
  if(arguments[0] != "--rotate" && arguments[0] != "--stiffness")
    return {};
  const std::string name = arguments[0].substr(2);
  const bool has_center = name == "rotate" && arguments.size() > 3 &&
                          split(arguments[3]).size() == 3;
  const std::size_t n = (std::min)(arguments.size(), std::size_t(has_center ? 4 : 3));
  const auto end = std::find_if(arguments.begin() + 1, arguments.begin() + n, is_option);
  boost::program_options::option result(name,
                                        std::vector<std::string>(arguments.begin() + 1, end));
  check_several(name, result.value.size());
  arguments.erase(arguments.begin(), end);
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
inline std::string with_options(std::string message)
{
  static const std::array<std::pair<std::regex, std::string>, 5> names = {{
    {std::regex("(the option )?(bending|smoothing)_length"), "--$2"},
    {std::regex("time_step, density, modulus and damping of the dynamics"),
     "--time_step, --modulus and --damping"},
    {std::regex("the option (\\w+)|(\\w+) of the dynamics"), "--$1$2"},
    {std::regex("erase one of these targets, .* or give it a finite weight"),
     "leave one of them out, or give a handle --soft"},
    {std::regex("give them finite weights"), "give them --soft"}}};
  for(const auto& [of_library, of_command] : names)
    message = std::regex_replace(message, of_library, of_command);
  return message;
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
    throw Usage_error("--selection already defines the handles; leave out --handle");
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
  if(line.selection.empty() && line.handles.empty() && !line.transforms.empty())
    throw Usage_error("--transform moves handles: give a --handle, or a --selection");
  if(!has_steps && !has_planes && line.transforms.empty() && !line.dynamics)
    throw Usage_error("nothing moves: give --move, --rotate or --transform");
  for(const auto& pick : line.picks)
    if(pick.second.is_point() && !line.save_selection.empty())
      throw Usage_error("--save-selection: a selection has vertices only, not " +
                        pick.second.name());
}

// the value of an option that has a single one
inline const std::string& value_of(const std::string& option,
                                   const boost::program_options::variables_map& values)
{
  return values[option].as<std::string>();
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
      dynamics.*member = number<double>(name, value_of(name, values));
    }
  if(!values.count("gravity"))
    return std::nullopt;
  if(!values.count("frames") && values["animation"].defaulted())
    throw Usage_error("--gravity: give --frames, how many time steps there are, or --animation");
  const auto g = numbers("--gravity", value_of("gravity", values), "x,y,z");
  dynamics.acceleration = {g[0], g[1], g[2]};
  if(const Outcome checked = dynamics.check(); !checked)
    throw Usage_error(with_options(checked.message));
  return dynamics;
}

// Reads --frames, --animation and --view.
inline void read_frames(const boost::program_options::variables_map& values, Command_line& line)
{
  const int keys = static_cast<int>((std::max)(line.transforms.size(), std::size_t(1)));
  line.frames = values.count("frames") ? number<int>("frames", value_of("frames", values))
                : line.animation.empty() ? keys : 24 * keys;
  line.is_sequence = values.count("frames") || (keys > 1 && line.animation.empty());
  if(line.frames < keys || line.frames > 9999)
    throw Usage_error(
      (values.count("frames") ? "--frames " + std::to_string(line.frames)
                              : std::to_string(keys) + " times --transform gives " +
                                std::to_string(line.frames) + " frames") +
      ": --frames is from " + std::to_string(keys) + " (one for each --transform) to 9999");
  if(line.is_sequence && is_written_directly(line.output))
    throw Usage_error("--output " + line.output + ": frames need a file each");
  if(values.count("view"))
  {
    const std::string text = value_of("view", values);
    const bool is_direction = split(text).size() == 3;
    line.view = numbers("--view", text, is_direction ? "x,y,z" : "azimuth,elevation");
    if(is_direction && line.view == std::vector<double>(3, 0))
      throw Usage_error("--view 0,0,0 is no direction");
    if(line.image.empty() &&
       (line.animation.empty() || is_gltf_format(lower_case_extension(line.animation))))
      throw Usage_error("--view is for pictures: give --image, or an --animation that is not glTF");
  }
}

// Reads the names of files.
inline void read_files(const boost::program_options::variables_map& values, Command_line& line)
{
  line.output = value_of("output", values);
  line.selection = value_of("selection", values);
  if(values.count("transform"))
    line.transforms = values["transform"].as<std::vector<std::string>>();
  for(const char* name : {"output", "selection", "report", "image", "animation", "color",
                          "save-selection", "save-transform"})
    if(!values[name].defaulted() && value_of(name, values).empty())
      throw Usage_error("the value of --" + std::string(name) + " is empty");
  if(std::count(line.transforms.begin(), line.transforms.end(), std::string()) > 0)
    throw Usage_error("the value of --transform is empty");
  if(line.mesh.empty())
    throw Usage_error("the name of the mesh is empty");
  line.report = value_of("report", values);
  line.image = value_of("image", values);
  line.animation = value_of("animation", values);
  line.save_selection = value_of("save-selection", values);
  line.save_transform = value_of("save-transform", values);
  if(!line.image.empty() && lower_case_extension(line.image) != ".png" &&
     !is_written_directly(line.image))
    throw Usage_error("--image " + line.image + ": the picture must be a .png file");
}

// Reads the models of the traits: weights, solver and rotation.
inline void read_models(const boost::program_options::variables_map& values, Command_line& line)
{
  line.weights = chosen_weight(value_of("weights", values));
#ifndef CGAL_LINKED_WITH_PETSC
  if(const std::string name = value_of("solver", values); name.rfind("petsc", 0) == 0)
    throw Usage_error("--solver " + name + ": this arap_deform was built without PETSc");
#endif
  line.solver = chosen<Solver_choice>(
    "solver", value_of("solver", values),
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
    "rotation", value_of("rotation", values),
    {{"newton", Rotation_choice::newton}, {"svd", Rotation_choice::svd}});
}

// Reads what are options of the library, too.
inline void read_options(const boost::program_options::variables_map& values, Options& options)
{
  std::map<std::string, std::string> named = {
    {"bending_length", value_of("bending", values)},
    {"smoothing_length", value_of("smoothing", values)}};
  for(const char* name :
      {"cells", "minimizer", "initial_guess", "iterations", "threads", "tolerance",
        "verify_minimum", "coarse_metric"})
    named[name] = value_of(name, values);
  if(const Outcome set = set_options(options, named); !set)
  {
    const std::string message = with_options(set.message);
    const bool begins_with_name = values.count(message.substr(0, message.find(' '))) > 0;
    throw Usage_error((begins_with_name ? "--" : "") + message);
  }
}

// The arguments of the command, where the names of options may be written with - for _, and with _
// for -. Throws if an option is in the place of a value, which Boost would take for it.
inline std::vector<std::string>
arguments_of(int argc, char** argv, const boost::program_options::options_description& all)
{
  std::vector<std::string> arguments(argv + (std::min)(argc, 1), argv + argc);
  for(std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) // no options follow
  {
    std::string& argument = arguments[i];
    if(!is_option(argument))
      continue;
    const bool is_long = argument.rfind("--", 0) == 0;
    if(is_long && argument[2] != '=')
    {
      const std::size_t length = (std::min)(argument.find('='), argument.size()) - 2;
      std::string name = argument.substr(2, length);
      for(const auto& [from, to] : {std::pair('-', '_'), std::pair('_', '-')})
      {
        std::replace(name.begin(), name.end(), from, to);
        if(all.find_nothrow(name, false))
          argument.replace(2, length, name);
      }
    }
    const auto* option = all.find_nothrow(is_long ? argument.substr(2) : argument, false);
    if(option && option->semantic()->min_tokens() > 0 &&
       (i + 1 == arguments.size() || is_option(arguments[i + 1])))
      throw Usage_error(argument + ": its value is missing");
  }
  return arguments;
}

inline Command_line parse_command_line(int argc, char** argv)
{
  namespace po = boost::program_options;
  po::options_description all = described_options();
  all.add_options()("mesh", po::value<std::vector<std::string>>());
  po::variables_map values;
  try
  {
    const auto parsed = po::command_line_parser(arguments_of(argc, argv, all))
      .options(all)
      .positional(po::positional_options_description().add("mesh", -1))
      .extra_style_parser(parse_several)
      .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
      .run();
    po::store(parsed, values);
    Command_line line;
    line.is_help = values.count("help") > 0;
    line.is_version = values.count("version") > 0;
    if(line.is_help || line.is_version)
      return line;
    const auto& meshes = values["mesh"];
    if(meshes.empty())
      throw Usage_error("no mesh is given");
    line.mesh = meshes.as<std::vector<std::string>>()[0];
    if(meshes.as<std::vector<std::string>>().size() > 1)
      throw Usage_error(in_quotes(meshes.as<std::vector<std::string>>()[1]) + " is a second mesh, "
                        "or a second value of an option that has one");
    po::notify(values);

    line.is_quiet = values.count("quiet") > 0;
    read_files(values, line);
    line.dynamics = read_dynamics(values);
    read_picks(parsed.options, line);
    check_task(line);
    line.has_quality = values.count("quality") > 0;
    line.color = value_of("color", values);
    if(!line.color.empty())
      vertex_measure(line.color);
    read_models(values, line);
    read_options(values, line.options);
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
  catch(const po::error& error)
  {
    throw Usage_error(error.what());
  }
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_COMMAND_LINE_H
