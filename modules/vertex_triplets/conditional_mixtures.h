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

/// The prefix of a path, for which conditionals are asked. On paths from lights, `previous` is the
/// vertex toward the light.
struct PathPrefix {
  Point3 previous, current;  ///< environment vertices are at EnvironmentShell::at()
  VertexKind previous_kind = VertexKind::surface;
  EventMask events = EventMask::all;  ///< events that are possible at `current`
};

/// A component given the prefix: a truncated Gaussian of the next vertex, the event at the current
/// vertex, and the kind of the next one. The weight is the component's share.
struct NextVertex {
  SpatialGaussian gaussian;
  Event event = Event::none;
  VertexKind kind = VertexKind::surface;
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
  std::size_t component_count() const { return next_.size(); }
  std::size_t size_bytes() const;

  /// Returns the mixture of the next vertex given the prefix (eq. 18, 21), allocated in `arena`.
  /// Components are left out if their mode contradicts the prefix or their support does not contain
  /// it. The shares of the others add up to one. Returns an empty span if no component is left.
  std::span<const NextVertex> given(std::size_t cell, const PathPrefix& prefix, Arena& arena) const;

 private:
  /// The parts of eight components that concern the prefix.
  struct Group {
    std::array<Float8, P> mean;
    std::array<Float8, triangle(P)> factor;  ///< as in Component
    Float8 log2_weight;  ///< includes the factor of the density that is independent of the prefix
  };
  /// The part of one component that concerns the next vertex.
  struct Next {
    float weight;
    std::array<float, 3> mean;
    std::array<float, 3 * P> gain;  ///< L21 by rows
    std::array<float, 6> cholesky;  ///< L22, as in SpatialGaussian
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
