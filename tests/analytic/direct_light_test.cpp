// Irradiance under lights with known closed forms, for every strategy and sampler.

#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "analytic.h"

namespace pharos::testing {
namespace {

using std::numbers::pi;

/// Returns a shape that emits radiance 3 and reflects nothing.
std::string lamp(const std::string& shape,
                 const std::string& emitter = "{ type: area, radiance: 3 }") {
  return fmt::format("    - {{ {}, material: black, emitter: {} }}\n", shape, emitter);
}

std::string placed(const std::string& type, const Transform& to_world) {
  return fmt::format("type: {}, to_world: {}", type, Value<Transform>::default_text(to_world));
}

/// Places a shape at height `h`, facing the floor.
Transform overhead(float h, Vec3 scale) {
  return Transform::translate({0, 0, h}) * Transform::rotate({1, 0, 0}, 180) *
         Transform::scale(scale);
}

/// Returns polygon_irradiance() of a rectangle with the half-edges a and b, parallel to the floor
/// and centered at height h: pi times four times the view factor of a quarter (Howell, catalog of
/// configuration factors, B-4).
double rectangle_irradiance(double a, double b, double h) {
  const double x = a / h, y = b / h;
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return 2 * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
}

TEST_CASE("a rectangle overhead") {
  const Transform quad = overhead(0.5f, {1, 0.5f, 1});
  const double irradiance = rectangle_irradiance(1, 0.5, 0.5);
  REQUIRE(polygon_irradiance(quad) == doctest::Approx(irradiance));
  Floor(lamp(placed("quad", quad)), "").check_irradiance(3 * irradiance, kStrategies);
}

TEST_CASE("a tilted rectangle") {
  const Transform quad = Transform::look_at({0.25f, 0.1f, 0.5f}, {-0.05f, 0, 0}, {0, 1, 0}) *
                         Transform::scale({0.75f, 0.7f, 1});
  Floor(lamp(placed("quad", quad)), "").check_irradiance(3 * polygon_irradiance(quad), kStrategies);
}

TEST_CASE("a sphere above the horizon") {
  // pi L (r / d)^2 cos: the same as for a disk with the solid angle of the sphere.
  const double d2 = 0.2 * 0.2 + 0.7 * 0.7;
  Floor(lamp("type: sphere, center: [0.2, 0, 0.7], radius: 0.6"), "")
      .check_irradiance(3 * pi * 0.36 / d2 * 0.7 / std::sqrt(d2), kStrategies);
}

TEST_CASE("a disk overhead") {
  if (registry().find("shape", "disk") == nullptr) {
    MESSAGE("there is no disk: skipped");
    return;
  }
  const double r = 1.2, h = 0.5;
  const std::string disk = placed("disk", overhead(0.5f, {1.2f, 1.2f, 1}));
  const double sine_squared = r * r / (h * h + r * r);
  Floor(lamp(disk), "").check_irradiance(3 * pi * sine_squared, kStrategies);

  // With radiance L c^n, where c is the cosine at both ends, the irradiance is the integral of 2 pi
  // L c^(n+1) over c.
  const double c = std::sqrt(1 - sine_squared);
  Floor(lamp(disk, "{ type: directional_area, radiance: 3, exponent: 1 }"), "")
      .check_irradiance(3 * 2 * pi * (1 - std::pow(c, 3)) / 3, kStrategies);
}

TEST_CASE("lights without extent") {
  const double d2 = 0.3 * 0.3 + 0.4 * 0.4 + 1.2 * 1.2, cosine = 1.2 / std::sqrt(d2);
  Floor("", "    - { type: point, intensity: 5, position: [0.3, 0.4, 1.2] }\n")
      .check_irradiance(5 * cosine / d2, kLightSampling);
  Floor("", "    - { type: directional, irradiance: 2, direction: [-3, 0, -4] }\n")
      .check_irradiance(2 * 0.8, kLightSampling);

  const auto spot = [](double degrees_off_axis) {
    const double tangent = std::tan(degrees_off_axis * pi / 180);
    return fmt::format(
        "    - {{ type: spot, intensity: 5, cutoff_angle: 30, beam_width: 20, to_world: "
        "{{ look_at: {{ origin: [0, 0, 2], target: [{}, 0, 0], up: [0, 1, 0] }} }} }}\n",
        2 * tangent);
  };
  Floor("", spot(0)).check_irradiance(5.0 / 4, kLightSampling);
  Floor("", spot(25)).check_irradiance(5.0 / 4 / 2, kLightSampling);
}

TEST_CASE("several lights add up, however one is chosen") {
  const Transform quad = overhead(0.5f, {1, 0.5f, 1});
  const Floor floor(lamp(placed("quad", quad)),
                    "    - { type: point, intensity: 0.5, position: [-0.5, 0, 0.3] }\n"
                    "    - { type: directional, irradiance: 2, direction: [3, 0, -0.5] }\n");
  const double d2 = 0.25 + 0.09;
  floor.check_irradiance(3 * rectangle_irradiance(1, 0.5, 0.5) + 0.5 * 0.3 / std::pow(d2, 1.5) +
                             2 * 0.5 / std::sqrt(9.25),
                         kLightSampling);
}

}  // namespace
}  // namespace pharos::testing
