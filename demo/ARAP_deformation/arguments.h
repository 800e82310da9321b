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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_ARGUMENTS_H
#define CGAL_ARAP_DEFORMATION_DEMO_ARGUMENTS_H

// The values of options: names, numbers, and lists of numbers.

#include <CGAL/Bbox_3.h>

#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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

// A number that may be a percentage of something in the mesh.
struct Measure
{
  double value = 0;
  bool is_percentage = false;

  // a coordinate: 0% and 100% are the ends of the bounding box
  double coordinate(const Bbox_3& box, int axis) const
  {
    const double share = value / 100;
    return is_percentage ? (1 - share) * box.min(axis) + share * box.max(axis) : value;
  }

  // a length: 100% is the diagonal of the bounding box
  double length(const Bbox_3& box) const
  {
    return is_percentage
             ? value / 100 * std::hypot(box.x_span(), box.y_span(), box.z_span()) : value;
  }
};

using Measures = std::vector<Measure>;

inline std::vector<std::string> split(const std::string& text, char separator = ',')
{
  std::vector<std::string> parts;
  for(std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1)
  {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

// The measures in a text, separated by commas. Throws if there are not as many as there are names.
inline Measures measures(const std::string& option, const std::string& text,
                         const std::string& names)
{
  const std::vector<std::string> parts = split(text);
  Measures result;
  for(std::string part : parts)
  {
    Measure measure;
    measure.is_percentage = !part.empty() && part.back() == '%';
    if(measure.is_percentage)
      part.pop_back();
    if(!boost::conversion::try_lexical_convert(part, measure.value) ||
       !std::isfinite(measure.value))
      throw Usage_error(option + ": '" + part + "' is not a finite number");
    result.push_back(measure);
  }
  if(parts.size() != split(names).size())
    throw Usage_error(option + ": expected the numbers " + names);
  return result;
}

// The same, without percentages.
inline std::vector<double> numbers(const std::string& option, const std::string& text,
                                   const std::string& names)
{
  std::vector<double> result;
  for(const Measure& measure : measures(option, text, names))
  {
    if(measure.is_percentage)
      throw Usage_error(option + ": a percentage makes no sense here");
    result.push_back(measure.value);
  }
  return result;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_ARGUMENTS_H
