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

#ifndef CGAL_ARAP_DEFORMATION_TEST_COMMAND_H
#define CGAL_ARAP_DEFORMATION_TEST_COMMAND_H

// Runs the command arap_deform as a user does, in a folder of its own.

#include "check.h"
#include "length.h"
#include "sanitizer.h"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/wait.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

inline std::string command; // its path
inline fs::path folder;     // where it runs

inline std::string content(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write(const std::string& name, const std::string& text)
{
  std::ofstream(folder / name, std::ios::binary) << text;
}

// the text with the first `from` replaced by `to`
inline std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t place = text.find(from);
  CHECK(place != std::string::npos);
  return text.replace((std::min)(place, text.size()), from.size(), to);
}

struct Run
{
  int exit_code;
  std::string out, err;
};

// Runs a line of the shell in the folder.
inline Run run_line(const std::string& line)
{
  const fs::path out = folder / "stdout", err = folder / "stderr";
  const int status = std::system(("cd \"" + folder.string() + "\" && ( " + line +
                                  " ) > stdout 2> stderr").c_str());
#if defined(__unix__) || defined(__APPLE__)
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
#else
  const int exit_code = status;
#endif
  Run result{exit_code, content(out), content(err)};
  fs::remove(out);
  fs::remove(err);
  return result;
}

inline Run run(const std::string& arguments) { return run_line('"' + command + "\" " + arguments); }

// From now on the command is killed if it takes longer than anything here should, also beside other
// programs, and, unless it is built with a sanitizer, which needs more, has no more than a GB to
// allocate, of which OpenBLAS takes some for each thread.
inline void limit_command()
{
#if defined(__linux__)
#ifdef CGAL_ARAP_TEST_HAS_OWN_MALLOC
  const std::string memory = "unlimited";
#else
  const std::string memory = "1000000";
#endif
  command = "/bin/sh\" -c 'ulimit -t 20; ulimit -v " + memory +
            "; OPENBLAS_NUM_THREADS=1 exec timeout -s KILL 100 \"$0\" \"$@\"' \"" + command;
#endif
}

inline std::set<std::string> files()
{
  std::set<std::string> names;
  for(const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

// Exit code and a phrase of the message; no file appears, none changes.
inline void check_refused(const std::string& arguments, int exit_code, const std::string& phrase)
{
  test_case() = arguments;
  const auto before = files();
  const Run refused = run(arguments);
  CHECK(refused.exit_code == exit_code);
  CHECK(refused.out.empty());
  CHECK(refused.err.rfind("arap_deform: ", 0) == 0);
  if(!CHECK(refused.err.find(phrase) != std::string::npos) || refused.exit_code != exit_code)
    std::cerr << "    exit code " << refused.exit_code << ", the message was: " << refused.err;
  CHECK(files() == before);
  CHECK(content(folder / "precious.off") == "precious");
}

// Calls each test in a new folder with the command whose path is the argument of the program.
// Returns what main() returns; where there is no command the test has failed.
inline int test_command(int argc, char** argv, const std::vector<std::function<void()>>& tests)
{
  if(argc < 2 || !fs::is_regular_file(argv[1]))
  {
    std::cerr << "usage: " << argv[0] << " PATH_OF_ARAP_DEFORM [...]; nothing was tested"
              << std::endl;
    return EXIT_FAILURE;
  }
  for(const auto& test : tests)
  {
    command = fs::absolute(argv[1]).string();
    const std::string unique = std::to_string(std::random_device()());
    folder = fs::temp_directory_path() / ("arap_deform_test_" + unique);
    fs::create_directory(folder);
    test();
    fs::remove_all(folder);
  }
  return checks_result();
}

#endif // CGAL_ARAP_DEFORMATION_TEST_COMMAND_H
