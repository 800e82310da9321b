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

// The flat interface for Python: the module arap_deformation._core. Only the Python file of
// arap_deformation calls it, which has made all arrays contiguous, of these types, and its own.

#include "../Array_deformation.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <any>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace py::literals;
using namespace CGAL::ARAP;
using bindings::Array_deformation;

namespace {

using Doubles = py::array_t<double, py::array::c_style>;
using Integers = py::array_t<std::int32_t, py::array::c_style>;

struct State
{
  std::any value;
};

// Arguments and results of the flat interface, for Python. The types of arguments are what Python
// passes; results are made with the GIL held.
template <typename T> struct Argument { using Type = T; };
template <> struct Argument<bindings::Indices> { using Type = Integers; };
template <> struct Argument<bindings::Numbers> { using Type = Doubles; };
template <> struct Argument<const std::any&> { using Type = const State&; };
template <> struct Argument<const std::string&> { using Type = std::string; };

template <typename T>
bindings::Rows<T> rows(const py::array_t<T, py::array::c_style>& array)
{
  return {array.data(), std::size_t(array.shape(0)),
          array.ndim() == 1 ? 1 : std::size_t(array.shape(1))};
}

template <typename To, typename From>
decltype(auto) argument(const From& value)
{
  if constexpr(std::is_same_v<To, const std::any&>)
    return (value.value);
  else if constexpr(std::is_base_of_v<py::array, From>)
    return rows(value);
  else
    return (value);
}

template <typename T>
const T& result(const T& value) { return value; }
State result(std::any value) { return {std::move(value)}; }
template <typename T>
py::array_t<T> result(const std::vector<T>& values)
{
  return py::array_t<T>(py::ssize_t(values.size()), values.data());
}

py::dict result(const Quality& q)
{
  return py::dict("edge_length_error"_a = q.edge_length_error, "area_change"_a = q.area_change,
                  "volume_change"_a = q.volume_change,
                  "largest_angle_change"_a = q.largest_angle_change,
                  "largest_spike"_a = q.largest_spike,
                  "inverted_simplices"_a = q.inverted_simplices);
}

py::list result(const std::vector<std::optional<bindings::Place>>& places)
{
  py::list list;
  for(const auto& place : places)
    if(place)
      list.append(py::make_tuple(place->simplex, result(place->coordinates), place->distance));
    else
      list.append(py::none());
  return list;
}

py::dict result(const Report& r)
{
  const Phase_seconds& s = r.seconds;
  return py::dict(
    "status"_a = to_string(r.status), "message"_a = r.message,
    "initial_guess"_a = to_string(r.initial_guess), "iterations"_a = r.iterations,
    "energy"_a = result(r.energy), "energy_scale"_a = r.energy_scale,
    "rounding_level"_a = r.rounding_level, "estimated_relative_gap"_a = r.estimated_relative_gap,
    "free_vertices"_a = r.free_vertices, "simplices"_a = r.simplices,
    "inverted_simplices"_a = r.inverted_simplices, "end"_a = to_string(r.end),
    "saddles_left"_a = r.saddles_left, "plateaus_left"_a = r.plateaus_left,
    "looking_iterations"_a = r.looking_iterations,
    "unconstrained_components"_a = r.unconstrained_components,
    "stages"_a = py::dict("region"_a = r.stages.region, "weights"_a = r.stages.weights,
                          "order"_a = r.stages.order, "factor"_a = r.stages.factor,
                          "border"_a = r.stages.border),
    "seconds"_a = py::dict("preprocess"_a = s.preprocess, "transfer"_a = s.transfer,
                           "initial_guess"_a = s.initial_guess, "local_steps"_a = s.local_steps,
                           "global_steps"_a = s.global_steps, "visitor"_a = s.visitor,
                           "total"_a = s.total));
}

py::dict result(const Step_report& r)
{
  py::dict d = result(static_cast<const Report&>(r));
  d["mass"] = r.mass;
  d["center_of_mass"] = r.center_of_mass;
  d["momentum"] = r.momentum;
  d["angular_momentum"] = r.angular_momentum;
  d["kinetic_energy"] = r.kinetic_energy;
  d["elastic_energy"] = r.elastic_energy;
  return d;
}

// Work without the GIL. Python must not end while there is some, by a daemon thread: that could not
// take the GIL again. So at its end runs of other threads than the one that ends it are cancelled,
// and what is at work is waited for: for five seconds at most, as it may itself wait for what ends.
class Long_work
{
public:
  Long_work()
  {
    ++s_count;
    if(is_ending())
    {
      --s_count;
      throw bindings::Deformation_error(Outcome(Status::cancelled, "Python is ending"));
    }
  }
  ~Long_work() { --s_count; }
  Long_work(const Long_work&) = delete;
  Long_work& operator=(const Long_work&) = delete;

