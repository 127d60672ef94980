// constant: the same color everywhere. Wherever a texture is expected, a bare number or a list of
// three numbers stands for this texture.
//
//     { type: constant, value: [0.2, 0.5, 0.8] }
#include "constant.h"

namespace pharos {

void ConstantTexture::Settings::describe(Schema<Settings>& s) {
  s.field("value", &Settings::value, "The color").at_least(0);
  s.example("{ value: [0.2, 0.5, 0.8] }");
}

}  // namespace pharos
