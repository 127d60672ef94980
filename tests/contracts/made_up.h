#pragma once

#include <array>
#include <string>

#include <pharos/conformance/stage.h>
#include <pharos/guiding/pipeline/guiding_state.h>

#include "furnace.h"

/// Helpers that train and query guides without a render.
namespace pharos::testing {

/// Learning as in a render of the diffuse furnace with this `guiding`. It must outlive the states
/// that it begins.
class MadeUpLearning {
 public:
  explicit MadeUpLearning(const std::string& guiding)
      : loaded_(config_from(path_config(kDiffuseScene, 4, guiding, 8))) {}

  const GuidingSettings& settings() const { return *loaded_.config.integrator->guiding(); }
  LearningContext context() const { return {.region = {{-1, -1, -1}, {1, 1, 1}}, .seed = 1}; }
  GuidingState begin() const { return {settings(), context()}; }

 private:
  LoadedConfig loaded_;
};

/// Returns a path on which all light arrives along one guidable step, which begins at x = -0.9. The
/// guide has a low density for this step. Region 0 decided the share of unguided samples.
inline PathLog lit_path() {
  constexpr std::array<Technique, 2> techniques{
      {{.share = 0.5f, .density = 1}, {.share = 0.5f, .density = 0.01f}}};
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor});
  RecordedVertex vertex{.position = {-0.9f, 0, 0},
                        .event = Event::smooth_reflect,
                        .guidable = true,
                        .parent = 0,
                        .local_weight = Rgb(1),
                        .direction = {0, 0, 1},
                        .mixing_key = 0};
  for (const Technique& t : techniques) vertex.pdf += t.share * t.density;
  const std::uint32_t index = log.add(vertex);
  log.set_techniques(index, techniques);
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(1)});
  return log;
}

/// A matte wall that faces +z, for queries of guides.
class Wall {
 public:
  Wall() : scattering_(point_, *bsdf_, kUp, Transport::radiance) {}
  Wall(const Wall&) = delete;
  Wall& operator=(const Wall&) = delete;

  GuidingQuery query(Point3 position, std::uint16_t bounce = 1) const {
    return {.current = {.position = position, .normal = kUp, .shading_normal = kUp},
            .towards_previous = kUp,
            .bounce = bounce,
            .scattering = &scattering_};
  }

 private:
  static constexpr Vec3 kUp{0, 0, 1};

  Ref<Bsdf> bsdf_ = conformance::matt_bsdf(0.5f);
  SurfacePoint point_{.normal = kUp, .shading = Frame::from_normal(kUp)};
  LocalScattering scattering_;
};

}  // namespace pharos::testing
