#include <cmath>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/scene/reach.h>

namespace pharos {

void check_reach(Point3 point, const char* what) {
  const bool is_near = std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest &&
                       std::abs(point.z) <= kFarthest;
  if (is_near) return;
  throw InputError(
      fmt::format("{} reaches ({:.3g}, {:.3g}, {:.3g}): expected coordinates of at "
                  "most {:.0e} scene units",
                  what, point.x, point.y, point.z, kFarthest));
}

void check_reach(const Bounds3& box, const char* what) {
  if (box.empty()) return;
  check_reach(box.low, what);
  check_reach(box.high, what);
}

}  // namespace pharos
