// Stub (d): a method that guides the first vertex only, and so the pixel: directions uniform in a
// cone about the view direction. Everything it touches ends in the film's splat layer.

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/guider.h>

#include "stubs.h"
#include "table.h"

namespace pharos::stubs {
namespace {

class EmptyModel final : public TableModel {
 public:
  using TableModel::TableModel;
  std::string name() const override { return "stub_camera"; }
  double density(Point3) const override { return 1; }
  double density(Point3, Vec3) const override { return 1; }
};

class EmptyState final : public TableState {
 public:
  EmptyState() : TableState(0) {}
  std::shared_ptr<const GuidingModel> initial_model() const override {
    return std::make_shared<EmptyModel>(Table{});
  }
  void absorb(const PathLog&) override {}
  std::shared_ptr<const GuidingModel> update(std::uint32_t, bool) override {
    return initial_model();
  }
};

class CameraLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit CameraLearner(Settings) {}
  LearnerTraits traits() const override { return {"stub_camera", {}}; }
  std::unique_ptr<LearningState> begin(const LearningContext&) const override {
    return std::make_unique<EmptyState>();
  }
  std::shared_ptr<const GuidingModel> load_model(std::istream& in) const override {
    return std::make_shared<EmptyModel>(load_table(in, 0));
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
  Density density(const ResolvedVertex& vertex) const override {
    const bool inside = 1 - dot(vertex.direction, frame_.n) <= one_minus_cos_;
    return {inside ? pdf_scale_ * warp::cone_pdf(one_minus_cos_) : 0.0f, Measure::solid_angle};
  }

 private:
  Frame frame_;
  float one_minus_cos_;
  float pdf_scale_;
};

class BoundCameraGuider final : public BoundGuider, public CameraGuider {
 public:
  explicit BoundCameraGuider(const CameraGuiderSettings& settings) : settings_(settings) {}

  const GuidingDistribution* query(const GuidingQuery&, Arena&) const override { return nullptr; }
  const CameraGuider* camera() const override { return this; }
  const GuidingDistribution* query_camera(const PreparedSensor&, const LensPoint& lens,
                                          Arena& arena) const override {
    return arena.make<ConeDistribution>(lens.normal, settings_);
  }

 private:
  CameraGuiderSettings settings_;
};

class StubCameraGuider final : public Guider {
 public:
  using Settings = CameraGuiderSettings;
  explicit StubCameraGuider(Settings settings) : settings_(settings) {}
  GuiderTraits traits() const override { return {.model = "stub_camera", .guides_camera = true}; }
  std::unique_ptr<const BoundGuider> bind(
      std::shared_ptr<const GuidingModel> model) const override {
    bind_model<EmptyModel>(model, *this);
    return std::make_unique<BoundCameraGuider>(settings_);
  }

 private:
  Settings settings_;
};

}  // namespace

void register_camera(Registry& registry) {
  registry.add<CameraLearner>("stub_camera", "Learns nothing");
  registry.add<StubCameraGuider>("stub_camera", "First vertices in a cone");
}

}  // namespace pharos::stubs
