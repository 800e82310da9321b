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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_TASK_H
#define CGAL_ARAP_DEFORMATION_DEMO_TASK_H

// What the command does with the vertices of a mesh: which are fixed, which belong to a handle, and
// where each handle is at each time.

#include "Command_line.h"
#include "Pick.h"
#include "shape_files.h"

#include <CGAL/Bbox_3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// A handle: vertices that an affine map moves.
struct Handle
{
  std::vector<std::size_t> vertices;
  std::optional<double> weight; // of its targets, if they are soft
  std::optional<Kernel::Plane_3> plane; // which they are, before it moves, if they are no points
  bool is_frame = false;        // it turns the cells at its vertices, too
  std::function<Transform(double)> transform; // at a time from 0 to the number of key frames
};

struct Task
{
  std::vector<int> selection;
  std::vector<Handle> handles; // handle k has the status HANDLE + k
  std::size_t key_frames = 1;
  double diagonal = 0; // of the bounding box: lengths are shares of it
};

namespace internal {

using Affine = Eigen::Affine3d;

inline Affine affine(const Transform& m)
{
  Affine result;
  result.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data());
  return result;
}

inline Transform transform(const Affine& m)
{
  Transform result;
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(result.data()) = m.matrix();
  return result;
}

inline const Transform identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// The map at the share s of the way from a to b, both included: the center moves along a straight
// line, the rotation of the polar decomposition turns at constant speed, and the stretch is
// interpolated linearly.
inline Transform interpolated(const Transform& a, const Transform& b, const Eigen::Vector3d& center,
                              double s)
{
  if(s == 0 || s == 1)
    return s == 0 ? a : b;
  Eigen::Matrix3d rotation_a, rotation_b, stretch_a, stretch_b;
  affine(a).computeRotationScaling(&rotation_a, &stretch_a);
  affine(b).computeRotationScaling(&rotation_b, &stretch_b);
  const Eigen::Quaterniond from(rotation_a), to(rotation_b);
  Affine result;
  result.setIdentity();
  result.linear() = from.slerp(s, to).toRotationMatrix() * ((1 - s) * stretch_a + s * stretch_b);
  result.translation() = (1 - s) * (affine(a) * center) + s * (affine(b) * center) -
                         result.linear() * center;
  return transform(result);
}

// The map at a time between key frames; the first is the identity, at the time 0.
inline Transform at_time(double time, const std::vector<Transform>& keys,
                         const Eigen::Vector3d& center)
{
  const std::size_t last = (std::min)(keys.size() - 1, static_cast<std::size_t>(time));
  return interpolated(last == 0 ? identity : keys[last - 1], keys[last], center, time - last);
}

// The map of a share of all steps, one after the other.
inline Transform of_steps(double share, const std::vector<Motion_step>& steps, const Bbox_3& box,
                          const Eigen::Vector3d& center)
{
  Affine result = Affine::Identity();
  for(const Motion_step& step : steps)
  {
    const Measures& m = step.place;
    if(!step.is_rotation)
    {
      result.pretranslate(share * Eigen::Vector3d(m[0].length(box), m[1].length(box),
                                                  m[2].length(box)));
      continue;
    }
    Eigen::Vector3d own_center = result * center;
    for(int k = 0; k < 3 && !m.empty(); ++k)
      own_center[k] = m[k].coordinate(box, k);
    const Eigen::Vector3d axis(step.axis[0], step.axis[1], step.axis[2]);
    result.pretranslate(-own_center);
    result.prerotate(Eigen::AngleAxisd(share * step.angle * std::acos(-1.0) / 180,
                                       axis.stableNormalized()));
    result.pretranslate(own_center);
  }
  return transform(result);
}

inline Eigen::Vector3d centroid(const std::vector<Kernel::Point_3>& points)
{
  Eigen::Vector3d sum(0, 0, 0);
  for(const Kernel::Point_3& p : points)
    sum += Eigen::Vector3d(p.x(), p.y(), p.z());
  return sum / static_cast<double>((std::max)(points.size(), std::size_t(1)));
}

