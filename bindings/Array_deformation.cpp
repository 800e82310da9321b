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

#include "Array_deformation.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Chosen_edge_weight.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/of_simplices.h>
#include <CGAL/ARAP_deformation/set_option.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace CGAL::ARAP::bindings {
namespace {

using Point = std::array<double, 3>;
using Points = std::vector<Point>;

void require(const Outcome& outcome)
{
  if(!outcome)
    throw Deformation_error(outcome);
}

void require(bool condition, const std::string& sentence)
{
  if(!condition)
    throw std::invalid_argument(sentence);
}

// a property map that writes points row by row
struct Written_points
{
  double* rows;
  friend void put(const Written_points& map, std::size_t v, const Point& p)
  {
    std::copy(p.begin(), p.end(), map.rows + 3 * v);
  }
};

Points points_of(Numbers rows)
{
  require(rows.columns == 3, "points need three coordinates, not " + std::to_string(rows.columns));
  Points points(rows.rows);
  for(std::size_t v = 0; v < rows.rows; ++v)
    std::copy(rows[v], rows[v + 1], points[v].begin());
  return points;
}

bool is_finite(const Point& p)
{
  return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
}

double dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

// a * p + b * q
Point combined(double a, const Point& p, double b, const Point& q)
{
  return {a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]};
}

// simplices as a range of ranges
class Simplices
{
public:
  Simplices(Indices rows, bool is_volume) : m_columns(rows.columns)
  {
    require(is_volume ? rows.columns == 4 : rows.columns >= 3,
            (is_volume ? "tetrahedra have four corners, not "
                       : "faces have at least three corners, not ") + std::to_string(rows.columns));
    m_corners.assign(rows.data, rows[rows.rows]);
    if(is_volume)
      for(std::size_t s = 0; s < rows.rows; ++s)
        require(*std::min_element(rows[s], rows[s + 1]) >= 0,
                "tetrahedron " + std::to_string(s) + " has a negative corner");
  }
  std::size_t size() const { return m_corners.size() / m_columns; }
  auto operator[](std::size_t s) const
  {
    const std::int32_t* const begin = m_corners.data() + s * m_columns;
    const std::int32_t* end = begin + m_columns;
    while(end != begin && end[-1] == -1)
      --end;
    return boost::make_iterator_range(begin, end);
  }

private:
  std::vector<std::int32_t> m_corners;
  std::size_t m_columns;
};

template <int Dimension>
using Soup = Simplex_soup_domain<Dimension, Points, Simplices>;

// a surface that targets are pulled to
class Target_surface
{
public:
  Target_surface(Numbers points, Indices polygons)
    : m_points(points_of(points)), m_polygons(polygons, false), m_domain(m_points, m_polygons),
      m_locator(m_domain)
  {
    for(std::size_t f = 0; f < m_polygons.size(); ++f)
    {
      const auto face_with = [f](const std::string& what) {
        return "face " + std::to_string(f) + " of the surface has " + what;
      };
      if(m_polygons[f].size() < 3) // the locator ignores it
        throw std::invalid_argument(face_with("fewer than three corners"));
      for(std::int32_t corner : m_polygons[f])
      {
        const auto v = static_cast<std::size_t>(corner); // negative ones are too large
        if(v >= m_points.size())
          throw std::out_of_range(face_with("the vertex " + std::to_string(corner) +
                                            ", which does not exist"));
        if(!is_finite(m_points[v]))
          throw std::invalid_argument(face_with("the vertex " + std::to_string(v) +
                                                ", which is not finite"));
      }
    }
    require(m_locator.locate({0, 0, 0}).has_value(), "the surface has no face with an area");
  }
  Target_surface(const Target_surface&) = delete; // the domain refers to the points
  Target_surface& operator=(const Target_surface&) = delete;

