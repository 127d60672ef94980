#include "experiment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pharos::focal::plane {

std::vector<Path> draw_paths(const GapScene& scene, const Technique& technique, int count,
                             RandomStream& random) {
  std::vector<Path> found;
  for (int i = 0; i < count; ++i) {
    const double x = scene.floor_half_width * (2 * uniform_number(random) - 1);
    const MixedDensity density = technique.at(x);
    const double angle = density.sample(random);
    if (!scene.sees_light(x, angle)) continue;
    const double pdf = density.pdf(angle);
    found.push_back({x, angle, pdf, std::cos(angle) / pdf});
  }
  return found;
}

void train(Guide& guide, const GapScene& scene, const TrainingPlan& plan, std::uint64_t seed) {
  for (int iteration = 0; iteration < plan.iterations; ++iteration) {
    RandomStream random(seed, static_cast<std::uint64_t>(iteration));
    const Technique technique{&guide, iteration == 0 ? 0 : plan.guided_fraction};
    guide.learn(draw_paths(scene, technique, plan.samples, random), iteration);
  }
}

MonteCarloMean estimate_irradiance(const GapScene& scene, const Technique& technique, int count,
                                   RandomStream& random) {
  double sum = 0, squares = 0;
  for (const Path& path : draw_paths(scene, technique, count, random)) {
    sum += path.value;
    squares += path.value * path.value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt((squares / count - mean * mean) / (count - 1))};
}

double local_variance(const GapScene& scene, const Technique& technique, double x) {
  constexpr int kPoints = 32;  // number of points of the midpoint rule in each gap
  const MixedDensity density = technique.at(x);
  double second_moment = 0;
  for (const Interval& lit : scene.lit_angles(x)) {
    const double step = (lit.high - lit.low) / kPoints;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = lit.low + (i + 0.5) * step, cosine = std::cos(angle);
      second_moment += step * cosine * cosine / density.pdf(angle);
    }
  }
  const double mean = scene.irradiance(x);
  return second_moment - mean * mean;
}

std::vector<double> variance_profile(const GapScene& scene, const Technique& technique,
                                     int positions) {
  std::vector<double> profile;
  for (int i = 0; i < positions; ++i) {
    const double x = scene.floor_half_width * (2 * (i + 0.5) / positions - 1);
    profile.push_back(local_variance(scene, technique, x));
  }
  return profile;
}

Evenness evenness(std::vector<double> profile) {
  std::sort(profile.begin(), profile.end());
  const std::size_t half = profile.size() / 2;
  const double median =
      profile.size() % 2 == 1 ? profile[half] : 0.5 * (profile[half - 1] + profile[half]);
  return {std::accumulate(profile.begin(), profile.end(), 0.0) / profile.size(),
          profile.back() / median};
}

}  // namespace pharos::focal::plane
