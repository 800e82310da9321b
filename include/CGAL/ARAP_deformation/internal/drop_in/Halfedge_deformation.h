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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_DEFORMATION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_DEFORMATION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Deformed_region.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Halfedge_energy.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Halfedge_weights.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Ordered_roi.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_global_local.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>
#include <CGAL/ARAP_deformation/internal/solver/factorize_laplacian.h>

#include <CGAL/Surface_mesh_deformation.h>
#include <CGAL/assertions.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What CGAL's class is given for its solver and its rotation where only its types are asked for:
// it then needs neither Eigen nor a model of these concepts.
struct No_linear_algebra {};
struct No_closest_rotation
{
  using Matrix = int;
  using Vector = int;
};

// The largest index of a vertex and one. It exceeds the number of vertices where some were removed.
template <typename Mesh, typename VertexIndexMap>
std::size_t number_of_vertex_indices(const Mesh& mesh, const VertexIndexMap& index_map)
{
  std::size_t n = 0;
  for(const auto v : vertices(mesh))
    n = (std::max)(n, static_cast<std::size_t>(get(index_map, v)) + 1);
  return n;
}

// The deformation with the semantics of CGAL's Surface_mesh_deformation.
template <Deformation_algorithm_tag Tag, typename Mesh, typename VertexIndexMap,
          typename HalfedgeIndexMap, typename VertexPointMap, typename WeightCalculator,
          typename Solver, typename ClosestRotation>
class Halfedge_deformation
{
  using Vertex = typename boost::graph_traits<Mesh>::vertex_descriptor;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Region = Deformed_region<Vertex, Point>;
  using Roi = Ordered_roi<Vertex, VertexIndexMap>;
  using Weights = Halfedge_weights<Mesh, HalfedgeIndexMap, VertexPointMap, WeightCalculator>;

public:
  Halfedge_deformation(Mesh& mesh, VertexIndexMap vertex_index_map,
                       HalfedgeIndexMap halfedge_index_map, VertexPointMap point_map,
                       WeightCalculator weight_calculator)
    : m_mesh(mesh), m_index_map(vertex_index_map), m_point_map(point_map),
      m_weights(mesh, std::move(halfedge_index_map), std::move(point_map),
                std::move(weight_calculator)),
      m_roi(vertex_index_map, number_of_vertex_indices(mesh, vertex_index_map))
  {
    m_region.places.assign(number_of_vertex_indices(mesh, vertex_index_map), Region::none);
  }

  const Mesh& mesh() const { return m_mesh; }
  const Roi& roi() const { return m_roi; }
  const Outcome& outcome() const { return m_outcome; }

  void set_alpha(double alpha) { m_alpha = alpha; }

  bool insert_roi(Vertex v) { return m_roi.insert(v) && region_changed(); }
  bool erase_roi(Vertex v) { return m_roi.erase(v) && region_changed(); }
  bool erase_control(Vertex v) { return m_roi.erase_control(v) && controls_changed(); }

  bool insert_control(Vertex v)
  {
    if(!m_roi.contains(v))
      region_changed();
    return m_roi.insert_control(v) && controls_changed();
  }

  void clear_roi()
  {
    m_roi.clear();
    region_changed();
  }

  void clear_controls()
  {
    m_roi.clear_controls();
    controls_changed();
  }

  Point target(Vertex v) const
  {
    CGAL_precondition(m_roi.is_control(v));
    const int place = m_region.places[index(v)];
    return place != Region::none ? m_region.points[place] : Point(get(m_point_map, v));
  }

  // makes the region fit the region of interest; what has left it is put back
  void update_region()
  {
    if(!m_is_region_outdated)
      return;
    Update update;
    update.region.emplace(make_next_region());
    put_back_erased();
    take(std::move(update));
  }

  // the target of a control vertex becomes move(target)
  template <typename Function>
  Outcome move_target(Vertex v, const Function& move)
  {
    update_region();
    if(!m_roi.is_control(v))
      return internal::outcome(Status::not_a_control_vertex, name(v));
    Point& target = m_region.points[m_region.places[index(v)]];
    target = move(std::as_const(target));
    return Outcome(Status::success, std::string()); // allocates nothing: the target is set already
  }

  bool preprocess()
  {
    Update update;
    if(!prepare(update))
      return false;
    put_back_erased();
    take(std::move(update));
    return true;
  }

