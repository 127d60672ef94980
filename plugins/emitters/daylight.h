#pragma once

#include <optional>

#include <pharos/config/schema.h>
#include <pharos/core/frame.h>
#include <pharos/core/transform.h>

/// The position of the sun, shared by the emitters `sky` and `sun`.
namespace pharos {

/// A place on Earth and a local date and time.
struct Observer {
  float latitude = 35.6894f, longitude = 139.6917f;  ///< [degrees], north and east positive
  float timezone = 9;  ///< difference of the clock to Greenwich time, east positive [hours]
  int year = 2010, month = 7, day = 10;
  float hour = 15, minute = 0, second = 0;

  static void describe(Schema<Observer>& s);
};

/// The common settings of `sky` and `sun`.
struct DaylightSettings {
  float turbidity = 3;
  std::optional<Vec3> sun_direction;
  std::optional<Observer> observer;
  float stretch = 1;
  Transform to_world = {};
  float scale = 1;
};

/// The position of the sun in the emitter's space, where +y is up, +x east and -z north.
struct SunPlace {
  double zenith = 0;   ///< angle from the zenith, in [0, pi / 2] [radians]
  double azimuth = 0;  ///< from north through east [radians]

  /// Returns the direction at the angle `zenith` from the zenith and at the sun's azimuth.
  Vec3 direction(double zenith) const;
};

/// Returns the position of the sun for `observer`, also below the horizon. Throws InputError if the
/// date does not exist.
SunPlace sun_place(const Observer& observer);

/// Returns the position of the sun given by `settings`, in a space with the given `axes`. Throws
/// InputError, beginning with the name `emitter`, if the settings give the position twice or if the
/// sun is below the horizon.
SunPlace sun_place(const DaylightSettings& settings, const Frame& axes, const char* emitter);

/// Declares the parameters of DaylightSettings for a Settings class derived from it.
template <class Settings>
void describe_daylight(Schema<Settings>& s) {
  s.template field<float>("turbidity", &Settings::turbidity,
                          "Haziness of the air: 2 very clear, 3 clear, 6 warm and moist, 10 hazy")
      .at_least(1.7)
      .at_most(10);
  s.template field<std::optional<Vec3>>(
       "sun_direction", &Settings::sun_direction,
       "Direction towards the sun, in world space; any length except 0")
      .check("a direction", [](const std::optional<Vec3>& d) {
        return !d || std::abs(length(normalize(*d)) - 1) < 1e-3f;
      });
  s.template field<std::optional<Observer>>(
      "observer", &Settings::observer,
      "Place and time, as an alternative to sun_direction; its defaults hold if neither is given");
  s.template field<float>("stretch", &Settings::stretch,
                          "Factor on angles from the zenith; more than 1 lowers the horizon")
      .at_least(1)
      .at_most(2);
  s.template field<Transform>(
      "to_world", &Settings::to_world,
      "From the sky's space (+y up, +x east, -z north) to world space; even scale, no shear");
  s.template field<float>("scale", &Settings::scale, "Factor on the radiance").at_least(0);
}

}  // namespace pharos
