// catmull_rom: the interpolating cubic of Catmull and Rom 1974 ("A Class of Local Interpolating
// Splines"), the member B = 0, C = 1/2 of `mitchell`'s family. It is 1 at the pixel's center and 0
// at every other one (with the radius of 2), and reproduces quadratic polynomials: edges stay
// sharper than with B = C = 1/3, and ring more.
//
//     { type: catmull_rom }
#include "catmull_rom.h"

namespace pharos {

void CatmullRomFilter::Settings::describe(Schema<Settings>& s) {
  s.field("radius", &Settings::radius, "Half-width").unit("pixels").at_least(0.5).at_most(16);
  s.example("{ radius: 1.5 }");
}

}  // namespace pharos
