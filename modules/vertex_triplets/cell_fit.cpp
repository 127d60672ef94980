#include "cell_fit.h"

#include <cmath>
#include <map>

namespace pharos::vertex_triplets {
namespace {

/// Converts triplets to the coordinates of points of D dimensions. `unit` has the unit of each.
template <int D>
struct Coordinates {
  Coordinates(const Cube& cell, float environment, const Mode& mode) : center(cell.center) {
    for (int i = 0; i < D; ++i) unit[i] = cell.size;
    const bool is_far = mode.after == VertexKind::environment && D > 3;
    for (int i = D - 3; is_far && i < D; ++i) unit[i] = environment;
  }

  /// Returns the coordinates of the last vertices of a triplet: three for D = 9, two for D = 6. For
  /// D = 3 (first vertices), it is the middle one.
  std::array<double, D> of(const Triplet& triplet) const {
    constexpr int kFirst = D == 9 ? 0 : 1;
    std::array<double, D> x;
    for (int i = 0; i < D; ++i) {
      const int axis = i % 3;
      x[i] = (double{triplet.vertices[kFirst + i / 3][axis]} - center[axis]) / unit[i];
    }
    return x;
  }

  Point3 center;
  std::array<double, D> unit;
};

/// Samples of one mode.
struct Group {
  std::vector<const Triplet*> triplets;
  std::vector<double> weights;
  double weight = 0;

  void add(const Triplet& triplet, double w) {
    triplets.push_back(&triplet);
    weights.push_back(w);
    weight += w;
  }
};

/// Least weight of a point relative to the mean weight. Squares of smaller weights underflow
/// floats.
constexpr double kLeastPointWeight = 1e-12;

/// Fits the mixture of a group, relative to the center of its cell [scene units].
template <int D>
Mixture<D> fit_group(const Group& group, const Coordinates<D>& coordinates,
                     const ClusterSettings& settings) {
  // Points are relative to their mean, where single precision has the most digits.
  Vector<D> mean = Vector<D>::Zero();
  for (std::size_t i = 0; i < group.triplets.size(); ++i) {
    const std::array<double, D> x = coordinates.of(*group.triplets[i]);
    mean += group.weights[i] / group.weight * Eigen::Map<const Vector<D>>(x.data());
  }
  const double to_mean_one = static_cast<double>(group.triplets.size()) / group.weight;
  Points<D> points;
  for (std::size_t i = 0; i < group.triplets.size(); ++i) {
    const double weight = group.weights[i] * to_mean_one;
    if (!(weight > kLeastPointWeight)) continue;
    const std::array<double, D> x = coordinates.of(*group.triplets[i]);
    std::array<float, D> centered;
    for (int axis = 0; axis < D; ++axis) centered[axis] = static_cast<float>(x[axis] - mean[axis]);
    points.add(centered, static_cast<float>(weight));
  }
  Mixture<D> mixture = fit_clusters(points, settings);
  const Vector<D> unit = Eigen::Map<const Vector<D>>(coordinates.unit.data());
  for (Gaussian<D>& gaussian : mixture.components) {
    gaussian.mean = unit.cwiseProduct(gaussian.mean + mean);
    gaussian.covariance = unit.asDiagonal() * gaussian.covariance * unit.asDiagonal();
  }
  return mixture;
}

/// Components with smaller weights are not worth keeping in single precision.
constexpr double kLeastWeight = 1e-9;

/// Standard deviation of a point that is evenly distributed over a cell, along each axis [edges].
const double kEvenDeviation = std::sqrt(1.0 / 12);

template <int P>
typename ConditionalMixtures<P>::Run fit_run(const Mode& mode, const Group& group, double share,
                                             const Cube& cell, const FitRule& rule) {
  const Coordinates<P + 3> coordinates(cell, rule.kind.environment.radius, mode);
  ClusterSettings settings = rule.clusters;
  if (rule.translation) {
    Regularization& regularization = settings.fit.regularization;
    regularization.shift = kEvenDeviation;
    regularization.shift_of_last = kEvenDeviation * cell.size / coordinates.unit[P];
  }
  const Mixture<P + 3> mixture = fit_group(group, coordinates, settings);
  typename ConditionalMixtures<P>::Run run{mode, {}};
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const double weight = share * mixture.weights[k];
    if (!(weight > kLeastWeight)) continue;
    const Component<P> component = make_component<P>(weight, mixture.components[k]);
    if (component.is_sound()) run.components.push_back(component);
  }
  return run;
}

void fit_first_vertices(const Group& group, VertexKind kind, const Cube& cell, const FitRule& rule,
                        std::vector<FirstVertex>& camera) {
  const Mixture<3> mixture = fit_group(group, Coordinates<3>(cell, 1, Mode{}), rule.clusters);
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const Gaussian<3>& g = mixture.components[k];
    const Eigen::LLT<Matrix<3>> factor(g.covariance);
    if (factor.info() != Eigen::Success) continue;
    const Matrix<3> l = factor.matrixL();
    FirstVertex& first = camera.emplace_back();
    first.kind = kind;
    first.gaussian.weight = static_cast<float>(group.weight * mixture.weights[k]);
    for (int row = 0, i = 0; row < 3; ++row) {
      first.gaussian.mean[row] = cell.center[row] + static_cast<float>(g.mean[row]);
      for (int column = 0; column <= row; ++column) {
        first.gaussian.cholesky[i++] = static_cast<float>(l(row, column));
      }
    }
  }
}

}  // namespace

CellFit fit_cell(const Reservoir& reservoir, const Cube& cell, const FitRule& rule) {
  const bool pairs = rule.kind.prefix == Prefix::pair;
  std::map<Mode, Group> groups;
  std::map<VertexKind, Group> first_vertices;
  double total = 0;
  reservoir.for_each([&](const Triplet& triplet, double weight) {
    Mode mode = triplet.mode;
    // Pairs do not depend on the previous vertex.
    if (pairs) mode.before = VertexKind::surface;
    total += weight;
    const bool can_guide = mode.after != VertexKind::light || rule.kind.both_ways;
    if (can_guide) groups[mode].add(triplet, weight);
    if (triplet.mode.before != VertexKind::sensor) return;
    const bool in_volume = triplet.mode.event == Event::scatter;
    first_vertices[in_volume ? VertexKind::volume : VertexKind::surface].add(triplet, weight);
  });
  CellFit fit;
  fit.knowledge.share = static_cast<float>(total);
  for (const auto& [mode, group] : groups) {
    const double share = group.weight / total;
    if (pairs) {
      auto run = fit_run<3>(mode, group, share, cell, rule);
      if (!run.components.empty()) fit.knowledge.pairs.push_back(std::move(run));
    } else {
      auto run = fit_run<6>(mode, group, share, cell, rule);
      if (!run.components.empty()) fit.knowledge.triplets.push_back(std::move(run));
    }
  }
  for (const auto& [kind, group] : first_vertices) {
    fit_first_vertices(group, kind, cell, rule, fit.camera);
  }
  return fit;
}

}  // namespace pharos::vertex_triplets
