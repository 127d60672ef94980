#pragma once

#include <optional>

#include <pharos/config/schema.h>
#include <pharos/core/frame.h>
#include <pharos/core/transform.h>

/// What the emitters `sky` and `sun` share: where the sun stands.
namespace pharos {

/// A place on Earth and a time, of the calendar and clock there.
struct Observer {
  float latitude = 35.6894f, longitude = 139.6917f;  ///< [degrees], north and east positive
  float timezone = 9;                                ///< of the clock, east of Greenwich [hours]
  int year = 2010, month = 7, day = 10;
  float hour = 15, minute = 0, second = 0;

  static void describe(Schema<Observer>& s);
};

/// Settings of either emitter.
struct DaylightSettings {
  float turbidity = 3;
  std::optional<Vec3> sun_direction;
  std::optional<Observer> observer;
  float stretch = 1;
  Transform to_world = {};
  float scale = 1;
};

/// The sun in the emitter's space, where +y is up, +x east and -z north.
struct SunPlace {
  double zenith = 0;   ///< angle from the zenith, in [0, pi / 2] [radians]
  double azimuth = 0;  ///< from north through east [radians]

  /// The direction at the angle `zenith` from the zenith, below the sun or above it.
  Vec3 direction(double zenith) const;
};

/// Where the sun stands for `observer`, also below the horizon. Throws InputError for days that
/// there are not.
SunPlace sun_place(const Observer& observer);

/// Where the sun stands that `settings` state, in a space of `axes`. Throws InputError, which
/// begins with the name `emitter`, when they state it twice, and when it is below the horizon.
SunPlace sun_place(const DaylightSettings& settings, const Frame& axes, const char* emitter);

/// Declares the parameters of DaylightSettings, for Settings that derive from it.
template <class Settings>
void describe_daylight(Schema<Settings>& s) {
  s.template field<float>("turbidity", &Settings::turbidity,
                          "How hazy the air is: 2 very clear, 3 clear, 6 warm and moist, 10 hazy")
      .at_least(1.7)
      .at_most(10);
  s.template field<std::optional<Vec3>>("sun_direction", &Settings::sun_direction,
                                        "Towards the sun, in world space; any length but 0")
      .check("a direction", [](const std::optional<Vec3>& d) {
        return !d || std::abs(length(normalize(*d)) - 1) < 1e-3f;
      });
  s.template field<std::optional<Observer>>(
      "observer", &Settings::observer,
      "Place and time instead of sun_direction; the defaults where neither stands");
  s.template field<float>("stretch", &Settings::stretch,
                          "Factor on angles from the zenith, which takes the horizon further down")
      .at_least(1)
      .at_most(2);
  s.template field<Transform>(
      "to_world", &Settings::to_world,
      "From the sky's space (+y up, +x east, -z north) to world space; no shear, even scale");
  s.template field<float>("scale", &Settings::scale, "Factor on the radiance").at_least(0);
}

}  // namespace pharos
