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

#include <CGAL/ARAP_deformation/Options.h>

#include <boost/lexical_cast.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <boost/program_options.hpp>

#include <filesystem>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// an error in the command line; the message names the option
struct Usage_error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

enum class Weight_choice { safe_cotangent, cotangent, clamped_cotangent, uniform };

struct Command_line
{
  bool is_help = false;
  bool is_quiet = false;
  std::string mesh, selection, transform, output; // files
  std::string report, image;                      // files, empty if not asked for
  Weight_choice weights = Weight_choice::safe_cotangent;
  Options options;
};

// the value with the given name
template <typename Value>
Value chosen(const std::string& option, const std::string& name,
             const std::vector<std::pair<std::string, Value>>& choices)
{
  std::string names;
  for(const auto& [choice, value] : choices)
  {
    if(choice == name)
      return value;
    names += (names.empty() ? "" : ", ") + choice;
  }
  throw Usage_error("--" + option + " '" + name + "' is not known; use one of " + names);
}

// the value of an option that is a number
template <typename Number>
Number number(const std::string& option, const std::string& text)
{
  Number value = 0;
  const bool is_number = boost::conversion::try_lexical_convert(text, value);
  if(std::is_integral_v<Number> && (!is_number || value < 0))
    throw Usage_error("--" + option + " '" + text + "' is not a whole number from 0 to " +
                      std::to_string((std::numeric_limits<Number>::max)()));
  if(!is_number)
    throw Usage_error("--" + option + " '" + text + "' is not a number");
  return value;
}

inline boost::program_options::options_description described_options()
{
  using boost::program_options::value;
  const Options defaults;
  boost::program_options::options_description input("Input and output"), run("The deformation"),
    other("Other");
  input.add_options()
    ("selection", value<std::string>()->value_name("S.sel")->required(),
     "one status per line and vertex: 0 fixed, 1 free, 2 handle; # starts a comment")
    ("transform", value<std::string>()->value_name("T.def")->required(),
     "4 x 4 affine matrix, row by row, applied to the handle vertices")
    ("output,o", value<std::string>()->value_name("OUT")->required(),
     "the deformed mesh: .mesh if MESH is a .mesh file, else .off, .obj, .ply or .stl")
    ("report", value<std::string>()->default_value("", "")->value_name("R.json"),
     "write a report as JSON")
    ("image", value<std::string>()->default_value("", "")->value_name("PICTURE.png"),
     "draw the shape (the boundary of a volume) before and after, fixed vertices red, handles "
     "yellow; needs the program povray");
  run.add_options()
    ("cells", value<std::string>()->default_value("spokes_and_rims")->value_name("NAME"),
     "which edges share a rotation: spokes, spokes_and_rims, elements")
    ("weights", value<std::string>()->default_value("safe_cotangent")->value_name("NAME"),
     "cotangent, clamped_cotangent, uniform, or safe_cotangent: clamped for spokes, unmodified "
     "for the other cells. With cotangent and spokes the energy can be negative and the shape "
     "distorted, especially with tetrahedra")
    ("minimizer", value<std::string>()->default_value("automatic")->value_name("NAME"),
     "local_global, the iteration of the paper; quasi_newton, which needs many times fewer "
     "iterations to the minimum; or automatic: quasi_newton unless the tolerance is 0")
    ("initial_guess", value<std::string>()->default_value("previous")->value_name("NAME"),
     "where to start: previous (the input with the handles moved), laplacian")
    ("iterations", value<std::string>()->default_value(std::to_string(defaults.iterations))
       ->value_name("N"), "run at most N iterations")
    ("tolerance", value<std::string>()->value_name("T")
       ->default_value(boost::lexical_cast<std::string>(defaults.tolerance)),
     "stop when the estimated relative gap of the energy to its minimum is at most T; 0: run all "
     "N iterations")
    ("threads", value<std::string>()->default_value(std::to_string(defaults.threads))
       ->value_name("N"),
     "use at most N threads; 0: one per processor. One if built without TBB. Does not change the "
     "result");
  other.add_options()
    ("quiet", "print only errors: no summary, no notes, no progress")
    ("help,h", "print this and exit");
  return input.add(run).add(other);
}

