#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// An affine map of texture coordinates: (u, v) to (a u + b v + c, d u + e v + f).
struct UvMap {
  double a = 1, b = 0, c = 0, d = 0, e = 1, f = 0;

  /// `outer * inner` applies inner first.
  friend UvMap operator*(const UvMap& outer, const UvMap& inner);
  bool only_scales() const { return b == 0 && c == 0 && d == 0 && f == 0; }
};

/// What a texture of Mitsuba does to the coordinates before it looks anything up: `to_uv`, or
/// `uscale`, `vscale`, `uvscale`, `uoffset` and `voffset`.
UvMap read_uv_map(Part& part);

/// Where a texture has its origin.
enum class UvOrigin {
  as_here,   ///< patterns, computed from the coordinates
  top_left,  ///< images, whose first row Mitsuba shows at v = 0 and Pharos at v = 1
};

/// Places the texture `node` of Pharos as Mitsuba does after `stated`, on shapes of the part's
/// UvSense: by `uv_scale`, or by a `uv_map` around it where that is not enough. Whole numbers may
/// be left out of offsets where the texture `repeats`.
ConfigNode placed(const Part& part, ConfigNode node, const UvMap& stated, UvOrigin origin,
                  bool repeats);

}  // namespace pharos::mitsuba
