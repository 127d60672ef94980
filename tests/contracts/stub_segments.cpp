// Stub (b): a method that splats contributions along whole path segments into a grid over the
// region, including segments that leave the scene. It samples directions toward the grid's mass.
// The density of a direction is an integral along the ray through every voxel.

#include <algorithm>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

#include "box_ray.h"
#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

constexpr std::uint32_t kEdge = 5, kVoxels = kEdge * kEdge * kEdge;

Bounds3 voxel_bounds(const Bounds3& region, std::uint32_t v) {
  const Vec3 cell = region.extent() / static_cast<float>(kEdge);
  const Vec3 index{static_cast<float>(v % kEdge), static_cast<float>(v / kEdge % kEdge),
                   static_cast<float>(v / (kEdge * kEdge))};
  Bounds3 box;
  box.add(region.low + index * cell);
  box.add(region.low + (index + Vec3{1, 1, 1}) * cell);
  return box;
}

class SegmentModel final : public TableModel {
 public:
  static constexpr std::string_view kName = "stub_segments";
  using TableModel::TableModel;

  ModelInfo info() const override {
    ModelInfo info = table_info(kName);
    info.bounds = region();
    info.facts = {{"voxels", std::to_string(kVoxels)}};
    return info;
  }
  void archive(Archive& archive) override { archive_table(archive, kVoxels); }
  double density(Point3 p, const Vec3* direction) const override {
    return direction == nullptr ? at(p) : along(p, *direction);
  }

  /// Returns the density [1/sr] of a direction from a point.
  double along(Point3 p, Vec3 direction) const {
    double sum = 0;
    for (std::uint32_t v = 0; v < kVoxels; ++v) {
      sum += table()[v] * box_direction_pdf(voxel_bounds(region(), v), p, direction);
    }
    return sum;
  }

 private:
  double at(Point3 p) const {
    for (std::uint32_t v = 0; v < kVoxels; ++v) {
      if (voxel_bounds(region(), v).contains(p)) return table()[v];
    }
    return 0;
  }
};

class SegmentState final : public TableState {
 public:
  explicit SegmentState(const Bounds3& region) : TableState(kVoxels), region_(region) {}

  void absorb(const PathLog& log) override {
    std::vector<Rgb> incident;
    for (std::size_t p = 0; p < log.size(); ++p) {
      const PathView path = log[p];
      estimate_incident_radiance(path, incident);
      for (std::size_t i = 1; i < path.vertices.size(); ++i) {
        const RecordedVertex& vertex = path.vertices[i];
        if (!vertex.guidable || vertex.next == kNoVertex) continue;
        splat(vertex.position, path.vertices[vertex.next].position,
              mean(vertex.throughput * vertex.local_weight * incident[i]));
      }
    }
  }

  Learned update(const TrainingStage&) override {
    double total = 0;
    for (const double sum : sums_) total += sum;
    Table mass{{}, region_};
    for (const double sum : sums_) {
      mass.values.push_back(0.2 / kVoxels + 0.8 * (total > 0 ? sum / total : 1.0 / kVoxels));
    }
    return {std::make_shared<SegmentModel>(std::move(mass))};
  }

 private:
  void splat(Point3 from, Point3 to, double contribution) {
    const float distance = length(to - from);
    const Vec3 direction = (to - from) / distance;
    for (std::uint32_t v = 0; v < kVoxels; ++v) {
      const Interval t = box_interval(voxel_bounds(region_, v), from, direction);
      const double inside = std::min(t.end, double{distance}) - t.begin;
      if (inside > 0) sums_[v] += contribution * inside / region_.diagonal();
    }
  }

  Bounds3 region_;
};

class SegmentLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit SegmentLearner(Settings) {}

  LearnerTraits traits() const override { return {.records = {.light_samples = true}}; }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override {
    return std::make_unique<SegmentState>(context.region);
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<SegmentModel>();
  }
};

class SegmentDistribution final : public GuidingDistribution {
 public:
  SegmentDistribution(const SegmentModel& model, Point3 origin) : model_(model), origin_(origin) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    double u = stream.get_1d(Purpose::guide_choice);
    std::uint32_t v = 0;
    while (v + 1 < kVoxels && u >= model_.table()[v]) u -= model_.table()[v++];
    const Vec2 xy = stream.get_2d(Purpose::guide_direction);
    const float z = stream.get_1d(Purpose::guide_distance);
    const Bounds3 box = voxel_bounds(model_.region(), v);
    const Vec3 offset = box.low + Vec3{xy.x, xy.y, z} * box.extent() - origin_;
    if (length_squared(offset) == 0) return std::nullopt;
    return Proposal{.direction = normalize(offset)};
  }
  float density(const ResolvedVertex& vertex) const override {
    return static_cast<float>(model_.along(origin_, vertex.direction));
  }

 private:
  const SegmentModel& model_;
  Point3 origin_;
};

class SegmentGuider final : public GuiderOf<SegmentModel> {
 public:
  using Settings = NoSettings;
  explicit SegmentGuider(Settings) {}

  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const SegmentModel& model, const GuidingQuery& query,
                                   Arena& arena) const override {
    return arena.make<SegmentDistribution>(model, query.current.position);
  }
};

}  // namespace

void register_segments(Registry& registry) {
  registry.add<SegmentLearner>("stub_segments", "Splats along segments into a grid");
  registry.add<SegmentGuider>("stub_segments", "Directions toward the grid's mass");
}

}  // namespace pharos::stubs
