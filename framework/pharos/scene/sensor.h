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

/// How the sensor sees a direction from a lens point.
struct SensorResponse {
  Vec2 film;                ///< normalized film position in [0,1)^2, y downwards
  float direction_pdf = 0;  ///< density of directions when film positions are uniform [1/sr]
};

/// A way from a point to the lens, for paths that begin at a light.
struct SensorConnection {
  LensPoint lens;
  Vec3 direction;      ///< unit, from the point to the lens
  float distance = 0;  ///< [scene units]
  Vec2 film;           ///< normalized film position that it belongs to
  float pdf = 0;       ///< density of rays of uniform film positions across a surface at the point
                  ///< that faces them [1/m^2]: what the pixels together make of light from there

  /// Density of directions from the lens when film positions are uniform [1/sr].
  float direction_pdf() const { return pdf * square(distance); }
};

/// A sensor for a film of given size: constant, thread-safe. Film positions are normalized to
/// [0,1)^2 with the origin at the top left. The measurement of a pixel is the mean of radiance
/// over its film positions and the lens, so a ray of uniform film and lens position has weight 1.
class PreparedSensor {
 public:
  virtual ~PreparedSensor() = default;

  /// Uniform on the lens.
  virtual LensPoint sample_lens(Vec2 u) const = 0;
  /// The ray from `lens` that belongs to a film position. Paths start at its origin, which is that
  /// of `lens` unless Sensor::sees_one_direction().
  virtual Ray ray(const LensPoint& lens, Vec2 film) const = 0;
  /// The film position that a direction from `lens` belongs to; empty off the film, and always for
  /// sensors that see one direction.
  virtual std::optional<SensorResponse> response(const LensPoint& lens, Vec3 direction) const = 0;

  /// The way from a point to a uniform point of the lens, if the film sees it there; what is in
  /// between is for the caller to find out. By default that of response().
  virtual std::optional<SensorConnection> connect(Point3 from, Vec2 u_lens) const;
};

/// Contract: a camera.
class Sensor : public Component {
 public:
  static constexpr std::string_view contract_name = "sensor";

  /// For a film of `width` x `height` pixels, both > 0.
  virtual std::unique_ptr<const PreparedSensor> prepare(int width, int height) const = 0;
  /// True when all rays are parallel: film positions then choose where a ray starts instead of
  /// where it goes, and there is no density over directions that a guide could mix with.
  virtual bool sees_one_direction() const { return false; }
  /// A point of the lens; part of the scene's bounds.
  virtual Point3 position() const = 0;
};

}  // namespace pharos