  Point projection(const Point& p) const
  {
    const auto place = m_locator.locate(p);
    return place ? construct_point(m_domain, *place) : p; // the run finds that p is too far away
  }

private:
  Points m_points;
  Simplices m_polygons;
  Soup<2> m_domain;
  Locator<Soup<2>> m_locator;
};

template <int Dimension>
class Array_deformation_of final : public Array_deformation
{
public:
  Array_deformation_of(Numbers points, Indices simplices, const std::string& weights)
    : m_points(points_of(points)), m_simplices(simplices, Dimension == 3),
      m_deformation(Domain(m_points, m_simplices), Traits({}, Chosen_edge_weight(weights)))
  {
    m_deformation.insert_roi_vertices(domain().vertices());
  }

  std::size_t number_of_vertices() const override { return m_points.size(); }
  const double* points() const override { return m_points.data()->data(); }
  std::vector<double> rest_points() const override
  {
    return coordinates_of(domain().vertices(), rest_map());
  }

  std::string option(const std::string& name) const override
  {
    return option_value(options(), name);
  }

  void set_points(Numbers points) override
  {
    refuse_in_a_run();
    require(points.rows == number_of_vertices() && points.columns == 3,
            "there are " + std::to_string(number_of_vertices()) + " vertices, but " +
            std::to_string(points.rows) + " points of " + std::to_string(points.columns) +
            " coordinates");
    const Points copy = points_of(points);
    for(std::size_t v = 0; v < copy.size(); ++v)
      if(!is_finite(copy[v]))
        throw Deformation_error(Outcome(Status::non_finite_point, "the point of vertex " +
                                        std::to_string(v) + " is not finite"));
    std::copy(copy.begin(), copy.end(), m_points.begin());
  }

  Options options_with(const Named_options& values) const override
  {
    Options options = this->options();
    require(ARAP::set_options(options, values));
    return options;
  }

  void set_options(const Named_options& values) override
  {
    const Options options = options_with(values);
    const bool at_vertices = this->options().cells.has_vertex_cells();
    require(options.cells.has_vertex_cells() == at_vertices || !(m_has_stiffness || m_has_groups),
            std::string("cells: there is a stiffness or a group of each ") +
            (at_vertices ? "vertex" : "simplex") +
            ", which is not that of other cells; clear it first");
    require(m_deformation.set_options(options));
  }

  void set_region(Indices vertices) override
  {
    refuse_in_a_run();
    const auto chosen = vertices_of(vertices);
    std::vector<char> is_chosen(number_of_vertices(), 0);
    for(std::size_t v : chosen)
      is_chosen[v] = 1;
    for(std::size_t v : domain().vertices())
      is_chosen[v] ? m_deformation.insert_roi_vertex(v) : m_deformation.erase_roi_vertex(v);
  }
  std::vector<std::int32_t> region() const override
  {
    return numbers_of(m_deformation.roi_vertices());
  }

  void insert_handles(Indices vertices) override
  {
    refuse_in_a_run();
    m_deformation.insert_control_vertices(vertices_of(vertices));
  }
  void erase_handles(Indices handles) override
  {
    refuse_in_a_run();
    for_each(handles, [&](auto handle, std::size_t) {
      if constexpr(is_point<decltype(handle)>)
        m_deformation.erase_control_point(handle);
      else
        m_deformation.erase_control_vertex(handle);
      return Outcome(Status::success, "");
    });
  }
  void clear_handles() override
  {
    refuse_in_a_run();
    m_deformation.clear_control_vertices();
  }
  void clear_points() override
  {
    refuse_in_a_run();
    m_deformation.clear_control_points();
  }
  std::vector<std::int32_t> handles() const override
  {
    std::vector<std::int32_t> result = numbers_of(m_deformation.control_vertices());
    for(Control_point point : m_deformation.control_points())
      result.push_back(handle_of(point));
    return result;
  }

