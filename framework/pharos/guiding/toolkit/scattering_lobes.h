#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/scene/local_scattering.h>

namespace pharos {

/// One lobe that a mixture is multiplied by: a von Mises-Fisher density up to a constant.
struct ScatteringLobe {
  Vec3 mean;        ///< unit
  float kappa = 0;  ///< > 0
  float peak = 1;   ///< its value at the mean, up to a constant common to all lobes
};

/// The factor that a mixture of incident radiance is multiplied by.
enum class ProductFactor {
  none,    ///< nothing
  cosine,  ///< the cosine on surfaces, or a lobe in its place
  bsdf     ///< lobes in place of BSDF and cosine, or of the phase function
};

/// Concentration of the lobe that approximates a clamped cosine about the normal (Ruppert et al.
/// 2020).
inline constexpr float kCosineKappa = 2.18853f;

/// At most two lobes that approximate the smooth scattering at a vertex, including the cosine.
struct ScatteringLobes {
  std::array<ScatteringLobe, 2> lobes;
  std::size_t count = 0;
};

inline constexpr std::uint32_t kMostScatteringSamples = 64;

/// Parameters of fit_scattering(). Guiders derive their settings from this class.
struct ScatteringFit {
  std::uint32_t bsdf_samples = 16;  ///< directions, at most kMostScatteringSamples
  float bsdf_tail = 0.1f;  ///< densities below this share of the largest make the second lobe
};

/// Declares the parameters of ScatteringFit for settings derived from it.
template <class Settings>
void describe_scattering_fit(Schema<Settings>& s) {
  s.field("bsdf_samples", &ScatteringFit::bsdf_samples,
          "For `bsdf`: number of sampled directions to which these lobes are fitted")
      .at_least(4)
      .at_most(kMostScatteringSamples);
  s.field("bsdf_tail", &ScatteringFit::bsdf_tail,
          "For `bsdf`: directions whose density is below this share of the largest density form "
          "the second lobe")
      .above(0)
      .below(1);
}

/// Fits lobes to directions that the scattering samples with a fixed point set. The result is
/// always the same for the same vertex. It is empty if the scattering samples no directions.
ScatteringLobes fit_scattering(const LocalScattering& scattering, const ScatteringFit& rule);

/// Returns a unit normal of a surface on the side from which the path comes.
Vec3 normal_towards_path(const GuidingQuery& query);
/// Returns whether the vertex is on a surface that transmits nothing, so that a cosine bounds it.
bool is_opaque_surface(const GuidingQuery& query);

template <>
struct EnumNames<ProductFactor> {
  static constexpr auto names =
      std::to_array<EnumName<ProductFactor>>({{"none", ProductFactor::none},
                                              {"cosine", ProductFactor::cosine},
                                              {"bsdf", ProductFactor::bsdf}});
};

}  // namespace pharos
