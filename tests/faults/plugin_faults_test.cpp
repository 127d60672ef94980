// Faults from the list of the statistics protocol, planted into plugins: a missing flip to the
// other hemisphere, exchanged directions, wrong Jacobians. The conformance suites must notice them.

#include <cmath>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include <pharos/conformance/conformance.h>
#include <pharos/core/warp.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/shape.h>

#include "../support/renders.h"

namespace pharos::testing {
namespace {

using Names = std::set<std::string>;

/// Returns the checks that fail for a plugin that is registered alone.
template <class Plugin>
Names red_checks() {
  Registry registry;
  registry.add<Plugin>("subject", "With a planted fault");
  return conformance::failed_checks(conformance::check_plugins(registry));
}

// --- a thin matte sheet --------------------------------------------------------------------------

enum class SheetFault { none, flip_missing, directions_exchanged, pdf_scaled };

/// A sheet that reflects one half and transmits three tenths, both by the cosine law.
template <SheetFault fault>
class Sheet final : public Bsdf {
 public:
  using Settings = NoSettings;
  explicit Sheet(const Settings&) {}

  EventMask events() const override {
    return mask_of(Event::smooth_reflect) | mask_of(Event::smooth_transmit);
  }
  ScatterValue evaluate(const SurfacePoint&, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override {
    const bool reflects = wo.z * wi.z > 0;
    const float probability =
        reflects ? reflect_probability(options) : 1 - reflect_probability(options);
    if (wo.z == 0 || wi.z == 0 || !allowed(options, reflects)) return {};
    const Vec3 towards = fault == SheetFault::directions_exchanged ? wo : wi;
    const float scale = fault == SheetFault::pdf_scaled ? 1.03f : 1.0f;
    return {Rgb((reflects ? 0.5f : 0.3f) * std::abs(wi.z) / kPi),
            scale * probability * std::abs(towards.z) / kPi};
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override {
    if (wo.z == 0 || !(allowed(options, true) || allowed(options, false))) return {};
    const bool reflects = u_choice < reflect_probability(options);
    Vec3 wi = warp::cosine_hemisphere_from_square(u);
    const bool flips = fault != SheetFault::flip_missing && !reflects;
    wi.z = std::copysign(wi.z, flips ? -wo.z : wo.z);
    const ScatterValue value = evaluate(point, wo, wi, options);
    if (!(value.pdf > 0)) return {};
    return ScatterSample{wi, reflects ? Event::smooth_reflect : Event::smooth_transmit,
                         value.value / value.pdf, value.pdf};
  }
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(0.8f); }

 private:
  static bool allowed(ScatterOptions options, bool reflects) {
    return contains(options.events, reflects ? Event::smooth_reflect : Event::smooth_transmit);
  }
  static float reflect_probability(ScatterOptions options) {
    if (!allowed(options, true)) return 0;
    return allowed(options, false) ? 0.6f : 1;
  }
};

// --- a square ------------------------------------------------------------------------------------

enum class SquareFault { none, distance_forgotten, cosine_forgotten };

/// The square [-1,1]^2 in the plane z = 0.
template <SquareFault fault>
class Square final : public Shape {
 public:
  using Settings = NoSettings;
  explicit Square(const Settings&) {
    mesh_.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh_.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh_.precompute();
  }

  Bounds3 bounds() const override { return mesh_.bounds(); }
  float area() const override { return 4; }
  const TriangleMesh* mesh() const override { return &mesh_; }
  ShapeSample sample(Vec2 u) const override {
    const bool lower = u.x >= u.y;  // the diagonal of the square separates the two triangles
    const Vec2 b = lower ? Vec2{u.x - u.y, u.y} : Vec2{u.x, u.y - u.x};
    return {mesh_.surface_point(lower ? 0 : 1, b.x, b.y), 0.25f};
  }
  ShapeSample sample_from(Point3 from, Vec2 u) const override {
    ShapeSample s = sample(u);
    s.pdf = pdf_from(from, s.point);
    return s;
  }
  float pdf_from(Point3 from, const SurfacePoint& point) const override {
    const Vec3 d = point.position - from;
    const float distance_squared = length_squared(d);
    const float cosine = std::abs(d.z) / std::sqrt(distance_squared);
    if (!(cosine > 0)) return 0;
    float pdf = 0.25f * distance_squared / cosine;
    if (fault == SquareFault::distance_forgotten) pdf /= distance_squared;
    if (fault == SquareFault::cosine_forgotten) pdf *= cosine;
    return pdf;
  }

 private:
  TriangleMesh mesh_;
};

}  // namespace

TEST_CASE("a sheet and a square without faults") {
  CHECK(red_checks<Sheet<SheetFault::none>>() == Names{});
  CHECK(red_checks<Square<SquareFault::none>>() == Names{});
}
TEST_CASE("fault: transmitted directions are not flipped to the other side") {
  const Names red = red_checks<Sheet<SheetFault::flip_missing>>();
  CHECK(red.contains("chi_square"));
  CHECK(red.contains("events"));
}
TEST_CASE("fault: the density is that of the exchanged directions") {
  const Names red = red_checks<Sheet<SheetFault::directions_exchanged>>();
  CHECK(red.contains("chi_square"));
  CHECK(red.contains("integral"));
  CHECK_FALSE(red.contains("weight"));
}
TEST_CASE("fault: a density is scaled by 1.03") {
  CHECK(red_checks<Sheet<SheetFault::pdf_scaled>>().contains("integral"));
}
TEST_CASE("fault: the Jacobian lacks the squared distance") {
  CHECK(red_checks<Square<SquareFault::distance_forgotten>>().contains("solid_angle"));
}
TEST_CASE("fault: the Jacobian lacks the cosine") {
  CHECK(red_checks<Square<SquareFault::cosine_forgotten>>().contains("solid_angle"));
}

TEST_CASE("fault: paths from the lens ignore how samples are shared among the pixels") {
  const auto report = conformance::check_plugins(registry(), {.names = {"share_blind"}});
  CHECK(conformance::failed_checks(report) == Names{"pixel_shares"});
}

}  // namespace pharos::testing
