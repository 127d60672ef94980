#pragma once

#include <concepts>
#include <span>
#include <string_view>
#include <utility>

#include <pharos/config/component.h>

namespace pharos::laboratory {

/// A point or vector of the plane. Primary numbers lie in [0, 1)^2. The type is double, so that
/// shifted points keep every bit of points and shift.
struct PlanePoint {
  double x = 0, y = 0;
};

/// Contract of the laboratory: a function on the unit square with an integral that is known in
/// closed form.
class Integrand : public Component {
 public:
  static constexpr std::string_view contract_name = "integrand";

  /// Returns the value at a point of [0, 1)^2.
  virtual double value(PlanePoint p) const = 0;
  /// Returns the sum of the values at all points, added in their order.
  virtual double sum(std::span<const PlanePoint> points) const = 0;
  /// Returns the exact integral over the unit square, which is the mean of the values.
  virtual double mean() const = 0;
};

/// A plane function: a value type with `Settings`, a constructor from them (which throws InputError
/// if they describe no useful integrand), its value and its exact mean.
template <class F>
concept PlaneFunction = std::constructible_from<F, const typename F::Settings&> &&
    requires(const F& f, PlanePoint p) {
  { f(p) } -> std::same_as<double>;
  { f.mean() } -> std::same_as<double>;
};

/// Implements Integrand by a plane function; sums are inlined.
template <PlaneFunction F>
class IntegrandOf final : public Integrand {
 public:
  using Settings = typename F::Settings;
  explicit IntegrandOf(const Settings& settings) : function_(settings) {}

  double value(PlanePoint p) const override { return function_(p); }
  double sum(std::span<const PlanePoint> points) const override {
    double total = 0;
    for (const PlanePoint p : points) total += function_(p);
    return total;
  }
  double mean() const override { return function_.mean(); }

 private:
  F function_;
};

}  // namespace pharos::laboratory
