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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_TARGETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_TARGETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>
#include <CGAL/ARAP_deformation/internal/session/Session_controls.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The targets of control vertices and control points, with their weights and rotations.
template <typename Domain>
class Session_targets : public Session_controls<Domain>
{
  using Base = Session_controls<Domain>;

public:
  using typename Base::Point;
  using typename Base::Vertices;
  using typename Base::vertex_descriptor;

  using Base::Base;
  using Base::present;
  using Base::rest_point;

  // The target of a control vertex or a control point, the projection of where it is if the target
  // is a set; the point of what is no control.
  template <typename Handle>
  Point target(Handle handle) const
  {
    const auto* target = m_vertices.find_target(handle);
    if(target == nullptr)
      return present(handle);
    const auto set = target->set; // as a function of the user, it may insert other targets
    return set ? set(present(handle)) : target->point;
  }

  // `f()` is the new target. It alone may ask where the present one is, which calls a set: a set
  // that is replaced may be gone. As a function of the user, it may also change where targets are.
  template <typename Handle, typename Function>
  Outcome change_target(Handle handle, const Function& f)
  {
    const Outcome success(Status::success, std::string());
    if(Outcome found = with_target(handle, [&](auto&) { return success; }); !found)
      return found;
    Point point = f();
    return with_target(handle, [&](auto& target) {
      replace_target(target, std::move(point));
      return success;
    });
  }

  template <typename Handle, typename Projection>
  Outcome set_target_set(Handle handle, Projection projection)
  {
    return with_target(handle, [&](auto& target) {
      if(target.is_hard())
        return refuse_hard_set(handle);
      decltype(target.set) set(std::move(projection));
      if(!set)
        throw std::bad_function_call();
      target.set = std::move(set);
      return Outcome(Status::success, std::string());
    });
  }

  // the weight of the target of a control vertex or a control point, 0 for what is none
  template <typename Handle>
  double weight(Handle handle) const
  {
    const auto* target = m_vertices.find_target(handle);
    return target == nullptr ? 0 : target->weight;
  }

  template <typename Handle>
  Outcome set_weight(Handle handle, double weight)
  {
    return with_target(handle, [&](auto& target) {
      if(!(weight >= 0))
        return outcome(Status::invalid_weight, name(handle));
      if(target.set && target.is_hard(weight))
        return refuse_hard_set(handle);
      const double before = std::exchange(target.weight, weight);
      if(weight != before)
        constraints_changed();
      return Outcome(Status::success, std::string());
    });
  }

  // the rotation of the cells at a control vertex, or none: then it is fitted
  Outcome set_rotation(vertex_descriptor v, const std::optional<Matrix_3x3>& rotation)
  {
    return with_target(v, [&](auto& target) {
      std::optional<Matrix_3x3> closest = rotation;
      if(rotation)
      {
        closest = Svd_rotation::closest(*rotation);
        bool is_right = is_rotation(*rotation, 1e-5); // as single precision leaves it
        if(is_planar<Domain>) // z must stay an axis, but for what single precision leaves of it
          for(const std::size_t k : {2u, 5u, 6u, 7u})
            is_right &= std::abs(std::exchange((*closest)[k], 0)) <= 1e-5;
        if(!is_right)
          return outcome(Status::invalid_rotation, name(v));
        closest = Svd_rotation::closest(*closest);
      }
      target.rotation = closest;
      return Outcome(Status::success, std::string());
    });
  }

  // the same for each of some control vertices: the rotation of their rigid motion
  Outcome set_rotations_of_motion(const std::vector<vertex_descriptor>& vertices)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    if(vertices.empty())
      return Outcome(Status::success, std::string());
    Array<Coordinates> rest, targets;
    for(vertex_descriptor v : vertices)
    {
      if(!m_vertices.is_control(v))
        return outcome(Status::not_a_control_vertex, name(v));
      rest.push_back(Domain::coordinates(rest_point(v)));
      targets.push_back(Domain::coordinates(target(v)));
    }
    const std::optional<Matrix_3x3> rotation = rotation_of_motion(rest, targets);
    if(!rotation)
      return Outcome(Status::invalid_rotation, "the targets differ from a rigid motion of the rest "
                     "shape by more than 1e-4 of their size, or the vertices lie on a line");
    Outcome result(Status::success, std::string());
    for(auto v = vertices.begin(); v != vertices.end() && result; ++v)
      result = set_rotation(*v, rotation);
    return result;
  }

protected:
  using Base::constraints_changed;
  using Base::m_vertices;
  using Base::name;
  using Base::refuse_in_a_run;

  static void replace_target(typename Vertices::Target& target, Point point)
  {
    target.point = std::move(point);
    target.set = nullptr;
  }

  // calls f(target) with the target of a control vertex or a control point
  template <typename Handle, typename Function>
  Outcome with_target(Handle handle, const Function& f)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    auto* const target = m_vertices.find_target(handle);
    return target != nullptr ? f(*target) : refuse_without_target(handle);
  }

  Outcome refuse_without_target(vertex_descriptor v) const
  {
    return outcome(Status::not_a_control_vertex, name(v));
  }

  Outcome refuse_without_target(Control_point point) const
  {
    return Outcome(Status::not_a_control_vertex,
                   name(point) + " has no target: it was erased, or is of another object");
  }

  template <typename Handle>
  Outcome refuse_hard_set(Handle handle) const
  {
    return Outcome(Status::invalid_weight,
                   name(handle) + " needs a finite weight for a target that is a set");
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_TARGETS_H
