#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <pharos/experiments/metrics/metrics.h>
#include <pharos/rendering/render_job.h>

namespace pharos {

/// What a run had reached at one moment, training included.
struct Checkpoint {
  double samples_per_pixel = 0;
  double seconds = 0;  ///< of the sampler's preparation, training, updates and rendering
  ImageErrors errors;
};

/// What one finished run has shown.
struct RunRecord {
  std::string key;  ///< of config, reference and version: another key, another run
  std::string version;
  int threads = 0;
  std::string processor;  ///< empty when unknown
  std::string scene, method;
  std::uint64_t seed = 0;
  double samples_per_pixel = 0;  ///< training included
  double training_samples = 0;   ///< a pixel
  RenderTimes times;
  std::uint64_t rays = 0;
  std::uint64_t invalid_paths = 0;
  std::uint64_t model_bytes = 0;
  std::optional<double> peak_bytes;
  ImageErrors errors;
  std::vector<Checkpoint> checkpoints;  ///< of the final image, in order; the last is its end

  /// Of training, updates and rendering: what a time budget counts.
  double seconds() const { return times.budgeted(); }
};

/// The metrics that are measured at checkpoints.
std::span<const Metric> checkpoint_metrics();

/// The errors that are known, by the metrics' keys.
nlohmann::json to_json(const ImageErrors& errors);
nlohmann::json to_json(const RunRecord& record);

/// Writes the record; the file appears whole or not at all.
void save_record(const RunRecord& record, const std::filesystem::path& path);
/// The record in a file; empty when there is none, and for files of another format, which are then
/// written anew.
std::optional<RunRecord> load_record(const std::filesystem::path& path);

}  // namespace pharos
