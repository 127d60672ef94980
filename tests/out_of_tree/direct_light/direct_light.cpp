// direct_light: renders emitters, and surfaces and media that they light directly. Directions come
// from the BSDF, from light samples, and from guides, weighted by multiple importance sampling.
//
//     integrator: { type: direct_light, guiding: { learner: …, guider: … } }

#include <pharos/config/module.h>
#include <pharos/transport/path_loop.h>
#include <pharos/transport/path_text.h>

namespace {

using namespace pharos;

/// Paths have two segments: one to the visible point, and one to a light.
constexpr std::uint16_t kSegments = 2;

class PreparedDirectLight final : public PreparedIntegrator {
 public:
  explicit PreparedDirectLight(const RenderTarget& target)
      : target_(target), lights_(target.scene, LightSelection::all) {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    with_recorder(context, result,
                  [&](auto& recorder) { render_unit(unit, context, recorder, result); });
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    PathLog log;
    LogRecorder recorder(log);
    TransportArenas arenas;
    RenderCounters counters;
    const CameraWalk walk(shared_, context, arenas, counters, recorder);
    const Rgb radiance = walk.run(SampleStream(context.sampler, key), kSegments).radiance;
    return {radiance, path_text(log[0], radiance)};
  }

 private:
  template <class Recorder>
  void render_unit(const WorkUnit& unit, const IterationContext& context, Recorder& recorder,
                   WorkResult& result) const {
    TransportArenas arenas;
    const CameraWalk walk(shared_, context, arenas, result.counters, recorder);
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    arenas.path.reset();
                    deposit(walk.run(stream, kSegments), target_, key, result);
                  });
  }

  RenderTarget target_;
  PathSettings settings_;
  LightSelector lights_;
  CameraScene shared_{target_, settings_, lights_};
};

class DirectLight final : public Integrator {
 public:
  struct Settings {
    std::optional<GuidingSettings> guiding;
    static void describe(Schema<Settings>& s) {
      s.field("guiding", &Settings::guiding,
              "Learner, guider, mixing policy and training schedule");
    }
  };
  explicit DirectLight(Settings settings) : settings_(std::move(settings)) {}

  IntegratorTraits traits() const override {
    return {.records = {.light_samples = true}, .guided = true, .guided_camera = true};
  }
  const GuidingSettings* guiding() const override {
    return settings_.guiding ? &*settings_.guiding : nullptr;
  }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override {
    return std::make_unique<PreparedDirectLight>(target);
  }

 private:
  Settings settings_;
};

}  // namespace

PHAROS_MODULE(registry) {
  registry.add<DirectLight>("direct_light", "Direct light, guided");
}
