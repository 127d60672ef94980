// scale: the product of two textures, channel by channel. A number or a color as `factor` tints or
// dims a texture; an image as `factor` darkens it in places.
//
// Its maximum is the product of both maxima. This is an upper bound, which is reached if both
// textures have their maximum of a channel at the same place. Its average is exact if one of the
// two is constant. Otherwise it includes their covariance over the unit square of texture
// coordinates, estimated from 64 x 64 points.
//
//     { type: scale, texture: { type: bitmap, file: wood.png }, factor: [1, 0.8, 0.6] }
#include "scale.h"

#include "covariance.h"

namespace pharos {

void ScaleTexture::Settings::describe(Schema<Settings>& s) {
  s.field("texture", &Settings::texture, "Texture that is scaled").required();
  s.field("factor", &Settings::factor, "Number, color or texture that multiplies it")
      .otherwise("1");
  s.example("{ texture: { type: checkerboard }, factor: [0.5, 2, 1] }");
  s.example("{ texture: { type: checkerboard }, factor: { type: grid, line_width: 0.2 } }");
}

ScaleTexture::ScaleTexture(Settings settings) : settings_(std::move(settings)) {
  if (!is_finite(maximum())) {
    throw InputError("scale: the product is beyond what a float can hold");
  }
  const Texture &a = *settings_.texture, &b = *settings_.factor;
  const Rgb product = a.average() * b.average() + texture_covariance(a, b);
  for (int i = 0; i < 3; ++i) average_[i] = std::max(0.0f, product[i]);
}

}  // namespace pharos
