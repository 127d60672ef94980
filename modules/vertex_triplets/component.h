#pragma once

#include <array>
#include <iosfwd>

#include <pharos/statistics/gaussian.h>

#include "triplet.h"

namespace pharos::vertex_triplets {

/// Number of entries in the lower triangle of a matrix of so many rows.
constexpr int triangle(int rows) {
  return rows * (rows + 1) / 2;
}

/// A component over a prefix of P dimensions and the next vertex, about the middle of its cell
/// [scene units]. The Cholesky factor L of its covariance says all that conditionals need
/// (Schuessler et al. 2022, eq. 49): its first P rows whiten the prefix, z = L11^-1 (prefix -
/// mean); the next vertex has then the mean mean_2 + L21 z and the covariance L22 L22^T.
template <int P>
struct Component {
  static constexpr int kSize = P + 3;

  float weight = 0;
  std::array<float, kSize> mean{};
  /// Lower triangle of L by rows, of the first P diagonal entries the reciprocals.
  std::array<float, triangle(kSize)> factor{};

  /// Whether all numbers are finite, and the weight and L's diagonal positive.
  bool is_sound() const;
  /// L as a matrix.
  statistics::Matrix<kSize> cholesky() const;
  void save(std::ostream& out) const;
  /// Throws InputError when it is damaged.
  static Component load(std::istream& in);
};

/// The component of a Gaussian; not sound if its covariance has lost its rank to rounding.
template <int P>
Component<P> make_component(double weight, const statistics::Gaussian<P + 3>& gaussian);

/// The component for the way back: its prefix is (x_3, x_2) where this one's is (x_1, x_2).
Component<6> reversed(const Component<6>& component);

}  // namespace pharos::vertex_triplets
