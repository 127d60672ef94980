#include "cell_mixture.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include <pharos/core/warp.h>

namespace pharos::parallax_aware_mixtures {
namespace {

Direction to_vector(Point3 p) {
  return {p.x, p.y, p.z};
}
Point3 to_point(const Direction& d) {
  return {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])};
}

/// Returns direction `i` of `count` directions that are spread evenly over the sphere, on a spiral
/// with the golden angle.
Direction spiral_direction(std::size_t i, std::size_t count) {
  constexpr double kGoldenAngle = 2.39996322972865332;
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
  const double sine = std::sqrt((1 - z) * (1 + z)), phi = kGoldenAngle * static_cast<double>(i);
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

/// Chooses `count` of the directions by systematic sampling, or all if there are not more.
std::vector<WeightedDirection> chosen_of(std::span<const WeightedDirection> directions,
                                         std::size_t count, RandomStream& random) {
  if (directions.size() <= count) return {directions.begin(), directions.end()};
  std::vector<WeightedDirection> chosen;
  choose_systematically(
      directions.size(), count, random.next_1d(),
      [&](std::size_t i) { return directions[i].weight; },
      [&](std::size_t i, double weight) {
        chosen.push_back({directions[i].direction, static_cast<float>(weight)});
      });
  return chosen;
}

}  // namespace

/// One update of a cell.
class CellUpdate {
 public:
  CellUpdate(CellMixture& cell, std::span<const Sample> samples,
             const ParallaxAwareMixturesSettings& settings)
      : cell_(cell), settings_(settings) {
    if (!cell_.knows_something()) begin();
    move_pivot(samples);
    for (const Sample& sample : samples) aimed_.push_back(aim(sample));
    set_directions();
    for (const Sample& sample : samples) box_.add(sample.origin);
  }

  void run(RandomStream& random) {
    frozen_ = cell_.moments_;
    chosen_ = chosen_of(directions_, settings_.most_fit_samples(), random);
    fit({});
    cell_.found_ += static_cast<double>(directions_.size());
    cell_.since_merge_ += static_cast<double>(aimed_.size());
    if (cell_.since_merge_ >= settings_.merge_samples) merge();
    split_where_needed();
    if (chosen_.size() < directions_.size()) refine();
    for (std::size_t k = 0; k < frozen_.size(); ++k) {
      cell_.moments_[k] = frozen_[k];
      cell_.moments_[k] += seen_[k];
    }
  }

 private:
  FitRules rules(std::span<const std::size_t> changing) const {
    return {.frozen = frozen_,
            .prior_share = settings_.prior_share,
            .prior_strength = settings_.prior_strength,
            .most_kappa = settings_.most_kappa,
            .changing = changing,
            .most_iterations = settings_.em_iterations,
            .tolerance = settings_.em_tolerance};
  }

  void begin() {
    const std::size_t count = settings_.components;
    cell_.moments_.assign(count, {});
    cell_.assessments_.assign(count, {});
    for (std::size_t k = 0; k < count; ++k) {
      cell_.mixture_.push_back(
          {1 / static_cast<double>(count), spiral_direction(k, count), settings_.first_kappa});
    }
  }

  /// Moves the pivot to the mean of all origins, and turns the lobes toward the same lights as
  /// before.
  void move_pivot(std::span<const Sample> samples) {
    Direction sum = Direction::Zero();
    for (const Sample& s : samples) sum += to_vector(s.origin);
    const double added = static_cast<double>(samples.size());
    const Direction mean = (cell_.origins_ * cell_.pivot_ + sum) / (cell_.origins_ + added);
    const Direction step = mean - cell_.pivot_;
    cell_.pivot_ = mean;
    cell_.origins_ += added;
    for (std::size_t k = 0; k < cell_.mixture_.size(); ++k) shift(k, step);
  }

  void shift(std::size_t k, const Direction& step) {
    const PlacedLobe before = placed(k), after = before.seen_from(step);
    cell_.mixture_[k].mean = after.lobe.mean;
    Moments& m = cell_.moments_[k];
    m.resultant = m.resultant.norm() * after.lobe.mean;
    if (before.inverse_distance > 0) {
      cell_.assessments_[k].inverse *= after.inverse_distance / before.inverse_distance;
    }
  }

