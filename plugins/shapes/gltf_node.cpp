#include "gltf_node.h"

#include <array>
#include <cmath>

#include <fmt/core.h>

namespace pharos {
namespace {

template <std::size_t n>
std::array<double, n> numbers(const GltfValue& node, const char* key,
                              const std::array<double, n>& otherwise) {
  if (!node.has(key)) return otherwise;
  const GltfValue list = node.member(key);
  if (list.size() != n) list.fail(fmt::format("has {} numbers instead of {}", list.size(), n));
  std::array<double, n> values;
  for (std::size_t i = 0; i < n; ++i) values[i] = list.item(i).number();
  return values;
}

NodeTransform matrix_of(const GltfValue& node) {
  const std::array<double, 16> m = numbers<16>(node, "matrix", {});  // column by column
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

/// Returns the rotation by a quaternion (x, y, z, w) of any length except zero.
NodeTransform rotation_of(const GltfValue& node) {
  auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
  const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
  if (!(length > 0 && std::isfinite(length))) node.fail("has a rotation about nothing");
  x /= length, y /= length, z /= length, w /= length;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
          {}};
}

}  // namespace

NodeTransform node_transform(const GltfValue& node) {
  constexpr const char* instancing = "EXT_mesh_gpu_instancing";
  if (node.has("extensions") && node.member("extensions").has(instancing)) {
    node.fail(fmt::format("is placed by {}, which is not read", instancing));
  }
  if (node.has("matrix")) return matrix_of(node);
  const auto [sx, sy, sz] = numbers<3>(node, "scale", {1, 1, 1});
  const auto [tx, ty, tz] = numbers<3>(node, "translation", {0, 0, 0});
  const NodeTransform translation({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {tx, ty, tz});
  const NodeTransform scale({sx, 0, 0}, {0, sy, 0}, {0, 0, sz}, {});
  return translation * (rotation_of(node) * scale);
}

}  // namespace pharos
