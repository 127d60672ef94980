#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/version.h>
#include <pharos/experiments/pictures/density_pictures.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/machine.h>
#include <pharos/experiments/runner/peak_memory.h>
#include <pharos/experiments/runner/plan.h>
#include <pharos/experiments/runner/run_order.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Measures an image in progress whenever the number of its own samples has doubled.
class CheckpointLog {
 public:
  explicit CheckpointLog(const Image& reference) : reference_(reference) {}

  void look(const RenderSnapshot& snapshot) {
    const double samples = snapshot.progress.samples_per_pixel;
    if (snapshot.progress.training) {
      training_samples_ = samples;
      return;
    }
    if (samples - training_samples_ < next_) return;
    next_ = 2 * (samples - training_samples_);
    checkpoints_.push_back({samples, snapshot.progress.seconds,
                            measure(snapshot.image(), reference_, checkpoint_metrics())});
  }

  double training_samples() const { return training_samples_; }

  /// Returns all checkpoints, including the end of the run.
  std::vector<Checkpoint> finish(const RunRecord& record) {
    if (checkpoints_.empty() || checkpoints_.back().samples_per_pixel < record.samples_per_pixel) {
      Checkpoint end{record.samples_per_pixel, record.seconds(), {}};
      for (const Metric metric : checkpoint_metrics()) end.errors[metric] = record.errors[metric];
      checkpoints_.push_back(end);
    }
    return std::move(checkpoints_);
  }

 private:
  const Image& reference_;
  std::vector<Checkpoint> checkpoints_;
  double training_samples_ = 0;
  double next_ = 0;  ///< samples of the final image before the next checkpoint
};

LoadedConfig config_of(const RunOrder& order, const Registry& registry) {
  ConfigNode node = parse_yaml(order.config, "run");
  ConfigNode output = ConfigNode::mapping();
  output.set("exposure", ConfigNode::scalar(fmt::format("{}", order.exposure)));
  node.set("output", std::move(output));
  node.set("seed", ConfigNode::scalar(std::to_string(order.seed)));
  return build_render_config(node, registry);
}

RunRecord record_of(const RunOrder& order, const RenderResult& result) {
  return {.key = order.key,
          .version = version(),
          .threads = thread_count(),
          .processor = processor_name(),
          .scene = order.scene,
          .method = order.method,
          .seed = order.seed,
          .samples_per_pixel = result.samples_per_pixel,
          .training_samples = 0,
          .times = result.times,
          .rays = result.counters.rays,
          .invalid_paths = result.counters.invalid_paths,
          .gain = result.gain,
          .model_bytes = result.model_bytes,
          .peak_bytes = {},
          .errors = {},
          .checkpoints = {},
          .files = {}};
}

fs::path file_of(const RunOrder& order, const std::string& extension) {
  return order.stem.string() + extension;
}

/// Writes the images of a run. Returns the content keys of the files, by extension.
std::map<std::string, std::string> keep_images(const RunOrder& order, const RenderResult& result,
                                               const Scene& scene) {
  std::map<std::string, std::string> files;
  const auto keep = [&](const Image& image, const std::string& extension,
                        const Metadata& metadata) {
    write_exr(image, file_of(order, extension), metadata);
    files[extension] = content_key_of_file(file_of(order, extension));
  };
  fs::create_directories(order.stem.parent_path());
  if (order.keeps_image) {
    keep(select_layers(result.image, {}), ".exr",
         {{"pharos:version", version()}, {"pharos:exposure", fmt::format("{}", order.exposure)}});
  }
  if (!order.keeps_pictures || result.model == nullptr) return files;
  const Image& image = result.image;
  for (const DensityPicture& picture :
       density_pictures(*result.model, scene, image.width(), image.height())) {
    keep(picture.image, "." + picture.name + ".exr", {{"pharos:caption", picture.caption}});
  }
  return files;
}

json node_of(const PartOrder& order) {
  return {{"config", order.config}, {"build", order.build}, {"part", order.file.string()}};
}

json node_of(const RunOrder& order) {
  return {{"key", order.key},
          {"scene", order.scene},
          {"method", order.method},
          {"seed", order.seed},
          {"config", order.config},
          {"build", order.build},
          {"exposure", order.exposure},
          {"reference", order.reference.string()},
          {"stem", order.stem.string()},
          {"keeps_image", order.keeps_image},
          {"keeps_pictures", order.keeps_pictures}};
}

}  // namespace

void save_order(const Order& order, const fs::path& path) {
  const json node = std::visit([](const auto& each) { return node_of(each); }, order);
  write_text_atomically(path, node.dump(1) + "\n");
}

Order load_order(const fs::path& path) {
  std::ifstream in(path);
  try {
    const json node = json::parse(in);
    if (node.contains("part")) {
      return PartOrder{.config = node.at("config"),
                       .build = node.at("build"),
                       .file = std::string(node.at("part"))};
    }
    return RunOrder{.key = node.at("key"),
                    .scene = node.at("scene"),
                    .method = node.at("method"),
                    .seed = node.at("seed"),
                    .config = node.at("config"),
                    .build = node.at("build"),
                    .exposure = node.at("exposure"),
                    .reference = std::string(node.at("reference")),
                    .stem = std::string(node.at("stem")),
                    .keeps_image = node.at("keeps_image"),
                    .keeps_pictures = node.at("keeps_pictures")};
  } catch (const json::exception& error) {
    throw RunError(fmt::format("{}: no order of an experiment: {}", path.string(), error.what()));
  }
}

std::optional<RunRecord> make_run(const RunOrder& order, const Registry& registry,
                                  const RenderControl& control) {
  PeakMemory peak;
  const LoadedConfig loaded = config_of(order, registry);
  check_build(loaded.resolved, order.build, registry);
  const PixelRect window = loaded.config.film.window();
  const Image reference = read_reference(order.reference, window.width(), window.height());
  RenderJob job(loaded.config);
  CheckpointLog checkpoints(reference);
  RenderControl own = control;
  own.on_pass = [&](const RenderSnapshot& snapshot) {
    peak.leave_out([&] { checkpoints.look(snapshot); });
  };
  const RenderResult result = job.run(own);
  if (result.stopped) return std::nullopt;
  RunRecord record = record_of(order, result);
  record.peak_bytes = peak.bytes();
  record.training_samples = checkpoints.training_samples();
  record.errors = measure(result.image, reference, Display{order.exposure});
  record.checkpoints = checkpoints.finish(record);
  record.files = keep_images(order, result, job.scene());
  save_record(record, file_of(order, ".json"));
  return record;
}

bool carry_out(const Order& order, const Registry& registry, const RenderControl& control) {
  if (const auto* part = std::get_if<PartOrder>(&order)) return make_part(*part, registry, control);
  return make_run(std::get<RunOrder>(order), registry, control).has_value();
}

}  // namespace pharos
