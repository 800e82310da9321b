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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_BLENDED_ROTATIONS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_BLENDED_ROTATIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// For each vertex the rotation closest to the weighted mean of those of its nodes, but for nodes
// whose rotation is not known; the identity if none is. Empty if no node has one.
inline Array<Matrix_3x3> blended_rotations(const Coarse_space& space,
                                           const Array<Matrix_3x3>& rotations,
                                           const Array<char>& is_known)
{
  if(std::find(is_known.begin(), is_known.end(), 1) == is_known.end())
    return {};
  Array<Matrix_3x3> result(space.number_of_vertices());
  for_each_block(result.size(), [&](std::size_t begin, std::size_t end) {
    Array<Matrix_3x3> sums(end - begin, Matrix_3x3());
    for(std::size_t v = begin; v < end; ++v)
    {
      const int* const nodes = space.nodes(static_cast<int>(v));
      const float* const weights = space.weights(static_cast<int>(v));
      for(int k = 0; k < Coarse_space::most_nodes && weights[k] > 0; ++k)
        if(is_known[nodes[k]])
        {
          add(sums[v - begin], weights[k], rotations[nodes[k]]);
          result[v] = rotations[nodes[k]]; // close enough to begin with
        }
    }
    Newton_closest_rotation()(end - begin, sums.data(), result.data() + begin);
  });
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_BLENDED_ROTATIONS_H
