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

// The command arap_deform with arguments and small files that are valid but for random changes: it
// ends soon, and if it could not do what was asked, says so in a sentence and leaves no file. Its
// path is the first argument; without it nothing is tested. Then come the number of runs, a seed.

#include "include/check.h"
#include "include/command.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

using Files = std::map<std::string, std::string>;

class Changes
{
public:
  explicit Changes(unsigned int seed) : m_engine(seed) {}

  // from 0 to n - 1; not of std::uniform_int_distribution, which differs between libraries
  std::size_t below(std::size_t n) { return n == 0 ? 0 : m_engine() % n; }

  // Changes a text once.
  void change(std::string& text)
  {
    static const std::vector<std::string> words = {
      "-1", "0", "3", "4294967295", "2147483648", "99999999999999999999", "1e308", "1e-400", "nan",
      "-", "--", "=", "x", "# ", "OFF", "End", "vertex", "element face 7", "uint", " "};
    const std::size_t begin = below(text.size()), n = below((std::min)(text.size() - begin,
                                                                       std::size_t(20)));
    switch(below(7))
    {
    case 0: text.resize(begin); break;
    case 1: text.erase(begin, n); break;
    case 2: text.insert(below(text.size()), text.substr(begin, n)); break;
    case 3: text.replace(begin, n, words[below(words.size())]); break;
    case 4: text.insert(begin, words[below(words.size())]); break;
    case 5: replace_number(text, begin, words[below(words.size())]); break;
    default:
      if(!text.empty())
        text[begin] = static_cast<char>(below(256));
    }
  }

private:
  static void replace_number(std::string& text, std::size_t begin, const std::string& word)
  {
    const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
    const auto first = std::find_if(text.begin() + begin, text.end(), is_digit);
    text.replace(first, std::find_if_not(first, text.end(), is_digit), word);
  }

  std::mt19937 m_engine;
};

