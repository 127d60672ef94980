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

/// Components of one mode that a cell inherited, and the weight for which they count.
template <int P>
struct InheritedRun {
  std::vector<Component<P>> components;
  double total = 0;  ///< weight of the whole inheritance [as of samples]

  double weight() const {
    double share = 0;
    for (const Component<P>& component : components) share += component.weight;
    return total * share;
  }
};

/// Returns the beliefs in the coordinates of points. `origin` is the origin of the points,
/// and `scale` the weight of a point with the weight 1.
template <int P>
Beliefs<P + 3> beliefs_of(const InheritedRun<P>& run, const Coordinates<P + 3>& coordinates,
                          const Vector<P + 3>& origin, double scale) {
  Beliefs<P + 3> beliefs;
  for (const Component<P>& component : run.components) {
    Belief<P + 3>& belief = beliefs.emplace_back();
    belief.weight = scale * run.total * component.weight;
    Matrix<P + 3> l = component.cholesky();
    for (int i = 0; i < P + 3; ++i) {
      belief.gaussian.mean[i] = component.mean[i] / coordinates.unit[i] - origin[i];
      l.row(i) /= coordinates.unit[i];
    }
    belief.gaussian.covariance = l * l.transpose();
  }
  return beliefs;
}

/// Least weight of a point relative to the mean weight. Squares of smaller weights underflow
/// floats.
constexpr double kLeastPointWeight = 1e-12;

/// Fits the mixture of a group, relative to the center of its cell [scene units].
/// `beliefs_about(origin, scale)` returns the beliefs as beliefs_of() does.
template <int D, class BeliefsAbout>
Mixture<D> fit_group(const Group& group, const Coordinates<D>& coordinates,
                     const ClusterSettings& settings, BeliefsAbout&& beliefs_about) {
  // Points are relative to their mean, where single precision has the most digits.
  Vector<D> mean = Vector<D>::Zero();
  for (std::size_t i = 0; i < group.triplets.size(); ++i) {
    const std::array<double, D> x = coordinates.of(*group.triplets[i]);
    mean += group.weights[i] / group.weight * Eigen::Map<const Vector<D>>(x.data());
  }
  const double to_mean_one =
      group.weight > 0 ? static_cast<double>(group.triplets.size()) / group.weight : 1;
  Points<D> points;
  for (std::size_t i = 0; i < group.triplets.size(); ++i) {
    const double weight = group.weights[i] * to_mean_one;
    if (!(weight > kLeastPointWeight)) continue;
    const std::array<double, D> x = coordinates.of(*group.triplets[i]);
    std::array<float, D> centered;
    for (int axis = 0; axis < D; ++axis) centered[axis] = static_cast<float>(x[axis] - mean[axis]);
    points.add(centered, static_cast<float>(weight));
  }
  Mixture<D> mixture = fit_clusters<D>(points, settings, beliefs_about(mean, to_mean_one));
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
typename ConditionalMixtures<P>::Run fit_run(const Mode& mode, const Group& group,
                                             const InheritedRun<P>& inherited, double share,
                                             const Cube& cell, const FitRule& rule) {
  const Coordinates<P + 3> coordinates(cell, rule.kind.environment.radius, mode);
  ClusterSettings settings = rule.clusters;
  if (rule.translation) {
    Regularization& regularization = settings.fit.regularization;
    regularization.shift = kEvenDeviation;
    regularization.shift_of_last = kEvenDeviation * cell.size / coordinates.unit[P];
  }
  const Mixture<P + 3> mixture =
      fit_group(group, coordinates, settings, [&](const Vector<P + 3>& origin, double scale) {
        return beliefs_of(inherited, coordinates, origin, scale);
      });
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
  const Mixture<3> mixture = fit_group(group, Coordinates<3>(cell, 1, Mode{}), rule.clusters,
                                       [](const Vector<3>&, double) { return Beliefs<3>{}; });
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

/// Returns the mixtures of all modes. `total` is the weight of all samples of the cell, and
/// `inherited` the weight of its inheritance.
template <int P>
std::vector<typename ConditionalMixtures<P>::Run> fit_runs(
    std::map<Mode, Group> groups, double total,
    const std::vector<typename ConditionalMixtures<P>::Run>& inheritance, double inherited,
    const Cube& cell, const FitRule& rule) {
  std::map<Mode, InheritedRun<P>> inherited_runs;
  for (const auto& run : inheritance) {
    groups.try_emplace(run.mode);
    inherited_runs[run.mode] = {run.components, inherited};
  }
  std::vector<typename ConditionalMixtures<P>::Run> runs;
  for (const auto& [mode, group] : groups) {
    const InheritedRun<P>& of_mode = inherited_runs[mode];
    const double share = (group.weight + of_mode.weight()) / (total + inherited);
    auto run = fit_run<P>(mode, group, of_mode, share, cell, rule);
    if (!run.components.empty()) runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

CellFit fit_cell(const Reservoir& reservoir, const Cube& cell, const FitRule& rule,
                 const Inheritance& inheritance) {
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
  double inherited = 0;
  if (!inheritance.empty()) {
    inherited = total > 0 ? rule.inherit * total / reservoir.effective_size() : 1;
  }
  if (pairs) {
    fit.knowledge.pairs =
        fit_runs<3>(std::move(groups), total, inheritance.pairs, inherited, cell, rule);
  } else {
    fit.knowledge.triplets =
        fit_runs<6>(std::move(groups), total, inheritance.triplets, inherited, cell, rule);
  }
  for (const auto& [kind, group] : first_vertices) {
    fit_first_vertices(group, kind, cell, rule, fit.camera);
  }
  return fit;
}

}  // namespace pharos::vertex_triplets
