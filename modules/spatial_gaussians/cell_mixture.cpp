#include "cell_mixture.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>

namespace pharos::spatial_gaussians {

using statistics::Matrix;
using statistics::MixtureFit;
using statistics::Vector;
using statistics::WeightedPoints;

namespace {

Vector<3> to_vector(Point3 p) {
  return {p.x, p.y, p.z};
}

/// Returns the targets of the samples that found light, relative to the pivot. Their weights add up
/// to their number.
WeightedPoints<3> points_of(std::span<const Sample> samples, const Vector<3>& pivot) {
  double total = 0, count = 0;
  for (const Sample& s : samples) {
    total += s.weight;
    count += s.weight > 0 ? 1 : 0;
  }
  WeightedPoints<3> points;
  for (const Sample& s : samples) {
    if (s.weight > 0) points.add(to_vector(s.target) - pivot, s.weight * count / total);
  }
  return points;
}

/// Chooses `count` of the points by systematic sampling, or all if there are not more.
WeightedPoints<3> chosen_of(const WeightedPoints<3>& points, std::size_t count,
                            RandomStream& random) {
  if (points.size() <= count) return points;
  WeightedPoints<3> chosen;
  choose_systematically(
      points.size(), count, random.next_1d(), [&](std::size_t i) { return points.weight(i); },
      [&](std::size_t i, double weight) { chosen.add(points.point(i), weight); });
  return chosen;
}

/// Chooses at most `count` centers among the points. The probability of a point is proportional to
/// its weight times its squared distance from the nearest center so far (k-means++, Arthur and
/// Vassilvitskii 2007).
std::vector<Vector<3>> spread_centers(const WeightedPoints<3>& points, std::size_t count,
                                      RandomStream& random) {
  std::vector<double> chances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) chances[i] = points.weight(i);
  std::vector<double> squared(points.size(), std::numeric_limits<double>::infinity());
  std::vector<Vector<3>> centers;
  while (centers.size() < count) {
    const double total = std::accumulate(chances.begin(), chances.end(), 0.0);
    if (!(total > 0)) break;  // fewer different points than centers
    double u = total * random.next_1d();
    std::size_t chosen = 0;
    while (chosen + 1 < points.size() && (u >= chances[chosen] || chances[chosen] == 0)) {
      u -= chances[chosen++];
    }
    centers.push_back(points.point(chosen));
    for (std::size_t i = 0; i < points.size(); ++i) {
      squared[i] = std::min(squared[i], (points.point(i) - centers.back()).squaredNorm());
      chances[i] = points.weight(i) * squared[i];
    }
  }
  return centers;
}

/// Returns for each center the moments of the points to which it is nearest.
std::vector<Moments3> moments_about(const std::vector<Vector<3>>& centers,
                                    const WeightedPoints<3>& points) {
  std::vector<Moments3> moments(centers.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector<3> x = points.point(i);
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < centers.size(); ++k) {
      if ((x - centers[k]).squaredNorm() < (x - centers[nearest]).squaredNorm()) nearest = k;
    }
    moments[nearest] += Moments3::of(points.weight(i), x, Matrix<3>::Zero());
  }
  return moments;
}

}  // namespace

/// One update of a cell.
class CellUpdate {
 public:
  CellUpdate(CellMixture& cell, std::span<const Sample> samples,
             const SpatialGaussiansSettings& settings, double scene_size)
      : cell_(cell),
        samples_(samples),
        settings_(settings),
        scene_size_(scene_size),
        least_size_(settings.least_size * scene_size) {}

  void run(RandomStream& random) {
    if (!cell_.knows_something()) begin(random);
    middle_ = mean_origin() - cell_.pivot_;
    const WeightedPoints<3> all = points_of(samples_, cell_.pivot_);
    set_prior(all);
    points_ = chosen_of(all, settings_.most_fit_samples(), random);
    frozen_ = cell_.moments_;
    fit({});
    cell_.samples_ += static_cast<double>(all.size());
    cell_.since_merge_ += static_cast<double>(samples_.size());
    if (cell_.since_merge_ >= settings_.merge_samples) merge();
    split_where_needed();
    if (points_.size() < all.size()) refine(all);
    for (std::size_t k = 0; k < frozen_.size(); ++k) cell_.moments_[k] = frozen_[k] + seen_[k];
  }

