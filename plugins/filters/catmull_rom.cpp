// catmull_rom: the interpolating cubic of Catmull and Rom 1974 ("A Class of Local Interpolating
// Splines"), which is `mitchell` with B = 0 and C = 1/2. With the radius of 2 it is 1 at the
// pixel's center and 0 at every other pixel's center, and it reproduces quadratic polynomials.
// Edges stay sharper than with B = C = 1/3 and ring more.
//
//     { type: catmull_rom }
#include "catmull_rom.h"

namespace pharos {

void CatmullRomFilter::Settings::describe(Schema<Settings>& s) {
  s.field("radius", &Settings::radius, "Half-width").unit("pixels").at_least(0.5).at_most(16);
  s.example("{ radius: 1.5 }");
}

}  // namespace pharos