  Report deform(unsigned int iterations, double tolerance)
  {
    Report report;
    static_cast<Outcome&>(report) = run(iterations, tolerance, report);
    return report;
  }

  void reset()
  {
    update_region();
    put_roi(m_region, m_region.rest);
    std::copy_n(m_region.rest.begin(), m_region.roi_size, m_region.points.begin());
    m_region.reset_rotations();
  }

  void overwrite_initial_geometry()
  {
    if(m_roi.vertices().empty())
      return;
    update_region();
    // what is the user's, maps and weights, may throw: nothing is changed before
    std::vector<Point> rest = m_region.rest, points = m_region.points;
    for(int k = 0; k < m_region.roi_size; ++k)
    {
      const Vertex v = m_region.vertices[k];
      rest[k] = get(m_point_map, v);
      if(!m_roi.is_control(v)) // not its target
        points[k] = rest[k];
    }
    m_weights.recompute_at(m_roi.vertices(), [this](Vertex v) { return m_roi.contains(v); });
    m_region.rest.swap(rest);
    m_region.points.swap(points);
    m_region.reset_rotations();
    region_changed(); // what is around the region of interest is read again too
  }

private:
  // what depends on the region and the control vertices, and not on the targets
  struct System
  {
    Deformation_energy energy;
    Solver solver; // has the factor
    std::vector<int> numbers; // for each vertex of the region; the free ones come first
    int number_of_free_vertices = 0;
    std::size_t number_of_triangles = 0;
  };

  // What is out of date, made anew. Taken when all has succeeded: what fails changes nothing.
  struct Update
  {
    std::optional<Region> region;
    std::optional<System> system;
  };

  // these two return true, for the sake of those above
  bool region_changed()
  {
    m_is_region_outdated = true;
    return controls_changed();
  }

  bool controls_changed()
  {
    m_system.reset();
    return true;
  }

  std::size_t index(Vertex v) const { return static_cast<std::size_t>(get(m_index_map, v)); }
  std::string name(Vertex v) const { return vertex_name(index(v)); }

  Region make_next_region() const
  {
    return next_region(m_region, m_roi.vertices(), m_mesh, m_index_map, m_point_map);
  }

  // What has left the region of interest is put back, before another region is taken.
  void put_back_erased()
  {
    if(!m_is_region_outdated)
      return;
    for(int k = 0; k < m_region.roi_size; ++k)
      if(!m_roi.contains(m_region.vertices[k]))
        put(m_point_map, m_region.vertices[k], m_region.rest[k]);
  }

  // Writes the points of the vertices of the region of interest.
  void put_roi(const Region& region, const std::vector<Point>& points)
  {
    for(int k = 0; k < region.roi_size; ++k)
      put(m_point_map, region.vertices[k], points[k]);
  }

  bool prepare(Update& update)
  {
    if(m_is_region_outdated)
      update.region.emplace(make_next_region());
    if(!m_system)
      m_outcome = make_system(update.region ? *update.region : m_region, update.system.emplace());
    return m_system || m_outcome;
  }

  void take(Update&& update)
  {
    if(update.region)
    {
      m_region = std::move(*update.region);
      m_is_region_outdated = false;
    }
    if(update.system)
      m_system = std::move(update.system);
  }

  void number_vertices(const Region& region, System& system) const
  {
    system.numbers.assign(region.size(), -1);
    for(int k = 0; k < region.roi_size; ++k)
      if(!m_roi.is_control(region.vertices[k]))
        system.numbers[k] = system.number_of_free_vertices++;
    int next = system.number_of_free_vertices;
    for(int& number : system.numbers)
      if(number < 0)
        number = next++;
  }

  // the vertex of the region with a number
  static Vertex vertex(const Region& region, const System& system, int number)
  {
    const auto it = std::find(system.numbers.begin(), system.numbers.end(), number);
    return region.vertices[it - system.numbers.begin()];
  }

