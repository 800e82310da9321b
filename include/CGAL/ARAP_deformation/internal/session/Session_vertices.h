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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_VERTICES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_VERTICES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/is_in_domain.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Held_point.h>
#include <CGAL/ARAP_deformation/internal/session/Surroundings.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The region of interest, the control vertices and control points with their targets, the rest
// shape and the present one. Vertices keep their entry when they leave the region of interest: they
// may have been moved, and the entry knows the rest shape.
template <typename Domain>
class Session_vertices
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using Point = typename Domain::Point;
  using Target = Handle_target<Point>;
  using Held_point = internal::Held_point<Domain>;

  struct Entry
  {
    vertex_descriptor vertex;
    int target; // its place in m_targets, if it was ever a control vertex
    Point rest;
    std::uint64_t insertion : 61; // when it last entered the region of interest
    bool is_roi : 1;
    bool is_control : 1;
    bool was_roi : 1; // when the points of the region were last written; see Session_rules
  };

  explicit Session_vertices(Domain domain) : m_domain(std::move(domain)) {}

  const Domain& domain() const { return m_domain; }

  // the target of a control vertex
  Target& whole_target(const Entry& entry) { return m_targets[entry.target]; }
  const Target& whole_target(const Entry& entry) const { return m_targets[entry.target]; }
  Point& target(const Entry& entry) { return m_targets[entry.target].point; }
  const Point& target(const Entry& entry) const { return m_targets[entry.target].point; }

  bool is_hard_control(const Entry& entry) const
  {
    return entry.is_control && whole_target(entry).is_hard();
  }

  // whether a vertex is solved for, and has a term of its own in the energy
  bool is_pulled(const Entry& entry) const
  {
    return entry.is_control && whole_target(entry).is_pull();
  }

  // the target of a control vertex or a control point, nullptr for what is none

  const Target* find_target(vertex_descriptor v) const
  {
    const Entry* entry = find_known(v);
    return entry != nullptr && entry->is_control ? &m_targets[entry->target] : nullptr;
  }

  const Target* find_target(Control_point point) const
  {
    const auto found = m_points.find(point);
    return found == m_points.end() ? nullptr : &found->second.target;
  }

  template <typename Handle>
  Target* find_target(Handle handle)
  {
    return const_cast<Target*>(std::as_const(*this).find_target(handle));
  }

  // the control points, in the order of insertion
  std::map<Control_point, Held_point>& points() { return m_points; }
  const std::map<Control_point, Held_point>& points() const { return m_points; }

  std::vector<Entry>& entries() { return m_entries; }
  const std::vector<Entry>& entries() const { return m_entries; }

  // where the vertices of the entries are
  std::vector<Point>& present_points() { return m_present_points; }
  const std::vector<Point>& present_points() const { return m_present_points; }

  const Entry* find(vertex_descriptor v) const
  {
    const int slot = m_slots[m_domain.index(v)];
    return slot == Paged_index_map::none ? nullptr : &m_entries[slot];
  }

  // allocates memory for so many more vertices
  void reserve(std::size_t n)
  {
    const std::size_t needed = m_entries.size() + n;
    if(needed > m_entries.capacity())
      m_entries.reserve((std::max)(needed, 2 * m_entries.size()));
    if(needed > m_present_points.capacity())
      m_present_points.reserve((std::max)(needed, 2 * m_present_points.size()));
  }

  // to be called when the vertices of a region have been inserted
  void release_spare_memory()
  {
    m_entries.shrink_to_fit();
    m_present_points.shrink_to_fit();
    m_targets.shrink_to_fit();
  }

  // where v is: the domain knows the points of vertices only that were not yet moved
  Point present(vertex_descriptor v) const
  {
    const Entry* entry = find(v);
    return entry == nullptr ? m_domain.point(v) : present(*entry);
  }

  Point& present(const Entry& entry) { return m_present_points[place(entry)]; }
  const Point& present(const Entry& entry) const { return m_present_points[place(entry)]; }

  // the point of v in the rest shape: of vertices that are not known, the one that the mesh has
  Point rest(vertex_descriptor v) const
  {
    if(const Entry* entry = find(v))
      return entry->rest;
    const Point* kept = m_surroundings.find(m_domain.index(v));
    return kept && is_finite(Domain::coordinates(*kept)) ? *kept : Point(m_domain.point(v));
  }

  // keeps the rest shape of a vertex around the region of interest, whoever moves it
  void keep_rest(vertex_descriptor v)
  {
    if(find(v) == nullptr)
      m_surroundings.keep(m_domain.index(v), v, rest(v));
  }

  // to be called when the rest shape is overwritten
  void read_surroundings_again() { m_surroundings.read_again(m_domain); }

  // the same, nullptr also for what is no vertex
  const Entry* find_known(vertex_descriptor v) const
  {
    return is_vertex_of(m_domain, v) ? find(v) : nullptr;
  }

  Entry* find_known(vertex_descriptor v)
  {
    return const_cast<Entry*>(std::as_const(*this).find_known(v));
  }

  // the entry of v if it is a control vertex, else nullptr
  Entry* find_control(vertex_descriptor v)
  {
    Entry* entry = find_known(v);
    return entry != nullptr && entry->is_control ? entry : nullptr;
  }

  bool is_roi(vertex_descriptor v) const
  {
    const Entry* entry = find_known(v);
    return entry != nullptr && entry->is_roi;
  }

  // a control vertex or a control point
  template <typename Handle>
  bool is_control(Handle handle) const
  {
    return find_target(handle) != nullptr;
  }

  // The functions that change the sets return whether they did.

  bool insert_roi(vertex_descriptor v) { return is_vertex(v) && enter_roi(find_or_insert(v)); }

  // The target is what `present(v)` returns.
  template <typename Function>
  bool insert_control(vertex_descriptor v, const Function& present)
  {
    if(!is_vertex(v) || is_control(v))
      return false;
    // what can throw comes before what is changed
    if(m_targets.size() == m_targets.capacity())
      m_targets.reserve(2 * m_targets.size() + 1);
    Target target = {present(v)};
    Entry& entry = find_or_insert(v);
    if(entry.target == no_target)
    {
      m_targets.push_back(std::move(target));
      entry.target = static_cast<int>(m_targets.size()) - 1;
    }
    else
      m_targets[entry.target] = std::move(target);
    enter_roi(entry);
    entry.is_control = true;
    return true;
  }

  bool erase_roi(vertex_descriptor v)
  {
    Entry* entry = find_known(v);
    if(entry == nullptr || !entry->is_roi)
      return false;
    leave_roi(*entry);
    return true;
  }

  bool erase_control(vertex_descriptor v)
  {
    Entry* entry = find_control(v);
    if(entry == nullptr)
      return false;
    entry->is_control = false;
    return true;
  }

  bool clear_roi()
  {
    bool is_change = false;
    for(Entry& entry : m_entries)
    {
      is_change |= entry.is_roi;
      leave_roi(entry);
    }
    return is_change;
  }

  bool clear_control()
  {
    bool is_change = false;
    for(Entry& entry : m_entries)
    {
      is_change |= entry.is_control;
      entry.is_control = false;
    }
    return is_change;
  }

  // inserts the corners in the region of interest, too
  Control_point insert_point(Held_point held)
  {
    const Control_point point(m_last_point + 1);
    const std::size_t size = m_entries.size();
    std::vector<std::size_t> indices, corners; // their places: what can throw comes first
    for(vertex_descriptor v : held.corners)
      indices.push_back(m_domain.index(v));
    try
    {
      for(vertex_descriptor v : held.corners)
        corners.push_back(place(find_or_insert(v)));
      m_points.emplace(point, std::move(held));
    }
    catch(...)
    {
      remove_entries_from(size, indices);
      throw;
    }
    ++m_last_point;
    for(std::size_t k : corners)
      enter_roi(m_entries[k]);
    return point;
  }

  bool erase_point(Control_point point) { return m_points.erase(point) > 0; }

  bool clear_points()
  {
    const bool is_change = !m_points.empty();
    m_points.clear();
    return is_change;
  }

  // the vertices whose entries fulfill a predicate, in the order in which they entered the region
  // of interest
  template <typename Predicate>
  std::vector<vertex_descriptor> select(const Predicate& predicate) const
  {
    std::vector<std::pair<std::uint64_t, std::size_t>> chosen; // with their places
    for(std::size_t k = 0; k < m_entries.size(); ++k)
      if(predicate(m_entries[k]))
        chosen.emplace_back(m_entries[k].insertion, k);
    if(!std::is_sorted(chosen.begin(), chosen.end()))
      std::sort(chosen.begin(), chosen.end());
    std::vector<vertex_descriptor> selected;
    selected.reserve(chosen.size());
    for(const auto& [insertion, k] : chosen)
      selected.push_back(m_entries[k].vertex);
    return selected;
  }

  // The vertices whose points others have changed, by the places of their entries, and these
  // points.
  std::vector<std::pair<std::size_t, Point>> changed_points() const
  {
    std::vector<std::pair<std::size_t, Point>> changed;
    for(std::size_t k = 0; k < m_entries.size(); ++k)
    {
      auto&& point = m_domain.point(m_entries[k].vertex);
      const Coordinates now = Domain::coordinates(point),
                        before = Domain::coordinates(m_present_points[k]);
      if(now != before && (is_finite(now) || is_finite(before))) // NaN differs from itself
        changed.emplace_back(k, point);
    }
    return changed;
  }

  // of the first entries; those of the others are zero
  Array<Coordinates>& velocities() { return m_velocities; }

  Coordinates velocity(const Entry* entry) const
  {
    if(entry == nullptr)
      return {0, 0, 0};
    const std::size_t k = place(*entry);
    return k < m_velocities.size() ? m_velocities[k] : Coordinates{0, 0, 0};
  }

  // false if v is not in the region of interest
  bool set_velocity(vertex_descriptor v, const Coordinates& velocity)
  {
    if(!is_roi(v))
      return false;
    if(m_velocities.size() < m_entries.size())
      m_velocities.resize(m_entries.size(), Coordinates{0, 0, 0});
    m_velocities[m_slots[m_domain.index(v)]] = velocity;
    return true;
  }

  // all of it, as a value
  struct State
  {
    std::vector<Entry> entries;
    std::vector<Point> present_points;
    std::vector<Target> targets;
    std::vector<Point> first_points;
    Array<typename Surroundings<Domain>::Vertex> surroundings;
    std::map<Control_point, Held_point> points;
    Array<Coordinates> velocities;
  };

  State state() const
  {
    return {m_entries, m_present_points, m_targets, m_first_points, m_surroundings.vertices(),
            m_points, m_velocities};
  }

  // What restore() makes of these, which needs no more memory and throws nothing.
  struct Change
  {
    State state;
    std::map<std::size_t, int> slots; // those that change
    Array<typename Surroundings<Domain>::Vertex> surroundings;
  };

  // Prepares the return to an earlier state. Vertices that have entered since leave.
  Change prepare(State state)
  {
    Change change{std::move(state), {}, {}};
    const std::vector<Entry>& after = change.state.entries;
    const auto is_same = [&](std::size_t k) {
      return k < m_entries.size() && k < after.size() && m_entries[k].vertex == after[k].vertex;
    };
    for(std::size_t k = 0; k < m_entries.size(); ++k)
      if(!is_same(k))
        change.slots[m_domain.index(m_entries[k].vertex)] = Paged_index_map::none;
    for(std::size_t k = 0; k < after.size(); ++k)
      if(!is_same(k))
      {
        const std::size_t index = m_domain.index(after[k].vertex);
        change.slots[index] = static_cast<int>(k);
        m_slots.reserve(index);
      }
    change.surroundings = m_surroundings.prepare(change.state.surroundings);
    return change;
  }

  // the present point of a vertex after restore(), nullptr if it has no entry then
  const Point* find_present(const Change& change, vertex_descriptor v) const
  {
    const std::size_t index = m_domain.index(v);
    const auto changed = change.slots.find(index);
    const int slot = changed != change.slots.end() ? changed->second : m_slots[index];
    return slot == Paged_index_map::none
           ? nullptr : &change.state.present_points[static_cast<std::size_t>(slot)];
  }

  void restore(Change change)
  {
    for(const auto& [index, slot] : change.slots)
      m_slots.set(index, slot);
    m_surroundings.restore(change.surroundings);
    m_entries.swap(change.state.entries);
    m_present_points.swap(change.state.present_points);
    m_targets.swap(change.state.targets);
    m_first_points.swap(change.state.first_points);
    m_points.swap(change.state.points);
    m_velocities.swap(change.state.velocities);
  }

  // to be called before the rest shape is overwritten
  void keep_first_points()
  {
    for(std::size_t k = m_first_points.size(); k < m_entries.size(); ++k)
      m_first_points.push_back(m_entries[k].rest);
  }

  // the point of a vertex when its entry was made, or, if that was not finite, its rest point
  const Point& first_point(std::size_t k) const
  {
    return k < m_first_points.size() && is_finite(Domain::coordinates(m_first_points[k]))
             ? m_first_points[k] : m_entries[k].rest;
  }

