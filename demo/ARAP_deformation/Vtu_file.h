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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_VTU_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_VTU_FILE_H

#include "Tetrahedra_text.h"
#include "Unwritable.h"
#include "Vtk_file.h"
#include "base64.h"
#include "zlib_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// Tetrahedra in .vtu files: unstructured grids in VTK's XML format. Arrays are text, base64 or raw,
// in place or appended, also compressed by zlib. All but the coordinates is kept as it is.
class Vtu_file : public Tetrahedra_text
{
public:
  explicit Vtu_file(const std::string& file) : Tetrahedra_text(file)
  {
    if(text().rfind("</VTKFile>") == std::string::npos)
      refuse("ends before </VTKFile>");
    read_tags();
    if(!m_has_piece)
      refuse("has no UnstructuredGrid with a Piece");
    const Array& points = array("Points", "");
    if(points.get("NumberOfComponents") != "3")
      refuse_at(points.place, "the Points need NumberOfComponents=\"3\"");
    if(const std::string type = points.get("type"); type != "Float32" && type != "Float64")
      refuse_at(points.place, "the Points are " + in_quotes(type) + ", not Float32 or Float64");
    else
      m_source.are_points_single = type == "Float32";
    if(points.format() == "ascii")
      read_text_of(points);
    else
      read_bytes_of(points);
    read_cells();
  }

  void write(std::ostream& out, const std::vector<Kernel::Point_3>& points) override
  {
    if(!m_encoded_points)
      return Tetrahedra_text::write(out, points);
    replace_ranges(points);
    Encoded& encoded = *m_encoded_points;
    std::string bytes = encoded.bytes;
    const std::size_t size = encoded.bytes.size() / (3 * points.size());
    for(std::size_t v = 0; v < points.size(); ++v)
      for(int k = 0; k < 3; ++k)
        if(const double x = points[v][k]; x != m_mesh.points[v][k])
          bytes.replace(size * (3 * v + k), size,
                        size == 4 ? Source_text::bytes_of(to_float(x), m_order)
                                  : Source_text::bytes_of(x, m_order));
    if(bytes != encoded.bytes)
      replace(encoded, bytes);
    m_source.write(out);
  }

private:
  using Span = Source_text::Span;
  using Attributes = std::map<std::string, Span>;

  // a DataArray, or an Array of strings: its attributes, and its contents, which may be elsewhere
  struct Array
  {
    const std::string& text;
    Attributes attributes;
    std::size_t place, begin, end; // where it is, and its contents
    std::string parent;

    std::string get(const std::string& name) const
    {
      const auto found = attributes.find(name);
      return found == attributes.end() ? std::string() : part(text, found->second);
    }

    // as VTK takes it where it is not said
    std::string format() const
    {
      return attributes.count("format") > 0   ? get("format")
             : attributes.count("offset") > 0 ? "appended"
                                              : "ascii";
    }

    std::string name() const { return "the array " + (parent == "Points" ? parent : get("Name")); }
  };

  // bytes of an array, and where they are encoded
  struct Encoded
  {
    std::string bytes;
    Span span;
    bool is_raw = false;
    std::size_t block_size = 0; // before compression
    std::optional<std::size_t> offset; // in what is appended
  };

  static std::string part(const std::string& text, const Span& span)
  {
    return text.substr(span.begin, span.end - span.begin);
  }

  [[noreturn]] void refuse_at(std::size_t place, const std::string& sentence) const
  {
    const auto line = std::count(text().begin(), text().begin() + place, '\n');
    throw bad_line(m_name, static_cast<std::size_t>(1 + line), sentence);
  }

