#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/version.h>
#include <pharos/experiments/metrics/metrics.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/claims.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/reference.h>

namespace pharos {

namespace fs = std::filesystem;

std::string part_claim(const PlannedReference& planned, std::uint32_t part) {
  return fmt::format("{}-{}.part-{}", planned.key, planned.build, part);
}

namespace {

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

/// The references of one cache folder, by key. The parts of unfinished references are stored next
/// to them.
class Cache {
 public:
  Cache(fs::path folder, const PlannedReference& planned, const Warn& warn)
      : folder_(std::move(folder)), planned_(planned), warn_(warn) {}

  std::optional<Reference> find() const {
    const fs::path file = path();
    std::optional<Image> image = sound_image(file);
    if (!image) return std::nullopt;
    const Metadata metadata = read_metadata(file);
    Reference reference{.image = std::move(*image), .key = planned_.key, .file = file};
    reference.samples_per_pixel = number_at(metadata, "pharos:samples_per_pixel").value_or(0);
    reference.seconds = number_at(metadata, "pharos:seconds").value_or(0);
    reference.mse = number_at(metadata, "pharos:own_mse");
    reference.relative_mse = number_at(metadata, "pharos:own_relmse");
    reference.version = text_at(metadata, "pharos:version");
    reference.build = text_at(metadata, kBuildEntry);
    return reference;
  }

  bool has_part(std::uint32_t part) const { return fs::exists(part_path(part)); }

  /// Averages all parts to the finished reference and removes the parts. Returns false if a part
  /// was missing or damaged. The latter is moved aside.
  bool finish(const std::string& config) const {
    MeanImage whole;
    std::array<MeanImage, 2> halves;
    double samples = 0, seconds = 0;
    for (std::uint32_t part = 0; part < planned_.parts; ++part) {
      const std::optional<Image> image = sound_image(part_path(part));
      if (!image) return false;
      const Metadata metadata = read_metadata(part_path(part));
      whole.add(*image);
      halves[part % 2].add(*image);
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
    return true;
  }

  void remove_parts() const {
    for (std::uint32_t part = 0; part < planned_.parts; ++part) fs::remove(part_path(part));
  }

  /// The parts of different builds are different files.
  fs::path part_path(std::uint32_t part) const {
    return folder_ / (part_claim(planned_, part) + ".exr");
  }

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
    warn_(fmt::format("{}: {}; {}, and is rendered again", file.string(), problem,
                      moved_aside(file)));
    return std::nullopt;
  }

  fs::path path() const { return folder_ / (planned_.key + ".exr"); }

  fs::path folder_;
  const PlannedReference& planned_;
  const Warn& warn_;
};

}  // namespace

fs::path reference_claims(const fs::path& cache) {
  return cache / "claims";
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

std::optional<Reference> known_reference(const PlannedReference& planned, const fs::path& cache,
                                         const Warn& warn) {
  if (planned.parts > 0) return Cache(cache, planned, warn).find();
  return Reference{.image = read_reference(planned.file, planned.width, planned.height),
                   .key = planned.key,
                   .file = planned.file};
}

namespace {

/// Makes the parts of a reference that are missing and that no other process makes.
class PartMaker {
 public:
  PartMaker(const Cache& cache, ClaimBoard& board, const PlannedReference& planned,
            const PartControl& control)
      : cache_(cache), board_(board), planned_(planned), control_(control) {}

  /// Returns true if it has made a part, or if there is no need to. Returns false if it was
  /// stopped.
  bool make(std::uint32_t part, const ConfigNode& whole) const {
    if (cache_.has_part(part)) return true;
    const std::optional<Claim> claim = board_.try_claim(part_claim(planned_, part));
    // Another process may have finished the part, or even the reference, since the last look.
    if (!claim || cache_.has_part(part) || cache_.find()) return true;
    control_.report(part, planned_.parts);
    ConfigNode config = whole;
    config.take("output");
    config.set("seed", ConfigNode::scalar(std::to_string(kReferenceSeed + part)));
    return control_.make({to_yaml(config), planned_.build, fs::absolute(cache_.part_path(part))});
  }

  bool has_all() const {
    for (std::uint32_t part = 0; part < planned_.parts; ++part) {
      if (!cache_.has_part(part)) return false;
    }
    return true;
  }

 private:
  const Cache& cache_;
  ClaimBoard& board_;
  const PlannedReference& planned_;
  const PartControl& control_;
};

}  // namespace

ReferenceSearch find_or_render(const PlannedReference& planned, const fs::path& cache_folder,
                               const Registry& registry, const PartControl& control) {
  if (planned.parts == 0) return {known_reference(planned, cache_folder, control.warn)};
  const Cache cache(cache_folder, planned, control.warn);
  if (std::optional<Reference> known = cache.find()) {
    cache.remove_parts();  // parts of a process that ended before it could remove them
    return {std::move(known)};
  }
  ClaimBoard board(reference_claims(cache_folder));
  const PartMaker maker(cache, board, planned, control);
  const ConfigNode whole = build_run(planned.config, kReferenceSeed, registry).resolved;
  for (std::uint32_t part = 0; part < planned.parts; ++part) {
    if (!maker.make(part, whole)) return {.reference = {}, .is_stopped = true};
  }
  if (!maker.has_all()) return {cache.find()};
  if (const std::optional<Claim> claim = board.try_claim(planned.key + "-whole")) {
    cache.finish(to_yaml(whole));
  }
  return {cache.find()};
}

}  // namespace pharos
