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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_OPTION_TEXT_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_OPTION_TEXT_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Status.h>

#include <charconv>
#include <initializer_list>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Value>
using Choices = std::initializer_list<std::pair<const char*, Value>>;

inline std::pair<const char*, Initial_guess> named(Initial_guess guess)
{
  return {to_string(guess), guess};
}

// Calls f with an option, and with what its values are called if they have names.
template <typename Options_, typename Function>
Outcome with_option(Options_& options, const std::string& name, const Function& f)
{
  if(name == "cells")
    return f(options.cells,
             Choices<Cell_scheme>{{"spokes", Cell_scheme::spokes()},
                                  {"spokes_and_rims", Cell_scheme::spokes_and_rims()},
                                  {"elements", Cell_scheme::elements()},
                                  {"k_ring:K", Cell_scheme::spokes()}});
  if(name == "minimizer")
    return f(options.minimizer, Choices<Minimizer>{{"automatic", Minimizer::automatic},
                                                   {"local_global", Minimizer::local_global},
                                                   {"quasi_newton", Minimizer::quasi_newton}});
  if(name == "initial_guess")
    return f(options.initial_guess,
             Choices<Initial_guess>{named(Initial_guess::automatic), named(Initial_guess::previous),
                                    named(Initial_guess::rotations),
                                    named(Initial_guess::laplacian)});
  if(name == "iterations")
    return f(options.iterations);
  if(name == "threads")
    return f(options.threads);
  if(name == "tolerance")
    return f(options.tolerance);
  if(name == "verify_minimum")
    return f(options.verify_minimum, Choices<bool>{{"true", true}, {"false", false}});
  if(name == "coarse_metric")
    return f(options.coarse_metric, Choices<bool>{{"true", true}, {"false", false}});
  if(name == "bending_length")
    return f(options.bending_length);
  if(name == "smoothing_length")
    return f(options.smoothing_length);
  return Outcome(Status::invalid_option,
                 "the option '" + name + "' is not known; use one of cells, minimizer, "
                 "initial_guess, iterations, threads, tolerance, verify_minimum, coarse_metric, "
                 "bending_length, smoothing_length");
}

// Reads a value, or tells which there are; Options::check() sees whether it is in its range.
struct Read_option
{
  const std::string& name;
  const std::string& text;

  template <typename Value>
  Outcome operator()(Value& value, Choices<Value> choices) const
  {
    const std::string ring = "k_ring:";
    if constexpr(std::is_same_v<Value, Cell_scheme>)
      if(text.compare(0, ring.size(), ring) == 0)
      {
        unsigned int k = 0;
        const std::string number = text.substr(ring.size());
        const Outcome outcome = Read_option{"cells k_ring", number}(k);
        if(outcome)
          value = Cell_scheme::k_ring(k);
        return outcome;
      }
    std::string names;
    for(const auto& choice : choices)
    {
      if(choice.first == text)
      {
        value = choice.second;
        return Outcome(Status::success, std::string());
      }
      names += (names.empty() ? "" : ", ") + std::string(choice.first);
    }
    return Outcome(Status::invalid_option,
                   name + " '" + text + "' is not known; use one of " + names);
  }

  Outcome operator()(unsigned int& value) const
  {
    unsigned int number = 0;
    const char* const end = text.data() + text.size();
    const auto [place, error] = std::from_chars(text.data(), end, number); // whatever the locale
    if(error != std::errc() || place != end)
      return Outcome(Status::invalid_option, name + " '" + text + "' is not a whole number from 0 "
                     "to " + std::to_string((std::numeric_limits<unsigned int>::max)()));
    value = number;
    return Outcome(Status::success, std::string());
  }

  Outcome operator()(double& value) const
  {
    std::istringstream in(text);
    in.imbue(std::locale::classic()); // the program may have another one, with a decimal comma
    double number = 0;
    if(!(in >> std::noskipws >> number) || in.peek() != std::istringstream::traits_type::eof())
      return Outcome(Status::invalid_option, name + " '" + text + "' is not a number");
    value = number;
    return Outcome(Status::success, std::string());
  }
};

// Writes a value as Read_option reads it.
struct Write_option
{
  std::string& text;

  template <typename Value>
  Outcome operator()(const Value& value, Choices<Value> choices) const
  {
    for(const auto& choice : choices)
      if(choice.second == value && text.empty())
        text = choice.first;
    if constexpr(std::is_same_v<Value, Cell_scheme>)
      if(value.rings() > 0)
        text = "k_ring:" + std::to_string(value.rings());
    return Outcome(Status::success, std::string());
  }

  template <typename Number>
  Outcome operator()(const Number& value) const
  {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(std::numeric_limits<Number>::max_digits10) << value; // all digits
    text = out.str();
    return Outcome(Status::success, std::string());
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_OPTION_TEXT_H
