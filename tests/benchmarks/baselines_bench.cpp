// Costs of the baselines of guiding: directional quadtrees (ppg) and von Mises-Fisher mixtures
// (pavmm). Both learn from 200,000 steps of a synthetic light field in the Cornell box, which
// consists of sixteen spots of light, seen from random positions. Queries, directions and densities
// are measured on one thread, updates on two.

#include <array>
#include <chrono>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/guided.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/rendering/render_config.h>

#include "bench.h"
#include "bench_scenes.h"
#include "guide_costs.h"

namespace pharos::bench {
namespace {

constexpr std::size_t kVertices = 20'000;
constexpr int kSteps = 200'000;
constexpr std::uint32_t kUpdates = 4;

struct Spot {
  Point3 center;
  float radius, light;
};

/// Returns paths with one guidable step each. Half of the steps hit a spot, and the others are
/// random.
PathLog light_field(const Bounds3& bounds, std::uint64_t seed) {
  RandomStream spots_random(1), random(seed, 2);
  const auto inside = [&](RandomStream& stream) {
    const Vec3 u{stream.next_1d(), stream.next_1d(), stream.next_1d()}, e = bounds.extent();
    return bounds.low + Vec3{u.x * e.x, u.y * e.y, u.z * e.z};
  };
  std::vector<Spot> spots(16);
  for (Spot& spot : spots) {
    spot = {inside(spots_random), bounds.diagonal() * 0.1f * spots_random.next_1d(),
            0.5f + spots_random.next_1d()};
  }
  PathLog log;
  for (int i = 0; i < kSteps; ++i) {
    const Point3 from = inside(random);
    const Spot& spot = spots[random() % spots.size()];
    const bool hits = random.next_1d() < 0.5f;
    const Vec3 aside = warp::sphere_from_square(random.next_2d());
    const Point3 to = hits ? spot.center + spot.radius * aside : from + bounds.diagonal() * aside;
    const float pdf = hits ? 1.0f : 0.1f;
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1), .local_weight = Rgb(1)});
    log.add(RecordedVertex{.position = from,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(1),
                           .direction = normalize(to - from),
                           .pdf = pdf});
    log.set_techniques(1, std::array{Technique{1, pdf}});
    log.add(
        RecordedVertex{.position = to, .parent = 1, .emission = Rgb(hits ? spot.light : 0.01f)});
  }
  return log;
}

template <class Contract>
Ref<Contract> build(const std::string& settings, const Registry& registry) {
  BuildContext context{registry};
  ConfigNode resolved;
  return registry.build<Contract>(parse_yaml(settings, "benchmark"), context, resolved);
}

/// What a learner makes of the light field, and how long its updates take on two threads [s].
struct Training {
  std::shared_ptr<const GuidingModel> model;
  std::vector<double> seconds;
};
Training train(const std::string& learner, const Bounds3& bounds, const Registry& registry) {
  const auto state = build<Learner>(learner, registry)
                         ->begin({.region = bounds, .seed = 1, .window = {0, 0, 100, 100}});
  Training training;
  tbb::task_arena arena(2);
  for (std::uint32_t i = 0; i < kUpdates; ++i) {
    const PathLog log = light_field(bounds, i);
    const auto start = std::chrono::steady_clock::now();
    arena.execute([&] {
      state->absorb(log);
      training.model = state->update({i, kUpdates - 1 - i}).model;
    });
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    training.seconds.push_back(elapsed.count());
  }
  return training;
}

class BaselineMeter {
 public:
  BaselineMeter(const Registry& registry, const Scene& scene, int repeats)
      : registry_(registry), scene_(scene), repeats_(repeats) {}

