#include "finds.h"

#include <algorithm>
#include <cmath>

namespace pharos {

void Finds::add(double u, double weight) {
  ++steps_;
  // Bins have equal widths in asin sqrt u. They are thus narrow near 0 and 1, where a share near 0
  // or 1 makes 1 / q steep.
  const double place = std::asin(std::sqrt(u)) * (2 / M_PI) * static_cast<double>(bins_.size());
  Bin& bin = bins_[std::min(static_cast<std::size_t>(place), bins_.size() - 1)];
  bin.weight += weight;
  bin.moment += weight * u;
}

std::vector<Finds::Term> Finds::terms(double drawn_with) const {
  double total = 0;
  for (const Bin& bin : bins_) total += bin.weight;
  std::vector<Term> all;
  for (const Bin& bin : bins_) {
    if (bin.weight == 0) continue;
    const double u = bin.moment / bin.weight;
    const double unguided = u / drawn_with, guided = (1 - u) / (1 - drawn_with);
    all.push_back({bin.weight / total, guided, unguided - guided});
  }
  return all;
}

void Finds::archive(Archive& archive) {
  const std::size_t count = bins_.size();
  archive(steps_, bins_);
  bool is_sound = bins_.size() == count;
  for (const Bin& bin : bins_) is_sound &= bin.moment >= 0 && bin.moment <= bin.weight;
  archive.expect(is_sound, "what was learned of mixing");
}

double objective_slope(const std::vector<Finds::Term>& terms, double a, MixingObjective objective) {
  double sum = 0;
  for (const Finds::Term& term : terms) {
    const double q = term.guided + a * term.excess;
    sum -= term.weight * term.excess / (objective == MixingObjective::kl ? q : q * q);
  }
  return sum;
}

}  // namespace pharos
