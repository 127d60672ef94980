#pragma once

#include <memory>
#include <optional>
#include <utility>

#include <pharos/conformance/guide_stage.h>
#include <pharos/rendering/filter.h>
#include <pharos/sampling/keyed_numbers.h>

/// Asks guides as renders do, and follows their proposals.
namespace pharos::conformance {

/// A sampler of independent random numbers. Each path is named by its index.
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

/// A filter by which each sample counts only in its own pixel, so that sums over the film are sums
/// over paths.
class OnePixel final : public Filter {
 public:
  float radius() const override { return 0.5f; }
  float evaluate(Vec2) const override { return 1; }
  float integral() const override { return 1; }
};

/// Returns a frame of one guider that is bound to a model, as in a render. Its densities are
/// complete. Steps are chosen among `candidates` candidates where the model knows the radiance.
GuidingFrame frame_of(const Guider& guider, const std::shared_ptr<const GuidingModel>& model,
                      std::uint32_t candidates = 1);

/// The answer of a guide at one vertex.
class Guided {
 public:
  Guided(const GuidingFrame& frame, const StageVertex& vertex)
      : vertex_(vertex), query_(vertex.query()), guidance_(frame.query(query_, arena_)) {}

  bool declines() const { return !guidance_.is_guided(); }
  const StageVertex& vertex() const { return vertex_; }
  /// The following functions may be called only if declines() is false.
  double density(const ResolvedVertex& vertex) const { return guidance_.density(vertex); }
  std::optional<Proposal> propose(std::uint64_t path) const;
  /// Draws a proposal and returns the vertex that it leads to; empty for a sample of value zero.
  std::optional<ResolvedVertex> draw(RandomStream& random) const;
  /// Returns whether the vertex scatters light into a direction. A guide's density elsewhere is not
  /// tested.
  bool scatters_into(Vec3 direction) const;
  /// Returns the end of the segment along a direction, where the ray hits a surface.
  ResolvedVertex end_along(Vec3 direction) const;
  /// Returns the volume vertex at `distance` along the segment to `v`.
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
