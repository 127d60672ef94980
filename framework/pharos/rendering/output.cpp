#include <filesystem>

#include <fmt/format.h>

#include <pharos/core/version.h>
#include <pharos/guiding/pipeline/model_file.h>
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
      {"pharos:seconds_sampler", fmt::format("{:.3f}", result.times.sampler)},
      {"pharos:seconds_training", fmt::format("{:.3f}", result.times.training)},
      {"pharos:seconds_update", fmt::format("{:.3f}", result.times.update)},
      {"pharos:seconds_rendering", fmt::format("{:.3f}", result.times.rendering)},
      {"pharos:rays", std::to_string(result.counters.rays)},
      {"pharos:invalid_paths", std::to_string(result.counters.invalid_paths)},
      {"pharos:stopped", result.stopped ? "true" : "false"},
      {"pharos:exposure", fmt::format("{}", loaded.config.output.exposure)},
  };
}

}  // namespace

void write_outputs(const RenderResult& result, const LoadedConfig& loaded) {
  const OutputSettings& output = loaded.config.output;
  write_exr(select_layers(result.image, output.aovs), output.image, metadata_of(result, loaded));
  if (output.png) {
    write_png(result.image, std::filesystem::path(output.image).replace_extension(".png"),
              output.exposure, output.filmic);
  }
  if (!output.model.empty() && result.learned != nullptr) {
    write_model_file(*result.learned, output.model);
  }
}

}  // namespace pharos
