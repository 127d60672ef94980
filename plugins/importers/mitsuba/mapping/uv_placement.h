#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// An affine map of texture coordinates: (u, v) to (a u + b v + c, d u + e v + f).
struct UvMap {
  double a = 1, b = 0, c = 0, d = 0, e = 1, f = 0;

  /// `outer * inner` applies `inner` first.
  friend UvMap operator*(const UvMap& outer, const UvMap& inner);
  bool only_scales() const { return b == 0 && c == 0 && d == 0 && f == 0; }
};

/// Reads the map that a Mitsuba texture applies to the coordinates before a lookup: `to_uv`, or
/// `uscale`, `vscale`, `uvscale`, `uoffset` and `voffset`.
UvMap read_uv_map(Part& part);

/// The origin of a texture.
enum class UvOrigin {
  as_here,   ///< patterns, computed from the coordinates
  top_left,  ///< images, whose first row is at v = 0 in Mitsuba and at v = 1 in Pharos
};

/// Places the Pharos texture `node` in the same way as Mitsuba with the map `stated`, on shapes
/// with the part's UvSense. Uses `uv_scale`, or wraps the texture in a `uv_map` if `uv_scale` is
/// not sufficient. If the texture `repeats`, whole numbers may be dropped from the offsets.
ConfigNode placed(const Part& part, ConfigNode node, const UvMap& stated, UvOrigin origin,
                  bool repeats);

}  // namespace pharos::mitsuba
