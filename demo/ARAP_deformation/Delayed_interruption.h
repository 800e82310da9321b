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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_DELAYED_INTERRUPTION_H
#define CGAL_ARAP_DEFORMATION_DEMO_DELAYED_INTERRUPTION_H

#include <csignal>
#include <stdexcept>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// set if the user interrupts the run during the lifetime of a Delayed_interruption
inline volatile std::sig_atomic_t is_interrupted = 0;

inline void check_interrupted()
{
  if(is_interrupted)
    throw std::runtime_error("interrupted");
}

// Protects temporary files: during its lifetime the usual signals do not end the program before the
// files are removed. Those that should end it set is_interrupted, and a pipe without a reader only
// fails the write. At any other time these signals end the program at once.
class Delayed_interruption
{
public:
  Delayed_interruption()
  {
    const Handler interrupt = [](int) { is_interrupted = 1; };
    replace(SIGINT, interrupt);
    replace(SIGTERM, interrupt);
#if defined(__unix__) || defined(__APPLE__)
    replace(SIGHUP, interrupt);
    replace(SIGPIPE, SIG_IGN);
#endif
  }

  Delayed_interruption(const Delayed_interruption&) = delete;
  Delayed_interruption& operator=(const Delayed_interruption&) = delete;

  ~Delayed_interruption()
  {
    for(const auto& [signal, handler] : m_before)
      std::signal(signal, handler);
  }

private:
  using Handler = void (*)(int);

  void replace(int signal, Handler handler)
  {
    const Handler before = std::signal(signal, handler);
    m_before.emplace_back(signal, before);
    if(before == SIG_IGN) // by nohup, for example
      std::signal(signal, SIG_IGN);
#if defined(__unix__) || defined(__APPLE__)
    // also interrupt blocking calls, such as waiting for a reader of a pipe
    struct sigaction action;
    sigaction(signal, nullptr, &action);
    action.sa_flags &= ~SA_RESTART;
    sigaction(signal, &action, nullptr);
#endif
  }

  std::vector<std::pair<int, Handler>> m_before;
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_DELAYED_INTERRUPTION_H