// a file of each format, of an octahedron or of three tetrahedra
Files make_files()
{
  const std::string off = "OFF\n6 8 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n0 0 -1\n"
    "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n3 5 2 1\n3 5 3 2\n3 5 4 3\n3 5 1 4\n";
  Files files = {
    {"in.off", off},
    {"coloured.off", "COFF\n4 2 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 9 8 7\n"
                     "3 0 1 2 3\n3 0 2 3 4\n"},
    {"in.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                "0 0 1 0\n1 1 1 0\n2 1 1 0\nTetrahedra 3\n1 2 3 4 0\n2 3 4 5 1\n2 4 5 6 2\nEnd\n"},
    {"in.sel", "0\n0\n1\n1\n1\n2 # the last\n"},
    {"in.def", "1 0 0 0.1\n0 1 0 0.2\n0 0 1 0\n0 0 0 1\n"},
    {"text.ply", "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty double y\n"
                 "property float z\nproperty uchar red\nelement face 4\n"
                 "property list uint int vertex_indices\nend_header\n0 0 1 1\n1 0 0 1\n0 1 0 1\n"
                 "-1 0 0 1\n0 -1 0 1\n0 0 -1 1\n3 0 1 2\n3 0 2 3\n3 0 3 4\n3 5 2 1\n"},
    {"text.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                 "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n"}};
  for(const auto& [name, text] : files)
    write(name, text);
  for(const std::string name : {"in.obj", "in.ply", "in.stl"})
  {
    test_case() = name;
    CHECK(run("in.off --selection in.sel --transform in.def --iterations 1 -o " + name).exit_code ==
          0);
    files[name] = content(folder / name);
  }
  return files;
}

std::string in_quotes(const std::string& argument)
{
  std::string text;
  for(char c : argument)
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return '\'' + text + '\'';
}

// An argument of a shell, and in no other folder.
bool is_harmless(const std::string& argument)
{
  return std::all_of(argument.begin(), argument.end(),
                     [](unsigned char c) { return std::isprint(c) != 0 && c != '/'; });
}

std::string make_arguments(Changes& changes, const std::string& mesh, bool is_changed)
{
  const std::string kind = mesh.substr(mesh.find('.'));
  std::vector<std::vector<std::string>> options = {
    {mesh}, {"--selection", "in.sel"}, {"--transform", "in.def"}, {"-o", "out" + kind},
    {"--report=r.json"}, {"--iterations", "5"}, {"--cells", "spokes"}, {"--weights", "uniform"},
    {"--minimizer", "quasi_newton"}, {"--initial_guess", "laplacian"}, {"--threads=1"},
    {"--quiet"}};
  options.resize(4 + changes.below(options.size() - 3));
  for(std::size_t i = options.size(); i > 1; --i)
    std::swap(options[i - 1], options[changes.below(i)]);
  std::vector<std::string> arguments;
  for(const auto& option : options)
    arguments.insert(arguments.end(), option.begin(), option.end());
  for(std::size_t i = is_changed ? 1 + changes.below(3) : 0; i > 0 && !arguments.empty(); --i)
  {
    const std::size_t place = changes.below(arguments.size());
    std::string argument = arguments[place];
    switch(changes.below(4))
    {
    case 0: arguments.erase(arguments.begin() + place); break;
    case 1: arguments.insert(arguments.begin() + changes.below(arguments.size()), argument); break;
    default:
      changes.change(argument);
      if(is_harmless(argument))
        arguments[place] = argument;
    }
  }
  std::string text;
  for(const std::string& argument : arguments)
    text += in_quotes(argument) + ' ';
  return text;
}

Files contents()
{
  Files result;
  for(const std::string& name : files())
    result[name] = content(folder / name);
  return result;
}

// What the command must do whatever it is given.
bool is_well_behaved(const Run& done, const Files& before)
{
  const auto lines = std::count(done.err.begin(), done.err.end(), '\n');
  const bool is_readable = std::all_of(done.err.begin(), done.err.end(), [](unsigned char c) {
    return std::isprint(c) != 0 || c == '\n';
  });
  if(done.exit_code == 0)
    return done.err.empty();
  return (done.exit_code == 1 || done.exit_code == 2) && done.out.empty() && is_readable &&
         lines == done.exit_code && done.err.rfind("arap_deform: ", 0) == 0 && contents() == before;
}

int main(int argc, char** argv)
{
  const int runs = argc > 2 ? std::stoi(argv[2]) : 300;
  const unsigned int seed = argc > 3 ? static_cast<unsigned int>(std::stoul(argv[3])) : 1;
  return test_command(argc, argv, [&] {
    limit_command();
    const Files good = make_files();
    const std::vector<std::string> meshes = {"in.off", "coloured.off", "in.obj", "in.ply",
                                             "text.ply", "in.stl", "text.stl", "in.mesh"};
    std::map<int, int> exit_codes;
    for(int i = 0; i < runs; ++i)
    {
      Changes changes(seed + i);
      Files input = good;
      const std::string mesh = meshes[changes.below(meshes.size())];
      const std::size_t changed = changes.below(4); // what: the arguments, the mesh, or others
      if(changed > 0)
        for(std::size_t k = 1 + changes.below(3); k > 0; --k)
          changes.change(input[changed < 3 ? mesh : changes.below(2) ? "in.sel" : "in.def"]);
      for(const auto& entry : fs::directory_iterator(folder))
        fs::remove_all(entry);
      for(const auto& [name, text] : input)
        write(name, text);
      const std::string arguments = make_arguments(changes, mesh, changed == 0);
      test_case() = "seed " + std::to_string(seed + i) + ": " + arguments;
      const Run done = run(arguments);
      ++exit_codes[done.exit_code];
      if(!CHECK(is_well_behaved(done, input)))
        std::cerr << "    exit code " << done.exit_code << ", the message was: " << done.err;
    }
    for(const auto& [code, number] : exit_codes)
      std::cout << number << " runs with the exit code " << code << '\n';
    CHECK(runs < 100 || exit_codes.size() == 3); // each happens, or the changes are too dull
  });
}
