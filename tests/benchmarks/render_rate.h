#pragma once

#include <memory>
#include <vector>

#include <pharos/rendering/render_config.h>

namespace pharos::bench {

/// The speed of a render without training.
struct Speed {
  double mrays = 0;      ///< [1e6 rays/s], of all threads together
  double vertex_ns = 0;  ///< processor time per vertex (RenderCounters::vertices) [ns]
};

/// Renders the film of a config repeatedly, with `samples` samples per pixel and without training.
class RenderRate {
 public:
  /// `scene` must outlive this object. `samples` is a multiple of 2.
  RenderRate(const RenderConfig& config, const Scene& scene, std::uint32_t samples);

  /// Renders a final image and returns the speed. `guiding` is the guide; null renders unguided.
  Speed measure(const GuidingFrame* guiding) const;

 private:
  const RenderConfig& config_;
  std::uint32_t samples_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> integrator_;
  std::unique_ptr<const PreparedSampler> sampler_;
};

/// The speed of guided renders relative to unguided ones, measured in turns.
struct GuidedSpeed {
  std::vector<double> rays_ratio;  ///< rays per second with the guide over rays without [1]
  std::vector<double> added_ns;    ///< processor time that the guide adds to a vertex [ns]
};
GuidedSpeed guided_speed(const RenderRate& rate, const GuidingFrame& guiding, int repeats);

}  // namespace pharos::bench
