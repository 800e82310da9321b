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

#ifndef CGAL_ARAP_DEFORMATION_CLOSEST_ROTATION_TRAITS_ADAPTOR_H
#define CGAL_ARAP_DEFORMATION_CLOSEST_ROTATION_TRAITS_ADAPTOR_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRotations
/// \brief adapts any model of CGAL's concept `DeformationClosestRotationTraits_3` to this package.
///
/// Uses only the operations of that concept. Its covariances are the transposes of ours, and are
/// scaled by powers of two to about one, so that nothing overflows or underflows. The rotation of
/// the zero matrix, and of one that is not finite, is the identity; the model is not called for it.
///
/// Results that are orthonormal up to a small error are made orthonormal up to rounding: CGAL's
/// `Deformation_Eigen_polar_closest_rotation_traits_3` leaves errors of up to \f$5 \cdot
/// 10^{-7}\f$. All other results are returned unchanged.
///
/// \tparam ClosestRotationTraits a model of `DeformationClosestRotationTraits_3`. One object is
///         constructed for each batch; in programs linked with TBB several may be in use at once,
///         in different threads.
///
/// \cgalModels{ARAPClosestRotation}
template <typename ClosestRotationTraits>
class Closest_rotation_traits_adaptor
{
public:
  /// the adapted type.
  using Closest_rotation_traits = ClosestRotationTraits;

  /// computes `rotations[k]`, the rotation closest to `covariances[k]`, for `k` in `[0, n)`.
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const
  {
    ClosestRotationTraits traits; // its functions need not be const
    for(std::size_t k = 0; k < n; ++k)
      rotations[k] = closest_rotation(traits, covariances[k], rotations[k]);
  }

private:
  using Matrix = typename ClosestRotationTraits::Matrix;
  using Vector = typename ClosestRotationTraits::Vector;

  static Matrix_3x3 closest_rotation(ClosestRotationTraits& traits, const Matrix_3x3& covariance,
                                     const Matrix_3x3& previous)
  {
    double largest = 0;
    bool are_finite = true;
    for(double entry : covariance)
    {
      are_finite &= internal::is_finite(entry);
      largest = (std::max)(largest, std::abs(entry));
    }
    if(!are_finite || largest == 0)
      return internal::identity_matrix();
    int exponent;
    std::frexp(largest, &exponent);
    Matrix_3x3 transposed;
    for(std::size_t row = 0; row < 3; ++row)
      for(std::size_t column = 0; column < 3; ++column)
        transposed[3 * row + column] = std::ldexp(covariance[3 * column + row], -exponent);

    Matrix rotation = matrix(traits, previous);
    traits.compute_close_rotation(matrix(traits, transposed), rotation);
    Matrix_3x3 result = entries(traits, rotation);
    for(int step = 0; step < 3 && remove_small_shear(result); ++step) {}
    return result;
  }

  // One step r (I - e / 2) toward the orthonormal matrix closest to r, with e = r^T r - I, which
  // converges quadratically. Returns false if e is too large to remove, or only rounding.
  static bool remove_small_shear(Matrix_3x3& r)
  {
    Matrix_3x3 correction;
    double largest = 0;
    for(std::size_t a = 0; a < 3; ++a)
      for(std::size_t b = 0; b < 3; ++b)
      {
        const double error = r[a] * r[b] + r[3 + a] * r[3 + b] + r[6 + a] * r[6 + b] - (a == b);
        if(!(std::abs(error) < 1e-3))
          return false;
        largest = (std::max)(largest, std::abs(error));
        correction[3 * a + b] = -error / 2;
      }
    if(largest < 1e-14)
      return false;
    for(std::size_t row = 0; row < 3; ++row)
    {
      const Coordinates old = {r[3 * row], r[3 * row + 1], r[3 * row + 2]};
      const Coordinates change = internal::product(correction, old);
      for(std::size_t column = 0; column < 3; ++column)
        r[3 * row + column] += change[column];
    }
    return true;
  }

  // the sum of c e^T over the columns c of m, with e the unit vector of the column
  static Matrix matrix(ClosestRotationTraits& traits, const Matrix_3x3& m)
  {
    Matrix result = traits.zero_matrix();
    for(std::size_t column = 0; column < 3; ++column)
      traits.add_scalar_t_vector_t_vector_transpose(
        result, 1, traits.vector(m[column], m[3 + column], m[6 + column]), unit(traits, column));
    return result;
  }

  // column by column, each as the product with a unit vector
  static Matrix_3x3 entries(ClosestRotationTraits& traits, const Matrix& m)
  {
    Matrix_3x3 result;
    for(std::size_t column = 0; column < 3; ++column)
    {
      Vector product = traits.vector(0, 0, 0);
      traits.add__scalar_t_matrix_p_scalar_t_matrix__t_vector(
        product, 1, m, 0, traits.identity_matrix(), unit(traits, column));
      for(int row = 0; row < 3; ++row)
        result[3 * static_cast<std::size_t>(row) + column] = traits.vector_coordinate(product, row);
    }
    return result;
  }

  static Vector unit(ClosestRotationTraits& traits, std::size_t k)
  {
    return traits.vector(k == 0, k == 1, k == 2);
  }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CLOSEST_ROTATION_TRAITS_ADAPTOR_H