  std::vector<std::optional<Place>> locate(Numbers points) const override
  {
    const Locator<Domain> locator(domain());
    std::vector<std::optional<Place>> places;
    for(const Point& point : points_of(points))
      places.push_back(locator.locate(point));
    return places;
  }
  std::vector<double> positions(Indices simplices, Numbers coordinates) const override
  {
    return coordinates_of(places_of(simplices, coordinates), [this](const auto& place) {
      return construct_point(domain(), place);
    });
  }
  std::vector<std::int32_t> insert_points(Indices simplices, Numbers coordinates) override
  {
    const auto places = places_of(simplices, coordinates);
    std::vector<std::int32_t> result;
    all_or_none(simplices.rows > 1, [&] {
      for(const auto& place : places)
      {
        const auto inserted = m_deformation.insert_control_point(place);
        require(inserted);
        result.push_back(handle_of(inserted.point));
      }
    });
    return result;
  }
  std::vector<double> point_positions(Indices handles) const override
  {
    std::vector<Control_point> points;
    for(std::size_t k = 0; k < handles.rows; ++k)
    {
      points.push_back(control_point(*handles[k]));
      require(m_deformation.is_control_point(points.back()),
              name(*handles[k]) + " is not a control point");
    }
    return coordinates_of(points, [this](Control_point point) {
      return m_deformation.control_point_position(point);
    });
  }

  void set_targets(Indices handles, Numbers targets) override
  {
    require_rows(handles, "handles", targets, "targets", 3);
    for_each(handles, [&](auto handle, std::size_t k) {
      return m_deformation.set_target_position(handle, point_at(targets[k]));
    });
  }
  void set_target_planes(Indices handles, Numbers points, Numbers normals) override
  {
    set_target_sets(handles, points, normals, "normal",
                    [](const Point& p, const Point& origin, const Point& normal) {
                      return combined(1, p, dot(combined(1, origin, -1, p), normal), normal);
                    });
  }
  void set_target_lines(Indices handles, Numbers points, Numbers directions) override
  {
    set_target_sets(handles, points, directions, "direction",
                    [](const Point& p, const Point& origin, const Point& direction) {
                      return combined(1, origin, dot(combined(1, p, -1, origin), direction),
                                      direction);
                    });
  }
  void set_target_surface(Indices handles, Numbers points, Indices polygons) override
  {
    const auto surface = std::make_shared<const Target_surface>(points, polygons);
    set_target_sets(handles, [surface](std::size_t) {
      return [surface](const Point& p) { return surface->projection(p); };
    });
  }
  std::vector<double> targets(Indices handles) const override
  {
    return coordinates_of(required_handles(handles), [this](std::int32_t handle) {
      return visit_handle(handle, [&](auto known) { return m_deformation.target_position(known); });
    });
  }
  std::vector<double> weights(Indices handles) const override
  {
    std::vector<double> result;
    for(std::int32_t handle : required_handles(handles))
      result.push_back(weight(handle));
    return result;
  }
  void transform(Indices handles, Numbers matrix, bool from_rest) override
  {
    require((matrix.rows == 3 || matrix.rows == 4) && matrix.columns == 4,
            "a transformation is a matrix of 4 x 4 or 3 x 4 numbers");
    if(matrix.rows == 4)
      require(std::equal(matrix[3], matrix[4], std::array<double, 4>{0, 0, 0, 1}.begin()),
              "the last row of a transformation must be 0, 0, 0, 1: it has its numbers row by row");
    const auto apply = [&](const Point& p) {
      Point q;
      for(std::size_t k = 0; k < 3; ++k)
        q[k] = matrix[k][0] * p[0] + matrix[k][1] * p[1] + matrix[k][2] * p[2] + matrix[k][3];
      return q;
    };
    for_each(handles, [&](auto handle, std::size_t) {
      return m_deformation.transform(handle, apply,
                                     from_rest ? Transformed::rest_shape : Transformed::targets);
    });
  }
  void set_weights(Indices handles, Numbers weights) override
  {
    require_values(handles, "handles", weights, "weights", 1);
    bool can_fail = false; // those of sets cannot be hard
    std::size_t number = 0;
    for(std::int32_t handle : required_handles(handles))
    {
      const double next = *row(weights, number++);
      can_fail |= !(next >= 0) || (std::isinf(next) && !std::isinf(weight(handle)));
    }
    all_or_none(can_fail && handles.rows > 1, [&] {
      for_each(handles, [&](auto handle, std::size_t k) {
        return m_deformation.set_target_weight(handle, *row(weights, k));
      });
    });
  }
  void set_rotations(Indices vertices, Numbers matrices) override
  {
    require_values(vertices, "vertices", matrices, "matrices", 9);
    const std::vector<std::size_t> chosen = control_vertices_of(vertices);
    all_or_none(matrices.rows > 1, [&] {
      for(std::size_t k = 0; k < chosen.size(); ++k)
      {
        Matrix_3x3 rotation;
        std::copy_n(row(matrices, k), rotation.size(), rotation.begin());
        require(m_deformation.set_target_rotation(chosen[k], rotation));
      }
    });
  }
  void set_rotations_of_motion(Indices vertices) override
  {
    require(m_deformation.set_target_rotations(control_vertices_of(vertices)));
  }
  void erase_rotations(Indices vertices) override
  {
    for(std::size_t v : control_vertices_of(vertices))
      require(m_deformation.erase_target_rotation(v));
  }

