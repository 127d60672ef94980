#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/mixing.h>
#include <pharos/guiding/contract/radiance_estimate.h>
#include <pharos/guiding/pipeline/guiding_settings.h>

namespace pharos {

/// The memories of all guides along one path. A copy of a path has its own copy of this array.
using PathMemories = std::array<const void*, GuidingSettings::kMostMethods>;

/// Returns the estimate of radiance around vertices that a model offers; null: none.
const RadianceEstimate* find_radiance_around(const GuidingModel& model);

/// A guide that takes part at a vertex.
struct GuidePart {
  const GuidingDistribution* distribution = nullptr;
  float share = 0;  ///< share among the guides that take part; these shares sum to 1
  std::uint32_t method = 0;
  bool steers_distance = false;
  bool steers_events = false;
  const RadianceAround* radiance = nullptr;  ///< null: unknown, or not needed

  std::optional<Proposal> propose(const VertexStream& stream) const;
  /// Returns the density like GuidingDistribution::density(), but always with the medium's factor.
  float density(const ResolvedVertex& vertex) const;
};

/// The density of each part of a Guidance, in the same order, including the medium's factor. The
/// other numbers are not set.
using PartDensities = std::array<float, GuidingSettings::kMostMethods>;

/// The sampling distribution at a vertex: a mixture of unguided sampling and of the guides that
/// know something there.
struct Guidance {
  std::span<const GuidePart> parts = {};  ///< empty: the vertex is sampled unguided
  float unguided_share = 1;
  std::uint32_t mixing_key = kNoMixing;
  std::uint32_t methods = 0;     ///< number of all methods of the render
  std::uint32_t candidates = 1;  ///< candidates of the next step; above 1, it is resampled

  bool is_guided() const { return !parts.empty(); }
  /// Returns whether the number `u` of Purpose::mix_choice decides for the guides.
  bool guides(float u) const { return is_guided() && u >= unguided_share; }
  /// Scales a number that has decided for the guides to [0, 1], so that it is uniform again.
  float rest_of(float u) const { return (u - unguided_share) / (1 - unguided_share); }
  /// Draws a proposal from the mixture of the guides. `u` in [0, 1] chooses the method. Scaled to
  /// [0, 1) again, it is the method's number guide_choice.
  std::optional<Proposal> propose(const VertexStream& stream, float u) const;
  /// Returns the density of the mixture of the guides, including the medium's factor; 0 if there
  /// are no guides. Fills in the densities of the parts.
  float density(const ResolvedVertex& vertex, PartDensities& of_parts) const;
  float density(const ResolvedVertex& vertex) const {
    PartDensities of_parts;
    return density(vertex, of_parts);
  }
  /// Returns the incident radiance that the models expect from `direction`, divided by the mean
  /// over all directions [1]. It is positive: the more of the samples are unguided, the closer it
  /// is to 1. May be called only if `candidates` is above 1.
  float relative_radiance(Vec3 direction) const;
  /// Fills in the techniques that could have drawn a step; see PathView::techniques(). `unguided`
  /// is the unguided density of the step, including the medium's factor, and `of_parts` is what
  /// density() filled in for its vertex. Returns the part of `out` that it filled.
  std::span<const Technique> techniques(
      float unguided, const PartDensities& of_parts,
      std::span<Technique, GuidingSettings::kMostMethods + 1> out) const;
};

/// Rules for all guides of a GuidingFrame.
struct GuidingRules {
  /// Number of candidates among which steps are chosen where a model knows the incident radiance.
  std::uint32_t candidates = 1;
  /// Vertices of a path after the one of this number are not guided. Vertices have no number on
  /// paths from lights and on paths made from both ends, so all of them are guided there.
  std::uint32_t last_bounce = std::numeric_limits<std::uint32_t>::max();
};

/// All methods of a render with their models, frozen for one iteration: constant and thread-safe.
class GuidingFrame {
 public:
  struct Method {
    std::optional<BoundGuider> guider;  ///< empty if the method is not asked
    GuiderTraits traits;
    /// Number of the first region of its model in the common numbering of all models.
    std::uint32_t first_region = 0;
  };

  GuidingFrame(std::vector<Method> methods, std::shared_ptr<const MixingShares> shares,
               const GuidingRules& rules = {});

  /// Returns the guidance at a vertex. Sets `query.region` and `query.memory` for each guide. The
  /// parts are made in `arena` and live until the next vertex is known. `memories` refers to
  /// objects that the guides remember in `path_arena`; if it is null, the guides have no memory.
  Guidance query(GuidingQuery& query, Arena& arena, PathMemories* memories = nullptr,
                 Arena* path_arena = nullptr) const;
  /// Returns whether any guide proposes the first vertex of paths from the sensor.
  bool guides_camera() const { return guides_camera_; }

 private:
  bool can_ask(const Method& method, const GuidingQuery& query) const;

  std::vector<Method> methods_;
  /// For each method the radiance that its model knows; null: none, or it is not needed.
  std::vector<const RadianceEstimate*> radiances_;
  std::shared_ptr<const MixingShares> shares_;
  GuidingRules rules_;
  bool guides_camera_ = false;
};

}  // namespace pharos
