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

#ifndef CGAL_ARAP_DEFORMATION_TEST_COMPILED_SESSIONS_H
#define CGAL_ARAP_DEFORMATION_TEST_COMPILED_SESSIONS_H

// Sessions over the domains that most tests and examples deform: compiled once, in
// compiled_sessions.cpp, instead of in each of them. Programs with the precompiled header link with
// these.

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <vector>

namespace compiled_sessions {

using Points = std::vector<CGAL::Simple_cartesian<double>::Point_3>;
template <typename Index, std::size_t n>
using Simplices = std::vector<std::array<Index, n>>;
using Mesh_domain =
  CGAL::ARAP::Face_graph_domain<CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>>;
using Triangles = CGAL::ARAP::Simplex_soup_domain<2, Points, Simplices<std::size_t, 3>>;
using Polygons = CGAL::ARAP::Simplex_soup_domain<2, Points, std::vector<std::vector<std::size_t>>>;
using Tetrahedra = CGAL::ARAP::Simplex_soup_domain<3, Points, Simplices<std::size_t, 4>>;
using Int_tetrahedra = CGAL::ARAP::Simplex_soup_domain<3, Points, Simplices<int, 4>>;
using Tetrahedra_as_vectors =
  CGAL::ARAP::Simplex_soup_domain<3, Points, std::vector<std::vector<std::size_t>>>;

} // namespace compiled_sessions

// the session over a domain, and what it consists of
#define CGAL_ARAP_TEST_SESSION(Extern, Domain)                                                     \
  Extern template struct CGAL::ARAP::internal::Built_region<compiled_sessions::Domain>;            \
  Extern template class CGAL::ARAP::internal::Cell_values<compiled_sessions::Domain>;              \
  Extern template class CGAL::ARAP::internal::Domain_region<compiled_sessions::Domain>;            \
  Extern template class CGAL::ARAP::internal::Prepared_region<compiled_sessions::Domain>;          \
  Extern template class CGAL::ARAP::internal::Region_targets<compiled_sessions::Domain>;           \
  Extern template class CGAL::ARAP::internal::Session_controls<compiled_sessions::Domain>;         \
  Extern template class CGAL::ARAP::internal::Session_history<compiled_sessions::Domain>;          \
  Extern template class CGAL::ARAP::internal::Session_targets<compiled_sessions::Domain>;          \
  Extern template class CGAL::ARAP::internal::Session_vertices<compiled_sessions::Domain>;         \
  Extern template class CGAL::ARAP::internal::Session<compiled_sessions::Domain>;                  \
  Extern template class CGAL::ARAP::internal::Surroundings<compiled_sessions::Domain>;

#define CGAL_ARAP_TEST_SESSIONS(Extern)                                                            \
  CGAL_ARAP_TEST_SESSION(Extern, Mesh_domain)                                                      \
  CGAL_ARAP_TEST_SESSION(Extern, Triangles)                                                        \
  CGAL_ARAP_TEST_SESSION(Extern, Polygons)                                                         \
  CGAL_ARAP_TEST_SESSION(Extern, Tetrahedra)                                                       \
  CGAL_ARAP_TEST_SESSION(Extern, Int_tetrahedra)                                                   \
  CGAL_ARAP_TEST_SESSION(Extern, Tetrahedra_as_vectors)

CGAL_ARAP_TEST_SESSIONS(extern)

#endif // CGAL_ARAP_DEFORMATION_TEST_COMPILED_SESSIONS_H
