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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_BASE64_H
#define CGAL_ARAP_DEFORMATION_DEMO_BASE64_H

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/dataflow_exception.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace CGAL::ARAP::demo {

// how many characters stand for this many bytes
inline std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

inline std::string to_base64(const std::string& bytes)
{
  using namespace boost::archive::iterators;
  using Encoded = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string result(Encoded(bytes.begin()), Encoded(bytes.end()));
  result.resize(base64_size(bytes.size()), '=');
  return result;
}

// none if the text is not in base64
inline std::optional<std::string> from_base64(std::string text)
{
  using namespace boost::archive::iterators;
  using Decoded = transform_width<binary_from_base64<std::string::const_iterator>, 8, 6>;
  while(!text.empty() && text.back() == '=')
    text.pop_back();
  const std::size_t size = text.size() * 6 / 8;
  text.resize((text.size() + 3) / 4 * 4, 'A');
  try
  {
    std::string result(Decoded(text.begin()), Decoded(text.end()));
    result.resize((std::min)(size, result.size()));
    return result;
  }
  catch(const dataflow_exception&)
  {
    return std::nullopt;
  }
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_BASE64_H
