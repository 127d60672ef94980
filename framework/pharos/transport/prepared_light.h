#pragma once

#include <pharos/transport/light_walk.h>
#include <pharos/transport/splats.h>

namespace pharos {

/// Light tracing, prepared for a render.
template <class Rules = EstimatorRules>
class PreparedLightTracing : public PreparedIntegrator {
 public:
  /// `rule` ends paths by Russian roulette; null: paths end at `max_depth` only.
  PreparedLightTracing(std::uint16_t max_depth, const RenderTarget& target,
                       std::shared_ptr<const TerminationRule> rule = nullptr)
      : target_(target),
        lights_(target.scene, LightSelection::one),
        rule_(std::move(rule)),
        shared_{target_, lights_, max_depth, 0, rule_.get()} {}

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
  std::shared_ptr<const TerminationRule> rule_;
  LightScene shared_;
};

}  // namespace pharos
