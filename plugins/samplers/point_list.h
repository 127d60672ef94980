#pragma once

#include <filesystem>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// Reads points from a text file: lines "x y" with numbers in [0, 1). Empty lines and lines that
/// begin with # are skipped. Throws InputError with file and line for any other content, and unless
/// there are 1 to SetPlace::kMostSamples points.
std::vector<Vec2> read_point_list(const std::filesystem::path& file);

/// See point_list.cpp.
class PointListSampler final : public Sampler {
 public:
  struct Settings {
    std::filesystem::path file;
    static void describe(Schema<Settings>& s);
  };
  /// Throws the errors of read_point_list().
  explicit PointListSampler(const Settings& settings) : points_(read_point_list(settings.file)) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan&) const override {
    return static_cast<std::uint32_t>(points_.size());
  }

 private:
  std::vector<Vec2> points_;
};

}  // namespace pharos
