#include <algorithm>
#include <cmath>
#include <utility>

#include <pharos/guiding/pipeline/held_out_gain.h>

namespace pharos {

void HeldOutGain::absorb(const PathLog& log) {
  double weights = 0, logs = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    if (path.transport != Transport::radiance) continue;
    estimate_incident_radiance(path, incident_);
    for (std::size_t k = 0; k < path.vertices.size(); ++k) {
      const RecordedVertex& vertex = path.vertices[k];
      const auto techniques = path.techniques(vertex);
      const double weight = mean(vertex.throughput * vertex.local_weight * incident_[k]);
      if (!vertex.guidable || techniques.empty() || !(weight > 0)) continue;
      const double log_ratio =
          std::log(double{vertex.pdf}) - std::log(double{techniques[0].density});
      if (!std::isfinite(log_ratio) || !std::isfinite(weight)) continue;
      weights += weight;
      logs += weight * log_ratio;
    }
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
  if (!is_measured()) return {};
  const double ratio = sums_.log / sums_.weight;
  const double squares =
      sums_.log_squared - 2 * ratio * sums_.product + ratio * ratio * sums_.weight_squared;
  const auto units = static_cast<double>(sums_.units);
  return {ratio, units / (units - 1) * std::max(squares, 0.0) / (sums_.weight * sums_.weight)};
}

bool HeldOutGain::end_iteration(double tolerance) {
  before_ = std::exchange(last_, gain());
  has_before_ = std::exchange(has_last_, is_measured());
  sums_ = {};
  const double error_of_change = std::sqrt(before_.variance + last_.variance);
  return has_before_ && has_last_ &&
         std::abs(last_.mean - before_.mean) + 2 * error_of_change < tolerance;
}

bool HeldOutGain::may_be_below(double least) const {
  return has_last_ && last_.mean - std::sqrt(last_.variance) < least;
}

}  // namespace pharos
