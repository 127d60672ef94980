#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pharos/guiding/pipeline/held_out_gain.h>

namespace pharos {

namespace {

/// Returns log(p / p') of a step of density p, where p' is its density if the share of technique
/// `i` went to all others in proportion. The unguided density must be positive.
double loss_without(std::span<const Technique> techniques, std::size_t i, double p) {
  double others = 0, share = 0;
  for (std::size_t k = 0; k < techniques.size(); ++k) {
    if (k == i) continue;
    others += double{techniques[k].share} * techniques[k].density;
    share += techniques[k].share;
  }
  return std::log(p * share / others);
}

}  // namespace

void HeldOutGain::absorb(const PathLog& log) {
  double weights = 0, logs = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    if (path.transport != Transport::radiance) continue;
    estimate_incident_radiance(path, incident_);
    bool found_light = false;
    for (std::size_t k = 0; k < path.vertices.size(); ++k) {
      const RecordedVertex& vertex = path.vertices[k];
      const auto techniques = path.techniques(vertex);
      const double weight = mean(vertex.throughput * vertex.local_weight * incident_[k]);
      if (!vertex.guidable || techniques.empty() || !(weight > 0)) continue;
      const double log_ratio =
          std::log(double{vertex.pdf}) - std::log(double{techniques[0].density});
      if (!std::isfinite(log_ratio) || !std::isfinite(weight)) continue;
      found_light = true;
      weights += weight;
      logs += weight * log_ratio;
      parts_.resize(std::max(parts_.size(), techniques.size() - 1));
      for (std::size_t t = 1; t < techniques.size(); ++t) {
        if (!(techniques[t].share > 0)) continue;
        parts_[t - 1].nats += weight * loss_without(techniques, t, vertex.pdf);
        parts_[t - 1].is_known = true;
      }
    }
    if (found_light) ++sums_.found;
  }
  sums_.weight += weights;
  sums_.log += logs;
  sums_.weight_squared += weights * weights;
  sums_.log_squared += logs * logs;
  sums_.product += weights * logs;
  ++sums_.units;
}

/// Returns the ratio of the sums, and the variance of a ratio of two means over work units, to
/// first order.
HeldOutGain::Gain HeldOutGain::gain() const {
  const double ratio = sums_.log / sums_.weight;
  const double squares =
      sums_.log_squared - 2 * ratio * sums_.product + ratio * ratio * sums_.weight_squared;
  const auto units = static_cast<double>(sums_.units);
  return {ratio, units / (units - 1) * std::max(squares, 0.0) / (sums_.weight * sums_.weight)};
}

bool HeldOutGain::end_iteration() {
  if (!is_measured()) return false;
  before_ = std::exchange(last_, gain());
  has_before_ = std::exchange(has_last_, true);
  for (Part& part : parts_) part.nats /= sums_.weight;
  last_parts_ = std::exchange(parts_, {});
  sums_ = {};
  return true;
}

double HeldOutGain::possible_rise() const {
  if (!has_before_) return std::numeric_limits<double>::infinity();
  return rise() + std::sqrt(before_.variance + last_.variance);
}

bool HeldOutGain::may_be_below(double least) const {
  return !has_last_ || last_.mean - std::sqrt(last_.variance) < least;
}

}  // namespace pharos
