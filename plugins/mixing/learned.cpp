// learned: learns a share of unguided samples for each region of the guide by gradient descent
// (Mueller 2019, "Practical Path Guiding in Production", in the SIGGRAPH course "Path Guiding in
// Production").
//
// The share is a = 1 / (1 + exp(-theta)). A step is drawn with density p; B and G are the unguided
// and the guided part of p. The estimate of the step is x = f / p (f: BSDF times estimated incident
// radiance). theta descends the slope
//
//     a (1 - a) E[ -x   (B - G) / q   ] / E[x]     objective kl,
//     a (1 - a) E[ -x^2 (B - G) / q^2 ] / E[x^2]   objective variance,       q = a B + (1 - a) G,
//
// (B, G and q relative to p) plus `regularization` times the distance of theta from its start. The
// descent uses Adam. The steps of an iteration are summed up (finds.h), and theta moves at the end
// of the iteration. If a region is refined, the new regions begin with its theta and its moments.
//
// This differs from the published method. There, each second sample moves theta at once by its own
// gradient, in the order of threads. Here, shares are frozen within an iteration. The result is
// therefore the same for any number of threads, and what several states absorbed adds up. Each
// second sample (`batch`) still earns one step of descent, up to `steps` an iteration, but along
// the slope of all samples. The slope is divided by E[x] or E[x^2], so that the unit of radiance
// does not change the relative effect of `regularization`. Theta is drawn back to `initial` rather
// than to one half. It is limited so that the share and its complement are at least `least`
// (published: |theta| < 20). A sample therefore weighs at most 1 / least times as much as it would
// under unguided sampling alone.
//
//     mixing: { type: learned, objective: variance }
#include "learned.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/error.h>
#include <pharos/core/parallel.h>
#include <pharos/statistics/adam.h>

#include "mixed_steps.h"

namespace pharos {
namespace {

using statistics::Adam;
using Settings = LearnedMixing::Settings;

double logit(double share) {
  return std::log(share / (1 - share));
}
double share_of(double theta) {
  return 1 / (1 + std::exp(-theta));
}

/// Takes the share of the region of the first method that knows something at the vertex.
class RegionShares final : public MixingShares {
 public:
  RegionShares(std::vector<float> unguided, std::vector<float> weights)
      : unguided_(std::move(unguided)), weights_(std::move(weights)) {}

  /// Returns the region as the key.
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    std::uint32_t region = 0;
    for (std::size_t i = query.places.size(); i-- > 0;) {
      if (query.places[i].evidence > 0) region = query.places[i].region;
    }
    share_by_weight(weights_, query.places, unguided_[region], shares);
    return region;
  }

 private:
  std::vector<float> unguided_;  ///< unguided share of each region
  std::vector<float> weights_;   ///< weight of each method
};

/// The learned state of one region.
struct Region {
  double theta;  ///< log-odds of the share of unguided samples
  Adam adam;
  Finds finds;  ///< since the last update
  void archive(Archive& archive) {
    archive(theta, adam, finds);
    archive.expect(std::abs(theta) < 100, "what was learned of mixing");
  }
};

class LearnedState final : public MixingState {
 public:
  LearnedState(const Settings& settings, std::span<const float> weights)
      : settings_(settings), weights_(weights.begin(), weights.end()) {}

  void absorb(const PathLog& log) override {
    for_each_mixed_step(log, incident_,
                        [&](const PathView& path, const RecordedVertex& vertex, Rgb incident) {
                          add(path, vertex, incident);
                        });
  }

  void update(std::uint32_t regions, std::span<const std::uint32_t> origins, bool) override {
    parallel_for(regions_.size(), [&](std::size_t i) { learn(regions_[i]); });
    std::vector<Region> next;
    for (std::uint32_t i = 0; i < regions; ++i) {
      const std::uint32_t origin = origins.empty() ? i : origins[i];
      next.push_back(origin < regions_.size() ? heir_of(regions_[origin]) : new_region());
    }
    regions_ = std::move(next);
  }

  std::shared_ptr<const MixingShares> shares() const override {
    std::vector<float> unguided;
    for (const Region& region : regions_) unguided.push_back(fraction(region));
    return std::make_shared<RegionShares>(std::move(unguided), weights_);
  }

