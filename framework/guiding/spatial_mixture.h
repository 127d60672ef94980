#pragma once

#include <span>
#include <string_view>

#include <pharos/core/arena.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/guider.h>

namespace pharos {

/// One component of a mixture of 3D Gaussians over positions of the next vertex.
struct SpatialGaussian {
  float weight = 0;  ///< >= 0; the weights of a mixture sum to 1
  Point3 mean;
  /// Lower triangle of the Cholesky factor L of the covariance, Sigma = L L^T [scene units]:
  /// l00, l10, l11, l20, l21, l22.
  float cholesky[6] = {1, 0, 1, 0, 0, 1};
};

/// Neutral contract of models that hold mixtures of 3D Gaussians: guiders of any module can sample
/// a model that also derives from this. Its name for GuiderTraits and LearnerTraits:
inline constexpr std::string_view kSpatialMixtureModel = "spatial_mixture";

class SpatialMixture {
 public:
  /// A mixture at one vertex and the region it belongs to.
  struct View {
    std::span<const SpatialGaussian> components;  ///< empty: nothing known here
    std::uint32_t region = 0;
  };

  virtual ~SpatialMixture() = default;
  /// The mixture of next-vertex positions at a query, perhaps conditioned on its prefix. Lives in
  /// the model or in `arena`.
  virtual View mixture_at(const GuidingQuery& query, Arena& arena) const = 0;
};

}  // namespace pharos
