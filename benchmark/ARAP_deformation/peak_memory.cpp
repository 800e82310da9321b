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

// The peak memory of a process that deforms one mesh with one class: run it once for each of them.

#include "include/deformations.h"
#include "include/memory.h"
#include "include/run_benchmark.h"
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
#include "include/libigl_deformation.h"
#endif

#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <type_traits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace benchmark;

// deforms the mesh of the scenario itself, without a copy
template <typename Deformation, typename Preprocess>
void deform(Scenario& scenario, Deformation& deformation, const Preprocess& preprocess)
{
  insert_vertices(scenario, deformation);
  preprocess();
  restart(scenario, deformation);
  static_cast<void>(deformation.deform(5, 0)); // CGAL's class returns nothing: see below
  for(const auto& [v, target] : scenario.targets)
    if(scenario.mesh.point(v) != target)
      throw Failure("a control vertex is not at its target");
}

void deform_with(const std::string& name, Scenario& scenario)
{
  if(name == "ours" || name == "ours_single" || name == "ours_eigen")
  {
    const auto deform_by_traits = [&scenario](const auto& traits) {
      CGAL::ARAP_deformation<Mesh, std::decay_t<decltype(traits)>> deformation(scenario.mesh,
                                                                               traits);
      ARAP::Options options;
      options.cells = ARAP::Cell_scheme::spokes();
      expect_success(deformation.set_options(options));
      deform(scenario, deformation, [&] { expect_success(deformation.preprocess()); });
    };
    if(name == "ours")
      deform_by_traits(Default_traits());
    else if(name == "ours_single")
      deform_by_traits(CGAL::ARAP_deformation_traits<benchmark::Single_precision_solver,
                                                       Clamped_angle_weight>());
    else
      deform_by_traits(CGAL::ARAP_deformation_traits<ARAP::Eigen_LDLT_solver,
                                                       Clamped_angle_weight>());
  }
  else if(name == "cgal")
  {
    CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, CGAL::ORIGINAL_ARAP>
      deformation(scenario.mesh);
    deform(scenario, deformation, [&] {
      if(!deformation.preprocess())
        throw Failure("CGAL::Surface_mesh_deformation: preprocess() failed");
    });
  }
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
  else if(name == "libigl")
  {
    const Libigl_scenario copy = libigl_scenario(scenario);
    scenario.mesh.clear();
    Libigl_deformation deformation(copy, Libigl_energy::spokes);
    deformation.run(5);
  }
#endif
  else if(name != "mesh")
    throw Failure("there is no class " + name);
}

std::size_t number_of_parts(const std::string& text)
{
  std::size_t parts = 0;
  if(!boost::conversion::try_lexical_convert(text, parts) || parts < 1 || parts > 1000)
    throw Failure("PARTS is a number from 1 to 1000, not " + text);
  return parts;
}

} // namespace

int main(int argc, char** argv)
{
  if(argc < 3 || argc > 4)
  {
    std::cerr << "usage: peak_memory CLASS PARTS [MESH]\n"
                 "  CLASS  ours, ours_single (a factor in single precision), ours_eigen (Eigen's\n"
                 "         factor), cgal, libigl, or mesh, to read it only\n"
                 "  PARTS  the number of parts that each edge is cut into\n"
                 "Prints the number of vertices and the peak memory in megabytes, or nan if this\n"
                 "system does not tell it.\n";
    return 2;
  }
  try
  {
    Scenario scenario = make_scenario(
      subdivided(read_mesh(argc > 3 ? argv[3] : CGAL::data_file_path("meshes/armadillo.off")),
                 number_of_parts(argv[2])));
    const std::size_t n = scenario.number_of_vertices();
#ifdef __GLIBC__
    malloc_trim(0); // what reading the mesh has left
#endif
    const bool is_reset = reset_peak();
    deform_with(argv[1], scenario);
    std::cout << n << " " << (is_reset ? megabytes("VmHWM") : std::nan("")) << "\n";
  }
  catch(const std::exception& error)
  {
    std::cerr << "peak_memory: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
