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

// The command arap_deform with files, arguments, pipes and signals that are made to break it.
// usage: test_command_files PATH_OF_ARAP_DEFORM [NUMBER_OF_RUNS [FIRST_SEED]]

#include "include/check.h"
#include "include/command.h"

#ifdef __linux__
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// The command arap_deform with files that lie about their counts, or are damaged otherwise: CGAL's
// readers of them crash, or allocate without bound. script/fuzz finds such files. The path of the
// command is the argument; without it nothing is tested.
namespace damaged {

const std::string rest = " --selection in.sel --transform in.def --threads 1 -o new.off";

void refuse(const std::string& extension, const std::string& text, const std::string& phrase)
{
  write("bad." + extension, text);
  check_refused("bad." + extension + rest, 1, "bad." + extension + ": " + phrase);
}

void refuse_at(int line, const std::string& extension, const std::string& text,
               const std::string& phrase)
{
  write("bad." + extension, text);
  check_refused("bad." + extension + rest, 1,
                "bad." + extension + ", line " + std::to_string(line) + ": " + phrase);
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
  const std::string surplus = "there is more than the 4 vertices and 2 faces that the header "
                              "announces";
  refuse_at(9, "off", good + "3 0 1 3\n", surplus);
  refuse_at(11, "off", good + "\n# a comment\n 3 0 1 3", surplus);
  accept("comment.off", good + "\n # a comment");
  // a closed fan of three faces and an open one, which meet in vertex 0, in orders that CGAL takes
  // for one fan, or not
  const std::string fans = "OFF\n8 6 0\n0 0 0\n-1 1 0\n-1 -.5 .8\n-1 -.5 -.8\n1 1 0\n1 .2 .9\n"
                           "1 -.8 .4\n1 -.6 -.7\n";
  refuse("off", fans + "3 5 0 4\n3 6 7 0\n3 3 1 0\n3 0 1 2\n3 0 2 3\n3 6 0 5\n",
         "the surface is not a manifold at vertex 0");
  refuse("off", fans + "3 6 0 5\n3 0 2 3\n3 0 1 2\n3 3 1 0\n3 6 7 0\n3 5 0 4\n",
         "face 3 does not form a manifold with the previous faces at one of its vertices");
  refuse("off", "OFF\n2147483647 2 0\n" + square, "vertex 4 is missing");
  refuse("off", "OFF\n4 2147483647 0\n" + square + "3 0 1 2\n", "face 1 is missing");
  for(const std::string row : {"1 nan 0", "1 x 0", "1 0", "1,5 0 0", "1e999 0 0", "1 0 0,5",
                              "1 0 0abc", "1-2 0 3", "0x1 0 0"})
    refuse("off", "OFF\n4 1 0\n0 0 0\n" + row + "\n1 1 0\n0 1 0\n3 0 2 3\n",
           "vertex 1 does not have three finite coordinates");
  for(const std::string corners : {"4000000000", "1e18", "1e300", "-1", "-1e300", "4", "x"})
    refuse("off", "OFF\n4 2 0\n" + square + "3 0 1 2\n" + corners + " 0 2 3\n",
           "face 1 has fewer vertices than it announces");
  for(const std::string corner : {"-1", "4", "1e300", "-1e300"})
    refuse("off", "OFF\n4 2 0\n" + square + "3 0 1 2\n3 0 2 " + corner + "\n",
           "face 1 has a vertex that does not exist");
  refuse("off", "OFF\n4 2\n" + square + "3 0 1 2\n3 0 2 3\n", "the header has no number of edges");
  accept("lines.off", "OFF\n4\n2\n0\n" + square + "3 0 1 2\n3 0 2 3\n");
  for(const std::string header : {"4COFF", "C4OFF", "4 2 0", "OFF\nx"})
    refuse("off", header + "\n4 2 0\n" + square, "does not start with a header that can be read");
  refuse("off", std::string("OFF BINARY\n\0\0\0\4\177\377\377\377\0\0\0\0", 23), "is binary");
  refuse("off", "4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 0\n3 0 1 2\n", "vertex 2 is at infinity");
  refuse("off", "STOFF\n3 1 0\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 0 1\n3 0 1 2\n",
         "has texture coordinates");

  test_case() = "normals of vertices, which the deformation makes wrong";
  write("normals.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
  CHECK(run("normals.off --selection three.sel --transform in.def -o new.off").exit_code == 0);
  CHECK(content(folder / "new.off").substr(0, 3) == "OFF");
  fs::remove(folder / "new.off");

  // colors, which CGAL reads without a look at how many numbers there are
  const auto colored = [](const std::string& vertex, const std::string& face) {
    return "COFF\n4 2 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 " + vertex +
           "\n3 0 1 2 3\n3 0 2 3 " + face + '\n';
  };
  accept("colored.off", colored("0.5 0.25 1 0.5", "255 0 17"));
  for(const std::string none : {"", "1 2"})
  {
    refuse("off", colored(none, "3"), "vertex 3 has a color that is neither one number nor");
    refuse("off", colored("1 2 3", none), "face 1 has a color that is neither one number nor");
  }
  for(const std::string color : {"-1", "1e300", "-1 2 3", "1 2 256"})
    refuse("off", colored("1 2 3", color), "face 1 has a color that is not from 0 to 255");
  refuse("off", colored("1 2 2.5", "3"), "vertex 3 has a color that is neither of integers");
  refuse("off", "COFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0 1 2 3\n3 0 1 2\n",
         "vertex 2 has a color, though");
}

void test_obj()
{
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\n";
  accept("isolated.obj", "v 7 7 7\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4\n");
  accept("good.obj", square + "f -4 -2 -1\n");
  for(const std::string corners : {"1 2 3", "1 2 4"})
    refuse("obj", square + "f " + corners + "\n", "face 1 has an edge, from vertex 0 to 1, which "
                                                  "face 0 has in the same direction");
  refuse("obj", square + "f 2 3 4 2\n", "face 1 has a vertex twice");
  refuse("obj", square + "v 2 0 0\nv 2 1 0\nf 1 3 4\nf 1 4 2\nf 1 5 6\n",
         "face 3 does not form a manifold with the previous faces at one of its vertices");
  refuse_at(1, "obj", "v 0x1 0 0\n" + square, "'0x1' is not a finite number");
  refuse_at(1, "obj", "f 1 2 -3\n" + square, "a face has the vertex '-3', which does not exist");
  for(const std::string corner : {"5", "2147483648", "9223372036854775807"})
    refuse_at(6, "obj", square + "f 1 3 " + corner + "\nf 1 2 4\n",
              "a face has the vertex " + corner + ", which does not exist");
  for(const std::string corner : {"-5", "-2147483648", "-99999999999999999999"})
    refuse_at(6, "obj", square + "f 1 3 " + corner + "\n", "a face has the vertex '" + corner);

  // what CGAL's reader takes for errors, or for the end of a face
  accept("statements.obj", "mtllib my.mtl\no a\nv 0 0 0\nv 1 0 0 # \\\nv 1 \\\n 1 0\r\n\n"
                           "v 0 1 0 1\nvt 0 0\nvn 0 0 1\nvp 1 2\ng b c\nusemtl d\ns off\nl 1 2\n"
                           "p 4\nf 1/1/1\t2/1 3//1\nf 1 -2 \\\r\n -1\n\\");
  CHECK(run("statements.obj" + rest).exit_code == 0);
  CHECK(content(folder / "new.off").find("\n4 2 0\n") != std::string::npos);
  fs::remove(folder / "new.off");
  for(const std::string corner : {"0", "x", "1.5", "-", "/1"})
    refuse_at(6, "obj", square + "f 1 3 " + corner + "\n", "'" + corner + "' is not a corner");
  refuse_at(6, "obj", square + "f 1 3\n", "a face has at least three vertices");
  for(const std::string normal : {"0 1", "0 1 nan", "0 1 2x"})
    refuse_at(6, "obj", square + "vn " + normal + "\nvn 0 0 1\n",
              "a normal has three finite numbers");
  refuse_at(6, "obj", square + "v 1 2\n", "a vertex has three coordinates");
  refuse_at(7, "obj", square + "\nv 1 nan 2\n",
            "'nan' is not a finite number");
  refuse_at(8, "obj", square + "l 1 \\\n 2\ncall other.obj\n", "'call' is not a statement");
  refuse("obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "has no faces");
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

  const std::string lost = "ends before all its elements, or has something that is not a finite "
                           "number in the property 'vertex_indices'";

  // counts
  for(const std::string count : {"4294967295", "18446744073709551615", "-1"})
    refuse_ply(ply("ascii", "float", count, "uchar int") + square + faces,
               "announces more elements than fit into its ");
  for(const std::string size : {"uint", "int"})
  {
    refuse_ply(ply("ascii", "float", "4", size + " int") + square + "3 0 1 2\n2000000000 0 2 3\n",
               "announces more entries of 'vertex_indices' than fit into its ");
    refuse_ply(ply("ascii", "float", "4", size + " int") + square + "3 0 1 2\n99999999999 0 2 3\n",
               lost);
    for(const std::string format : {"binary_little_endian", "binary_big_endian"})
      refuse_ply(ply(format, "float", "1", size + " int") + std::string(12, '\0') +
                   std::string(12, '\177'),
                 "announces more entries of 'vertex_indices' than fit into its ");
  }
  refuse_ply(ply("ascii", "float", "4", "char int") + square + "3 0 1 2\n-1 0 2 3\n",
             "cannot be read");
  refuse_ply("ply\nformat ascii 1.0\nelement vertex 9999999999999\nend_header\n",
             "announces more elements");

  // rows
  for(const std::string end : {"", "3 0 1\n", "3 0 2 x\n"})
    refuse_ply(ply("ascii", "float", "4", "uchar int") + square + "3 0 1 2\n" + end,
               lost);
  const std::string good = ply("ascii", "float", "4", "uchar int") + square + faces;
  const std::string surplus = "more than the elements that the header announces";
  refuse_at(16, "ply", good + "3 0 1 3\n", "there is " + surplus);
  const std::string origin(12, '\0');
  refuse_ply("ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
             "property float y\nproperty float z\nend_header\n" + origin + "\n\1",
             "has " + surplus);

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
  refuse_ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nelement "
             "face 1\nproperty list uchar int vertex_indices\nend_header\n0 0\n1 0\n1 1\n3 0 1 2\n",
             "the vertices have no property z");
  refuse_ply(ply("ascii", "float", "2", "uchar int", "property float quality\n") +
               "0 0 0 1\n1 0 0 nan\n", "ends before all its elements, or has something that is not "
                                        "a finite number in the property 'quality'");
  refuse_ply(ply("ascii", "float", "4", "uchar short") + square + faces,
             "the property vertex_indices is not a list of int or uint");
  refuse_ply(ply("ascii", "float", "4", "float int") + square + faces, "has a list with a");
  const std::string colored = "0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n";
  refuse_ply(ply("ascii", "float", "4", "uchar int", "property uchar red\nproperty float blue\n") +
               colored + faces, "the property blue is not uchar");
  const std::string halfedges = "element halfedge 1\nproperty int source\nproperty int target\n";
  refuse_ply(ply("ascii", "float", "4", "uchar int", halfedges) + square + "0 1\n" + faces,
             "the property source is not uint");
  refuse_ply("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n", "has no end of its");

  // the coordinates are not in single precision because something else is
  const std::string camera = "element camera 1\nproperty float x\n";
  write("camera.ply",
        ply("ascii", "double", "4", "uchar int", camera) + square + "0.5\n" + faces);
  CHECK(run("camera.ply --handle list:0 --move 1e39,0,0 -o new.ply").exit_code == 0);
  CHECK(content(folder / "new.ply").find("\n0.5\n") != std::string::npos);
  fs::remove(folder / "new.ply");
  // CGAL writes the number of corners as one byte
  std::string disc, face = "f";
  for(int k = 0; k < 300; ++k)
  {
    disc += "v " + std::to_string(std::cos(k * 0.02)) + ' ' + std::to_string(std::sin(k * 0.02)) +
            " 0\n";
    face += ' ' + std::to_string(k + 1);
  }
  write("disc.obj", disc + face + '\n');
  check_refused("disc.obj --handle list:0 --move 0,0,1 -o new.ply", 1,
                "new.ply: the faces of a .ply file that is made have at most 255 vertices, but "
                "face 0 has 300");
}

// the bytes of a number
template <typename Number>
std::string bytes(Number value, bool is_reversed)
{
  std::string result(reinterpret_cast<const char*>(&value), sizeof(value));
  if(is_reversed)
    std::reverse(result.begin(), result.end());
  return result;
}

void test_format_of_ply()
{
  test_case() = "a line before the format of a .ply file";
  for(const std::string line : {"comment by hand", "obj_info by a scanner", "comment", "obj_info"})
    refuse("ply", "ply\n" + line + "\nformat ascii 1.0\n",
           "can be read only if the second line is the one that starts with 'format'");
}

void test_stl()
{
  refuse("stl", std::string(80, 'x') + std::string(4, '\377') + std::string(50, '\0'),
         "is neither text, which starts with 'solid', nor a whole binary file: it ends before");
  refuse("stl", std::string(80, 'x'), "");
  const std::string one(std::string(80, 'x') + std::string("\1\0\0\0", 4) +
                        std::string(50, '\0'));
  refuse("stl", one + std::string(50, '\1'),
         "is neither text, which starts with 'solid', nor a whole binary file: it has more");

  // the same triangles, also in forms that CGAL takes for those of a binary file or misreads
  const auto text_of = [](const std::string& start, const std::string& end, bool is_upper_case) {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex ";
    std::string text = facet + "1 0 0\nvertex 1 1 0\nendloop\nendfacet\n" + facet +
                       "1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";
    if(is_upper_case)
      std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return static_cast<char>(std::toupper(c));
      });
    return start + text + end;
  };
  std::string binary = "solid, but binary" + std::string(63, ' ') + std::string("\2\0\0\0", 4);
  for(const auto& corners : {std::array<float, 6>{1, 0, 0, 1, 1, 0}, {1, 1, 0, 0, 1, 0}})
  {
    binary += std::string(24, '\0'); // the normal, and the first corner
    for(float coordinate : corners)
      binary += bytes(coordinate, false);
    binary += "ab";
  }
  std::string expected;
  for(const std::string& text : {text_of("solid a\n", "endsolid a\n", false),
                                 text_of("Solid Unity Mesh\n", "endsolid\n", false),
                                 text_of("SOLID A\r\n", "ENDSOLID A\r\n", true),
                                 text_of("solid\ta\n", "endsolid\ta\n", false),
                                 text_of("solid solid facet\n", "endsolid vertex facet\n", false),
                                 text_of(" solid ", "endsolid", false), binary,
                                 replaced(binary, "solid,", "solid ")})
  {
    test_case() = "an .stl file that starts with " + text.substr(0, 17);
    write("any.stl", text);
    CHECK(run("any.stl --handle list:2 --move 0,0,0 -o new.off").exit_code == 0);
    const std::string read = content(folder / "new.off");
    if(expected.empty())
      expected = read;
    CHECK(read == expected && read.find("\n4 2 0\n") != std::string::npos);
    fs::remove(folder / "new.off");
  }
  refuse("stl", text_of("solid a\n", "", false), "cannot be read");

