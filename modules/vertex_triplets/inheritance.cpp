#include "inheritance.h"

#include <cmath>

#include "truncated_normal.h"

namespace pharos::vertex_triplets {
namespace {

/// Components with less of the divided cell's weight in the part are left out.
constexpr double kLeastShare = 1e-3;

/// Returns the probability that the current vertex of a component is in a cube. The component is
/// relative to `origin` [scene units].
template <int P>
double probability_in(const Cube& cube, const Component<P>& component, Point3 origin) {
  const statistics::Matrix<P + 3> l = component.cholesky();
  double probability = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int row = P - 3 + axis;
    const double deviation = l.row(row).norm();
    const double offset =
        double{cube.center[axis]} - double{origin[axis]} - double{component.mean[row]};
    const double half = 0.5 * cube.size;
    probability *=
        normal_below((offset + half) / deviation) - normal_below((offset - half) / deviation);
  }
  return probability;
}

template <int P>
using Runs = std::vector<typename ConditionalMixtures<P>::Run>;

template <class Runs>
double sum_of_weights(const Runs& runs) {
  double sum = 0;
  for (const auto& run : runs) {
    for (const auto& component : run.components) sum += component.weight;
  }
  return sum;
}

template <int P>
Runs<P> inherited(Runs<P> runs, const Cube& divided, const Cube& part) {
  const double all = sum_of_weights(runs);
  const Vec3 shift = divided.center - part.center;
  for (auto& run : runs) {
    for (Component<P>& component : run.components) {
      component.weight *= static_cast<float>(probability_in(part, component, divided.center));
      for (int i = 0; i < P + 3; ++i) component.mean[i] += shift[i % 3];
    }
  }
  for (auto& run : runs) {
    std::erase_if(run.components,
                  [&](const Component<P>& c) { return !(c.weight > kLeastShare * all); });
  }
  std::erase_if(runs, [](const auto& run) { return run.components.empty(); });
  const double kept = sum_of_weights(runs);
  for (auto& run : runs) {
    for (Component<P>& component : run.components) {
      component.weight = static_cast<float>(component.weight / kept);
    }
  }
  return runs;
}

}  // namespace

Inheritance inheritance(const CellKnowledge& knowledge, const Cube& divided, const Cube& part) {
  return {inherited<3>(knowledge.pairs, divided, part),
          inherited<6>(knowledge.triplets, divided, part)};
}

}  // namespace pharos::vertex_triplets
