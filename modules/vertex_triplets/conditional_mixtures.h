#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/arena.h>
#include <pharos/core/simd.h>
#include <pharos/guiding/contract/spatial_gaussian.h>

#include "component.h"
#include "next_group.h"
#include "truncated_normal.h"

namespace pharos::vertex_triplets {

/// The prefix of a path, for which conditionals are asked. On paths from lights, `previous` is the
/// vertex toward the light.
struct PathPrefix {
  Point3 previous, current;  ///< environment vertices are at EnvironmentShell::at()
  VertexKind previous_kind = VertexKind::surface;
  EventMask events = EventMask::all;  ///< events that are possible at `current`
  /// The largest root mean square distance of the coordinates from the mean of the nearest
  /// component [standard deviations]. Prefixes that are further away are unknown.
  float most_deviations = kTruncation;
};

/// Mixtures over a prefix of P dimensions and the next vertex, one for each cell. Components of the
/// same mode are stored together, in groups of eight.
template <int P>
class ConditionalMixtures {
 public:
  /// The end at which paths begin. For from_sensor, the prefix is (before, current), and the next
  /// vertex is `after`. For from_lights, `before` and `after` are exchanged.
  enum class Direction { from_sensor, from_lights };

  /// Components of one mode. Their weights are shares of the whole mixture of the cell.
  struct Run {
    Mode mode;
    std::vector<Component<P>> components;
    void archive(Archive& archive) {
      archive(mode, components);
      archive.expect(!components.empty(), "the model of vertex triplets");
    }
  };

  explicit ConditionalMixtures(Direction direction) : direction_(direction) {}

  /// Adds the mixture of the next cell, which has this center.
  void add_cell(Point3 center, std::span<const Run> runs);

  std::size_t cell_count() const { return cells_.size(); }
  /// Returns whether a cell has any component.
  bool knows_something(std::size_t cell) const { return cells_[cell].run_count > 0; }
  Point3 center(std::size_t cell) const { return cells_[cell].center; }
  /// Returns the mixture of a cell as it was added.
  std::vector<Run> runs(std::size_t cell) const;
  std::size_t component_count() const { return component_count_; }
  std::size_t size_bytes() const;

  /// Returns the mixture of the next vertex given the prefix (eq. 18, 21), allocated in `arena`.
  /// Components are left out if their mode contradicts the prefix or their support does not contain
  /// it. The shares of the others add up to one. Returns an empty span if no component is left, or
  /// if all are further away than PathPrefix::most_deviations.
  std::span<const NextGroup> given(std::size_t cell, const PathPrefix& prefix, Arena& arena) const;

 private:
  /// The parts of eight components that concern the prefix.
  struct Group {
    std::array<Float8, P> mean;
    std::array<Float8, triangle(P)> factor;  ///< as in Component
    Float8 log2_weight;  ///< includes the factor of the density that is independent of the prefix
  };
  /// The parts of eight components that concern the next vertex.
  struct NextPart {
    Float8 weight;
    std::array<Float8, 3> mean;
    std::array<Float8, 3 * P> gain;  ///< L21 by rows
    std::array<Float8, 6> cholesky;  ///< L22, as in SpatialGaussian
  };
  struct ModeRun {
    Mode mode;
    std::uint32_t first_group, count;

    std::uint32_t group_count() const { return (count + 7) / 8; }
  };
  struct Cell {
    Point3 center;
    std::uint32_t first_run, run_count, group_count;
  };
  struct Weighed;

  bool admits(const Mode& mode, const PathPrefix& prefix) const;
  /// Adds a group without components and returns its index.
  std::size_t add_group();
  void weigh(const Group& group, const std::array<float, P>& prefix, Weighed& weighed) const;
  void fill_next(const Weighed& weighed, Point3 center, NextGroup& next) const;

  Direction direction_;
  std::vector<Cell> cells_;
  std::vector<ModeRun> runs_;
  std::vector<Group> groups_;
  std::vector<NextPart> next_parts_;  ///< indexed like groups_
  std::size_t component_count_ = 0;
};

}  // namespace pharos::vertex_triplets
