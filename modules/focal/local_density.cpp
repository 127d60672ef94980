#include "local_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pharos::focal {
namespace {

/// A cell of an octree: its level (the children of the root have level 1), and its number along
/// each axis.
struct CellPlace {
  unsigned level = 0;
  std::array<unsigned, 3> at{};

  CellPlace child(unsigned c) const {
    CellPlace place{level + 1, at};
    for (unsigned axis = 0; axis < 3; ++axis) place.at[axis] = 2 * at[axis] + (c >> axis & 1);
    return place;
  }
};

/// Calls `visit(i, c, place)` for each leaf, the child c of node i.
template <class Visit>
void for_each_leaf(const Octree& octree, Visit&& visit) {
  std::vector<CellPlace> places(octree.nodes().size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Octree::Node& node = octree.nodes()[i];
    for (unsigned c = 0; c < 8; ++c) {
      const CellPlace child = places[i].child(c);
      if (node.is_leaf(c)) {
        visit(i, c, child);
      } else {
        places[node.index(c)] = child;
      }
    }
  }
}

/// Calls `visit(voxel, share)` for each voxel that a cell covers or lies in, with the share of the
/// cell that lies in the voxel.
template <class Visit>
void for_each_voxel(const CellPlace& cell, Visit&& visit) {
  const unsigned below = cell.level < kVoxelLevel ? kVoxelLevel - cell.level : 0;
  const unsigned above = cell.level > kVoxelLevel ? cell.level - kVoxelLevel : 0;
  const unsigned edge = 1u << below;
  const double share = std::ldexp(1.0, -3 * static_cast<int>(below));
  const auto voxel = [&](unsigned axis, unsigned i) {
    return std::size_t{(cell.at[axis] >> above) * edge + i} << axis * kVoxelLevel;
  };
  for (unsigned z = 0; z < edge; ++z) {
    for (unsigned y = 0; y < edge; ++y) {
      for (unsigned x = 0; x < edge; ++x) visit(voxel(0, x) + voxel(1, y) + voxel(2, z), share);
    }
  }
}

/// Returns the masses that the octree's density has in the voxels.
VoxelMasses density_in_voxels(const Octree& octree) {
  std::vector<double> masses(8 * octree.nodes().size());
  for_each_leaf(octree, [&](std::uint32_t i, unsigned c, const CellPlace& place) {
    const double volume = std::ldexp(octree.box().volume(), -3 * static_cast<int>(place.level));
    masses[8 * std::size_t{i} + c] = octree.nodes()[i].density(c) * volume;
  });
  VoxelMasses voxels;
  add_to_voxels(octree, masses, voxels);
  return voxels;
}

double sum(const VoxelMasses& masses) {
  return std::accumulate(masses.begin(), masses.end(), 0.0);
}

}  // namespace

std::size_t CellGrid::at(Point3 p) const {
  std::size_t cell = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double place = (p[axis] - box_.low[axis]) / box_.size[axis] * per_axis_;
    const double last = per_axis_ - 1;
    const auto i = static_cast<std::size_t>(std::min(std::max(0.0, place), last));
    cell = cell * static_cast<std::size_t>(per_axis_) + i;
  }
  return cell;
}

void add_to_voxels(const Octree& octree, std::span<const double> masses, VoxelMasses& voxels) {
  voxels.resize(kVoxels);
  for_each_leaf(octree, [&](std::uint32_t i, unsigned c, const CellPlace& place) {
    const double mass = masses[8 * std::size_t{i} + c];
    if (mass == 0) return;
    for_each_voxel(place, [&](std::size_t v, double share) { voxels[v] += share * mass; });
  });
}

Octree reweighted(const Octree& octree, std::span<const double> weights) {
  std::vector<Octree::Node> nodes = octree.nodes();
  for_each_leaf(octree, [&](std::uint32_t i, unsigned c, const CellPlace& place) {
    double weight = 0;
    for_each_voxel(place, [&](std::size_t v, double share) { weight += share * weights[v]; });
    nodes[i].set_density(c, static_cast<float>(weight * nodes[i].density(c)));
  });
  return {octree.box(), std::move(nodes)};
}

void LocalUse::add(std::span<const Segment> segments, const FocalDensity& density,
                   const FocalSums& sums) {
  add_to_voxels(density.converging, sums.converging, converging);
  add_to_voxels(density.diverging, sums.diverging, diverging);
  for (const Segment& segment : segments) {
    const double contribution = segment.contribution;
    contributions += contribution;
    squares += contribution * contribution;
  }
}

LocalUse& LocalUse::operator+=(const LocalUse& other) {
  const auto add = [](VoxelMasses& masses, const VoxelMasses& others) {
    masses.resize(std::max(masses.size(), others.size()));
    for (std::size_t v = 0; v < others.size(); ++v) masses[v] += others[v];
  };
  add(converging, other.converging);
  add(diverging, other.diverging);
  contributions += other.contributions;
  squares += other.squares;
  return *this;
}

void LocalUse::archive(Archive& archive) {
  archive(converging, diverging, contributions, squares);
  bool is_sound = contributions >= 0 && squares >= 0 && converging.size() == diverging.size() &&
                  (converging.empty() || converging.size() == kVoxels);
  for (const VoxelMasses* voxels : {&converging, &diverging}) {
    for (const double mass : *voxels) is_sound &= mass >= 0;
  }
  archive.expect(is_sound, "what was learned of focal points");
}

FocalDensity local_density(const FocalDensity& density, const LocalUse& use, double prior) {
  const double used = sum(use.converging) + sum(use.diverging);
  if (!(used > 0)) return density;
  const double certainty = use.segments() / (use.segments() + prior);
  double total = 0;
  const auto weights = [&](const Octree& octree, const VoxelMasses& uses) {
    std::vector<double> voxels = density_in_voxels(octree);
    for (std::size_t v = 0; v < kVoxels; ++v) {
      const double mass = voxels[v];
      const double weight = 1 - certainty + (mass > 0 ? certainty * uses[v] / used / mass : 0);
      total += weight * mass;
      voxels[v] = weight;
    }
    return voxels;
  };
  std::vector<double> converging = weights(density.converging, use.converging);
  std::vector<double> diverging = weights(density.diverging, use.diverging);
  // Mass of `use` where the density has none cannot be kept.
  for (std::vector<double>* each : {&converging, &diverging}) {
    for (double& weight : *each) weight /= total;
  }
  return {reweighted(density.converging, converging), reweighted(density.diverging, diverging)};
}

}  // namespace pharos::focal