  PlacedLobe placed(std::size_t k) const {
    const Assessment& a = cell_.assessments_[k];
    return {cell_.mixture_[k], a.certainty > 0 ? a.inverse / a.certainty : 0};
  }

  AimedSample aim(const Sample& sample) const {
    AimedSample aimed{sample.direction, 0, sample.weight, sample.pdf, sample.steps};
    if (!settings_.parallax) return aimed;
    const PlacedLobe there{{1, to_vector(sample.direction), 0}, sample.inverse_distance};
    const PlacedLobe here = there.seen_from(cell_.pivot_ - to_vector(sample.origin));
    aimed.direction = normalize(to_point(here.lobe.mean));
    aimed.inverse_distance = static_cast<float>(here.inverse_distance);
    return aimed;
  }

  /// Sets the directions of the samples that found light. Their weights add up to their number.
  void set_directions() {
    double total = 0, count = 0;
    for (const AimedSample& s : aimed_) {
      total += s.weight;
      count += s.weight > 0 ? 1 : 0;
    }
    for (const AimedSample& s : aimed_) {
      const auto weight = static_cast<float>(s.weight * count / total);
      if (s.weight > 0) directions_.push_back({s.direction, weight});
    }
  }

  void fit(std::span<const std::size_t> changing) {
    seen_ = parallax_aware_mixtures::fit(cell_.mixture_, chosen_, rules(changing));
  }

  /// Takes the last step of the fit, with all directions.
  void refine() {
    seen_ = expectation(cell_.mixture_, directions_).moments;
    std::vector<Moments> moments = seen_;
    for (std::size_t k = 0; k < moments.size(); ++k) moments[k] += frozen_[k];
    maximize(moments, rules({}), cell_.mixture_);
  }

  void merge() {
    cell_.since_merge_ = 0;
    merge_cheapest_pairs(
        settings_.merge_threshold, [&] { return cell_.mixture_.size(); },
        [&](std::size_t i, std::size_t j, double bound) { return cost_anywhere(i, j, bound); },
        [&](std::size_t i, std::size_t j) { join(i, j); });
  }

  /// Returns the largest cost of merging two lobes over several viewpoints in the cell. The search
  /// ends at the first cost that is at least `bound`.
  double cost_anywhere(std::size_t i, std::size_t j, double bound) const {
    const PlacedLobe a = placed(i), b = placed(j);
    double most = merge_cost(a.lobe, b.lobe);
    if (!settings_.parallax) return most;
    const Direction low = to_vector(box_.low) - cell_.pivot_,
                    high = to_vector(box_.high) - cell_.pivot_;
    for (const Direction& corner :
         {Direction(low[0], high[1], high[2]), Direction(high[0], low[1], high[2]),
          Direction(high[0], high[1], low[2])}) {
      if (most >= bound) return most;
      most = std::max(most, merge_cost(a.seen_from(corner / 2).lobe, b.seen_from(corner / 2).lobe));
    }
    return most;
  }

