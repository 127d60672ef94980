#include "lobe_changes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <pharos/core/frame.h>
#include <pharos/core/parallel.h>
#include <pharos/statistics/von_mises_fisher.h>

#include "lobe_simd.h"

namespace pharos::parallax_aware_mixtures {
namespace {

/// Returns the integral of v_a v_b / v, where v is `whole`. It is the integral of e^(kappa' cos
/// theta) times normalization factors, where kappa' is the length of
/// kappa_a mu_a + kappa_b mu_b - kappa mu.
double overlap(const Lobe& a, const Lobe& b, const Lobe& whole) {
  const double rest = (a.kappa * a.mean + b.kappa * b.mean - whole.kappa * whole.mean).norm();
  return std::exp(von_mises_fisher::log_norm(a.kappa) + von_mises_fisher::log_norm(b.kappa) -
                  von_mises_fisher::log_norm(whole.kappa) - von_mises_fisher::log_norm(rest));
}

Vec3 to_vec(const Direction& d) {
  return {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])};
}

/// Eight lobes, prepared for assess().
struct TestLobes8 {
  TestLobes8(const Mixture& mixture, std::size_t first) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Lobe lobe = first + i < mixture.size() ? mixture[first + i] : Lobe{};
      const Frame frame = Frame::from_normal(to_vec(lobe.mean));
      for (int axis = 0; axis < 3; ++axis) {
        mean[axis][i] = frame.n[axis];
        s[axis][i] = frame.s[axis];
        t[axis][i] = frame.t[axis];
      }
      slope[i] = static_cast<float>(-0.5 * lobe.kappa) * kLog2E;
      mode[i] = static_cast<float>(von_mises_fisher::mode_density(lobe.kappa));
      weight[i] = static_cast<float>(lobe.weight);
    }
  }
  Float8 density(Vec3 w) const { return mode * exp2(slope * squared_distance(mean, w)); }
  /// Returns the second moments xx, xy and yy across a lobe's mean as a matrix in world space.
  statistics::Matrix<3> to_world(std::size_t lane, const double (&moments)[3]) const {
    const Direction a(s[0][lane], s[1][lane], s[2][lane]), b(t[0][lane], t[1][lane], t[2][lane]);
    return moments[0] * a * a.transpose() + moments[1] * (a * b.transpose() + b * a.transpose()) +
           moments[2] * b * b.transpose();
  }

  Float8 mean[3], s[3], t[3];
  Float8 slope, mode, weight;
};

Float8 along(const Float8 (&axis)[3], Vec3 w) {
  return axis[0] * w.x + axis[1] * w.y + axis[2] * w.z;
}

struct Sums8 {
  Float8 divergence{}, weight{}, xx{}, xy{}, yy{}, inverse{}, certainty{};

  void add(const TestLobes8& lobes, const AimedSample& sample, const Float8& density,
           float divergence_factor, float over_total) {
    const Float8 share = lobes.weight * density;
    divergence += share * divergence_factor;
    const Float8 found = share * (sample.weight * over_total);
    const Float8 x = along(lobes.s, sample.direction), y = along(lobes.t, sample.direction);
    weight += found;
    xx += found * x * x;
    xy += found * x * y;
    yy += found * y * y;
    // Samples near the mean are the most reliable for the distance of the light.
    const Float8 certain = found * density;
    inverse += certain * sample.inverse_distance;
    certainty += certain;
  }
  void add_to(const TestLobes8& lobes, std::span<Assessment> all) const {
    for (std::size_t i = 0; i < std::min(kLanes, all.size()); ++i) {
      const double moments[] = {xx[i], xy[i], yy[i]};
      const Assessment part{.divergence_sum = divergence[i],
                            .weight = weight[i],
                            .spread = lobes.to_world(i, moments),
                            .inverse = inverse[i],
                            .certainty = certainty[i]};
      // Sums that overflow floats are dropped.
      const double sum =
          part.divergence_sum + part.weight + part.spread.sum() + part.inverse + part.certainty;
      if (std::isfinite(sum)) all[i] += part;
    }
  }
};

/// Constants that are the same for all samples.
struct Scale {
  float over_light;     ///< 1 / Phi
  float least_density;  ///< [1/sr]
};

void assess_part(std::span<const TestLobes8> lobes, std::span<const AimedSample> samples,
                 const Scale& scale, std::vector<Assessment>& result) {
  std::vector<Float8> densities(lobes.size());
  std::vector<Sums8> sums(lobes.size());
  for (const AimedSample& sample : samples) {
    Float8 total8{};
    for (std::size_t g = 0; g < lobes.size(); ++g) {
      densities[g] = lobes[g].density(sample.direction);
      total8 += lobes[g].weight * densities[g];
    }
    const float total = sum(total8), q = total + scale.least_density;
    const float step_weight = sample.weight / sample.steps;
    const float difference = step_weight * sample.pdf * scale.over_light / q - 1;
    const float factor = sample.steps * difference * difference / sample.pdf;
    const float over_total = total > 0 ? 1 / total : 0;
    for (std::size_t g = 0; g < lobes.size(); ++g) {
      sums[g].add(lobes[g], sample, densities[g], factor, over_total);
    }
  }
  for (std::size_t g = 0; g < lobes.size(); ++g) {
    sums[g].add_to(lobes[g], std::span(result).subspan(g * kLanes));
  }
}

}  // namespace

