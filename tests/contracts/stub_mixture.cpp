// Stub (g), the model: one isotropic Gaussian of target vertices in each octant of the region, offered
// through the neutral SpatialMixture contract. The guiders live in another module.

#include <algorithm>
#include <array>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/guiding/spatial_mixture.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

constexpr std::size_t kOctants = 8;
/// Sums kept of each octant: weight, weighted position and squared position.
constexpr std::size_t kSums = 5;

class MixtureModel final : public TableModel, public SpatialMixture {
 public:
  explicit MixtureModel(std::vector<SpatialGaussian> components)
      : TableModel({}), components_(std::move(components)) {}

  std::string name() const override { return "stub_mixture"; }
  double density(Point3 p) const override {
    double sum = 0;
    for (const SpatialGaussian& g : components_) {
      const float s = g.cholesky[0];
      sum += g.weight * std::exp(-0.5f * length_squared(p - g.mean) / (s * s)) / (s * s * s);
    }
    return sum;
  }
  double density(Point3 p, Vec3 direction) const override { return density(p + direction); }
  View mixture_at(const GuidingQuery&, Arena&) const override { return {components_, 0}; }

 private:
  std::vector<SpatialGaussian> components_;
};

class MixtureState final : public TableState {
 public:
  explicit MixtureState(const Bounds3& region) : TableState(kOctants * kSums), region_(region) {}

  void absorb(const PathLog& log) override {
    for_each_step(log, [&](const PathView& path, std::size_t i, double weight) {
      if (i + 1 >= path.vertices.size()) return;
      const Point3 p = path.vertices[i + 1].position;
      const Point3 c = region_.center();
      double* sums = &sums_[kSums * static_cast<std::size_t>((p.x > c.x) | (p.y > c.y) << 1 |
                                                             (p.z > c.z) << 2)];
      sums[0] += weight;
      for (int axis = 0; axis < 3; ++axis) sums[1 + axis] += weight * p[axis];
      sums[4] += weight * length_squared(p);
    });
  }

  std::shared_ptr<const GuidingModel> update(std::uint32_t, bool) override {
    double total = 0;
    for (std::size_t k = 0; k < kOctants; ++k) total += sums_[k * kSums];
    std::vector<SpatialGaussian> components;
    for (std::size_t k = 0; k < kOctants; ++k) {
      const double* sums = &sums_[k * kSums];
      if (sums[0] > 0) components.push_back(fit(sums, total));
    }
    return std::make_shared<MixtureModel>(std::move(components));
  }

 private:
  SpatialGaussian fit(const double* sums, double total) const {
    const Vec3 mean = Vec3{static_cast<float>(sums[1]), static_cast<float>(sums[2]),
                           static_cast<float>(sums[3])} /
                      static_cast<float>(sums[0]);
    const auto variance = static_cast<float>(sums[4] / sums[0]) - length_squared(mean);
    const float s = std::max(std::sqrt(std::max(variance, 0.0f) / 3), 0.05f * region_.diagonal());
    return {static_cast<float>(sums[0] / total), mean, {s, 0, s, 0, 0, s}};
  }

  Bounds3 region_;
};

class MixtureLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit MixtureLearner(Settings) {}
  LearnerTraits traits() const override {
    return {std::string(kSpatialMixtureModel), {.light_samples = true}};
  }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override {
    return std::make_unique<MixtureState>(context.region);
  }
  std::shared_ptr<const GuidingModel> load_model(std::istream& in) const override {
    read_table(in, 0);
    return std::make_shared<MixtureModel>(std::vector<SpatialGaussian>{});
  }
};

}  // namespace

void register_mixture(Registry& registry) {
  registry.add<MixtureLearner>("stub_mixture", "A Gaussian of targets for each octant");
}

}  // namespace pharos::stubs
