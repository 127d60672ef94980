// Costs of the guiders of spatial Gaussians, by the number of components. The mixture has exactly
// this number of components, around the Cornell box, and every vertex sees all of them. All figures
// are measured on one thread.

#include <cmath>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/guided.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/rendering/render_config.h>

#include "bench.h"
#include "bench_scenes.h"
#include "guide_costs.h"

namespace pharos::bench {
namespace {

constexpr std::size_t kVertices = 20'000;

/// Returns needles, plates and balls between and behind the walls of a scene.
std::vector<SpatialGaussian> components_around(const Bounds3& bounds, std::size_t count) {
  RandomStream random(1);
  const auto number = [&](float low, float high) { return low + (high - low) * random.next_1d(); };
  std::vector<SpatialGaussian> components;
  for (std::size_t k = 0; k < count; ++k) {
    SpatialGaussian g{.weight = 1 / static_cast<float>(count)};
    for (int axis = 0; axis < 3; ++axis) g.mean[axis] = number(bounds.low[axis], bounds.high[axis]);
    for (const int diagonal : {0, 2, 5}) {
      g.cholesky[diagonal] = bounds.diagonal() * std::exp2(number(-7, -3));
    }
    for (const int off : {1, 3, 4}) g.cholesky[off] = bounds.diagonal() * number(-0.03f, 0.03f);
    components.push_back(g);
  }
  return components;
}

/// A model that returns the same mixture everywhere.
class FixedMixture final : public GuidingModel, public SpatialMixture {
 public:
  explicit FixedMixture(std::vector<SpatialGaussian> components)
      : components_(std::move(components)) {
    for (std::size_t i = 0; i < components_.size(); i += WhitenedGroup::kLanes) {
      whitened_.emplace_back(std::span(components_).subspan(i));
    }
  }
  ModelInfo info() const override {
    return {.name = "fixed_mixture", .bytes = components_.size() * sizeof components_[0]};
  }
  void archive(Archive&) override {}
  double density(Point3, const Vec3*) const override { return 0; }
  std::span<const SpatialGaussian> mixture_at(const GuidingQuery&, Arena&) const override {
    return components_;
  }
  std::span<const WhitenedGroup> whitened_at(const GuidingQuery&) const override {
    return whitened_;
  }

 private:
  std::vector<SpatialGaussian> components_;
  std::vector<WhitenedGroup> whitened_;
};

Ref<Guider> build_guider(const std::string& name, const Registry& registry) {
  BuildContext context{registry};
  ConfigNode resolved;
  return registry.build<Guider>(ConfigNode::scalar(name), context, resolved);
}

class GuiderMeter {
 public:
  GuiderMeter(const Registry& registry, const Scene& scene) : registry_(registry), scene_(scene) {}

  /// Returns the figures of one guider with `count` components. Times of samples and queries are
  /// returned only if `all` is true.
  std::vector<Measurement> measure(const std::string& guider, std::size_t count, bool all,
                                   int repeats) const {
    const Ref<Guider> technique = build_guider(guider, registry_);
    const auto model = std::make_shared<FixedMixture>(components_around(scene_.bounds(), count));
    const auto queries = guide_queries(scene_, conformance::frame_of(*technique, model), kVertices);
    const BoundGuider bound(*technique, model);
    const auto named = [&](const char* what) {
      return fmt::format("gaussians.{}{}", what, count == 16 ? "" : fmt::format(".k{}", count));
    };
    Measurement pdf{fmt::format("gaussians.{}_pdf_ns.k{}", guider, count), "ns", {}},
        sample{named("sample_ns"), "ns", {}}, query{named("query_ns"), "ns", {}};
    for (int i = 0; i < repeats; ++i) {
      const GuideCosts costs = measure_costs(bound, queries);
      pdf.runs.push_back(costs.pdf_ns);
      sample.runs.push_back(costs.sample_ns);
      query.runs.push_back(costs.query_ns);
    }
    if (!all) return {pdf};
    return {pdf, sample, query};
  }

 private:
  const Registry& registry_;
  const Scene& scene_;
};

}  // namespace

std::vector<Measurement> bench_gaussians(int repeats) {
  const Registry registry = load_default_modules();
  const std::string config = scene_entry("cornell-box") + "\nbudget: { spp: 1 }\n";
  const RenderConfig loaded = build_render_config(parse_yaml(config, "benchmark"), registry).config;
  const Scene scene(loaded.scene);
  const GuiderMeter meter(registry, scene);
  std::vector<Measurement> all;
  for (const std::size_t count : {4u, 8u, 16u, 32u}) {
    for (const char* guider : {"p0", "p1", "projected"}) {
      const bool is_first = std::string(guider) == "p0";
      for (Measurement& m : meter.measure(guider, count, is_first, repeats)) all.push_back(m);
    }
  }
  return all;
}

}  // namespace pharos::bench
