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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_HELD_POINT_H
#define CGAL_ARAP_DEFORMATION_DEMO_HELD_POINT_H

#include "Command_line.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation/locate.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// A point inside a simplex that is picked, with its status and its option.
template <typename Domain>
struct Held_point
{
  int status;
  std::string name;
  Location<typename Domain::simplex_descriptor> location;
};

template <typename Domain>
std::vector<Held_point<Domain>> held_points(const Command_line& line, const Domain& domain,
                                            const std::vector<Kernel::Point_3>& points)
{
  std::vector<Held_point<Domain>> held;
  std::optional<Locator<Domain>> locator;
  for(const auto& [status, pick] : line.picks)
    if(pick.is_point())
    {
      if(!locator)
        locator.emplace(domain);
      const auto location = locator->locate(pick.point(points));
      if(!location)
        throw std::runtime_error(pick.name() + ": no place for it was found in the mesh");
      held.push_back({status, pick.name(), *location});
    }
  return held;
}

// Replaces the number of a control point in a message of the library by its option.
template <typename Domain>
std::string with_names(std::string message, const std::vector<Held_point<Domain>>& held)
{
  for(std::size_t k = held.size(); k > 0; --k) // 12 before 1
  {
    const std::string number = "control point " + std::to_string(k);
    if(const std::size_t place = message.find(number); place != std::string::npos)
      return message.replace(place, number.size(), held[k - 1].name);
  }
  return message;
}

// with their places
template <typename Domain>
std::vector<std::pair<int, Kernel::Point_3>> places(const std::vector<Held_point<Domain>>& held,
                                                    const Domain& domain)
{
  std::vector<std::pair<int, Kernel::Point_3>> result;
  for(const auto& point : held)
    result.emplace_back(point.status, construct_point(domain, point.location));
  return result;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_HELD_POINT_H
