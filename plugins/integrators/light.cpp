// light: light tracing. Paths start at the lights, each chosen by its power, and whatever they meet
// is seen from the lens, as a splat: caustics that no path from the sensor finds are found, what is
// behind mirrors, glass, masks and the like is not. The first vertex on the light is seen as well;
// environments are seen by sensors that see more than one direction.
//
// One path starts for each sample of a pixel, whatever pixels it then lands in. There are no layers
// of first hits (albedo, normal, depth), and no paths through the middles of pixels alone.
//
//     integrator: { type: light, max_depth: 12 }

#include "light.h"

#include <vector>

#include <fmt/format.h>

#include <pharos/core/error.h>

#include "light_walk.h"
#include "unit_paths.h"

namespace pharos {
namespace {

/// What a path contributes, until it is known to be finite.
class Splats {
 public:
  explicit Splats(std::size_t most) { all_.reserve(most); }
  void arrive(VertexKind, Point3, Rgb) {}
  void contribute(Vec2 film, Rgb contribution) { all_.push_back({film, contribution}); }

  /// Puts them on the film; nothing of a path of NaN or infinity.
  void deposit(const PathKey& key, WorkResult& result) {
    bool finite = true;
    for (const auto& [film, contribution] : all_) finite = finite && is_finite(contribution);
    if (!finite) reject(key, result);
    for (const auto& [film, contribution] : all_) {
      if (finite && !is_black(contribution)) result.film.add_splat(film, contribution);
    }
    all_.clear();
  }

 private:
  struct Splat {
    Vec2 film;
    Rgb contribution;
  };
  std::vector<Splat> all_;
};

/// Tells of a path.
class Teller {
 public:
  void arrive(VertexKind kind, Point3 at, Rgb throughput) {
    const char* what = kind == VertexKind::volume        ? "volume"
                       : kind == VertexKind::environment ? "environment"
                       : kind == VertexKind::light       ? "light"
                                                         : "surface";
    text_ += fmt::format(
        "{:3} {:<11} at ({:.6g}, {:.6g}, {:.6g})  throughput ({:.6g}, {:.6g}, {:.6g})\n", number_++,
        what, at.x, at.y, at.z, throughput.r, throughput.g, throughput.b);
  }
  void contribute(Vec2 film, Rgb c) {
    total_ += c;
    text_ += fmt::format("      seen at film ({:.4f}, {:.4f}) px: ({:.6g}, {:.6g}, {:.6g})\n",
                         film.x, film.y, c.r, c.g, c.b);
  }
  PathTrace trace() const { return {total_, text_}; }

 private:
  std::string text_;
  int number_ = 0;
  Rgb total_;
};

class PreparedLight final : public PreparedIntegrator {
 public:
  PreparedLight(std::uint16_t max_depth, const RenderTarget& target)
      : target_(target),
        lights_(target.scene, LightSelection::one),
        shared_{target_, lights_, max_depth} {}

  void render(const WorkUnit& unit, const IterationContext& context,
              WorkResult& result) const override {
    Splats splats(shared_.max_depth);
    for_each_path(unit, context, target_.width, result,
                  [&](const PathKey& key, const SampleStream& stream) {
                    LightWalk(shared_, stream, result.counters, splats).run();
                    splats.deposit(key, result);
                  });
  }

  PathTrace replay(const PathKey& key, const IterationContext& context) const override {
    Teller teller;
    RenderCounters counters;
    const SampleStream stream(context.sampler, key);
    LightWalk(shared_, stream, counters, teller).run();
    return teller.trace();
  }

 private:
  RenderTarget target_;
  LightSelector lights_;
  LightScene shared_;
};

}  // namespace

void LightIntegrator::Settings::describe(Schema<Settings>& s) {
  s.field("max_depth", &Settings::max_depth, "Longest path, from the light to the lens")
      .unit("segments")
      .at_least(1);
}

std::unique_ptr<const PreparedIntegrator> LightIntegrator::prepare(
    const RenderTarget& target) const {
  if (!target.jitter) throw InputError("the integrator 'light' needs a film with 'jitter: true'");
  return std::make_unique<PreparedLight>(settings_.max_depth, target);
}

}  // namespace pharos
