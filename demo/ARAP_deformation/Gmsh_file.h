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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_GMSH_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_GMSH_FILE_H

#include "Tetrahedra_text.h"

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace CGAL::ARAP::demo {

// Tetrahedra in .msh files of Gmsh, version 2.2 or 4.1, text or binary. All other sections are kept
// as they are.
class Gmsh_file : public Tetrahedra_text
{
public:
  explicit Gmsh_file(const std::string& file) : Tetrahedra_text(file)
  {
    Words words(text());
    if(words.next() != "$MeshFormat")
      refuse(words, "a .msh file starts with '$MeshFormat', but this with");
    const std::string_view version = words.next();
    m_has_blocks = version == "4.1";
    if(!m_has_blocks && version != "2.2" && version != "2.1" && version != "2")
      refuse(words, "only the versions 2.2 and 4.1 of .msh files can be read, but this is");
    read_numbers(words);
    words = section("$Nodes", words.end());
    if(m_has_blocks)
      read_blocks(words, [&](const Block& block) { read_nodes(words, block); });
    else
      read_nodes(words);
    read_end(words, "$EndNodes");
    const std::size_t end_of_nodes = words.end();
    words = section("$Elements", words.end());
    if(m_has_blocks)
      read_blocks(words, [&](const Block& block) {
        for(long long i = 0; i < block.size; ++i)
        {
          read_tag(words);
          read_element(words, block.type);
        }
      });
    else
      read_elements(words);
    read_end(words, "$EndElements");
    for(const auto& [keyword, end] :
        {std::pair("$Nodes", end_of_nodes), std::pair("$Elements", words.end())})
      if(find_section(keyword, end))
        refuse(std::string("has a second section ") + keyword);
  }

private:
  // The words after a line that starts with a keyword, the first one after a place.
  std::optional<Words> find_section(const std::string& keyword, std::size_t place) const
  {
    for(; (place = text().find(keyword, place)) != std::string::npos; ++place)
      if(place > 0 && text()[place - 1] == '\n')
        if(Words words(text(), place); words.next() == keyword)
          return words;
    return std::nullopt;
  }

  Words section(const std::string& keyword, std::size_t place) const
  {
    if(const auto found = find_section(keyword, place))
      return *found;
    refuse("has no " + keyword);
  }

  // the head of a block of nodes or elements of the version 4.1
  struct Block
  {
    long long dimension, type, size; // the type of elements, or whether nodes are parametric
  };

  static constexpr long long largest = (std::numeric_limits<int>::max)();

  // Reads how numbers are written: as text, or as bytes in the order that a one shows.
  void read_numbers(Words& words)
  {
    const std::string_view kind = words.next(), size = words.next();
    if(kind != "0" && kind != "1")
      refuse(words, "a .msh file is text (0) or binary (1), but this is");
    if(kind == "0")
      return;
    if(size != "8")
      refuse(words, "only binary files with the data size 8 can be read, but here it is");
    skip_end_of_line(words);
    const std::string_view one = words.skip(4);
    m_source.numbers = one == std::string_view("\1\0\0\0", 4)
                         ? Source_text::Numbers::little_endian : Source_text::Numbers::big_endian;
    if(one.size() < 4 || Source_text::number_of<int>(one, m_source.numbers) != 1)
      refuse("is binary, but does not show its byte order by the number 1");
  }

  static void skip_end_of_line(Words& words)
  {
    if(words.skip(1) == "\r")
      words.skip(1);
  }

  void read_end(Words& words, const std::string& keyword)
  {
    m_found = in_quotes(words.next());
    if(m_found != in_quotes(keyword))
      refuse(words, "expected " + keyword + " after as many as the file announces, but found");
  }

  // Reads an integer, which has four bytes in a binary file.
  long long read(Words& words, long long smallest = 0)
  {
    return read_of<int>(words, smallest);
  }

  // Reads a count, which has eight bytes in the version 4.1.
  long long read_size(Words& words) { return read_of<long long>(words, 0); }

  // Reads the number of a node or an element, which may need the eight bytes.
  long long read_tag(Words& words)
  {
    return read_of<long long>(words, 0, (std::numeric_limits<long long>::max)());
  }

  // Reads an integer that is written as text in a binary file, too, at the end of a line.
  long long read_as_text(Words& words)
  {
    const long long value = read_text(words, 0);
    if(is_binary())
      skip_end_of_line(words);
    return value;
  }

  long long read_text(Words& words, long long smallest, long long most = largest) const
  {
    return read_integer(words, smallest, most, [&] { return description(smallest); });
  }

  static std::string description(long long smallest)
  {
    return "an integer from " + std::to_string(smallest);
  }

  template <typename Integer>
  long long read_of(Words& words, long long smallest, long long most = largest)
  {
    if(!is_binary())
      return read_text(words, smallest, most);
    const long long value = read_bytes<Integer>(words);
    if(value < smallest || value > most)
      refuse(words, "expected " + description(smallest) + ", but found");
    return value;
  }

  template <typename Read_block>
  void read_blocks(Words& words, const Read_block& read_block)
  {
    if(is_binary())
      skip_end_of_line(words);
    const long long blocks = read_size(words);
    for(int k = 0; k < 3; ++k)
      read_tag(words); // the total, and the range of the tags
    for(long long i = 0; i < blocks; ++i)
    {
      Block block;
      block.dimension = read(words);
      read(words, -largest); // the entity
      block.type = read(words);
      block.size = read_size(words);
      read_block(block);
    }
  }

  void read_node(Words& words)
  {
    const auto node = [this] { return "node " + std::to_string(m_mesh.points.size() + 1); };
    if(is_binary())
      read_binary_point(words, node);
    else
      read_point(words, node);
  }

  void insert_tag(const Words& words, long long tag, std::size_t index)
  {
    if(!m_nodes.emplace(tag, static_cast<int>(index)).second)
      refuse(words, "a node has the same number as another one, in");
  }

  void read_nodes(Words& words, const Block& block)
  {
    for(long long i = 0; i < block.size; ++i)
      insert_tag(words, read_tag(words), m_mesh.points.size() + i);
    // nodes on a curve or a surface have parameters, too
    const long long parameters = block.type == 0 ? 0 : block.dimension;
    if(parameters > 3)
      refuse(words, "a block of nodes can have the dimension 3 at most, but has " +
                    std::to_string(parameters) + " before");
    for(long long i = 0; i < block.size; ++i)
    {
      read_node(words);
      for(long long k = 0; k < parameters; ++k)
        if(is_binary())
          read_bytes<double>(words);
        else
          words.next();
    }
  }

  void read_nodes(Words& words)
  {
    for(long long i = read_as_text(words); i > 0; --i)
    {
      insert_tag(words, read(words), m_mesh.points.size());
      read_node(words);
    }
  }

  // In a binary file elements of the same type are together.
  void read_elements(Words& words)
  {
    for(long long left = read_as_text(words), size = 1; left > 0; left -= size)
    {
      if(!is_binary())
        read(words); // its number
      const long long type = read(words);
      if(is_binary())
        size = read(words, 1);
      if(size > left)
        refuse(words, "expected at most " + std::to_string(left) + " elements, but found");
      const long long tags = read(words);
      for(long long i = 0; i < size; ++i)
      {
        if(is_binary())
          read(words); // its number
        for(long long k = 0; k < tags; ++k)
          read(words, -largest);
        read_element(words, type);
      }
    }
  }

  void read_element(Words& words, long long type)
  {
    static const std::map<long long, int> corners = {{1, 2}, {2, 3}, {3, 4}, {4, 4}, {15, 1}};
    const int tetrahedron = 4;
    const auto found = corners.find(type);
    if(found == corners.end())
      refuse(words, "only tetrahedra with four vertices can be deformed, but there are elements of "
                    "the type " + std::to_string(type) + ", after");
    std::array<int, 4> vertices = {};
    for(int k = 0; k < found->second; ++k)
    {
      const auto node = m_nodes.find(m_has_blocks ? read_tag(words) : read(words));
      if(node == m_nodes.end())
        refuse(words, "there is no node");
      vertices[k] = node->second;
    }
    if(type != tetrahedron)
      return;
    add_tetrahedron(words, vertices, [] { return std::string("a tetrahedron"); });
  }

  bool m_has_blocks = false; // of nodes and elements: version 4.1
  std::unordered_map<long long, int> m_nodes; // indices, by their numbers in the file
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_GMSH_FILE_H
