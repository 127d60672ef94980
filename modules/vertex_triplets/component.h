#pragma once

#include <array>

#include <pharos/statistics/gaussian.h>

#include "triplet.h"

namespace pharos::vertex_triplets {

/// Returns the number of entries in the lower triangle of a matrix with this number of rows.
constexpr int triangle(int rows) {
  return rows * (rows + 1) / 2;
}

/// A component over a prefix of P dimensions and the next vertex, relative to the center of its
/// cell [scene units]. It stores the Cholesky factor L of its covariance, which is all that
/// conditionals need (Schuessler et al. 2022, eq. 49). The first P rows of L whiten the prefix, z =
/// L11^-1 (prefix - mean). The next vertex then has the mean mean_2 + L21 z and the covariance L22
/// L22^T.
template <int P>
struct Component {
  static constexpr int kSize = P + 3;

  float weight = 0;
  std::array<float, kSize> mean{};
  /// Lower triangle of L by rows, with the reciprocals of the first P diagonal entries.
  std::array<float, triangle(kSize)> factor{};

  /// Returns whether all numbers are finite, and the weight and the diagonal of L are positive.
  bool is_sound() const;
  /// Returns L as a matrix.
  statistics::Matrix<kSize> cholesky() const;
  void archive(Archive& archive) {
    archive(weight, mean, factor);
    archive.expect(!archive.loads() || is_sound(), "the model of vertex triplets");
  }
};

/// Returns the component for a Gaussian. The component is not sound if rounding made the covariance
/// singular.
template <int P>
Component<P> make_component(double weight, const statistics::Gaussian<P + 3>& gaussian);

/// Returns the component for the opposite direction of paths: its prefix is (x_3, x_2), not
/// (x_1, x_2).
Component<6> reversed(const Component<6>& component);

}  // namespace pharos::vertex_triplets
