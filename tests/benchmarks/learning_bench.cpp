// The share of updates in the training time of every learner, in renders with a budget of time and
// the learner's own settings, on two threads.

#include <set>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/rendering/render_job.h>

#include "bench.h"
#include "bench_scenes.h"
#include "guide_pairs.h"

namespace pharos::bench {
namespace {

using testing::GuidePair;

constexpr int kThreads = 2;

Measurement update_share(const GuidePair& pair, const std::string& learner,
                         const std::string& scene, double seconds, const Registry& registry) {
  const std::string config = learning_config(scene, pair.learner, pair.guider, seconds);
  RenderJob job(build_render_config(parse_yaml(config, "benchmark"), registry).config);
  const RenderTimes times = job.run().times;
  return {fmt::format("learning.{}.{}.update_share", scene, learner),
          "1",
          {times.update / (times.training + times.update)}};
}

}  // namespace

Group learning_group(const std::shared_ptr<const Registry>& registry, double seconds) {
  return {"learning", [registry, seconds](int) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
            tbb::task_arena arena(kThreads);
            std::vector<Measurement> all;
            std::set<std::string> learners;  // each is measured with its first guider
            for (const GuidePair& pair : testing::guide_pairs(*registry)) {
              const std::string learner = pair.name.substr(0, pair.name.find('+'));
              if (!learners.insert(learner).second) continue;
              for (const char* scene : {"cornell-box", "pool"}) {
                all.push_back(arena.execute(
                    [&] { return update_share(pair, learner, scene, seconds, *registry); }));
              }
            }
            return all;
          }};
}

}  // namespace pharos::bench
