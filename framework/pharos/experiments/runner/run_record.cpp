#include <array>
#include <cmath>
#include <fstream>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/run_record.h>
#include <pharos/experiments/tables/json_number.h>

namespace pharos {
namespace {

using nlohmann::json;

/// The format version of record files.
constexpr int kRecordFormat = 5;

ImageErrors errors_from(const json& node) {
  ImageErrors errors;
  for (const MetricInfo& info : metric_infos()) {
    const auto value = node.find(info.key);
    if (value != node.end()) errors[info.metric] = number_from(*value);
  }
  errors.invalid_pixels = node.value("invalid_pixels", std::size_t{0});
  return errors;
}

std::optional<double> optional_number(const json& node) {
  return node.is_number() ? std::optional(node.get<double>()) : std::nullopt;
}

json optional_json(const std::optional<double>& number) {
  return number ? json(*number) : json(nullptr);
}

std::optional<GuideGain> gain_from(const json& node) {
  if (node.is_null()) return std::nullopt;
  return GuideGain{.nats = node.at("nats"),
                   .noise_ratio = optional_number(node.at("noise_ratio")),
                   .is_off = node.at("is_off")};
}

json to_json(const std::optional<GuideGain>& gain) {
  if (!gain) return nullptr;
  return {{"nats", gain->nats},
          {"noise_ratio", optional_json(gain->noise_ratio)},
          {"is_off", gain->is_off}};
}

RunRecord record_from(const json& node) {
  RunRecord record{.key = node.at("key"),
                   .version = node.at("version"),
                   .threads = node.at("threads"),
                   .processor = node.at("processor"),
                   .scene = node.at("scene"),
                   .method = node.at("method"),
                   .seed = node.at("seed"),
                   .samples_per_pixel = node.at("samples_per_pixel"),
                   .training_samples = node.at("training_samples"),
                   .times = {.preparation = node.at("seconds_preparation"),
                             .sampler = node.at("seconds_sampler"),
                             .training = node.at("seconds_training"),
                             .update = node.at("seconds_update"),
                             .rendering = node.at("seconds_rendering")},
                   .rays = node.at("rays"),
                   .invalid_paths = node.at("invalid_paths"),
                   .gain = gain_from(node.at("gain")),
                   .model_bytes = node.at("model_bytes"),
                   .peak_bytes = optional_number(node.at("peak_bytes")),
                   .errors = errors_from(node.at("errors")),
                   .checkpoints = {},
                   .files = node.at("files")};
  for (const json& checkpoint : node.at("checkpoints")) {
    record.checkpoints.push_back({checkpoint.at("samples_per_pixel"), checkpoint.at("seconds"),
                                  errors_from(checkpoint.at("errors"))});
  }
  return record;
}

}  // namespace

std::span<const Metric> checkpoint_metrics() {
  static constexpr std::array metrics{Metric::mse, Metric::capped_mse, Metric::relative_mse,
                                      Metric::trimmed_relative_mse};
  return metrics;
}

json to_json(const ImageErrors& errors) {
  json node = json::object();
  for (const MetricInfo& info : metric_infos()) {
    const double value = errors[info.metric];
    if (!std::isnan(value)) node[std::string(info.key)] = json_number<json>(value);
  }
  node["invalid_pixels"] = errors.invalid_pixels;
  return node;
}

json to_json(const RunRecord& record) {
  json checkpoints = json::array();
  for (const Checkpoint& checkpoint : record.checkpoints) {
    checkpoints.push_back({{"samples_per_pixel", checkpoint.samples_per_pixel},
                           {"seconds", checkpoint.seconds},
                           {"errors", to_json(checkpoint.errors)}});
  }
  return {{"key", record.key},
          {"version", record.version},
          {"threads", record.threads},
          {"processor", record.processor},
          {"scene", record.scene},
          {"method", record.method},
          {"seed", record.seed},
          {"samples_per_pixel", record.samples_per_pixel},
          {"training_samples", record.training_samples},
          {"seconds_preparation", record.times.preparation},
          {"seconds_sampler", record.times.sampler},
          {"seconds_training", record.times.training},
          {"seconds_update", record.times.update},
          {"seconds_rendering", record.times.rendering},
          {"rays", record.rays},
          {"invalid_paths", record.invalid_paths},
          {"gain", to_json(record.gain)},
          {"model_bytes", record.model_bytes},
          {"peak_bytes", optional_json(record.peak_bytes)},
          {"errors", to_json(record.errors)},
          {"checkpoints", std::move(checkpoints)},
          {"files", record.files}};
}

namespace {

/// Returns the checksum of a record without its checksum.
std::string checksum_of(json node) {
  node.erase("checksum");
  return content_key(node.dump());
}

}  // namespace

void save_record(const RunRecord& record, const std::filesystem::path& path) {
  json node = to_json(record);
  node["format"] = kRecordFormat;
  node["checksum"] = checksum_of(node);
  write_text_atomically(path, node.dump(1) + "\n");
}

std::optional<RunRecord> load_record(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Location where{path.string()};
  if (const std::string problem = file_problem(path); !problem.empty()) {
    throw InputError(where, problem);
  }
  std::ifstream in(path);
  try {
    const json node = json::parse(in);
    if (node.value("format", 0) != kRecordFormat) return std::nullopt;
    if (node.at("checksum") == checksum_of(node)) return record_from(node);
  } catch (const json::exception&) {  // no JSON, or values are missing
  }
  throw InputError(where, "the record is damaged or was changed");
}

}  // namespace pharos
