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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_BLOCK_FORCES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_BLOCK_FORCES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// Adds up for each vertex the forces at its places.
struct Gather_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Index_lists& places, int begin, int end,
                                          const Double4* forces, Coordinates* force)
  {
    for(int v = begin; v < end; ++v)
    {
      Double4 sum = Double4::zero();
      for(int k = places.begin[v]; k < places.begin[v + 1]; ++k)
        sum = sum + forces[places.items[k]];
      force[v] = {sum[0], sum[1], sum[2]};
    }
  }
};

// The forces of simplices on their corners, block by block. A block has a place of its own for each
// of its vertices, so that no two blocks write to one place; the vertices add up theirs. Simplices
// are in the order of their smallest vertices, which are numbered breadth-first: few vertices are
// in more than one block.
class Block_forces
{
public:
  Block_forces(const Index_lists& corners, int number_of_vertices)
    : m_block_size((std::max)(static_cast<int>(default_block_size), corners.size() / 64)),
      m_places(corners.items.size())
  {
    const auto largest = std::max_element(corners.items.begin(), corners.items.end());
    Array<int> place(largest == corners.items.end() ? 0 : *largest + 1, -1); // in the last block
    Array<int> vertices; // at each place
    for(int s = 0; s < corners.size(); ++s)
    {
      const auto number_of_places = static_cast<int>(vertices.size());
      if(s % m_block_size == 0)
        m_first_place.push_back(number_of_places);
      for(int k = corners.begin[s]; k < corners.begin[s + 1]; ++k)
      {
        const int v = corners.items[k];
        if(place[v] < m_first_place.back())
        {
          place[v] = static_cast<int>(vertices.size());
          vertices.push_back(v);
        }
        m_places[k] = place[v];
      }
    }
    m_first_place.push_back(to_index(vertices.size()));
    m_places_of_vertices = places_of(vertices, number_of_vertices);
    m_forces = Array<Double4>(vertices.size(), Double4::zero());
  }

  int block_size() const { return m_block_size; } // in simplices

  const int* places() const { return m_places.data(); } // of each corner
  Double4* data() { return m_forces.data(); }           // for each place

  void clear() { std::fill(m_forces.begin(), m_forces.end(), Double4::zero()); }

  void clear_block_of(int simplex)
  {
    const int block = simplex / m_block_size;
    std::fill(m_forces.begin() + m_first_place[block], m_forces.begin() + m_first_place[block + 1],
              Double4::zero());
  }

  void gather(Coordinates* force) const
  {
    for_each_block(static_cast<std::size_t>(m_places_of_vertices.size()),
                   [&](std::size_t begin, std::size_t end) {
      run_kernel<Gather_kernel>(m_places_of_vertices, static_cast<int>(begin),
                                static_cast<int>(end), m_forces.data(), force);
    });
  }

private:
  int m_block_size;
  Array<int> m_places;              // of each corner
  Array<int> m_first_place;         // of each block
  Index_lists m_places_of_vertices;
  Array<Double4> m_forces;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_BLOCK_FORCES_H
