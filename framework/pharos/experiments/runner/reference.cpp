#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/file_lock.h>
#include <pharos/core/user_cache.h>
#include <pharos/core/version.h>
#include <pharos/experiments/metrics/metrics.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/reference.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// The first seed of references, far from the seeds of runs.
constexpr std::uint64_t kReferenceSeed = std::uint64_t{1} << 40;

/// The mean of images of one size.
class MeanImage {
 public:
  void add(const Image& image) {
    if (count_ == 0) {
      sum_.assign(image.values().size(), 0.0);
      mean_ = image;
    }
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += image.values()[i];
    ++count_;
  }
  Image mean() const {
    Image image = mean_;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      image.values()[i] = static_cast<float>(sum_[i] / count_);
    }
    return image;
  }

 private:
  std::vector<double> sum_;
  Image mean_;
  int count_ = 0;
};

std::string text_at(const Metadata& metadata, const std::string& key) {
  const auto entry = metadata.find(key);
  return entry == metadata.end() ? "" : entry->second;
}

/// Returns empty if there is no entry.
std::optional<double> number_at(const Metadata& metadata, const std::string& key) {
  const std::string text = text_at(metadata, key);
  if (text.empty()) return std::nullopt;
  return std::strtod(text.c_str(), nullptr);
}

/// The name under which the header of an image file holds pixels_key().
constexpr const char* kPixelsEntry = "pharos:pixels";

/// The name under which it holds the key of the code that rendered it, see build_key().
constexpr const char* kBuildEntry = "pharos:build";

