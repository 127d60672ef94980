#include <pharos/config/module.h>

#include "bitmap.h"
#include "checkerboard.h"
#include "constant.h"
#include "grid.h"
#include "mix.h"
#include "scale.h"
#include "uv_map.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::ConstantTexture>("constant", "The same color everywhere");
  registry.add<pharos::Checkerboard>("checkerboard", "Squares of two colors");
  registry.add<pharos::GridTexture>("grid", "Lines on a ground of another color");
  registry.add<pharos::MixTexture>("mix", "Two textures, blended by a third");
  registry.add<pharos::ScaleTexture>("scale", "The product of two textures");
  registry.add<pharos::Bitmap>("bitmap", "An image file");
  registry.add<pharos::UvMapTexture>("uv_map", "A texture that is moved, rotated or stretched");
  registry.set_shorthand<pharos::Texture>("constant", "value");
}
