#include "clustering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>

#include "truncated_normal.h"

namespace pharos::vertex_triplets {
namespace {

/// Number of parameters that a mixture of two Gaussians has beyond a single Gaussian: a mean, a
/// covariance and a weight (55, 28, 10 for D = 9, 6, 3).
template <int D>
constexpr int kAddedParameters = D + D*(D + 1) / 2 + 1;

/// Returns sums about `center` over the points on each side of the plane through `center` across
/// `axis`. The sums of one side are not the difference of two sums, which would have no correct
/// digits where that side has little weight.
template <int D>
std::array<Sums<D>, 2> sums_of_sides(const Points<D>& points, const std::array<float, D>& center,
                                     const std::array<float, D>& axis) {
  std::array<Sums8<D>, 2> sums;
  for (const auto& points8 : points.registers()) {
    std::array<Float8, D> d;
    Float8 along{};
    for (int i = 0; i < D; ++i) {
      d[i] = points8.x[i] - center[i];
      along += d[i] * axis[i];
    }
    sums[0].add(along > 0 ? points8.weight : Float8{}, d);
    sums[1].add(along > 0 ? Float8{} : points8.weight, d);
  }
  return {sums[0].summed(), sums[1].summed()};
}

template <int D>
std::array<float, D> rounded(const Vector<D>& x) {
  std::array<float, D> result;
  for (int i = 0; i < D; ++i) result[i] = static_cast<float>(x[i]);
  return result;
}
template <int D>
Vector<D> widened(const std::array<float, D>& x) {
  Vector<D> result;
  for (int i = 0; i < D; ++i) result[i] = x[i];
  return result;
}

/// Points with the Gaussian fitted to them.
template <int D>
struct Cluster {
  Points<D> points;
  Belief<D> belief;
  Sums<D> sums;  ///< about `center`
  std::array<float, D> center{};
  Gaussian<D> gaussian;
  double log_likelihood = 0;  ///< as in Expectation

  Cluster(Points<D> all, const Regularization& rule, const Belief<D>& believed = {})
      : points(std::move(all)), belief(believed) {
    // The first sums are about any point and yield the mean; the final sums are about the mean.
    for (int i = 0; i < D; ++i) center[i] = points.registers()[0].x[i][0];
    center = rounded<D>(widened<D>(center) + sums_of_all().offset());
    sums = sums_of_all();
    gaussian = most_probable<D>(sums, widened<D>(center), belief, rule);
    const Vector<D> apart = widened<D>(center) + sums.offset() - gaussian.mean;
    log_likelihood =
        mean_log_density<D>(sums.covariance() + apart * apart.transpose(), gaussian.covariance);
  }
  double weight() const { return sums.weight + belief.weight; }

