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

// Misuse of the interface in Release, where preconditions are not checked: refused calls that say so.

#define CGAL_NDEBUG 1

#include "include/misuse.h"

int main()
{
  test_misuse([](const auto& call) {
    const CGAL::ARAP::Outcome outcome = call();
    CHECK(outcome.status == CGAL::ARAP::Status::not_a_control_vertex);
    CHECK(outcome.message.find("vertex 5 is not a control vertex") != std::string::npos);
  });
  return checks_result();
}