  // Reads the tags up to what is appended, which may be raw and is no XML then.
  void read_tags()
  {
    std::string parent, key;
    for(std::size_t place = 0; (place = text().find('<', place)) != std::string::npos;)
    {
      const std::size_t start = place;
      const auto skip_to = [&](const std::string& end) { // returns whether it is there
        const std::size_t found = text().find(end, place);
        if(found == std::string::npos)
          refuse_at(start, "a tag has no end");
        place = found + end.size();
      };
      if(text().compare(place, 4, "<!--") == 0 || text().compare(place, 2, "<?") == 0)
      {
        skip_to(text()[place + 1] == '?' ? "?>" : "-->");
        continue;
      }
      if(text().compare(place, 2, "</") == 0)
      {
        if(const std::string name = "</" + parent; text().compare(place, name.size(), name) == 0)
          parent.clear();
        skip_to(">");
        continue;
      }
      const auto [name, attributes] = read_tag(place);
      const std::size_t end = (std::min)(text().find('<', place), text().size());
      const Array array = {text(), attributes, start, place, end, parent};
      if(name == "VTKFile")
        read_head(array);
      else if(name == "Piece" && std::exchange(m_has_piece, true))
        refuse_at(start, "only one Piece can be read, but this is another one");
      else if(name == "Piece")
        m_piece = {array.get("NumberOfPoints"), array.get("NumberOfCells")};
      else if(name == "Points" || name == "Cells")
        parent = name;
      else if(name == "DataArray" || name == "Array")
      {
        m_arrays.push_back(array);
        for(const auto& [end_of_range, is_largest] :
            {std::pair("RangeMin", false), std::pair("RangeMax", true)})
          if(const auto found = attributes.find(end_of_range);
             found != attributes.end() && parent == "Points")
            m_ends_of_ranges.push_back({found->second, is_largest});
      }
      else if(name == "InformationKey")
        key = array.get("name");
      else if(name == "Value" && parent == "Points" && is_range(key))
        m_ends_of_ranges.push_back({Span{place, end}, array.get("index") != "0"});
      else if(name == "AppendedData")
      {
        m_is_appended_raw = array.get("encoding") == "raw";
        m_appended = text().find('_', place) + 1; // 0 if it is not there
        return;
      }
    }
  }

  // Reads the name and the attributes of a tag, up to its end.
  std::pair<std::string, Attributes> read_tag(std::size_t& place) const
  {
    const std::size_t start = place;
    const auto span_to = [&](const char* ends) {
      const std::size_t end = text().find_first_of(ends, place);
      if(end == std::string::npos)
        refuse_at(start, "a tag has no end");
      return Span{std::exchange(place, end), end};
    };
    ++place;
    const std::string name = part(text(), span_to(" \t\r\n/>"));
    Attributes attributes;
    while(true)
    {
      place = (std::min)(text().find_first_not_of(" \t\r\n/", place), text().size());
      if(place == text().size() || text()[place] == '>')
        break;
      const Span key = span_to("= \t\r\n>");
      span_to("\"'>");
      if(text()[place] == '>')
        refuse_at(start, "an attribute of the tag " + in_quotes(name) + " has no value");
      const char quote[] = {text()[place++], '\0'};
      attributes[part(text(), key)] = span_to(quote);
      ++place;
    }
    if(place == text().size())
      refuse_at(start, "a tag has no end");
    ++place;
    return {name, attributes};
  }

  void read_head(const Array& file)
  {
    const auto require = [&](const std::string& name, const std::string& missing,
                             const std::vector<std::string>& known) {
      const std::string value = file.get(name);
      if(!value.empty() && std::find(known.begin(), known.end(), value) == known.end())
        refuse_at(file.place, name + "=" + in_quotes(value) + " cannot be read, only " + known[0] +
                                (known.size() > 1 ? " and " + known[1] : ""));
      return value.empty() ? missing : value;
    };
    require("type", "", {"UnstructuredGrid"});
    const std::string order = require("byte_order", "LittleEndian", {"LittleEndian", "BigEndian"});
    m_order = order == "BigEndian" ? Source_text::Numbers::big_endian
                                   : Source_text::Numbers::little_endian;
    m_header = require("header_type", "UInt32", {"UInt32", "UInt64"}) == "UInt32" ? 4 : 8;
    m_is_compressed = !require("compressor", "", {"vtkZLibDataCompressor"}).empty();
    if(m_is_compressed && !has_zlib)
      refuse_at(file.place, "is compressed, but arap_deform was built without zlib");
  }

  const Array& array(const std::string& parent, const std::string& name) const
  {
    for(const Array& array : m_arrays)
      if(array.parent == parent && (name.empty() || array.get("Name") == name))
        return array;
    refuse("has no DataArray " + (name.empty() ? "" : name + ' ') + "in its " + parent);
  }

  long long count(const std::string& word) const
  {
    long long value = -1;
    if(!boost::conversion::try_lexical_convert(word, value) || value < 0 ||
       value > (std::numeric_limits<int>::max)())
      refuse("the Piece has no readable NumberOfPoints or NumberOfCells: " +
             in_quotes(word));
    return value;
  }

  // A number of the type that counts bytes.
  std::size_t header_word(std::string_view bytes) const
  {
    return m_header == 4 ? Source_text::number_of<std::uint32_t>(bytes, m_order)
                         : static_cast<std::size_t>(
                             Source_text::number_of<std::uint64_t>(bytes, m_order));
  }

  std::string header_bytes(std::size_t word) const
  {
    return m_header == 4 ? Source_text::bytes_of(static_cast<std::uint32_t>(word), m_order)
                         : Source_text::bytes_of(static_cast<std::uint64_t>(word), m_order);
  }

