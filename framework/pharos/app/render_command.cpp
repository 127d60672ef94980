#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/host_port.h>
#include <pharos/core/log.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/rendering/checkpoint.h>
#include <pharos/rendering/rank_helper.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_job.h>
#include <pharos/rendering/tev_packets.h>
#include <pharos/rendering/tev_preview.h>

#include "commands.h"
#include "config_options.h"
#include "earlier_render.h"
#include "import_notes.h"
#include "interrupt.h"
#include "launched_ranks.h"
#include "progress_bar.h"
#include "render_outputs.h"

namespace pharos {
namespace {

struct RenderOptions {
  ConfigOptions config;
  ConfineOption confine;
  std::string output;
  int threads = 0;
  bool quiet = false;
  std::vector<std::uint32_t> replay;
  std::optional<std::string> preview;
  bool resume = false;
  std::string continued;  ///< image that gets more samples; empty: none
};

void replay_path(RenderJob& job, const RenderConfig& config,
                 const std::vector<std::uint32_t>& numbers) {
  const int x = static_cast<int>(numbers[0]), y = static_cast<int>(numbers[1]);
  const PixelRect window = config.film.window();
  if (!window.contains(x, y)) {
    throw InputError(fmt::format("--replay: error: pixel ({}, {}) is not on the film of {} x {}{}",
                                 numbers[0], numbers[1], config.film.width, config.film.height,
                                 config.film.crop ? ", or not in its window" : ""));
  }
  fmt::print("{}", job.replay(x, y, numbers[2], numbers.size() > 3 ? numbers[3] : 0).text);
}

bool is_black(const Image& image) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.rgb(x, y) != Rgb()) return false;
    }
  }
  return true;
}

/// Warns of an image that is black, or nearly so because few paths find the light. Integrators that
/// do not count such paths are judged by their images.
void warn_of_darkness(const RenderResult& result, const RenderConfig& config) {
  constexpr double kFewest = 1e-3;  // of all paths
  const RenderCounters& counters = result.counters;
  const auto lit = static_cast<double>(counters.lit_paths);
  if (lit >= kFewest * static_cast<double>(counters.paths)) return;
  if (counters.lit_paths == 0 && !is_black(result.image)) return;
  log_warning(fmt::format(
      "{}: {} of {} paths found light; is there light where the sensor looks? Lights that paths "
      "from the sensor rarely hit need the integrator 'light' or 'bidirectional', or a guide",
      config.output.image, counters.lit_paths == 0 ? "none" : fmt::to_string(counters.lit_paths),
      counters.paths));
}

void report(const RenderResult& result, const RenderConfig& config) {
  const double seconds = result.times.budgeted();
  const PixelRect window = config.film.window();
  log_info(fmt::format("{}: {} x {}, {:.6g} samples a pixel, {:.1f} s, {:.2f} Mrays/s{}",
                       config.output.image, window.width(), window.height(),
                       result.samples_per_pixel, seconds,
                       static_cast<double>(result.counters.rays) / seconds * 1e-6,
                       result.stopped ? " (interrupted)" : ""));
  if (result.gain) {
    const std::optional<double> noise = result.gain->noise_ratio;
    const std::string cost =
        config.budget.seconds ? fmt::format(" in {:.2g} times their time", result.gain->path_cost)
                              : "";
    log_info(fmt::format(
        "the guides' gain is {:.2g} nats a step{}{}", result.gain->nats,
        noise ? fmt::format(", with {:.2g} times the noise of unguided paths{}", *noise, cost) : "",
        result.gain->is_off ? "; that is too little, so the image is not guided" : ""));
  }
  if (!config.output.model.empty() && result.learned == nullptr) {
    log_warning(fmt::format("{}: not written, since {} was learned", config.output.model,
                            result.model_bytes > 0 ? "not every model" : "nothing"));
  }
  if (result.first_invalid) {
    const PathKey& key = *result.first_invalid;
    const auto width = static_cast<std::uint64_t>(config.film.width);
    log_warning(fmt::format(
        "{} paths had NaN or infinite values and count as black; see one with --replay {},{},{},{}",
        result.counters.invalid_paths, key.index % width, key.index / width, key.sample,
        key.iteration));
  }
  warn_of_darkness(result, config);
  if (result.invalid_pixels > 0) {
    log_warning(
        fmt::format("{}: {} pixels are NaN or infinite, which happens if light is beyond the "
                    "range of a float",
                    config.output.image, result.invalid_pixels));
  }
}

