#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <tbb/concurrent_queue.h>

#include <pharos/core/error.h>
#include <pharos/core/saved_bytes.h>
#include <pharos/core/stopwatch.h>
#include <pharos/rendering/iteration_state.h>
#include <pharos/rendering/pixel_noise.h>
#include <pharos/rendering/prepared_render.h>
#include <pharos/rendering/rank_helper.h>
#include <pharos/rendering/rank_leader.h>
#include <pharos/rendering/render_images.h>
#include <pharos/rendering/render_job.h>
#include <pharos/rendering/schedule.h>
#include <pharos/rendering/unit_plan.h>
#include <pharos/rendering/unit_runner.h>

namespace pharos {
namespace {

/// More than any render takes [s].
constexpr double kLongest = 1e9;

}  // namespace

class RenderJob::Implementation {
 public:
  explicit Implementation(const RenderConfig& config) : prepared_(config) {}

  RenderResult run(const RenderControl& control, const std::string& state) {
    begin(control);
    if (!state.empty()) load_state(state);
    result_.times.preparation = prepared_.preparation_seconds();
    result_.times.sampler = prepared_.sampler_seconds();
    // Ranks that load slowly are not charged to the budget.
    watch_.pause([&] { units_ = unit_runner(control.ranks); });
    while (current_ || (!stopped() && begin_iteration())) run_iteration();
    if (stopped()) save_when_stopped();
    result_.image = images_->result();
    result_.stopped = stopped();
    result_.invalid_pixels = invalid_colors(result_.image);
    if (const GuidingState* guiding = learning_->guiding()) {
      result_.gain = guiding->gain();
      result_.model_bytes = guiding->model_bytes();
      result_.model = guiding->model(0);
      result_.learned = guiding->learned();
    }
    return std::move(result_);
  }

  void help(Ranks& ranks, const std::string& render_key) {
    begin({});
    const Film film = prepared_.make_film();
    const auto begin_iteration = [&](bool trains, const std::string& frozen) {
      iteration_.training = trains;
      load_bytes(frozen, [this](Archive& archive) { archive_frozen(archive); });
    };
    const auto render = [&](const WorkUnit& unit, bool records) {
      WorkResult work{.film = film.make_tile(unit.pixels, shares_)};
      prepared_.integrator().render(unit, context(records), work);
      return work;
    };
    pharos::help(ranks, render_key, {begin_iteration, render});
  }

  PathTrace replay(const PathKey& key) {
    if (key.iteration > 0 && config().budget.seconds) {
      throw InputError(
          "training by a time budget cannot be repeated: only iteration 0 can be replayed");
    }
    begin({});
    units_ = unit_runner(nullptr);
    while (begin_iteration()) {
      if (iteration_.index == key.iteration) {
        const auto width = static_cast<std::uint64_t>(config().film.width);
        const std::uint32_t samples =
            shares_.count(static_cast<int>(key.index % width), static_cast<int>(key.index / width),
                          iteration_.samples);
        if (key.sample < samples) return prepared_.integrator().replay(key, context(false));
        throw InputError(
            fmt::format("--replay: error: there is no sample {}: iteration {} has {} in this pixel",
                        key.sample, key.iteration, samples));
      }
      run_iteration();
    }
    throw InputError(fmt::format("there is no iteration {}: this render has {}", key.iteration,
                                 iteration_.index + 1));
  }

  const RenderConfig& config() const { return prepared_.config(); }
  const Scene& scene() const { return prepared_.scene(); }

 private:
  void begin(const RenderControl& control) {
    control_ = control;
    watch_ = Stopwatch();
    result_ = {};
    schedule_.emplace(prepared_.schedule());
    spending_ = {};
    images_.emplace(prepared_.training(), prepared_.make_film().layers());
    noise_ = {};
    shares_ = {};
    current_.reset();
    is_saved_ = false;
    learning_.emplace(prepared_.make_learning());
  }

  std::unique_ptr<UnitRunner> unit_runner(Ranks* ranks) const {
    if (ranks == nullptr) return std::make_unique<LocalUnits>();
    return std::make_unique<RankLeader>(*ranks, control_.render_key, [this] { return !stopped(); });
  }

