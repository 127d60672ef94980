#include "transforms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "values.h"

namespace pharos::mitsuba {
namespace {

Transform read_rotation(const Element& element) {
  element.expect({"angle"}, {"x", "y", "z", "value"});
  const Vec3 axis = read_coordinates(element, 0);
  const float angle = read_float(element, "angle");
  return Transform::rotate(axis, angle);
}

/// Reads 16 numbers by rows, or the 9 numbers of the linear part.
Transform read_matrix(const Element& element) {
  element.expect({"value"});
  const std::vector<float> all = read_floats(element, "value");
  if (all.size() != 16 && all.size() != 9) {
    element.fail("value", fmt::format("expected 16 or 9 numbers, found {}", all.size()));
  }
  const std::size_t columns = all.size() == 16 ? 4 : 3;
  Transform::Matrix matrix{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      matrix[row][column] = all[row * columns + column];
    }
  }
  constexpr float rounding = 1e-5f;
  for (std::size_t i = 12; i < all.size(); ++i) {
    if (std::abs(all[i] - (i == 15 ? 1 : 0)) > rounding) {
      element.fail("value", "expected the last row 0 0 0 1: the map must be affine");
    }
  }
  return Transform(matrix);
}

/// Returns the default `up` direction of Mitsuba, a direction perpendicular to the unit vector `n`.
/// Each dialect has its own rule (2 and 3: Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
Vec3 perpendicular(Vec3 n, Dialect dialect) {
  if (dialect == Dialect::mitsuba_0) {
    const Vec3 t = std::abs(n.x) > std::abs(n.y) ? Vec3{n.z, 0, -n.x} : Vec3{0, n.z, -n.y};
    return cross(t, n);
  }
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  return {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

Transform read_look_at(const Element& element, Dialect dialect) {
  element.expect({"origin", "target"}, {"up"});
  const Vec3 origin = read_triple(element, "origin"), target = read_triple(element, "target");
  const Vec3 ahead = target - origin;
  const float distance = length(ahead);
  if (!(distance > 0)) element.fail("expected an origin and a target that differ");
  Vec3 up{0, 0, 0};
  if (element.has("up")) up = read_triple(element, "up");
  if (length_squared(up) == 0) up = perpendicular(ahead / distance, dialect);
  return Transform::look_at(origin, target, up);
}

Transform read_step(const Element& element, Dialect dialect) {
  element.expect_empty();
  const std::string_view tag = element.tag();
  if (tag == "translate") {
    element.expect({}, {"x", "y", "z", "value"});
    return Transform::translate(read_coordinates(element, 0));
  }
  if (tag == "scale") {
    element.expect({}, {"x", "y", "z", "value"});
    return Transform::scale(read_coordinates(element, 1));
  }
  if (tag == "rotate") return read_rotation(element);
  if (tag == "matrix") return read_matrix(element);
  if (tag == "lookat" || tag == "lookAt") return read_look_at(element, dialect);
  const std::vector<std::string> known(kTransformTags.begin(), kTransformTags.end());
  element.fail(
      fmt::format("<{}> is no step of a transform{}", one_line(tag, 60), suggestion(tag, known)));
}

/// Applies a step after `before`. Errors of Transform get the location of the step; so do maps
/// beyond the range of float.
Transform after(const Transform& before, const Element& element, Dialect dialect) {
  try {
    const Transform both = read_step(element, dialect) * before;
    for (const auto& row : both.matrix()) {
      if (std::any_of(row.begin(), row.end(), [](float m) { return !std::isfinite(m); })) {
        element.fail("expected a transform of finite numbers");
      }
    }
    return both;
  } catch (const InputError& e) {
    if (e.located()) throw;
    element.fail(e.what());
  }
}

}  // namespace

Transform read_transform(const Element& element, Variables& variables, Dialect dialect) {
  Transform all;
  for (const Element& step : element.children(variables)) all = after(all, step, dialect);
  return all;
}

Transform read_animation(const Element& element, Variables& variables, Dialect dialect) {
  std::optional<Transform> first;
  double earliest = 0;
  for (const Element& frame : element.children(variables)) {
    if (frame.tag() != "transform") {
      frame.fail("expected <transform time=\"…\"> in an <animation>");
    }
    frame.expect({"time"});
    const double time = read_number(frame, "time");
    const Transform transform = read_transform(frame, variables, dialect);
    if (first && time >= earliest) continue;
    first = transform;
    earliest = time;
  }
  if (!first) element.fail("expected <transform time=\"…\"> in an <animation>");
  return *first;
}

}  // namespace pharos::mitsuba