  void join(std::size_t i, std::size_t j) {
    const auto erase = [j](auto& list) {
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(j));
    };
    const Lobe whole = merged(cell_.mixture_[i], cell_.mixture_[j]);
    frozen_[i] += frozen_[j];
    seen_[i] += seen_[j];
    const double inverse = cell_.assessments_[i].inverse + cell_.assessments_[j].inverse;
    const double certainty = cell_.assessments_[i].certainty + cell_.assessments_[j].certainty;
    cell_.assessments_[i] = {.inverse = inverse, .certainty = certainty};
    cell_.mixture_[i] = whole;
    erase(frozen_);
    erase(seen_);
    erase(cell_.mixture_);
    erase(cell_.moments_);
    erase(cell_.assessments_);
  }

  void split_where_needed() {
    const std::vector<Assessment> now = assess();
    for (std::size_t k = 0; k < now.size(); ++k) cell_.assessments_[k] += now[k];
    split_until_settled([&] { return assess(); }, [&] { return split(); },
                        [&](std::span<const std::size_t> changed) { fit(changed); },
                        [&](std::size_t k, const Assessment& again) {
                          // The halves keep the distance of the whole lobe's light.
                          Assessment& known = cell_.assessments_[k];
                          known = {.inverse = known.inverse, .certainty = known.certainty};
                          known += again;
                        });
  }

  std::vector<Assessment> assess() const {
    return parallax_aware_mixtures::assess(cell_.mixture_, aimed_,
                                           settings_.least_density * warp::sphere_pdf());
  }

  std::vector<std::size_t> split() {
    const auto divergence = [&](std::size_t k) {
      const Assessment& a = cell_.assessments_[k];
      return a.samples < settings_.split_samples ? 0 : a.divergence();
    };
    return halve_worst(
        settings_.split_threshold, settings_.most_components, [&] { return cell_.mixture_.size(); },
        divergence, [&](std::size_t k) { return halve(k); });
  }

  bool halve(std::size_t k) {
    const auto axis = cell_.assessments_[k].half_axis(cell_.mixture_[k].mean);
    if (!axis) return false;
    const std::array<Lobe, 2> parts = halves(cell_.mixture_[k], *axis, settings_.most_kappa);
    for (auto* moments : {&frozen_, &seen_}) {
      Moments& whole = (*moments)[k];
      const double length = whole.resultant.norm() / 2 * std::sqrt(1 + axis->squaredNorm());
      const double weight = whole.weight / 2, resultant = std::min(length, weight);
      whole = {weight, resultant * parts[0].mean};
      moments->push_back({weight, resultant * parts[1].mean});
    }
    cell_.mixture_[k] = parts[0];
    cell_.mixture_.push_back(parts[1]);
    cell_.moments_.emplace_back();
    Assessment& a = cell_.assessments_[k];
    a = {.inverse = a.inverse / 2, .certainty = a.certainty / 2};
    cell_.assessments_.push_back(a);
    return true;
  }

  CellMixture& cell_;
  const ParallaxAwareMixturesSettings& settings_;
  std::vector<AimedSample> aimed_;
  std::vector<WeightedDirection> directions_;  ///< of the samples that found light
  std::vector<WeightedDirection> chosen_;      ///< directions for the fit, see chosen_of()
  Bounds3 box_;                                ///< bounds of the samples' origins
  std::vector<Moments> frozen_;                ///< moments of earlier iterations
  std::vector<Moments> seen_;                  ///< moments of this iteration
};

void CellMixture::update(std::span<const Sample> samples,
                         const ParallaxAwareMixturesSettings& settings, RandomStream random) {
  learn_when_enough(
      samples, knows_something(), settings.first_samples, first_,
      [&](std::span<const Sample> enough) { CellUpdate(*this, enough, settings).run(random); });
}

void CellMixture::forget(double factor) {
  for (Moments& m : moments_) m *= factor;
  for (Assessment& a : assessments_) a *= factor;
  origins_ *= factor;
  found_ *= factor;
}

std::vector<double> CellMixture::inverse_distances() const {
  std::vector<double> all;
  for (const Assessment& a : assessments_) {
    all.push_back(a.certainty > 0 ? a.inverse / a.certainty : 0);
  }
  return all;
}

Point3 CellMixture::pivot() const {
  return to_point(pivot_);
}

void CellMixture::archive(Archive& archive) {
  archive(pivot_, origins_, found_, since_merge_, mixture_, moments_, assessments_, first_);
  const std::size_t count = mixture_.size();
  bool is_sound = origins_ >= 0 && found_ >= 0 && since_merge_ >= 0 && moments_.size() == count &&
                  assessments_.size() == count;
  for (std::size_t k = 0; is_sound && k < count; ++k) {
    const Lobe& lobe = mixture_[k];
    const Assessment& a = assessments_[k];
    for (const double v : {lobe.kappa, moments_[k].weight, a.samples, a.divergence_sum, a.weight,
                           a.inverse, a.certainty}) {
      is_sound &= v >= 0;
    }
    is_sound &= std::abs(lobe.mean.squaredNorm() - 1) < 1e-6 && lobe.weight > 0 &&
                a.inverse <= kLargestInverse * a.certainty;
  }
  archive.expect(is_sound, "the learning of the von Mises-Fisher mixtures");
}

}  // namespace pharos::parallax_aware_mixtures
