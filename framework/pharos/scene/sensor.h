#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/ray.h>

namespace pharos {

/// A point on the lens, the first vertex of every path from the sensor.
struct LensPoint {
  Point3 position;
  Vec3 normal;  ///< unit, along the view direction
};

/// The sensor's response to a direction from a lens point.
struct SensorResponse {
  Vec2 film;                ///< normalized film position in [0,1)^2, y downwards
  float direction_pdf = 0;  ///< density of directions for uniform film positions [1/sr]
};

/// A connection from a point to the lens, for paths that begin at a light.
struct SensorConnection {
  LensPoint lens;
  Vec3 direction;      ///< unit, from the point to the lens
  float distance = 0;  ///< [scene units]
  Vec2 film;           ///< normalized film position of the connection
  /// Density [1/m^2] of rays with uniform film positions, on a surface at the point that is
  /// perpendicular to the ray. It is the response of all pixels together to light from there.
  float pdf = 0;

  /// The response to the direction from the lens to the point.
  SensorResponse response() const { return {film, pdf * square(distance)}; }
};

/// A sensor prepared for a film of a given size. Constant and thread-safe. Film positions are
/// normalized to [0,1)^2 with the origin at the top left. The measurement of a pixel is the mean of
/// radiance over its film positions and over the lens, so a ray with uniform film and lens
/// positions has weight 1.
class PreparedSensor {
 public:
  virtual ~PreparedSensor() = default;

  /// Returns a point that is uniform on the lens.
  virtual LensPoint sample_lens(Vec2 u) const = 0;
  /// Returns the ray from `lens` through a film position. Paths start at the ray's origin, which is
  /// the position of `lens` unless Sensor::sees_one_direction() is true.
  virtual Ray ray(const LensPoint& lens, Vec2 film) const = 0;
  /// Returns the film position of a direction from `lens`. Returns nothing if the direction misses
  /// the film, and always for sensors that see one direction.
  virtual std::optional<SensorResponse> response(const LensPoint& lens, Vec3 direction) const = 0;

  /// Connects a point with a uniform point on the lens. Returns nothing if the connection misses
  /// the film. Occlusion is left to the caller. The default implementation uses response().
  virtual std::optional<SensorConnection> connect(Point3 from, Vec2 u_lens) const;
};

/// Contract: a camera.
class Sensor : public Component {
 public:
  static constexpr std::string_view contract_name = "sensor";

  /// Prepares the sensor for a film of `width` x `height` pixels, both > 0.
  virtual std::unique_ptr<const PreparedSensor> prepare(int width, int height) const = 0;
  /// Whether all rays are parallel. Film positions then choose the origin of a ray instead of its
  /// direction, and there is no density over directions that a guide could be mixed with.
  virtual bool sees_one_direction() const { return false; }
  /// A point on the lens. It is part of the scene's bounds.
  virtual Point3 position() const = 0;
};

}  // namespace pharos