  void set_stiffness(Numbers values) override
  {
    if(values.rows == 0)
      require(m_deformation.clear_stiffness());
    else
      with_cell_map(values, [&](const auto& map) { return m_deformation.set_stiffness(map); });
    m_has_stiffness = values.rows > 0;
  }
  void set_groups(Indices groups) override
  {
    if(groups.rows == 0)
      require(m_deformation.clear_groups());
    else
      with_cell_map(groups, [&](const auto& map) { return m_deformation.set_groups(map); });
    m_has_groups = groups.rows > 0;
  }

  std::string preprocess() override
  {
    Outcome prepared = m_deformation.preprocess();
    require(prepared);
    return prepared.message;
  }
  Report deform(unsigned int iterations, double tolerance, const Visitor& visitor) override
  {
    return checked(m_deformation.deform(iterations, tolerance, visitor_of(visitor)));
  }
  Step_report advance(const Dynamics& dynamics, Numbers forces, const Visitor& visitor) override
  {
    require(forces.rows == 0 || (forces.rows == number_of_vertices() && forces.columns == 3),
            "forces have three coordinates for each of the " +
            std::to_string(number_of_vertices()) + " vertices");
    const auto force_at = [&](std::size_t v) {
      return forces.rows == 0 ? Point{0, 0, 0} : point_at(forces[v]);
    };
    return checked(m_deformation.advance(dynamics, force_at, visitor_of(visitor)));
  }

  std::vector<double> velocities() const override
  {
    return coordinates_of(domain().vertices(),
                          [this](std::size_t v) { return m_deformation.velocity(v); });
  }
  void set_velocities(Indices vertices, Numbers velocities) override
  {
    require_rows(vertices, "vertices", velocities, "velocities", 3);
    refuse_in_a_run();
    const std::vector<std::size_t> chosen = vertices_of(vertices);
    for(std::size_t v : chosen)
      require(m_deformation.is_roi_vertex(v),
              "vertex " + std::to_string(v) + " is not in the region of interest");
    for(std::size_t k = 0; k < chosen.size(); ++k)
      m_deformation.set_velocity(chosen[k], point_at(velocities[k]));
  }

  void reset() override
  {
    refuse_in_a_run();
    m_deformation.reset();
  }
  void make_rest_shape() override
  {
    refuse_in_a_run();
    m_deformation.overwrite_initial_geometry();
  }
  std::any state() const override { return m_deformation.state(); }
  void restore(const std::any& state) override
  {
    const auto* known = std::any_cast<typename Deformation::State>(&state);
    if(known == nullptr)
      throw Deformation_error(
        Outcome(Status::foreign_state, "the state is of another kind of shape"));
    require(m_deformation.restore(*known));
  }

