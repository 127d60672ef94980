// Stub (d): a method that guides only the first vertex, and thereby the pixel. It samples
// directions uniformly in a cone about the view direction. All of its contributions go to the
// film's splat layer.

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/guider.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

/// A model that stores only the region. The guider does not use it.
class CameraModel final : public TableModel {
 public:
  static constexpr std::string_view kName = "stub_camera";
  using TableModel::TableModel;
  ModelInfo info() const override { return table_info(kName); }
  void archive(Archive& archive) override { archive_table(archive, 0); }
  double density(Point3, const Vec3*) const override { return 1; }
};

class CameraState final : public TableState {
 public:
  explicit CameraState(const Bounds3& region) : TableState(0), region_(region) {}
  void absorb(const PathLog&) override {}
  Learned update(const TrainingStage&) override {
    return {std::make_shared<CameraModel>(Table{{}, region_})};
  }

 private:
  Bounds3 region_;
};

class CameraLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit CameraLearner(Settings) {}
  LearnerTraits traits() const override { return {}; }
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override {
    return std::make_unique<CameraState>(context.region);
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<CameraModel>();
  }
};

struct CameraGuiderSettings {
  float cone_degrees = 12;
  float pdf_scale = 1;
  static void describe(Schema<CameraGuiderSettings>& s) {
    s.field("cone_degrees", &CameraGuiderSettings::cone_degrees, "Half-angle of the cone")
        .unit("degrees")
        .above(0);
    s.field("pdf_scale", &CameraGuiderSettings::pdf_scale, "Planted fault: factor on the density");
  }
};

class ConeDistribution final : public GuidingDistribution {
 public:
  ConeDistribution(Vec3 axis, const CameraGuiderSettings& settings)
      : frame_(Frame::from_normal(axis)),
        one_minus_cos_(1 - std::cos(radians(settings.cone_degrees))),
        pdf_scale_(settings.pdf_scale) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const Vec2 u = stream.get_2d(Purpose::guide_direction);
    return Proposal{.direction = frame_.to_world(warp::cone_from_square(u, one_minus_cos_))};
  }
  float density(const ResolvedVertex& vertex) const override {
    const bool inside = 1 - dot(vertex.direction, frame_.n) <= one_minus_cos_;
    return inside ? pdf_scale_ * warp::cone_pdf(one_minus_cos_) : 0.0f;
  }

 private:
  Frame frame_;
  float one_minus_cos_;
  float pdf_scale_;
};

class CameraGuider final : public GuiderOf<CameraModel> {
 public:
  using Settings = CameraGuiderSettings;
  explicit CameraGuider(Settings settings) : settings_(settings) {}
  GuiderTraits traits() const override { return {.guides_camera = true}; }
  const GuidingDistribution* query(const CameraModel&, const GuidingQuery& query,
                                   Arena& arena) const override {
    if (query.current.kind != VertexKind::sensor) return nullptr;
    return arena.make<ConeDistribution>(query.current.normal, settings_);
  }

 private:
  Settings settings_;
};

}  // namespace

void register_camera(Registry& registry) {
  registry.add<CameraLearner>("stub_camera", "Learns nothing");
  registry.add<CameraGuider>("stub_camera", "First vertices in a cone");
}

}  // namespace pharos::stubs
