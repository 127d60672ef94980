#pragma once

#include <memory>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/guiding/toolkit/scattering_lobes.h>

#include "seen_mixture.h"

namespace pharos::spatial_gaussians {

/// Settings of the three guiders.
struct SeenSettings : ScatteringFit {
  ProductFactor product = ProductFactor::cosine;
  float least_factor = 0.01f;
  static void describe(Schema<SeenSettings>& schema);
};

/// Samples directions to points of any model that is a SpatialMixture.
class MixtureGuider : public GuiderOf<SpatialMixture> {
 public:
  using Settings = SeenSettings;
  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const SpatialMixture& model, const GuidingQuery& query,
                                   Arena& arena) const override;

 protected:
  MixtureGuider(const Settings& settings, Technique technique)
      : settings_(settings), technique_(technique) {}

 private:
  Settings settings_;
  Technique technique_;
};

/// Samples directions to the points, with the exact density.
struct P0Guider final : MixtureGuider {
  explicit P0Guider(const Settings& s) : MixtureGuider(s, Technique::exact) {}
};
/// Samples the same directions, but flips a direction that points away from the mean.
struct P1Guider final : MixtureGuider {
  explicit P1Guider(const Settings& s) : MixtureGuider(s, Technique::flipped) {}
};
/// Samples directions to the projections of the points onto planes through the means.
struct ProjectedGuider final : MixtureGuider {
  explicit ProjectedGuider(const Settings& s) : MixtureGuider(s, Technique::plane) {}
};

}  // namespace pharos::spatial_gaussians