  test_case() = "a triangle of an .stl file with two equal corners";
  write("flat.stl", text_of("solid a\nfacet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 1 0 0\n"
                            "vertex 1 1 0\nendloop\nendfacet\n", "endsolid a\n", false));
  const Run done = run("flat.stl --handle list:2 --move 0,0,0 -o new.off");
  CHECK(done.exit_code == 0 && done.err.find("triangles with two equal corners") !=
                                 std::string::npos);
  CHECK(content(folder / "new.off").find("\n4 2 0\n") != std::string::npos);
  fs::remove(folder / "new.off");
  const auto triangle = [](const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
  };
  refuse("stl", "solid a\n" + triangle("0 0 0", "0 0 0", "1 0 0") +
                  triangle("0 0 0", "1 0 0", "0 1 0") + triangle("1 0 0", "1 0 0", "0 1 0") +
                  triangle("0 0 0", "1 0 0", "0 0 1") + "endsolid a\n",
         "face 3 has an edge, from vertex 0 to 1, which face 1 has in the same direction");
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
  // arguments that Boost.Program_options takes for its own placeholders, or for a part of them
  const auto refuse_option = [](const std::string& option, const std::string& phrase) {
    check_refused("good.off " + option + rest, 2, phrase);
  };
  refuse_option("--iterations %value%", "--iterations '%value%' is not a whole number from 0 to 4");
  refuse_option("--tolerance 1%", "--tolerance '1%' is not a number");
  refuse_option("--iterations 9999999999", "--iterations '9999999999' is not a whole number from");
  for(const std::string option : {"--%canonical_option%", "-%option%", "--x%=3"})
    refuse_option(option, "the option '" + option + "' is not known");
  refuse_option("--quiet=%canonical_option%", "option '--quiet' does not take any arguments");
  refuse_option("--output=50%.off", "'--output' cannot be specified more than once");
  check_refused("'' --selection in.sel --transform in.def -o new.off", 2,
                "the name of the mesh is empty");
  for(const std::string option : {"report", "image", "animation", "color", "save-selection",
                                  "save-transform", "transform"}) // a variable that is not set
    refuse_option("--" + option + " ''", "the value of --" + option + " is empty");
  refuse_option("--save_selection ''", "the value of --save-selection is empty");
  refuse_option("--save_transform ''", "the value of --save-transform is empty");
}

// Editors put a byte order mark at the start of a text, shells of Windows write UTF-16.
void test_byte_order_marks()
{
  const std::string mark = "\xEF\xBB\xBF", square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  accept("marked.off", mark + "OFF\n4 2 0\n" + square + "3 0 1 2\n3 0 2 3\n");
  accept("marked.obj", mark + "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  accept("marked.ply", mark + ply("ascii", "float", "4", "uchar int") + square +
                         "3 0 1 2\n3 0 2 3\n");
  accept("marked.stl", mark + "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                              "vertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nfacet normal 0 0 1\n"
                              "outer loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
                              "endfacet\nendsolid a\n");
  test_case() = "byte order marks";
  write("marked.mesh", mark + "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 1\n"
                              "1 0 0 1\n0 1 0 1\n0 0 1 1\nTetrahedra\n1\n1 2 3 4 1\nEnd\n");
  write("marked.sel", mark + "0\n0\n1\n2\n");
  write("marked.def", mark + "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  CHECK(run("marked.mesh --selection marked.sel --transform marked.def -o new.mesh").exit_code ==
        0);
  CHECK(content(folder / "new.mesh").rfind("MeshVersionFormatted 1\n", 0) == 0);
  fs::remove(folder / "new.mesh");
  for(const std::string extension : {"off", "obj", "ply", "stl"})
    refuse(extension, mark, "is empty");
  write("wide.sel", std::string("\xFF\xFE" "0\0\n\0", 6));
  check_refused("good.off --selection wide.sel --transform in.def -o new.off", 1,
                "wide.sel: is a text in UTF-16; save it in UTF-8");
}

