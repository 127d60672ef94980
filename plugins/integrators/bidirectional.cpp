// bidirectional: path tracing and light tracing together. For each sample of a pixel one path
// starts at the lens and one at a light. Light is found in three ways: paths from the lens run into
// it or sample it, and whatever paths from lights meet is seen from the lens. Each way counts by
// the balance heuristic over all that can make the same path (Veach 1997, section 10.2), so that
// caustics come from the lights and what only the lens can see from there; subpaths are not
// connected in between.
//
// One model guides both kinds of path, if its guider can: the densities of either, guides included,
// count in the weights of the other. Guides learn from the paths that start at the lens, as in
// `path`, or from both if they ask for light paths. There is no Russian roulette: its probabilities
// would have to be known from the other end.
//
//     integrator:
//       type: bidirectional
//       max_depth: 12
//       light_paths: always    # always | training: the final image then is that of `path`

#include "bidirectional.h"

#include <algorithm>
#include <utility>

#include <pharos/core/error.h>

#include "light_walk.h"
#include "path_text.h"
#include "path_walk.h"
#include "splats.h"

namespace pharos {
namespace {

/// Number of the first vertex of light paths among a sample's dimensions, beyond those of the path
/// from the lens.
constexpr std::uint16_t kFirstLightBounce = 0x8000;

PathSettings path_settings(const BidirectionalIntegrator::Settings& settings) {
  PathSettings path;
  path.max_depth = settings.max_depth;
  path.light_selection = settings.light_selection;
  return path;
}

/// Whether a learner wants to hear of paths from lights.
bool records_light_paths(const std::optional<GuidingSettings>& guiding) {
  if (!guiding) return false;
  const std::vector<GuidingMethod> methods = guiding->resolved_methods();
  return std::any_of(methods.begin(), methods.end(), [](const GuidingMethod& method) {
    return method.learns() && method.learner->traits().records.light_paths;
  });
}

class PreparedBidirectional final : public PreparedIntegrator {
 public:
  PreparedBidirectional(const BidirectionalIntegrator::Settings& settings,
                        const RenderTarget& target)
      : target_(target),
        settings_(path_settings(settings)),
        light_paths_(settings.light_paths),
        records_light_paths_(records_light_paths(settings.guiding)),
        sampled_(target.scene, settings.light_selection),
        emitting_(target.scene, LightSelection::one),
        from_lens_{target_, settings_, sampled_},
        from_lights_{target_, emitting_, settings.max_depth, kFirstLightBounce} {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    Arenas arenas;
    if (!context.record) {
      SilentRecorder recorder;
      Splats splats(settings_.max_depth);
      render_unit(unit, context, arenas, recorder, splats, result);
    } else if (records_light_paths_) {
      LogRecorder recorder(result.log);
      RecordedSplats splats(settings_.max_depth, result.log);
      render_unit(unit, context, arenas, recorder, splats, result);
    } else {
      LogRecorder recorder(result.log);
      Splats splats(settings_.max_depth);
      render_unit(unit, context, arenas, recorder, splats, result);
    }
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    PathLog log;
    LogRecorder recorder(log);
    LightPathTeller teller;
    Arenas arenas;
    RenderCounters counters;
    const SampleStream stream(context.sampler, key);
    const PathSample sample = walk_from_lens(stream, context, arenas, counters, recorder);
    if (traces_light(context)) walk_from_light(stream, context, arenas, counters, teller);
    const PathTrace light = teller.trace();
    return {sample.radiance + light.radiance,
            "from the lens, weighted among its own ways:\n" + path_text(log[0], sample.radiance) +
                "from a light, weighted among all ways:\n" + light.text};
  }

 private:
  /// Of queries along the path, and of those backwards.
  struct Arenas {
    Arena forward, backward;
  };

  /// Whether paths start at lights: in training they always do.
  bool traces_light(const IterationContext& context) const {
    return context.record || light_paths_ == LightPaths::always;
  }

  template <class Recorder, class Listener>
  void render_unit(const WorkUnit& unit, const IterationContext& context, Arenas& arenas,
                   Recorder& recorder, Listener& splats, WorkResult& result) const {
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    const PathSample sample =
                        walk_from_lens(stream, context, arenas, result.counters, recorder);
                    deposit(sample, target_, key, result);
                    if (!traces_light(context)) return;
                    splats.begin();
                    walk_from_light(stream, context, arenas, result.counters, splats);
                    splats.deposit(key, result);
                  });
  }

  template <class Recorder>
  PathSample walk_from_lens(const SampleStream& stream, const IterationContext& context,
                            Arenas& arenas, RenderCounters& counters, Recorder& recorder) const {
    if (!traces_light(context)) {
      return PathWalk(from_lens_, context, stream, arenas.forward, counters, recorder)
          .run(settings_.max_depth);
    }
    PathWalk walk(from_lens_, context, stream, arenas.forward, counters, recorder,
                  LightCounterparts(target_, choices_, context.guiding,
                                    stream.get_2d({Purpose::lens}), arenas.backward));
    return walk.run(settings_.max_depth);
  }

  template <class Listener>
  void walk_from_light(const SampleStream& stream, const IterationContext& context, Arenas& arenas,
                       RenderCounters& counters, Listener& listener) const {
    LightWalk(from_lights_, context, stream, arenas.forward, counters, listener,
              CameraCounterparts(target_, choices_, context.guiding, arenas.backward))
        .run();
  }

  RenderTarget target_;
  PathSettings settings_;
  LightPaths light_paths_;
  bool records_light_paths_;
  LightSelector sampled_, emitting_;
  LightChoices choices_{sampled_, emitting_};
  PathScene from_lens_;
  LightScene from_lights_;
};

}  // namespace

void BidirectionalIntegrator::Settings::describe(Schema<Settings>& s) {
  s.field("max_depth", &Settings::max_depth, "Longest path: 1 sees emitters only")
      .unit("segments")
      .at_least(1)
      .at_most(kFirstLightBounce - 1);
  s.field("light_selection", &Settings::light_selection,
          "Which lights a vertex samples: one in proportion to power, or all");
  s.field("light_paths", &Settings::light_paths,
          "Whether paths start at lights always, or for the training of guides alone: the final "
          "image then is that of path tracing");
  s.field("guiding", &Settings::guiding, "What is learned and how it is used");
}

IntegratorTraits BidirectionalIntegrator::traits() const {
  return {.records = {.light_samples = true, .light_paths = true},
          .guided = true,
          .guided_camera = true};
}

const GuidingSettings* BidirectionalIntegrator::guiding() const {
  return settings_.guiding ? &*settings_.guiding : nullptr;
}

std::unique_ptr<const PreparedIntegrator> BidirectionalIntegrator::prepare(
    const RenderTarget& target) const {
  if (!target.jitter) {
    throw InputError("the integrator 'bidirectional' needs a film with 'jitter: true'");
  }
  return std::make_unique<PreparedBidirectional>(settings_, target);
}

}  // namespace pharos
