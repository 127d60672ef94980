#include <cmath>
#include <cstdlib>
#include <memory>

#include <doctest/doctest.h>

#include <pharos/conformance/guided.h>
#include <pharos/transport/segment.h>

#include "scene_fixtures.h"

namespace pharos {
namespace {

/// Lets all light pass.
class OpenBsdf final : public test::BlackBsdf {
 public:
  EventMask events() const override { return mask_of(Event::pass_through); }
};

/// Attenuates light by exp(-t), and always scatters after the same distance.
class SteadyMedium final : public Medium {
 public:
  explicit SteadyMedium(float distance) : distance_(distance) {}
  DistanceSample sample(const Ray& ray, Rgb, float, float) const override {
    return {distance_, distance_ < ray.t_max};
  }
  MediumLeg leg(const Ray&, Rgb, float t) const override {
    const float left = std::exp(-t);
    return {.transmittance = Rgb(left), .pass_probability = left, .scatter_pdf = 2 * left};
  }
  Rgb scattering(Point3) const override { return Rgb(1); }
  const PhaseFunction& phase_function() const override { std::abort(); }

 private:
  float distance_;
};

/// A boundary at z = 2 with a medium below it, and a black floor at z = 0.
struct Pond {
  explicit Pond(float distance) : water(std::make_shared<const SteadyMedium>(distance)) {}

  std::shared_ptr<const Medium> water;
  Scene scene{[this] {
    SceneParts parts = test::parts_of({test::square_at(0), test::square_at(2)});
    parts.objects[0].exterior = water;
    parts.objects[1].interior = water;
    parts.objects[1].bsdf = std::make_shared<const OpenBsdf>();
    return parts;
  }()};
  mutable RenderCounters counters;
  SegmentTracer tracer{scene, counters};
  conformance::KeyedSampler sampler;
  SampleStream stream{sampler, {}};

  struct Traced {
    bool arrives;
    Segment segment;
    SurfacePoint end;
  };
  /// Traces a step straight down from 1 above the boundary.
  Traced down(const ScatterStep& step) const {
    Traced traced;
    traced.arrives = tracer.trace({{0.2f, 0.1f, 3}, {0, 0, -1}}, nullptr, step, Rgb(1),
                                  VertexStream(stream, 1), traced.segment, traced.end);
    return traced;
  }
};

TEST_CASE("segments: a step scatters in the medium behind a boundary") {
  const Pond pond(0.5f);
  REQUIRE(pond.scene.has_boundaries());
  const auto [arrives, segment, end] = pond.down({});
  CHECK(arrives);
  CHECK(segment.kind == VertexKind::volume);
  CHECK(segment.medium == pond.water.get());
  CHECK(segment.length == doctest::Approx(1.5));
  CHECK(end.position.z == doctest::Approx(1.5));
  CHECK(segment.passage.transmittance.g == doctest::Approx(std::exp(-0.5)));
  CHECK(segment.passage.medium_density == doctest::Approx(2 * std::exp(-0.5)));
  CHECK(pond.counters.rays == 2);
}

TEST_CASE("segments: a surface before the place of scattering ends the step") {
  const Pond pond(2.5f);
  const auto [arrives, segment, end] = pond.down({});
  CHECK(arrives);
  CHECK(segment.kind == VertexKind::surface);
  CHECK(segment.length == doctest::Approx(3));
  CHECK(end.position.z == doctest::Approx(0));
  CHECK(segment.passage.transmittance.g == doctest::Approx(std::exp(-2.0)));
  CHECK(segment.passage.medium_density == doctest::Approx(std::exp(-2.0)));
}

TEST_CASE("segments: steps across a medium, and to a distance that was proposed") {
  const Pond pond(0.5f);
  CHECK(pond.down({.reach = Proposal::Reach::surface}).segment.kind == VertexKind::surface);
  const auto at = [&pond](float distance) {
    return pond.down({.reach = Proposal::Reach::distance, .distance = distance});
  };
  const Pond::Traced inside = at(2.25f);
  CHECK(inside.arrives);
  CHECK(inside.segment.kind == VertexKind::volume);
  CHECK(inside.segment.length == doctest::Approx(2.25));
  CHECK(inside.segment.passage.medium_density == doctest::Approx(2 * std::exp(-1.25)));
  CHECK_FALSE(at(0.5f).arrives);  // in empty space
  CHECK_FALSE(at(4).arrives);     // behind the floor
  CHECK_FALSE(at(kInfinity).arrives);
}

TEST_CASE("segments: a shadow ray passes boundaries and ends at surfaces") {
  const Pond pond(0.5f);
  const auto passes = [&pond](float length, Passage& passage) {
    return pond.tracer.pass({{0.2f, 0.1f, 3}, {0, 0, -1}, length}, nullptr, Rgb(1), passage);
  };
  Passage empty, water, floor;
  CHECK(passes(0.75f, empty));
  CHECK(empty.transmittance == Rgb(1));
  CHECK(passes(2.5f, water));
  CHECK(water.transmittance.r == doctest::Approx(std::exp(-1.5)));
  CHECK(water.medium_density == doctest::Approx(std::exp(-1.5)));
  CHECK_FALSE(passes(3.5f, floor));
}

TEST_CASE("segments: a scene without media has surfaces and the environment only") {
  const Scene scene(test::parts_of({test::square_at(0)}));
  RenderCounters counters;
  const SegmentTracer tracer(scene, counters);
  const conformance::KeyedSampler sampler;
  const SampleStream stream(sampler, {});
  const auto trace = [&](Vec3 direction, const ScatterStep& step, Segment& segment) {
    SurfacePoint end;
    return tracer.trace({{0.2f, 0.1f, 3}, direction}, nullptr, step, Rgb(1),
                        VertexStream(stream, 1), segment, end);
  };
  Segment down, up, proposed;
  CHECK(trace({0, 0, -1}, {}, down));
  CHECK(down.kind == VertexKind::surface);
  CHECK(down.length == doctest::Approx(3));
  CHECK(trace({0, 0, 1}, {}, up));
  CHECK(up.kind == VertexKind::environment);
  CHECK(std::isinf(up.length));
  CHECK(up.passage.medium_density == 1);
  CHECK_FALSE(trace({0, 0, -1}, {.reach = Proposal::Reach::distance, .distance = 1}, proposed));
}

}  // namespace
}  // namespace pharos