/// Returns a key of what a process renders.
std::string render_key(const LoadedConfig& loaded, const Registry& registry) {
  const SavedRender head = saved_render_head(loaded, registry);
  return content_key(head.config + head.build);
}

/// One run of the command after its config was loaded.
class Render {
 public:
  Render(const LoadedConfig& loaded, const Registry& registry, const RenderOptions& options,
         Ranks* ranks)
      : loaded_(loaded), registry_(registry), options_(options), ranks_(ranks) {
    find_checkpoint();
    job_.emplace(loaded.config);
  }

  /// Renders the image and writes it, with a preview in `viewer` if one is given.
  RenderResult run(const std::optional<HostPort>& viewer) {
    std::optional<TevPreview> preview;
    if (loaded_.config.output.png) prepare_image_files();
    OutputSpace space(loaded_.config);
    RenderControl control{.on_progress = {}, .on_pass = {}, .stop = &interrupt_.flag()};
    if (!options_.quiet) control.on_progress = [this](const Progress& p) { bar_.show(p); };
    if (viewer) {
      preview.emplace(*viewer, loaded_.config.output.image,
                      [this](const std::string& message) { warn(message); });
      control.on_pass = [&preview](const RenderSnapshot& snapshot) { preview->show(snapshot); };
    }
    control.ranks = ranks_;
    if (ranks_ != nullptr) control.render_key = render_key(loaded_, registry_);
    control.checkpoint.is_due = [this] { return is_checkpoint_due(); };
    if (checkpoints_) {
      control.checkpoint.take = [this](std::string state, bool finished) {
        if (finished) state_name_ = state_name(state);
        checkpoints_->write(std::move(state), finished);
      };
      control.checkpoint.on_failure = [this](const std::string& reason) {
        checkpoints_->skip(reason);
      };
    }
    RenderResult result = run_job(control);
    bar_.clear();
    if (preview) preview->show_last(result.image);
    space.release();
    write_outputs(result, loaded_, state_name_);
    if (preview) preview->finish();
    if (checkpoints_ && checkpoints_->finish() && result.stopped) {
      log_info(fmt::format("{}: --resume goes on from here", loaded_.config.output.checkpoint));
    }
    return result;
  }

 private:
  void find_checkpoint() {
    const OutputSettings& output = loaded_.config.output;
    if (output.checkpoint.empty() && !options_.resume && options_.continued.empty()) return;
    const SavedRender head = saved_render_head(loaded_, registry_);
    check_named(output, options_.resume ? "--resume" : "--continue");
    // Locked before it is read: a render that still ends may write a newer one.
    checkpoints_.emplace(output.checkpoint, head, output.every,
                         [this](const std::string& message) { warn(message); });
    if (options_.resume) state_ = state_to_resume(loaded_, head);
    if (!options_.continued.empty()) {
      state_ = state_to_continue(loaded_, head, options_.continued);
      checkpoints_->request();  // with the new budget, so that --resume can go on from it
    }
    if (state_.empty() && std::filesystem::exists(output.checkpoint)) {
      log_warning(
          fmt::format("{}: will be replaced; to go on from it, use --resume with the same config",
                      output.checkpoint));
    }
  }

  RenderResult run_job(const RenderControl& control) {
    try {
      return job_->run(control, state_);
    } catch (const InputError& error) {
      if (state_.empty()) throw;
      throw InputError(
          fmt::format("the checkpoint '{}': {}", loaded_.config.output.checkpoint, error.what()));
    }
  }

  void warn(const std::string& message) {
    bar_.clear();
    log_warning(message);
  }

