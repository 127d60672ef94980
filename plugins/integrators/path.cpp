// path: unidirectional path tracing.
//
// Paths start at the sensor. At every vertex that scatters smoothly the light is sampled (next
// event estimation), then the path goes on by the BSDF or phase function, or by the guide if there
// is one; what both ways can find is weighted by multiple importance sampling over the full density
// of the mixture (Veach 1997, ch. 9). Media are sampled by distance. Guides may choose the first
// vertex.
//
//     integrator:
//       type: path
//       max_depth: 12            # segments: 1 sees emitters only, 2 adds direct light
//       light_selection: all     # one | all
//       guiding: { learner: …, guider: … }

#include "path.h"

#include "path_probe.h"
#include "path_text.h"
#include "path_walk.h"
#include "unit_paths.h"

namespace pharos {
namespace {

class PreparedPath final : public PreparedIntegrator {
 public:
  PreparedPath(const PathSettings& settings, const RenderTarget& target)
      : target_(target),
        settings_(settings),
        lights_(target.scene, settings.light_selection),
        shared_{target_, settings_, lights_} {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    Arena arena;
    if (context.record) {
      LogRecorder recorder(result.log);
      render_unit(unit, context, arena, recorder, result);
    } else {
      SilentRecorder recorder;
      render_unit(unit, context, arena, recorder, result);
    }
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    PathLog log;
    LogRecorder recorder(log);
    Arena arena;
    RenderCounters counters;
    const SampleStream stream(context.sampler, key);
    PathWalk walk(shared_, context, stream, arena, counters, recorder);
    const PathSample sample = walk.run(settings_.max_depth);
    return {sample.radiance, path_text(log[0], sample.radiance)};
  }

  std::unique_ptr<const IntegrandProbe> probe() const override { return make_path_probe(shared_); }

 private:
  template <class Recorder>
  void render_unit(const WorkUnit& unit, const IterationContext& context, Arena& arena,
                   Recorder& recorder, WorkResult& result) const {
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    PathWalk walk(shared_, context, stream, arena, result.counters, recorder);
                    const PathSample sample = walk.run(settings_.max_depth);
                    const bool dropped =
                        planted(PlantedFault::zero_samples_dropped) && is_black(sample.radiance);
                    if (!dropped) deposit(sample, target_, key, result);
                  });
  }

  RenderTarget target_;
  PathSettings settings_;
  LightSelector lights_;
  PathScene shared_;
};

}  // namespace

void PathSettings::describe(Schema<PathSettings>& s) {
  s.field("max_depth", &PathSettings::max_depth,
          "Longest path: 1 sees emitters only, 2 adds direct light")
      .unit("segments")
      .at_least(1);
  s.field("next_event_estimation", &PathSettings::next_event_estimation,
          "Sample lights at every vertex");
  s.field("light_selection", &PathSettings::light_selection,
          "Which lights a vertex samples: one in proportion to power, or all");
  s.field(
      "mis", &PathSettings::mis,
      "How light found by sampling lights and by running into them is weighted; light_samples: the "
      "former alone, wherever lights can be sampled");
  s.field("roulette", &PathSettings::roulette,
          "Russian roulette: off, or with the throughput as survival probability");
  s.field("roulette_depth", &PathSettings::roulette_depth, "Vertex from which roulette is played");
  s.field("roulette_limit", &PathSettings::roulette_limit, "Largest survival probability")
      .above(0)
      .at_most(1);
  s.field("guiding", &PathSettings::guiding, "What is learned and how it is used");
}

PathIntegrator::PathIntegrator(Settings settings) : settings_(std::move(settings)) {}

IntegratorTraits PathIntegrator::traits() const {
  return {.records = {.light_samples = true}, .guided = true, .guided_camera = true};
}

const GuidingSettings* PathIntegrator::guiding() const {
  return settings_.guiding ? &*settings_.guiding : nullptr;
}

std::unique_ptr<const PreparedIntegrator> PathIntegrator::prepare(
    const RenderTarget& target) const {
  return std::make_unique<PreparedPath>(settings_, target);
}

}  // namespace pharos