// What an output does not keep is said.
void test_notes()
{
  const auto check_note = [](const std::string& file, const std::string& output,
                             const std::string& list) {
    test_case() = file + " to " + output;
    const std::string call = file + " --selection in.sel --transform in.def -o " + output;
    CHECK(run(call).err == (list.empty() ? "" : "note: " + output + " does not keep: " + list +
                                                  '\n'));
    CHECK(run(call + " --quiet").err.empty());
    fs::remove(folder / output);
  };
  const auto faces = [](const std::string& color) {
    return "3 0 1 2" + color + "\n3 0 2 3" + color + '\n';
  };
  check_note("good.off", "new.obj", "");
  check_note("good.off", "new.stl", "double precision");
  write("colors.off", "COFF\n4 2 0\n0 0 0 1 2 3\n1 0 0 1 2 3\n1 1 0 1 2 3\n0 1 0 1 2 3\n" +
                         faces(" 1 2 3"));
  check_note("colors.off", "new.off", "");
  check_note("colors.off", "new.ply", "");
  write("clear.off", "COFF\n4 2 0\n0 0 0 1 2 3 9\n1 0 0 1 2 3 9\n1 1 0 1 2 3 9\n0 1 0 1 2 3 9\n" +
                       faces(""));
  check_note("clear.off", "new.ply", "transparency of colors");
  for(const std::string opaque : {"1 2 3 255", "0 1 0 255", "0.5 1 0 1"})
  {
    std::string text = content(folder / "clear.off");
    for(std::size_t place; (place = text.find("1 2 3 9")) != std::string::npos;)
      text.replace(place, 7, opaque);
    write("opaque.off", text);
    check_note("opaque.off", "new.ply", "");
  }
  write("indices.off", "COFF\n4 2 0\n0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n" + faces(""));
  check_note("indices.off", "new.off", "");
  check_note("indices.off", "new.ply", "indices of colors");
  check_note("colors.off", "new.obj", "colors");
  const auto ply_of = [](const std::string& vertex_color, const std::string& face_color) {
    write("some.off", "COFF\n4 2 0\n0 0 0" + vertex_color + "\n1 0 0" + vertex_color + "\n1 1 0" +
                      vertex_color + "\n0 1 0" + vertex_color + "\n3 0 1 2" + face_color +
                      "\n3 0 2 3" + face_color + '\n');
    CHECK(run("some.off --selection in.sel --transform in.def -o new.ply").exit_code == 0);
    const std::string text = content(folder / "new.ply");
    const std::size_t faces_begin = text.find("element face");
    fs::remove(folder / "new.ply");
    return std::pair(text.substr(0, faces_begin).find("red") != std::string::npos,
                     text.find("red", faces_begin) != std::string::npos);
  };
  test_case() = "colors of vertices or of faces only";
  CHECK(ply_of(" 1 2 3", "") == std::pair(true, false));
  CHECK(ply_of("", " 1 2 3") == std::pair(false, true));
  CHECK(ply_of(" 1 2 3", " 1 2 3") == std::pair(true, true));
  write("faces.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces(" 1 2 3"));
  check_note("faces.off", "new.off", "");
  check_note("faces.off", "new.ply", "colors");
  write("vertices.off", "OFF\n4 2 0\n0 0 0 1 2 3\n1 0 0 1 2 3\n1 1 0 1 2 3\n0 1 0 1 2 3\n" +
                          faces(""));
  check_note("vertices.off", "new.obj", "colors");
  write("normals.off", "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n" +
                         faces(""));
  check_note("normals.off", "new.off", "normals");
  const std::string row = " 0 0 1 1 2 3 0.25 0.75\n"; // a normal, a color, and a place in a texture
  write("textured.off", "STCNOFF\n4 2 0\n0 0 0" + row + "1 0 0" + row + "1 1 0" + row + "0 1 0" +
                          row + faces(""));
  check_note("textured.off", "new.off", "normals");
  check_note("textured.off", "new.ply", "normals, texture coordinates");
  CHECK(run("textured.off --selection in.sel --transform in.def -o new.off").exit_code == 0);
  CHECK(content(folder / "new.off").find("0.25 0.75\n") != std::string::npos);
  write("isolated.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 2 3\n");
  check_note("isolated.off", "new.stl", "double precision, vertices without a face");
  check_note("statements.obj", "new.off", "curves and free-form surfaces, groups, lines, "
                                          "materials, normals, points, texture coordinates");
  write("colors.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n"
                       "f 1 3 4\n");
  check_note("colors.obj", "new.obj", "");
  check_note("colors.obj", "new.off", "colors");
  write("more.ply", ply("ascii", "float", "4", "uchar int",
                        "property float nx\nproperty uchar red\nproperty int quality\n"
                        "element edge 1\nproperty int a\n") +
                      "0 0 0 1 2 3\n1 0 0 1 2 3\n1 1 0 1 2 3\n0 1 0 1 2 3\n7\n" + faces(""));
  check_note("more.ply", "new.ply", "");
  check_note("more.ply", "new.off", "colors, normals, the element 'edge', the property 'quality'");
  write("alpha.ply", ply("ascii", "float", "4", "uchar int",
                         "property uchar red\nproperty uchar alpha\nelement edge 0\n"
                         "property int a\n") +
                       "0 0 0 1 2\n1 0 0 1 2\n1 1 0 1 2\n0 1 0 1 2\n" + faces(""));
  check_note("alpha.ply", "new.off", "colors"); // no edges, as there are none
}

// In the format of the input only coordinates change, and normals turn. Here two triangles share an
// edge on the y axis, and one turns about it, so that its last vertex goes from x = -1 to z = 1.
void test_kept()
{
  write("quarter.def", "0 0 1 0\n0 1 0 0\n-1 0 0 0\n0 0 0 1\n");
  const auto deformed = [](const std::string& file, const std::string& text,
                           const std::string& dropped = "") {
    test_case() = file;
    write(file, text);
    const std::string output = "new" + file.substr(file.find('.'));
    const Run done = run(file + " --fix x:0.. --handle x:..-1 --transform quarter.def -o " +
                         output);
    const std::string note = dropped.empty() ? "" : "note: " + output + " does not keep: " +
                                                      dropped + '\n';
    if(!CHECK(done.exit_code == 0 && done.err == note))
      std::cerr << "    " << done.err;
    return content(folder / output);
  };
  CHECK(deformed("kept.off",
                 "COFF # a comment\n4 2 5\n\n0.0 -1 0e3 1 2 3 # color\n+1 0 0\t4 5 6\n"
                 "0 1 0 7 8 9\n# another\n -1.00 0.5  0 1 1 1\n3 0 1 2 7\n3 0 2 3 8 # end") ==
        "COFF # a comment\n4 2 5\n\n0.0 -1 0e3 1 2 3 # color\n+1 0 0\t4 5 6\n"
        "0 1 0 7 8 9\n# another\n 0 0.5  1 1 1 1\n3 0 1 2 7\n3 0 2 3 8 # end");

  const std::string start = "# a comment\r\nmtllib my.mtl\r\no a\nv 0.0 -1 0e3\n\tv 1 \\\n 0 0 0.5 "
                            "0.5 0.5 # color\nv 0 1 0 1.0\nvt 0 0\nvt 1 0.50\nvn 0 0 1.0\n";
  const std::string end = "g b c\nusemtl red\ns 1\nf 1/1/1 2/1/1 3/2/1\nusemtl blue\n"
                          "f 3/1/2 -1/2/-1 1/2/2\nl 1 2";
  std::string obj = deformed("kept.obj", start + "v -1.00 0.5 0\nvn 0 0 2\nvn 0 1 0\n" + end);
  const std::size_t turned = start.size() + std::string("v 0 0.5 1\n").size();
  CHECK(obj.substr(0, turned) == start + "v 0 0.5 1\n"); // the first normal is as it was
  CHECK(obj.size() > turned + end.size() && obj.substr(obj.size() - end.size()) == end);
  std::istringstream normals(obj.substr((std::min)(turned, obj.size())));
  for(const auto& expected : {std::array<double, 3>{2, 0, 0}, {0, 1, 0}})
  {
    std::string keyword;
    CHECK(normals >> keyword && keyword == "vn");
    for(int k = 0; k < 3; ++k)
    {
      double value = 7;
      normals >> value;
      CHECK_AT_MOST(std::abs(value - expected[k]), 1e-12);
    }
  }

  // no normal after the last slash is none, and not the number of the next vertex
  const std::string four = "v 0 -1 0\nv 1 0 0\nv 0 1 0\nv -1 0.5 0\nvn 0 0 1\nvn 0 0.5 1\n";
  const auto normals_of = [&](const std::string& corner) {
    const std::string all = deformed("some.obj", four + "f 1//1 2//1 3//1\nf " + corner +
                                                 " 1//2 3//2\n");
    return all.substr(all.find("vn"), all.find('f') - all.find("vn"));
  };
  CHECK(normals_of("4//") == normals_of("4") && normals_of("4/7/") == normals_of("4"));
  CHECK(normals_of("4//1") != normals_of("4"));

  const std::string two = // coordinates of a normal
    ply("ascii", "float", "4", "uchar int", "property float nx\nproperty float ny\n") +
    "0 -1 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n";
  CHECK(deformed("two.ply", two + "-1 0.5 0 1 2\n3 0 1 2\n3 0 2 3\n") ==
        two + "0 0.5 1 1 2\n3 0 1 2\n3 0 2 3\n");
  const std::string mixed = // a normal of other types than CGAL reads
    ply("ascii", "float", "4", "uchar int",
        "property float nx\nproperty float ny\nproperty int nz\n") +
    "0 -1 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n";
  const std::string integers = "the directions of normals, which are integers and do not turn";
  CHECK(deformed("mixed.ply", mixed + "-1 0.5 0 1 2 3\n3 0 1 2\n3 0 2 3\n", integers) ==
        mixed + "0 0.5 1 1 2 3\n3 0 1 2\n3 0 2 3\n");

  const std::string normals_of_faces = "property float nx\nproperty double ny\nproperty float nz\n",
                    list = "property list uchar int vertex_indices\n";
  for(const bool are_apart : {false, true}) // in two elements
  {
    std::string text = ply("ascii", "float", "4", "uchar int");
    text.insert(text.find("end_header"), normals_of_faces);
    if(are_apart)
    {
      text.replace(text.find("face 2"), 6, "face 1");
      text.insert(text.find("end_header"), "element faces 1\n" + list + normals_of_faces);
    }
    text = deformed("of_faces.ply", text + "0 -1 0\n1 0 0\n0 1 0\n-1 0.5 0\n3 0 1 2 0 0 1\n"
                                           "3 0 2 3 0 1 2\n");
    const std::string kept = "0 0.5 1\n3 0 1 2 0 0 1\n3 0 2 3 ";
    const std::size_t place = text.find(kept);
    if(!CHECK(place != std::string::npos))
      continue;
    double x = 0, y = 0, z = 0;
    std::istringstream(text.substr(place + kept.size())) >> x >> y >> z;
    CHECK_AT_MOST(std::abs(x - 2) + std::abs(y - 1) + std::abs(z), 1e-12);
  }

  const auto header = [](const std::string& format) {
    return "ply\nformat " + format + " 1.0\ncomment by hand\nelement lists 1\n"
           "property list uchar short things\nelement vertex 4\nproperty int before\n"
           "property double z\nproperty float x\nproperty float y\nproperty uchar red\n"
           "element face 2\nproperty uchar quality\nproperty list uchar int vertex_indices\n"
           "element edge 1\nproperty int a\nend_header\n";
  };
  CHECK(deformed("kept.ply", header("ascii") + "2 8 9\n1 0.0 0 -1 9\n2 0 1.0 0 9\n3 0 0 1 9\n"
                                               "4 0 -1 0.50 9\n5 3 0 1 2\n6 3 0 2 3\n 7") ==
        header("ascii") + "2 8 9\n1 0.0 0 -1 9\n2 0 1.0 0 9\n3 0 0 1 9\n"
                          "4 1 0 0.50 9\n5 3 0 1 2\n6 3 0 2 3\n 7");
  for(const bool is_big : {false, true})
  {
    const auto binary = [&](double x, double z) {
      const std::string format = is_big ? "binary_big_endian" : "binary_little_endian";
      std::string text = header(format) + '\2' + bytes<short>(8, is_big) + bytes<short>(9, is_big);
      for(const auto& p : {std::array<double, 3>{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {x, 0.5, z}})
        text += bytes<int>(4, is_big) + bytes<double>(p[2], is_big) +
                bytes<float>(static_cast<float>(p[0]), is_big) +
                bytes<float>(static_cast<float>(p[1]), is_big) + '\x9';
      for(const auto& corners : {std::array<int, 3>{0, 1, 2}, {0, 2, 3}})
      {
        text += "\5\3";
        for(int corner : corners)
          text += bytes<int>(corner, is_big);
      }
      return text + bytes<int>(7, is_big);
    };
    CHECK(deformed("kept.ply", binary(-1, 0)) == binary(0, 1));
  }
}

// A property goes behind each row of a binary file, also where a coordinate that moves follows.
void test_color()
{
  test_case() = "a property of a binary file";
  const auto binary = [](const std::string& property, float step, std::string error = "") {
    std::string text = ply("binary_little_endian", "float", "4", "uchar int", property);
    if(error.empty() && !property.empty())
      error = std::string(4, '\0');
    for(const auto& [x, y] : {std::pair(0.f, 0.f), {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}})
      text += bytes(x + step, false) + bytes(y, false) + bytes(0.f, false) + error;
    for(const auto& corners : {std::array<int, 3>{0, 1, 2}, {0, 2, 3}})
    {
      text += '\3';
      for(int corner : corners)
        text += bytes(corner, false);
    }
    return text;
  };
  write("binary.ply", binary("", 0));
  CHECK(run("binary.ply --handle x:0.. --move 1,0,0 --color edge_error -o new.ply").exit_code == 0);
  CHECK(content(folder / "new.ply") == binary("property float edge_error\n", 1));
  const std::string in_double = "property double edge_error\n"; // is written over
  write("binary.ply", binary(in_double, 0, bytes(7.0, false)));
  CHECK(run("binary.ply --handle x:0.. --move 1,0,0 --color edge_error -o new.ply").exit_code == 0);
  CHECK(content(folder / "new.ply") == binary(in_double, 1, bytes(0.0, false)));

  test_case() = "a property of a text with ends of lines of two characters";
  std::string text = ply("ascii", "float", "4", "uchar int", "property int area \n") +
                     "0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n3 0 1 2\n3 0 2 3\n";
  for(std::size_t place = 0; (place = text.find('\n', place)) != std::string::npos; place += 2)
    text.insert(place, 1, '\r');
  write("returns.ply", text);
  CHECK(run("returns.ply --handle x:0.. --move 0,0,0 --color area -o new.ply").exit_code == 0);
  const std::string colored = content(folder / "new.ply");
  CHECK(colored.find("property int area \r\nproperty float area_\r\n") != std::string::npos);
  CHECK(colored.find("\r\n1 0 0 7 0\r\n") != std::string::npos);

  test_case() = "a property that there is";
  const std::string start = ply("ascii", "float", "4", "uchar int", "property float spike\n");
  write("again.ply", start + "0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n3 0 1 2\n3 0 2 3\n");
  CHECK(run("again.ply --handle x:0.. --move 1,0,0 --color spike -o new.ply").exit_code == 0);
  const std::string once = content(folder / "new.ply");
  CHECK(once.rfind(start + "1 0 0 ", 0) == 0 && once.find(" 7\n") == std::string::npos);
  write("again.ply", once);
  CHECK(run("again.ply --handle x:0.. --move -1,0,0 --color spike -o new.ply").exit_code == 0);
  CHECK(content(folder / "new.ply").rfind(start + "0 0 0 ", 0) == 0);
  fs::remove(folder / "new.ply");
}

// Three tetrahedra, and a triangle on them, in binary files. The last vertex moves by a vector of
// floats: only its bytes change.
namespace binary_volumes {

using Points = std::vector<std::array<double, 3>>;

const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 1, 1}};
const Points moved = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2.25, 1, 0.5}};
const std::vector<std::vector<int>> cells = {{0, 1, 2, 3}, {0, 1, 2}, {1, 2, 3, 4}, {1, 3, 4, 5}};
const std::string rest = " --fix list:0,1,2,3,4 --handle list:5 --move 0.25,0,-0.5 -o new.";