inline void print_help(std::ostream& out)
{
  out << "usage: arap_deform MESH --selection S.sel --transform T.def -o OUT [options]\n\n"
         "Deforms a surface or a volume as rigidly as possible: handle vertices are\n"
         "transformed, fixed vertices stay, and free vertices follow so that every small\n"
         "part of the shape only rotates (Sorkine and Alexa 2007).\n\n"
         "MESH is a surface of triangles or polygons in an .off, .obj, .ply or .stl file,\n"
         "or a volume of tetrahedra in a .mesh file (Medit, text). OUT is of the same kind.\n"
         "A pipe or a device whose name does not tell the format, such as /dev/stdout, gets\n"
         "the format of MESH.\n\n"
         "In a .mesh file only the coordinates change: references, comments and all\n"
         "sections are kept. For a surface, OUT has the points and the faces, and the\n"
         "colours of an .off file if OUT is an .off or .ply file. Everything else in MESH,\n"
         "such as normals, texture coordinates, materials and comments, is dropped; a note\n"
         "says what, except for comments. .ply and .stl files are written in binary.\n\n"
         "S.sel lists the vertices in the order of MESH (.stl: of their first appearance).\n"
         "Messages count them from 0. Free vertices without a face or tetrahedron stay\n"
         "where they are.\n\n"
      << described_options()
      << "\nThe report has the fields status, message, vertices, simplices (faces or\n"
         "tetrahedra), free_vertices, iterations, energy (one number for the initial guess\n"
         "and one after each iteration), estimated_relative_gap (to the minimum, null if\n"
         "unknown), edge_length_error (relative root mean square), inverted_simplices (the\n"
         "number of inverted tetrahedra; 0 for a surface), unconstrained_components (the\n"
         "first vertex of each component without a path of edges of non-zero weight to a\n"
         "fixed or handle vertex; these components stay where they are), seconds (load,\n"
         "preprocess, deform) and peak_memory_bytes.\n\n"
         "Exit status: 0 success, 1 failure, 2 wrong usage. If it is not 0, no output file\n"
         "is written, and existing files are unchanged. Outputs that are not regular\n"
         "files, such as pipes, are written to directly, /dev/stdout and the like as the\n"
         "shell has opened them. The summary goes to the standard output, or to the\n"
         "standard error if the standard output is OUT or PICTURE.png.\n";
}

// Outputs must be different files and must not be inputs; only the mesh may be deformed in place.
inline void check_outputs(const Command_line& line)
{
  const auto check = [](const std::string& a, const std::string& b) {
    if(!a.empty() && !b.empty() && is_same_file(a, b))
      throw Usage_error("the file " + a + " is given for two things");
  };
  for(const std::string& output : {line.output, line.report, line.image})
    for(const std::string& input : {line.selection, line.transform})
      check(output, input);
  check(line.report, line.mesh);
  check(line.image, line.mesh);
  check(line.output, line.report);
  check(line.output, line.image);
  check(line.report, line.image);
}

inline Command_line parse_command_line(int argc, char** argv)
{
  namespace po = boost::program_options;
  po::options_description all = described_options();
  all.add_options()("mesh", po::value<std::string>()->required());
  po::variables_map values;
  try
  {
    po::store(po::command_line_parser(argc, argv)
                .options(all)
                .positional(po::positional_options_description().add("mesh", 1))
                .style(po::command_line_style::default_style &
                       ~po::command_line_style::allow_guessing)
                .run(), values);
    Command_line line;
    line.is_help = values.count("help") > 0;
    if(line.is_help)
      return line;
    if(!values.count("mesh"))
      throw Usage_error("no mesh is given");
    po::notify(values);

    line.is_quiet = values.count("quiet") > 0;
    line.mesh = values["mesh"].as<std::string>();
    line.selection = values["selection"].as<std::string>();
    line.transform = values["transform"].as<std::string>();
    line.output = values["output"].as<std::string>();
    if(line.mesh.empty() || line.selection.empty() || line.transform.empty() || line.output.empty())
      throw Usage_error("the name of a file is empty");
    line.report = values["report"].as<std::string>();
    line.image = values["image"].as<std::string>();
    line.weights = chosen<Weight_choice>(
      "weights", values["weights"].as<std::string>(),
      {{"cotangent", Weight_choice::cotangent},
       {"clamped_cotangent", Weight_choice::clamped_cotangent},
       {"uniform", Weight_choice::uniform},
       {"safe_cotangent", Weight_choice::safe_cotangent}});
    line.options.cells = chosen<Cell_scheme>(
      "cells", values["cells"].as<std::string>(),
      {{"spokes", Cell_scheme::spokes()},
       {"spokes_and_rims", Cell_scheme::spokes_and_rims()},
       {"elements", Cell_scheme::elements()}});
    line.options.minimizer = chosen<Minimizer>(
      "minimizer", values["minimizer"].as<std::string>(),
      {{"automatic", Minimizer::automatic},
       {"local_global", Minimizer::local_global},
       {"quasi_newton", Minimizer::quasi_newton}});
    line.options.initial_guess = chosen<Initial_guess>(
      "initial_guess", values["initial_guess"].as<std::string>(),
      {{"previous", Initial_guess::previous}, {"laplacian", Initial_guess::laplacian}});
    const auto text = [&values](const char* option) { return values[option].as<std::string>(); };
    line.options.iterations = number<int>("iterations", text("iterations"));
    line.options.threads = number<int>("threads", text("threads"));
    line.options.tolerance = number<double>("tolerance", text("tolerance"));
    if(const Outcome checked = line.options.check(); !checked)
      throw Usage_error(checked.message);
    if(!line.image.empty() && std::filesystem::path(line.image).extension() != ".png" &&
       !is_written_directly(line.image))
      throw Usage_error("--image " + line.image + ": the picture must be a .png file");
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
    throw Usage_error("more than one mesh is given");
  }
  catch(const po::error& error)
  {
    throw Usage_error(error.what());
  }
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_COMMAND_LINE_H
