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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_PROGRESS_H
#define CGAL_ARAP_DEFORMATION_DEMO_PROGRESS_H

#include "Command_line.h"

#include <CGAL/Real_timer.h>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

#include <iostream>
#include <sstream>
#include <string>

namespace CGAL::ARAP::demo {

inline bool is_terminal()
{
#if defined(__unix__) || defined(__APPLE__)
  return isatty(STDERR_FILENO) != 0;
#else
  return false;
#endif
}

// Says on a terminal what is being done, in a line that is replaced by the next one.
class Progress
{
public:
  explicit Progress(const Command_line& line) : m_is_shown(!line.is_quiet && is_terminal()) {}

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  ~Progress() { show(""); }

  void show(const std::string& what)
  {
    m_timer = CGAL::Real_timer(); // it may be running
    m_timer.start();
    if(m_is_shown)
      std::cerr << '\r' << what << "\033[K" << std::flush;
  }

  // shows how far a frame is
  template <typename Iterate>
  void show(const std::string& which, const Iterate& iterate, unsigned int iterations)
  {
    if(!m_is_shown)
      return;
    std::ostringstream text;
    text << which << "iteration " << iterate.iteration() << " of at most " << iterations
         << ", energy " << iterate.energy();
    show(text.str());
  }

  // Replaces the line for good, with the seconds since it was shown.
  void done(const std::string& what)
  {
    if(m_is_shown)
      std::cerr << '\r' << what << " in " << m_timer.time() << " s\033[K\n" << std::flush;
  }

private:
  bool m_is_shown;
  CGAL::Real_timer m_timer;
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_PROGRESS_H
