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

// The flat interface for JavaScript, by way of WebAssembly: index.js calls these functions and
// nothing else does. Arrays are pointers into the heap. Each function returns whether it succeeded;
// then there are numbers, else a message.

#include "../Array_deformation.h"

#include <emscripten.h>

#include <any>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::ARAP;
using bindings::Array_deformation;
using bindings::Indices;
using bindings::Numbers;

namespace {

struct Answer
{
  Answer() // has memory for what it says when there is none
  {
    status.reserve(32);
    message.reserve(32);
  }

  std::vector<double> numbers;
  std::string status, message;
} answer;

// No exception may leave C++.
template <typename Function>
bool answer_of(const Function& f)
{
  const auto refuse = [](const char* status, const char* message) {
    answer.status = status;
    answer.message = message;
    return false;
  };
  answer.numbers.clear();
  answer.status.clear();
  answer.message.clear();
  try
  {
    f();
    return true;
  }
  catch(const bindings::Deformation_error& error)
  {
    return refuse(to_string(error.status), error.what());
  }
  catch(const std::bad_alloc&)
  {
    return refuse("out_of_memory", "there is not enough memory");
  }
  catch(const std::exception& error) // misuse
  {
    return refuse("", error.what());
  }
}

template <typename Range>
void add(const Range& numbers)
{
  answer.numbers.insert(answer.numbers.end(), numbers.begin(), numbers.end());
}

void add(const Report& report)
{
  answer.status = to_string(report.status);
  answer.message = report.message;
  const auto& stages = report.stages;
  const auto& seconds = report.seconds;
  add(std::vector<double>{
    double(report.iterations), report.energy_scale, report.rounding_level,
    report.estimated_relative_gap, double(report.free_vertices), double(report.simplices),
    double(report.inverted_simplices), double(stages.region), double(stages.weights),
    double(stages.order), double(stages.factor), double(stages.border), seconds.preprocess,
    seconds.transfer, seconds.initial_guess, seconds.local_steps, seconds.global_steps,
    seconds.visitor, seconds.total, double(report.end), double(report.saddles_left),
    double(report.plateaus_left), double(report.looking_iterations), double(report.initial_guess),
    double(report.unconstrained_components.size())});
  add(report.unconstrained_components);
  add(report.energy);
}

void add(const Step_report& report)
{
  add(static_cast<const Report&>(report));
  add(std::vector<double>{report.mass, report.kinetic_energy, report.elastic_energy});
  add(report.center_of_mass);
  add(report.momentum);
  add(report.angular_momentum);
}

Array_deformation::Named_options options_of(const char* texts, std::size_t n)
{
  Array_deformation::Named_options options;
  const auto next = [&] {
    const std::string text = texts;
    texts += text.size() + 1;
    return text;
  };
  for(; n > 0; --n)
  {
    const std::string name = next();
    options[name] = next();
  }
  return options;
}

} // namespace

// the visitor that index.js has set; 0 to proceed, 1 to stop, 2 to cancel
EM_JS(int, arap_visit, (unsigned int iteration, double energy), {
  return Module["visit"](iteration, energy);
});

namespace {

const Array_deformation::Put_points* put_iterate = nullptr; // for the visitor that is called

Visitor_action visit(unsigned int iteration, double energy,
                     const Array_deformation::Put_points& put_points)
{
  const auto of_outer_run = std::exchange(put_iterate, &put_points);
  const auto action = static_cast<Visitor_action>(arap_visit(iteration, energy));
  put_iterate = of_outer_run;
  return action;
}

Array_deformation::Visitor visitor(bool visits)
{
  return visits ? visit : Array_deformation::Visitor();
}

} // namespace