  bool stopped() const { return control_.stop != nullptr && control_.stop->load(); }

  /// The seconds that the budget counts.
  double seconds() const { return prepared_.sampler_seconds() + watch_.seconds(); }

  /// Returns what the units of the current iteration share. `records`: their paths are recorded.
  IterationContext context(bool records) const {
    return {prepared_.sampler(), config().seed, learning_->frame(), records,
            iteration_.training, &shares_,      learning_->rule()};
  }

  /// Makes the next iteration the current one. Returns false if there is none.
  bool begin_iteration() {
    spending_.seconds = seconds();
    const std::optional<Iteration> next = schedule_->next(spending_);
    if (!next) return false;
    iteration_ = *next;
    current_.emplace(begun_iteration(seconds()));
    if (iteration_.training) return true;
    shares_ = final_shares();
    // If a guide of the camera makes all paths splats, there are no samples to average with.
    if (!guides_camera()) {
      result_.counters.invalid_paths += prepared_.add_left_over_samples(current_->film);
    }
    return true;
  }

  bool adapts_pixels() const { return prepared_.training().pixels == FinalPixels::adaptive; }
  bool guides_camera() const { return learning_->guides_camera(); }

  /// Returns how the samples of the final image are shared among the pixels. A guide of the camera
  /// chooses the pixels itself.
  PixelShares final_shares() const {
    return adapts_pixels() && !guides_camera() ? noise_.shares() : PixelShares();
  }

  /// Returns the state of the current iteration before its first pass.
  IterationState begun_iteration(double start) const {
    // Training iterations do not wait for whole sets.
    const bool trains = iteration_.training;
    return {prepared_.make_film(),
            PassSizes(iteration_, trains ? prepared_.training().recorded(iteration_.samples) : 0,
                      trains ? 1 : prepared_.set_size(), start),
            start};
  }

  void run_iteration() {
    units_->begin_iteration(iteration_.training, [this] {
      return saved_bytes([this](Archive& archive) { archive_frozen(archive); });
    });
    while (current_->begin_pass(seconds()) && run_passes()) {
      if (control_.on_pass) watch_.pause([&] { show(current_->film); });
    }
    const bool is_stopped = stopped();
    if (is_stopped) save_when_stopped();
    if (!is_stopped && !iteration_.training) save_finished();
    const IterationState done = std::move(*current_);
    current_.reset();
    end_iteration(done, is_stopped);
  }

  void end_iteration(const IterationState& state, bool is_stopped) {
    const Film& film = state.film;
    const double taken = seconds() - state.start;
    images_->add(film, iteration_.training, spent_on(film, taken));
    (iteration_.training ? result_.times.training : result_.times.rendering) += taken;
    if (iteration_.training && adapts_pixels() && !guides_camera()) noise_.add(film);
    result_.samples_per_pixel += film.samples_per_pixel();
    spending_.samples += state.done;
    spending_.seconds_per_sample = taken / std::max(state.done, 1u);
    if (iteration_.training && !is_stopped) update_learning(state, taken);
  }

  /// Returns the part of the budget that the film of the current iteration has taken, after `taken`
  /// seconds.
  SpentBudget spent_on(const Film& film, double taken) const {
    if (config().budget.seconds) {
      const double before = result_.times.training + result_.times.rendering;
      return {before, before + taken};
    }
    return {result_.samples_per_pixel, result_.samples_per_pixel + film.samples_per_pixel()};
  }

  void show(const Film& film) const {
    const auto image = [&] {
      return images_->result_with(film, iteration_.training,
                                  spent_on(film, seconds() - current_->start));
    };
    control_.on_pass({progress(film.samples_per_pixel()), image});
  }

