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

// The time of one closest rotation, with the covariances and the previous rotations of a real run.

#include "include/deformations.h"
#include "include/run_benchmark.h"
#include "include/star_energy.h"

#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>

#include <CGAL/Deformation_Eigen_closest_rotation_traits_3.h>
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace {

using namespace benchmark;

// the input of one local step
struct Batch
{
  std::vector<ARAP::Matrix_3x3> covariances, rotations;

  std::size_t size() const { return covariances.size(); }
};

// Fits like SVD_closest_rotation, and records its input while told to. Parts of a step may be
// processed concurrently.
class Recording_rotation
{
public:
  struct Record
  {
    bool is_on = false;
    Batch batch;
    std::mutex mutex;
  };

  explicit Recording_rotation(Record& record) : m_record(&record) {}

  void operator()(std::size_t n, const ARAP::Matrix_3x3* covariances,
                  ARAP::Matrix_3x3* rotations) const
  {
    if(m_record->is_on)
    {
      const std::lock_guard<std::mutex> lock(m_record->mutex);
      Batch& batch = m_record->batch;
      batch.covariances.insert(batch.covariances.end(), covariances, covariances + n);
      batch.rotations.insert(batch.rotations.end(), rotations, rotations + n);
    }
    m_rotation(n, covariances, rotations);
  }

private:
  Record* m_record;
  ARAP::SVD_closest_rotation m_rotation;
};

// the input of the local step after so many iterations
Batch record_batch(const Scenario& scenario, unsigned int iterations)
{
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Clamped_angle_weight,
                                                 Recording_rotation>;
  Recording_rotation::Record record;
  Our_deformation<Traits> ours(scenario, Traits(Traits::Sparse_solver(), Clamped_angle_weight(),
                                                Recording_rotation(record)));
  ours.restart();
  expect_success(ours.deformation().deform(iterations, 0, [&](const auto& iterate) {
    record.is_on = iterate.iteration() + 1 == iterations;
    return ARAP::Visitor_action::proceed;
  }));
  return record.batch;
}

template <typename Rotation>
void add_row(const std::string& name, const Rotation& rotation, const std::string& start,
             const Batch& batch, const Settings& settings, Json& rows)
{
  std::vector<ARAP::Matrix_3x3> rotations;
  const double seconds =
    median_seconds(settings.quick ? 0.2 : 1, 5, [&] { rotations = batch.rotations; }, [&] {
      rotation(batch.size(), batch.covariances.data(), rotations.data());
    });

  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  double largest = 0;
  for(std::size_t k = 0; k < batch.size(); ++k)
  {
    const Matrix expected = Star_energy::closest_rotation(
      Eigen::Map<const Matrix>(batch.covariances[k].data()));
    largest = larger(largest,
                     (Eigen::Map<const Matrix>(rotations[k].data()) - expected).norm());
  }
  verify_at_most(largest, 1e-6, "the largest difference between the rotations of " + name +
                                " and those of Eigen's singular value decomposition");
  rows.push_back({{"rotation", name},
                  {"start", start},
                  {"nanoseconds", 1e9 * seconds / static_cast<double>(batch.size())},
                  {"largest_difference", largest}});
}

Json run(const Settings& settings)
{
  const Scenario scenario = make_scenario(read_mesh(settings.file_or("armadillo.off")));
  Json section = make_section(
    "The closest rotation",
    "Nanoseconds for one cell on one thread, and the largest difference (Frobenius norm) from "
    "Eigen's JacobiSVD, in the local step after twenty iterations. Warm: from the rotations of the "
    "step before, as in a run. Cold: from identities.",
    {{"rotation", "model"}, {"start", "start"}, {"nanoseconds", "ns"},
     {"largest_difference", "largest difference"}});
  const Thread_limit limit(1);
  const Batch warm = record_batch(scenario, 20);
  Batch cold = warm;
  std::fill(cold.rotations.begin(), cold.rotations.end(),
            ARAP::Matrix_3x3{1, 0, 0, 0, 1, 0, 0, 0, 1});
  for(const bool is_warm : {false, true})
  {
    const Batch& batch = is_warm ? warm : cold;
    const auto add = [&](const std::string& name, const auto& rotation) {
      add_row(name, rotation, is_warm ? "warm" : "cold", batch, settings, section["rows"]);
    };
    add("Newton_closest_rotation", ARAP::Newton_closest_rotation());
    add("SVD_closest_rotation", ARAP::SVD_closest_rotation());
    add("CGAL, SVD", ARAP::Closest_rotation_traits_adaptor<
                       CGAL::Deformation_Eigen_closest_rotation_traits_3>());
    add("CGAL, polar", ARAP::Closest_rotation_traits_adaptor<
                         CGAL::Deformation_Eigen_polar_closest_rotation_traits_3>());
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "closest_rotation",
                       "usage: closest_rotation [options]\n\n"
                       "Measures the time of the closest rotation of a matrix.", run,
                       {"mesh"});
}
