#include "stroke_font.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include <pharos/core/error.h>

namespace pharos::focal::plane {
namespace {

/// Strokes as control points of two characters each: x as a digit and y as a letter, where 'd' is
/// the base line. Inner corners are rounded. A sharp corner consists of two strokes that end there.
const std::map<char, std::string_view>& strokes() {
  static const std::map<char, std::string_view> all{
      {' ', ""},
      {'(', "3n0l0c3a"},
      {')', "0n3l3c0a"},
      {'-', "0h4h"},
      {'0', "3n0n0d6d6n3n"},
      {'1', "0l3n 3n3d"},
      {'2', "0l0n6n6i0d 0d6d"},
      {'3', "0l0n6n6i2i 2i6i6d0d0f"},
      {'4', "4n0f 0f6f 4n4d"},
      {'5', "6n1n 1n0i 0i1k6k6d0d0f"},
      {'6', "5n1n0j0g 3j0j0d6d6j3j"},
      {'7', "0n6n 6n2d"},
      {'8', "3n1n1i5i5n3n 3i0i0d6d6i3i"},
      {'9', "3n0n0h6h6n3n 6k6h5d1d"},
      {'a', "3k0k0d6d6k3k 6k6d"},
      {'b', "0n0d 3k0k0d6d6k3k"},
      {'c', "6i6k0k0d6d6f"},
      {'d', "6n6d 3k0k0d6d6k3k"},
      {'e', "0h6h 6h6k0k0d6d6f"},
      {'f', "5n2n2k2h2d 0k5k"},
      {'g', "3k0k0d6d6k3k 6k6a0a0b"},
      {'h', "0n0d 0g0k6k6g6d"},
      {'i', "0k0d 0m0n"},
      {'l', "0n0d"},
      {'m', "0k0d 0g0k4k4g4d 4g4k8k8g8d"},
      {'n', "0k0d 0g0k6k6g6d"},
      {'o', "3k0k0d6d6k3k"},
      {'p', "0k0a 3k0k0d6d6k3k"},
      {'r', "0k0d 0g0k4k"},
      {'s', "5i5k0k0g5h5d0d0f"},
      {'t', "2n2h2d5d 0k5k"},
      {'u', "0k0d6d6k 6k6d"},
      {'v', "0k3d 3d6k"},
  };
  return all;
}

/// Applies one step of Chaikin's corner cutting (1974), which converges to a quadratic B-spline.
/// End points do not move.
std::vector<Point2> rounded(const std::vector<Point2>& corners) {
  if (corners.size() < 3) return corners;
  const auto between = [](Point2 a, Point2 b, double t) {
    return Point2{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  };
  std::vector<Point2> cut{corners.front()};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    // The first and last edges are cut at their midpoints, because the ends of the spline are
    // fixed.
    cut.push_back(between(corners[i - 1], corners[i], i == 1 ? 0.5 : 0.75));
    cut.push_back(between(corners[i], corners[i + 1], i + 2 == corners.size() ? 0.5 : 0.25));
  }
  cut.push_back(corners.back());
  return cut;
}

std::vector<Point2> stroke_of(std::string_view code) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i + 1 < code.size(); i += 2) {
    points.push_back({static_cast<double>(code[i] - '0'), static_cast<double>(code[i + 1] - 'd')});
  }
  for (int i = 0; i < 3; ++i) points = rounded(points);
  return points;
}

}  // namespace

Glyph glyph_of(char letter) {
  const auto found = strokes().find(letter);
  if (found == strokes().end()) {
    throw InputError(std::string("the font of the picture has no '") + letter + "'");
  }
  constexpr double kSpace = 4, kBetween = 3;
  Glyph glyph;
  double width = letter == ' ' ? kSpace : 0;
  for (std::string_view rest = found->second; !rest.empty();) {
    const std::size_t length = std::min(rest.find(' '), rest.size());
    glyph.strokes.push_back(stroke_of(rest.substr(0, length)));
    rest.remove_prefix(std::min(length + 1, rest.size()));
    for (const Point2& p : glyph.strokes.back()) width = std::max(width, p.x);
  }
  glyph.advance = width + kBetween;
  return glyph;
}

}  // namespace pharos::focal::plane
