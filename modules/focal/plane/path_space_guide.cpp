#include "path_space_guide.h"

#include <algorithm>
#include <cmath>

namespace pharos::focal::plane {
namespace {

double normal_density(double offset, double deviation) {
  const double z = offset / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2 * std::numbers::pi));
}

/// A mixture of normal distributions of the point on the light, given the point on the floor.
class ConditionalMixture final : public DirectionDensity {
 public:
  struct Component {
    double cumulative;  ///< sum of the weights of this component and all previous components
    double weight, mean, deviation;
  };

  ConditionalMixture(double x, double light_height, std::vector<Component> components)
      : x_(x), light_height_(light_height), components_(std::move(components)) {}

  double sample(RandomStream& random) const override {
    const double u = uniform_number(random) * total();
    const auto chosen = std::upper_bound(
        components_.begin(), components_.end() - 1, u,
        [](double value, const Component& component) { return value < component.cumulative; });
    const double target = chosen->mean + chosen->deviation * normal_number(random);
    return std::atan((target - x_) / light_height_);
  }

  double pdf(double angle) const override {
    const double slope = std::tan(angle), target = x_ + light_height_ * slope;
    double sum = 0;
    for (const Component& c : components_) {
      sum += c.weight * normal_density(target - c.mean, c.deviation);
    }
    // Change of variables from points on the light to angles: d target / d angle = height / cos^2.
    return sum / total() * light_height_ * (1 + slope * slope);
  }

 private:
  double total() const { return components_.back().cumulative; }

  double x_, light_height_;
  std::vector<Component> components_;
};

}  // namespace

double normal_number(RandomStream& random) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform_number(random)));
  return radius * std::cos(2 * std::numbers::pi * uniform_number(random));
}

void PathSpaceGuide::learn(std::span<const Path> paths, int) {
  if (!settings_.accumulate) paths_.clear();
  for (const Path& path : paths) {
    paths_.push_back({path.x, path.x + light_height_ * std::tan(path.angle), path.value});
  }
  kernels_.clear();
  if (paths_.size() < static_cast<std::size_t>(settings_.neighbors)) return;
  std::vector<const GuidePath*> order;
  for (const GuidePath& path : paths_) order.push_back(&path);
  for (const GuidePath& path : paths_) kernels_.push_back(kernel_of(path, order));
}

/// Returns the kernel of a guide path. `order` holds all paths; the call moves the nearest paths to
/// the front.
PathSpaceGuide::Kernel PathSpaceGuide::kernel_of(const GuidePath& path,
                                                 std::vector<const GuidePath*>& order) const {
  const auto distance = [&path](const GuidePath* other) {
    const double d0 = other->x0 - path.x0, d1 = other->x1 - path.x1;
    return d0 * d0 + d1 * d1;
  };
  const auto end = order.begin() + settings_.neighbors;
  std::nth_element(
      order.begin(), end - 1, order.end(),
      [&](const GuidePath* a, const GuidePath* b) { return distance(a) < distance(b); });
  const double share = 1.0 / settings_.neighbors;
  GuidePath center = path;
  if (settings_.center == KernelCenter::neighbors) {
    center.x0 = center.x1 = 0;
    for (auto it = order.begin(); it != end; ++it) {
      center.x0 += share * (*it)->x0;
      center.x1 += share * (*it)->x1;
    }
  }
  const double least = settings_.least_deviation * settings_.least_deviation;
  double s00 = least, s01 = 0, s11 = least;
  for (auto it = order.begin(); it != end; ++it) {
    const double d0 = (*it)->x0 - center.x0, d1 = (*it)->x1 - center.x1;
    s00 += share * d0 * d0;
    s01 += share * d0 * d1;
    s11 += share * d1 * d1;
  }
  const double slope = s01 / s00;
  return {path.weight, center.x0, std::sqrt(s00), center.x1, slope, std::sqrt(s11 - slope * s01)};
}

std::unique_ptr<DirectionDensity> PathSpaceGuide::at(double x) const {
  std::vector<ConditionalMixture::Component> components;
  double sum = 0;
  for (const Kernel& kernel : kernels_) {
    const double offset = x - kernel.mean0;
    const double weight = kernel.weight * normal_density(offset, kernel.deviation0);
    if (!(weight > 0)) continue;
    sum += weight;
    components.push_back({sum, weight, kernel.mean1 + kernel.slope * offset, kernel.deviation1});
  }
  if (components.empty()) return nullptr;
  return std::make_unique<ConditionalMixture>(x, light_height_, std::move(components));
}

}  // namespace pharos::focal::plane
