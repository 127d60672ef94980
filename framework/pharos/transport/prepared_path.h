#pragma once

#include <memory>

#include <pharos/transport/path_loop.h>
#include <pharos/transport/path_probe.h>
#include <pharos/transport/path_text.h>

namespace pharos {

/// Path tracing, prepared for a render.
template <class Rules = EstimatorRules>
class PreparedPath : public PreparedIntegrator {
 public:
  PreparedPath(const PathSettings& settings, const RenderTarget& target)
      : target_(target), settings_(settings), lights_(target.scene, settings.light_selection) {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    result.log.set_most_records(settings_.most_records);
    with_recorder(context, result,
                  [&](auto& recorder) { render_unit(unit, context, recorder, result); });
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    PathLog log;
    LogRecorder recorder(log);
    TransportArenas arenas;
    RenderCounters counters;
    const CameraWalk<LogRecorder, NoCounterparts, Rules> walk(shared_, context, arenas, counters,
                                                              recorder);
    const PathSample sample = walk.run(SampleStream(context.sampler, key), settings_.max_depth);
    return {sample.radiance, path_text(log[0], sample.radiance)};
  }

  std::unique_ptr<const IntegrandProbe> probe() const override { return make_path_probe(shared_); }

 private:
  template <class Recorder>
  void render_unit(const WorkUnit& unit, const IterationContext& context, Recorder& recorder,
                   WorkResult& result) const {
    TransportArenas arenas;
    const CameraWalk<Recorder, NoCounterparts, Rules> walk(shared_, context, arenas,
                                                           result.counters, recorder);
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    arenas.path.reset();
                    const PathSample sample = walk.run(stream, settings_.max_depth);
                    if (Rules::keeps(sample.radiance)) deposit(sample, target_, key, result);
                  });
  }

  RenderTarget target_;
  PathSettings settings_;
  LightSelector lights_;
  std::shared_ptr<const TerminationRule> first_rule_ = settings_.first_rule();
  CameraScene shared_{target_, settings_, lights_, first_rule_.get()};
};

}  // namespace pharos
