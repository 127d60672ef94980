#pragma once

#include <memory>
#include <vector>

#include <pharos/rendering/render_config.h>

namespace pharos::bench {

/// Renders the film of a config again and again, without training.
class RenderRate {
 public:
  /// `scene` outlives the object.
  RenderRate(const RenderConfig& config, const Scene& scene);

  /// Millions of rays a second of a final image, guided by `guiding`; null: unguided.
  double mrays(const GuidingFrame* guiding) const;

 private:
  const RenderConfig& config_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> integrator_;
  std::unique_ptr<const PreparedSampler> sampler_;
};

}  // namespace pharos::bench