 private:
  Sums<D> sums_of_all() const {
    Sums8<D> all;
    for (const auto& points8 : points.registers()) {
      std::array<Float8, D> d;
      for (int i = 0; i < D; ++i) d[i] = points8.x[i] - center[i];
      all.add(points8.weight, d);
    }
    return all.summed();
  }
};

/// Returns the mixture of two Gaussians for the points on both sides of a plane across an
/// eigenvector, for the plane with the highest likelihood. Returns nothing if no plane separates
/// the points.
template <int D>
std::optional<Mixture<D>> best_halves(const Cluster<D>& cluster, const Regularization& rule) {
  std::optional<Mixture<D>> best;
  double best_score = -std::numeric_limits<double>::infinity();
  const Matrix<D> axes = statistics::eigenvectors<D>(cluster.sums.covariance());
  for (int i = D - 1; i >= 0; --i) {
    const Vector<D> axis = axes.col(i);
    Mixture<D> halves;
    double score = 0;
    for (const Sums<D>& half : sums_of_sides<D>(cluster.points, cluster.center, rounded<D>(axis))) {
      const double share = half.weight / cluster.sums.weight;
      if (!(share > 0) || !(half.squared_weight > 0)) break;
      const Matrix<D> covariance = regularized<D>(half.covariance(), half.count(), rule);
      score += share * (std::log(share) + mean_log_density<D>(half.covariance(), covariance));
      halves.weights.push_back(share);
      halves.components.push_back({widened<D>(cluster.center) + half.offset(), covariance});
    }
    if (halves.size() == 2 && score > best_score) {
      best_score = score;
      best = std::move(halves);
    }
  }
  return best;
}

/// Returns both parts of a cluster. Returns nothing if two Gaussians are no better than one by AIC
/// (eq. 45, per point, with the effective number of points). Nothing is believed of the parts,
/// because the points have refuted the belief in the whole.
template <int D>
std::vector<Cluster<D>> split(const Cluster<D>& cluster, const FitSettings& settings) {
  if (cluster.points.size() < 2) return {};
  const std::optional<Mixture<D>> halves = best_halves(cluster, settings.regularization);
  if (!halves) return {};
  const Fit<D> two = fit(*halves, cluster.points, settings);
  const double gain = cluster.sums.count() * (two.log_likelihood - cluster.log_likelihood);
  if (!(gain > kAddedParameters<D>) || two.mixture.size() < 2) return {};
  const std::vector<std::size_t> owners = assignment(two.mixture, cluster.points);
  std::array<Points<D>, 2> parts;
  for (std::size_t i = 0; i < owners.size(); ++i) parts[owners[i]].add(cluster.points, i);
  if (parts[0].size() == 0 || parts[1].size() == 0) return {};
  return {Cluster<D>(std::move(parts[0]), settings.regularization),
          Cluster<D>(std::move(parts[1]), settings.regularization)};
}

/// The points within a truncated Gaussian.
template <int D>
class Support {
 public:
  explicit Support(const Gaussian<D>& gaussian)
      : mean_(gaussian.mean), factor_(gaussian.covariance) {}

  bool contains(const Vector<D>& x) const {
    const Vector<D> z = factor_.matrixL().solve(x - mean_);
    return z.cwiseAbs().maxCoeff() <= kTruncation;
  }

