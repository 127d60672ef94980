#include "transforms.h"

#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>

namespace pharos::pbrt {
namespace {

float at(const Statement& s, std::size_t i) {
  return static_cast<float>(s.numbers[i]);
}

Vec3 triple(const Statement& s, std::size_t first) {
  return {at(s, first), at(s, first + 1), at(s, first + 2)};
}

/// Reads a matrix, which stands column by column.
Transform matrix(const Statement& s) {
  const bool is_affine = s.numbers[3] == 0 && s.numbers[7] == 0 && s.numbers[11] == 0;
  if (!is_affine || !(s.numbers[15] != 0)) {
    throw InputError(s.where,
                     "the last row of the matrix must be 0 0 0 1 (columns are written "
                     "one after the other)");
  }
  Transform::Matrix m;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      m[row][column] = static_cast<float>(s.numbers[4 * column + row] / s.numbers[15]);
    }
  }
  return Transform(m);
}

/// Maps the world to a camera at `from` that looks along +z, with +x on the right of the image.
Transform look_at(const Statement& s) {
  const Vec3 from = triple(s, 0), to = triple(s, 3), up = triple(s, 6);
  return inverse(Transform::look_at(from, to, up));
}

Transform step(const Statement& s) {
  if (s.word == "Translate") return Transform::translate(triple(s, 0));
  if (s.word == "Scale") return Transform::scale(triple(s, 0));
  if (s.word == "Rotate") return Transform::rotate(triple(s, 1), at(s, 0));
  if (s.word == "LookAt") return look_at(s);
  return matrix(s);
}

const Transform& space(const Statement& s, const std::map<std::string, Transform>& spaces) {
  const auto found = spaces.find(s.type());
  if (found != spaces.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, map] : spaces) known.push_back(name);
  throw InputError(s.where, fmt::format("there is no coordinate system '{}'{}",
                                        one_line(s.type(), 60), suggestion(s.type(), known)));
}

}  // namespace

bool is_transform(const Statement& statement) {
  static const std::set<std::string_view> words{
      "ConcatTransform", "CoordSysTransform", "Identity", "LookAt", "Rotate",
      "Scale",           "Transform",         "Translate"};
  return words.contains(statement.word);
}

Transform transformed(const Transform& now, const Statement& statement,
                      const std::map<std::string, Transform>& spaces) {
  if (statement.word == "Identity") return Transform();
  if (statement.word == "CoordSysTransform") return space(statement, spaces);
  try {
    const Transform change = step(statement);
    return statement.word == "Transform" ? change : now * change;
  } catch (const InputError& e) {
    if (e.located()) throw;
    throw InputError(statement.where, e.what());
  }
}

Transform inverse(const Transform& map) {
  Transform::Matrix m;
  const Vec3 columns[] = {map.inverse_vector({1, 0, 0}), map.inverse_vector({0, 1, 0}),
                          map.inverse_vector({0, 0, 1}), Vec3(map.inverse_point({0, 0, 0}))};
  for (std::size_t c = 0; c < 4; ++c) {
    m[0][c] = columns[c].x;
    m[1][c] = columns[c].y;
    m[2][c] = columns[c].z;
  }
  return Transform(m);
}

}  // namespace pharos::pbrt
