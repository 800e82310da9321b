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

// The command arap_deform with files that lie about their counts, or are damaged otherwise: CGAL's
// readers of them crash, or allocate without bound. script/fuzz finds such files. The path of the
// command is the argument; without it nothing is tested.

#include "include/check.h"
#include "include/command.h"

#include <iostream>
#include <string>

const std::string rest = " --selection in.sel --transform in.def --threads 1 -o new.off";

void refuse(const std::string& extension, const std::string& text, const std::string& phrase)
{
  write("bad." + extension, text);
  check_refused("bad." + extension + rest, 1, "bad." + extension + ": " + phrase);
}

void accept(const std::string& file, const std::string& text)
{
  test_case() = file;
  write(file, text);
  const Run done = run(file + rest);
  if(!CHECK(done.exit_code == 0))
    std::cerr << "    " << done.err;
  fs::remove(folder / "new.off");
}

void test_off()
{
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const std::string good = "OFF\n4 2 0\n" + square + "3 0 1 2\n3 0 2 3\n";
  accept("good.off", good);
  accept("isolated.off", "OFF\n4 1 0\n" + square + "3 0 2 3\n");
  refuse("off", "OFF\n2147483647 2 0\n" + square, "vertex 4 is missing");
  refuse("off", "OFF\n4 2147483647 0\n" + square + "3 0 1 2\n", "face 1 is missing");
  for(const std::string corners : {"4000000000", "1e18", "1e300", "-1", "-1e300", "4", "x"})
    refuse("off", "OFF\n4 2 0\n" + square + "3 0 1 2\n" + corners + " 0 2 3\n",
           "face 1 has fewer vertices than it announces");
  for(const std::string corner : {"-1", "4", "1e300", "-1e300"})
    refuse("off", "OFF\n4 2 0\n" + square + "3 0 1 2\n3 0 2 " + corner + "\n",
           "face 1 has a vertex that does not exist");
  refuse("off", std::string("OFF BINARY\n\0\0\0\4\177\377\377\377\0\0\0\0", 23), "is binary");
  refuse("off", "4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 0\n3 0 1 2\n", "vertex 2 is at infinity");
  refuse("off", "STOFF\n3 1 0\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 0 1\n3 0 1 2\n",
         "has texture coordinates");

  test_case() = "normals of vertices, which the deformation makes wrong";
  write("normals.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
  CHECK(run("normals.off --selection three.sel --transform in.def -o new.off").exit_code == 0);
  CHECK(content(folder / "new.off").substr(0, 3) == "OFF");
  fs::remove(folder / "new.off");

  // colours, which CGAL reads without a look at how many numbers there are
  const auto coloured = [](const std::string& vertex, const std::string& face) {
    return "COFF\n4 2 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 " + vertex +
           "\n3 0 1 2 3\n3 0 2 3 " + face + '\n';
  };
  accept("coloured.off", coloured("0.5 0.25 1 0.5", "255 0 17"));
  for(const std::string none : {"", "1 2"})
  {
    refuse("off", coloured(none, "3"), "vertex 3 has a colour that is neither one number nor");
    refuse("off", coloured("1 2 3", none), "face 1 has a colour that is neither one number nor");
  }
  for(const std::string colour : {"-1", "1e300", "-1 2 3", "1 2 256"})
    refuse("off", coloured("1 2 3", colour), "face 1 has a colour that is not from 0 to 255");
  refuse("off", coloured("1 2 2.5", "3"), "vertex 3 has a colour that is neither of integers");
}

void test_obj()
{
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\n";
  accept("isolated.obj", "v 7 7 7\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4\n");
  accept("good.obj", square + "f -4 -2 -1\n");
  for(const std::string corners : {"1 2 3", "2 3 4 2", "1 2 4"})
    refuse("obj", square + "f " + corners + "\n", "face 1 has a vertex twice, or is no oriented");
  refuse("obj", square + "f 1 3 5\n", "face 1 has a vertex that does not exist");
  refuse("obj", "f 1 2 -3\n" + square, "face 0 has a vertex that does not exist");
  for(const std::string corner : {"6", "-5", "-2147483648", "2147483647", "2147483648"})
    refuse("obj", square + "f 1 3 " + corner + "\n", "");
}

std::string ply(const std::string& format, const std::string& coordinate, const std::string& number,
                const std::string& list, const std::string& more = "")
{
  return "ply\nformat " + format + " 1.0\nelement vertex " + number + "\nproperty " + coordinate +
         " x\nproperty " + coordinate + " y\nproperty " + coordinate + " z\n" + more +
         "element face 2\nproperty list " + list + " vertex_indices\nend_header\n";
}

void test_ply()
{
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", faces = "3 0 1 2\n3 0 2 3\n";
  for(const std::string list : {"uchar int", "int int", "uint32 uint32", "char uint", "short int"})
    accept("good.ply", ply("ascii", "float", "4", list) + square + faces);
  const auto refuse_ply = [&](const std::string& text, const std::string& phrase) {
    refuse("ply", text, phrase);
  };

  // counts
  for(const std::string count : {"4294967295", "18446744073709551615", "-1"})
    refuse_ply(ply("ascii", "float", count, "uchar int") + square + faces,
               "announces more elements than fit into its ");
  for(const std::string size : {"uint", "int"})
  {
    refuse_ply(ply("ascii", "float", "4", size + " int") + square + "3 0 1 2\n2000000000 0 2 3\n",
               "announces more entries of vertex_indices than fit into its ");
    refuse_ply(ply("ascii", "float", "4", size + " int") + square + "3 0 1 2\n99999999999 0 2 3\n",
               "ends before all its elements, or holds something that is not a number");
    for(const std::string format : {"binary_little_endian", "binary_big_endian"})
      refuse_ply(ply(format, "float", "1", size + " int") + std::string(12, '\0') +
                   std::string(12, '\177'),
                 "announces more entries of vertex_indices than fit into its ");
  }
  refuse_ply(ply("ascii", "float", "4", "char int") + square + "3 0 1 2\n-1 0 2 3\n",
             "cannot be read");
  refuse_ply("ply\nformat ascii 1.0\nelement vertex 9999999999999\nend_header\n",
             "announces more elements");

  // corners
  for(const std::string corner : {"4", "-1", "2147483647"})
    refuse_ply(ply("ascii", "float", "4", "uchar int") + square + "3 0 1 2\n3 0 2 " + corner + "\n",
               "face 1 has a vertex that does not exist");

  // types
  refuse_ply("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "has a property before any");
  refuse_ply(ply("ascii", "int", "4", "uchar int") + square + faces, "the property x is not float");
  refuse_ply(ply("ascii", "list uchar float", "4", "uchar int") + square + faces,
             "the property x is not float or double");
  refuse_ply(ply("ascii", "quad", "4", "uchar int") + square + faces, "has a property of an");
  refuse_ply(ply("ascii", "float", "4", "uchar short") + square + faces,
             "the property vertex_indices is not a list of int or uint");
  refuse_ply(ply("ascii", "float", "4", "float int") + square + faces, "has a list with a");
  const std::string coloured = "0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n";
  refuse_ply(ply("ascii", "float", "4", "uchar int", "property uchar red\nproperty float blue\n") +
               coloured + faces, "the property blue is not uchar");
  const std::string halfedges = "element halfedge 1\nproperty int source\nproperty int target\n";
  refuse_ply(ply("ascii", "float", "4", "uchar int", halfedges) + square + "0 1\n" + faces,
             "the property source is not uint");
  refuse_ply("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n", "has no end of its");
}

void test_stl()
{
  refuse("stl", std::string(80, 'x') + std::string(4, '\377') + std::string(50, '\0'),
         "cannot be read");
  refuse("stl", std::string(80, 'x'), "");
}

void test_text_files()
{
  write("odd.def", "1 0 0 0\n0 1 0 \33[2J" + std::string(1000, 'x') + "\n");
  check_refused("good.off --selection in.sel --transform odd.def -o new.off", 1,
                "odd.def, line 2: '?[2Jxxx");
  test_case() = "a large transform";
  write("large.def", "1e60 0 0 0\n0 1e60 0 0\n0 0 1e60 0\n0 0 0 1\n");
  CHECK(run("good.off --selection in.sel --transform large.def -o new.off").exit_code == 0);
  fs::remove(folder / "new.off");
  // arguments that Boost.Program_options takes for its own placeholders
  for(const std::string option : {"--iterations %value%", "--%canonical_option% 3"})
    check_refused("good.off " + option + rest, 2, "an option is missing, not known or given twice");
  check_refused("'' --selection in.sel --transform in.def -o new.off", 2, "a file is empty");
}

int main(int argc, char** argv)
{
  return test_command(argc, argv, [] {
    limit_command();
    write("precious.off", "precious");
    write("in.sel", "0\n0\n1\n2\n");
    write("three.sel", "0\n0\n2\n");
    write("in.def", "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    test_off();
    test_obj();
    test_ply();
    test_stl();
    test_text_files();
  });
}