PlacedLobe PlacedLobe::seen_from(const Direction& step) const {
  PlacedLobe seen = *this;
  const Direction to = lobe.mean - inverse_distance * step;
  const double length = to.norm();
  if (!(length > 1e-6)) return seen;  // the new origin is the position of the light
  seen.lobe.mean = to / length;
  seen.inverse_distance = inverse_distance / length;
  return seen;
}

Lobe merged(const Lobe& a, const Lobe& b) {
  const double weight = a.weight + b.weight;
  const Direction resultant = (a.weight * von_mises_fisher::mean_cosine(a.kappa) * a.mean +
                               b.weight * von_mises_fisher::mean_cosine(b.kappa) * b.mean) /
                              weight;
  const double length = resultant.norm();
  return {weight, length > 0 ? Direction(resultant / length) : a.mean,
          von_mises_fisher::concentration(length)};
}

double merge_cost(const Lobe& i, const Lobe& j) {
  const Lobe whole = merged(i, j);
  const double sum = i.weight * i.weight * overlap(i, i, whole) +
                     2 * i.weight * j.weight * overlap(i, j, whole) +
                     j.weight * j.weight * overlap(j, j, whole);
  return sum / whole.weight - whole.weight;
}

std::array<Lobe, 2> halves(const Lobe& lobe, const Direction& axis, double most_kappa) {
  std::array<Lobe, 2> parts{lobe, lobe};
  const double stretch = std::sqrt(1 + axis.squaredNorm());
  const double cosine = von_mises_fisher::mean_cosine(lobe.kappa) * stretch;
  for (int side : {0, 1}) {
    Lobe& part = parts[static_cast<std::size_t>(side)];
    part.weight = lobe.weight / 2;
    part.mean = (lobe.mean + (side == 0 ? 1.0 : -1.0) * axis) / stretch;
    part.kappa = cosine < von_mises_fisher::mean_cosine(most_kappa)
                     ? von_mises_fisher::concentration(cosine)
                     : most_kappa;
  }
  return parts;
}

std::optional<Direction> Assessment::half_axis(const Direction& mean) const {
  if (!(weight > 0)) return std::nullopt;
  const statistics::Matrix<3> across = statistics::Matrix<3>::Identity() - mean * mean.transpose();
  const statistics::Matrix<3> covariance = across * spread * across / weight;
  const Eigen::SelfAdjointEigenSolver<statistics::Matrix<3>> solver(covariance);
  const double variance = solver.eigenvalues()[2];
  if (!(variance > 0)) return std::nullopt;
  const Direction axis = across * solver.eigenvectors().col(2);
  return Direction(0.5 * std::sqrt(variance) * axis);
}

Assessment& Assessment::operator+=(const Assessment& o) {
  samples += o.samples;
  divergence_sum += o.divergence_sum;
  weight += o.weight;
  spread += o.spread;
  inverse += o.inverse;
  certainty += o.certainty;
  return *this;
}

Assessment& Assessment::operator*=(double factor) {
  for (double* v : {&samples, &divergence_sum, &weight, &inverse, &certainty}) *v *= factor;
  spread *= factor;
  return *this;
}

std::vector<Assessment> assess(const Mixture& mixture, std::span<const AimedSample> samples,
                               float least_density) {
  double light = 0, count = 0;
  for (const AimedSample& s : samples) {
    light += s.weight;
    count += s.steps;
  }
  std::vector<Assessment> all(mixture.size(), {.samples = count});
  if (!(light > 0)) return all;
  const Scale scale{static_cast<float>(count / light), least_density};
  std::vector<TestLobes8> lobes;
  for (std::size_t k = 0; k < mixture.size(); k += kLanes) lobes.emplace_back(mixture, k);
  constexpr std::size_t kPart = 4096, kBlock = 256;
  std::vector<std::vector<Assessment>> parts((samples.size() + kPart - 1) / kPart,
                                             std::vector<Assessment>(mixture.size()));
  parallel_for(parts.size(), [&](std::size_t i) {
    const auto part = samples.subspan(i * kPart, std::min(kPart, samples.size() - i * kPart));
    for (std::size_t first = 0; first < part.size(); first += kBlock) {
      assess_part(lobes, part.subspan(first, std::min(kBlock, part.size() - first)), scale,
                  parts[i]);
    }
  });
  for (const std::vector<Assessment>& part : parts) {
    for (std::size_t k = 0; k < all.size(); ++k) all[k] += part[k];
  }
  return all;
}

}  // namespace pharos::parallax_aware_mixtures