// of numbers: their bytes
template <typename Number>
std::string all(const std::vector<Number>& numbers, bool is_big)
{
  std::string text;
  for(Number number : numbers)
    text += bytes(number, is_big);
  return text;
}

std::string msh2(const Points& p, bool is_big)
{
  std::string text = "$MeshFormat\n2.2 1 8\n" + bytes(1, is_big) + "\n$EndMeshFormat\n$Nodes\n6\n";
  for(int v = 0; v < 6; ++v)
    text += bytes(v + 100, is_big) + all<double>({p[v].begin(), p[v].end()}, is_big);
  text += "\n$EndNodes\n$Elements\n4\n";
  for(const auto& block : {std::vector<int>{4, 0, 2}, {2, 1}, {4, 3}}) // its type, and its cells
  {
    text += all<int>({block[0], static_cast<int>(block.size()) - 1, 2}, is_big);
    for(std::size_t k = 1; k < block.size(); ++k)
    {
      text += all<int>({block[k] + 1, 7, -8}, is_big); // number and tags
      for(int v : cells[block[k]])
        text += bytes(v + 100, is_big);
    }
  }
  return text + "\n$EndElements\n$NodeData\n\1\2\n\3";
}

std::string msh4(const Points& p, bool is_big)
{
  using Long = std::int64_t;
  const Long first = 6000000000; // numbers that need eight bytes
  std::string text = "$MeshFormat\n4.1 1 8\n" + bytes(1, is_big) + "\n$EndMeshFormat\n$Entities\n" +
                     all<Long>({0, 0, 0, 0}, is_big) + "\n$EndEntities\n$Nodes\n" +
                     all<Long>({3, 6, 1, first + 60}, is_big) +
                     all<int>({1, -4, 1}, is_big) + // on a curve
                     all<Long>({1, first + 10}, is_big) +
                     all<double>({p[0][0], p[0][1], p[0][2], 0.5}, is_big) +
                     all<int>({2, 7, 1}, is_big) + // on a surface
                     all<Long>({1, first + 20}, is_big) +
                     all<double>({p[1][0], p[1][1], p[1][2], 0.5, 0.25}, is_big) +
                     all<int>({3, 1, 0}, is_big) +
                     all<Long>({4, first + 30, first + 40, first + 50, first + 60}, is_big);
  for(int v = 2; v < 6; ++v)
    text += all<double>({p[v].begin(), p[v].end()}, is_big);
  text += "\n$EndNodes\n$Elements\n" + all<Long>({4, 4, 1, 4}, is_big);
  for(Long k = 0; k < 4; ++k)
  {
    text += all<int>({3, 1, cells[k].size() == 4 ? 4 : 2}, is_big) +
            all<Long>({1, first + k}, is_big);
    for(int v : cells[k])
      text += bytes<Long>(first + 10 * (v + 1), is_big);
  }
  return text + "\n$EndElements\n";
}

