#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <pharos/core/image.h>
#include <pharos/guiding/pipeline/guiding_state.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/integrator.h>
#include <pharos/rendering/ranks.h>
#include <pharos/rendering/render_config.h>

namespace pharos {

/// The progress of a render.
struct Progress {
  std::uint32_t iteration = 0;
  std::uint32_t iteration_count = 1;  ///< as expected now; it may change during training
  bool training = false;
  double fraction = 0;  ///< fraction of the whole budget, in [0, 1]
  double seconds = 0;   ///< seconds so far that a time budget counts
  double samples_per_pixel = 0;
  std::uint64_t rays = 0;
};

/// The state of a render between two passes.
struct RenderSnapshot {
  Progress progress;
  /// Makes the image with which the render would end now, with all layers. During training this is
  /// the image of the current iteration. Valid only during the call that receives the snapshot.
  std::function<Image()> image;
};

/// Callbacks that keep the states of a render. A render that was killed can go on from them.
struct CheckpointControl {
  /// Whether a state is wanted now. Called after every work unit, by one thread at a time. May be
  /// empty: never.
  std::function<bool()> is_due;
  /// Receives a state that RenderJob::run() takes: when one is due, when the render was stopped,
  /// and when it has `finished` its budget. May be empty. The time of the call counts.
  std::function<void(std::string state, bool finished)> take;
  /// Receives the reason why there is no state although one was due. May be empty.
  std::function<void(const std::string& reason)> on_failure;
};

/// Callbacks to watch a render and a flag to stop it.
struct RenderControl {
  /// Called between work units, by one thread at a time. May be empty.
  std::function<void(const Progress&)> on_progress;
  /// Called after every whole pass, while nothing is rendered and the clock is stopped, so its time
  /// is not charged to the budget. Passes end at powers of two of samples per pixel as long as they
  /// are short. May be empty. It changes no bit of the image.
  std::function<void(const RenderSnapshot&)> on_pass;
  /// Set it from any thread to end the render early. The samples so far are kept.
  const std::atomic<bool>* stop = nullptr;
  CheckpointControl checkpoint;
  /// The processes that render together; null: this one alone. The others call RenderJob::help()
  /// with the same config. This one is rank 0, and calls dismiss_helpers() when it needs them no
  /// more.
  Ranks* ranks = nullptr;
  std::string render_key;  ///< key of what is rendered, which all ranks must have in common
};

/// Wall-clock seconds by what they were spent on.
struct RenderTimes {
  double preparation = 0;  ///< building the acceleration structure
  double sampler = 0;      ///< preparing the sampler: tables, probing the integrand
  double training = 0;     ///< rendering training iterations
  double update = 0;       ///< updating the learners' models
  double rendering = 0;    ///< rendering the final image

  /// The seconds that a time budget counts.
  double budgeted() const { return sampler + training + update + rendering; }
};

/// The result of a render.
struct RenderResult {
  Image image;  ///< color and all layers, see Film::layers()
  double samples_per_pixel = 0;
  RenderCounters counters;
  RenderTimes times;
  bool stopped = false;                       ///< whether RenderControl::stop ended it early
  std::optional<GuideGain> gain;              ///< none if nothing depends on the guides' gain
  std::size_t model_bytes = 0;                ///< size of the learned models
  std::shared_ptr<const GuidingModel> model;  ///< model of the first method; null if there is none
  /// Everything that was learned; null if a method has learned nothing, and without guiding.
  std::shared_ptr<const LearnedGuiding> learned;
  std::optional<PathKey> first_invalid;  ///< first path whose value is NaN or infinite
  std::size_t invalid_pixels = 0;        ///< pixels of the image whose color is NaN or infinite
};

/// Runs a render config. It divides the budget into iterations and passes, runs their work units on
/// TBB or on several ranks, merges tiles in order, and trains between iterations. With a sample
/// budget the result is identical to the bit for any number of threads and ranks.
class RenderJob {
 public:
  explicit RenderJob(const RenderConfig& config);
  ~RenderJob();

  /// Renders the image. If `state` is not empty, the render goes on from this state, which a render
  /// with the same config has handed out. With a sample budget the result has the same bits as if
  /// the render had never stopped; with a time budget the time that was spent until then counts.
  /// The config may have a larger budget than the earlier render: a finished image then gets the
  /// samples that are left, from models that learn no more. Throws InputError if the state is
  /// damaged.
  RenderResult run(const RenderControl& control = {}, const std::string& state = {});

  /// Renders what rank 0 hands out, until it says that there is no more. `render_key` is as in
  /// RenderControl.
  void help(Ranks& ranks, const std::string& render_key);

  /// Traces one path of `iteration` again, after training up to this iteration. (x, y) is its pixel
  /// on the whole film. `iteration` counts training iterations too; unguided renders only have
  /// iteration 0.
  PathTrace replay(int x, int y, std::uint32_t sample, std::uint32_t iteration);

  const Scene& scene() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The name under which the header of an image file holds the name of the finished render's state.
inline constexpr const char* kStateEntry = "pharos:state";

/// Writes the image, its PNG and the model. The image's metadata contain `resolved`, the facts in
/// `result` and, if it is not empty, `state_name`. Files appear whole or not at all. A file that
/// cannot be written is written into the folder for temporary files instead. Then throws RunError,
/// which says where.
void write_outputs(const RenderResult& result, const LoadedConfig& loaded,
                   const std::string& state_name = {});

}  // namespace pharos