  void archive(Archive& archive) override {
    archive.heading("learned mixing", 2);
    const std::size_t count = regions_.size();
    archive.list(regions_, [&] { return new_region(); });
    archive.expect(count == 0 || regions_.size() == count, "what was learned of mixing");
  }

 private:
  Region new_region() const { return {logit(settings_.initial), {}, Finds(settings_.bins)}; }
  Region heir_of(const Region& region) const {
    return {region.theta, region.adam, Finds(settings_.bins)};
  }

  /// Returns the largest value of theta.
  double limit() const { return logit(1 - settings_.least); }
  float fraction(const Region& region) const {
    return static_cast<float>(
        std::clamp(share_of(region.theta), settings_.least, 1 - settings_.least));
  }

  void add(const PathView& path, const RecordedVertex& vertex, Rgb incident) {
    const double found = mean(vertex.local_weight * incident);
    const double weight = settings_.objective == MixingObjective::kl ? found : found * found;
    double unguided = 0, guided = 0;
    const std::span<const Technique> techniques = path.techniques(vertex);
    for (std::size_t i = 0; i < techniques.size(); ++i) {
      (i == 0 ? unguided : guided) += double{techniques[i].share} * techniques[i].density;
    }
    // A zero sample may have no density at all.
    const double u = weight > 0 ? unguided / (unguided + guided) : 0;
    // A single infinite value would stay in the sums forever.
    if (std::isfinite(weight) && std::isfinite(u)) regions_[vertex.mixing_key].finds.add(u, weight);
  }

  void learn(Region& region) const {
    const std::vector<Finds::Term> terms = region.finds.terms(fraction(region));
    if (terms.empty()) return;
    const statistics::AdamRates rates{settings_.learning_rate, settings_.mean_decay,
                                      settings_.square_decay, settings_.epsilon};
    const double start = logit(settings_.initial);
    const std::uint64_t earned = region.finds.steps() / settings_.batch;
    for (std::uint64_t step = std::min<std::uint64_t>(earned, settings_.steps); step > 0; --step) {
      const double a = share_of(region.theta);
      const double gradient = a * (1 - a) * objective_slope(terms, a, settings_.objective) +
                              settings_.regularization * (region.theta - start);
      const double theta = region.theta + region.adam.step(gradient, rates);
      region.theta = std::clamp(theta, -limit(), limit());
    }
  }

  const Settings settings_;
  std::vector<float> weights_;
  std::vector<Region> regions_;
  std::vector<Rgb> incident_;  ///< of one path; a member, so that it keeps its memory
};

}  // namespace

void LearnedMixing::Settings::describe(Schema<Settings>& s) {
  s.field("objective", &Settings::objective,
          "Minimized quantity: divergence from the target distribution, or variance of the "
          "estimate of a step");
  s.field("initial", &Settings::initial, "Initial share of unguided samples").above(0).below(1);
  s.field("least", &Settings::least, "Lower bound of the shares of unguided and of guided samples")
      .at_least(1e-4)
      .at_most(0.5);
  s.field("learning_rate", &Settings::learning_rate, "Step size of Adam")
      .unit("log-odds")
      .above(0)
      .at_most(10);
  s.field("mean_decay", &Settings::mean_decay, "beta_1 of Adam").at_least(0).below(1);
  s.field("square_decay", &Settings::square_decay, "beta_2 of Adam").at_least(0).below(1);
  s.field("epsilon", &Settings::epsilon,
          "epsilon of Adam; much smaller gradients have almost no effect")
      .above(0);
  s.field("regularization", &Settings::regularization,
          "Strength of the pull towards the initial share")
      .at_least(0);
  s.field("batch", &Settings::batch, "Number of samples that earn a region one step of descent")
      .at_least(1);
  s.field("steps", &Settings::steps, "Largest number of steps of descent in an iteration")
      .at_least(1)
      .at_most(100'000);
  s.field("bins", &Settings::bins,
          "Number of bins in which a region's samples are summed up by their densities")
      .at_least(2)
      .at_most(1024);
}

LearnedMixing::LearnedMixing(const Settings& settings) : settings_(settings) {
  if (settings.initial < settings.least || settings.initial > 1 - settings.least) {
    throw InputError("the initial share must be between least and 1 - least");
  }
}

std::unique_ptr<MixingState> LearnedMixing::begin(std::span<const float> weights) const {
  return std::make_unique<LearnedState>(settings_, weights);
}

}  // namespace pharos
