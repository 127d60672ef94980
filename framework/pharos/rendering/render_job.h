#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <pharos/core/image.h>
#include <pharos/guiding/pipeline/guiding.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/integrator.h>
#include <pharos/rendering/render_config.h>

namespace pharos {

/// How far a render has come.
struct Progress {
  std::uint32_t iteration = 0, iteration_count = 1;
  bool training = false;
  double fraction = 0;  ///< of the whole budget, in [0, 1]
  double seconds = 0;   ///< that a time budget counts, so far
  double samples_per_pixel = 0;
  std::uint64_t rays = 0;
};

/// A render between two passes.
struct RenderSnapshot {
  Progress progress;
  /// Makes the image that the render would end with here, with all layers; in training, that of
  /// the iteration in progress. Valid within the call that it was given to.
  std::function<Image()> image;
};

/// How a render is watched and stopped.
struct RenderControl {
  /// Called between work units, by one thread at a time; may be empty.
  std::function<void(const Progress&)> on_progress;
  /// Called after every whole pass, while nothing is rendered and the clock stands: what it takes
  /// is not charged to the budget. Passes end at powers of two of samples a pixel as long as they
  /// are short. May be empty; changes no bit of the image.
  std::function<void(const RenderSnapshot&)> on_pass;
  /// Set by anyone to end the render early; what was rendered is kept.
  const std::atomic<bool>* stop = nullptr;
};

/// Seconds of wall-clock time by what they were spent on.
struct RenderTimes {
  double preparation = 0;  ///< acceleration structure
  double sampler = 0;      ///< the sampler's preparation: tables, looks at the integrand
  double training = 0;     ///< rendering of training iterations
  double update = 0;       ///< learners' updates
  double rendering = 0;    ///< of the final image

  /// What a time budget counts.
  double budgeted() const { return sampler + training + update + rendering; }
};

/// What a render has made.
struct RenderResult {
  Image image;  ///< color and all layers, see Film::layers()
  double samples_per_pixel = 0;
  RenderCounters counters;
  RenderTimes times;
  bool stopped = false;                       ///< ended early through RenderControl::stop
  std::size_t model_bytes = 0;                ///< of the learned models
  std::shared_ptr<const GuidingModel> model;  ///< of the first method; null: none
  std::string learner;                        ///< plugin name of the learner of `model`
  std::optional<PathKey> first_invalid;       ///< a path of NaN or infinite value
};

/// Runs a config: divides the budget into iterations and passes, runs their work units on TBB,
/// merges in order, trains between iterations. With a sample budget the result is the same to
/// the bit for any number of threads.
class RenderJob {
 public:
  explicit RenderJob(const RenderConfig& config);
  ~RenderJob();

  RenderResult run(const RenderControl& control = {});

  /// Runs one path of `iteration` again, after training up to there; (x, y) is its pixel on the
  /// whole film. `iteration` counts training
  /// iterations too; unguided renders have only iteration 0.
  PathTrace replay(int x, int y, std::uint32_t sample, std::uint32_t iteration);

  const Scene& scene() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Writes the image, with `resolved` and what `result` tells in its metadata, its PNG, and the
/// model. Files appear whole or not at all.
void write_outputs(const RenderResult& result, const LoadedConfig& loaded);

}  // namespace pharos