std::string base64(const std::string& text)
{
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for(std::size_t i = 0; i < text.size(); i += 3)
  {
    unsigned int word = 0;
    for(std::size_t k = 0; k < 3; ++k)
      word = 256 * word + (i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0);
    for(std::size_t k = 0; k < 4; ++k)
      result += i + k > text.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return result;
}

// a stream of zlib, which is not smaller
std::string stored(const std::string& text)
{
  const auto n = static_cast<std::uint16_t>(text.size());
  unsigned int a = 1, b = 0;
  for(unsigned char c : text)
  {
    a = (a + c) % 65521;
    b = (b + a) % 65521;
  }
  return "\x78\1\1" + bytes(n, false) + bytes(static_cast<std::uint16_t>(~n), false) + text +
         bytes(65536 * b + a, true);
}

// how a .vtu file is written
struct Style
{
  std::string format; // ascii, binary, raw or base64, of which the last two are appended
  bool is_big = false, is_long = false, is_double = false, is_compressed = false;

  std::string head(std::size_t n) const
  {
    return is_long ? bytes<std::uint64_t>(n, is_big)
                   : bytes(static_cast<std::uint32_t>(n), is_big);
  }

  std::string encoded(const std::string& text) const
  {
    return format == "raw" ? text : base64(text);
  }

  std::string encoded_array(const std::string& text) const
  {
    if(!is_compressed)
      return encoded(head(text.size()) + text);
    const std::size_t block = is_big ? 24 : 32; // of 24 the last one of the points is full
    std::string heads = head((text.size() + block - 1) / block) + head(block) +
                        head(text.size() % block), data;
    for(std::size_t i = 0; i < text.size(); i += block)
    {
      const std::string part = stored(text.substr(i, block));
      heads += head(part.size());
      data += part;
    }
    return encoded(heads) + encoded(data);
  }
};

std::string vtu(const Points& p, const Style& style)
{
  std::string appended;
  const auto array = [&](const std::string& name, const std::string& type, const auto& numbers,
                         const std::string& tag = "DataArray") {
    const std::string start = '<' + tag + " Name='" + name + "' NumberOfComponents=\"" +
                              (name == "Points" ? "3" : "1") + "\" type=\"" + type + "\" format=\"";
    if(style.format == "ascii")
    {
      std::ostringstream text;
      for(auto number : numbers)
        text << +number << '\n';
      return start + "ascii\">\n" + text.str() + "</" + tag + ">\n";
    }
    const std::string encoded = style.encoded_array(all(numbers, style.is_big));
    if(style.format == "binary")
      return start + "binary\">\n  " + encoded + "\n</" + tag + ">\n";
    appended += encoded;
    return start + "appended\" offset=\"" + std::to_string(appended.size() - encoded.size()) +
           "\"/>\n";
  };
  std::vector<double> coordinates;
  for(const auto& q : p)
    coordinates.insert(coordinates.end(), q.begin(), q.end());
  std::vector<std::int64_t> corners, ends;
  std::vector<unsigned char> types;
  for(const auto& cell : cells)
  {
    corners.insert(corners.end(), cell.begin(), cell.end());
    ends.push_back(static_cast<std::int64_t>(corners.size()));
    types.push_back(cell.size() == 4 ? 10 : 5);
  }
  std::string text = "<?xml version=\"1.0\"?>\n<!-- a <Piece> -->\n"
                     "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" +
                     std::string(style.is_big ? "BigEndian" : "LittleEndian") +
                     "\" header_type=\"" + (style.is_long ? "UInt64" : "UInt32") + '"' +
                     (style.is_compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
                     ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"6\" NumberOfCells=\"4\">\n"
                     "<PointData>\n" +
                     array("connectivity", "Float64", std::vector<double>{1, 2, 3, 4, 5, 6}) +
                     "</PointData>\n<Points>\n";
  text += style.is_double ? array("Points", "Float64", coordinates)
                          : array("Points", "Float32",
                                  std::vector<float>(coordinates.begin(), coordinates.end()));
  text += "</Points>\n<Cells>\n" + array("connectivity", "Int64", corners);
  text += style.is_long
            ? array("offsets", "UInt16", std::vector<std::uint16_t>(ends.begin(), ends.end()))
            : array("offsets", "Int32", std::vector<int>(ends.begin(), ends.end()));
  text += array("types", "UInt8", types) + "</Cells>\n<CellData>\n";
  text += array("labels", "String", std::vector<unsigned char>{'a', 0, 'b', 0, 'c', 0, 'd', 0},
                "Array") + "</CellData>\n</Piece>\n</UnstructuredGrid>\n";
  if(!appended.empty())
    text += "<AppendedData encoding=\"" + style.format + "\">\n   _" + appended +
            "\n</AppendedData>\n";
  return text + "</VTKFile>\n";
}

// the points and tetrahedra that the command reads from a file
std::string as_mesh(const std::string& file)
{
  CHECK(run(file + " --handle list:5 --move 0,0,0 --quiet -o read.mesh").exit_code == 0);
  const std::string text = content(folder / "read.mesh");
  fs::remove(folder / "read.mesh");
  return text;
}

std::string expected_mesh(const Points& p)
{
  std::ostringstream text;
  text << "MeshVersionFormatted 2\nDimension 3\nVertices 6\n";
  for(const auto& q : p)
    text << q[0] << ' ' << q[1] << ' ' << q[2] << " 0\n";
  text << "Tetrahedra 3\n";
  for(const auto& cell : cells)
    if(cell.size() == 4)
      text << cell[0] + 1 << ' ' << cell[1] + 1 << ' ' << cell[2] + 1 << ' ' << cell[3] + 1
           << " 0\n";
  return text.str() + "End\n";
}

void check_kept(const std::string& name, const std::string& extension, const std::string& before,
                const std::string& after)
{
  test_case() = name;
  write("in." + extension, before);
  CHECK(as_mesh("in." + extension) == expected_mesh(points));
  const Run done = run("in." + extension + rest + extension);
  if(!CHECK(done.exit_code == 0 && done.err.empty()))
    std::cerr << "    " << done.err;
  CHECK(content(folder / ("new." + extension)) == after);
  fs::remove(folder / ("new." + extension));
}

void refuse(const std::string& extension, const std::string& text, const std::string& phrase)
{
  write("bad." + extension, text);
  const bool is_start = phrase.empty() || phrase[0] == ','; // else the place is before it
  check_refused("bad." + extension + rest + extension, 1,
                is_start ? "bad." + extension + phrase : phrase);
}

void test_msh()
{
  for(const bool is_big : {false, true})
  {
    check_kept("binary msh 2.2", "msh", msh2(points, is_big), msh2(moved, is_big));
    check_kept("binary msh 4.1", "msh", msh4(points, is_big), msh4(moved, is_big));
  }
  const std::string name = // is no section
    "$PhysicalNames\n1\n2 1 \"the $Nodes 6\"\n$EndPhysicalNames\n$Nodes";
  check_kept("msh with a keyword in a name", "msh", replaced(msh2(points, false), "$Nodes", name),
             replaced(msh2(moved, false), "$Nodes", name));
  const std::string good2 = msh2(points, false), good4 = msh4(points, false);
  for(const std::string& good : {good2, good4})
    for(std::size_t size = 19; size < good.find("$EndElements"); size += 37)
      refuse("msh", good.substr(0, size), "");
  refuse("msh", replaced(good2, "2.2 1", "2.2 2"), ", line 2: a .msh file is text (0) or binary");
  refuse("msh", replaced(good2, "1 8", "1 4"), ", line 2: only binary files with the data size 8");
  refuse("msh", replaced(good2, bytes(1, false), "1\n\n\n"), ": is binary, but does not show its");
  // a file whose numbers have not the byte order that it shows
  refuse("msh", replaced(good4, bytes(1, false), bytes(1, true)),
         ": byte 103: expected an integer");
  const auto text4 = [](const std::string& tag) { // of the last node
    return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 6 1 6\n3 1 0 6\n1\n2\n3\n4\n5\n" + tag +
           "\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n2 1 1\n$EndNodes\n$Elements\n1 3 1 3\n3 1 4 3\n"
           "1 1 2 3 4\n2 2 3 4 5\n3 2 4 5 " + tag + "\n$EndElements\n";
  };
  write("in.msh", text4("6000000000"));
  CHECK(run("in.msh" + rest + "msh").exit_code == 0);
  CHECK(content(folder / "new.msh") ==
        replaced(text4("6000000000"), "\n2 1 1\n", "\n2.25 1 0.5\n"));
  for(const std::string tag : {"9223372036854775808", "99999999999999999999"})
    refuse("msh", text4(tag), ", line 12: expected an integer from 0, but found '" + tag);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Points damaged = points;
  damaged[2][1] = nan;
  refuse("msh", msh2(damaged, false), ": byte 117: expected a finite number, a coordinate in "
                                      "node 3, but found nan");
  refuse("msh", msh4(damaged, true), ": byte 323: expected a finite number, a coordinate in ");
  refuse("msh", replaced(good2, "$Nodes\n6", "$Nodes\n7"), ": byte ");
  refuse("msh", good4 + good4.substr(good4.find("$Nodes")), "has a second section $Nodes");
  refuse("msh", replaced(good2, "$Elements", good2.substr(good2.find("$Nodes"))),
         "has a second section $Nodes");
  refuse("msh", replaced(good2, "$Nodes\n6", "$Nodes\n5"),
         ": byte 189: expected $EndNodes after as many as the file announces, but found");
  refuse("msh", replaced(good2, "$Elements\n4", "$Elements\n3"),
         ": byte 344: expected $EndElements after as many");
  refuse("msh", replaced(good2, "$Elements\n4", "$Elements\n1"), "elements, but found 2");
  refuse("msh", replaced(good2, bytes(105, false) + "\n", bytes(99, false) + "\n"),
         ": byte 380: there is no node 99");
  refuse("msh", replaced(good2, bytes(101, false), bytes(100, false)),
         "a node has the same number as another one, in 100");
}

// the appended text of the strings, from where their offset says that it begins
std::string appended_labels(const std::string& text)
{
  const std::string before = "offset=\"";
  const std::size_t offset =
    std::stoul(text.substr(text.find(before, text.find("'labels'")) + before.size()));
  const std::size_t begin = text.find('_', text.find("<AppendedData")) + 1;
  return text.substr(begin + offset, text.find("\n</AppendedData>") - begin - offset);
}

// the same points nearer to the last one, which moves
Points shifted(Points p)
{
  for(auto& q : p)
    q = {q[0] - 3, q[1] - 1, q[2] - 1};
  return p;
}

// The smallest and the largest distance from the origin, as text.
std::array<std::string, 2> range_of(const Points& p)
{
  double smallest = HUGE_VAL, largest = 0;
  for(const auto& q : p)
  {
    smallest = (std::min)(smallest, std::hypot(q[0], q[1], q[2]));
    largest = (std::max)(largest, std::hypot(q[0], q[1], q[2]));
  }
  std::array<std::string, 2> result;
  for(std::size_t k = 0; k < 2; ++k)
  {
    std::ostringstream text;
    text.precision(17);
    text << (k == 0 ? smallest : largest);
    result[k] = text.str();
  }
  return result;
}

void test_vtk()
{
  test_case() = "the range of distances from the origin, vtk";
  const auto vtk = [](const Points& p) {
    std::ostringstream text;
    text << "# vtk DataFile Version 5.1\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n";
    for(const auto& q : p)
      text << q[0] << ' ' << q[1] << ' ' << q[2] << '\n';
    text << "METADATA\nINFORMATION 3\n";
    for(const std::string name : {"L2_NORM_RANGE", "COMPONENT_RANGE", "L2_NORM_FINITE_RANGE"})
      text << "NAME " << name << " LOCATION vtkDataArray\nDATA 2 "
           << (name[0] == 'L' ? range_of(p)[0] + ' ' + range_of(p)[1] : "0 1") << '\n';
    text << "\nCELLS 4 18\n";
    for(const auto& cell : cells)
    {
      text << cell.size();
      for(int v : cell)
        text << ' ' << v;
      text << '\n';
    }
    text << "CELL_TYPES 4\n";
    for(const auto& cell : cells)
      text << (cell.size() == 4 ? "10\n" : "5\n");
    text << "NAME L2_NORM_RANGE DATA 2 0 1\n"; // of something else
    return text.str();
  };
  for(const bool is_shifted : {false, true})
  {
    write("in.vtk", vtk(is_shifted ? shifted(points) : points));
    CHECK(run("in.vtk" + rest + "vtk").exit_code == 0);
    CHECK(content(folder / "new.vtk") == vtk(is_shifted ? shifted(moved) : moved));
  }
}

void test_vtu()
{
  for(const std::string format : {"ascii", "binary", "raw", "base64"})
    for(const bool is_big : {false, true})
    {
      const Style style = {format, is_big, is_big != (format == "raw"), is_big};
      check_kept(format + " vtu", "vtu", vtu(points, style), vtu(moved, style));
    }
  for(const std::string format : {"ascii", "raw"})
  {
    test_case() = "the range of distances from the origin, " + format;
    const auto with_range = [&](const Points& p) {
      const auto [smallest, largest] = range_of(p);
      const auto key = [](const std::string& name, const std::string& begin,
                          const std::string& end) {
        return "<InformationKey name=\"" + name + "\" location=\"vtkDataArray\" length=\"2\">\n"
               "<Value index=\"0\">" + begin + "</Value><Value index=\"1\">" + end +
               "</Value>\n</InformationKey>\n";
      };
      const std::string text =
        replaced(vtu(p, {format}), "type=\"Float32\"",
                 "type=\"Float32\" RangeMin=\"" + smallest + "\" RangeMax=\"" + largest + '"');
      const std::string keys = key("L2_NORM_RANGE", smallest, largest) +
                               key("COMPONENT_RANGE", "0", "1") +
                               key("L2_NORM_FINITE_RANGE", smallest, largest) +
                               "</DataArray>\n</Points>";
      return format == "ascii" ? replaced(text, "</DataArray>\n</Points>", keys)
                               : replaced(text, "/>\n</Points>", '>' + keys);
    };
    for(const bool is_shifted : {false, true})
    {
      write("in.vtu", with_range(is_shifted ? shifted(points) : points));
      CHECK(run("in.vtu" + rest + "vtu").exit_code == 0);
      CHECK(content(folder / "new.vtu") == with_range(is_shifted ? shifted(moved) : moved));
    }
  }
  test_case() = "arrays without a format";
  for(const std::string format : {"ascii", "raw"})
  {
    const auto without = [&](std::string text) {
      const std::string attribute = " format=\"" + (format == "raw" ? "appended" : format) + '"';
      for(std::size_t place; (place = text.find(attribute)) != std::string::npos;)
        text.erase(place, attribute.size());
      return text;
    };
    write("in.vtu", without(vtu(points, {format})));
    CHECK(run("in.vtu" + rest + "vtu").exit_code == 0);
    CHECK(content(folder / "new.vtu") == without(vtu(moved, {format})));
  }

  bool has_zlib = true;
  for(const std::string format : {"binary", "raw", "base64"})
  {
    test_case() = "compressed vtu, " + format;
    const Style style = {format, format == "raw", format == "base64", format == "raw", true};
    const std::string text = vtu(points, style);
    write("in.vtu", text);
    const Run done = run("in.vtu" + rest + "vtu");
    has_zlib = done.err.find("without zlib") == std::string::npos;
    if(!has_zlib)
      break;
    if(!CHECK(done.exit_code == 0 && done.err.empty()))
      std::cerr << "    " << done.err;
    CHECK(as_mesh("in.vtu") == expected_mesh(points));
    CHECK(as_mesh("new.vtu") == expected_mesh(moved));
    const std::size_t begin = text.find("<Points>"); // what is before is as it was
    CHECK(content(folder / "new.vtu").substr(0, begin) == text.substr(0, begin));
    if(format != "binary") // the strings are still the last of what is appended
      CHECK(appended_labels(content(folder / "new.vtu")) == appended_labels(text));
    CHECK(run("in.vtu" + rest + "vtu --move -0.25,0,0.5").exit_code == 0);
    CHECK(content(folder / "new.vtu") == text); // where nothing moves, all is
    fs::remove(folder / "new.vtu");
    std::string damaged = text;
    for(std::size_t i = text.find("<AppendedData"); i < text.size() - 30; i += 11)
      damaged[i + 29] = '7';
    if(format != "binary")
      refuse("vtu", damaged, "");
    for(std::size_t size = text.size() - 40; size > 900; size -= 97)
      refuse("vtu", text.substr(0, size), "");
  }
  if(!has_zlib)
    std::cout << "NOTICE: arap_deform was built without zlib; compressed .vtu files were not tested"
              << std::endl;

  const std::string text = vtu(points, {"ascii"}), raw = vtu(points, {"raw"}),
                    inside = vtu(points, {"binary"});
  for(const std::string& good : {text, raw, inside, vtu(points, {"base64"})})
    for(std::size_t size = 20; size < good.size() - 60; size += 67)
      refuse("vtu", good.substr(0, size), "");
  refuse("vtu", text.substr(0, text.size() - 5), ": ends before </VTKFile>");
  refuse("vtu", "OFF</VTKFile>\n", ": has no UnstructuredGrid with a Piece");
  refuse("vtu", replaced(text, "UnstructuredGrid", "PolyData"),
         ", line 3: type='PolyData' cannot be read, only UnstructuredGrid");
  refuse("vtu", replaced(text, "LittleEndian", "Middle"), ", line 3: byte_order='Middle' ");
  refuse("vtu", replaced(text, "UInt32", "UInt16"), ", line 3: header_type='UInt16' cannot");
  refuse("vtu", replaced(text, "header_type", "compressor='vtkLZ4DataCompressor' header_type"),
         ", line 3: compressor='vtkLZ4DataCompressor' cannot be read");
  refuse("vtu", replaced(text, "</Piece>", "</Piece><Piece>"), ": only one Piece can be read");
  refuse("vtu", replaced(text, "NumberOfPoints=\"6\"", "NumberOfPoints=\"-6\""),
         ": the Piece has no readable NumberOfPoints or NumberOfCells: '-6'");
  refuse("vtu", replaced(text, "NumberOfPoints=\"6\"", "NumberOfPoints=\"7\""),
         ": expected a finite number, a coordinate in point 6, but found nothing");
  refuse("vtu", replaced(text, "NumberOfPoints=\"6\"", "NumberOfPoints=\"5\""),
         ": expected 5 Points, but after them there is '2'");
  refuse("vtu", replaced(raw, "NumberOfPoints=\"6\"", "NumberOfPoints=\"7\""),
         ": there are 7 points, but the array has 72 bytes");
  refuse("vtu", replaced(text, "NumberOfCells=\"4\"", "NumberOfCells=\"5\""),
         ": there are 5 cells, but 4 offsets and 4 types");
  for(const std::string& each : {text, raw})
    refuse("vtu", replaced(each, "Float32", "Int32"),
           "the Points are 'Int32', not Float32 or Float64");
  refuse("vtu", replaced(text, "2\n1\n1\n</", "2\nnan\n1\n</"),
         ": expected a finite number, a coordinate in point 5, but found 'nan'");
  refuse("vtu", replaced(text, "4\n5\n</", "4\n6\n</"),
         ": the cell 3 has the vertex 6, which does not exist");
  refuse("vtu", replaced(text, "4\n5\n</", "4\n3\n</"), ": the cell 3 has a vertex twice");
  refuse("vtu", replaced(text, "4\n7\n11\n", "4\n9\n11\n"), ": the cell 2 has the type 10 and 2 ");
  refuse("vtu", replaced(text, "4\n7\n11\n", "4\n70\n11\n"), ": the cell 1 ends at 70, which is");
  refuse("vtu", replaced(text, "10\n5\n", "10\n12\n"), ": the cell 1 has the type 12 and 3 ");
  refuse("vtu", replaced(text, "'offsets'", "'ends'"), ": has no DataArray offsets in its Cells");
  refuse("vtu", replaced(inside, "Float32\" format=\"binary\"", "Float32\" format=\"hex\""),
         "the array Points has the format 'hex', which is neither ascii, binary nor appended");
  Points damaged = points;
  damaged[2][1] = std::numeric_limits<double>::infinity();
  for(const std::string format : {"binary", "raw"})
    refuse("vtu", vtu(damaged, {format}), ": point 2 has a coordinate that is infinite or not a");
  // a file whose numbers have not the byte order that it tells
  refuse("vtu", replaced(raw, "LittleEndian", "BigEndian"), "the array Points is shorter than it");
  refuse("vtu", replaced(raw, "offset=\"52\"", "offset=\"-5\""),
         "the array Points is appended, but its offset is wrong");
}

void test_all()
{
  test_msh();
  test_vtk();
  test_vtu();
}

} // namespace binary_volumes

void test_all()
{
  limit_command();
  write("precious.off", "precious");
  write("in.sel", "0\n0\n1\n2\n");
  write("three.sel", "0\n0\n2\n");
  write("in.def", "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  test_off();
  test_obj();
  test_ply();
  test_format_of_ply();
  test_stl();
  test_text_files();
  test_byte_order_marks();
  test_notes();
  test_kept();
  test_color();
  binary_volumes::test_all();
}

} // namespace damaged

// The command arap_deform with pipes, devices, links, what the shell has opened, and signals: it
// does not hang, and whatever fails, all files are as they were. The path of the command is the
// argument; without it nothing is tested.
namespace outputs {

const std::string mesh = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string call = "arap in.off --selection in.sel -o in.off ";

// Runs a line of the shell in which arap stands for the command, and returns the exit code of that.
// `limit` says how it is ended if it takes too long.
Run run_arap(const std::string& line, const std::string& limit = "-s KILL 100")
{
  test_case() = line;
  write("in.off", mesh);
  Run result = run_line("arap() { timeout " + limit + " \"" + command +
                        "\" \"$@\" --transform in.def --threads 1; echo $? > status; }; " + line);
  const std::string status = content(folder / "status");
  result.exit_code = status.empty() ? -1 : std::stoi(status);
  fs::remove(folder / "status");
  return result;
}

bool is_deformed() { return content(folder / "in.off") != mesh; }

void check_done(const Run& done)
{
  if(!CHECK(done.exit_code == 0 && is_deformed()))
    std::cerr << "    exit code " << done.exit_code << ", the message was: " << done.err;
}

void check_failed(const std::string& line, int exit_code, const std::string& phrase,
                  const std::string& limit = "-s KILL 100")
{
  const auto before = files();
  const Run failed = run_arap(line, limit);
  if(!CHECK(failed.exit_code == exit_code && failed.err.find(phrase) != std::string::npos))
    std::cerr << "    exit code " << failed.exit_code << ", the message was: " << failed.err;
  CHECK(!is_deformed());
  CHECK(files() == before);
}

// a line that writes into a pipe whose other end is closed before it begins
std::string when_nobody_reads(const std::string& line)
{
  return "{ read gate < gate; " + line + "; } | { exec <&-; echo > gate; }";
}

bool is_report(const std::string& text)
{
  return text.substr(0, 2) == "{\n" && text.substr(text.size() - 2) == "}\n";
}

void test_pipes()
{
  Run done = run_arap(call + "--quiet --report /dev/stdout | cat");
  check_done(done);
  CHECK(is_report(done.out));
  done = run_arap("cat in.sel | arap in.off --selection /dev/stdin -o in.off --quiet "
                  "--report /dev/stdout | cat");
  check_done(done);
  CHECK(is_report(done.out));
  check_done(run_arap("timeout 100 cat fifo > got & " + call + "--report fifo; wait"));
  CHECK(is_report(content(folder / "got")));
  fs::remove(folder / "got");
  check_failed(when_nobody_reads(call + "--quiet --report /dev/stdout"), 1,
               "/dev/stdout: could not be written to the end");
  check_failed(when_nobody_reads(call), 1, "the standard output could not be");
  check_failed(call + "> /dev/full", 1, "the standard output could not be written");
  check_failed(call + "--report /dev/full", 1, "/dev/full: could not be written to the end");
  check_failed("arap fifo.off --selection in.sel -o in.off", 1, "fifo.off: is not a regular file");
}

// A mesh written to what has no name that tells a format has that of the input; the summary goes
// elsewhere.
void test_meshes_in_pipes()
{
  const auto check_mesh = [](const std::string& line, const std::string& start) {
    const Run done = run_arap(line);
    CHECK(done.exit_code == 0 && !is_deformed());
    CHECK(done.out.rfind(start, 0) == 0);
    CHECK(done.out.find("written: ") == std::string::npos);
    CHECK(done.err.find("written: ") != std::string::npos);
  };
  const std::string arguments = "--selection in.sel -o ";
  write("in.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  check_mesh("arap in.off " + arguments + "/dev/stdout | cat", "OFF\n4 2 0\n");
  check_mesh("arap in.obj " + arguments + "/dev/stdout | cat", "v 0 0 0\nv");
  check_mesh("arap in.obj " + arguments + "link_to_stdout", "v 0 0 0\nv");
  check_mesh("arap in.obj " + arguments + "/dev/fd/1 > got; cat got", "v 0 0 0\nv");
  fs::remove(folder / "got");
  Run done = run_arap("timeout 100 cat fifo > got & arap in.obj " + arguments + "fifo; wait");
  CHECK(done.exit_code == 0 && done.out.find("written: fifo") != std::string::npos);
  CHECK(content(folder / "got").rfind("v 0 0 0\nv", 0) == 0);
  fs::remove(folder / "got");
  done = run_arap("timeout 100 cat fifo.off > got & arap in.obj " + arguments + "fifo.off; wait");
  CHECK(done.exit_code == 0 && content(folder / "got").rfind("OFF", 0) == 0);
  fs::remove(folder / "got");
  done = run_arap("arap in.off " + arguments + "new.off > new.off");
  CHECK(done.exit_code == 0 && done.err.find("written: new.off") != std::string::npos);
  CHECK(content(folder / "new.off").rfind("OFF", 0) == 0);
  fs::remove(folder / "new.off");
  for(const std::string end : {"", " | cat"})
    check_failed("arap in.off " + arguments + "/dev/stdout --report /dev/stdout" + end, 2,
                 "is given for two things");
  check_failed("arap in.off " + arguments + "fifo.off --report fifo.off", 2,
               "is given for two things");

#ifdef __linux__
  int ends[2]; // of a socket, as some programs give those that they run for a standard output
  CHECK(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
  for(int& end : ends) // away from the descriptor 9: the shell takes one digit
    close(std::exchange(end, fcntl(end, F_DUPFD, 10)));
  CHECK(dup2(ends[0], 9) == 9);
  const std::string to_socket = " 1>&9";
  done = run_arap("arap in.off " + arguments + "/dev/stdout" + to_socket);
  CHECK(done.exit_code == 0 && done.err.find("written: /dev/stdout") != std::string::npos);
  check_failed("arap in.off " + arguments + "/dev/stdout --report /dev/stdout" + to_socket, 2,
               "is given for two things");
  for(int end : {ends[0], ends[1], 9})
    close(end);
#endif
  check_failed(when_nobody_reads("arap in.off " + arguments + "/dev/stdout"), 1,
               "/dev/stdout: could not be written to the end");
  check_failed("arap in.off " + arguments + "nothing", 2, "the name of a mesh file ends in");
}

// On a terminal the command says what it is doing.
void test_terminal()
{
  if(run_line("script --version").exit_code != 0)
  {
    std::cout << "NOTICE: the program script is not installed; no terminal was tested" << std::endl;
    return;
  }
  write("in.off", mesh);
  const auto on_terminal = [](const std::string& arguments) {
    test_case() = "on a terminal: " + arguments;
    return run_line("script -qec '\"" + command + "\" --selection in.sel --transform in.def "
                    "-o new.off " + arguments + "' /dev/null").out;
  };
  const std::string shown = on_terminal("in.off");
  std::size_t place = 0;
  for(const std::string text : {"loading in.off ...", "\rloaded in.off, 4 vertices and 2 faces, "
                                "in ", "\rpreprocessing ...", "\rpreprocessed in ",
                                "\riteration 1 of ", "written: new.off"})
    CHECK((place = shown.find(text, place)) != std::string::npos);
  CHECK(on_terminal("in.off --quiet").empty());
  write("bad.off", "OFF\n");
  CHECK(on_terminal("bad.off").find("\r\033[Karap_deform: bad.off: ") != std::string::npos);
  fs::remove(folder / "new.off");
  fs::remove(folder / "bad.off");
}

// What the shell has opened goes on from where it is.
void test_descriptors()
{
  const auto check_log = [](const std::string& line, const std::string& start) {
    write("log", "old\n");
    const Run done = run_arap(line);
    check_done(done);
    const std::string log = content(folder / "log");
    CHECK(log.substr(0, start.size()) == start);
    // the summary goes to the other stream
    const bool is_to_error = line.find("stdout") != std::string::npos;
    const std::string& summary = is_to_error ? done.err : done.out;
    CHECK(summary.find("in.off: 4 vertices") == 0);
    CHECK(summary.find("written: in.off") != std::string::npos);
    CHECK(log.substr(log.size() - 2) == "}\n");
  };
  check_log(call + "--report /dev/stdout >> log", "old\n{\n");
  check_log(call + "--report /dev/stdout > log", "{\n");
  check_log(call + "--report /dev/stderr 2>> log", "old\n{\n");
  check_log(call + "--report /dev/fd/3 3>> log", "old\n{\n");
  check_log(call + "--report /proc/self/fd/3 3> log", "{\n");
  check_log(call + "--report link_to_stdout >> log", "old\n{\n");
  CHECK(fs::is_symlink(folder / "link_to_stdout"));
  fs::remove(folder / "log");
  const Run done = run_arap("arap in.off --selection in.sel --transform in.def --frames 2 "
                            "-o kept.off > kept-0001.off");
  CHECK(done.exit_code == 0);
  CHECK(done.err.find("written: kept-0001.off to kept-0002.off") != std::string::npos);

  check_failed(call + "--report /dev/fd/9", 1, "/dev/fd/9: cannot be written");
  check_failed(call + "--report /dev/fd/3 3< in.def", 2, "is given for two things");
  check_failed(call + "--report /dev/stdout >> in.sel", 2, "is given for two things");
  check_failed("arap in.off --selection in.sel -o new.off --report \"$PWD/new.off\"", 2,
               "is given for two things");
  check_failed("arap in.off --selection in.sel -o new.off --save-transform new.off", 2,
               "new.off is given for two things");
  check_failed("arap in.off --selection in.sel -o new.off --save-transform in.def", 2,
               "in.def is given for two things");
}

void test_names()
{
  const auto check_new = [](const std::string& name, const std::string& written) {
    CHECK(run_arap("arap in.off --selection in.sel -o " + name).exit_code == 0);
    CHECK(content(folder / written).substr(0, 3) == "OFF");
    fs::remove(folder / written);
  };
  fs::create_symlink("new.off", folder / "dangling.off");
  check_new("dangling.off", "new.off");
  CHECK(fs::is_symlink(folder / "dangling.off"));
  const std::string longest = std::string(251, 'x') + ".off";
  check_new(longest, longest);
  fs::create_symlink("circle.off", folder / "circle.off");
  check_failed("arap in.off --selection in.sel -o circle.off", 1, "circle.off: cannot be written");
}

// What fails at last, as the file of the selection here, whose folder has gone, leaves all outputs
// as they were. The report is larger than a pipe, which nobody reads until then.
void test_undo()
{
  fs::create_directory(folder / "apart");
  check_failed("{ until find apart -size +0 | grep -q tmp; do sleep 0.01; done; mv apart gone; "
               "timeout 100 cat > /dev/null; } < fifo & " + call +
               "--iterations 20000 --tolerance 0 --report fifo --save-transform new.def "
               "--save-selection apart/new.sel; wait; rm -r gone; mkdir apart", 1,
               "apart/new.sel: cannot be written: ");
  fs::remove(folder / "apart");
}

// timeout returns 124 for what its signal has ended, and 137 for what it had to kill.
void test_signals()
{
  std::signal(SIGINT, SIG_DFL); // where it is ignored, so it is in what is run here
  for(const std::string signal : {"TERM", "HUP"})
  {
    const std::string limit = "-s " + signal + " -k 20 0.5";
    check_failed(call + "--report fifo", 124, "", limit);
    check_failed("arap in.off --selection fifo -o in.off", 124, "", limit);
    check_failed(call + "--iterations 100000000 --tolerance 0", 124, "", limit);
  }
  // a pipe that nobody reads, and which is full before the end of the report
  check_failed("timeout 30 sleep 30 < fifo & " + call +
               "--iterations 20000 --tolerance 0 --report fifo; kill $!", 124, "interrupted",
               "-s TERM -k 20 2");
  // what ignores a signal, as nohup makes it, goes on
  const std::string shell_command = command;
  command = "/usr/bin/nohup\" \"" + shell_command;
  run_arap("{ sleep 1.5; timeout 100 cat fifo; } > got & arap in.off --selection in.sel -o new.off "
           "--report fifo; wait", "-s HUP -k 20 0.5");
  command = shell_command;
  CHECK(content(folder / "new.off").substr(0, 3) == "OFF" && is_report(content(folder / "got")));
  fs::remove(folder / "new.off");
  fs::remove(folder / "got");
  // the keyboard interrupts the program that draws, and not the one that waits for it: POV-Ray ends
  // with 2, or the shell does by the signal
  for(const std::string end : {"exit 2", "trap - INT; kill -INT $$"})
  {
    write("povray", "#!/bin/sh\n[ \"$1\" = --version ] && exit\n" + end + '\n');
    fs::permissions(folder / "povray", fs::perms::owner_all);
    check_failed("PATH=\"$PWD:$PATH\"; " + call + "--image new.png", 1, "interrupted");
  }
  fs::remove(folder / "povray");
}

void test_all()
{
  write("in.sel", "0\n0\n1\n2\n");
  write("in.def", "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  fs::create_symlink("/dev/stdout", folder / "link_to_stdout");
  CHECK(run_line("mkfifo fifo fifo.off gate").exit_code == 0);
  test_pipes();
  test_meshes_in_pipes();
  test_terminal();
  test_descriptors();
  test_names();
  test_undo();
  test_signals();
}

} // namespace outputs

// The command arap_deform with arguments and small files that are valid but for random changes: it
// ends soon, and if it could not do what was asked, says so in a sentence and leaves no file. Its
// path is the first argument; without it nothing is tested. Then come the number of runs, a seed.
namespace mutations {

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
      "-", "--", "=", "x", "# ", "OFF", "End", "vertex", "element face 7", "uint", " ",
      "%canonical_option%", "f 1 2\\\n", "\xEF\xBB\xBF"};
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
    {"colored.off", "COFF\n4 2 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 9 8 7\n"
                     "3 0 1 2 3\n3 0 2 3 4\n"},
    {"in.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                "0 0 1 0\n1 1 1 0\n2 1 1 0\nTetrahedra 3\n1 2 3 4 0\n2 3 4 5 1\n2 4 5 6 2\nEnd\n"},
    {"in.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 6 1 6\n3 1 0 6\n1\n2\n3\n4\n5\n6\n"
               "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n2 1 1\n$EndNodes\n$Elements\n1 3 1 3\n3 1 4 3\n"
               "1 1 2 3 4\n2 2 3 4 5\n3 2 4 5 6\n$EndElements\n"},
    {"in.vtk", "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n"
               "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 2 1 1\nCELLS 3 15\n4 0 1 2 3\n4 1 2 3 4\n4 1 3 4 5\n"
               "CELL_TYPES 3\n10\n10\n10\n"},
    {"binary.msh", damaged::binary_volumes::msh4(damaged::binary_volumes::points, false)},
    {"in.vtu", damaged::binary_volumes::vtu(damaged::binary_volumes::points, {"ascii"})},
    {"base64.vtu", damaged::binary_volumes::vtu(damaged::binary_volumes::points,
                                                {"base64", true, true, true, true})},
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
  for(const std::string name : {"in.obj", "in.ply", "in.stl", "in.gltf", "in.glb"})
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
    {"--quiet"}, {"--frames", "2"}, {"--region", "x:-50%..0.5"}, {"--fix", "near:0,0,1"},
    {"--save-selection", "new.sel"}, {"--soft", "3"}, {"--quality"}};
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
    return done.err.empty() || (done.err.rfind("note: ", 0) == 0 && lines == 1 && is_readable);
  return (done.exit_code == 1 || done.exit_code == 2) && done.out.empty() && is_readable &&
         lines == done.exit_code && done.err.rfind("arap_deform: ", 0) == 0 && contents() == before;
}

void test_all(int runs, unsigned int seed)
{
  limit_command();
  const Files good = make_files();
  const std::vector<std::string> meshes = {"in.off", "colored.off", "in.obj", "in.ply",
                                           "text.ply", "in.stl", "text.stl", "in.mesh",
                                           "in.gltf", "in.glb", "in.msh", "in.vtk",
                                           "binary.msh", "in.vtu", "base64.vtu"};
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
}

} // namespace mutations

int main(int argc, char** argv)
{
  std::vector<std::function<void()>> tests = {damaged::test_all};
#ifdef __linux__
  tests.push_back(outputs::test_all);
#else
  std::cout << "NOTICE: pipes, devices and signals are tested on Linux only." << std::endl;
#endif
  const int runs = argc > 2 ? std::stoi(argv[2]) : short_or_long(100, 300);
  const unsigned int seed = argc > 3 ? static_cast<unsigned int>(std::stoul(argv[3])) : 1;
  tests.push_back([&] { mutations::test_all(runs, seed); });
  return test_command(argc, argv, tests);
}
