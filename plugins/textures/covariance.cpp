#include "covariance.h"

namespace pharos {

Rgb texture_covariance(const Texture& a, const Texture& b) {
  constexpr int kSteps = 64;
  constexpr float kCell = 1.0f / kSteps, kShare = kCell * kCell;
  Rgb mean_a, mean_b, mean_product;  // of the differences to the averages
  for (int y = 0; y < kSteps; ++y) {
    for (int x = 0; x < kSteps; ++x) {
      SurfacePoint point;
      point.uv = kCell * Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
      const Rgb rest_a = a.evaluate(point) - a.average(), rest_b = b.evaluate(point) - b.average();
      mean_a += kShare * rest_a;
      mean_b += kShare * rest_b;
      mean_product += kShare * rest_a * rest_b;
    }
  }
  return mean_product - mean_a * mean_b;
}

}  // namespace pharos