extern "C" {

#define ARAP_EXPORT EMSCRIPTEN_KEEPALIVE

ARAP_EXPORT const double* arap_numbers() { return answer.numbers.data(); }
ARAP_EXPORT std::size_t arap_size() { return answer.numbers.size(); }
ARAP_EXPORT const char* arap_status() { return answer.status.c_str(); }
ARAP_EXPORT const char* arap_message() { return answer.message.c_str(); }

// null if it failed
ARAP_EXPORT Array_deformation* arap_create(const double* points, std::size_t n,
                                           const std::int32_t* simplices, std::size_t m,
                                           std::size_t k, bool is_volume, const char* weights)
{
  Array_deformation* result = nullptr;
  answer_of([&] {
    result = bindings::make_array_deformation({points, n, 3}, {simplices, m, k}, is_volume,
                                              weights).release();
  });
  return result;
}
ARAP_EXPORT void arap_delete(Array_deformation* d) { delete d; }

ARAP_EXPORT const double* arap_points(const Array_deformation* d) { return d->points(); }
ARAP_EXPORT bool arap_set_points(Array_deformation* d, const double* points, std::size_t rows)
{
  return answer_of([&] { d->set_points({points, rows, 3}); });
}
ARAP_EXPORT bool arap_rest_points(const Array_deformation* d)
{
  return answer_of([&] { add(d->rest_points()); });
}
// for the visitor that is called; null if it failed
ARAP_EXPORT const double* arap_iterate_points(const Array_deformation* d)
{
  const bool is_put = answer_of([&] {
    answer.numbers.resize(3 * d->number_of_vertices());
    (*put_iterate)(answer.numbers.data());
  });
  return is_put ? answer.numbers.data() : nullptr;
}

// texts: a name, its value, the next name, ...
ARAP_EXPORT bool arap_set_options(Array_deformation* d, const char* texts, std::size_t n)
{
  return answer_of([&] { d->set_options(options_of(texts, n)); });
}
// the message is the value; empty for an unknown name
ARAP_EXPORT bool arap_option(const Array_deformation* d, const char* name)
{
  return answer_of([&] { answer.message = d->option(name); });
}

ARAP_EXPORT bool arap_set_region(Array_deformation* d, const std::int32_t* vertices, std::size_t n)
{
  return answer_of([&] { d->set_region({vertices, n}); });
}
ARAP_EXPORT bool arap_region(const Array_deformation* d)
{
  return answer_of([&] { add(d->region()); });
}

ARAP_EXPORT bool arap_insert_handles(Array_deformation* d, const std::int32_t* vertices,
                                     std::size_t n)
{
  return answer_of([&] { d->insert_handles({vertices, n}); });
}
ARAP_EXPORT bool arap_erase_handles(Array_deformation* d, const std::int32_t* handles,
                                    std::size_t n)
{
  return answer_of([&] { d->erase_handles({handles, n}); });
}
ARAP_EXPORT bool arap_clear_handles(Array_deformation* d)
{
  return answer_of([&] { d->clear_handles(); });
}
ARAP_EXPORT bool arap_clear_points(Array_deformation* d)
{
  return answer_of([&] { d->clear_points(); });
}
ARAP_EXPORT bool arap_handles(const Array_deformation* d)
{
  return answer_of([&] { add(d->handles()); });
}

// for each point the number of coordinates, 0 if there is no place; simplex, distance, coordinates
ARAP_EXPORT bool arap_locate(const Array_deformation* d, const double* points, std::size_t rows)
{
  return answer_of([&] {
    for(const auto& place : d->locate({points, rows, 3}))
      if(place)
      {
        add(std::vector<double>{double(place->coordinates.size()), double(place->simplex),
                                place->distance});
        add(place->coordinates);
      }
      else
        add(std::vector<double>{0});
  });
}
// k coordinates for each simplex
ARAP_EXPORT bool arap_insert_points(Array_deformation* d, const std::int32_t* simplices,
                                    std::size_t n, const double* coordinates, std::size_t k)
{
  return answer_of([&] { add(d->insert_points({simplices, n}, {coordinates, n, k})); });
}
ARAP_EXPORT bool arap_positions(const Array_deformation* d, const std::int32_t* simplices,
                                std::size_t n, const double* coordinates, std::size_t k)
{
  return answer_of([&] { add(d->positions({simplices, n}, {coordinates, n, k})); });
}
ARAP_EXPORT bool arap_point_positions(const Array_deformation* d, const std::int32_t* handles,
                                      std::size_t n)
{
  return answer_of([&] { add(d->point_positions({handles, n})); });
}

ARAP_EXPORT bool arap_set_targets(Array_deformation* d, const std::int32_t* handles, std::size_t n,
                                  const double* targets, std::size_t rows)
{
  return answer_of([&] { d->set_targets({handles, n}, {targets, rows, 3}); });
}
ARAP_EXPORT bool arap_set_target_planes(Array_deformation* d, const std::int32_t* handles,
                                        std::size_t n, const double* points, std::size_t rows,
                                        const double* normals, std::size_t normal_rows)
{
  return answer_of([&] {
    d->set_target_planes({handles, n}, {points, rows, 3}, {normals, normal_rows, 3});
  });
}
ARAP_EXPORT bool arap_set_target_lines(Array_deformation* d, const std::int32_t* handles,
                                       std::size_t n, const double* points, std::size_t rows,
                                       const double* directions, std::size_t direction_rows)
{
  return answer_of([&] {
    d->set_target_lines({handles, n}, {points, rows, 3}, {directions, direction_rows, 3});
  });
}
ARAP_EXPORT bool arap_set_target_surface(Array_deformation* d, const std::int32_t* handles,
                                         std::size_t n, const double* points, std::size_t rows,
                                         const std::int32_t* polygons, std::size_t m, std::size_t k)
{
  return answer_of([&] {
    d->set_target_surface({handles, n}, {points, rows, 3}, {polygons, m, k});
  });
}
ARAP_EXPORT bool arap_targets(const Array_deformation* d, const std::int32_t* handles,
                              std::size_t n)
{
  return answer_of([&] { add(d->targets({handles, n})); });
}
ARAP_EXPORT bool arap_transform(Array_deformation* d, const std::int32_t* handles, std::size_t n,
                                const double* matrix, std::size_t rows, bool from_rest)
{
  return answer_of([&] { d->transform({handles, n}, {matrix, rows, 4}, from_rest); });
}
ARAP_EXPORT bool arap_weights(const Array_deformation* d, const std::int32_t* handles,
                              std::size_t n)
{
  return answer_of([&] { add(d->weights({handles, n})); });
}
ARAP_EXPORT bool arap_set_weights(Array_deformation* d, const std::int32_t* handles, std::size_t n,
                                  const double* weights, std::size_t rows)
{
  return answer_of([&] { d->set_weights({handles, n}, {weights, rows}); });
}
ARAP_EXPORT bool arap_set_rotations(Array_deformation* d, const std::int32_t* vertices,
                                    std::size_t n, const double* matrices, std::size_t rows)
{
  return answer_of([&] { d->set_rotations({vertices, n}, {matrices, rows, 9}); });
}
ARAP_EXPORT bool arap_set_rotations_of_motion(Array_deformation* d, const std::int32_t* vertices,
                                              std::size_t n)
{
  return answer_of([&] { d->set_rotations_of_motion({vertices, n}); });
}
ARAP_EXPORT bool arap_erase_rotations(Array_deformation* d, const std::int32_t* vertices,
                                      std::size_t n)
{
  return answer_of([&] { d->erase_rotations({vertices, n}); });
}

ARAP_EXPORT bool arap_set_stiffness(Array_deformation* d, const double* values, std::size_t n)
{
  return answer_of([&] { d->set_stiffness({values, n}); });
}
ARAP_EXPORT bool arap_set_groups(Array_deformation* d, const std::int32_t* groups, std::size_t n)
{
  return answer_of([&] { d->set_groups({groups, n}); });
}

ARAP_EXPORT bool arap_preprocess(Array_deformation* d)
{
  return answer_of([&] { answer.message = d->preprocess(); });
}
// with options for this call
ARAP_EXPORT bool arap_deform(Array_deformation* d, const char* texts, std::size_t n, bool visits)
{
  return answer_of([&] {
    const Options options = d->options_with(options_of(texts, n));
    const Report report = d->deform(options.iterations, options.tolerance, visitor(visits));
    answer.numbers.clear(); // of what a visitor may have asked
    add(report);
  });
}
ARAP_EXPORT bool arap_advance(Array_deformation* d, double time_step, double density,
                              double modulus, double damping, const double* acceleration,
                              const double* forces, std::size_t rows, bool visits)
{
  return answer_of([&] {
    const Dynamics dynamics{time_step, density, modulus, damping,
                            {acceleration[0], acceleration[1], acceleration[2]}};
    const Step_report report = d->advance(dynamics, {forces, rows, 3}, visitor(visits));
    answer.numbers.clear();
    add(report);
  });
}

ARAP_EXPORT bool arap_reset(Array_deformation* d)
{
  return answer_of([&] { d->reset(); });
}
ARAP_EXPORT bool arap_make_rest_shape(Array_deformation* d)
{
  return answer_of([&] { d->make_rest_shape(); });
}

ARAP_EXPORT std::any* arap_state(const Array_deformation* d)
{
  std::any* state = nullptr;
  answer_of([&] { state = new std::any(d->state()); });
  return state;
}
ARAP_EXPORT bool arap_restore(Array_deformation* d, const std::any* state)
{
  return answer_of([&] { d->restore(*state); });
}
ARAP_EXPORT void arap_delete_state(std::any* state) { delete state; }

ARAP_EXPORT bool arap_energy(const Array_deformation* d)
{
  return answer_of([&] { add(std::vector<double>{d->energy()}); });
}
ARAP_EXPORT bool arap_velocities(const Array_deformation* d)
{
  return answer_of([&] { add(d->velocities()); });
}
ARAP_EXPORT bool arap_set_velocities(Array_deformation* d, const std::int32_t* vertices,
                                     std::size_t n, const double* velocities, std::size_t rows)
{
  return answer_of([&] { d->set_velocities({vertices, n}, {velocities, rows, 3}); });
}
ARAP_EXPORT bool arap_rotations(const Array_deformation* d)
{
  return answer_of([&] { add(d->rotations()); });
}
ARAP_EXPORT bool arap_quality(const Array_deformation* d)
{
  return answer_of([&] {
    const Quality q = d->quality();
    add(std::vector<double>{q.edge_length_error, q.area_change, q.volume_change,
                            q.largest_angle_change, q.largest_spike,
                            double(q.inverted_simplices)});
  });
}
ARAP_EXPORT bool arap_quality_at_vertices(const Array_deformation* d, const char* measure)
{
  return answer_of([&] { add(d->quality_at_vertices(measure)); });
}

} // extern "C"
