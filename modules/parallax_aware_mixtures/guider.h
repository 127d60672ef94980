#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/toolkit/scattering_lobes.h>

#include "model.h"

namespace pharos::parallax_aware_mixtures {

struct ParallaxAwareMixturesGuiderSettings : ScatteringFit {
  ProductFactor product = ProductFactor::cosine;
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

}  // namespace pharos::parallax_aware_mixtures