  Outcome make_system(const Region& region, System& system) const
  {
    number_vertices(region, system);
    for(int k = 0; k < region.size(); ++k)
      if(!is_finite(region.rest_coordinates(k)))
        return internal::outcome(Status::non_finite_point, name(region.vertices[k]));

    const Halfedge_energy_builder builder(m_mesh, region, m_index_map, m_weights, system.numbers,
                                          system.number_of_free_vertices);
    if constexpr(Tag == SPOKES_AND_RIMS)
    {
      if(const int k = builder.find_non_triangle(); k >= 0)
        return Outcome(Status::not_a_simplex,
                       name(vertex(region, system, k)) + " is at a face that is not a triangle");
      system.energy = builder.spokes_and_rims();
    }
    else
      system.energy = builder.spokes();
    system.number_of_triangles =
      Tag == SPOKES_AND_RIMS ? system.energy.number_of_edge_sets() : 0;

    Outcome bad_weight(Status::success, std::string());
    system.energy.for_each_edge([&](int i, int j, double weight) {
      if(bad_weight && !std::isfinite(weight))
        bad_weight = Outcome(Status::non_finite_weight,
                             "the weight of the edge from " + name(vertex(region, system, j)) +
                               " to " + name(vertex(region, system, i)) +
                               " is infinite or not a number");
    });
    if(!bad_weight)
      return bad_weight;

    const Diagnosis diagnosis = factorize_laplacian(system.energy, system.solver);
    return internal::outcome(diagnosis.status,
                             diagnosis.vertex < 0 ? std::string()
                                                  : name(vertex(region, system, diagnosis.vertex)));
  }

  Outcome run(unsigned int iterations, double tolerance, Report& report)
  {
    const Scoped_seconds total(report.seconds.total);
    if(std::isnan(tolerance))
      return Outcome(Status::invalid_option, "the tolerance is not a number");
    if(Tag == SRE_ARAP && m_alpha != 0)
      return Outcome(Status::invalid_option,
                     "SRE_ARAP can be run with alpha = 0 only: rotations are not smoothed yet");
    Update update;
    {
      const Scoped_seconds seconds(report.seconds.preprocess);
      if(!prepare(update))
        return m_outcome;
    }
    const Region& region = update.region ? *update.region : m_region;
    System& system = update.system ? *update.system : *m_system;
    report.free_vertices = system.number_of_free_vertices;
    report.simplices = system.number_of_triangles;

    std::vector<Coordinates> x(region.size());
    for(int k = 0; k < region.size(); ++k)
    {
      const Coordinates c = Point_conversion<Point>::coordinates(region.points[k]);
      if(!is_finite(c))
        return internal::outcome(Status::non_finite_point, name(region.vertices[k]));
      x[system.numbers[k]] = c;
    }
    std::vector<Matrix_3x3> rotations(region.rotations.size()); // by the numbers of the centres
    for(int k = 0; k < region.number_of_cells; ++k)
      rotations[system.numbers[k]] = region.rotations[k];
    const Status status =
      minimize_global_local(system.energy, m_closest_rotation, system.solver,
                            report.free_vertices, iterations, tolerance, x, rotations, report);
    if(!succeeded(status))
      return internal::outcome(status);

    // All is there before the first point is written, the sentence too. If the map throws
    // meanwhile, the object is as it was.
    Outcome result =
      status == Status::converged
      ? Outcome(status, "the energy changed by less than the tolerance in an iteration")
      : internal::outcome(status);
    std::vector<Point> points;
    points.reserve(region.points.size());
    for(int k = 0; k < region.size(); ++k)
    {
      const int number = system.numbers[k];
      points.push_back(number < system.number_of_free_vertices
                         ? Point_conversion<Point>::make_point(x[number])
                         : region.points[k]);
    }
    std::vector<Matrix_3x3> region_rotations;
    region_rotations.reserve(rotations.size());
    for(int k = 0; k < region.number_of_cells; ++k)
      region_rotations.push_back(rotations[system.numbers[k]]);
    put_back_erased();
    put_roi(region, points);
    take(std::move(update));
    m_region.points = std::move(points);
    m_region.rotations = std::move(region_rotations);
    return result;
  }

  Mesh& m_mesh;
  VertexIndexMap m_index_map;
  VertexPointMap m_point_map;
  Weights m_weights;
  Roi m_roi;
  Region m_region;
  bool m_is_region_outdated = true;
  std::optional<System> m_system; // none if it is out of date
  ClosestRotation m_closest_rotation;
  Outcome m_outcome;
  double m_alpha = 0.02;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_DEFORMATION_H
