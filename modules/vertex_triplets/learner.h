#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/learner.h>

#include "sample.h"

namespace pharos::vertex_triplets {

/// Parameters of the method. The README documents them and states their sources.
struct VertexTripletsSettings {
  Prefix vertices = Prefix::triplet;
  bool light_paths = false;
  std::uint32_t cells = 64;
  std::uint32_t components = 32;
  std::uint32_t reservoir = 1024;
  double least_effective = 0;
  float jitter = 0.2f;
  float single_deviation = 0.1f;
  float least_deviation = 1e-4f;
  int em_iterations = 50;
  double em_tolerance = 1e-3;
  float environment_distance = 5;
  double inherit = 0;
  bool translation = false;
  bool light_samples = true;
  SampleWeights weights = SampleWeights::path;
  int pixel_radius = 2;
  double least_pixel = 0.01;

  static void describe(Schema<VertexTripletsSettings>& schema);
};

/// Learns mixtures of the next path vertex given the prefix of the path (Schuessler et al. 2022).
class VertexTripletsLearner final : public Learner {
 public:
  using Settings = VertexTripletsSettings;
  /// Throws InputError if paths from lights are to be learned from as pairs, because pairs know one
  /// direction of paths only, or with weights that suit paths from the sensor only.
  explicit VertexTripletsLearner(const Settings& settings);

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace pharos::vertex_triplets

namespace pharos {
template <>
struct EnumNames<vertex_triplets::Prefix> {
  static constexpr auto names = std::to_array<EnumName<vertex_triplets::Prefix>>(
      {{"pairs", vertex_triplets::Prefix::pair}, {"triplets", vertex_triplets::Prefix::triplet}});
};
template <>
struct EnumNames<vertex_triplets::SampleWeights> {
  static constexpr auto names = std::to_array<EnumName<vertex_triplets::SampleWeights>>(
      {{"path", vertex_triplets::SampleWeights::path},
       {"suffix", vertex_triplets::SampleWeights::suffix},
       {"relative", vertex_triplets::SampleWeights::relative}});
};
}  // namespace pharos
