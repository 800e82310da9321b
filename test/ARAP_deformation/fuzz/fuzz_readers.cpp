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

// Gives the readers of the command arap_deform whatever libFuzzer comes up with, as a file whose
// extension is the argument --format=EXTENSION; with --format=arguments, as arguments, one a line.
// A reader must return what the rest of the command can work with, or throw a std::runtime_error.
// script/fuzz builds it and runs it for each format.

#include "../../../demo/ARAP_deformation/Command_line.h"
#include "../../../demo/ARAP_deformation/Shape_file.h"
#include "../../../demo/ARAP_deformation/read_mesh.h"
#include "../../../demo/ARAP_deformation/shape_files.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace CGAL::ARAP::demo;

namespace {

std::string format;
fs::path folder;

// what libFuzzer takes for a finding
void require(bool condition, const char* what)
{
  if(condition)
    return;
  std::cerr << "required: " << what << std::endl;
  std::abort();
}

void read_arguments(const std::string& text)
{
  std::vector<std::string> arguments = {"arap_deform"};
  std::istringstream in(text);
  for(std::string line; std::getline(in, line);)
    arguments.push_back(line.substr(0, line.find('\0')));
  std::vector<char*> argv;
  for(std::string& argument : arguments)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  const Command_line line = parse_command_line(static_cast<int>(arguments.size()), argv.data());
  require(line.is_help || line.is_version ||
          (!line.mesh.empty() && !line.output.empty() && line.options.check()),
          "complete arguments");
}

void read(const std::string& file)
{
  if(format == "sel")
    read_selection(file, 4);
  else if(format == "def")
    read_transforms(file);
  else if(is_gltf_format('.' + format))
  {
    const Gltf_file gltf(file, "");
    require(gltf.mesh().is_valid(false), "a valid mesh");
    const std::string copy = (folder / ("out." + format)).string();
    Output_file out(copy);
    gltf.write(out, '.' + format, Skin());
    out.replace();
    out.keep();
    require(Gltf_file(copy, "").number_of_simplices() == gltf.number_of_simplices(),
            "the same faces if no point has moved");
  }
  else if(is_tetrahedra_format('.' + format))
  {
    const auto tetrahedra = read_tetrahedra(file);
    std::ostringstream out;
    tetrahedra->write(out, tetrahedra->mesh().points);
    const std::ifstream in = open_for_reading(file);
    std::ostringstream text;
    text << in.rdbuf();
    require(out.str() == text.str(), "the same text if no point has moved");
  }
  else
  {
    const Mesh mesh = read_mesh(file);
    require(mesh.is_valid(false), "a valid mesh");
    Output_file out((folder / ("out." + format)).string());
    write_mesh(out, mesh, "." + format);
    Source_text source = read_source(file);
    require(source.points.empty() || source.points.size() == mesh.number_of_vertices(),
            "a place for each point");
    std::ostringstream same;
    source.write(same);
    require(same.str() == source.text, "the same text if no point has moved");
  }
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  const std::string option = "--format=";
  for(int i = 1; i < *argc; ++i)
    if(const std::string argument = (*argv)[i]; argument.rfind(option, 0) == 0)
      format = argument.substr(option.size());
  require(!format.empty(), "an argument --format");
  const std::string unique = std::to_string(std::random_device()());
  folder = fs::temp_directory_path() / ("arap_deform_fuzz_" + unique);
  fs::create_directory(folder);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  try
  {
    if(format == "arguments")
    {
      read_arguments(text);
      return 0;
    }
    const std::string file = (folder / ("in." + format)).string();
    std::ofstream(file, std::ios::binary) << text;
    read(file);
  }
  catch(const std::runtime_error& error)
  {
    const std::string sentence = error.what();
    require(!sentence.empty() && sentence.find('\n') == std::string::npos, "one sentence");
  }
  return 0;
}