private:
  static constexpr int no_target = -1;

  std::size_t place(const Entry& entry) const // of one of m_entries, no copy
  {
    return static_cast<std::size_t>(&entry - m_entries.data());
  }

  // in Release false for what is no vertex, if the domain can tell
  bool is_vertex(vertex_descriptor v) const
  {
    const bool is_one = is_vertex_of(m_domain, v);
    CGAL_precondition_msg(is_one, "the mesh has no such vertex");
    return is_one;
  }

  bool enter_roi(Entry& entry)
  {
    if(entry.is_roi)
      return false;
    entry.is_roi = true;
    entry.insertion = m_number_of_insertions++;
    return true;
  }

  // it comes back at rest
  void leave_roi(Entry& entry)
  {
    entry.is_roi = entry.is_control = false;
    if(const std::size_t k = place(entry); k < m_velocities.size())
      m_velocities[k] = {0, 0, 0};
  }

  Entry& find_or_insert(vertex_descriptor v)
  {
    const std::size_t index = m_domain.index(v);
    if(m_slots[index] == Paged_index_map::none)
    {
      m_slots.reserve(index); // so that what throws throws before anything is changed
      reserve(1);
      insert(v);
      m_slots.set(index, static_cast<int>(m_entries.size() - 1));
    }
    return m_entries[m_slots[index]];
  }

  // Appends an entry, or leaves all as it was: points may have no move constructor, and throw.
  void insert(vertex_descriptor v)
  {
    const std::size_t size = m_entries.size();
    Point point = m_domain.point(v), rest = this->rest(v);
    try
    {
      if(Domain::coordinates(rest) != Domain::coordinates(point))
      {
        keep_first_points();
        m_first_points.push_back(point);
      }
      m_present_points.push_back(std::move(point));
      m_entries.push_back({v, no_target, std::move(rest), 0, false, false, false});
    }
    catch(...)
    {
      if(m_first_points.size() > size)
        m_first_points.pop_back();
      if(m_present_points.size() > size)
        m_present_points.pop_back();
      throw;
    }
  }

  // those that were inserted last, of vertices with indices that are among these
  void remove_entries_from(std::size_t size, const std::vector<std::size_t>& indices)
  {
    for(std::size_t index : indices)
      if(m_slots[index] >= static_cast<int>(size))
        m_slots.set(index, Paged_index_map::none);
    for(; m_entries.size() > size; m_entries.pop_back())
      m_present_points.pop_back();
    if(m_first_points.size() > size)
      m_first_points.erase(m_first_points.begin() + static_cast<std::ptrdiff_t>(size),
                           m_first_points.end());
  }

  Domain m_domain;
  Paged_index_map m_slots; // from Domain::index() to the place in m_entries
  Array<Entry> m_entries;
  std::vector<Point> m_present_points;
  Array<Target> m_targets;
  Surroundings<Domain> m_surroundings;
  std::vector<Point> m_first_points; // of the entries that had another rest shape
  std::map<Control_point, Held_point> m_points;
  Array<Coordinates> m_velocities;
  std::uint64_t m_number_of_insertions = 0;
  std::size_t m_last_point = 0; // its number, which no other one gets
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_VERTICES_H