  double energy() const override { return m_deformation.energy(); }
  std::vector<double> rotations() const override
  {
    const bool at_vertices = options().cells.has_vertex_cells();
    std::vector<double> result;
    for(std::size_t c = 0; c < (at_vertices ? number_of_vertices() : m_simplices.size()); ++c)
    {
      const Matrix_3x3 r = at_vertices ? m_deformation.rotation(c)
                                       : m_deformation.simplex_rotation(c);
      result.insert(result.end(), r.begin(), r.end());
    }
    return result;
  }
  Quality quality() const override { return ARAP::quality(domain(), rest_map()); }
  std::vector<double> quality_at_vertices(const std::string& measure) const override
  {
    using M = Vertex_measure;
    for(const auto& [name, known] : {std::pair("edge_length_error", M::edge_length_error),
                                     std::pair("size_change", M::size_change),
                                     std::pair("angle_change", M::angle_change),
                                     std::pair("spike", M::spike)})
      if(measure == name)
        return ARAP::quality_at_vertices(domain(), known, rest_map());
    throw std::invalid_argument("the measure '" + measure + "' is not known; use one of "
                                "edge_length_error, size_change, angle_change, spike");
  }

private:
  using Domain = Soup<Dimension>;
  using Traits = ARAP_deformation_traits<Default, Chosen_edge_weight>;
  using Deformation = ARAP_deformation<Domain, Traits>;

  template <typename Handle>
  static constexpr bool is_point = std::is_same_v<std::decay_t<Handle>, Control_point>;

  const Domain& domain() const { return m_deformation.domain(); }
  auto rest_map() const
  {
    return [this](std::size_t v) { return m_deformation.rest_position(v); };
  }
  static Point point_at(const double* p) { return {p[0], p[1], p[2]}; }
  // the coordinates of the points that a function has for each of a range
  template <typename Range, typename Function>
  static std::vector<double> coordinates_of(const Range& range, const Function& f)
  {
    std::vector<double> result;
    for(const auto& x : range)
    {
      const Point p = f(x);
      result.insert(result.end(), p.begin(), p.end());
    }
    return result;
  }
  static std::vector<std::int32_t> numbers_of(const std::vector<std::size_t>& vertices)
  {
    return std::vector<std::int32_t>(vertices.begin(), vertices.end());
  }

  // Simplices and coordinates, without what fills the rows. Throws unless all are places, before
  // one of them uses up the number of a control point.
  std::vector<Place> places_of(Indices simplices, Numbers coordinates) const
  {
    require(coordinates.rows == simplices.rows,
            "there are " + std::to_string(simplices.rows) + " simplices, but " +
            std::to_string(coordinates.rows) + " rows of coordinates");
    std::vector<Place> result;
    for(std::size_t k = 0; k < simplices.rows; ++k)
    {
      const std::string place = "place " + std::to_string(k);
      const auto s = static_cast<std::size_t>(*simplices[k]); // negative ones are too large
      if(s >= m_simplices.size())
        throw std::out_of_range(place + ": there is no simplex " +
                                std::to_string(*simplices[k]));
      std::vector<double> own(coordinates[k], coordinates[k + 1]);
      while(!own.empty() && std::isnan(own.back()))
        own.pop_back();
      const auto corners = static_cast<std::size_t>(m_simplices[s].size());
      require(own.size() == corners, place + " has " + std::to_string(own.size()) +
                                     " coordinates, but simplex " + std::to_string(s) + " has " +
                                     std::to_string(corners) + " corners");
      if(domain().simplex_vertices(s).empty())
        throw Deformation_error(Outcome(Status::not_a_simplex, place + ": a corner of simplex " +
                                        std::to_string(s) + " does not exist"));
      if(!internal::add_up_to_one(own))
        throw Deformation_error(internal::outcome(Status::invalid_coordinates, place));
      result.push_back({s, std::move(own)});
    }
    return result;
  }

