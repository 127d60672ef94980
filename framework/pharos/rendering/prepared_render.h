#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <pharos/core/stopwatch.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/integrator.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_learning.h>
#include <pharos/rendering/schedule.h>

namespace pharos {

/// The scene, integrator and sampler of a config, prepared before its render begins. They do not
/// change during the render. All processes of a render prepare the same.
class PreparedRender {
 public:
  /// Throws InputError if the parts of the config do not fit together.
  explicit PreparedRender(const RenderConfig& config);

  const RenderConfig& config() const { return config_; }
  const Scene& scene() const { return scene_; }
  const PreparedIntegrator& integrator() const { return *integrator_; }
  const PreparedSampler& sampler() const { return *sampler_; }
  /// The tiles of the window that is rendered.
  const std::vector<PixelRect>& tiles() const { return tiles_; }
  /// The training; without iterations if nothing learns.
  const TrainingSettings& training() const { return training_; }
  /// The samples per pixel in a set, which passes of the final image fill.
  std::uint32_t set_size() const { return set_size_; }

  /// The seconds that building the acceleration structure took.
  double preparation_seconds() const { return preparation_seconds_; }
  /// The seconds that preparing the sampler took.
  double sampler_seconds() const { return sampler_seconds_; }

  /// Returns the schedule before its first iteration.
  Schedule schedule() const { return {config_.budget, training_, set_size_}; }
  /// Returns the learning of a render that begins. It must not outlive this object.
  RenderLearning make_learning() const;
  Film make_film() const;
  /// Adds the samples that the sampler has left over to the film of the final image. Returns how
  /// many of them are NaN or infinite; they count as black.
  std::uint64_t add_left_over_samples(Film& film) const;

 private:
  /// `watch` has measured the time since the preparation began.
  PreparedRender(const RenderConfig& config, const Stopwatch& watch);

  RenderConfig config_;
  Scene scene_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> integrator_;
  std::vector<PixelRect> tiles_;
  TrainingSettings training_;
  std::uint32_t set_size_ = 1;
  std::unique_ptr<const PreparedSampler> sampler_;
  double preparation_seconds_ = 0, sampler_seconds_ = 0;
};

}  // namespace pharos