 private:
  MixtureFit<3> rules(std::span<const std::size_t> changing) const {
    return {.frozen = frozen_,
            .prior = {settings_.prior_counts, settings_.prior_strength},
            .prior_variances = prior_variances_,
            .floors = floors_,
            .changing = changing,
            .most_iterations = settings_.em_iterations,
            .tolerance = settings_.em_tolerance};
  }

  /// Returns whether a position is on the environment. Other targets are within the scene.
  bool is_far(const Vector<3>& position) const { return (position - middle_).norm() > scene_size_; }
  /// If targets of one kind have not been found, it has the other's variance.
  double prior_variance(const Vector<3>& mean) const {
    const double own = is_far(mean) ? cell_.far_variance_ : cell_.near_variance_;
    return own > 0 ? own : std::max(cell_.near_variance_, cell_.far_variance_);
  }

  /// Sets the variances of the prior, and the lower bounds of the eigenvalues, for the current
  /// positions of the components, and applies the bounds. As seen from the middle of the samples'
  /// origins, no component is then more concentrated than the largest concentration allows.
  void set_bounds() {
    prior_variances_.clear();
    floors_.clear();
    for (const Gaussian3& g : cell_.mixture_.components) {
      prior_variances_.push_back(prior_variance(g.mean));
    }
    for (const Gaussian3& g : cell_.mixture_.components) {
      floors_.push_back(std::max((g.mean - middle_).squaredNorm() / settings_.largest_concentration,
                                 least_size_ * least_size_));
    }
    for (std::size_t k = 0; k < floors_.size(); ++k) {
      Matrix<3>& covariance = cell_.mixture_.components[k].covariance;
      covariance = statistics::with_eigenvalues_above<3>(floors_[k], covariance);
    }
  }

  /// Returns the mean of the samples' origins.
  Vector<3> mean_origin() const {
    Vector<3> sum = Vector<3>::Zero();
    for (const Sample& s : samples_) sum += to_vector(s.origin);
    return sum / static_cast<double>(samples_.size());
  }

  /// Makes the first mixture of the cell.
  void begin(RandomStream& random) {
    cell_.pivot_ = mean_origin();
    const WeightedPoints<3> points = points_of(samples_, cell_.pivot_);
    const auto centers = spread_centers(points, settings_.components, random);
    const std::vector<Moments3> moments = moments_about(centers, points);
    const Moments3 all = std::accumulate(moments.begin(), moments.end(), Moments3{});
    set_prior(points);
    const auto count = moments.size();
    cell_.mixture_.weights.assign(count, 1.0 / static_cast<double>(count));
    const Gaussian3 ball{all.mean(), prior_variance(all.mean()) * Matrix<3>::Identity()};
    cell_.mixture_.components.assign(count, ball);
    cell_.moments_.assign(count, {});
    cell_.tests_.assign(count, {});
    frozen_.clear();
    floors_.clear();
    prior_variances_.clear();
    for (const Moments3& m : moments) {
      prior_variances_.push_back(prior_variance(m.weight > 0 ? m.mean() : all.mean()));
    }
    statistics::maximize<3>(moments, rules({}), cell_.mixture_);
  }

