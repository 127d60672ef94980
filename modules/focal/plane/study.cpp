#include "study.h"

#include <algorithm>
#include <numbers>

#include "picture.h"

namespace pharos::focal::plane {
namespace {

// Keys of random numbers that are not for training. No iteration has these numbers.
constexpr std::uint64_t kEstimateKey = 1'000'000, kPictureKey = 1'000'001;

constexpr Rgb kVermilion{0.84f, 0.33f, 0.16f}, kTeal{0.0f, 0.53f, 0.53f};

/// Both guides after training.
struct TrainedGuides {
  TrainedGuides(const StudySettings& settings, std::uint64_t seed)
      : path_space(settings.scene.light_height, settings.path_space),
        focal(settings.scene, {.guided_fraction = settings.plan.guided_fraction}) {
    train(path_space, settings.scene, settings.plan, seed);
    train(focal, settings.scene, settings.plan, seed);
  }

  PathSpaceGuide path_space;
  FocalGuide focal;
};

MethodResult measure(const StudySettings& settings, const Technique& technique,
                     const std::vector<double>& uniform, std::uint64_t seed) {
  RandomStream random(seed, kEstimateKey);
  MethodResult result;
  result.estimate =
      estimate_irradiance(settings.scene, technique, settings.estimate_samples, random);
  result.variances = variance_profile(settings.scene, technique, settings.positions);
  const Evenness here = evenness(result.variances);
  result.efficiency = evenness(uniform).mean / here.mean;
  result.worst_to_median = here.worst_to_median;
  result.least_efficiency = uniform[0] / result.variances[0];
  for (std::size_t i = 1; i < uniform.size(); ++i) {
    result.least_efficiency = std::min(result.least_efficiency, uniform[i] / result.variances[i]);
  }
  return result;
}

}  // namespace

SeedResult run_seed(const StudySettings& settings, std::uint64_t seed) {
  const TrainedGuides guides(settings, seed);
  const double fraction = settings.plan.guided_fraction;
  const std::vector<double> uniform = variance_profile(settings.scene, {}, settings.positions);
  return {measure(settings, {}, uniform, seed),
          measure(settings, {&guides.path_space, fraction}, uniform, seed),
          measure(settings, {&guides.focal, fraction}, uniform, seed)};
}

Image draw_seed(const StudySettings& settings, std::uint64_t seed) {
  const TrainedGuides guides(settings, seed);
  const auto panel = [&](const char* title, const Guide& guide, const Quadtree* tree, Rgb color) {
    const Technique technique{&guide, settings.plan.guided_fraction};
    RandomStream random(seed, kPictureKey);
    return Panel{.title = title,
                 .paths = draw_paths(settings.scene, technique, settings.plan.samples, random),
                 .variances = variance_profile(settings.scene, technique, settings.positions),
                 .tree = tree,
                 .color = color};
  };
  const Panel panels[] = {panel("(a) path-space guiding", guides.path_space, nullptr, kVermilion),
                          panel("(b) focal guiding", guides.focal, &guides.focal.tree(), kTeal)};
  // The value of a path along the normal that only uniform sampling finds. Half of this value is
  // drawn with full opacity.
  const double unguided_value = std::numbers::pi / (1 - settings.plan.guided_fraction);
  return draw_picture(settings.scene, panels,
                      variance_profile(settings.scene, {}, settings.positions),
                      0.5 * unguided_value);
}

}  // namespace pharos::focal::plane
