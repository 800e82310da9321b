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

#ifndef CGAL_ARAP_DEFORMATION_TEST_CONFORMANCE_H
#define CGAL_ARAP_DEFORMATION_TEST_CONFORMANCE_H

// Checks of the conformance tests: whether a model has passed, or was caught for what is wrong.

#include "check.h"

#include <iostream>
#include <string>
#include <vector>

inline void check_conforms(const std::vector<std::string>& sentences, const char* text,
                           const char* file, int line)
{
  if(check(sentences.empty(), text, file, line))
    return;
  for(const std::string& sentence : sentences)
    std::cerr << "    " << sentence << std::endl;
}

// A sentence contains `expected`.
inline void check_caught(const std::vector<std::string>& sentences, const std::string& expected,
                         const char* text, const char* file, int line)
{
  bool is_caught = false;
  for(const std::string& sentence : sentences)
    is_caught |= sentence.find(expected) != std::string::npos;
  if(check(is_caught, text, file, line))
    return;
  for(const std::string& sentence : sentences)
    std::cerr << "    " << sentence << std::endl;
}

#define CHECK_CONFORMS(sentences) check_conforms((sentences), #sentences, __FILE__, __LINE__)
#define CHECK_CAUGHT(sentences, expected) \
  check_caught((sentences), (expected), #sentences, __FILE__, __LINE__)

#endif // CGAL_ARAP_DEFORMATION_TEST_CONFORMANCE_H