  /// Updates what is learned after a training iteration, which was rendered in `taken` seconds.
  void update_learning(const IterationState& done, double taken) {
    const double start = watch_.seconds();
    IterationCost cost{.spent = schedule_->fraction(result_.samples_per_pixel, seconds())};
    // What a budget of samples renders does not depend on the clock.
    if (config().budget.seconds) {
      cost.samples = done.done;
      cost.steps = done.film.mean_cost();
      cost.seconds = taken;
    }
    if (learning_->may_end_training(cost)) {
      schedule_->end_training();
      iteration_.training_left = 0;
    }
    spending_.largest_share = learning_->worthwhile_share();
    const TrainingStage stage{iteration_.index, iteration_.training_left};
    units_->on_idle_cores([&] { learning_->update(stage); });
    if (stage.is_last()) spare_logs_.clear();
    spending_.region_minimum = region_minimum(done.done);
    spending_.update_seconds = watch_.seconds() - start;
    result_.times.update += spending_.update_seconds;
  }

  /// Returns the samples per pixel with which every region of the new models has enough training
  /// samples on average, according to the last iteration, which had `samples`.
  std::uint32_t region_minimum(std::uint32_t samples) const {
    const double found = learning_->samples_per_region();
    if (!(found > 0)) return 1;
    const TrainingSettings& training = prepared_.training();
    const double wanted = std::ceil(training.recorded(samples) * training.region_samples / found);
    // An iteration with more samples than are recorded would teach no more.
    return training.recorded(static_cast<std::uint32_t>(std::clamp(wanted, 1.0, 1e9)));
  }

  /// Returns the rest of the current pass. If neither the clock nor a viewer is asked between
  /// passes, all later passes of the iteration follow, so that no thread waits for the end of a
  /// pass.
  UnitPlan planned_units() const {
    const bool all_passes = !iteration_.is_timed() && !control_.on_pass;
    return current_->units_left(prepared_.tiles(), iteration_.index, all_passes);
  }

  /// Renders what planned_units() returns. Returns false if it was stopped early.
  bool run_passes() {
    IterationState& now = *current_;
    const UnitPlan plan = planned_units();
    const auto blank = [&](std::size_t i) {
      WorkResult work{.film = now.film.make_tile(plan[i].pixels, shares_)};
      if (is_recorded(plan[i])) spare_logs_.try_pop(work.log);
      return work;
    };
    const auto render = [&](std::size_t i) {
      WorkResult work = blank(i);
      prepared_.integrator().render(plan[i], context(is_recorded(plan[i])), work);
      return work;
    };
    const auto take = [&](std::size_t i, WorkResult& work) {
      merge(plan[i], work);
      if (now.units == now.unit_count(prepared_.tiles().size())) {
        now.end_pass(true);
        if (i + 1 < plan.count()) now.begin_pass(seconds());
      }
      if (control_.on_progress) control_.on_progress(progress(now.samples()));
      if (control_.checkpoint.is_due && control_.checkpoint.is_due()) save_state(false);
    };
    units_->run({.count = plan.count(),
                 .unit = [&](std::size_t i) { return plan[i]; },
                 .is_recorded = [&](std::size_t i) { return is_recorded(plan[i]); },
                 .blank = blank,
                 .render = render,
                 .merge = take,
                 .keeps_going = [&] { return !stopped(); }});
    if (now.pass == 0) return true;
    save_when_stopped();
    now.end_pass(false);
    return false;
  }

  bool is_recorded(const WorkUnit& unit) const {
    return iteration_.training &&
           unit.first_sample < prepared_.training().recorded(iteration_.samples);
  }

  /// Adds the result of a work unit to the film and the training data.
  void merge(const WorkUnit& unit, WorkResult& work) {
    current_->merge(unit, work.film);
    if (is_recorded(unit)) {
      learning_->absorb(work.log);
      work.log.clear();
      spare_logs_.push(std::move(work.log));
    }
    result_.counters += work.counters;
    if (!result_.first_invalid) result_.first_invalid = work.first_invalid;
  }

  /// Hands out the state of a render that was stopped, once. Nothing that comes after it belongs to
  /// the render that goes on.
  void save_when_stopped() {
    if (!is_saved_) save_state(false);
    is_saved_ = true;
  }

  /// A render that is stopped afterwards has nothing to hand out any more.
  void save_finished() {
    save_state(true);
    is_saved_ = true;
  }

