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

#ifndef CGAL_ARAP_DEFORMATION_TEST_PRECOMPILED_H
#define CGAL_ARAP_DEFORMATION_TEST_PRECOMPILED_H

// What most tests include, compiled once for all of them. Each test includes what it uses itself,
// and so compiles without this header.

#include "domains.h"

#include <CGAL/ARAP_deformation/Face_graph_domain.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>

#include <boost/property_map/property_map.hpp>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <type_traits>

#endif // CGAL_ARAP_DEFORMATION_TEST_PRECOMPILED_H
