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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_OUTPUT_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_OUTPUT_FILE_H

// The output files of the command arap_deform, and the files that names refer to.

#include "Delayed_interruption.h"
#include "Unwritable.h"

#include <boost/lexical_cast/try_lexical_convert.hpp>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace CGAL::ARAP::demo {

namespace internal {

// whether the name is that of a file descriptor of this process, such as /dev/fd/1
inline bool is_descriptor(const std::filesystem::path& file)
{
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical("/dev/fd", error);
  return !folder.empty() && std::filesystem::canonical(file.parent_path(), error) == folder;
}

// The end of the links that start at a name: a file, which need not exist, or a descriptor, such as
// /dev/fd/1 for /dev/stdout. Cyclic links are followed only so far.
inline std::filesystem::path followed(const std::string& name)
{
  std::error_code error;
  std::filesystem::path file = std::filesystem::absolute(name, error);
  const int most_links = 40;
  for(int links = 0; links < most_links && !is_descriptor(file) &&
                     std::filesystem::is_symlink(file, error); ++links)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  return file;
}

// The canonical name of a file, which need not exist; empty if it cannot exist.
inline std::filesystem::path location(const std::string& name)
{
  std::error_code error;
  return std::filesystem::exists(name, error)
           ? std::filesystem::canonical(name, error)
           : std::filesystem::weakly_canonical(followed(name), error);
}

// A file of the C library: unlike a stream, it can be opened on a descriptor, and signals interrupt
// it.
struct Close_file
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using C_file = std::unique_ptr<std::FILE, Close_file>;

// Opens a duplicate of a descriptor: a file is neither truncated nor written from its start, and
// later output to the descriptor follows.
inline C_file open_descriptor(const std::filesystem::path& file)
{
#if defined(__unix__) || defined(__APPLE__)
  int number;
  if(boost::conversion::try_lexical_convert(file.filename().string(), number))
    if(const int copy = dup(number); copy >= 0)
    {
      C_file opened(fdopen(copy, "wb"));
      if(!opened)
        close(copy);
      return opened;
    }
#else
  static_cast<void>(file);
#endif
  return nullptr;
}

} // namespace internal

// Whether two names refer to the same file, pipe or socket, or would if it existed. Devices can
// serve for two things.
inline bool is_same_file(const std::string& a, const std::string& b)
{
#if defined(__unix__) || defined(__APPLE__)
  // std::filesystem::equivalent() compares neither pipes nor sockets
  struct stat of_a, of_b;
  if(stat(a.c_str(), &of_a) == 0 && (S_ISFIFO(of_a.st_mode) || S_ISSOCK(of_a.st_mode)))
    return stat(b.c_str(), &of_b) == 0 && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
#endif
  std::error_code error;
  if(std::filesystem::exists(a, error) && std::filesystem::exists(b, error))
    return std::filesystem::equivalent(a, b, error);
  const std::filesystem::path place = internal::location(a);
  return !place.empty() && place == internal::location(b);
}

// Whether an output is written directly: a descriptor, such as /dev/stdout, a pipe or a device.
inline bool is_written_directly(const std::string& file)
{
  std::error_code error;
  return internal::is_descriptor(internal::followed(file)) ||
         std::filesystem::is_other(file, error);
}

