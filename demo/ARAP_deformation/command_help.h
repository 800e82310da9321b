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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_COMMAND_HELP_H
#define CGAL_ARAP_DEFORMATION_DEMO_COMMAND_HELP_H

#include <CGAL/ARAP_deformation/Options.h>

#include <boost/lexical_cast.hpp>
#include <boost/program_options.hpp>

#include <ostream>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

// all options of the command, with what --help says of them
inline boost::program_options::options_description described_options()
{
  using boost::program_options::value;
  const Options defaults;
  boost::program_options::options_description task("What is held and moved"), output("Output"),
    run("The deformation"), dynamics("Time steps with inertia, instead of a shape at rest"),
    other("Other");
  // an option that picks or moves vertices: what it says depends on those before it
  const auto in_order = [] { return value<std::vector<std::string>>()->composing(); };
  task.add_options()
    ("fix", in_order()->value_name("WHAT"), "these vertices stay")
    ("handle", in_order()->value_name("WHAT"),
     "these are a handle, for the next five options, which are for all handles of a --selection; "
     "each --handle is a new one")
    ("move", in_order()->value_name("DX,DY,DZ"), "move the handle")
    ("rotate", in_order()->value_name("AXIS ANGLE [X,Y,Z]"),
     "turn it about x, y, z or a vector, by degrees; about a point or else its own center")
    ("soft", in_order()->value_name("WEIGHT"),
     "its targets pull with this weight, instead of being met; an edge weighs about 1 on a "
     "surface, and about its length in a volume")
    ("onto", in_order()->value_name("PLANE"),
     "to this plane, plane:X,Y,Z,NX,NY,NZ, along which they glide; the plane moves as the handle")
    ("turn", value<std::vector<std::string>>()->composing()->zero_tokens(),
     "its rotation is prescribed to the cells at it: even one vertex turns its surroundings")
    ("region", in_order()->value_name("WHAT"), "of the free vertices only these may move")
    ("stiffness", in_order()->value_name("WHAT K"), "these cells are K times as stiff")
    ("rigid", in_order()->value_name("WHAT"),
     "these cells share a rotation; each --rigid is a part of its own, which may still stretch "
     "where it has no --stiffness")
    ("selection", value<std::string>()->default_value("", "")->value_name("S.sel"),
     "instead of --handle: a status per line and vertex: 0 fixed, 1 free, k >= 2 handle k; # is a "
     "comment; what --fix picks is fixed, whatever the file says")
    ("transform", value<std::vector<std::string>>()->composing()->value_name("T.def"),
     "instead of moves: a 4 x 4 matrix, row by row, for each handle or one for all; given "
     "several times: key frames, and without --frames and --animation OUT-0001 is written for the "
     "first, OUT-0002 for the second and so on, and no OUT")
    ("save-selection", value<std::string>()->default_value("", "")->value_name("S.sel"),
     "write the selection that was picked")
    ("save-transform", value<std::string>()->default_value("", "")->value_name("T.def"),
     "write the matrices of the handles at the end");
  output.add_options()
    ("output,o", value<std::string>()->value_name("OUT")->required(),
     "the deformed mesh; for tetrahedra .mesh or the format of MESH")
    ("frames", value<std::string>()->value_name("N"),
     "write OUT-0001, OUT-0002 and so on, the number before the ending: the way to the end in N "
     "frames, each from the one before")
    ("animation", value<std::string>()->default_value("", "")->value_name("FILM"),
     "of the frames, 20 a second; without --frames 24 for each --transform, or 24 in all: .gltf or "
     ".glb; or drawn as --image is, with povray, .gif, .mp4 or .webm (ffmpeg writes these two)")
    ("report", value<std::string>()->default_value("", "")->value_name("R.json"),
     "write a report as JSON")
    ("quality", "look for self-intersections, too, for the report")
    ("color", value<std::string>()->default_value("", "")->value_name("NAME"),
     "color the picture, and write a property of a .ply file: edge_error, area or volume (two "
     "names for one measure, of faces or of tetrahedra), angle, spike (how far a vertex is from "
     "its neighbors)")
    ("image", value<std::string>()->default_value("", "")->value_name("PICTURE.png"),
     "draw the shape before and after, fixed red, handles yellow; needs povray")
    ("view", value<std::string>()->value_name("A,E"),
     "of --image and of a film that is drawn: azimuth and elevation of the eye in degrees, or its "
     "direction X,Y,Z");
  run.add_options()
    ("cells", value<std::string>()->default_value("spokes_and_rims")->value_name("NAME"),
     "which edges share a rotation: spokes, spokes_and_rims, elements, or k_ring:K, the spokes of "
     "all vertices within K rings")
    ("bending", value<std::string>()->default_value("0")->value_name("B"),
     "the length over which a sharp bend is spread, as a share of the bounding box's diagonal; "
     "0.02 to 0.1 keep a pulled vertex from being a spike, except on a border")
    ("smoothing", value<std::string>()->default_value("0")->value_name("S"),
     "the length over which rotations are made smooth, as a share of the bounding box's diagonal")
    ("weights", value<std::string>()->default_value("safe_cotangent")->value_name("NAME"),
     "cotangent (with spokes the energy can be negative), clamped_cotangent, uniform, or "
     "safe_cotangent: clamped for stars (spokes, k_ring) only")
    ("minimizer", value<std::string>()->default_value("automatic")->value_name("NAME"),
     "local_global, that of the paper; quasi_newton, with fewer iterations; or automatic: "
     "quasi_newton unless the tolerance is 0")
    ("solver", value<std::string>()->default_value("default")->value_name("NAME"),
     "of linear systems: default, single_precision (its factor takes half the memory), eigen, and "
     "where the command is linked with them cholmod, petsc (its factor is distributed over the "
     "processes that mpirun starts) or petsc_cg (without a factor, for the largest shapes)")
    ("rotation", value<std::string>()->default_value("newton")->value_name("NAME"),
     "how rotations are fitted: newton, or svd")
    ("initial_guess", value<std::string>()->default_value("automatic")->value_name("NAME"),
     "where to start: previous (the input with the handles moved), rotations (Poisson editing), "
     "laplacian, or automatic: previous, but rotations for connected parts where a handle is torn "
     "away by over a tenth of their diagonal, if that is better, and on large surfaces then a run "
     "on a coarser one")
    ("iterations", value<std::string>()->default_value(std::to_string(defaults.iterations))
       ->value_name("N"), "run at most N iterations")
    ("tolerance", value<std::string>()->value_name("T")
       ->default_value(boost::lexical_cast<std::string>(defaults.tolerance)),
     "stop when the estimated relative gap to the minimum is at most T; 0: run all N")
    ("verify_minimum", value<std::string>()->default_value("true")->value_name("true|false"),
     "before stopping, look at the second derivative, and go on unless this is a minimum")
    ("coarse_metric", value<std::string>()->default_value("true")->value_name("true|false"),
     "complete the metric of quasi-Newton runs where 30,000 vertices or more are free: fewer "
     "iterations, more memory")
    ("threads", value<std::string>()->default_value(std::to_string(defaults.threads))
       ->value_name("N"),
     "use at most N threads; 0: as many as processors");
  dynamics.add_options()
    ("gravity", value<std::string>()->value_name("X,Y,Z"),
     "each of the --frames is a time step under this acceleration, in any consistent units")
    ("time_step", value<std::string>()->value_name("H"), "the time of a step; default 1/60")
    ("modulus", value<std::string>()->default_value("1")->value_name("M"),
     "how stiff a body of density 1 is: its elastic energy is M times the energy")
    ("damping", value<std::string>()->default_value("0")->value_name("D"),
     "the rate at which velocities decay");
  other.add_options()
    ("quiet", "print only errors: no summary, no notes, no progress")
    ("help,h", "print this and exit")
    ("version", "print the version, and what it was built with, and exit");
  return task.add(output).add(run).add(dynamics).add(other);
}

