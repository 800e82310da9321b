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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CHECK_STL_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_CHECK_STL_FILE_H

#include "Source_text.h"
#include "shape_files.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace CGAL::ARAP::demo {

namespace internal {

// The text with keywords in lower case, as CGAL's reader knows them, and without names, in which it
// would find some.
inline std::string plain_stl(const std::string& text)
{
  std::istringstream lines(text);
  std::string result;
  for(std::string line; std::getline(lines, line); result += line + '\n')
  {
    boost::algorithm::to_lower(line);
    Words words(line);
    const std::string_view first = words.next();
    const std::size_t begin = words.end(),
                      end = (std::min)(line.find("facet normal"), line.size());
    if((first == "solid" || first == "endsolid") && begin < end)
      line.replace(begin, end - begin, " ");
  }
  return result;
}

} // namespace internal

// The file as CGAL's reader of .stl files takes it for what it is, text or binary: where it errs,
// it appends the other reading to what it has. Throws a std::runtime_error if it is neither.
inline std::stringstream check_stl_file(std::istream& in, const std::string& file)
{
  std::string text(std::istreambuf_iterator<char>(in), {});
  const std::size_t head = 84;
  std::size_t triangles = 0; // of a binary file
  if(text.size() >= head)
    triangles = Source_text::number_of<std::uint32_t>(std::string_view(text).substr(head - 4),
                                                      Source_text::Numbers::little_endian);
  const double bytes = static_cast<double>(head) + 50.0 * static_cast<double>(triangles);
  if(static_cast<double>(text.size()) == bytes)
    text[0] = 'b'; // text starts with s
  else if(boost::algorithm::to_lower_copy(std::string(Words(text).next())) == "solid")
    text = internal::plain_stl(text) + std::string(head, ' '); // too long for an empty binary file
  else
    throw std::runtime_error(file + ": is neither text, which starts with 'solid', nor a whole "
                             "binary file: it " +
                             (static_cast<double>(text.size()) < bytes
                                ? "ends before the " : "has more than the ") +
                             "triangles that its header announces");
  return std::stringstream(text);
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHECK_STL_FILE_H
