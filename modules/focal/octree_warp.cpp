#include "octree_warp.h"

#include <numeric>

namespace pharos::focal {
namespace {

/// Returns the mean density of child c of a node.
double mean_of_child(const OctreeNode& node, unsigned c, const std::vector<double>& means) {
  return node.is_leaf(c) ? node.density(c) : means[node.index(c)];
}

/// Returns the mean density of each node's cell.
std::vector<double> mean_densities(const std::vector<OctreeNode>& nodes) {
  std::vector<double> means(nodes.size());
  // Children are stored after their parents.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    for (unsigned c = 0; c < 8; ++c) means[i] += 0.125 * mean_of_child(nodes[i], c, means);
  }
  return means;
}

/// Returns the number of a cell in a grid of 4 x 4 x 4 cells: child `g` of child `c`.
unsigned cell_of(unsigned c, unsigned g) {
  unsigned cell = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    cell += (2 * (c >> axis & 1) + (g >> axis & 1)) << (2 * axis);
  }
  return cell;
}

}  // namespace

template <unsigned N>
void OctreeWarp::Choice<N>::set(const std::array<double, N>& weights) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0;
  for (unsigned i = 0; i < N; ++i) {
    begin[i] = total > 0 ? sum / total : static_cast<double>(i) / N;
    sum += weights[i];
  }
  for (unsigned i = 0; i < N; ++i) {
    const double length = (i + 1 < N ? begin[i + 1] : 1) - begin[i];
    // Bounded, because an interval near 0 may be too short for the reciprocal to be a float. Only
    // the number 0 lies in such an interval, and stays 0.
    constexpr double kLargestScale = 0x1p100;
    scale[i] = length > 0 ? static_cast<float>(std::min(1 / length, kLargestScale)) : 0;
  }
}

template <unsigned N>
void OctreeWarp::Warp<N>::set(const std::array<double, N * N * N>& masses) {
  std::array<double, N> slices{};
  for (unsigned i = 0; i < N; ++i) {
    std::array<double, N> columns{};
    for (unsigned j = 0; j < N; ++j) {
      std::array<double, N> cells;
      for (unsigned k = 0; k < N; ++k) {
        cells[k] = masses[i + N * (j + N * k)];
        columns[j] += cells[k];
      }
      z[i + N * j].set(cells);
      slices[i] += columns[j];
    }
    y[i].set(columns);
  }
  x.set(slices);
}

OctreeWarp::OctreeWarp(const std::vector<OctreeNode>& nodes) {
  const std::vector<double> means = mean_densities(nodes);
  mean_density_ = means[0];
  first_ = add(nodes, means, 0);
}

OctreeWarp::Next OctreeWarp::add(const std::vector<OctreeNode>& nodes,
                                 const std::vector<double>& means, std::size_t i) {
  const OctreeNode& node = nodes[i];
  if (node.inner_bits() == 0) {
    std::array<double, 8> masses;
    for (unsigned c = 0; c < 8; ++c) masses[c] = node.density(c);
    twos_.emplace_back().set(masses);
    return Next::two(twos_.size() - 1);
  }
  const std::size_t index = fours_.size();
  fours_.emplace_back();
  std::array<double, 64> masses;
  for (unsigned c = 0; c < 8; ++c) {
    for (unsigned g = 0; g < 8; ++g) {
      const unsigned cell = cell_of(c, g);
      masses[cell] = mean_of_child(node, c, means);
      if (node.is_leaf(c)) continue;
      const OctreeNode& child = nodes[node.index(c)];
      masses[cell] = mean_of_child(child, g, means);
      if (!child.is_leaf(g)) {
        const Next next = add(nodes, means, child.index(g));
        fours_[index].next[cell] = next;
      }
    }
  }
  fours_[index].warp.set(masses);
  return Next::four(index);
}

std::array<double, 3> OctreeWarp::sample(std::array<double, 3> u) const {
  double edge = 1;                        // edge of the cell
  std::array<std::uint32_t, 3> corner{};  // corner of the cell, in units of its edge
  const auto descend = [&](unsigned factor, const std::array<unsigned, 3>& cell) {
    for (int axis = 0; axis < 3; ++axis) corner[axis] = factor * corner[axis] + cell[axis];
    edge /= factor;
  };
  for (Next next = first_; !next.is_leaf();) {
    if (next.is_two()) {
      descend(2, twos_[next.index()].choose(u));
      break;
    }
    const Four& four = fours_[next.index()];
    const std::array<unsigned, 3> cell = four.warp.choose(u);
    descend(4, cell);
    next = four.next[cell[0] + 4 * (cell[1] + 4 * cell[2])];
  }
  for (int axis = 0; axis < 3; ++axis) u[axis] = (corner[axis] + u[axis]) * edge;
  return u;
}

}  // namespace pharos::focal