std::string pixels_key(const Image& image) {
  const std::vector<float>& values = image.values();
  return content_key({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

/// The references of one cache folder, by key. The parts of unfinished references are stored next
/// to them.
class Cache {
 public:
  Cache(fs::path folder, std::string key, const PlannedReference& planned,
        const PartControl& control)
      : folder_(std::move(folder)), key_(std::move(key)), planned_(planned), control_(control) {}

  std::optional<Reference> find() const {
    const fs::path file = path();
    std::optional<Image> image = sound_image(file);
    if (!image) return std::nullopt;
    const Metadata metadata = read_metadata(file);
    Reference reference{.image = std::move(*image), .key = key_, .file = file};
    reference.samples_per_pixel = number_at(metadata, "pharos:samples_per_pixel").value_or(0);
    reference.seconds = number_at(metadata, "pharos:seconds").value_or(0);
    reference.mse = number_at(metadata, "pharos:own_mse");
    reference.relative_mse = number_at(metadata, "pharos:own_relmse");
    reference.version = text_at(metadata, "pharos:version");
    reference.build = text_at(metadata, kBuildEntry);
    return reference;
  }

  /// Whether there is a sound part that the same code has rendered.
  bool has_part(std::uint32_t part) const {
    return sound_image(part_path(part)) &&
           text_at(read_metadata(part_path(part)), kBuildEntry) == planned_.build;
  }

  /// Averages all parts to the finished reference and removes the parts.
  void finish(const std::string& config) const {
    MeanImage whole;
    std::array<MeanImage, 2> halves;
    double samples = 0, seconds = 0;
    for (std::uint32_t part = 0; part < planned_.parts; ++part) {
      const Image image = read_reference(part_path(part), planned_.width, planned_.height);
      const Metadata metadata = read_metadata(part_path(part));
      whole.add(image);
      halves[part % 2].add(image);
      samples += number_at(metadata, "pharos:samples_per_pixel").value_or(0);
      seconds += number_at(metadata, "pharos:seconds").value_or(0);
    }
    // The mean squared difference of the halves is twice the variance of one half, and the variance
    // of a half is twice the variance of the whole.
    static constexpr std::array<Metric, 2> metrics{Metric::mse, Metric::relative_mse};
    const ImageErrors difference = measure(halves[0].mean(), halves[1].mean(), metrics);
    const Image image = whole.mean();
    write_exr(image, path(),
              {{"pharos:version", version()},
               {kPixelsEntry, pixels_key(image)},
               {kBuildEntry, planned_.build},
               {"pharos:config", config},
               {"pharos:parts", std::to_string(planned_.parts)},
               {"pharos:samples_per_pixel", fmt::format("{}", samples)},
               {"pharos:seconds", fmt::format("{}", seconds)},
               {"pharos:own_mse", fmt::format("{}", difference[Metric::mse] / 4)},
               {"pharos:own_relmse", fmt::format("{}", difference[Metric::relative_mse] / 4)}});
    remove_parts();
  }

  void remove_parts() const {
    for (std::uint32_t part = 0; part < planned_.parts; ++part) fs::remove(part_path(part));
  }

  fs::path part_path(std::uint32_t part) const {
    return folder_ / fmt::format("{}.part-{}.exr", key_, part);
  }
  /// Returns the file that the process which renders this reference holds locked.
  fs::path lock_path() const { return folder_ / (key_ + ".lock"); }

 private:
  /// Returns the image in a file; none if there is no file or it is damaged. A damaged file is
  /// moved aside.
  std::optional<Image> sound_image(const fs::path& file) const {
    if (!fs::exists(file)) return std::nullopt;
    std::string problem = "its pixels were changed";
    try {
      Image image = read_reference(file, planned_.width, planned_.height);
      // Files of older versions have no such entry.
      const std::string key = text_at(read_metadata(file), kPixelsEntry);
      if (key.empty() || key == pixels_key(image)) return image;
    } catch (const InputError& error) {
      problem = error.what();
    }
    control_.warn(fmt::format("{}: {}; {}, and is rendered again", file.string(), problem,
                              moved_aside(file)));
    return std::nullopt;
  }

  fs::path path() const { return folder_ / (key_ + ".exr"); }

  fs::path folder_;
  std::string key_;
  const PlannedReference& planned_;
  const PartControl& control_;
};

}  // namespace

fs::path default_reference_cache() {
  return user_cache_folder() / "references";
}

bool make_part(const PartOrder& order, const Registry& registry, const RenderControl& control) {
  const LoadedConfig loaded = build_render_config(parse_yaml(order.config, "reference"), registry);
  check_build(loaded.resolved, order.build, registry);
  const RenderResult result = RenderJob(loaded.config).run(control);
  if (result.stopped) return false;
  const Image image = select_layers(result.image, {});
  write_exr(image, order.file,
            {{"pharos:version", version()},
             {kPixelsEntry, pixels_key(image)},
             {kBuildEntry, order.build},
             {"pharos:samples_per_pixel", fmt::format("{}", result.samples_per_pixel)},
             {"pharos:seconds", fmt::format("{}", result.times.budgeted())}});
  return true;
}

std::optional<Reference> find_or_render(const PlannedReference& planned,
                                        const fs::path& cache_folder, const Registry& registry,
                                        const PartControl& control) {
  if (planned.parts == 0) {
    Reference given{.image = read_reference(planned.file, planned.width, planned.height),
                    .file = planned.file};
    given.key = pixels_key(given.image);
    return given;
  }
  const LoadedConfig whole = build_run(planned.config, kReferenceSeed, registry);
  const Cache cache(cache_folder,
                    content_key(content_key(whole) + fmt::format(" in {}", planned.parts)), planned,
                    control);
  fs::create_directories(cache_folder);
  // Another process may be rendering the same reference. In this case, its result is used.
  const auto lock = FileLock::wait(cache.lock_path(), control.stop);
  if (!lock) return std::nullopt;
  if (std::optional<Reference> known = cache.find()) {
    cache.remove_parts();  // parts of a process that ended before it could remove them
    return known;
  }
  for (std::uint32_t part = 0; part < planned.parts; ++part) {
    if (cache.has_part(part)) continue;
    control.report(part, planned.parts);
    ConfigNode config = whole.resolved;
    config.take("output");
    config.set("seed", ConfigNode::scalar(std::to_string(kReferenceSeed + part)));
    const PartOrder order{to_yaml(config), planned.build, fs::absolute(cache.part_path(part))};
    if (!control.make(order)) return std::nullopt;
  }
  cache.finish(to_yaml(whole.resolved));
  return cache.find();
}

}  // namespace pharos
