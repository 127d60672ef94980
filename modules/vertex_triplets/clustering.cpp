#include "clustering.h"

#include <cmath>
#include <limits>
#include <optional>
#include <queue>

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

/// Returns the mean of log N(x) over points whose covariance about the Gaussian's mean is `sample`.
template <int D>
double mean_log_density(const Matrix<D>& sample, const Matrix<D>& covariance) {
  const Eigen::LLT<Matrix<D>> factor(covariance);
  const double log_determinant = 2 * Matrix<D>(factor.matrixL()).diagonal().array().log().sum();
  return -0.5 * (D * std::log(2 * EIGEN_PI) + log_determinant + factor.solve(sample).trace());
}

/// Points with the Gaussian fitted to them.
template <int D>
struct Cluster {
  Points<D> points;
  Sums<D> sums;  ///< about `center`
  std::array<float, D> center{};
  Gaussian<D> gaussian;
  double log_likelihood = 0;  ///< as in Expectation

  Cluster(Points<D> all, const Regularization& rule) : points(std::move(all)) {
    // The first sums are about any point and yield the mean; the final sums are about the mean.
    for (int i = 0; i < D; ++i) center[i] = points.registers()[0].x[i][0];
    center = rounded<D>(widened<D>(center) + sums_of_all().offset());
    sums = sums_of_all();
    gaussian = {widened<D>(center) + sums.offset(),
                regularized<D>(sums.covariance(), sums.count(), rule)};
    log_likelihood = mean_log_density<D>(sums.covariance(), gaussian.covariance);
  }

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
  const Eigen::SelfAdjointEigenSolver<Matrix<D>> eigen(cluster.sums.covariance());
  for (int i = D - 1; i >= 0; --i) {
    const Vector<D> axis = eigen.eigenvectors().col(i);
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
/// (eq. 45, per point, with the effective number of points).
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

}  // namespace

template <int D>
Clusters<D> find_clusters(const Points<D>& points, const ClusterSettings& settings) {
  std::vector<Cluster<D>> clusters{Cluster<D>(points, settings.fit.regularization)};
  const auto is_better = [&](std::size_t a, std::size_t b) {
    return clusters[a].log_likelihood > clusters[b].log_likelihood;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(is_better)> open(is_better);
  open.push(0);
  while (!open.empty() && clusters.size() < settings.most_components) {
    const std::size_t worst = open.top();
    open.pop();
    std::vector<Cluster<D>> parts = split(clusters[worst], settings.fit);
    if (parts.empty()) continue;
    clusters[worst] = std::move(parts[0]);
    clusters.push_back(std::move(parts[1]));
    open.push(worst);
    open.push(clusters.size() - 1);
  }
  double total = 0;
  for (const Cluster<D>& cluster : clusters) total += cluster.sums.weight;
  Clusters<D> found;
  for (const Cluster<D>& cluster : clusters) {
    found.mixture.weights.push_back(cluster.sums.weight / total);
    found.mixture.components.push_back(cluster.gaussian);
    found.points.add(cluster.points);
  }
  return found;
}

template <int D>
Mixture<D> fit_clusters(const Points<D>& points, const ClusterSettings& settings) {
  const Clusters<D> start = find_clusters(points, settings);
  return fit(start.mixture, start.points, settings.fit).mixture;
}

#define PHAROS_FOR_DIMENSION(D)                                                  \
  template Mixture<D> fit_clusters<D>(const Points<D>&, const ClusterSettings&); \
  template Clusters<D> find_clusters<D>(const Points<D>&, const ClusterSettings&);
PHAROS_FOR_DIMENSION(3)
PHAROS_FOR_DIMENSION(6)
PHAROS_FOR_DIMENSION(9)
#undef PHAROS_FOR_DIMENSION

}  // namespace pharos::vertex_triplets
