#include <atomic>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/host_port.h>
#include <pharos/core/log.h>
#include <pharos/core/writable.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_job.h>
#include <pharos/rendering/tev_packets.h>
#include <pharos/rendering/tev_preview.h>

#include "commands.h"
#include "config_options.h"
#include "import_notes.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "threads.h"

namespace pharos {
namespace {

struct RenderOptions {
  ConfigOptions config;
  std::string output;
  int threads = 0;
  bool quiet = false;
  std::vector<std::uint32_t> replay;
  std::optional<std::string> preview;
};

void check_outputs(const OutputSettings& output) {
  const std::filesystem::path image = output.image;
  if (image.extension() != ".exr") {
    throw InputError(
        fmt::format("{}: error: images are OpenEXR files: expected a name that ends "
                    "in .exr",
                    output.image));
  }
  check_writable(image);
  if (output.png) check_writable(std::filesystem::path(image).replace_extension(".png"));
  check_writable(output.model);
}

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
    log_info(fmt::format(
        "the guides' gain is {:.2g} nats a step{}{}", result.gain->nats,
        noise ? fmt::format(", with {:.2g} times the noise of unguided paths", *noise) : "",
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
}

/// Runs the job and writes its outputs, with a preview in `viewer` if one is given.
RenderResult render_and_write(RenderJob& job, const LoadedConfig& loaded,
                              const std::optional<HostPort>& viewer, const RenderOptions& options,
                              const std::atomic<bool>& stop) {
  ProgressBar bar;
  std::optional<TevPreview> preview;
  RenderControl control{.on_progress = {}, .on_pass = {}, .stop = &stop};
  if (!options.quiet) control.on_progress = [&bar](const Progress& p) { bar.show(p); };
  if (viewer) {
    preview.emplace(*viewer, loaded.config.output.image, [&bar](const std::string& message) {
      bar.clear();
      log_warning(message);
    });
    control.on_pass = [&preview](const RenderSnapshot& snapshot) { preview->show(snapshot); };
  }
  RenderResult result = job.run(control);
  bar.clear();
  if (preview) preview->show_last(result.image);
  write_outputs(result, loaded);
  if (preview) preview->finish();
  return result;
}

int render(const RenderOptions& options) {
  set_log_quiet(options.quiet);
  std::optional<HostPort> viewer;
  if (options.preview) viewer = parse_host_port(*options.preview, kTevPort, {"--preview"});
  const Registry registry = load_default_modules();
  LoadedConfig loaded = load_render_config(options.config.path, options.config.overrides, registry);
  if (!options.output.empty()) loaded.config.output.image = options.output;
  check_outputs(loaded.config.output);
  tell_notes(loaded.notes, options.config.strict);

  const InterruptGuard interrupt;
  RenderJob job(loaded.config);
  if (!options.replay.empty()) {
    replay_path(job, loaded.config, options.replay);
    return kDone;
  }
  const RenderResult result = render_and_write(job, loaded, viewer, options, interrupt.flag());
  report(result, loaded.config);
  return result.stopped ? kInterrupted : kDone;
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("render", "Render an image");
  const auto options = std::make_shared<RenderOptions>();
  options->config.add_to(*command);
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
  command->callback([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = render(*options); });
  });
}

}  // namespace pharos
