#include <pharos/scene/sensor.h>

namespace pharos {

std::optional<SensorConnection> PreparedSensor::connect(Point3 from, Vec2 u_lens) const {
  SensorConnection connection{.lens = sample_lens(u_lens)};
  const Vec3 way = connection.lens.position - from;
  connection.distance = length(way);
  if (!(connection.distance > 0)) return std::nullopt;
  connection.direction = way / connection.distance;
  const std::optional<SensorResponse> seen = response(connection.lens, -connection.direction);
  if (!seen) return std::nullopt;
  connection.film = seen->film;
  connection.pdf = seen->direction_pdf / square(connection.distance);
  if (!std::isfinite(connection.pdf)) return std::nullopt;
  return connection;
}

}  // namespace pharos
