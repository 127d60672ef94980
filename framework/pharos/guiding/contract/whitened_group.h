#pragma once

#include <cstddef>
#include <span>

#include <pharos/core/lanes3.h>
#include <pharos/core/simd.h>
#include <pharos/guiding/contract/spatial_gaussian.h>

namespace pharos {

/// The lower triangle of l00 L^-1, for eight components. The factor l00 keeps floats in range.
template <typename Number>
struct Whitening8 {
  /// Returns the whitened vectors, times l00.
  Lanes3<Number> operator()(const Lanes3<Number>& v) const {
    return {v.x, r10 * v.x + r11 * v.y, r20 * v.x + r21 * v.y + r22 * v.z};
  }
  Number r10, r11, r20, r21, r22;
};

inline Whitening8<Double8> widened(const Whitening8<Float8>& w) {
  return {widened(w.r10), widened(w.r11), widened(w.r20), widened(w.r21), widened(w.r22)};
}

/// Up to eight components of a mixture, one in each lane, with everything about their densities
/// that depends neither on the origin nor on the direction. Lanes without a component have the
/// weight 0 and repeat another component.
struct WhitenedGroup {
  static constexpr std::size_t kLanes = 8;

  /// Takes the first eight of at least one component.
  explicit WhitenedGroup(std::span<const SpatialGaussian> components);

  Float8 weight;        ///< as in SpatialGaussian
  Lanes3<Float8> mean;  ///< [scene units]
  Whitening8<Float8> whitening;
  Float8 over_l00;  ///< 1 / l00 [1/scene unit]
  Float8 flatness;  ///< l00^2 / (2 pi l11 l22) [1]

 private:
  void fill(const SpatialGaussian* eight);
};

}  // namespace pharos
