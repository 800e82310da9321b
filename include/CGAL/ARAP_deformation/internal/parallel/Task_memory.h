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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_TASK_MEMORY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_TASK_MEMORY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Arrays of numbers that tasks take for a while. The thread that starts the tasks allocates them,
// for as many tasks as run at a time: what other threads allocate, the C library keeps for them.
class Task_memory
{
public:
  struct Piece
  {
    std::size_t size;
    std::unique_ptr<double[]> numbers;
  };

  // for tasks that need these sizes
  explicit Task_memory(std::vector<std::size_t> sizes)
  {
    std::sort(sizes.begin(), sizes.end(), std::greater<std::size_t>());
    sizes.resize((std::min)(sizes.size(), number_of_threads()));
    for(std::size_t size : sizes)
      m_free.push_back(piece(size));
  }

  // the smallest that is large enough
  Piece take(std::size_t size)
  {
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      for(std::size_t k = m_free.size(); k-- > 0;)
        if(m_free[k].size >= size)
        {
          Piece taken = std::move(m_free[k]);
          m_free.erase(m_free.begin() + static_cast<std::ptrdiff_t>(k));
          return taken;
        }
    }
    return piece(size); // a thread that waited for tasks of its own has begun another one
  }

  void give_back(Piece taken)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto place = std::find_if(m_free.begin(), m_free.end(), [&](const Piece& other) {
      return other.size < taken.size;
    });
    m_free.insert(place, std::move(taken));
  }

private:
  static Piece piece(std::size_t size)
  {
    return {size, std::unique_ptr<double[]>(new double[size])}; // first touched by a task
  }

  std::vector<Piece> m_free; // the largest first
  std::mutex m_mutex;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_TASK_MEMORY_H
