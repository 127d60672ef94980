#pragma once

#include <cstdint>

namespace pharos {

/// The kind of place where a path vertex lies.
enum class VertexKind : std::uint8_t {
  sensor,       ///< on the lens
  surface,      ///< on a shape
  volume,       ///< in a medium
  environment,  ///< infinitely far away; `position` is a stand-in outside the scene
  light,        ///< on an emitter without extent (point, spot)
};

/// The event at a path vertex. Events are bits, so that sets of events are masks.
enum class Event : std::uint8_t {
  none = 0,
  smooth_reflect = 1,     ///< has a density over directions [1/sr]
  smooth_transmit = 2,    ///< has a density over directions [1/sr]
  discrete_reflect = 4,   ///< one direction with a probability
  discrete_transmit = 8,  ///< one direction with a probability
  pass_through = 16,      ///< straight through an index-matched or masked surface; discrete
  scatter = 32,           ///< in a medium; has a density over directions [1/sr]
};

/// A set of events.
enum class EventMask : std::uint8_t {
  nothing = 0,
  smooth = 1 | 2 | 32,
  discrete = 4 | 8 | 16,
  reflect = 1 | 4,
  transmit = 2 | 8 | 16,
  all = 63,
};

constexpr EventMask mask_of(Event e) {
  return static_cast<EventMask>(e);
}
constexpr EventMask operator|(EventMask a, EventMask b) {
  return static_cast<EventMask>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr EventMask operator&(EventMask a, EventMask b) {
  return static_cast<EventMask>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}
constexpr bool contains(EventMask set, Event e) {
  return (static_cast<std::uint8_t>(set) & static_cast<std::uint8_t>(e)) != 0;
}
constexpr bool is_empty(EventMask set) {
  return set == EventMask::nothing;
}
constexpr bool is_discrete(Event e) {
  return contains(EventMask::discrete, e);
}

/// The quantity that a path carries, and thus the direction in which light runs. A path from the
/// sensor carries importance against the direction of light: it *estimates radiance*.
enum class Transport : std::uint8_t {
  radiance,    ///< the path begins at the sensor
  importance,  ///< the path begins at a light
};

/// The measure of a density. Densities of different measures are never mixed.
enum class Measure : std::uint8_t {
  solid_angle,         ///< [1/sr]: a direction; the next vertex is on a surface or the environment
  solid_angle_length,  ///< [1/(sr m)]: a direction and a distance; the next vertex is in a medium
  discrete,         ///< [1]: a discrete event; the next vertex is on a surface or the environment
  discrete_length,  ///< [1/m]: a discrete event and a distance; the next vertex is in a medium
};

/// Returns the measure of reaching a vertex of kind `target` by `event`.
constexpr Measure measure_of(Event event, VertexKind target) {
  if (target == VertexKind::volume) {
    return is_discrete(event) ? Measure::discrete_length : Measure::solid_angle_length;
  }
  return is_discrete(event) ? Measure::discrete : Measure::solid_angle;
}

}  // namespace pharos