  static std::string name(std::int32_t handle) { return "handle " + std::to_string(handle); }
  std::int32_t handle_of(Control_point point) const
  {
    return static_cast<std::int32_t>(number_of_vertices() + point.number() - 1);
  }
  Control_point control_point(std::int32_t handle) const
  {
    const auto n = static_cast<std::int32_t>(number_of_vertices());
    return handle < n ? Control_point() : Control_point(static_cast<std::size_t>(handle - n + 1));
  }

  std::vector<std::size_t> vertices_of(Indices vertices) const
  {
    std::vector<std::size_t> result;
    for(std::size_t k = 0; k < vertices.rows; ++k)
    {
      const std::int32_t v = *vertices[k];
      if(!is_vertex(v))
        throw std::out_of_range("there is no vertex " + std::to_string(v));
      result.push_back(static_cast<std::size_t>(v));
    }
    return result;
  }
  std::vector<std::size_t> control_vertices_of(Indices vertices) const
  {
    std::vector<std::size_t> result = vertices_of(vertices);
    for(std::size_t v : result)
      require(m_deformation.is_control_vertex(v),
              "vertex " + std::to_string(v) + " is not a control vertex");
    return result;
  }

  static void require_rows(Indices indices, const char* what, Numbers rows, const char* values,
                           std::size_t columns)
  {
    require(rows.rows == indices.rows && rows.columns == columns,
            "there are " + std::to_string(indices.rows) + " " + what + ", but " +
            std::to_string(rows.rows) + " " + values +
            (columns == 1 ? "" : " of " + std::to_string(rows.columns) + " numbers"));
  }
  // one row may also be for all
  static void require_values(Indices indices, const char* what, Numbers rows, const char* values,
                             std::size_t columns)
  {
    require_rows(rows.rows == 1 ? Indices{indices.data, 1} : indices, what, rows, values, columns);
  }
  static const double* row(Numbers rows, std::size_t k) { return rows[rows.rows == 1 ? 0 : k]; }

  bool is_vertex(std::int32_t handle) const
  {
    return handle >= 0 && static_cast<std::size_t>(handle) < number_of_vertices();
  }
  // what a function of a control vertex or a control point returns
  template <typename Function>
  auto visit_handle(std::int32_t handle, const Function& f) const
  {
    return is_vertex(handle) ? f(static_cast<std::size_t>(handle)) : f(control_point(handle));
  }
  double weight(std::int32_t handle) const
  {
    return visit_handle(handle, [&](auto known) { return m_deformation.target_weight(known); });
  }
  std::vector<std::int32_t> required_handles(Indices handles) const
  {
    std::vector<std::int32_t> result(handles.data, handles[handles.rows]);
    for(std::int32_t handle : result)
      require(is_vertex(handle) ? m_deformation.is_control_vertex(static_cast<std::size_t>(handle))
                                : m_deformation.is_control_point(control_point(handle)),
              name(handle) + " is neither a control vertex nor a control point");
    return result;
  }
  // Calls f(handle, k) for the k-th handle. All are known before the first one is changed.
  template <typename Function>
  void for_each(Indices handles, const Function& f) const
  {
    std::size_t k = 0;
    for(std::int32_t handle : required_handles(handles))
    {
      require(visit_handle(handle, [&](auto known) { return f(known, k); }));
      ++k;
    }
  }
  // Calls f(), which may change something before it fails if `can_fail`: then all is as it was.
  template <typename Function>
  void all_or_none(bool can_fail, const Function& f)
  {
    if(!can_fail)
      return f();
    auto before = m_deformation.state();
    try
    {
      f();
    }
    catch(...)
    {
      require(m_deformation.restore(std::move(before)));
      throw;
    }
  }

