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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_INSERTIONS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_INSERTIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/linkage.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Places of entries, to be put in the order in which they entered the region of interest.
class Insertions
{
public:
  void add(std::uint64_t insertion, std::size_t place);

  std::vector<std::size_t> places_in_order();

private:
  std::vector<std::pair<std::uint64_t, std::size_t>> m_insertions; // with the places
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/Insertions_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_INSERTIONS_H
