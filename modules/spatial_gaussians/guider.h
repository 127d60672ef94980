#pragma once

#include <memory>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>

#include "seen_mixture.h"

namespace pharos::spatial_gaussians {

/// What all three guiders are told.
struct SeenSettings {
  bool reweight = true;
  float least_cosine = 0.01f;
  static void describe(Schema<SeenSettings>& schema);
};

/// Samples directions to the points of any mixture of spatial Gaussians.
class MixtureGuider : public Guider {
 public:
  using Settings = SeenSettings;
  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;

 protected:
  MixtureGuider(const Settings& settings, Technique technique)
      : settings_(settings), technique_(technique) {}

 private:
  Settings settings_;
  Technique technique_;
};

/// Exactly the points' directions.
struct P0Guider final : MixtureGuider {
  explicit P0Guider(const Settings& s) : MixtureGuider(s, Technique::exact) {}
};
/// Those that look away from the mean turned around.
struct P1Guider final : MixtureGuider {
  explicit P1Guider(const Settings& s) : MixtureGuider(s, Technique::flipped) {}
};
/// Directions to the points' feet in the planes through the means.
struct ProjectedGuider final : MixtureGuider {
  explicit ProjectedGuider(const Settings& s) : MixtureGuider(s, Technique::plane) {}
};

}  // namespace pharos::spatial_gaussians
