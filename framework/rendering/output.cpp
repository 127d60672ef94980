#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/version.h>
#include <pharos/rendering/render_job.h>

namespace pharos {
namespace {

Metadata metadata_of(const RenderResult& result, const LoadedConfig& loaded) {
  return {
      {"pharos:version", version()},
      {"pharos:config", to_yaml(loaded.resolved)},
      {"pharos:seed", std::to_string(loaded.config.seed)},
      {"pharos:samples_per_pixel", fmt::format("{:g}", result.samples_per_pixel)},
      {"pharos:seconds_preparation", fmt::format("{:.3f}", result.times.preparation)},
      {"pharos:seconds_training", fmt::format("{:.3f}", result.times.training)},
      {"pharos:seconds_update", fmt::format("{:.3f}", result.times.update)},
      {"pharos:seconds_rendering", fmt::format("{:.3f}", result.times.rendering)},
      {"pharos:rays", std::to_string(result.counters.rays)},
      {"pharos:invalid_paths", std::to_string(result.counters.invalid_paths)},
      {"pharos:stopped", result.stopped ? "true" : "false"},
  };
}

void write_model(const GuidingModel& model, const std::filesystem::path& path) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    model.save(out);
    out.flush();
    if (!out) throw RunError(fmt::format("{}: error: cannot be written", path.string()));
  });
}

}  // namespace

void write_outputs(const RenderResult& result, const LoadedConfig& loaded) {
  const OutputSettings& output = loaded.config.output;
  write_exr(select_layers(result.image, output.aovs), output.image, metadata_of(result, loaded));
  if (output.png) {
    write_png(result.image, std::filesystem::path(output.image).replace_extension(".png"),
              output.exposure, output.filmic);
  }
  if (!output.model.empty() && result.model != nullptr) write_model(*result.model, output.model);
}

}  // namespace pharos
