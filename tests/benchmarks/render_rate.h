#pragma once

#include <memory>
#include <vector>

#include <pharos/rendering/render_config.h>

namespace pharos::bench {

/// Renders the film of a config repeatedly, without training.
class RenderRate {
 public:
  /// `scene` must outlive this object.
  RenderRate(const RenderConfig& config, const Scene& scene);

  /// Returns millions of rays per second of a final image. `guiding` is the guide; null renders
  /// unguided.
  double mrays(const GuidingFrame* guiding) const;

 private:
  const RenderConfig& config_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> integrator_;
  std::unique_ptr<const PreparedSampler> sampler_;
};

}  // namespace pharos::bench