  static std::size_t encoded_size(std::size_t bytes, bool is_raw)
  {
    return is_raw ? bytes : base64_size(bytes);
  }

  static std::string encoded(const std::string& bytes, bool is_raw)
  {
    return is_raw ? bytes : to_base64(bytes);
  }

  // Decodes the bytes of an array that is no text.
  Encoded decode(const Array& array) const
  {
    Encoded result;
    std::size_t begin = (std::min)(text().find_first_not_of(" \t\r\n", array.begin), array.end);
    std::size_t end = array.end;
    if(array.format() == "appended")
    {
      std::size_t offset = 0;
      if(m_appended == 0 || array.get("offset")[0] == '-' ||
         !boost::conversion::try_lexical_convert(array.get("offset"), offset) ||
         offset > text().size() - m_appended)
        refuse_at(array.place, array.name() + " is appended, but its offset is wrong");
      result.offset = offset;
      result.is_raw = m_is_appended_raw;
      begin = m_appended + offset;
      end = text().size();
    }
    else if(array.format() != "binary")
      refuse_at(array.place, array.name() + " has the format " + in_quotes(array.format()) +
                               ", which is neither ascii, binary nor appended");
    std::size_t place = begin;
    const auto take = [&](std::size_t n) { // decodes n bytes, and ends after them
      if(n > end - place || encoded_size(n, result.is_raw) > end - place)
        refuse_at(array.place, array.name() + " is shorter than it announces");
      const Span span = {place, place + encoded_size(n, result.is_raw)};
      place = span.end;
      const std::string bytes = part(text(), span);
      const auto decoded = result.is_raw ? std::optional(bytes) : from_base64(bytes);
      if(!decoded)
        refuse_at(array.place, array.name() + " is not in base64");
      return decoded->substr(0, n);
    };
    const auto again = [&](std::size_t n) { // decodes from the start
      place = begin;
      return take(n);
    };
    const std::size_t first = header_word(take(m_header));
    if(!m_is_compressed)
      result.bytes = again(first > end - begin ? end - begin + 1 : m_header + first)
                       .substr(m_header);
    else if(first > 0)
    {
      if(first > (end - begin) / m_header)
        refuse_at(array.place, array.name() + " is shorter than it announces");
      const std::string head = again(m_header * (3 + first));
      const auto word = [&](std::size_t k) {
        return header_word(std::string_view(head).substr(m_header * k));
      };
      std::vector<std::size_t> sizes;
      for(std::size_t k = 0; k < first; ++k)
        sizes.push_back(word(3 + k));
      std::size_t sum = 0;
      for(std::size_t size : sizes)
        sum += (std::min)(size, text().size());
      result.block_size = word(1);
      const auto bytes = uncompressed({take(sum), sizes}, word(1), word(2));
      if(!bytes || result.block_size == 0)
        refuse_at(array.place, array.name() + " cannot be uncompressed");
      result.bytes = *bytes;
    }
    result.span = {begin, place};
    return result;
  }

  // Replaces the bytes of an array, which has not changed its length before compression.
  void replace(const Encoded& array, const std::string& bytes)
  {
    std::string text;
    if(m_is_compressed)
    {
      const auto [data, sizes] = compressed(bytes, array.block_size);
      std::string head = header_bytes(sizes.size()) + header_bytes(array.block_size) +
                         header_bytes(bytes.size() % array.block_size);
      for(std::size_t size : sizes)
        head += header_bytes(size);
      text = encoded(head, array.is_raw) + encoded(data, array.is_raw);
    }
    else
      text = encoded(header_bytes(bytes.size()) + bytes, array.is_raw);
    m_source.replace(array.span, text);
    const std::size_t before = array.span.end - array.span.begin;
    for(const Array& other : m_arrays) // what is appended behind it moves
      if(std::size_t offset = 0; array.offset && text.size() != before &&
         boost::conversion::try_lexical_convert(other.get("offset"), offset) &&
         offset > *array.offset)
        m_source.replace(other.attributes.at("offset"),
                         std::to_string(offset + text.size() - before));
  }

  std::size_t number_of_points() const { return static_cast<std::size_t>(count(m_piece.first)); }

  // the words of an array that is text
  Words words_of(const Array& array) const
  {
    return Words(std::string_view(text()).substr(0, array.end), array.begin);
  }

  void read_text_of(const Array& points)
  {
    Words words = words_of(points);
    const std::size_t n = number_of_points();
    for(std::size_t v = 0; v < n; ++v)
      read_point(words, [v] { return "point " + std::to_string(v); });
    if(!words.next().empty())
      refuse(words, "expected " + std::to_string(n) + " Points, but after them there is");
  }

