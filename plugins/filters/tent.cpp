// tent: t(x) t(y) with t(x) = 1 - |x| / r, zero from the radius r on. With the default radius the
// weights are those of linear interpolation, and the weights of the pixels around any sample add up
// to one.
//
//     { type: tent, radius: 1 }
#include "tent.h"

namespace pharos {

void TentFilter::Settings::describe(Schema<Settings>& s) {
  s.field("radius", &Settings::radius, "Half-width").unit("pixels").at_least(0.5).at_most(16);
  s.example("{ radius: 0.5 }");
  s.example("{ radius: 2.25 }");
}

}  // namespace pharos
