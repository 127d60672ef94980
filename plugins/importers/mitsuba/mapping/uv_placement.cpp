#include "uv_placement.h"

#include <cmath>

namespace pharos::mitsuba {
namespace {

constexpr UvMap kUpsideDown{.e = -1, .f = 1};

double without_whole_numbers(double offset) {
  return offset - std::floor(offset);
}

}  // namespace

UvMap operator*(const UvMap& o, const UvMap& i) {
  return {o.a * i.a + o.b * i.d, o.a * i.b + o.b * i.e, o.a * i.c + o.b * i.f + o.c,
          o.d * i.a + o.e * i.d, o.d * i.b + o.e * i.e, o.d * i.c + o.e * i.f + o.f};
}

UvMap read_uv_map(Part& part) {
  if (const std::optional<Transform> stated = part.transform("to_uv")) {
    const Transform::Matrix& m = stated->matrix();
    return {m[0][0], m[0][1], m[0][3], m[1][0], m[1][1], m[1][3]};
  }
  const double both = part.number("uvscale", 1);
  return {.a = part.number("uscale", both),
          .c = part.number("uoffset", 0),
          .e = part.number("vscale", both),
          .f = part.number("voffset", 0)};
}

ConfigNode placed(const Part& part, ConfigNode node, const UvMap& stated, UvOrigin origin,
                  bool repeats) {
  UvMap map = stated;
  if (part.sense() == UvSense::v_flipped) map = map * kUpsideDown;
  if (origin == UvOrigin::top_left) map = kUpsideDown * map;
  if (repeats) {
    map.c = without_whole_numbers(map.c);
    map.f = without_whole_numbers(map.f);
  }
  const auto list = [&](std::initializer_list<double> values) {
    ConfigNode numbers = ConfigNode::sequence(part.where());
    for (const double x : values) numbers.items().push_back(number_node(x, part.where()));
    return numbers;
  };
  if (map.only_scales()) {
    if (map.a != 1 || map.e != 1) node.set("uv_scale", list({map.a, map.e}), part.where());
    return node;
  }
  ConfigNode around = part.node("uv_map");
  around.set("texture", std::move(node), part.where());
  around.set("matrix", list({map.a, map.b, map.c, map.d, map.e, map.f}), part.where());
  return around;
}

}  // namespace pharos::mitsuba
