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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_INTERNAL_VIOLATIONS_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_INTERNAL_VIOLATIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// collects messages about the identities that a model violates, each once
class Violations
{
public:
  // adds the message composed of the parts if the identity does not hold
  template <typename... Parts>
  void check(bool holds, const Parts&... parts)
  {
    if(holds)
      return;
    std::ostringstream sentence;
    (sentence << ... << parts);
    if(std::find(m_sentences.begin(), m_sentences.end(), sentence.str()) == m_sentences.end())
      m_sentences.push_back(sentence.str());
  }

  // calls f(); an exception is a violation too
  template <typename Function>
  void run(const std::string& name, const Function& f)
  {
    try
    {
      f();
    }
    catch(const std::exception& exception)
    {
      check(false, name, " threw an exception: ", exception.what());
    }
  }

  const std::vector<std::string>& sentences() const { return m_sentences; }

private:
  std::vector<std::string> m_sentences;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_INTERNAL_VIOLATIONS_H
