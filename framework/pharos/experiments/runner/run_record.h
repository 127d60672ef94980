#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <pharos/experiments/metrics/metrics.h>
#include <pharos/rendering/render_job.h>

namespace pharos {

/// The state of a run at one moment, training included.
struct Checkpoint {
  double samples_per_pixel = 0;
  double seconds = 0;  ///< time of the sampler's preparation, training, updates and rendering
  ImageErrors errors;
};

/// The results of one finished run.
struct RunRecord {
  std::string key;  ///< key of config, code, reference and seed, and of the machine with a time
                    ///< budget; a different key means a different run
  std::string version;
  int threads = 0;
  std::string processor;  ///< empty if unknown
  std::string scene, method;
  std::uint64_t seed = 0;
  double samples_per_pixel = 0;  ///< training included
  double training_samples = 0;   ///< training samples per pixel
  RenderTimes times;
  std::uint64_t rays = 0;
  std::uint64_t invalid_paths = 0;
  std::optional<GuideGain> gain;  ///< none if it is unknown
  std::uint64_t model_bytes = 0;
  std::optional<double> peak_bytes;
  ImageErrors errors;
  std::vector<Checkpoint> checkpoints;  ///< of the final image, in order; the last is the end
  /// The content keys of the run's images, by what follows the stem of their names.
  std::map<std::string, std::string> files;

  /// Returns the time that a time budget counts [s], see RenderTimes::budgeted().
  double seconds() const { return times.budgeted(); }
};

/// Returns the metrics that are measured at checkpoints.
std::span<const Metric> checkpoint_metrics();

/// Returns the known errors, by the keys of the metrics.
nlohmann::json to_json(const ImageErrors& errors);
nlohmann::json to_json(const RunRecord& record);

/// Writes the record. The file is written completely or not at all.
void save_record(const RunRecord& record, const std::filesystem::path& path);
/// Reads the record in a file. Returns empty if there is no file or the file has another format.
/// Such files are written anew. Throws InputError if the file is damaged or was changed.
std::optional<RunRecord> load_record(const std::filesystem::path& path);

}  // namespace pharos
