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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CHECK_COUNT_H
#define CGAL_ARAP_DEFORMATION_DEMO_CHECK_COUNT_H

#include <cstddef>
#include <stdexcept>
#include <string>

namespace CGAL::ARAP::demo {

// A file has at least one byte for each of its items. Throws if it announces more: it is damaged,
// and a reader that trusts it allocates without bound.
inline void check_count(const std::string& file, std::size_t bytes, double count,
                        const std::string& things)
{
  if(!(count >= 0 && count <= static_cast<double>(bytes)))
    throw std::runtime_error(file + ": announces more " + things + " than fit into its " +
                             std::to_string(bytes) + " bytes");
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHECK_COUNT_H
