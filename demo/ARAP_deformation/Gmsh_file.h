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
#include <string>
#include <string_view>
#include <unordered_map>

namespace CGAL::ARAP::demo {

// Tetrahedra in .msh files, the text format of Gmsh, version 2.2 or 4.1. All other sections are
// kept as they are.
class Gmsh_file : public Tetrahedra_text
{
public:
  explicit Gmsh_file(const std::string& file) : Tetrahedra_text(file)
  {
    Words words(text());
    if(words.next() != "$MeshFormat")
      refuse(words, "a .msh file starts with '$MeshFormat', but this with");
    const std::string_view version = words.next();
    const bool has_blocks = version == "4.1";
    if(!has_blocks && version != "2.2" && version != "2.1" && version != "2")
      refuse(words, "only the versions 2.2 and 4.1 of .msh files can be read, but this is");
    if(words.next() != "0")
      refuse("is binary; save it as text");
    words = section("$Nodes", words.end());
    if(has_blocks)
      read_blocks(words, [&](const Block& block) { read_nodes(words, block); });
    else
      read_nodes(words);
    words = section("$Elements", words.end());
    if(has_blocks)
      read_blocks(words, [&](const Block& block) {
        for(long long i = 0; i < block.size; ++i)
        {
          read(words);
          read_element(words, block.type);
        }
      });
    else
      read_elements(words);
    if(m_mesh.tetrahedra.empty())
      refuse("has no tetrahedra; surfaces are read from .off, .obj, .ply, .stl and glTF files");
  }

private:
  // the head of a block of nodes or elements of the version 4.1
  struct Block
  {
    long long dimension, type, size; // the type of elements, or whether nodes are parametric
  };

  static constexpr long long largest = (std::numeric_limits<int>::max)();

  long long read(Words& words, long long smallest = 0) const
  {
    return read_integer(words, smallest, largest, [&] {
      return "an integer from " + std::to_string(smallest);
    });
  }

  template <typename Read_block>
  void read_blocks(Words& words, const Read_block& read_block) const
  {
    const long long blocks = read(words);
    for(int k = 0; k < 3; ++k)
      read(words); // the total, and the range of the tags
    for(long long i = 0; i < blocks; ++i)
    {
      Block block;
      block.dimension = read(words);
      read(words, -largest); // the entity
      block.type = read(words);
      block.size = read(words);
      read_block(block);
    }
  }

  void read_node(Words& words)
  {
    read_point(words, [this] { return "node " + std::to_string(m_mesh.points.size() + 1); });
  }

  void insert_tag(const Words& words, long long tag, std::size_t index)
  {
    if(!m_nodes.emplace(tag, static_cast<int>(index)).second)
      refuse(words, "a node has the same number as another one, in");
  }

  void read_nodes(Words& words, const Block& block)
  {
    for(long long i = 0; i < block.size; ++i)
      insert_tag(words, read(words), m_mesh.points.size() + i);
    for(long long i = 0; i < block.size; ++i)
    {
      read_node(words);
      for(long long k = 0; block.type != 0 && k < block.dimension; ++k)
        words.next(); // parameters on a curve or a surface
    }
  }

  void read_nodes(Words& words)
  {
    for(long long i = read(words); i > 0; --i)
    {
      insert_tag(words, read(words), m_mesh.points.size());
      read_node(words);
    }
  }

  void read_elements(Words& words)
  {
    for(long long i = read(words); i > 0; --i)
    {
      read(words); // its number
      const long long type = read(words);
      for(long long tags = read(words); tags > 0; --tags)
        read(words, -largest);
      read_element(words, type);
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
      const auto node = m_nodes.find(read(words));
      if(node == m_nodes.end())
        refuse(words, "there is no node");
      vertices[k] = node->second;
    }
    if(type != tetrahedron)
      return;
    check_tetrahedron(words, vertices, [] { return std::string("a tetrahedron"); });
    m_mesh.tetrahedra.push_back(vertices);
  }

  std::unordered_map<long long, int> m_nodes; // indices, by their numbers in the file
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_GMSH_FILE_H
