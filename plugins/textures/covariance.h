#pragma once

#include <pharos/scene/texture.h>

namespace pharos {

/// The covariance of two textures over the unit square of texture coordinates, channel by channel,
/// estimated from 64 x 64 points; exactly 0 if either texture is constant.
Rgb texture_covariance(const Texture& a, const Texture& b);

}  // namespace pharos
