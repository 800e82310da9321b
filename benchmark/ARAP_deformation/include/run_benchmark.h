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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_RUN_BENCHMARK_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_RUN_BENCHMARK_H

// Common to all benchmarks: the command line, the machine, the results file.

#include "measure.h"
#include "section.h"
#include "threads.h"

#include <CGAL/config.h>

#include <Eigen/Core>

#include <boost/config.hpp>
#include <boost/program_options.hpp>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <thread>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/version.h>
#endif

#ifdef CGAL_LINKED_WITH_CHOLMOD
#include <cholmod.h>
#endif

#ifndef ARAP_DEFORMATION_COMPILER_FLAGS // CMakeLists.txt defines it
#define ARAP_DEFORMATION_COMPILER_FLAGS "unknown"
#endif

namespace benchmark {

struct Settings
{
  bool quick = false;
  unsigned int repetitions = 7;
  unsigned int few_repetitions = 3; // of what takes long
  std::string mesh_file; // empty for the benchmark's own choice
  std::string json_file;

  // the file to read where the benchmark's own choice is this one of CGAL's
  std::string file_or(const std::string& name) const
  {
    return mesh_file.empty() ? CGAL::data_file_path("meshes/" + name) : mesh_file;
  }
};

inline std::string processor()
{
  std::ifstream cpuinfo("/proc/cpuinfo");
  for(std::string line; std::getline(cpuinfo, line);)
    if(line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown processor";
}

inline std::string eigen_version()
{
#ifdef EIGEN_VERSION_STRING // since Eigen 5
  return EIGEN_VERSION_STRING;
#else
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
#endif
}

inline std::string library_versions()
{
  std::string versions = std::string("CGAL ") + CGAL_VERSION_STR + ", Eigen " + eigen_version();
#ifdef CGAL_LINKED_WITH_TBB
  versions += ", TBB " + std::to_string(TBB_VERSION_MAJOR) + "." +
              std::to_string(TBB_VERSION_MINOR);
#else
  versions += ", without TBB";
#endif
#ifdef CGAL_LINKED_WITH_CHOLMOD
  versions += ", CHOLMOD " + std::to_string(CHOLMOD_MAIN_VERSION) + "." +
              std::to_string(CHOLMOD_SUB_VERSION);
#else
  versions += ", without CHOLMOD";
#endif
#ifdef CGAL_METIS_ENABLED
  versions += ", METIS";
#endif
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
  versions += ", libigl";
#endif
  return versions;
}

inline Json machine(const Settings& settings)
{
  return {{"quick", settings.quick},
          {"repetitions", settings.repetitions},
          {"mesh", settings.mesh_file},
          {"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"threads", number_of_threads()},
          {"compiler", BOOST_COMPILER},
          {"flags", ARAP_DEFORMATION_COMPILER_FLAGS},
          {"libraries", library_versions()}};
}

// What the results file has, if it is there: of one machine, with the same settings.
inline Json read_results(const Settings& settings)
{
  Json results;
  if(std::ifstream in(settings.json_file); in)
    results = Json::parse(in);
  if(results.contains("machine") && results["machine"] != machine(settings))
    throw Failure(settings.json_file + " has results of another machine, other libraries or other "
                  "settings: name another file, or remove it");
  return results;
}

// Replaces one section of the results file.
inline void write_section(const Settings& settings, const std::string& name, const Json& section)
{
  Json results = read_results(settings);
  results["machine"] = machine(settings);
  results[name] = section;
  std::ofstream out(settings.json_file);
  out << results.dump(1) << "\n";
  if(!out.flush())
    throw Failure("cannot write " + settings.json_file);
}

// Returns false if only help was asked for.
inline bool parse_command_line(int argc, char** argv, const std::string& usage,
                               const std::set<std::string>& further_options, Settings& settings)
{
  namespace po = boost::program_options;
  int repetitions = 0;
  po::options_description options("Options");
  options.add_options()
    ("quick", po::bool_switch(&settings.quick), "smaller meshes, fewer repetitions");
  if(further_options.count("repetitions"))
    options.add_options()
      ("repetitions", po::value(&repetitions)->value_name("N"),
       "number of timed runs of each kind, whose medians are printed; 7, where they take long or "
       "with --quick 3");
  if(further_options.count("mesh"))
    options.add_options()
      ("mesh", po::value(&settings.mesh_file)->value_name("FILE"), "another triangulated surface");
  options.add_options()
    ("json", po::value(&settings.json_file)->value_name("FILE"),
     "add the results to FILE, next to those of other benchmarks")
    ("help,h", "print this and exit");

  po::variables_map values;
  po::store(po::command_line_parser(argc, argv)
              .options(options)
              .positional(po::positional_options_description())
              .run(), values);
  po::notify(values);
  if(values.count("help"))
  {
    std::cout << usage << "\n\n" << options;
    return false;
  }
  if(values.count("repetitions") && repetitions < 1)
    throw po::error("--repetitions must be at least 1");
  if(repetitions > 0)
    settings.repetitions = settings.few_repetitions = static_cast<unsigned int>(repetitions);
  else if(settings.quick)
    settings.repetitions = settings.few_repetitions;
  return true;
}

// The main() of a benchmark: run(settings) returns its section, or throws. It takes the further
// options named.
template <typename Function>
int run_benchmark(int argc, char** argv, const std::string& name, const std::string& usage,
                  const Function& run,
                  const std::set<std::string>& further_options = {"mesh", "repetitions"})
{
  Settings settings;
  try
  {
    if(!parse_command_line(argc, argv, usage, further_options, settings))
      return EXIT_SUCCESS;
  }
  catch(const boost::program_options::error& error)
  {
    std::cerr << name << ": " << error.what() << "\n";
    return 2;
  }

  try
  {
#ifndef NDEBUG
    std::cout << "NOTICE: assertions are enabled: these are not the times of a release build\n";
#endif
    read_results(settings); // if they are of another machine, fails now rather than after the run
    const Json section = run(settings);
    print_text(std::cout, section);
    if(!settings.json_file.empty())
      write_section(settings, name, section);
  }
  catch(const std::exception& error)
  {
    std::cerr << name << ": " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_RUN_BENCHMARK_H
