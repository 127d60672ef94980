#include <algorithm>

#include <fmt/format.h>

#include <pharos/conformance/check.h>

namespace pharos::conformance {

void Check::add_p_value(double p, const std::string& where) {
  ++tests_;
  // A p-value that is NaN means that the statistic is NaN, which is a fault.
  expect(!std::isnan(p), [&] { return where + ": no statistic"; });
  if (p < smallest_p_ || tests_ == 1) {
    smallest_p_ = p;
    worst_ = where;
  }
}

Finding Check::finding() const {
  Finding f;
  f.check = name_;
  const bool often = static_cast<double>(exceptions_) > 0.005 * static_cast<double>(draws_);
  if (tests_ > 0) {
    f.p_value = std::min(1.0, smallest_p_ * static_cast<double>(tests_));
    f.detail = worst_;
  } else if (asked_ == 0 && draws_ == 0) {
    f.verdict = reason_.empty() ? Verdict::failed : Verdict::not_applicable;
    f.detail = reason_.empty() ? "nothing was asked" : reason_;
  }
  if (faults_ > 0 || often) {
    f.verdict = Verdict::failed;
    f.detail =
        faults_ > 0 ? fault_ : fmt::format("{} ({} of {} draws)", exception_, exceptions_, draws_);
    if (faults_ > 1) f.detail += fmt::format(" (and {} more)", faults_ - 1);
  }
  return f;
}

std::vector<Finding> Suite::findings() const {
  std::vector<Finding> all;
  for (const Check& check : checks_) all.push_back(check.finding());
  return all;
}

}  // namespace pharos::conformance
