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
      for(std::int32_t v : m_polygons[f])
        if(v < 0 || static_cast<std::size_t>(v) >= m_points.size())
          throw std::out_of_range("face " + std::to_string(f) + " of the surface has the vertex " +
                                  std::to_string(v) + ", which does not exist");
    require(m_locator.locate({0, 0, 0}).has_value(), "the surface has no face with an area");
  }
  Target_surface(const Target_surface&) = delete; // the domain refers to the points
  Target_surface& operator=(const Target_surface&) = delete;

  Point projection(const Point& p) const
  {
    const auto place = m_locator.locate(p);
    if(!place) // the run finds that p is too far away
      return p;
    Point result = {0, 0, 0};
    const auto corners = m_polygons[place->simplex];
    for(std::size_t k = 0; k < place->coordinates.size(); ++k)
      result = combined(1, result, place->coordinates[k],
                        m_points[static_cast<std::size_t>(corners[k])]);
    return result;
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
    : m_points(points_of(points)), m_rest(m_points), m_simplices(simplices, Dimension == 3),
      m_deformation(Domain(m_points, m_simplices), Traits({}, Chosen_edge_weight(weights)))
  {
    m_deformation.insert_roi_vertices(domain().vertices());
  }

  std::size_t number_of_vertices() const override { return m_points.size(); }
  const double* points() const override { return m_points.data()->data(); }
  const double* rest_points() const override { return m_rest.data()->data(); }

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
    for(std::size_t v = 0; v < copy.size(); ++v)
      if(!is_finite(m_rest[v])) // the session mends it, too
        m_rest[v] = copy[v];
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
    for_each(handles, [&](auto handle) {
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
    {
      places.emplace_back();
      if(const auto found = locator.locate(point))
        places.back() = Place{found->simplex, found->coordinates, found->distance};
    }
    return places;
  }
  std::int32_t insert_point(std::int32_t simplex, Numbers coordinates) override
  {
    if(simplex < 0 || static_cast<std::size_t>(simplex) >= m_simplices.size())
      throw std::out_of_range("there is no simplex " + std::to_string(simplex));
    const auto inserted = m_deformation.insert_control_point(
      static_cast<std::size_t>(simplex),
      std::vector<double>(coordinates.data, coordinates[coordinates.rows]));
    require(inserted);
    return handle_of(inserted.point);
  }
  void point_position(std::int32_t handle, double* point) const override
  {
    const Control_point known = control_point(handle);
    require(m_deformation.is_control_point(known), name(handle) + " is not a control point");
    const Point p = m_deformation.control_point_position(known);
    std::copy(p.begin(), p.end(), point);
  }

  void set_targets(Indices handles, Numbers targets) override
  {
    require_rows(handles, "handles", targets, "targets");
    std::size_t row = 0;
    for_each(handles, [&](auto handle) {
      return m_deformation.set_target_position(handle, point_at(targets[row++]));
    });
  }
  void set_target_plane(Indices handles, Numbers plane) override
  {
    const auto [origin, normal] = point_and_direction(plane, "normal");
    set_target_sets(handles, [origin = origin, normal = normal](const Point& p) {
      return combined(1, p, dot(combined(1, origin, -1, p), normal), normal);
    });
  }
  void set_target_line(Indices handles, Numbers line) override
  {
    const auto [origin, direction] = point_and_direction(line, "direction");
    set_target_sets(handles, [origin = origin, direction = direction](const Point& p) {
      return combined(1, origin, dot(combined(1, p, -1, origin), direction), direction);
    });
  }
  void set_target_surface(Indices handles, Numbers points, Indices polygons) override
  {
    const auto surface = std::make_shared<const Target_surface>(points, polygons);
    set_target_sets(handles, [surface](const Point& p) { return surface->projection(p); });
  }
  void target(std::int32_t handle, double* point) const override
  {
    require_handle(handle);
    visit_handle(handle, [&](auto known) {
      const Point p = m_deformation.target_position(known);
      std::copy(p.begin(), p.end(), point);
    });
  }
  double weight(std::int32_t handle) const override
  {
    require_handle(handle);
    double weight = 0;
    visit_handle(handle, [&](auto known) { weight = m_deformation.target_weight(known); });
    return weight;
  }
  void transform(Indices handles, Numbers matrix, bool from_rest) override
  {
    require((matrix.rows == 3 || matrix.rows == 4) && matrix.columns == 4,
            "a transformation is a matrix of 4 x 4 or 3 x 4 numbers");
    if(matrix.rows == 4)
      require(std::equal(matrix[3], matrix[4], std::array<double, 4>{0, 0, 0, 1}.begin()),
              "the last row of a transformation must be 0, 0, 0, 1");
    const auto apply = [&](const Point& p) {
      Point q;
      for(std::size_t k = 0; k < 3; ++k)
        q[k] = matrix[k][0] * p[0] + matrix[k][1] * p[1] + matrix[k][2] * p[2] + matrix[k][3];
      return q;
    };
    for_each(handles, [&](auto handle) {
      return m_deformation.transform(handle, apply,
                                     from_rest ? Transformed::rest_shape : Transformed::targets);
    });
  }
  void set_weight(Indices handles, double weight) override
  {
    std::vector<double> before;
    for(std::size_t k = 0; k < handles.rows; ++k)
      before.push_back(this->weight(*handles[k]));
    try
    {
      for_each(handles, [&](auto handle) {
        return m_deformation.set_target_weight(handle, weight);
      });
    }
    catch(const Deformation_error&) // as of a set, which cannot be hard
    {
      auto next = before.begin();
      for_each(handles, [&](auto handle) {
        return m_deformation.set_target_weight(handle, *next++);
      });
      throw;
    }
  }
  void set_rotation(Indices vertices, const double* matrix) override
  {
    Matrix_3x3 rotation;
    std::copy(matrix, matrix + rotation.size(), rotation.begin());
    for(std::size_t v : control_vertices_of(vertices))
      require(m_deformation.set_target_rotation(v, rotation));
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
    std::vector<double> result;
    for(std::size_t v : domain().vertices())
    {
      const Coordinates velocity = m_deformation.velocity(v);
      result.insert(result.end(), velocity.begin(), velocity.end());
    }
    return result;
  }
  void set_velocities(Indices vertices, Numbers velocities) override
  {
    require_rows(vertices, "vertices", velocities, "velocities");
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
    m_rest = m_points;
  }
  std::any state() const override { return State{m_deformation.state(), m_rest}; }
  void restore(const std::any& state) override
  {
    const State* known = std::any_cast<State>(&state);
    if(known == nullptr)
      throw Deformation_error(
        Outcome(Status::foreign_state, "the state is of another kind of shape"));
    Points rest = known->rest;
    require(m_deformation.restore(known->session));
    m_rest = std::move(rest);
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
  Quality quality() const override { return ARAP::quality(domain(), m_rest); }
  std::vector<double> quality_at_vertices(const std::string& measure) const override
  {
    using M = Vertex_measure;
    for(const auto& [name, known] : {std::pair("edge_length_error", M::edge_length_error),
                                     std::pair("size_change", M::size_change),
                                     std::pair("angle_change", M::angle_change),
                                     std::pair("spike", M::spike)})
      if(measure == name)
        return ARAP::quality_at_vertices(domain(), known, m_rest);
    throw std::invalid_argument("the measure '" + measure + "' is not known; use one of "
                                "edge_length_error, size_change, angle_change, spike");
  }

private:
  using Domain = Soup<Dimension>;
  using Traits = ARAP_deformation_traits<Default, Chosen_edge_weight>;
  using Deformation = ARAP_deformation<Domain, Traits>;

  struct State
  {
    typename Deformation::State session;
    Points rest;
  };

  template <typename Handle>
  static constexpr bool is_point = std::is_same_v<std::decay_t<Handle>, Control_point>;

  const Domain& domain() const { return m_deformation.domain(); }
  static Point point_at(const double* p) { return {p[0], p[1], p[2]}; }
  static std::vector<std::int32_t> numbers_of(const std::vector<std::size_t>& vertices)
  {
    return std::vector<std::int32_t>(vertices.begin(), vertices.end());
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

  static void require_rows(Indices indices, const char* what, Numbers points, const char* values)
  {
    require(points.rows == indices.rows && points.columns == 3,
            "there are " + std::to_string(indices.rows) + " " + what + ", but " +
            std::to_string(points.rows) + " " + values + " of " + std::to_string(points.columns) +
            " coordinates");
  }

  bool is_vertex(std::int32_t handle) const
  {
    return handle >= 0 && static_cast<std::size_t>(handle) < number_of_vertices();
  }
  template <typename Function>
  void visit_handle(std::int32_t handle, const Function& f) const
  {
    if(is_vertex(handle))
      f(static_cast<std::size_t>(handle));
    else
      f(control_point(handle));
  }
  void require_handle(std::int32_t handle) const
  {
    require(is_vertex(handle) ? m_deformation.is_control_vertex(static_cast<std::size_t>(handle))
                              : m_deformation.is_control_point(control_point(handle)),
            name(handle) + " is neither a control vertex nor a control point");
  }
  // All handles are known before the first one is changed.
  template <typename Function>
  void for_each(Indices handles, const Function& f) const
  {
    for(std::size_t k = 0; k < handles.rows; ++k)
      require_handle(*handles[k]);
    for(std::size_t k = 0; k < handles.rows; ++k)
      visit_handle(*handles[k], [&](auto handle) { require(f(handle)); });
  }

  // a finite point, and a direction of length 1
  static std::pair<Point, Point> point_and_direction(Numbers rows, const char* what)
  {
    const Points points = points_of(rows);
    require(points.size() == 2 && is_finite(points[0]), "the point must have finite coordinates");
    const Point& d = points[1];
    const double length = std::hypot(d[0], d[1], d[2]);
    require(std::isfinite(length) && length > 0,
            std::string("the ") + what + " must be finite, and not zero");
    return {points[0], {d[0] / length, d[1] / length, d[2] / length}};
  }

  template <typename Projection>
  void set_target_sets(Indices handles, const Projection& projection)
  {
    for(std::size_t k = 0; k < handles.rows; ++k) // all, before the first one is changed
      if(std::isinf(weight(*handles[k])))
        throw Deformation_error(Outcome(Status::invalid_weight, name(*handles[k]) +
                                        " has a hard target, which cannot be a set: give it a "
                                        "finite weight first"));
    for_each(handles, [&](auto handle) {
      return m_deformation.set_target_set(handle, projection);
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

  Points m_points, m_rest;
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
