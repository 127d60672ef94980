#include <exception>
#include <filesystem>
#include <unistd.h>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/version.h>
#include <pharos/guiding/pipeline/model_file.h>
#include <pharos/rendering/render_job.h>

namespace pharos {
namespace {

Metadata metadata_of(const RenderResult& result, const LoadedConfig& loaded,
                     const std::string& state_name) {
  Metadata metadata{
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
      {"pharos:invalid_pixels", std::to_string(result.invalid_pixels)},
      {"pharos:stopped", result.stopped ? "true" : "false"},
      {"pharos:exposure", fmt::format("{}", loaded.config.output.exposure)},
  };
  if (!loaded.papers.empty()) {
    metadata.emplace("pharos:papers", fmt::format("{}", fmt::join(loaded.papers, "\n")));
  }
  if (!state_name.empty()) metadata.emplace(kStateEntry, state_name);
  return metadata;
}

/// Writes files one after another. If one cannot be written, it is written into the folder for
/// temporary files instead.
class Writer {
 public:
  template <class Write>
  void write(const std::filesystem::path& file, Write&& write) {
    try {
      write(file);
    } catch (const std::exception& error) {  // also a lack of memory
      keep(file, error.what(), write);
    }
  }

  /// Throws RunError if a file could not be written where it should be.
  void finish() const {
    if (!problems_.empty()) throw RunError(problems_);
  }

 private:
  template <class Write>
  void keep(const std::filesystem::path& file, const std::string& problem, Write& write) {
    std::error_code failed;
    const std::filesystem::path kept =
        std::filesystem::temp_directory_path(failed) /
        fmt::format("pharos-{}-{}", getpid(), file.filename().string());
    problems_ += (problems_.empty() ? "" : "; ") + problem;
    try {
      write(kept);
      problems_ += fmt::format("; it is kept as '{}'", kept.string());
    } catch (const std::exception& error) {
      problems_ += fmt::format("; {}", error.what());
    }
  }

  std::string problems_;
};

}  // namespace

void write_outputs(const RenderResult& result, const LoadedConfig& loaded,
                   const std::string& state_name) {
  const OutputSettings& output = loaded.config.output;
  const std::filesystem::path image = output.image;
  Writer writer;
  writer.write(image, [&](const std::filesystem::path& file) {
    write_exr(select_layers(result.image, output.aovs), file,
              metadata_of(result, loaded, state_name));
  });
  if (output.png) {
    writer.write(std::filesystem::path(image).replace_extension(".png"),
                 [&](const std::filesystem::path& file) {
                   write_png(result.image, file, output.exposure, output.filmic);
                 });
  }
  if (!output.model.empty() && result.learned != nullptr) {
    writer.write(output.model, [&](const std::filesystem::path& file) {
      write_model_file(*result.learned, file);
    });
  }
  writer.finish();
}

}  // namespace pharos