// A file that is written under a temporary name in the same folder and then renamed: no other
// program ever sees half of it. What was there returns, and nothing else is left, unless keep() is
// called. Follows links and keeps permissions. Files that are not regular, such as pipes, and
// descriptors, such as /dev/stdout, are opened once, at construction, and written directly.
class Output_file
{
public:
  // Throws if the file cannot be written, and leaves it untouched.
  explicit Output_file(const std::string& file) : m_name(file)
  {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if(const auto end = internal::followed(file); internal::is_descriptor(end))
      open_directly(internal::open_descriptor(end));
    else if(std::filesystem::is_other(status))
      open_directly(internal::C_file(std::fopen(file.c_str(), "wb")));
    else
      create_temporary(status);
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file()
  {
    std::error_code ignored;
    if(m_has_replaced && m_former.empty())
      std::filesystem::remove(m_file, ignored);
    else if(m_has_replaced)
    {
      std::filesystem::rename(m_former, m_file, ignored);
      m_former.clear(); // where that failed, it is the only copy
    }
    for(const std::filesystem::path& file : {m_temporary, m_former})
      if(!file.empty())
        std::filesystem::remove(file, ignored);
  }

  // Calls write(stream), and throws if not everything reached the file. Call it once only.
  template <typename Write>
  void write(const Write& write)
  {
    try
    {
      if(!(m_direct ? write_directly(write) : write_temporary(write)))
        throw Unwritable("could not be written to the end");
    }
    catch(const Unwritable& error)
    {
      throw std::runtime_error(m_name + ": " + error.what());
    }
  }

  // Puts what was written in the place of what was there, which is set aside until keep().
  void replace()
  {
    if(m_temporary.empty())
      return;
    std::error_code error;
    if(std::filesystem::exists(m_file, error))
      set_aside(error);
    if(!error)
      std::filesystem::rename(m_temporary, m_file, error);
    if(error)
      throw std::runtime_error(m_name + ": cannot be written: " + error.message());
    m_temporary.clear();
    m_has_replaced = true;
  }

  // makes it final
  void keep() { m_has_replaced = false; }

private:
  void require(bool condition) const
  {
    if(!condition)
      throw std::runtime_error(m_name + ": cannot be written");
  }

  void open_directly(internal::C_file file)
  {
    m_direct = std::move(file);
    require(m_direct != nullptr);
  }

  void create_temporary(std::filesystem::file_status status)
  {
    m_file = internal::location(m_name);
    const bool exists = std::filesystem::is_regular_file(status);
    require(exists || status.type() == std::filesystem::file_type::not_found);
    require(!m_file.empty() && (!exists || std::ofstream(m_file, std::ios::app)));
    const auto temporary = free_name();
    require(bool(std::ofstream(temporary)));
    m_temporary = temporary;
    std::error_code ignored;
    if(exists)
      std::filesystem::permissions(m_temporary, status.permissions(), ignored);
  }

  // A name in the same folder that no file has; short, since that of the file may have the maximum
  // length.
  std::filesystem::path free_name() const
  {
    std::filesystem::path name;
    std::error_code ignored;
    do
      name = m_file.parent_path() / ("arap_" + std::to_string(std::random_device()()) + ".tmp");
    while(std::filesystem::exists(name, ignored));
    return name;
  }

  // Gives what is there a second name, or copies it where there are no links.
  void set_aside(std::error_code& error)
  {
    m_former = free_name();
    std::filesystem::create_hard_link(m_file, m_former, error);
    if(error)
      std::filesystem::copy_file(m_file, m_former, error);
  }

  // In pieces that a pipe takes as a whole or not at all: a signal interrupts only what has to wait
  // before it begins.
  template <typename Write>
  bool write_directly(const Write& write)
  {
    std::ostringstream out;
    write(out);
    const std::string text = out.str();
    std::setvbuf(m_direct.get(), nullptr, _IONBF, 0);
    const std::size_t largest_piece = 4096;
    bool is_written = bool(out);
    for(std::size_t begin = 0; begin < text.size() && is_written; begin += largest_piece)
    {
      check_interrupted();
      const std::size_t size = (std::min)(largest_piece, text.size() - begin);
      is_written = std::fwrite(text.data() + begin, 1, size, m_direct.get()) == size;
    }
    check_interrupted();
    return std::fclose(m_direct.release()) == 0 && is_written;
  }

  template <typename Write>
  bool write_temporary(const Write& write) const
  {
    std::ofstream out(m_temporary, std::ios::binary);
    write(out);
    out.close();
    return bool(out);
  }

  std::string m_name; // as the user gave it
  std::filesystem::path m_file, m_temporary, m_former;
  bool m_has_replaced = false; // the new file is in its place, and not final
  internal::C_file m_direct; // instead of a temporary file
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_OUTPUT_FILE_H
