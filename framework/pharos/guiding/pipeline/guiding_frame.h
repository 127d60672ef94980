#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/mixing.h>
#include <pharos/guiding/pipeline/guiding_settings.h>

namespace pharos {

/// The memories of all guides along one path. A copy of a path has a copy of this.
using PathMemories = std::array<const void*, GuidingSettings::kMostMethods>;

/// One guide that takes part at a vertex.
struct GuidePart {
  const GuidingDistribution* distribution = nullptr;
  float share = 0;  ///< among the guides that take part; these shares sum to 1
  std::uint32_t method = 0;
  bool steers_distance = false;
  bool steers_events = false;

  std::optional<Proposal> propose(const VertexStream& stream) const;
  /// As GuidingDistribution::density(), always with the medium's factor.
  float density(const ResolvedVertex& vertex) const;
};

/// How a vertex is sampled: unguided sampling and the guides that know something there share the
/// samples.
struct Guidance {
  std::span<const GuidePart> parts = {};  ///< empty: the vertex is sampled unguided
  float unguided_share = 1;
  std::uint32_t mixing_key = kNoMixing;
  std::uint32_t methods = 0;  ///< number of all methods of the render

  bool is_guided() const { return !parts.empty(); }
  /// Draws a proposal of the guides' mixture.
  std::optional<Proposal> propose(const VertexStream& stream) const;
  /// The density of the guides' mixture, medium included; 0 without guides.
  float density(const ResolvedVertex& vertex) const;
  /// Fills in the techniques of a step to `vertex` whose unguided density is `unguided`, medium
  /// included; see PathView::techniques(). Returns the part of `out` that it filled.
  std::span<const Technique> techniques(
      const ResolvedVertex& vertex, float unguided,
      std::span<Technique, GuidingSettings::kMostMethods + 1> out) const;
};

/// All methods of a render with their models, frozen for one iteration: constant and thread-safe.
class GuidingFrame {
 public:
  struct Method {
    std::optional<BoundGuider> guider;  ///< empty while its learner knows nothing
    GuiderTraits traits;
    std::uint32_t first_region = 0;  ///< regions of all models are numbered through
  };

  GuidingFrame(std::vector<Method> methods, std::shared_ptr<const MixingShares> shares);

  /// Returns the guidance at a vertex; `query.region` and `query.memory` are filled in for each
  /// guide. Parts are made in `arena` and live until the next vertex is known. What guides remember
  /// goes through `memories` to objects in `path_arena`; null: they have no memory.
  Guidance query(GuidingQuery& query, Arena& arena, PathMemories* memories = nullptr,
                 Arena* path_arena = nullptr) const;
  /// Whether a guide proposes first vertices.
  bool guides_camera() const { return guides_camera_; }

 private:
  bool can_ask(const Method& method, const GuidingQuery& query) const;

  std::vector<Method> methods_;
  std::shared_ptr<const MixingShares> shares_;
  bool guides_camera_ = false;
};

}  // namespace pharos
