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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_UNWRITABLE_H
#define CGAL_ARAP_DEFORMATION_DEMO_UNWRITABLE_H

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace CGAL::ARAP::demo {

// What the format of a file cannot hold; Output_file adds the name of the file.
struct Unwritable : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// A number in single precision. Throws if it is too large; NaN stays what it is.
inline float to_float(double x)
{
  if(std::abs(x) > (std::numeric_limits<float>::max)())
  {
    std::ostringstream why;
    why << "the number " << x << " is too large for the single precision of this file";
    throw Unwritable(why.str());
  }
  return static_cast<float>(x);
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_UNWRITABLE_H
