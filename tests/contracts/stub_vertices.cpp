// Stub (c): a method that proposes whole vertices. It depends on the previous vertex. It proposes
// positions in space (in a medium) and on the surface behind them, distances, and discrete events.
// For some prefixes of the path it declines to guide. Its model is the region's box.

#include <algorithm>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

#include "box_ray.h"
#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

class BoxModel final : public TableModel {
 public:
  static constexpr std::string_view kName = "stub_vertices";
  using TableModel::TableModel;
  ModelInfo info() const override { return table_info(kName); }
  void archive(Archive& archive) override { archive_table(archive, 0); }
  double density(Point3 p, const Vec3* direction) const override {
    if (direction != nullptr) return box_direction_pdf(region(), p, *direction);
    return region().contains(p) ? 1 : 0;
  }
};

class BoxState final : public TableState {
 public:
  explicit BoxState(const Bounds3& box) : TableState(0), box_(box) {}
  void absorb(const PathLog&) override {}
  Learned update(const TrainingStage&) override {
    return {std::make_shared<BoxModel>(Table{{}, box_})};
  }

 private:
  Bounds3 box_;
};

class VertexLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit VertexLearner(Settings) {}
  LearnerTraits traits() const override { return {.records = {.light_samples = true}}; }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override {
    return std::make_unique<BoxState>(context.region);
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<BoxModel>();
  }
};

/// Shares of the branches at smooth vertices. The remaining branch samples a direction and leaves
/// the distance to the medium.
constexpr float kVolumeShare = 0.4f, kSurfaceShare = 0.3f;
/// The share of reflection among discrete events.
constexpr float kReflectShare = 0.7f;

class VertexDistribution final : public GuidingDistribution {
 public:
  VertexDistribution(const Bounds3& box, Point3 origin, bool discrete)
      : box_(box), origin_(origin), discrete_(discrete) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const float u = stream.get_1d(Purpose::guide_choice);
    if (discrete_) return Proposal{.events = u < kReflectShare ? reflect() : transmit()};
    const Vec2 xy = stream.get_2d(Purpose::guide_direction);
    const float z = stream.get_1d(Purpose::guide_distance);
    const Vec3 offset = box_.low + Vec3{xy.x, xy.y, z} * box_.extent() - origin_;
    const float distance = length(offset);
    if (distance == 0) return std::nullopt;
    Proposal proposal{.direction = offset / distance};
    if (u < kVolumeShare) {
      proposal.reach = Proposal::Reach::distance;
      proposal.distance = distance;
      proposal.targets = TargetMask::volume;
    } else if (u < kVolumeShare + kSurfaceShare) {
      proposal.reach = Proposal::Reach::surface;
      proposal.targets = TargetMask::surface | TargetMask::environment;
    }
    return proposal;
  }

  float density(const ResolvedVertex& vertex) const override {
    if (is_discrete(vertex.event) != discrete_) return 0;
    if (discrete_) {
      const float share = contains(reflect(), vertex.event) ? kReflectShare : 1 - kReflectShare;
      return share * vertex.medium_density;
    }
    const auto along = static_cast<float>(box_direction_pdf(box_, origin_, vertex.direction));
    const float by_medium = (1 - kVolumeShare - kSurfaceShare) * along * vertex.medium_density;
    if (vertex.kind != VertexKind::volume) return kSurfaceShare * along + by_medium;
    const Vec3 e = box_.extent();
    const float in_box = box_.contains(vertex.position) ? 1 / (e.x * e.y * e.z) : 0.0f;
    return kVolumeShare * in_box * square(vertex.distance) + by_medium;
  }

 private:
  static EventMask reflect() { return EventMask::reflect & EventMask::discrete; }
  static EventMask transmit() { return EventMask::transmit & EventMask::discrete; }

  Bounds3 box_;
  Point3 origin_;
  bool discrete_;
};

class VertexGuider final : public GuiderOf<BoxModel> {
 public:
  using Settings = NoSettings;
  explicit VertexGuider(Settings) {}
  GuiderTraits traits() const override {
    return {.steers_distance = true, .steers_events = true, .guides_light_paths = true};
  }
  const GuidingDistribution* query(const BoxModel& model, const GuidingQuery& query,
                                   Arena& arena) const override {
    // The guide declines by prefix: it knows only paths whose previous vertex is in the upper half.
    if (query.previous == nullptr || query.previous->position.y < model.region().center().y) {
      return nullptr;
    }
    return arena.make<VertexDistribution>(model.region(), query.current.position,
                                          query.scattering->purely_discrete());
  }
};

}  // namespace

void register_vertices(Registry& registry) {
  registry.add<VertexLearner>("stub_vertices", "Remembers the region");
  registry.add<VertexGuider>("stub_vertices", "Positions, distances and discrete events");
}

}  // namespace pharos::stubs
