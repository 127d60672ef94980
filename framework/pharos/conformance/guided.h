#pragma once

#include <memory>
#include <optional>
#include <utility>

#include <pharos/conformance/guide_stage.h>
#include <pharos/sampling/keyed_numbers.h>

/// Guides as renders ask them, with what becomes of their proposals.
namespace pharos::conformance {

/// Independent numbers, each path named by its index.
class KeyedSampler final : public PreparedSampler {
 public:
  std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return keyed_numbers(stream.state(), dimension).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return keyed_numbers(stream.state(), dimension);
  }
};

/// A guider bound to a model, as a render would ask it: densities are complete.
GuidingFrame frame_of(const Guider& guider, const std::shared_ptr<const GuidingModel>& model);

/// What a guide knows at one vertex.
class Guided {
 public:
  Guided(const GuidingFrame& frame, const StageVertex& vertex)
      : vertex_(vertex), query_(vertex.query()), guidance_(frame.query(query_, arena_)) {}

  bool declines() const { return !guidance_.is_guided(); }
  const StageVertex& vertex() const { return vertex_; }
  /// All the following need an answer: !declines().
  double density(const ResolvedVertex& vertex) const { return guidance_.density(vertex); }
  std::optional<Proposal> propose(std::uint64_t path) const;
  /// The vertex that a draw leads to; empty for a sample of value zero.
  std::optional<ResolvedVertex> draw(RandomStream& random) const;
  /// Whether steps into a direction carry anything; a guide's density elsewhere is its own affair.
  bool scatters_into(Vec3 direction) const;
  /// The end of the segment along a direction, at its surface.
  ResolvedVertex end_along(Vec3 direction) const;
  /// The same segment, ended in the medium at `distance`.
  ResolvedVertex stopped(ResolvedVertex v, float distance) const;

 private:
  std::pair<Vec3, Event> step(const Proposal& proposal) const;
  std::optional<ResolvedVertex> reach(const ResolvedVertex& end, const Proposal& proposal,
                                      RandomStream& random) const;

  const StageVertex& vertex_;
  GuidingQuery query_;
  Arena arena_;
  KeyedSampler numbers_;
  Guidance guidance_;
};

}  // namespace pharos::conformance
