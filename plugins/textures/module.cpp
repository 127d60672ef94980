#include <pharos/config/module.h>

#include "bitmap.h"
#include "checkerboard.h"
#include "constant.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::ConstantTexture>("constant", "The same colour everywhere");
  registry.add<pharos::Checkerboard>("checkerboard", "Two colours in squares");
  registry.add<pharos::Bitmap>("bitmap", "An image file");
  registry.set_shorthand<pharos::Texture>("constant", "value");
}
