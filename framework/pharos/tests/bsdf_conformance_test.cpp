// BSDFs: a planted fault makes exactly the checks fail that are meant to find it.

#include <atomic>
#include <cmath>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <pharos/core/warp.h>
#include <pharos/scene/bsdf.h>

#include "planted_faults.h"

namespace pharos {
namespace {

using test::FaultSettings;
using test::red_with;

// --- bsdf ----------------------------------------------------------------------------------------

enum class BsdfFault {
  none,
  pdf_scale,
  pdf_scale_of_half,
  pdf_shape,
  weight,
  adjoint,
  energy,
  event,
  nan,
  nan_density,
  infinite_density,
  memory
};

/// A matte surface.
class FaultyBsdf final : public Bsdf {
 public:
  using Settings = FaultSettings<BsdfFault>;
  explicit FaultyBsdf(const Settings&) : fault_(Settings::planted) {}

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint&, Vec3 wo, Vec3 wi, ScatterOptions o) const override {
    const bool masked = !contains(o.events, Event::smooth_reflect) && fault_ != BsdfFault::event;
    if (fault_ == BsdfFault::nan_density && wo.z > 0 && wi.z < -0.1f) return {Rgb(0), NAN};
    if (fault_ == BsdfFault::infinite_density && wo.z > 0 && wi.z < -0.1f) return {{}, kInfinity};
    if (wo.z <= 0 || wi.z <= 0 || masked) return {};
    if (fault_ == BsdfFault::nan && wi.z < 1e-5f) return {Rgb(std::sqrt(-wo.z)), 1};
    const float pdf = warp::cosine_hemisphere_pdf(wi.z);
    return {reflectance(wo, wi) * pdf, claimed(pdf, wi)};
  }
  std::optional<ScatterSample> sample(const SurfacePoint&, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions o) const override {
    if (wo.z <= 0 || !contains(o.events, Event::smooth_reflect)) return {};
    const Vec3 wi = warp::cosine_hemisphere_from_square(u);
    const bool lost = fault_ == BsdfFault::pdf_scale_of_half && u_choice < 0.5f;
    if (wi.z <= 0 || lost) return {};
    const float pdf = warp::cosine_hemisphere_pdf(wi.z);
    Rgb weight = reflectance(wo, wi) * (pdf / claimed(pdf, wi));
    if (fault_ == BsdfFault::weight) weight *= 1.03f;
    if (fault_ == BsdfFault::memory && ++calls_ % 5 == 0) weight *= 0.9999f;
    return ScatterSample{wi, Event::smooth_reflect, weight, claimed(pdf, wi)};
  }
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(0.5f); }

 private:
  Rgb reflectance(Vec3 wo, Vec3 wi) const {
    if (fault_ == BsdfFault::adjoint) return Rgb(0.5f + 0.05f * (wo.z - wi.z));
    return Rgb(fault_ == BsdfFault::energy ? 1.03f : 0.5f);
  }
  float claimed(float pdf, Vec3 wi) const {
    if (fault_ == BsdfFault::pdf_scale) return 1.03f * pdf;
    if (fault_ == BsdfFault::pdf_scale_of_half) return 1.03f * 0.5f * pdf;
    if (fault_ == BsdfFault::pdf_shape) return pdf * (1 + 0.2f * wi.x);
    return pdf;
  }

  BsdfFault fault_;
  mutable std::atomic<int> calls_{0};
};

TEST_CASE("conformance: faults of a BSDF") {
  CHECK(red_with<FaultyBsdf>(BsdfFault::none) == "");
  // A density that is too large may also fail the test of counts, which then expects more draws
  // than there are.
  CHECK(red_with<FaultyBsdf>(BsdfFault::pdf_scale).ends_with("integral"));
  CHECK(red_with<FaultyBsdf>(BsdfFault::pdf_scale_of_half).ends_with("integral"));
  CHECK(red_with<FaultyBsdf>(BsdfFault::pdf_shape) == "chi_square");
  CHECK(red_with<FaultyBsdf>(BsdfFault::weight) == "weight");
  CHECK(red_with<FaultyBsdf>(BsdfFault::adjoint) == "adjoint");
  CHECK(red_with<FaultyBsdf>(BsdfFault::energy) == "energy");
  CHECK(red_with<FaultyBsdf>(BsdfFault::event) == "events integral");
  CHECK(red_with<FaultyBsdf>(BsdfFault::nan) == "finite");
  for (const BsdfFault fault : {BsdfFault::nan_density, BsdfFault::infinite_density}) {
    CHECK(red_with<FaultyBsdf>(fault).find("integral") != std::string::npos);
  }
  CHECK(red_with<FaultyBsdf>(BsdfFault::memory) == "determinism");
}

TEST_CASE("conformance: the report does not depend on the number of threads") {
  const auto run = [](int threads) {
    return tbb::task_arena(threads).execute(
        [] { return to_json(test::report_with<FaultyBsdf>(BsdfFault::pdf_shape)); });
  };
  const std::string one = run(1);
  CHECK(one == run(2));
  CHECK(one.find(R"("check": "chi_square", "verdict": "failed")") != std::string::npos);
}

// --- glass ---------------------------------------------------------------------------------------

enum class GlassFault { none, no_scaling, probability };

/// An interface that refracts the share 0.8, except under total reflection.
class FaultyGlass final : public Bsdf {
 public:
  using Settings = FaultSettings<GlassFault>;
  explicit FaultyGlass(const Settings&) : fault_(Settings::planted) {}

  EventMask events() const override { return EventMask::discrete; }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  DiscreteOutcomes discrete(const SurfacePoint&, Vec3 wo, ScatterOptions o) const override {
    DiscreteOutcomes all;
    if (wo.z == 0) return all;
    const float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    const float cos2 = 1 - (1 - wo.z * wo.z) / (eta * eta);
    const bool refracts = cos2 > 0 && contains(o.events, Event::discrete_transmit);
    const bool reflects = contains(o.events, Event::discrete_reflect);
    const float share = cos2 > 0 ? 0.2f : 1.0f;
    if (reflects) {
      all.add({Event::discrete_reflect, {-wo.x, -wo.y, wo.z}, Rgb(share), refracts ? share : 1});
    }
    if (refracts) {
      const bool scaled = o.transport == Transport::radiance && fault_ != GlassFault::no_scaling;
      const Vec3 direction{-wo.x / eta, -wo.y / eta, std::copysign(std::sqrt(cos2), -wo.z)};
      all.add({Event::discrete_transmit, normalize(direction),
               Rgb(scaled ? 0.8f / (eta * eta) : 0.8f), reflects ? 0.8f : 1.0f});
    }
    return all;
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u, Vec2,
                                      ScatterOptions o) const override {
    const DiscreteOutcomes all = discrete(point, wo, o);
    if (all.count == 0) return {};
    const float reflected = fault_ == GlassFault::probability ? 0.23f : 0.2f;
    const DiscreteOutcome& c = all.outcomes[all.count == 2 && u >= reflected ? 1 : 0];
    return ScatterSample{c.direction, c.event, c.value / c.probability, c.probability};
  }
  float roughness(const SurfacePoint&) const override { return 0; }
  float relative_ior() const override { return 1 / 1.5f; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(1); }

 private:
  GlassFault fault_;
};

TEST_CASE("conformance: faults of an interface") {
  CHECK(red_with<FaultyGlass>(GlassFault::none) == "");
  CHECK(red_with<FaultyGlass>(GlassFault::no_scaling) == "adjoint");
  CHECK(red_with<FaultyGlass>(GlassFault::probability) == "discrete");
}
}  // namespace
}  // namespace pharos