  static bool is_ending() { return s_is_ending && std::this_thread::get_id() != s_last_thread; }

  // to be called with the GIL
  static void end()
  {
    s_last_thread = std::this_thread::get_id();
    s_is_ending = true;
    const py::gil_scoped_release release;
    using Clock = std::chrono::steady_clock;
    const Clock::time_point latest = Clock::now() + std::chrono::seconds(5);
    while(s_count > 0 && Clock::now() < latest)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

private:
  static inline std::atomic<int> s_count{0};
  static inline std::atomic<bool> s_is_ending{false};
  static inline std::thread::id s_last_thread; // which ends Python
};

// Calls a function of Python, and lets Python handle signals now and then: its exceptions end the
// run, as a visitor's do.
class Python_visitor
{
public:
  Python_visitor(const py::object& function, const Array_deformation& deformation)
    : m_function(&function), m_deformation(&deformation)
  {}

  Visitor_action operator()(unsigned int iteration, double energy,
                            const Array_deformation::Put_points& put_points)
  {
    if(Long_work::is_ending())
      return Visitor_action::cancel;
    const auto now = std::chrono::steady_clock::now();
    if(m_function->is_none() && now - m_last < std::chrono::milliseconds(50))
      return Visitor_action::proceed;
    m_last = now;
    const py::gil_scoped_acquire acquire;
    if(PyErr_CheckSignals() != 0)
      throw py::error_already_set();
    const Iterate_points points(put_points, m_deformation->number_of_vertices());
    const py::object answer = m_function->is_none()
                                ? py::none()
                                : (*m_function)(iteration, energy, points.function());
    const std::string name = py::str(answer);
    if(answer.is_none() || name == "proceed")
      return Visitor_action::proceed;
    if(name == "stop" || name == "cancel")
      return name == "stop" ? Visitor_action::stop : Visitor_action::cancel;
    throw std::invalid_argument("a visitor returns None, 'proceed', 'stop' or 'cancel', not " +
                                std::string(py::repr(answer)));
  }

private:
  // a function that returns the points of an iterate, as long as this object lives
  class Iterate_points
  {
  public:
    Iterate_points(const Array_deformation::Put_points& put, std::size_t n)
      : m_put(std::make_shared<const Array_deformation::Put_points*>(&put)), m_n(n)
    {}
    ~Iterate_points() { *m_put = nullptr; }
    Iterate_points(const Iterate_points&) = delete;
    Iterate_points& operator=(const Iterate_points&) = delete;

    py::cpp_function function() const
    {
      return {[put = m_put, n = py::ssize_t(m_n)] {
        if(*put == nullptr)
          throw std::invalid_argument("the visitor has returned: its points are gone");
        py::array_t<double> points({n, py::ssize_t(3)});
        (**put)(points.mutable_data());
        return points;
      }};
    }

  private:
    std::shared_ptr<const Array_deformation::Put_points*> m_put;
    std::size_t m_n;
  };

  const py::object* m_function;
  const Array_deformation* m_deformation;
  std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

// A deformation for one call at a time. The long ones release the GIL; the others keep it, so that
// they are refused only while a long one works, and refuse none.
class Session
{
public:
  Session(const Doubles& points, const Integers& simplices, bool is_volume,
          const std::string& weights)
  {
    const auto p = rows(points);
    const auto s = rows(simplices);
    const Long_work work;
    const py::gil_scoped_release release;
    m_deformation = bindings::make_array_deformation(p, s, is_volume, weights);
  }

  template <typename Function>
  auto at_work(const Function& f, bool is_long = false)
  {
    if(m_is_at_work.exchange(true))
      throw bindings::Deformation_error(Outcome(
        Status::in_a_run,
        "the deformation is at work, in another thread or for this visitor; wait for its end"));
    struct Guard
    {
      std::atomic<bool>& is_at_work;
      ~Guard() { is_at_work = false; }
    } guard{m_is_at_work};
    if(!is_long)
      return f(*m_deformation);
    const Long_work work;
    const py::gil_scoped_release release;
    return f(*m_deformation);
  }

