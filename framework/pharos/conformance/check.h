#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/conformance/report.h>
#include <pharos/core/rgb.h>

namespace pharos::conformance {

/// Collects the findings of one check over all its configurations: faults that need no statistics,
/// and p-values. Messages are only composed when they are needed.
class Check {
 public:
  explicit Check(std::string_view name) : name_(name) {}

  /// Records a condition that must always hold. `what()` describes the fault.
  template <class What>
  void expect(bool holds, What&& what) {
    ++asked_;
    if (!holds && faults_++ == 0) fault_ = what();
  }
  /// Records a condition that must hold for all but one draw in 200. The exceptions are draws on an
  /// edge, where rounding decides.
  template <class What>
  void expect_mostly(bool holds, What&& what) {
    ++draws_;
    if (!holds && exceptions_++ == 0) exception_ = what();
  }
  /// Adds the p-value of one configuration.
  void add_p_value(double p, const std::string& where);
  /// States why there is nothing to check. The reason counts only if nothing was checked. A check
  /// that asked nothing and has no such reason fails.
  void not_applicable(std::string reason) { reason_ = std::move(reason); }

  /// Returns the finding, without plugin and case. Its p-value is the smallest one of all
  /// configurations times their number (Bonferroni).
  Finding finding() const;

 private:
  std::string name_, fault_, exception_, worst_, reason_;
  std::size_t asked_ = 0, faults_ = 0, draws_ = 0, exceptions_ = 0, tests_ = 0;
  double smallest_p_ = 1;
};

/// The checks of one case, in the order in which they were first requested.
class Suite {
 public:
  explicit Suite(std::uint64_t seed) : seed_(seed) {}

  /// Adds the check of this name. The reference stays valid.
  Check& check(std::string_view name) {
    checks_.emplace_back(name);
    return checks_.back();
  }
  /// The key of all random numbers of the suite.
  std::uint64_t seed() const { return seed_; }
  std::vector<Finding> findings() const;

 private:
  std::uint64_t seed_;
  std::deque<Check> checks_;
};

/// Whether two values agree within a tolerance relative to the larger one.
inline bool close(double a, double b, double relative, double absolute = 0) {
  if (a == b) return true;  // also if both are infinite
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b)) + absolute;
}
/// Whether two colors agree within a tolerance relative to their largest channel.
inline bool close(Rgb a, Rgb b, double relative, double absolute = 0) {
  const double scale = std::max(max_component(a), max_component(b));
  for (int c = 0; c < 3; ++c) {
    if (!(a[c] == b[c]) && !(std::abs(double{a[c]} - b[c]) <= relative * scale + absolute)) {
      return false;
    }
  }
  return true;
}
inline bool is_non_negative(Rgb c) {
  return is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0;
}
/// Whether a value is finite and at least zero.
inline bool is_non_negative(float v) {
  return std::isfinite(v) && v >= 0;
}

}  // namespace pharos::conformance
