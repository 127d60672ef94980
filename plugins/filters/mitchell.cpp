// mitchell: k(x) k(y) with the piecewise cubic k of Mitchell and Netravali 1988 ("Reconstruction
// Filters in Computer Graphics", equation 8). With t = 2 |x| / r, where r is the radius,
//
//     6 k = (12 - 9 B - 6 C) t^3 + (-18 + 12 B + 6 C) t^2 + 6 - 2 B                    t < 1
//     6 k = (-B - 6 C) t^3 + (6 B + 30 C) t^2 + (-12 B - 48 C) t + 8 B + 24 C          1 <= t < 2
//
// The filter is continuously differentiable, and its integral is (r / 2)^2 for all B and C.
// B blurs, C rings. B + 2 C = 1 works best, and the authors recommend B = C = 1/3. B = 1, C = 0 is
// the cubic B-spline; B = 0, C = 1/2 is Catmull-Rom. If C > 0, weights are negative between about
// half the radius and the radius. This sharpens edges, but pixels next to bright ones may become
// negative. A sharp filter also amplifies the noise of pixels with few samples.
//
//     { type: mitchell, b: 0.3333, c: 0.3333, radius: 2 }
#include "mitchell.h"

namespace pharos {

void MitchellFilter::Settings::describe(Schema<Settings>& s) {
  s.field("b", &Settings::b, "Parameter B, which blurs").at_least(0).at_most(1);
  s.field("c", &Settings::c, "Parameter C, which rings").at_least(0).at_most(1);
  s.field("radius", &Settings::radius, "Half-width").unit("pixels").at_least(0.5).at_most(16);
  s.example("{ b: 1, c: 0 }");
  s.example("{ b: 0, c: 0.5, radius: 3 }");
}

MitchellFilter::MitchellFilter(const Settings& settings)
    : radius_(settings.radius),
      inner_{6 - 2 * settings.b, 0, -18 + 12 * settings.b + 6 * settings.c,
             12 - 9 * settings.b - 6 * settings.c},
      outer_{8 * settings.b + 24 * settings.c, -12 * settings.b - 48 * settings.c,
             6 * settings.b + 30 * settings.c, -settings.b - 6 * settings.c} {}

float MitchellFilter::integral() const {
  return square(radius_ / 2);
}

float MitchellFilter::profile(float x) const {
  const float t = 2 * std::abs(x) / radius_;
  if (!(t < 2)) return 0;
  const float* k = t < 1 ? inner_ : outer_;
  return (k[0] + t * (k[1] + t * (k[2] + t * k[3]))) / 6;
}

}  // namespace pharos