  // Finite points and directions of length 1, of planes or lines. What is set for a handle is
  // `projection` with those of its row.
  template <typename Projection>
  void set_target_sets(Indices handles, Numbers points, Numbers directions, const char* what,
                       const Projection& projection)
  {
    require_values(handles, "handles", points, "points", 3);
    require_values(handles, "handles", directions, "directions", 3);
    Points origins = points_of(points), units = points_of(directions);
    const auto of_handle = [&](std::size_t k, const Points& rows) {
      return rows.size() == 1 ? std::string() : " of " + name(*handles[k]);
    };
    for(std::size_t k = 0; k < origins.size(); ++k)
      require(is_finite(origins[k]),
              "the point" + of_handle(k, origins) + " must have finite coordinates");
    for(std::size_t k = 0; k < units.size(); ++k)
    {
      Point& d = units[k];
      const double length = std::hypot(d[0], d[1], d[2]);
      require(std::isfinite(length) && length > 0,
              std::string("the ") + what + of_handle(k, units) + " must be finite, and not zero");
      d = {d[0] / length, d[1] / length, d[2] / length};
    }
    set_target_sets(handles, [&](std::size_t k) {
      return [origin = origins[points.rows == 1 ? 0 : k],
              unit = units[directions.rows == 1 ? 0 : k], projection](const Point& p) {
        return projection(p, origin, unit);
      };
    });
  }

  // `projection(k)` is that onto the set of the k-th handle
  template <typename Projection>
  void set_target_sets(Indices handles, const Projection& projection)
  {
    for(std::int32_t handle : required_handles(handles)) // all, before the first one is changed
      if(std::isinf(weight(handle)))
        throw Deformation_error(Outcome(Status::invalid_weight, name(handle) +
                                        " has a hard target, which cannot be a set: give it a "
                                        "finite weight first"));
    for_each(handles, [&](auto handle, std::size_t k) {
      return m_deformation.set_target_set(handle, projection(k));
    });
  }

  // calls f with a map of vertices, or of simplices, whichever have cells
  template <typename Number, typename Function>
  void with_cell_map(Rows<Number> values, const Function& f) const
  {
    const bool at_vertices = options().cells.has_vertex_cells();
    const std::size_t cells = at_vertices ? number_of_vertices() : m_simplices.size();
    require(values.rows == cells, "there are " + std::to_string(values.rows) + " values for the " +
                                  std::to_string(cells) +
                                  (at_vertices ? " vertices" : " simplices"));
    const std::vector<Number> map(values.data, values[values.rows]);
    require(at_vertices ? f(map) : f(of_simplices(map)));
  }

  const Options& options() const { return m_deformation.options(); }

  // For what has no outcome, and in a visitor would be left undone without a word. The options stay
  // as they are: setting them only tells.
  void refuse_in_a_run() { require(m_deformation.set_options(options())); }

  template <typename Report_>
  static Report_ checked(Report_ report)
  {
    if(!report && report.status != Status::cancelled)
      throw Deformation_error(report);
    return report;
  }
  auto visitor_of(const Visitor& visitor) const
  {
    return [this, &visitor](const typename Deformation::Iterate& iterate) {
      const auto put_points = [&](double* points) {
        std::copy_n(this->points(), 3 * number_of_vertices(), points); // not all are in the region
        iterate.put_points(Written_points{points});
      };
      return visitor ? visitor(iterate.iteration(), iterate.energy(), put_points)
                     : Visitor_action::proceed;
    };
  }

  Points m_points;
  Simplices m_simplices;
  Deformation m_deformation;
  bool m_has_stiffness = false, m_has_groups = false;
};

} // namespace

std::unique_ptr<Array_deformation> make_array_deformation(Numbers points, Indices simplices,
                                                          bool is_volume,
                                                          const std::string& weights)
{
  if(is_volume)
    return std::make_unique<Array_deformation_of<3>>(points, simplices, weights);
  return std::make_unique<Array_deformation_of<2>>(points, simplices, weights);
}

} // namespace CGAL::ARAP::bindings