 private:
  Vector<D> mean_;
  Eigen::LLT<Matrix<D>> factor_;
};

/// Returns the points by the belief that explains them best, followed by the points that no belief
/// explains. With `always`, the best belief gets these points, too.
template <int D>
std::vector<Points<D>> points_by_belief(const Points<D>& points, const Beliefs<D>& beliefs,
                                        bool always) {
  std::vector<Support<D>> supports;
  for (const Belief<D>& belief : beliefs) supports.emplace_back(belief.gaussian);
  const std::vector<std::size_t> owners = assignment(believed_mixture<D>(beliefs), points);
  std::vector<Points<D>> parts(beliefs.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector<D> x = widened<D>(points.at(i));
    const bool is_explained =
        always || std::any_of(supports.begin(), supports.end(),
                              [&](const Support<D>& s) { return s.contains(x); });
    parts[is_explained ? owners[i] : beliefs.size()].add(points, i);
  }
  return parts;
}

/// Returns a cluster in which `belief` holds if its points do not refute it: if a Gaussian fitted
/// to the points alone is no better by AIC, as the second Gaussian of a split.
template <int D>
Cluster<D> believing_cluster(Points<D> points, const Regularization& rule,
                             const Belief<D>& belief) {
  Cluster<D> own(points, rule);
  if (!(belief.weight > 0)) return own;
  Cluster<D> believing(std::move(points), rule, belief);
  const double gain = own.sums.count() * (own.log_likelihood - believing.log_likelihood);
  return gain > kAddedParameters<D> ? own : believing;
}

/// The clusters before any is split, and the beliefs without points.
template <int D>
struct FirstClusters {
  std::vector<Cluster<D>> clusters;
  Beliefs<D> unseen;
};

template <int D>
FirstClusters<D> first_clusters(const Points<D>& points, const ClusterSettings& settings,
                                const Beliefs<D>& beliefs) {
  const Regularization& rule = settings.fit.regularization;
  if (beliefs.empty()) return {{Cluster<D>(points, rule)}, {}};
  const bool has_room = beliefs.size() < settings.most_components;
  std::vector<Points<D>> parts = points_by_belief(points, beliefs, !has_room);
  FirstClusters<D> first;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Belief<D> belief = belief_in(beliefs, k);
    if (parts[k].size() > 0) {
      first.clusters.push_back(believing_cluster(std::move(parts[k]), rule, belief));
    } else if (k < beliefs.size()) {
      first.unseen.push_back(belief);
    }
  }
  return first;
}

/// Returns the mixture of the clusters and of the beliefs without points. Components of which
/// something is believed come first.
template <int D>
Clusters<D> joined(const std::vector<Cluster<D>>& clusters, const Beliefs<D>& unseen) {
  double total = weight_of<D>(unseen);
  for (const Cluster<D>& cluster : clusters) total += cluster.weight();
  Clusters<D> found;
  const auto add = [&](double weight, const Gaussian<D>& gaussian) {
    found.mixture.weights.push_back(weight / total);
    found.mixture.components.push_back(gaussian);
  };
  const auto add_clusters = [&](bool with_belief) {
    for (const Cluster<D>& cluster : clusters) {
      if ((cluster.belief.weight > 0) != with_belief) continue;
      add(cluster.weight(), cluster.gaussian);
      found.points.add(cluster.points);
      if (with_belief) found.beliefs.push_back(cluster.belief);
    }
  };
  add_clusters(true);
  for (const Belief<D>& belief : unseen) {
    add(belief.weight, belief.gaussian);
    found.beliefs.push_back(belief);
  }
  add_clusters(false);
  return found;
}

}  // namespace

template <int D>
Clusters<D> find_clusters(const Points<D>& points, const ClusterSettings& settings,
                          const Beliefs<D>& beliefs) {
  FirstClusters<D> first = first_clusters(points, settings, beliefs);
  std::vector<Cluster<D>>& clusters = first.clusters;
  const auto is_better = [&](std::size_t a, std::size_t b) {
    return clusters[a].log_likelihood > clusters[b].log_likelihood;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(is_better)> open(is_better);
  for (std::size_t i = 0; i < clusters.size(); ++i) open.push(i);
  while (!open.empty() && clusters.size() + first.unseen.size() < settings.most_components) {
    const std::size_t worst = open.top();
    open.pop();
    std::vector<Cluster<D>> parts = split(clusters[worst], settings.fit);
    if (parts.empty()) continue;
    clusters[worst] = std::move(parts[0]);
    clusters.push_back(std::move(parts[1]));
    open.push(worst);
    open.push(clusters.size() - 1);
  }
  return joined(clusters, first.unseen);
}

template <int D>
Mixture<D> fit_clusters(const Points<D>& points, const ClusterSettings& settings,
                        const Beliefs<D>& beliefs) {
  if (points.size() == 0) return believed_mixture<D>(beliefs);
  const Clusters<D> start = find_clusters(points, settings, beliefs);
  return fit(start.mixture, start.points, settings.fit, start.beliefs).mixture;
}

#define PHAROS_FOR_DIMENSION(D)                                                   \
  template Mixture<D> fit_clusters<D>(const Points<D>&, const ClusterSettings&,   \
                                      const Beliefs<D>&);                         \
  template Clusters<D> find_clusters<D>(const Points<D>&, const ClusterSettings&, \
                                        const Beliefs<D>&);
PHAROS_FOR_DIMENSION(3)
PHAROS_FOR_DIMENSION(6)
PHAROS_FOR_DIMENSION(9)
#undef PHAROS_FOR_DIMENSION

}  // namespace pharos::vertex_triplets
