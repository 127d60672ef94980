#pragma once

#include <pharos/transport/counterparts.h>
#include <pharos/transport/light_walk.h>
#include <pharos/transport/path_text.h>
#include <pharos/transport/splats.h>

namespace pharos {

/// The rules for paths that start at lights.
struct LightPathRules {
  bool always = true;     ///< also in the final image; otherwise only in training iterations
  bool recorded = false;  ///< a learner needs records of them
};

/// Path tracing and light tracing in combination, prepared for a render.
template <class Rules = EstimatorRules>
class PreparedBidirectional : public PreparedIntegrator {
 public:
  /// Number of the first vertex of light paths in the dimensions of a sample. It lies beyond the
  /// vertices of the path from the lens.
  static constexpr std::uint16_t kFirstLightBounce = 0x8000;

  PreparedBidirectional(const PathSettings& settings, const LightPathRules& light_paths,
                        const RenderTarget& target)
      : target_(target),
        settings_(settings),
        light_paths_(light_paths),
        sampled_(target.scene, settings.light_selection),
        emitting_(target.scene, LightSelection::one),
        rule_(settings.first_rule()),
        from_lights_{target_, emitting_, settings.max_depth, kFirstLightBounce, rule_.get()} {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    if (!context.record) {
      SilentRecorder recorder;
      SplatRecorder<SilentRecorder> splats(settings_.max_depth);
      render_unit(unit, context, recorder, splats, result);
    } else if (light_paths_.recorded) {
      LogRecorder recorder(result.log);
      SplatRecorder<LogRecorder> splats(settings_.max_depth, result.log);
      render_unit(unit, context, recorder, splats, result);
    } else {
      LogRecorder recorder(result.log);
      SplatRecorder<SilentRecorder> splats(settings_.max_depth);
      render_unit(unit, context, recorder, splats, result);
    }
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    PathLog log;
    LogRecorder recorder(log);
    LightPathTeller teller(target_);
    Arenas arenas;
    RenderCounters counters;
    const SampleStream stream(context.sampler, key);
    const PathSample sample = walk_from_lens(stream, context, arenas, counters, recorder);
    if (traces_light(context)) walk_from_light(stream, context, arenas, counters, teller);
    const PathTrace light = teller.trace();
    return {sample.radiance + light.radiance,
            "from the lens, weighted among its own techniques:\n" +
                path_text(log[0], sample.radiance) +
                "from a light, weighted among all techniques:\n" + light.text};
  }

 private:
  struct Arenas {
    TransportArenas forward;  ///< for queries along paths
    Arena backward;           ///< for queries of densities from the other end
  };

  /// Returns whether paths start at lights. In training iterations they always do.
  bool traces_light(const IterationContext& context) const {
    return context.training || light_paths_.always;
  }

  template <class Recorder, class LightRecorder>
  void render_unit(const WorkUnit& unit, const IterationContext& context, Recorder& recorder,
                   LightRecorder& splats, WorkResult& result) const {
    Arenas arenas;
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    arenas.forward.path.reset();
                    const PathSample sample =
                        walk_from_lens(stream, context, arenas, result.counters, recorder);
                    deposit(sample, target_, key, result);
                    if (!traces_light(context)) return;
                    walk_from_light(stream, context, arenas, result.counters, splats);
                    splats.deposit(key, result);
                  });
  }

  template <class Recorder>
  PathSample walk_from_lens(const SampleStream& stream, const IterationContext& context,
                            Arenas& arenas, RenderCounters& counters, Recorder& recorder) const {
    if (!traces_light(context)) {
      return CameraWalk<Recorder, NoCounterparts, Rules>(from_lens_, context, arenas.forward,
                                                         counters, recorder)
          .run(stream, settings_.max_depth);
    }
    using Counterparts = LightCounterparts<Rules>;
    return CameraWalk<Recorder, Counterparts, Rules>(from_lens_, context, arenas.forward, counters,
                                                     recorder)
        .run(stream, settings_.max_depth,
             Counterparts(target_, choices_, context, stream.get_2d({Purpose::lens}),
                          arenas.backward));
  }

  template <class Recorder>
  void walk_from_light(const SampleStream& stream, const IterationContext& context, Arenas& arenas,
                       RenderCounters& counters, Recorder& recorder) const {
    LightWalk<Recorder, CameraCounterparts, Rules>(from_lights_, context, arenas.forward, counters,
                                                   recorder)
        .run(stream, CameraCounterparts(target_, choices_, context, arenas.backward));
  }

  RenderTarget target_;
  PathSettings settings_;
  LightPathRules light_paths_;
  LightSelector sampled_, emitting_;
  LightChoices choices_{sampled_, emitting_};
  std::shared_ptr<const TerminationRule> rule_;
  CameraScene from_lens_{target_, settings_, sampled_, rule_.get()};
  LightScene from_lights_;
};

}  // namespace pharos