  void save_state(bool finished) {
    if (!control_.checkpoint.take) return;
    std::string state;
    try {
      state = saved_bytes([this](Archive& archive) { archive_state(archive); }, state_bytes_);
      state_bytes_ = state.size() + state.size() / 16;  // the next state may be somewhat longer
    } catch (const std::bad_alloc&) {
      if (control_.checkpoint.on_failure) {
        control_.checkpoint.on_failure("the state of the render does not fit into memory");
      }
      return;
    }
    control_.checkpoint.take(std::move(state), finished);
  }

  void load_state(const std::string& state) {
    load_bytes(state, [this](Archive& archive) { archive_state(archive); });
  }

  void archive_state(Archive& archive) {
    archive.heading("render", 5);
    double watch_seconds = watch_.seconds();
    archive(watch_seconds, result_.times.training, result_.times.update, result_.times.rendering,
            result_.counters, result_.samples_per_pixel, result_.first_invalid, *schedule_,
            spending_, iteration_, *images_, noise_);
    archive.expect(
        noise_.window() == PixelRect() || noise_.window() == prepared_.make_film().window(),
        "the noise of the pixels");
    archive.expect(watch_seconds >= 0 && watch_seconds <= kLongest, "the state of the render");
    if (archive.loads()) watch_ = Stopwatch(watch_seconds);
    learning_->archive(archive);
    bool has_current = current_.has_value();
    double start = has_current ? current_->start : 0;
    archive(has_current, start);
    if (!has_current) return;
    if (archive.loads()) {
      // The budget of the final image may have grown.
      if (!iteration_.training) iteration_ = schedule_->final_image(spending_);
      if (!iteration_.training) shares_ = final_shares();
      current_.emplace(begun_iteration(start));
    }
    archive(*current_);
    archive.expect(current_->units <= current_->unit_count(prepared_.tiles().size()),
                   "the state of the render");
  }

  /// Saves what other ranks need to render the units of an iteration as this one does, or loads it.
  void archive_frozen(Archive& archive) {
    archive(shares_);
    learning_->archive_frozen(archive);
  }

  /// Returns the progress after `samples` samples per pixel of the current iteration.
  Progress progress(double samples) const {
    const double all = result_.samples_per_pixel + samples;
    return {.iteration = iteration_.index,
            .iteration_count =
                iteration_.index + iteration_.training_left + (iteration_.training ? 2 : 1),
            .training = iteration_.training,
            .fraction = schedule_->fraction(all, seconds()),
            .seconds = seconds(),
            .samples_per_pixel = all,
            .rays = result_.counters.rays};
  }

  const PreparedRender prepared_;

  // State of the run in progress.
  Stopwatch watch_;
  RenderControl control_;
  RenderResult result_;
  std::optional<Schedule> schedule_;
  Spending spending_;
  Iteration iteration_;                    ///< the current one
  std::optional<IterationState> current_;  ///< its state; none between two iterations
  std::optional<RenderImages> images_;
  PixelNoise noise_;             ///< of the training images
  PixelShares shares_;           ///< of the current iteration
  std::size_t state_bytes_ = 0;  ///< memory for the next saved state
  bool is_saved_ = false;  ///< the render was stopped or has finished, and has handed out its state
  std::unique_ptr<UnitRunner> units_;
  std::optional<RenderLearning> learning_;
  /// Empty logs whose memory is used again until training ends. Fresh memory would cost page
  /// faults.
  tbb::concurrent_queue<PathLog> spare_logs_;
};

RenderJob::RenderJob(const RenderConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}

RenderJob::~RenderJob() = default;

RenderResult RenderJob::run(const RenderControl& control, const std::string& state) {
  return implementation_->run(control, state);
}

void RenderJob::help(Ranks& ranks, const std::string& render_key) {
  implementation_->help(ranks, render_key);
}

PathTrace RenderJob::replay(int x, int y, std::uint32_t sample, std::uint32_t iteration) {
  const RenderConfig& config = implementation_->config();
  return implementation_->replay({.seed = config.seed,
                                  .iteration = iteration,
                                  .index = static_cast<std::uint64_t>(y) * config.film.width + x,
                                  .sample = sample});
}

const Scene& RenderJob::scene() const {
  return implementation_->scene();
}

}  // namespace pharos
