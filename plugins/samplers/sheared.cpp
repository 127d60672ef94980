// sheared: points that are stratified in lines of a given direction (Singh and Jarosz 2017,
// "Convergence Analysis for Anisotropic Monte Carlo Sampling Spectra"). The points of samplers such
// as pmj02 or multi_jittered fill narrow rows and columns evenly. They are therefore best for
// integrands that vary along one axis only, such as an edge along the other axis. A shear on the
// torus turns the rows or the columns into lines of the direction of an edge in the integrand. For
// directions within 45 degrees of the x axis it turns the rows: y moves by x times the slope. For
// other directions it turns the columns: x moves by y over the slope. The shear preserves area, so
// uniform points remain uniform. If the slope is a whole number, the border of the square breaks no
// line. The other axis keeps its stratification.
//
// Only the points of `purpose` are sheared, at every path vertex. All other numbers come unchanged
// from `base`.
//
//     { type: sheared, base: pmj02, direction: 45 }
#include "sheared.h"

#include <cmath>

#include <pharos/config/registry.h>

#include "unit_steps.h"

namespace pharos {
namespace {

class PreparedSheared final : public PreparedSampler {
 public:
  PreparedSheared(std::unique_ptr<const PreparedSampler> base, double direction, Purpose purpose)
      : base_(std::move(base)), purpose_(purpose) {
    const double angle = direction * 3.14159265358979323846 / 180;
    is_flat_ = std::abs(std::cos(angle)) >= std::abs(std::sin(angle));
    const double slope = is_flat_ ? std::tan(angle) : std::cos(angle) / std::sin(angle);
    slope_ = std::llround(slope * 0x1p32);
  }

  std::uint64_t begin(const PathKey& key) const override { return base_->begin(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return base_->value_1d(stream, dimension);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Vec2 u = base_->value_2d(stream, dimension);
    if (dimension.purpose() != purpose_) return u;
    if (is_flat_) return {u.x, moved(u.y, u.x)};
    return {moved(u.x, u.y), u.y};
  }
  std::span<const FilmSample> film_samples() const override { return base_->film_samples(); }

 private:
  /// Moves `u` by `by` times the slope. Only the distance is rounded.
  float moved(float u, float by) const {
    const std::int64_t way = (std::int64_t{steps_of(by)} * slope_) >> 32;
    return number_of(steps_of(u) + static_cast<std::int32_t>(way));
  }

  std::unique_ptr<const PreparedSampler> base_;
  Purpose purpose_;
  bool is_flat_;        ///< y moves by x, otherwise x by y
  std::int64_t slope_;  ///< in units of 2^-32, so whole slopes are exact
};

}  // namespace

void ShearedSampler::Settings::describe(Schema<Settings>& s) {
  s.field("base", &Settings::base, "Sampler that provides the points").otherwise("pmj02");
  s.field("direction", &Settings::direction,
          "Direction of the lines, measured from the x axis towards the y axis")
      .unit("degrees")
      .at_least(-180)
      .at_most(180);
  s.field("purpose", &Settings::purpose, "Purpose of the points that are sheared");
  s.example("{ direction: 120, purpose: pixel }");
  s.example("{ base: sobol, direction: -20 }");
}

std::unique_ptr<const PreparedSampler> ShearedSampler::prepare(const PixelGrid& grid,
                                                               const SamplePlan& plan,
                                                               const IntegrandProbe* probe) const {
  return std::make_unique<PreparedSheared>(settings_.base->prepare(grid, plan, probe),
                                           settings_.direction, settings_.purpose);
}

}  // namespace pharos
