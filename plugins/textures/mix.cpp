// mix: two textures, blended channel by channel: (1 - weight) first + weight second. With a
// `checkerboard` of 0 and 1 as the weight, its squares show the two textures. With `first: 1` and
// `second: 0`, the weight is inverted.
//
// Its maximum is the larger one of both maxima. Its average is exact if the weight is constant or
// if both textures are. Otherwise it includes covariances that are estimated from 64 x 64 points.
//
//     { type: mix, first: { type: bitmap, file: wood.png }, second: 0.8,
//       weight: { type: checkerboard, color0: 0, color1: 1 } }
#include "mix.h"

#include "covariance.h"

namespace pharos {
namespace {

bool is_at_most_one(Rgb c) {
  return c.r <= 1 && c.g <= 1 && c.b <= 1;
}

}  // namespace

void MixTexture::Settings::describe(Schema<Settings>& s) {
  s.field("first", &Settings::first, "Texture where the weight is 0").required();
  s.field("second", &Settings::second, "Texture where the weight is 1").required();
  s.field("weight", &Settings::weight, "Share of the second texture; at most 1").otherwise("0.5");
  s.example("{ first: { type: checkerboard }, second: [0.5, 2, 1], weight: 0.25 }");
  s.example(
      "{ first: 0.2, second: { type: grid, line_width: 0.2 }, weight: { type: checkerboard, "
      "color0: 0, color1: 1 } }");
}

MixTexture::MixTexture(Settings settings) : settings_(std::move(settings)) {
  if (!is_at_most_one(settings_.weight->maximum()))
    throw InputError("mix: 'weight' must be at most 1");
  const Texture &a = *settings_.first, &b = *settings_.second, &w = *settings_.weight;
  const Rgb weight = w.average();
  const Rgb mean = (Rgb(1) - weight) * a.average() + weight * b.average() +
                   texture_covariance(w, b) - texture_covariance(w, a);
  for (int i = 0; i < 3; ++i) average_[i] = std::max(0.0f, mean[i]);
}

Rgb MixTexture::value_at(const SurfacePoint& point) const {
  const Rgb weight = settings_.weight->evaluate(point);
  return (Rgb(1) - weight) * settings_.first->evaluate(point) +
         weight * settings_.second->evaluate(point);
}

Rgb MixTexture::maximum() const {
  const Rgb a = settings_.first->maximum(), b = settings_.second->maximum();
  return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}

}  // namespace pharos