  void read_bytes_of(const Array& points)
  {
    m_encoded_points = decode(points);
    const std::size_t n = number_of_points(), size = points.get("type") == "Float32" ? 4 : 8;
    std::string_view bytes = m_encoded_points->bytes;
    if(bytes.size() != 3 * size * n)
      refuse_at(points.place, "there are " + std::to_string(n) + " points, but the array has " +
                                std::to_string(bytes.size()) + " bytes");
    for(std::size_t v = 0; v < n; ++v)
    {
      std::array<double, 3> p;
      for(double& x : p)
      {
        x = size == 4 ? Source_text::number_of<float>(bytes, m_order)
                      : Source_text::number_of<double>(bytes, m_order);
        bytes.remove_prefix(size);
        if(!std::isfinite(x))
          refuse_at(points.place, "point " + std::to_string(v) + " has a coordinate that is "
                                  "infinite or not a number");
      }
      m_mesh.points.emplace_back(p[0], p[1], p[2]);
    }
  }

  template <typename Integer>
  std::vector<long long> integers_of(const std::string& bytes) const
  {
    std::vector<long long> result;
    for(std::string_view rest = bytes; rest.size() >= sizeof(Integer);
        rest.remove_prefix(sizeof(Integer)))
      result.push_back(static_cast<long long>(Source_text::number_of<Integer>(rest, m_order)));
    return result;
  }

  std::vector<long long> integers(const std::string& name) const
  {
    const Array& found = array("Cells", name);
    if(found.format() == "ascii")
    {
      std::vector<long long> result;
      for(Words words = words_of(found), look = words; !look.next().empty(); look = words)
        result.push_back(read_integer(words, 0, (std::numeric_limits<int>::max)(), [&] {
          return "an integer from 0, in " + found.name();
        }));
      return result;
    }
    const std::string type = found.get("type"), bytes = decode(found).bytes;
    if(type == "Int8" || type == "UInt8")
      return integers_of<unsigned char>(bytes);
    if(type == "Int16" || type == "UInt16")
      return integers_of<std::uint16_t>(bytes);
    if(type == "Int32" || type == "UInt32")
      return integers_of<std::uint32_t>(bytes);
    if(type == "Int64" || type == "UInt64")
      return integers_of<std::int64_t>(bytes);
    refuse_at(found.place, found.name() + " has the type " + in_quotes(type) +
                             ", which is not one of integers");
  }

  void read_cells()
  {
    const std::vector<long long> corners = integers("connectivity"), ends = integers("offsets"),
                                 types = integers("types");
    const auto cells = static_cast<std::size_t>(count(m_piece.second));
    if(ends.size() != cells || types.size() != cells)
      refuse("there are " + std::to_string(cells) + " cells, but " + std::to_string(ends.size()) +
             " offsets and " + std::to_string(types.size()) + " types");
    long long begin = 0;
    for(std::size_t i = 0; i < cells; begin = ends[i++])
    {
      const auto refuse_cell = [&](const std::string& what) {
        refuse("the cell " + std::to_string(i) + ' ' + what);
      };
      if(ends[i] < begin || ends[i] > static_cast<long long>(corners.size()))
        refuse_cell("ends at " + std::to_string(ends[i]) + ", which is not from " +
                    std::to_string(begin) + " to " + std::to_string(corners.size()));
      const long long size = ends[i] - begin;
      if(types[i] == vtk_tetrahedron ? size != 4 : !is_flat_vtk_cell(types[i]))
        refuse_cell("has the type " + std::to_string(types[i]) + " and " + std::to_string(size) +
                    " vertices; only tetrahedra with four vertices can be deformed");
      std::array<int, 4> vertices = {};
      for(long long k = 0; k < size; ++k)
      {
        const long long v = corners[static_cast<std::size_t>(begin + k)];
        if(v < 0 || v >= static_cast<long long>(m_mesh.points.size()))
          refuse_cell("has the vertex " + std::to_string(v) + ", which does not exist");
        if(types[i] == vtk_tetrahedron)
          vertices[static_cast<std::size_t>(k)] = static_cast<int>(v);
      }
      if(types[i] != vtk_tetrahedron)
        continue;
      if(has_vertex_twice(vertices))
        refuse_cell("has a vertex twice");
      m_mesh.tetrahedra.push_back(vertices);
    }
  }

  std::vector<Array> m_arrays;
  bool m_has_piece = false, m_is_compressed = false, m_is_appended_raw = false;
  std::pair<std::string, std::string> m_piece; // how many points and cells
  std::size_t m_appended = 0, m_header = 4;    // where appended arrays start; bytes of a count
  Source_text::Numbers m_order = Source_text::Numbers::little_endian;
  std::optional<Encoded> m_encoded_points; // if they are no text
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_VTU_FILE_H