  /// Sets the variances of the prior that are not yet known. Distant points that stand for the
  /// environment would make components on small lamps as wide as the scene, so each kind has its
  /// own.
  void set_prior(const WeightedPoints<3>& points) {
    Moments3 near, far;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector<3> x = points.point(i);
      (is_far(x) ? far : near) += Moments3::of(points.weight(i), x, Matrix<3>::Zero());
    }
    const auto set = [&](const Moments3& found, double& variance) {
      const double own = found.weight > 0 ? found.covariance().trace() / 3 : 0;
      // A single point has no variance.
      if (variance == 0 && own > least_size_ * least_size_) variance = own;
    };
    set(near, cell_.near_variance_);
    set(far, cell_.far_variance_);
    if (cell_.near_variance_ == 0 && cell_.far_variance_ == 0) {
      cell_.near_variance_ = least_size_ * least_size_;
    }
  }

  void fit(std::span<const std::size_t> changing) {
    set_bounds();
    seen_ = statistics::fit_mixture(cell_.mixture_, points_, rules(changing)).seen;
  }

  /// Takes the last step of the fit, with all points.
  void refine(const WeightedPoints<3>& all) {
    seen_ = statistics::expectation(cell_.mixture_, all).moments;
    maximize({});
  }

  /// Recomputes the components with the numbers `changing` from their moments.
  void maximize(std::span<const std::size_t> changing) {
    std::vector<Moments3> moments = seen_;
    for (std::size_t k = 0; k < moments.size(); ++k) moments[k] += frozen_[k];
    statistics::maximize<3>(moments, rules(changing), cell_.mixture_);
  }

  void merge() {
    cell_.since_merge_ = 0;
    const Mixture& m = cell_.mixture_;
    std::set<std::pair<std::size_t, std::size_t>> refused;
    merge_cheapest_pairs(
        settings_.merge_threshold, [&] { return m.size(); },
        [&](std::size_t i, std::size_t j, double least) {
          const double cost =
              merge_cost(m.weights[i], m.components[i], m.weights[j], m.components[j]);
          if (cost >= least) return cost;
          if (!refused.contains({i, j}) && !would_be_split(i, j)) return cost;
          refused.insert({i, j});
          return kNeverMerged;
        },
        [&](std::size_t i, std::size_t j) {
          join(i, j);
          refused.clear();  // other pairs have these numbers now
        });
  }

  static constexpr double kNeverMerged = std::numeric_limits<double>::infinity();

  /// Returns whether the directions ask to split what would replace a pair of components. Merges
  /// look at positions and splits at directions, so the same pair could be merged and split again
  /// and again. Few samples do not tell.
  bool would_be_split(std::size_t i, std::size_t j) const {
    if (samples_.size() < settings_.split_samples) return false;
    Mixture merged = cell_.mixture_;
    const auto part = [&](std::size_t k) {
      return Moments3::of(merged.weights[k], merged.components[k].mean,
                          merged.components[k].covariance);
    };
    const Moments3 both = part(i) + part(j);
    merged.weights[i] += merged.weights[j];
    merged.components[i] = {both.mean(), both.covariance()};
    merged.weights.erase(merged.weights.begin() + static_cast<std::ptrdiff_t>(j));
    merged.components.erase(merged.components.begin() + static_cast<std::ptrdiff_t>(j));
    return asks_for_split(test(merged)[i]);
  }

  void join(std::size_t i, std::size_t j) {
    Mixture& m = cell_.mixture_;
    const auto erase = [j](auto& list) {
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(j));
    };
    frozen_[i] += frozen_[j];
    seen_[i] += seen_[j];
    m.weights[i] += m.weights[j];
    cell_.tests_[i] = {};
    erase(frozen_);
    erase(seen_);
    erase(m.weights);
    erase(m.components);
    erase(cell_.tests_);
    erase(cell_.moments_);
    erase(floors_);
    erase(prior_variances_);
    const std::size_t changed[] = {i};
    maximize(changed);
  }

  void split_where_needed() {
    add_tests(test(cell_.mixture_));
    split_until_settled([&] { return test(cell_.mixture_); }, [&] { return split(); },
                        [&](std::span<const std::size_t> changed) { fit(changed); },
                        [&](std::size_t k, const DirectionTest& t) { cell_.tests_[k] = t; });
  }

  std::vector<DirectionTest> test(const Mixture& mixture) const {
    return test_directions(mixture, cell_.pivot_, samples_,
                           settings_.least_density * warp::sphere_pdf());
  }
  void add_tests(const std::vector<DirectionTest>& tests) {
    for (std::size_t k = 0; k < tests.size(); ++k) {
      cell_.tests_[k].sum += tests[k].sum;
      cell_.tests_[k].samples += tests[k].samples;
    }
  }

  bool asks_for_split(const DirectionTest& t) const {
    return t.samples >= settings_.split_samples && t.divergence() > settings_.split_threshold;
  }

  std::vector<std::size_t> split() {
    const auto divergence = [&](std::size_t k) {
      return asks_for_split(cell_.tests_[k]) ? cell_.tests_[k].divergence() : 0;
    };
    return halve_worst(
        settings_.split_threshold, settings_.most_components, [&] { return cell_.mixture_.size(); },
        divergence,
        [&](std::size_t k) {
          halve(k);
          return true;
        });
  }

  void halve(std::size_t k) {
    Mixture& m = cell_.mixture_;
    const Vector<3> axis = statistics::principal_axis(m.components[k].covariance);
    for (auto* moments : {&frozen_, &seen_}) {
      if (!((*moments)[k].weight > 0)) {
        moments->push_back({});
        continue;
      }
      const auto parts = statistics::halves<3>((*moments)[k], axis);
      (*moments)[k] = parts[0];
      moments->push_back(parts[1]);
    }
    const Moments3 whole =
        Moments3::of(m.weights[k], m.components[k].mean, m.components[k].covariance);
    const auto parts = statistics::halves<3>(whole, axis);
    m.components[k] = {parts[0].mean(), parts[0].covariance()};
    m.components.push_back({parts[1].mean(), parts[1].covariance()});
    m.weights[k] /= 2;
    m.weights.push_back(m.weights[k]);
    cell_.moments_.push_back({});
    cell_.tests_[k] = {};
    cell_.tests_.emplace_back();
  }

  CellMixture& cell_;
  std::span<const Sample> samples_;
  const SpatialGaussiansSettings& settings_;
  double scene_size_, least_size_;        ///< [scene units]
  Vector<3> middle_ = Vector<3>::Zero();  ///< mean of the samples' origins, relative to the pivot
  WeightedPoints<3> points_;              ///< points for the fit, see chosen_of()
  std::vector<double> floors_, prior_variances_;  ///< of each component
  std::vector<Moments3> frozen_;                  ///< moments of earlier iterations
  std::vector<Moments3> seen_;                    ///< moments of this iteration
};

