#pragma once

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>

namespace pharos {

/// Saves or loads a rectangle of pixels. Throws InputError if the loaded one is damaged: if a
/// corner has a negative coordinate, or if it ends before it begins.
inline void archive_rect(Archive& archive, PixelRect& rect) {
  archive(rect.x0, rect.y0, rect.x1, rect.y1);
  archive.expect(0 <= rect.x0 && rect.x0 <= rect.x1 && 0 <= rect.y0 && rect.y0 <= rect.y1,
                 "a rectangle of pixels");
}

}  // namespace pharos
