#include "von_mises.h"

#include <cmath>
#include <numeric>

#include <pharos/statistics/adam.h>

namespace pharos::aligned {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

}  // namespace

DirectionDistribution::DirectionDistribution(const DirectionHistogram& histogram, int axis_width,
                                             double floor) {
  for (int k = 0; k < kDirections; ++k) {
    if (degrees_from_axis(k) > axis_width) total_ += histogram[static_cast<std::size_t>(k)];
  }
  if (total_ == 0) return;
  of_whole_ = total_ / std::accumulate(histogram.begin(), histogram.end(), 0.0);
  for (int k = 0; k < kDirections; ++k) {
    if (degrees_from_axis(k) <= axis_width) continue;
    const double share = histogram[static_cast<std::size_t>(k)] / total_;
    shares_[static_cast<std::size_t>(k)] = share;
    bins_.push_back({static_cast<double>(k), std::log(std::max(share, floor / kDirections))});
  }
}

double DirectionDistribution::mass(int direction, int width) const {
  double sum = 0;
  for (int k = direction - width; k <= direction + width; ++k) sum += share(as_direction(k));
  return of_whole_ * sum;
}

struct DirectionDistribution::Terms {
  std::vector<double> q, log_ratio;
};

DirectionDistribution::Terms DirectionDistribution::terms(const VonMises& q) const {
  Terms t;
  double sum = 0;
  for (const Bin& bin : bins_) {
    const double exponent = q.kappa * (std::cos(2 * kRadians * (bin.degrees - q.mean)) - 1);
    t.q.push_back(std::exp(exponent));
    t.log_ratio.push_back(exponent - bin.log_share);
    sum += t.q.back();
  }
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    t.q[i] /= sum;
    t.log_ratio[i] -= std::log(sum);
  }
  return t;
}

double DirectionDistribution::divergence(const VonMises& q) const {
  const Terms t = terms(q);
  double sum = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) sum += t.q[i] * t.log_ratio[i];
  return sum;
}

DirectionDistribution::Gradient DirectionDistribution::gradient(const VonMises& q) const {
  // The expected derivative of log q is zero. Only its product with log(q / p) remains, and terms
  // that are equal for all bins may be left out.
  const Terms t = terms(q);
  double mean_cos = 0, mean_sin = 0;
  std::vector<double> cosines, sines;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const double angle = 2 * kRadians * (bins_[i].degrees - q.mean);
    cosines.push_back(std::cos(angle));
    sines.push_back(std::sin(angle));
    mean_cos += t.q[i] * cosines[i];
    mean_sin += t.q[i] * sines[i];
  }
  Gradient gradient;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    gradient.kappa += t.q[i] * (cosines[i] - mean_cos) * t.log_ratio[i];
    gradient.mean += t.q[i] * (sines[i] - mean_sin) * t.log_ratio[i];
  }
  gradient.mean *= 2 * kRadians * q.kappa;
  return gradient;
}

int best_mean(const DirectionDistribution& p, double kappa, int start, int window) {
  int best = start;
  double least = INFINITY;
  for (int k = start - window; k <= start + window; ++k) {
    const double divergence = p.divergence({static_cast<double>(as_direction(k)), kappa});
    if (divergence >= least) continue;
    least = divergence;
    best = as_direction(k);
  }
  return best;
}

VonMises descend(const DirectionDistribution& p, VonMises start, const DescentSettings& settings) {
  statistics::Adam mean_descent, kappa_descent;
  double mean = start.mean, log_kappa = std::log(start.kappa);
  for (int i = 0; i < settings.steps; ++i) {
    // Steps that shrink to zero end at the minimum itself.
    const double left = 1 - static_cast<double>(i) / settings.steps;
    const double kappa = std::exp(log_kappa);
    const auto gradient = p.gradient({mean, kappa});
    mean += mean_descent.step(gradient.mean, {.learning_rate = left * settings.mean_step});
    log_kappa +=
        kappa_descent.step(kappa * gradient.kappa, {.learning_rate = left * settings.kappa_step});
  }
  mean -= kDirections * std::floor(mean / kDirections);
  return {mean, std::exp(log_kappa)};
}

}  // namespace pharos::aligned
