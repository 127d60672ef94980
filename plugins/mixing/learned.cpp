// learned: a share of unguided samples for each region of the guide, learned by gradient descent
// (Mueller 2019, "Practical Path Guiding in Production", in the SIGGRAPH course "Path Guiding in
// Production").
//
// The share is a = 1 / (1 + exp(-theta)). With what a step finds, x = f / p (f: BSDF times
// estimated incident radiance), drawn with density p, of which B and G are the unguided and the
// guided part, theta descends the slope
//
//     a (1 - a) E[ -x   (B - G) / q   ] / E[x]     objective kl,
//     a (1 - a) E[ -x^2 (B - G) / q^2 ] / E[x^2]   objective variance,       q = a B + (1 - a) G,
//
// (B, G and q relative to p) plus `regularization` times theta's distance from its start, by Adam.
// An iteration's steps are summed up (finds.h); its end takes the steps of descent. Regions that a
// region is refined into begin with its theta and its moments.
//
// Where this is not what was published: there, each second sample moves theta at once by its own
// gradient, in the order of threads. Here fractions are frozen within an iteration, the result
// is the same for any number of threads, and what several states absorbed adds up; each second
// sample (`batch`) still earns a step, up to `steps` an iteration, but along the slope of all
// samples. The slope is divided by E[x] or E[x^2], so that the unit of radiance does not matter
// beside `regularization`. Theta is drawn back to `initial` rather than to one half, and held where
// the share and its complement are at least `least` (published: |theta| < 20), so that no sample
// weighs more than 1 / least times what unguided sampling alone would make of it.
//
//     mixing: { type: learned, objective: variance }
#include "learned.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>
#include <pharos/core/error.h>
#include <pharos/core/parallel.h>
#include <pharos/statistics/adam.h>

namespace pharos {
namespace {

using statistics::Adam;
using Settings = LearnedMixing::Settings;

constexpr const char* kStateName = "learned mixing";
constexpr std::uint32_t kStateVersion = 1;

double logit(double share) {
  return std::log(share / (1 - share));
}
double share_of(double theta) {
  return 1 / (1 + std::exp(-theta));
}

class RegionFractions final : public MixingFractions {
 public:
  explicit RegionFractions(std::vector<float> fractions) : fractions_(std::move(fractions)) {}
  float unguided_fraction(std::uint32_t region) const override { return fractions_[region]; }

 private:
  std::vector<float> fractions_;
};

/// What is known of one region.
struct Region {
  double theta;  ///< log-odds of the share of unguided samples
  Adam adam;
  Finds finds;  ///< since the last update
};

class LearnedState final : public MixingState {
 public:
  explicit LearnedState(const Settings& settings) : settings_(settings) {}

  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) {
      const PathView path = log[i];
      if (path.transport != Transport::radiance) continue;
      estimate_incident_radiance(path, incident_);
      for (std::size_t k = 0; k < path.vertices.size(); ++k) {
        const RecordedVertex& vertex = path.vertices[k];
        // The share of a vertex is below one only where a guide had an answer.
        if (vertex.unguided_fraction < 1) add(vertex, incident_[k]);
      }
    }
  }

  std::shared_ptr<const MixingFractions> update(std::uint32_t region_count,
                                                std::span<const std::uint32_t> origins) override {
    parallel_for(regions_.size(), [&](std::size_t i) { learn(regions_[i]); });
    std::vector<Region> next;
    std::vector<float> fractions;
    for (std::uint32_t i = 0; i < region_count; ++i) {
      const std::uint32_t origin = origins.empty() ? i : origins[i];
      next.push_back(origin < regions_.size() ? heir_of(regions_[origin]) : new_region());
      fractions.push_back(fraction(next.back()));
    }
    regions_ = std::move(next);
    return std::make_shared<RegionFractions>(std::move(fractions));
  }

  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  void merge(const MixingState& other) override;

 private:
  Region new_region() const { return {logit(settings_.initial), {}, Finds(settings_.bins)}; }
  Region load_region(std::istream& in) const;
  Region heir_of(const Region& region) const {
    return {region.theta, region.adam, Finds(settings_.bins)};
  }

  /// The largest theta.
  double limit() const { return logit(1 - settings_.least); }
  float fraction(const Region& region) const {
    return static_cast<float>(
        std::clamp(share_of(region.theta), settings_.least, 1 - settings_.least));
  }

