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

#ifndef CGAL_ARAP_DEFORMATION_TEST_ALLOCATION_FAULTS_H
#define CGAL_ARAP_DEFORMATION_TEST_ALLOCATION_FAULTS_H

// Replaces the allocation functions of the program by some that fail where they are told to: those
// of the C library, which Eigen calls too, if it is glibc and no sanitizer has replaced them
// already; else operator new only. To be included in one file of a program, which has one thread.

#include "faults.h"
#include "sanitizer.h"

#include <cerrno>
#include <cstdlib>
#include <new>

// needs no initialization: there are allocations before that of any variable
inline Faults allocation_faults;

#if defined(__GLIBC__) && !defined(CGAL_ARAP_TEST_HAS_OWN_MALLOC)

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

inline bool is_out_of_memory()
{
  if(!allocation_faults.is_hit())
    return false;
  errno = ENOMEM;
  return true;
}

void* malloc(std::size_t size) noexcept
{
  return is_out_of_memory() ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t n, std::size_t size) noexcept
{
  return is_out_of_memory() ? nullptr : __libc_calloc(n, size);
}

void* realloc(void* block, std::size_t size) noexcept
{
  return is_out_of_memory() ? nullptr : __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept
{
  return is_out_of_memory() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
  return memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept
{
  void* const allocated = memalign(alignment, size);
  if(allocated == nullptr)
    return ENOMEM;
  *block = allocated;
  return 0;
}

} // extern "C"

#else

namespace allocation {

inline void* of_size(std::size_t size) noexcept
{
  return allocation_faults.is_hit() ? nullptr : std::malloc(size == 0 ? 1 : size);
}

inline void* of_size(std::size_t size, std::align_val_t alignment) noexcept
{
  const auto unit = static_cast<std::size_t>(alignment);
  return allocation_faults.is_hit()
       ? nullptr : std::aligned_alloc(unit, (size + unit - 1) / unit * unit);
}

template <typename... Alignment>
void* of_size_or_throw(std::size_t size, Alignment... alignment)
{
  void* const block = of_size(size, alignment...);
  if(block == nullptr)
    throw std::bad_alloc();
  return block;
}

} // namespace allocation

using std::align_val_t;
using std::nothrow_t;
using std::size_t;

void* operator new(size_t n) { return allocation::of_size_or_throw(n); }
void* operator new[](size_t n) { return allocation::of_size_or_throw(n); }
void* operator new(size_t n, align_val_t a) { return allocation::of_size_or_throw(n, a); }
void* operator new[](size_t n, align_val_t a) { return allocation::of_size_or_throw(n, a); }
void* operator new(size_t n, const nothrow_t&) noexcept { return allocation::of_size(n); }
void* operator new[](size_t n, const nothrow_t&) noexcept { return allocation::of_size(n); }
void* operator new(size_t n, align_val_t a, const nothrow_t&) noexcept
{ return allocation::of_size(n, a); }
void* operator new[](size_t n, align_val_t a, const nothrow_t&) noexcept
{ return allocation::of_size(n, a); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, size_t) noexcept { std::free(p); }
void operator delete[](void* p, size_t) noexcept { std::free(p); }
void operator delete(void* p, align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, align_val_t) noexcept { std::free(p); }
void operator delete(void* p, size_t, align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, size_t, align_val_t) noexcept { std::free(p); }
void operator delete(void* p, const nothrow_t&) noexcept { std::free(p); }
void operator delete[](void* p, const nothrow_t&) noexcept { std::free(p); }
void operator delete(void* p, align_val_t, const nothrow_t&) noexcept { std::free(p); }
void operator delete[](void* p, align_val_t, const nothrow_t&) noexcept { std::free(p); }

#endif

#endif // CGAL_ARAP_DEFORMATION_TEST_ALLOCATION_FAULTS_H