inline void print_help(std::ostream& out)
{
  out << "usage: arap_deform MESH -o OUT --handle WHAT --rotate AXIS ANGLE ... [options]\n\n"
         "  arap_deform cactus.off -o bent.off --fix z:..5% --handle z:90%.. \\\n"
         "    --rotate x 60 50%,50%,40%\n\n"
         "holds the lowest twentieth of the shape, turns the top by 60 degrees about a\n"
         "point at two fifths of the height, and lets the rest follow so that every small\n"
         "part of it turns and moves, but stretches as little as possible (Sorkine and\n"
         "Alexa 2007).\n\n"
         "MESH is a surface in an .off, .obj, .ply, .stl, .gltf or .glb file, or tetrahedra\n"
         "in a .mesh (Medit), .msh (Gmsh, text or binary), .vtk (text) or .vtu file. OUT is\n"
         "of the same kind; a pipe gets the format of MESH. A note says what OUT does not\n"
         "keep of MESH.\n\n"
         "WHAT picks vertices; later options win. It is one of\n"
         "  z:90%..  y:..0.2  x:-1..1          between two x, y or z, or beyond one\n"
         "  box:X0,Y0,Z0,X1,Y1,Z1  sphere:X,Y,Z,R  inside a box, inside a ball\n"
         "  plane:X,Y,Z,NX,NY,NZ               the side to which the normal N points\n"
         "  near:X,Y,Z                         the nearest vertex\n"
         "  point:X,Y,Z                        for --fix and --handle: no vertex, but the\n"
         "                                     nearest point of a surface; in tetrahedra\n"
         "                                     the point itself\n"
         "  list:0,7,12  list:@FILE            numbers of vertices, from 0\n"
         "A coordinate N% goes from 0% to 100% of the bounding box; a length N% is of its\n"
         "diagonal. Where WHAT picks cells, these are the cells of its vertices, or with\n"
         "--cells elements the simplices all of whose corners it picks.\n\n"
      << described_options()
      << "\nBetween key frames the center of a handle moves along a straight line; if each\n"
         "transform file has one matrix for all handles, they move as one, about their common\n"
         "center. The rotation turns at constant speed, the shorter way; the stretch is\n"
         "interpolated linearly. This makes two key frames, a way through them, and a film of\n"
         "a body under gravity:\n\n"
         "  arap_deform cactus.off -o bent.off --fix z:..5% --handle z:90%.. \\\n"
         "    --rotate x 60 50%,50%,40% --save-transform bent.def\n"
         "  arap_deform cactus.off -o turned.off --fix z:..5% --handle z:90%.. \\\n"
         "    --rotate z 90 --save-transform turned.def\n"
         "  arap_deform cactus.off -o film.off --fix z:..5% --handle z:90%.. \\\n"
         "    --transform bent.def --transform turned.def --frames 24\n"
         "  arap_deform cactus.off -o hanging.off --fix z:..5% --gravity 1,0,0 \\\n"
         "    --modulus 20 --frames 60 --animation hanging.gif\n\n"
         "The report tells status, message, the initial_guess that was taken, iterations,\n"
         "energy (initial, and after each), estimated_relative_gap to the minimum, the kind of\n"
         "end (minimum, flat, undecided, unknown), saddles_left, plateaus_left,\n"
         "edge_length_error (relative root mean square), area_change and volume_change\n"
         "(relative), largest_angle_change (degrees), largest_spike, inverted_simplices\n"
         "(tetrahedra), unconstrained_components (by their first vertex; nothing holds them,\n"
         "and they stay), vertices_in_no_simplex (free, and they stay), seconds, and more.\n\n"
         "Exit status: 0 success, 1 failure, 2 wrong usage. If it is not 0, no output file\n"
         "is written, except to pipes and devices, and existing files are unchanged.\n";
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_COMMAND_HELP_H