  /// Measures the answers of a guider under these names. An empty name omits the figure.
  void answers(const std::string& learner, const std::string& guider, const char* pdf,
               const char* sample, const char* query) {
    const Ref<Guider> technique = build<Guider>(guider, registry_);
    const auto model = train(learner, scene_.bounds(), registry_).model;
    const auto queries = guide_queries(scene_, conformance::frame_of(*technique, model), kVertices);
    const BoundGuider bound(*technique, model);
    Measurement a{pdf, "ns", {}}, b{sample, "ns", {}}, c{query, "ns", {}};
    for (int i = 0; i < repeats_; ++i) {
      const GuideCosts costs = measure_costs(bound, queries);
      a.runs.push_back(costs.pdf_ns);
      b.runs.push_back(costs.sample_ns);
      c.runs.push_back(costs.query_ns);
    }
    for (Measurement& m : {std::ref(a), std::ref(b), std::ref(c)}) {
      if (!m.name.empty()) all_.push_back(m);
    }
  }

  /// Measures the time to absorb and learn from 200,000 steps, for the first update and for later
  /// ones.
  void updates(const std::string& name, const std::string& learner) {
    Measurement first{name + ".first_update_s.200k", "s", {}},
        later{name + ".update_s.200k", "s", {}};
    Measurement bytes{name + ".bytes_per_cell", "B", {}};
    for (int i = 0; i < repeats_; ++i) {
      const Training training = train(learner, scene_.bounds(), registry_);
      const ModelInfo info = training.model->info();
      first.runs.push_back(training.seconds.front());
      later.runs.push_back(training.seconds.back());
      bytes.runs.push_back(static_cast<double>(info.bytes) / info.regions);
    }
    all_.push_back(first);
    all_.push_back(later);
    all_.push_back(bytes);
  }

  const std::vector<Measurement>& all() const { return all_; }

 private:
  const Registry& registry_;
  const Scene& scene_;
  int repeats_;
  std::vector<Measurement> all_;
};

std::string lobes(int count) {
  return fmt::format(
      "{{ type: parallax_aware_mixtures, spatial: single, components: {0}, most_components: {0}, "
      "merge_threshold: 0 }}",
      count);
}

}  // namespace

std::vector<Measurement> bench_baselines(int repeats) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  const Registry registry = load_default_modules();
  const std::string config = scene_entry("cornell-box") + "\nbudget: { spp: 1 }\n";
  const RenderConfig loaded = build_render_config(parse_yaml(config, "benchmark"), registry).config;
  const Scene scene(loaded.scene);
  BaselineMeter meter(registry, scene, repeats);
  meter.answers("practical_path_guiding", "practical_path_guiding", "ppg.pdf_ns", "ppg.sample_ns",
                "ppg.query_ns");
  meter.updates("ppg", "practical_path_guiding");
  const std::string plain = "{ type: parallax_aware_mixtures, product: none }";
  meter.answers(lobes(16), plain, "pavmm.pdf_ns.k16", "pavmm.sample_ns.k16", "pavmm.query_ns");
  meter.answers(lobes(16), "parallax_aware_mixtures", "", "", "pavmm.query_cosine_ns");
  meter.answers(lobes(16), "{ type: parallax_aware_mixtures, product: bsdf }",
                "pavmm.product_pdf_ns.k16", "", "pavmm.query_product_ns");
  meter.answers(lobes(32), plain, "pavmm.pdf_ns.k32", "pavmm.sample_ns.k32", "pavmm.query_ns.k32");
  meter.updates("pavmm", "parallax_aware_mixtures");
  if (registry.find(Learner::contract_name, "open_pgl") != nullptr) {
    // Look-ups of neighbors are off, as in the guides of Pharos. Open PGL does not report its
    // cells.
    const std::string field = "{ type: open_pgl, neighbors: false }";
    meter.answers(field, "{ type: open_pgl, cosine: false }", "open_pgl.pdf_ns",
                  "open_pgl.sample_ns", "open_pgl.query_ns");
    meter.answers(field, "open_pgl", "", "", "open_pgl.query_cosine_ns");
    meter.updates("open_pgl", field);
  }
  return meter.all();
}

}  // namespace pharos::bench