// Changes the selection of the file to that of all options.
inline void select(const Command_line& line, const std::vector<Kernel::Point_3>& points,
                   std::vector<int>& selection)
{
  for(const auto& [status, pick] : line.picks)
    if(!pick.is_point())
      for(std::size_t v : pick.vertices(points))
        selection[v] = status;
  for(const auto& [status, pick] : line.picks)
    if(status != FIXED && !pick.is_point() &&
       std::count(selection.begin(), selection.end(), status) == 0)
      throw std::runtime_error(pick.name() + ": a later --fix or --handle picks all its vertices");
  std::vector<bool> is_in_region(points.size(), line.region.empty());
  for(const Pick& pick : line.region)
    for(std::size_t v : pick.vertices(points))
      is_in_region[v] = true;
  for(std::size_t v = 0; v < points.size(); ++v)
    if(selection[v] == FREE && !is_in_region[v])
      selection[v] = FIXED;
}

// Reads the matrices of the key frames: one for each handle, or one for all.
inline std::vector<std::vector<Transform>> read_key_frames(const Command_line& line,
                                                           std::size_t handles)
{
  std::vector<std::vector<Transform>> keys;
  for(const std::string& file : line.transforms)
  {
    keys.push_back(read_transforms(file));
    if(const std::size_t n = keys.back().size(); n != 1 && n != handles)
      throw std::runtime_error(file + ": has " + std::to_string(n) + " matrices, but the number of "
                               "handles is " + std::to_string(handles) + "; give one for each, or "
                               "one for all");
  }
  return keys;
}

} // namespace internal

// `held` are the points inside simplices that are picked, with their statuses.
inline Task make_task(const Command_line& line, const std::vector<Kernel::Point_3>& points,
                      const std::vector<std::pair<int, Kernel::Point_3>>& held = {})
{
  Task task;
  task.selection = line.selection.empty() ? std::vector<int>(points.size(), FREE)
                                          : read_selection(line.selection, points.size());
  const int largest = *std::max_element(task.selection.begin(), task.selection.end());
  internal::select(line, points, task.selection); // which may leave handles without vertices
  task.handles.resize((std::max)(line.handles.size(),
                                 std::size_t(largest < HANDLE ? 0 : largest - HANDLE + 1)));
  std::vector<Kernel::Point_3> all; // that handles hold
  std::vector<std::vector<Kernel::Point_3>> places(task.handles.size());
  const auto add_place = [&](int status, const Kernel::Point_3& place) {
    places[status - HANDLE].push_back(place);
    all.push_back(place);
  };
  for(std::size_t v = 0; v < points.size(); ++v)
    if(task.selection[v] >= HANDLE)
    {
      task.handles[task.selection[v] - HANDLE].vertices.push_back(v);
      add_place(task.selection[v], points[v]);
    }
  for(const auto& [status, place] : held)
    if(status >= HANDLE)
      add_place(status, place);

  const bool is_moved = !line.transforms.empty() || !line.all_handles.steps.empty() ||
                        line.all_handles.plane;
  if(line.handles.empty() && all.empty() && is_moved)
    throw std::runtime_error("nothing moves: no vertex belongs to a handle of " + line.selection);
  const auto key_frames = internal::read_key_frames(line, task.handles.size());
  // the last ones of a file that hold nothing any more are not in the selection that is saved
  while(line.handles.empty() && !task.handles.empty() && places[task.handles.size() - 1].empty())
    task.handles.pop_back();
  if(task.handles.empty() && !line.save_transform.empty())
    throw std::runtime_error("--save-transform: there is no handle");

  const bool are_together = // all handles move as one
    (line.handles.empty() || !key_frames.empty()) &&
    std::all_of(key_frames.begin(), key_frames.end(),
                [](const auto& key) { return key.size() == 1; });
  const Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
  task.diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(),
                             box.zmax() - box.zmin());
  for(std::size_t k = 0; k < task.handles.size(); ++k)
  {
    Handle& handle = task.handles[k];
    const Handle_options& options = line.handles.empty() ? line.all_handles : line.handles[k];
    const Eigen::Vector3d center = internal::centroid(are_together ? all : places[k]);
    handle.weight = options.weight;
    handle.is_frame = options.is_frame;
    if(options.plane)
      handle.plane = options.plane->plane(box);
    std::vector<Transform> keys;
    for(const auto& key : key_frames)
      keys.push_back(key[key.size() == 1 ? 0 : k]);
    if(keys.empty())
      handle.transform = [steps = options.steps, box, center](double time) {
        return internal::of_steps(time, steps, box, center);
      };
    else
      handle.transform = [keys, center](double time) {
        return internal::at_time(time, keys, center);
      };
  }
  task.key_frames = (std::max)(key_frames.size(), std::size_t(1));
  return task;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_TASK_H
