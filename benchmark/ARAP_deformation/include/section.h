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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_SECTION_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_SECTION_H

// The results of a benchmark: a section of the results file, and its table.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

using Json = nlohmann::ordered_json;

// Columns are pairs of a key and a title. Rows are objects; keys without a column are numbers that
// the table does not show.
inline Json make_section(const std::string& title, const std::string& description,
                         const std::vector<std::pair<std::string, std::string>>& columns)
{
  return {{"title", title},
          {"description", description},
          {"columns", columns},
          {"rows", Json::array()}};
}

// three digits, and thousands separated: 0.0123, 4.56, 78.9, 26,002
inline std::string format_number(double value)
{
  if(!std::isfinite(value))
    return "-";
  char text[64];
  const double size = std::abs(value);
  if(size != 0 && size < 1e-3)
    std::snprintf(text, sizeof(text), "%.1e", value);
  else
  {
    int decimals = 0;
    for(double bound = 100; decimals < 5 && size < bound && size > 0; bound /= 10)
      ++decimals;
    std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  }
  std::string digits = text;
  if(size >= 999.5) // which is 1000 by now
    for(std::size_t k = digits.size(); k > 3; k -= 3)
      digits.insert(k - 3, ",");
  return digits;
}

inline std::string format_cell(const Json& row, const std::string& key)
{
  if(!row.contains(key) || row[key].is_null())
    return "-";
  const Json& value = row[key];
  if(value.is_string())
    return value.get<std::string>();
  if(value.is_number_integer() && std::abs(value.get<double>()) < 1e3)
    return std::to_string(value.get<int>());
  return format_number(value.get<double>());
}

// all cells of the table, with the titles as the first row
inline std::vector<std::vector<std::string>> format_cells(const Json& section)
{
  std::vector<std::vector<std::string>> lines(1);
  for(const Json& column : section["columns"])
    lines[0].push_back(column[1]);
  for(const Json& row : section["rows"])
  {
    lines.emplace_back();
    for(const Json& column : section["columns"])
      lines.back().push_back(format_cell(row, column[0]));
  }
  return lines;
}

inline void print_text(std::ostream& out, const Json& section)
{
  const auto lines = format_cells(section);
  std::vector<std::size_t> widths(lines[0].size());
  for(const auto& line : lines)
    for(std::size_t k = 0; k < line.size(); ++k)
      widths[k] = (std::max)(widths[k], line[k].size());
  out << "\n" << section["title"].get<std::string>() << "\n"
      << section["description"].get<std::string>() << "\n";
  for(const auto& line : lines)
  {
    for(std::size_t k = 0; k < line.size(); ++k)
      out << "  " << std::string(widths[k] - line[k].size(), ' ') << line[k];
    out << "\n";
  }
  out << std::flush;
}

// for the README, and for Doxygen
inline void print_markdown(std::ostream& out, const Json& section)
{
  const auto lines = format_cells(section);
  const auto print_line = [&out](const std::vector<std::string>& cells) {
    for(const std::string& cell : cells)
      out << "| " << cell << " ";
    out << "|\n";
  };
  print_line(lines[0]);
  for(std::size_t k = 0; k < lines[0].size(); ++k)
    out << "|---:";
  out << "|\n";
  std::for_each(lines.begin() + 1, lines.end(), print_line);
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_SECTION_H
