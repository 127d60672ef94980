// box: equal weight for every sample within a square about the pixel's center. With the default
// radius each sample belongs to one pixel, and pixels are independent of each other.
//
//     { type: box, radius: 0.5 }
#include "box.h"

namespace pharos {

void BoxFilter::Settings::describe(Schema<Settings>& s) {
  s.field("radius", &Settings::radius, "Half-width").unit("pixels").at_least(0.5).at_most(16);
  s.example("{ radius: 1.75 }");
}

}  // namespace pharos
