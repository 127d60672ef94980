#pragma once

#include <span>
#include <string_view>

#include <pharos/core/arena.h>
#include <pharos/guiding/contract/spatial_gaussian.h>
#include <pharos/guiding/contract/vertex.h>
#include <pharos/guiding/contract/whitened_group.h>

namespace pharos {

/// Neutral contract of models that hold mixtures of 3D Gaussians. Guiders of any module can sample
/// a model that also derives from this class.
class SpatialMixture {
 public:
  static constexpr std::string_view kName = "spatial_mixture";

  virtual ~SpatialMixture() = default;
  /// Returns the mixture of positions of the next vertex, which may depend on the prefix of the
  /// path. The mixture lives in the model or in `arena`. It is empty if nothing is known here.
  virtual std::span<const SpatialGaussian> mixture_at(const GuidingQuery& query,
                                                      Arena& arena) const = 0;
  /// Returns the components of mixture_at() in whitened groups, in the same order, if the model
  /// keeps them. Otherwise returns an empty span, and guiders whiten the components themselves.
  virtual std::span<const WhitenedGroup> whitened_at(const GuidingQuery&) const { return {}; }
};

}  // namespace pharos