  /// SIGUSR1 asks for a checkpoint. A render without a checkpoint file ends instead.
  bool is_checkpoint_due() {
    if (interrupt_.take_request()) {
      if (!checkpoints_) interrupt_.set();
      if (checkpoints_) checkpoints_->request();
    }
    return checkpoints_ && checkpoints_->is_due();
  }

  const LoadedConfig& loaded_;
  const Registry& registry_;
  const RenderOptions& options_;
  Ranks* ranks_;
  InterruptGuard interrupt_;
  std::optional<RenderJob> job_;
  ProgressBar bar_;
  std::optional<CheckpointWriter> checkpoints_;
  std::string state_;       ///< from which the render goes on; empty: from nothing
  std::string state_name_;  ///< of the finished render
};

LoadedConfig load_config(const RenderOptions& options, const Registry& registry) {
  options.confine.apply(registry);
  if (!options.continued.empty()) allow_reading(options.continued);
  return load_render_config(options.config.path, options.config.overrides, registry);
}

/// Renders what rank 0 hands out. Rank 0 says what there is to say, so that it is said once. It
/// also decides what a signal means.
int help_to_render(const RenderOptions& options, Ranks& ranks) {
  InterruptGuard::expect_requests();
  const InterruptGuard signals;
  set_log_quiet(true);
  try {
    const Registry registry = load_default_modules();
    const LoadedConfig loaded = load_config(options, registry);
    RenderJob(loaded.config).help(ranks, render_key(loaded, registry));
  } catch (const std::exception& error) {
    refuse_to_help(ranks, error.what());
  }
  return signals.flag() ? kInterrupted : kDone;
}

int render(const RenderOptions& options, Ranks* ranks) {
  if (ranks != nullptr && ranks->rank() > 0) return help_to_render(options, *ranks);
  if (ranks != nullptr && !options.replay.empty()) {
    throw InputError("--replay: error: one process traces the path, found several");
  }
  if (options.replay.empty()) InterruptGuard::expect_requests();
  set_log_quiet(options.quiet);
  std::optional<HostPort> viewer;
  if (options.preview) viewer = parse_host_port(*options.preview, kTevPort, {"--preview"});
  const Registry registry = load_default_modules();
  LoadedConfig loaded = load_config(options, registry);
  if (!options.continued.empty()) loaded.config.output.image = options.continued;
  if (!options.output.empty()) loaded.config.output.image = options.output;
  check_outputs(loaded);
  tell_notes(loaded.notes, options.config.strict);

  if (!options.replay.empty()) {
    RenderJob job(loaded.config);
    replay_path(job, loaded.config, options.replay);
    return kDone;
  }
  Render render(loaded, registry, options, ranks);
  const RenderResult result = render.run(viewer);
  report(result, loaded.config);
  return result.stopped ? kInterrupted : kDone;
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("render", "Render an image");
  const auto options = std::make_shared<RenderOptions>();
  options->config.add_to(*command);
  options->confine.add_to(*command);
  command->add_option("-o,--output", options->output, "Image file (.exr) instead of the config's");
  command->add_option("--threads", options->threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command->add_flag("-q,--quiet", options->quiet, "Only warnings and errors");
  CLI::Option* replay = command
                            ->add_option("--replay", options->replay,
                                         "Run one path again and print it: x,y,sample[,iteration]")
                            ->delimiter(',')
                            ->expected(3, 4);
  command
      ->add_option("--preview", options->preview,
                   "Show the image while it renders in the viewer tev at HOST[:PORT]")
      ->excludes(replay);
  CLI::Option* resume = command->add_flag(
      "--resume", options->resume, "Go on from the config's output.checkpoint, if it exists");
  resume->excludes(replay);
  command
      ->add_option("--continue", options->continued,
                   "Add samples to a finished image, up to a larger budget, from the config's "
                   "output.checkpoint")
      ->excludes(replay)
      ->excludes(resume);
  command->callback([options, &exit_code] {
    with_launched_ranks(options->threads,
                        [&](Ranks* ranks) { exit_code = render(*options, ranks); });
  });
}

}  // namespace pharos
