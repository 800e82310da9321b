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

#ifndef CGAL_ARAP_DEFORMATION_BINDINGS_ARRAY_DEFORMATION_H
#define CGAL_ARAP_DEFORMATION_BINDINGS_ARRAY_DEFORMATION_H

// CGAL::ARAP_deformation for arrays of numbers: what other languages are bound to. It only
// forwards.

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/quality.h>

#include <any>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::ARAP::bindings {

// A call that failed: the message is that of the outcome. What is misuse, such as an index
// that is out of range, is a std::logic_error with a message. Either changes nothing.
struct Deformation_error : std::runtime_error
{
  explicit Deformation_error(const Outcome& outcome)
    : std::runtime_error(outcome.message), status(outcome.status)
  {}
  Status status;
};

// indices of vertices or handles, or numbers, row by row
template <typename Number>
struct Rows
{
  const Number* data = nullptr;
  std::size_t rows = 0, columns = 1;

  const Number* operator[](std::size_t row) const { return data + row * columns; }
};
using Indices = Rows<std::int32_t>;
using Numbers = Rows<double>;

using Place = Location<std::size_t>; // in a face or tetrahedron

// A deformation of n vertices. A handle is a number: that of a vertex, or from n on that of a
// control point inside a simplex. The coordinates of a point, and the entries of a matrix, follow
// each other.
class Array_deformation
{
public:
  // returns what to do next, for the number and the energy of an iterate, and a function that
  // writes its points, n x 3
  using Put_points = std::function<void(double*)>;
  using Visitor = std::function<Visitor_action(unsigned int, double, const Put_points&)>;

  virtual ~Array_deformation() = default;

  virtual std::size_t number_of_vertices() const = 0;

  // n x 3: where the vertices are. The memory stays the same as long as this object lives.
  virtual const double* points() const = 0;
  // The next run starts there, and fixed vertices that are no handles stay there. Where a point of
  // the rest shape is not finite it becomes the new one.
  virtual void set_points(Numbers points) = 0;
  // n x 3: the rest shape
  virtual std::vector<double> rest_points() const = 0;

  // Options are texts by their names. All of them are set, or none.
  using Named_options = std::map<std::string, std::string>;
  virtual void set_options(const Named_options& values) = 0;
  virtual std::string option(const std::string& name) const = 0;
  virtual Options options_with(const Named_options& values) const = 0; // which are not set

  // All vertices are in the region of interest at first. Control vertices that are not in it are
  // erased, control points stay.
  virtual void set_region(Indices vertices) = 0;
  virtual std::vector<std::int32_t> region() const = 0;

  // vertices that become handles, whose targets are where they are; they enter the region
  virtual void insert_handles(Indices vertices) = 0;
  virtual void erase_handles(Indices handles) = 0;
  virtual void clear_handles() = 0;
  virtual void clear_points() = 0; // the handles that are control points
  virtual std::vector<std::int32_t> handles() const = 0;

  // the places nearest to k points where the shape is now, if there are any; builds a search tree
  virtual std::vector<std::optional<Place>> locate(Numbers points) const = 0;
  // Places have a row of barycentric coordinates for each simplex; NaN fills the rows of those that
  // have fewer corners.
  virtual std::vector<double> positions(Indices simplices, Numbers coordinates) const = 0; // k x 3
  virtual std::vector<std::int32_t> insert_points(Indices simplices, Numbers coordinates) = 0;
  virtual std::vector<double> point_positions(Indices handles) const = 0; // k x 3

  virtual void set_targets(Indices handles, Numbers targets) = 0; // k x 3
  // Where values of k handles or vertices are asked for, one row is for all of them.
  // Soft targets become sets: planes or lines, given by points and normals or directions; or a
  // surface, given by points and polygons, which are copied.
  virtual void set_target_planes(Indices handles, Numbers points, Numbers normals) = 0;
  virtual void set_target_lines(Indices handles, Numbers points, Numbers directions) = 0;
  virtual void set_target_surface(Indices handles, Numbers points, Indices polygons) = 0;
  virtual std::vector<double> targets(Indices handles) const = 0; // k x 3
  // targets p to A p, with a 3 x 4 or 4 x 4 matrix; of the rest shape or of the present targets
  virtual void transform(Indices handles, Numbers matrix, bool from_rest) = 0;
  virtual std::vector<double> weights(Indices handles) const = 0; // infinite: hard
  virtual void set_weights(Indices handles, Numbers weights) = 0;
  virtual void set_rotations(Indices vertices, Numbers matrices) = 0; // rows of 3 x 3
  virtual void set_rotations_of_motion(Indices vertices) = 0;
  virtual void erase_rotations(Indices vertices) = 0;

  // A value for each cell: n, or one for each simplex if cells are simplices; none clears them. As
  // long as there are values cells cannot be changed from vertices to simplices, or back.
  virtual void set_stiffness(Numbers values) = 0;
  virtual void set_groups(Indices groups) = 0;

  // what the next call of deform() needs, before it is made; returns a message on what it found
  virtual std::string preprocess() = 0;
  virtual Report deform(unsigned int iterations, double tolerance, const Visitor& visitor) = 0;
  virtual Step_report advance(const Dynamics& dynamics, Numbers forces, const Visitor& visitor) = 0;
  // n x 3: those that the next time step begins with, zero outside the region of interest
  virtual std::vector<double> velocities() const = 0;
  virtual void set_velocities(Indices vertices, Numbers velocities) = 0; // k x 3

  virtual void reset() = 0;
  virtual void make_rest_shape() = 0; // of the present positions
  virtual std::any state() const = 0;
  virtual void restore(const std::any& state) = 0;

  virtual double energy() const = 0;
  virtual std::vector<double> rotations() const = 0; // 3 x 3 for each cell
  virtual Quality quality() const = 0;
  virtual std::vector<double> quality_at_vertices(const std::string& measure) const = 0;
};

// points: n x 3; simplices: m x k. A volume has tetrahedra, k = 4; else they are polygons of up to
// k corners, and -1 fills the rows of those that have fewer. All is copied. weights: see
// CGAL::ARAP::Chosen_edge_weight.
std::unique_ptr<Array_deformation> make_array_deformation(Numbers points, Indices simplices,
                                                          bool is_volume,
                                                          const std::string& weights);

} // namespace CGAL::ARAP::bindings

#endif // CGAL_ARAP_DEFORMATION_BINDINGS_ARRAY_DEFORMATION_H
