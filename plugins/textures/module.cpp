#include <pharos/config/module.h>

#include "bitmap.h"
#include "checkerboard.h"
#include "constant.h"
#include "grid.h"
#include "scale.h"
#include "uv_map.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::ConstantTexture>("constant", "The same color everywhere");
  registry.add<pharos::Checkerboard>("checkerboard", "Two colors in squares");
  registry.add<pharos::GridTexture>("grid", "Lines on a ground");
  registry.add<pharos::ScaleTexture>("scale", "The product of two textures");
  registry.add<pharos::Bitmap>("bitmap", "An image file");
  registry.add<pharos::UvMapTexture>("uv_map", "A texture moved, turned or stretched");
  registry.set_shorthand<pharos::Texture>("constant", "value");
}