  void add(const RecordedVertex& vertex, Rgb incident) {
    const double found = mean(vertex.local_weight * incident);
    const double weight = settings_.objective == MixingObjective::kl ? found : found * found;
    const double share = vertex.unguided_fraction;
    const double unguided = share * vertex.unguided_pdf, guided = (1 - share) * vertex.guided_pdf;
    // A step that found nothing may have no density at all: it was a zero sample.
    const double u = weight > 0 ? unguided / (unguided + guided) : 0;
    // One infinite find would stay in the sums for good.
    if (std::isfinite(weight) && std::isfinite(u)) regions_[vertex.region].finds.add(u, weight);
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
  std::vector<Region> regions_;
  std::vector<Rgb> incident_;  ///< of one path; a member to keep its memory
};

void LearnedState::save(std::ostream& out) const {
  save_heading(out, kStateName, kStateVersion);
  save_number(out, static_cast<std::uint32_t>(settings_.objective));
  save_number(out, settings_.bins);
  save_number(out, static_cast<std::uint64_t>(regions_.size()));
  for (const Region& region : regions_) {
    const Adam::Moments& moments = region.adam.moments();
    for (const double value :
         {region.theta, moments.mean, moments.square, moments.mean_left, moments.square_left}) {
      save_number(out, value);
    }
    region.finds.save(out);
  }
}

void LearnedState::load(std::istream& in) {
  expect_heading(in, kStateName, kStateVersion);
  const auto objective = load_number<std::uint32_t>(in), bins = load_number<std::uint32_t>(in);
  if (objective != static_cast<std::uint32_t>(settings_.objective) || bins != settings_.bins) {
    throw InputError("mixing was learned with another objective or another number of bins");
  }
  const auto count = load_number<std::uint64_t>(in);
  std::vector<Region> regions;
  // A count that is damaged must not decide how much memory is taken: regions are read first.
  for (std::uint64_t i = 0; i < count; ++i) regions.push_back(load_region(in));
  regions_ = std::move(regions);
}

Region LearnedState::load_region(std::istream& in) const {
  Region region = new_region();
  region.theta = std::clamp(load_finite<double>(in), -limit(), limit());
  Adam::Moments moments;
  for (double* value : {&moments.mean, &moments.square, &moments.mean_left, &moments.square_left}) {
    *value = load_finite<double>(in);
  }
  const auto is_share = [](double x) { return x >= 0 && x <= 1; };
  if (moments.square < 0 || !is_share(moments.mean_left) || !is_share(moments.square_left)) {
    throw InputError("what was saved is damaged");
  }
  region.adam = Adam(moments);
  region.finds.load(in);
  return region;
}

void LearnedState::merge(const MixingState& other) {
  const auto& theirs = dynamic_cast<const LearnedState&>(other);
  if (theirs.regions_.size() != regions_.size() || theirs.settings_.bins != settings_.bins) {
    throw InputError("mixing can be merged only with a state of the same settings and updates");
  }
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    regions_[i].finds.add(theirs.regions_[i].finds);
  }
}

}  // namespace

void LearnedMixing::Settings::describe(Schema<Settings>& s) {
  s.field("objective", &Settings::objective,
          "What is minimized: divergence from what is sought, or variance of what is found");
  s.field("initial", &Settings::initial, "Share of unguided samples to start from")
      .above(0)
      .below(1);
  s.field("least", &Settings::least, "Smallest share of either kind").at_least(1e-4).at_most(0.5);
  s.field("learning_rate", &Settings::learning_rate, "Length of a step of Adam")
      .unit("log-odds")
      .above(0)
      .at_most(10);
  s.field("mean_decay", &Settings::mean_decay, "beta_1 of Adam").at_least(0).below(1);
  s.field("square_decay", &Settings::square_decay, "beta_2 of Adam").at_least(0).below(1);
  s.field("epsilon", &Settings::epsilon, "Of Adam: smaller gradients move nothing").above(0);
  s.field("regularization", &Settings::regularization, "Pull towards the initial share")
      .at_least(0);
  s.field("batch", &Settings::batch, "Samples that earn a region one step").at_least(1);
  s.field("steps", &Settings::steps, "Most steps an iteration").at_least(1).at_most(100'000);
  s.field("bins", &Settings::bins, "In which a region's samples are summed up by their densities")
      .at_least(2)
      .at_most(1024);
}

LearnedMixing::LearnedMixing(const Settings& settings) : settings_(settings) {
  if (settings.initial < settings.least || settings.initial > 1 - settings.least) {
    throw InputError("the initial share must be between least and 1 - least");
  }
}

std::unique_ptr<MixingState> LearnedMixing::begin() const {
  return std::make_unique<LearnedState>(settings_);
}

}  // namespace pharos