  // A view of the positions, which keeps the object alive. They change when a call has succeeded.
  static py::array points(const py::object& self)
  {
    const Array_deformation& d = *self.cast<Session&>().m_deformation;
    py::array view(py::dtype::of<double>(), {d.number_of_vertices(), std::size_t(3)}, d.points(),
                   self);
    view.attr("setflags")("write"_a = false);
    return view;
  }

private:
  std::unique_ptr<Array_deformation> m_deformation;
  std::atomic<bool> m_is_at_work{false};
};

// a function of the flat interface as one of the session
template <typename Member, typename Result, typename... Arguments>
auto bound(Member f, bool is_long)
{
  return [=](Session& session, const typename Argument<Arguments>::Type&... arguments) {
    const auto call = [&](Array_deformation& d) {
      return (d.*f)(argument<Arguments>(arguments)...);
    };
    if constexpr(std::is_void_v<Result>)
      session.at_work(call, is_long);
    else
      return result(session.at_work(call, is_long));
  };
}
template <typename Result, typename... Arguments>
auto bound(Result (Array_deformation::*f)(Arguments...), bool is_long = false)
{
  return bound<decltype(f), Result, Arguments...>(f, is_long);
}
template <typename Result, typename... Arguments>
auto bound(Result (Array_deformation::*f)(Arguments...) const, bool is_long = false)
{
  return bound<decltype(f), Result, Arguments...>(f, is_long);
}

// with options for this call only
py::dict deform(Session& session, const Array_deformation::Named_options& values,
                const py::object& visitor)
{
  return result(session.at_work([&](Array_deformation& d) {
    const Options options = d.options_with(values);
    return d.deform(options.iterations, options.tolerance, Python_visitor(visitor, d));
  }, true));
}

py::dict advance(Session& session, double time_step, double density, double modulus, double damping,
                 const Coordinates& acceleration, const Doubles& forces, const py::object& visitor)
{
  const Dynamics dynamics{time_step, density, modulus, damping, acceleration};
  const auto f = rows(forces);
  return result(session.at_work([&](Array_deformation& d) {
    return d.advance(dynamics, f, Python_visitor(visitor, d));
  }, true));
}

} // namespace

PYBIND11_MODULE(_core, module)
{
  py::register_exception_translator([](std::exception_ptr thrown) {
    try
    {
      std::rethrow_exception(thrown);
    }
    catch(const bindings::Deformation_error& error)
    {
      const py::object type = py::module_::import("arap_deformation").attr("DeformationError");
      PyErr_SetObject(type.ptr(), type(error.what(), to_string(error.status)).ptr());
    }
  });

  py::module_::import("atexit").attr("register")(py::cpp_function(&Long_work::end));

  py::class_<State>(module, "State", "What state() returns, for restore().");
  using D = Array_deformation;
  constexpr bool is_long = true;
  py::class_<Session>(module, "Session")
    .def(py::init<const Doubles&, const Integers&, bool, const std::string&>())
    .def("points", &Session::points).def("set_points", bound(&D::set_points))
    .def("rest_points", bound(&D::rest_points))
    .def("option", bound(&D::option)).def("set_options", bound(&D::set_options))
    .def("region", bound(&D::region)).def("set_region", bound(&D::set_region))
    .def("handles", bound(&D::handles)).def("clear_handles", bound(&D::clear_handles))
    .def("insert_handles", bound(&D::insert_handles))
    .def("erase_handles", bound(&D::erase_handles)).def("clear_points", bound(&D::clear_points))
    .def("locate", bound(&D::locate, is_long)).def("insert_points", bound(&D::insert_points))
    .def("positions", bound(&D::positions, is_long))
    .def("point_positions", bound(&D::point_positions))
    .def("targets", bound(&D::targets)).def("set_targets", bound(&D::set_targets))
    .def("set_target_planes", bound(&D::set_target_planes))
    .def("set_target_lines", bound(&D::set_target_lines))
    .def("set_target_surface", bound(&D::set_target_surface, is_long))
    .def("transform", bound(&D::transform))
    .def("weights", bound(&D::weights)).def("set_weights", bound(&D::set_weights))
    .def("set_rotations", bound(&D::set_rotations))
    .def("set_rotations_of_motion", bound(&D::set_rotations_of_motion))
    .def("erase_rotations", bound(&D::erase_rotations))
    .def("set_stiffness", bound(&D::set_stiffness)).def("set_groups", bound(&D::set_groups))
    .def("preprocess", bound(&D::preprocess, is_long))
    .def("deform", &deform).def("advance", &advance)
    .def("velocities", bound(&D::velocities)).def("set_velocities", bound(&D::set_velocities))
    .def("reset", bound(&D::reset)).def("make_rest_shape", bound(&D::make_rest_shape))
    .def("state", bound(&D::state)).def("restore", bound(&D::restore))
    .def("energy", bound(&D::energy)).def("rotations", bound(&D::rotations))
    .def("quality", bound(&D::quality, is_long))
    .def("quality_at_vertices", bound(&D::quality_at_vertices, is_long));
}
