#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/arena.h>
#include <pharos/core/simd.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "component.h"
#include "truncated_normal.h"

namespace pharos::vertex_triplets {

/// Where a path stands and what is known of it. Along paths from lights `previous` lies towards the
/// light.
struct PathPrefix {
  Point3 previous, current;  ///< an environment at EnvironmentShell::at()
  VertexKind previous_kind = VertexKind::surface;
  EventMask events = EventMask::all;  ///< that may happen at `current`
};

/// A component given the prefix: a truncated Gaussian of the next vertex, and what the step to it
/// is. The weight is the component's share.
struct NextVertex {
  SpatialGaussian gaussian;
  Event event = Event::none;
  VertexKind kind = VertexKind::surface;
};

/// Mixtures over a prefix of P dimensions and the next vertex, one for each cell. Components of one
/// mode stand together, eight side by side.
template <int P>
class ConditionalMixtures {
 public:
  /// Which end paths come from. from_sensor: the prefix is (before, current), and `after` is next;
  /// from_lights: the other way round.
  enum class Direction { from_sensor, from_lights };

  /// Components of one mode, whose weights are shares of the whole mixture.
  struct Run {
    Mode mode;
    std::vector<Component<P>> components;
  };

  explicit ConditionalMixtures(Direction direction) : direction_(direction) {}

  /// Adds the mixture of the next cell, whose middle is `center`.
  void add_cell(Point3 center, std::span<const Run> runs);

  std::size_t cell_count() const { return cells_.size(); }
  Point3 center(std::size_t cell) const { return cells_[cell].center; }
  /// The mixture of a cell as it was added.
  std::vector<Run> runs(std::size_t cell) const;
  std::size_t component_count() const { return next_.size(); }
  std::size_t size_bytes() const;

  /// The mixture of the next vertex given the prefix (eq. 18, 21): components whose mode
  /// contradicts it or whose support does not hold it are left out, the others' shares add up to
  /// one. Empty: nothing is known. Lives in `arena`.
  std::span<const NextVertex> given(std::size_t cell, const PathPrefix& prefix, Arena& arena) const;

 private:
  /// Eight components as a prefix sees them.
  struct Group {
    std::array<Float8, P> mean;
    std::array<Float8, triangle(P)> factor;  ///< as Component's
    Float8 log2_weight;  ///< with the factor of the density that the prefix does not change
  };
  /// And the rest of one of them.
  struct Next {
    float weight;
    std::array<float, 3> mean;
    std::array<float, 3 * P> gain;  ///< L21 by rows
    std::array<float, 6> cholesky;  ///< L22, as SpatialGaussian's
  };
  struct ModeRun {
    Mode mode;
    std::uint32_t first_group, first_next, count;
  };
  struct Cell {
    Point3 center;
    std::uint32_t first_run, run_count, group_count;
  };
  struct Weighed;

  bool admits(const Mode& mode, const PathPrefix& prefix) const;
  NextVertex next_of(const Weighed& weighed, int lane, Point3 center) const;

  Direction direction_;
  std::vector<Cell> cells_;
  std::vector<ModeRun> runs_;
  std::vector<Group> groups_;
  std::vector<Next> next_;
};

}  // namespace pharos::vertex_triplets