void CellMixture::update(std::span<const Sample> samples, const SpatialGaussiansSettings& settings,
                         double scene_size, RandomStream random) {
  learn_when_enough(samples, knows_something(), settings.first_samples, first_,
                    [&](std::span<const Sample> enough) {
                      CellUpdate(*this, enough, settings, scene_size).run(random);
                    });
}

void CellMixture::forget(double factor) {
  for (Moments3& m : moments_) m *= factor;
  for (DirectionTest& t : tests_) {
    t.sum *= factor;
    t.samples *= factor;
  }
  samples_ *= factor;
}

std::vector<SpatialGaussian> CellMixture::components() const {
  std::vector<SpatialGaussian> all;
  for (std::size_t k = 0; k < mixture_.size(); ++k) {
    const Gaussian3& g = mixture_.components[k];
    const Vector<3> mean = g.mean + pivot_;
    const Matrix<3> l = Eigen::LLT<Matrix<3>>(g.covariance).matrixL();
    const auto f = [](double v) { return static_cast<float>(v); };
    all.push_back({f(mixture_.weights[k]),
                   {f(mean[0]), f(mean[1]), f(mean[2])},
                   {f(l(0, 0)), f(l(1, 0)), f(l(1, 1)), f(l(2, 0)), f(l(2, 1)), f(l(2, 2))}});
  }
  return all;
}

void CellMixture::archive(Archive& archive) {
  archive(pivot_, near_variance_, far_variance_, samples_, since_merge_, mixture_.weights,
          mixture_.components, moments_, tests_, first_);
  if (!archive.loads()) return;
  const std::size_t count = mixture_.weights.size();
  bool is_sound = near_variance_ >= 0 && far_variance_ >= 0 && samples_ >= 0 && since_merge_ >= 0 &&
                  mixture_.components.size() == count && moments_.size() == count &&
                  tests_.size() == count;
  for (std::size_t k = 0; is_sound && k < count; ++k) {
    const Eigen::LLT<Matrix<3>> factor(mixture_.components[k].covariance);
    is_sound =
        mixture_.weights[k] > 0 && moments_[k].weight >= 0 && factor.info() == Eigen::Success;
  }
  archive.expect(is_sound, "the learning of the Gaussians");
}

}  // namespace pharos::spatial_gaussians
