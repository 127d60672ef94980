#include "../daylight.h"

#include <numbers>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Zenith angle and azimuth from north through east [degrees].
struct Expected {
  double zenith, azimuth;
};

void check_place(const Observer& observer, const Expected& expected) {
  const SunPlace sun = sun_place(observer);
  const double azimuth = sun.azimuth / kDegree;
  CHECK(sun.zenith / kDegree == doctest::Approx(expected.zenith).epsilon(3e-4));
  CHECK((azimuth < 0 ? azimuth + 360 : azimuth) == doctest::Approx(expected.azimuth).epsilon(3e-4));
}

}  // namespace

TEST_CASE("daylight: the sun's place agrees with another algorithm") {
  // Expected values follow the formulas of NOAA's solar calculator (after Meeus, "Astronomical
  // Algorithms").
  check_place({}, {43.9191, 265.7532});
  check_place({.latitude = 52.52f,
               .longitude = 13.405f,
               .timezone = 1,
               .year = 2024,
               .month = 12,
               .day = 21,
               .hour = 10,
               .minute = 30},
              {78.7152, 157.9452});
  check_place({.latitude = -33.87f,
               .longitude = 151.21f,
               .timezone = 11,
               .year = 1999,
               .month = 1,
               .day = 5,
               .hour = 17,
               .minute = 14,
               .second = 60},
              {56.3245, 263.6741});
}

TEST_CASE("daylight: north is -z, east is +x, up is +y") {
  const SunPlace noon =
      sun_place(Observer{.hour = 11.7f});  // in Tokyo the sun is high in the south
  CHECK(noon.direction(noon.zenith).z > 0.2f);
  CHECK(noon.direction(noon.zenith).y > 0.9f);
  const SunPlace morning = sun_place(Observer{.hour = 7});
  CHECK(morning.direction(morning.zenith).x > 0.7f);
  const SunPlace evening = sun_place(Observer{.hour = 17});
  CHECK(evening.direction(evening.zenith).x < -0.7f);
}

TEST_CASE("daylight: a direction in world space, and its place in the sky's") {
  const DaylightSettings settings{.sun_direction = Vec3{0, 3, 3}};
  const SunPlace sun = sun_place(settings, {}, "sky");
  CHECK(sun.zenith == doctest::Approx(45 * kDegree));
  CHECK(std::abs(sun.azimuth) == doctest::Approx(std::numbers::pi));
  CHECK(length(sun.direction(sun.zenith) - normalize(Vec3{0, 1, 1})) < 1e-6f);
  const Frame z_up{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  CHECK(sun_place(DaylightSettings{.sun_direction = Vec3{0, 0, 2}}, z_up, "sky").zenith ==
        doctest::Approx(0).scale(1));
}

TEST_CASE("daylight: suns that are not to be had") {
  const auto refusal = [](const DaylightSettings& settings) {
    return test::input_error([&] { sun_place(settings, {}, "sky"); });
  };
  CHECK(refusal({.sun_direction = Vec3{0, 1, 0}, .observer = Observer{}}) ==
        "sky: 'sun_direction' and 'observer' exclude each other");
  CHECK(refusal({.sun_direction = Vec3{1, -1, 0}}) ==
        "sky: the sun is 45 degrees below the horizon; the model ends there");
  CHECK(refusal({.observer = Observer{.hour = 23}}).starts_with("sky: the sun is "));
  CHECK(refusal({.observer = Observer{.year = 2023, .month = 2, .day = 29}}) ==
        "there is no day 2023-02-29");
  CHECK(refusal({.sun_direction = Vec3{1, 0, 0}}) == "no error");  // on the horizon
  CHECK(refusal({.sun_direction = Vec3{1, -1e-8f, 0}}) == "no error");
}

}  // namespace pharos
