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

#ifndef CGAL_ARAP_DEFORMATION_SET_OPTION_H
#define CGAL_ARAP_DEFORMATION_SET_OPTION_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Status.h>

#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <initializer_list>
#include <string>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Finds the value with a name; else tells which names there are.
template <typename Value>
Outcome choose(const std::string& option, const std::string& name, Value& value,
               std::initializer_list<std::pair<const char*, Value>> choices)
{
  std::string names;
  for(const auto& choice : choices)
  {
    if(choice.first == name)
    {
      value = choice.second;
      return Outcome(Status::success, std::string());
    }
    names += (names.empty() ? "" : ", ") + std::string(choice.first);
  }
  return Outcome(Status::invalid_option,
                 option + " '" + name + "' is not known; use one of " + names);
}

inline Outcome read_count(const std::string& option, const std::string& text, unsigned int& value)
{
  int number = -1;
  if(!boost::conversion::try_lexical_convert(text, number) || number < 0)
    return Outcome(Status::invalid_option,
                   option + " '" + text + "' is not a whole number from 0 to 2147483647");
  value = static_cast<unsigned int>(number);
  return Outcome(Status::success, std::string());
}

inline Outcome read_number(const std::string& option, const std::string& text, double& value)
{
  if(!boost::conversion::try_lexical_convert(text, value))
    return Outcome(Status::invalid_option, option + " '" + text + "' is not a number");
  return Outcome(Status::success, std::string());
}

// Sets the option; Options::check() sees whether its value is in its range.
inline Outcome read_option(Options& options, const std::string& name, const std::string& value)
{
  if(name == "cells")
  {
    const std::string ring = "k_ring:";
    if(value.compare(0, ring.size(), ring) != 0)
      return choose<Cell_scheme>(name, value, options.cells,
                                 {{"spokes", Cell_scheme::spokes()},
                                  {"spokes_and_rims", Cell_scheme::spokes_and_rims()},
                                  {"elements", Cell_scheme::elements()},
                                  {"k_ring:K", Cell_scheme::spokes()}});
    unsigned int k = 0;
    const Outcome outcome = read_count("cells k_ring", value.substr(ring.size()), k);
    if(outcome)
      options.cells = Cell_scheme::k_ring(k);
    return outcome;
  }
  if(name == "minimizer")
    return choose<Minimizer>(name, value, options.minimizer,
                             {{"automatic", Minimizer::automatic},
                              {"local_global", Minimizer::local_global},
                              {"quasi_newton", Minimizer::quasi_newton}});
  if(name == "initial_guess")
    return choose<Initial_guess>(name, value, options.initial_guess,
                                 {{"automatic", Initial_guess::automatic},
                                  {"previous", Initial_guess::previous},
                                  {"rotations", Initial_guess::rotations},
                                  {"laplacian", Initial_guess::laplacian}});
  if(name == "iterations")
    return read_count(name, value, options.iterations);
  if(name == "threads")
    return read_count(name, value, options.threads);
  if(name == "tolerance")
    return read_number(name, value, options.tolerance);
  if(name == "verify_minimum")
    return choose(name, value, options.verify_minimum, {{"true", true}, {"false", false}});
  if(name == "bending_length")
    return read_number(name, value, options.bending_length);
  if(name == "smoothing_length")
    return read_number(name, value, options.smoothing_length);
  return Outcome(Status::invalid_option,
                 "the option '" + name + "' is not known; use one of cells, minimizer, "
                 "initial_guess, iterations, threads, tolerance, verify_minimum, bending_length, "
                 "smoothing_length");
}

} // namespace internal

/// \ingroup PkgARAPDeformationOptions
/// \brief sets an option that is given by its name and its value as text, for programs that read
/// options from a command line, a file or another language.
///
/// The names are those of the members of `Options` and of the enumerators; cells are `spokes`,
/// `spokes_and_rims`, `elements` or `k_ring:K`. Returns `Status::invalid_option`, with a message
/// that begins with the name and tells what is possible, and changes nothing, if there is no such
/// option or the value is not one of it.
inline Outcome set_option(Options& options, const std::string& name, const std::string& value)
{
  Options changed = options;
  Outcome outcome = internal::read_option(changed, name, value);
  if(outcome)
    outcome = changed.check();
  if(outcome)
    options = changed;
  return outcome;
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SET_OPTION_H
