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

// What most tests and examples include, compiled once for all of them: headers of CGAL, Eigen, the
// standard library and the public ones of this package. Each program includes what it uses itself,
// and so compiles without this header.

#include "compiled_sessions.h"
#include "dense_algebra.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/check_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#endif // CGAL_ARAP_DEFORMATION_TEST_PRECOMPILED_H
