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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_ZLIB_BLOCKS_H
#define CGAL_ARAP_DEFORMATION_DEMO_ZLIB_BLOCKS_H

// Bytes in blocks that are compressed one by one, as VTK does it.

#ifdef CGAL_ARAP_DEMO_WITH_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

using Blocks = std::pair<std::string, std::vector<std::size_t>>; // all together, and their sizes

#ifdef CGAL_ARAP_DEMO_WITH_ZLIB

constexpr bool has_zlib = true;

// Uncompresses blocks, the last of which may have another size; none if they are damaged.
inline std::optional<std::string> uncompressed(const Blocks& blocks, std::size_t block_size,
                                               std::size_t last_size)
{
  const std::size_t largest_ratio = 1032; // of zlib: more is a lie
  std::string result;
  const char* place = blocks.first.data();
  for(std::size_t k = 0; k < blocks.second.size(); ++k)
  {
    const std::size_t before = blocks.second[k];
    const std::size_t size = k + 1 == blocks.second.size() && last_size > 0 ? last_size
                                                                            : block_size;
    if(size / largest_ratio > before)
      return std::nullopt;
    std::string block(size, '\0');
    uLongf after = static_cast<uLongf>(size);
    if(uncompress(reinterpret_cast<Bytef*>(block.data()), &after,
                  reinterpret_cast<const Bytef*>(place), static_cast<uLong>(before)) != Z_OK ||
       after != size)
      return std::nullopt;
    result += block;
    place += before;
  }
  return result;
}

inline Blocks compressed(const std::string& bytes, std::size_t block_size)
{
  Blocks result;
  for(std::size_t begin = 0; begin < bytes.size(); begin += block_size)
  {
    const auto size = static_cast<uLong>((std::min)(block_size, bytes.size() - begin));
    uLongf after = compressBound(size);
    std::string block(after, '\0');
    compress(reinterpret_cast<Bytef*>(block.data()), &after,
             reinterpret_cast<const Bytef*>(bytes.data() + begin), size);
    result.first.append(block, 0, after);
    result.second.push_back(after);
  }
  return result;
}

#else

constexpr bool has_zlib = false;

inline std::optional<std::string> uncompressed(const Blocks&, std::size_t, std::size_t)
{
  return std::nullopt;
}

inline Blocks compressed(const std::string&, std::size_t) { return {}; }

#endif

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_ZLIB_BLOCKS_H
