// Stub (g), the model: one isotropic Gaussian of target vertices in each octant of the region,
// offered through the neutral SpatialMixture contract. The guiders live in another module.

#include <algorithm>
#include <array>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

constexpr std::size_t kOctants = 8;
/// Sums kept of each octant: weight, weighted position and squared position.
constexpr std::size_t kSums = 5;
/// Numbers saved of each component: weight, mean, standard deviation.
constexpr std::size_t kNumbers = 5;

class MixtureModel final : public TableModel, public SpatialMixture {
 public:
  explicit MixtureModel(Table table) : TableModel(std::move(table)) {
    for (const double* n = this->table().data(); n < this->table().data() + this->table().size();
         n += kNumbers) {
      const auto f = [n](int i) { return static_cast<float>(n[i]); };
      components_.push_back({f(0), {f(1), f(2), f(3)}, {f(4), 0, f(4), 0, 0, f(4)}});
    }
  }

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
    Table table{{}, region_};
    for (std::size_t k = 0; k < kOctants; ++k) {
      const double* sums = &sums_[k * kSums];
      table.values.push_back(total > 0 ? sums[0] / total : 0);
      double variance = sums[0] > 0 ? sums[4] / sums[0] : 0;
      for (int axis = 1; axis <= 3; ++axis) {
        const double mean = sums[0] > 0 ? sums[axis] / sums[0] : 0;
        table.values.push_back(mean);
        variance -= mean * mean;
      }
      const double smallest = 0.05 * region_.diagonal();
      table.values.push_back(std::max(std::sqrt(std::max(variance, 0.0) / 3), smallest));
    }
    if (total == 0) return nullptr;
    return std::make_shared<MixtureModel>(std::move(table));
  }

 private:
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
    return std::make_shared<MixtureModel>(load_table(in, kOctants * kNumbers));
  }
};

}  // namespace

void register_mixture(Registry& registry) {
  registry.add<MixtureLearner>("stub_mixture", "A Gaussian of targets for each octant");
}

}  // namespace pharos::stubs
