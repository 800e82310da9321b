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

#ifndef CGAL_ARAP_DEFORMATION_CHOSEN_EDGE_WEIGHT_H
#define CGAL_ARAP_DEFORMATION_CHOSEN_EDGE_WEIGHT_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/flat_types.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <variant>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationWeights
/// \brief one of the other weights, chosen by its name at run time: for programs that let their
/// users choose.
///
/// \cgalModels{ARAPEdgeWeight}
class Chosen_edge_weight
{
public:
  /// chooses `safe_cotangent`, `cotangent`, `clamped_cotangent` or `uniform`.
  /// \throws std::invalid_argument for another name, with a message that lists these
  explicit Chosen_edge_weight(const std::string& name = "safe_cotangent")
  {
    if(name == "cotangent")
      m_weight = Cotangent_weight();
    else if(name == "clamped_cotangent")
      m_weight = Clamped_cotangent_weight();
    else if(name == "uniform")
      m_weight = Uniform_weight();
    else if(name != "safe_cotangent")
      throw std::invalid_argument("weights '" + name + "' is not known; use one of "
                                  "safe_cotangent, cotangent, clamped_cotangent, uniform");
  }

  /// returns the weights of the edges of a triangle or a tetrahedron.
  template <std::size_t N>
  auto simplex_weights(const std::array<Coordinates, N>& simplex) const
  {
    return std::visit([&](const auto& w) { return w.simplex_weights(simplex); }, m_weight);
  }

  /// returns the weight of an edge, whose weights in its simplices add up to `sum`.
  double edge_weight(Edge_set edge_set, std::size_t i, std::size_t j, double sum) const
  {
    return std::visit([&](const auto& w) { return w.edge_weight(edge_set, i, j, sum); }, m_weight);
  }

private:
  std::variant<Safe_cotangent_weight, Cotangent_weight, Clamped_cotangent_weight, Uniform_weight>
    m_weight;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CHOSEN_EDGE_WEIGHT_H
