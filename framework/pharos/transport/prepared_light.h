#pragma once

#include <pharos/transport/light_walk.h>
#include <pharos/transport/splats.h>

namespace pharos {

/// Light tracing, prepared for a render.
template <class Rules = EstimatorRules>
class PreparedLightTracing : public PreparedIntegrator {
 public:
  PreparedLightTracing(std::uint16_t max_depth, const RenderTarget& target)
      : target_(target),
        lights_(target.scene, LightSelection::one),
        shared_{target_, lights_, max_depth} {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    TransportArenas arenas;
    SplatRecorder<SilentRecorder> splats(shared_.max_depth);
    const LightWalk<SplatRecorder<SilentRecorder>, NoCounterparts, Rules> walk(
        shared_, context, arenas, result.counters, splats);
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    arenas.path.reset();
                    walk.run(stream);
                    splats.deposit(key, result);
                  });
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    LightPathTeller teller(target_);
    RenderCounters counters;
    TransportArenas arenas;
    LightWalk(shared_, context, arenas, counters, teller).run(SampleStream(context.sampler, key));
    return teller.trace();
  }

 private:
  RenderTarget target_;
  LightSelector lights_;
  LightScene shared_;
};

}  // namespace pharos
