// Stub (g), the model: one isotropic Gaussian over target vertices in each octant of the region,
// available through the neutral contract SpatialMixture. The guiders are in another module.

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
/// The number of sums for each octant: weight, weighted position and squared position.
constexpr std::size_t kSums = 5;
/// The number of saved values for each component: weight, mean, standard deviation.
constexpr std::size_t kNumbers = 5;

class MixtureModel final : public TableModel, public SpatialMixture {
 public:
  static constexpr std::string_view kName = "stub_mixture";
  MixtureModel() = default;
  explicit MixtureModel(Table table) : TableModel(std::move(table)) { make_components(); }

  ModelInfo info() const override { return table_info(kName); }
  void archive(Archive& archive) override {
    archive_table(archive, kOctants * kNumbers);
    if (archive.loads()) make_components();
  }
  double density(Point3 p, const Vec3* direction) const override {
    if (direction != nullptr) p = p + *direction;
    double sum = 0;
    for (const SpatialGaussian& g : components_) {
      const float s = g.cholesky[0];
      sum += g.weight * std::exp(-0.5f * length_squared(p - g.mean) / (s * s)) / (s * s * s);
    }
    return sum;
  }
  std::span<const SpatialGaussian> mixture_at(const GuidingQuery&, Arena&) const override {
    return components_;
  }

 private:
  void make_components() {
    components_.clear();
    for (std::size_t k = 0; k < table().size(); k += kNumbers) {
      const auto f = [&](std::size_t i) { return static_cast<float>(table()[k + i]); };
      components_.push_back({f(0), {f(1), f(2), f(3)}, {f(4), 0, f(4), 0, 0, f(4)}});
    }
  }

  std::vector<SpatialGaussian> components_;
};

class MixtureState final : public TableState {
 public:
  explicit MixtureState(const Bounds3& region) : TableState(kOctants * kSums), region_(region) {}

  void absorb(const PathLog& log) override {
    for_each_step(log, [&](const PathView& path, std::size_t i, double weight) {
      const std::uint32_t next = path.vertices[i].next;
      if (next == kNoVertex) return;
      const Point3 p = path.vertices[next].position;
      const Point3 c = region_.center();
      double* sums = &sums_[kSums * static_cast<std::size_t>((p.x > c.x) | (p.y > c.y) << 1 |
                                                             (p.z > c.z) << 2)];
      sums[0] += weight;
      for (int axis = 0; axis < 3; ++axis) sums[1 + axis] += weight * p[axis];
      sums[4] += weight * length_squared(p);
    });
  }

  Learned update(const TrainingStage&) override {
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
    if (total == 0) return {nullptr};
    return {std::make_shared<MixtureModel>(std::move(table))};
  }

 private:
  Bounds3 region_;
};

class MixtureLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit MixtureLearner(Settings) {}
  LearnerTraits traits() const override { return {.records = {.light_samples = true}}; }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override {
    return std::make_unique<MixtureState>(context.region);
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<MixtureModel>();
  }
};

}  // namespace

void register_mixture(Registry& registry) {
  registry.add<MixtureLearner>("stub_mixture", "A Gaussian of targets for each octant");
}

}  // namespace pharos::stubs
