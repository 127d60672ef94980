#pragma once

namespace pharos {

/// The mean of f(cosine) over the cosine-weighted hemisphere: the integral of 2 c f(c) dc over [0,
/// 1] [unit of f]. The error of the midpoint rule is about 1e-6 for Fresnel's equations, and about
/// 1e-4 if there is total reflection.
template <class F>
float hemisphere_mean(const F& f) {
  constexpr int kPoints = 1024;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double cosine = (i + 0.5) / kPoints;
    sum += 2 * cosine * double{f(static_cast<float>(cosine))};
  }
  return static_cast<float>(sum / kPoints);
}

}  // namespace pharos
