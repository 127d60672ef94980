#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>

#include "model.h"
#include "scattering_lobes.h"

namespace pharos {
namespace parallax_aware_mixtures {

/// The factor that the mixture of incident radiance is multiplied by.
enum class ProductFactor {
  none,    ///< nothing
  cosine,  ///< a lobe in place of the cosine, on opaque surfaces
  bsdf     ///< lobes in place of BSDF and cosine, or of the phase function
};

struct ParallaxAwareMixturesGuiderSettings {
  ProductFactor product = ProductFactor::cosine;
  std::uint32_t bsdf_samples = 16;
  float bsdf_tail = 0.1f;
  static void describe(Schema<ParallaxAwareMixturesGuiderSettings>& schema);
};

/// Samples directions in proportion to mixtures of von Mises-Fisher lobes (Ruppert et al. 2020).
class ParallaxAwareMixturesGuider final : public GuiderOf<ParallaxAwareMixturesModel> {
 public:
  using Settings = ParallaxAwareMixturesGuiderSettings;
  explicit ParallaxAwareMixturesGuider(const Settings& settings) : settings_(settings) {}

  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const ParallaxAwareMixturesModel& model,
                                   const GuidingQuery& query, Arena& arena) const override;

 private:
  ScatteringLobes factors_at(const GuidingQuery& query) const;

  Settings settings_;
};

}  // namespace parallax_aware_mixtures

template <>
struct EnumNames<parallax_aware_mixtures::ProductFactor> {
  static constexpr auto names = std::to_array<EnumName<parallax_aware_mixtures::ProductFactor>>(
      {{"none", parallax_aware_mixtures::ProductFactor::none},
       {"cosine", parallax_aware_mixtures::ProductFactor::cosine},
       {"bsdf", parallax_aware_mixtures::ProductFactor::bsdf}});
};

}  // namespace pharos
