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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_VERTEX_MAPS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_VERTEX_MAPS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename T>
constexpr bool is_range = is_valid<Begin_of, const T>;

template <typename Map, typename Vertex>
using Call_map = decltype(std::declval<const Map&>()(std::declval<Vertex>()));

// false only for property maps with other keys, whose get() is often declared for any key
template <typename Map, typename Vertex, typename = void>
struct Is_key : std::true_type {};

template <typename Map, typename Vertex>
struct Is_key<Map, Vertex, std::void_t<typename boost::property_traits<Map>::key_type>>
  : std::is_convertible<Vertex, typename boost::property_traits<Map>::key_type> {};

template <typename Map, typename Vertex>
using Call_get = std::enable_if_t<
  Is_key<Map, Vertex>::value,
  decltype(get(std::declval<const Map&>(), std::declval<Vertex>()))>;

template <typename Map, typename Vertex>
using Call_find = decltype(std::declval<const Map&>().find(std::declval<Vertex>())->second);

template <typename Map, typename Vertex>
using Call_at = decltype(std::declval<const Map&>().at(std::size_t()));

// Calls f(value) with the value of a vertex in a map: a function object, a property map, an
// associative container, where a vertex may have none, or a container by the index of the vertex.
template <typename Map, typename Vertex, typename Function>
void with_value(const Map& map, Vertex v, std::size_t index, const Function& f)
{
  if constexpr(is_valid<Call_map, Map, Vertex>)
    f(map(v));
  else if constexpr(is_valid<Call_get, Map, Vertex>)
    f(get(map, v));
  else if constexpr(is_valid<Call_find, Map, Vertex>)
  {
    if(const auto found = map.find(v); found != map.end())
      f(found->second);
  }
  else
  {
    static_assert(is_valid<Call_at, Map, Vertex>,
                  "a map of vertices must be a function object, a property map, a map, or a vector "
                  "by the indices of the vertices");
    f(map.at(index)); // throws std::out_of_range if it is too short
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_VERTEX_MAPS_H
