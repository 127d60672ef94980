#include "daylight.h"

#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// The position of the sun in the sky of the equator [radians].
struct CelestialPlace {
  double right_ascension, declination;
};

/// Days since noon of 1 January 2000, universal time.
double elapsed_days(const Observer& observer, double universal_hours) {
  using namespace std::chrono;
  const year_month_day date{year(observer.year), month(static_cast<unsigned>(observer.month)),
                            std::chrono::day(static_cast<unsigned>(observer.day))};
  if (!date.ok()) {
    throw InputError(
        fmt::format("there is no day {}-{:02}-{:02}", observer.year, observer.month, observer.day));
  }
  const sys_days start{year(2000) / January / 1};
  return static_cast<double>((sys_days(date) - start).count()) - 0.5 + universal_hours / 24;
}

// Uses the algorithm and numbers of Blanco-Muriel et al. 2001, "Computing the Solar Vector" (Solar
// Energy 70). They are accurate to half a minute of arc until 2015 and not much worse later.

CelestialPlace celestial_place(double days) {
  const double omega = 2.1429 - 0.0010394594 * days;
  const double mean_longitude = 4.8950630 + 0.017202791698 * days;
  const double anomaly = 6.2400600 + 0.0172019699 * days;
  const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) +
                           0.00034894 * std::sin(2 * anomaly) - 0.0001134 -
                           0.0000203 * std::sin(omega);
  const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);
  return {std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)),
          std::asin(std::sin(obliquity) * std::sin(longitude))};
}

}  // namespace

void Observer::describe(Schema<Observer>& s) {
  s.field("latitude", &Observer::latitude, "Latitude, positive north of the equator")
      .unit("degrees")
      .at_least(-90)
      .at_most(90);
  s.field("longitude", &Observer::longitude, "Longitude, positive east of Greenwich")
      .unit("degrees")
      .at_least(-180)
      .at_most(180);
  s.field("timezone", &Observer::timezone,
          "Difference of the clock to Greenwich time, positive in the east")
      .unit("hours")
      .at_least(-15)
      .at_most(15);
  s.field("year", &Observer::year, "Year").at_least(1900).at_most(2100);
  s.field("month", &Observer::month, "Month").at_least(1).at_most(12);
  s.field("day", &Observer::day, "Day of the month").at_least(1).at_most(31);
  s.field("hour", &Observer::hour, "Hour").unit("hours").at_least(0).at_most(24);
  s.field("minute", &Observer::minute, "Minute").unit("minutes").at_least(0).at_most(60);
  s.field("second", &Observer::second, "Second").unit("seconds").at_least(0).at_most(60);
}

Vec3 SunPlace::direction(double at_zenith) const {
  const double sine = std::sin(at_zenith);
  return {static_cast<float>(sine * std::sin(azimuth)), static_cast<float>(std::cos(at_zenith)),
          static_cast<float>(-sine * std::cos(azimuth))};
}

SunPlace sun_place(const Observer& observer) {
  const double hours =
      double{observer.hour} - observer.timezone + observer.minute / 60.0 + observer.second / 3600.0;
  const double days = elapsed_days(observer, hours);
  const auto [right_ascension, declination] = celestial_place(days);
  const double greenwich = 6.6974243242 + 0.0657098283 * days + hours;  // sidereal time [hours]
  const double hour_angle = (15 * greenwich + observer.longitude) * kDegree - right_ascension;
  const double latitude = observer.latitude * kDegree;
  const double height = std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                        std::sin(declination) * std::sin(latitude);
  const double zenith = std::acos(std::clamp(height, -1.0, 1.0));
  constexpr double kParallax =
      6371.01 / 149597890;  // Earth's radius over its distance from the sun
  return {
      .zenith = zenith + kParallax * std::sin(zenith),
      .azimuth = std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) -
                                                       std::sin(latitude) * std::cos(hour_angle))};
}

SunPlace sun_place(const DaylightSettings& settings, const Frame& axes, const char* emitter) {
  if (settings.sun_direction && settings.observer) {
    throw InputError(fmt::format("{}: 'sun_direction' and 'observer' exclude each other", emitter));
  }
  SunPlace sun;
  if (settings.sun_direction) {
    const Vec3 d = axes.to_local(normalize(*settings.sun_direction));
    sun = {.zenith = std::atan2(std::hypot(d.x, d.z), d.y), .azimuth = std::atan2(d.x, -d.z)};
  } else {
    sun = sun_place(settings.observer.value_or(Observer{}));
  }
  constexpr double kHorizon = std::numbers::pi / 2, kRounding = 1e-6;
  if (sun.zenith > kHorizon + kRounding) {
    throw InputError(
        fmt::format("{}: the sun is {:.4g} degrees below the horizon; the model ends "
                    "there",
                    emitter, (sun.zenith - kHorizon) / kDegree));
  }
  sun.zenith = std::min(sun.zenith, kHorizon);
  return sun;
}

}  // namespace pharos
