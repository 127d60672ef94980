// Samplers and guides: a planted fault makes exactly the checks fail that are meant to find it.

#include <atomic>
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/sampling/keyed_numbers.h>

#include "planted_faults.h"

namespace pharos {
namespace {

using test::FaultSettings;
using test::red_with;

// --- sampler -------------------------------------------------------------------------------------

enum class SamplerFault {
  none,
  squared,
  same_for_all_bounces,
  same_for_all_samples,
  same_for_all_iterations,
  pairs,
  one
};

class FaultySampler final : public Sampler {
 public:
  using Settings = FaultSettings<SamplerFault>;
  explicit FaultySampler(const Settings&) : fault_(Settings::planted) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid&, const SamplePlan&,
                                                 const IntegrandProbe*) const override {
    return std::make_unique<const Prepared>(fault_);
  }

 private:
  class Prepared final : public PreparedSampler {
   public:
    explicit Prepared(SamplerFault fault) : fault_(fault) {}
    std::uint64_t begin(const PathKey& key) const override {
      PathKey seen = key;
      if (fault_ == SamplerFault::same_for_all_samples) seen.sample = 0;
      if (fault_ == SamplerFault::same_for_all_iterations) seen.iteration = 0;
      if (fault_ == SamplerFault::pairs) seen.sample /= 2;
      return hash_key(seen);
    }
    float value_1d(const SampleStream& stream, Dimension d) const override {
      return value_2d(stream, d).x;
    }
    Vec2 value_2d(const SampleStream& stream, Dimension d) const override {
      if (fault_ == SamplerFault::same_for_all_bounces) d = {d.purpose(), 0, d.branch()};
      Vec2 u = keyed_numbers(stream.state(), d);
      if (fault_ == SamplerFault::squared) u.x = std::pow(u.x, 1.1f);
      if (fault_ == SamplerFault::one && u.x > 0.9999f) u.x = 1;
      return u;
    }

   private:
    SamplerFault fault_;
  };
  SamplerFault fault_;
};

TEST_CASE("conformance: faults of a sampler") {
  CHECK(red_with<FaultySampler>(SamplerFault::none) == "");
  CHECK(red_with<FaultySampler>(SamplerFault::squared) == "independence mean uniformity");
  CHECK(red_with<FaultySampler>(SamplerFault::same_for_all_bounces) == "independence");
  CHECK(red_with<FaultySampler>(SamplerFault::same_for_all_samples) == "independence");
  CHECK(red_with<FaultySampler>(SamplerFault::same_for_all_iterations) == "independence");
  CHECK(red_with<FaultySampler>(SamplerFault::pairs) == "independence");
  CHECK(red_with<FaultySampler>(SamplerFault::one) == "range");
}

// --- guider --------------------------------------------------------------------------------------

enum class GuideFault { none, pdf, fog_pdf, forgets, moods, declines, no_model };

/// Knows only whether it was made to be loaded.
class BlankModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "blank";
  explicit BlankModel(bool loaded) : loaded_(loaded) {}
  ModelInfo info() const override { return {.name = std::string(kName)}; }
  void archive(Archive&) override {}
  double density(Point3, const Vec3*) const override { return 1; }
  bool loaded() const { return loaded_; }

 private:
  bool loaded_;
};

class BlankLearner final : public Learner {
 public:
  using Settings = NoSettings;
  explicit BlankLearner(const Settings&) {}
  LearnerTraits traits() const override { return {}; }
  std::unique_ptr<LearningState> begin(const LearningContext&) const override {
    return std::make_unique<State>();
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<BlankModel>(true);
  }

 private:
  class State final : public LearningState {
   public:
    void absorb(const PathLog&) override {}
    Learned update(const TrainingStage&) override {
      if (FaultSettings<GuideFault>::planted == GuideFault::no_model) return {};
      return {std::make_shared<BlankModel>(false)};
    }
    void archive(Archive&) override {}
  };
};

/// Directions uniform over the sphere.
class FaultyGuider final : public GuiderOf<BlankModel> {
 public:
  using Settings = FaultSettings<GuideFault>;
  explicit FaultyGuider(const Settings&) : fault_(Settings::planted) {}
  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const BlankModel& model, const GuidingQuery& query,
                                   Arena& arena) const override {
    if (fault_ == GuideFault::declines) return nullptr;
    const bool in_fog = query.current.kind == VertexKind::volume;
    const bool wrong = fault_ == GuideFault::pdf || (fault_ == GuideFault::fog_pdf && in_fog);
    const bool turned = (fault_ == GuideFault::forgets && model.loaded()) ||
                        (fault_ == GuideFault::moods && ++asked_ % 3 == 0);
    return arena.make<Sphere>(wrong ? 1.03f : 1.0f, turned ? 0.3f : 0.0f);
  }

 private:
  class Sphere final : public GuidingDistribution {
   public:
    Sphere(float pdf_scale, float turn) : pdf_scale_(pdf_scale), turn_(turn) {}
    std::optional<Proposal> propose(const VertexStream& stream) const override {
      Vec2 u = stream.get_2d(Purpose::guide_direction);
      u.x = u.x + turn_ - std::floor(u.x + turn_);
      return Proposal{.direction = warp::sphere_from_square(u)};
    }
    float density(const ResolvedVertex&) const override { return pdf_scale_ * warp::sphere_pdf(); }

   private:
    float pdf_scale_, turn_;
  };

  GuideFault fault_;
  mutable std::atomic<int> asked_{0};
};

/// Returns the failed checks of the guider. If `tested` is the learner, returns the failed checks
/// of the learner and of the pair of both.
std::string red_guide(GuideFault fault, const char* tested = "faulty") {
  FaultSettings<GuideFault>::planted = fault;
  Registry registry;
  load_modules(registry, PHAROS_PLUGINS, true);
  registry.add<BlankLearner>("blank", "Learns nothing");
  registry.add<FaultyGuider>("faulty", "Uniform");
  return test::red(conformance::check_plugins(registry, {.names = {tested}}));
}

TEST_CASE("conformance: faults of a guide") {
  CHECK(red_guide(GuideFault::none) == "");
  CHECK(red_guide(GuideFault::pdf).find("integral") != std::string::npos);
  CHECK(red_guide(GuideFault::fog_pdf).find("integral") != std::string::npos);
  CHECK(red_guide(GuideFault::declines) == "answers");
  CHECK(red_guide(GuideFault::no_model) == "answers");
  CHECK(red_guide(GuideFault::no_model, "blank") == "answers determinism");
  CHECK(red_guide(GuideFault::forgets) == "save_load");
  CHECK(red_guide(GuideFault::moods).find("determinism") != std::string::npos);
}
}  // namespace
}  // namespace pharos
