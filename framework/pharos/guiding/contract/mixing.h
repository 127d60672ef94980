#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/core/archive.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/vertex.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// A vertex at which sampling techniques share the samples. The policy is asked before any guide.
struct MixingQuery {
  const GuidingQuery& vertex;  ///< `region` is undefined
  /// What the model of each method knows of the vertex. The regions of all models share one
  /// numbering. A method that cannot be asked here has the evidence 0.
  std::span<const Place> places;
};

/// The shares of the sampling techniques, frozen for one iteration: constant and thread-safe.
class MixingShares {
 public:
  virtual ~MixingShares() = default;

  /// Fills in the share of unguided sampling, `shares[0]`, and of each method, `shares[1 + i]`. The
  /// shares sum to 1. The unguided share is positive, because otherwise directions that no guide
  /// proposes would be lost. If the guide of a method turns out to know nothing, the other methods
  /// divide its share. Returns a key from which the policy later knows how it decided here; see
  /// RecordedVertex::mixing_key.
  virtual std::uint32_t at(const MixingQuery& query, std::span<float> shares) const = 0;
  /// Returns whether method `i` may have a positive share anywhere. A method that has none is left
  /// out of the iteration. If all are, paths are traced as without guides.
  virtual bool asks(std::size_t /*method*/) const { return true; }
};

/// The state of a policy during one render. Threads use it in the same way as LearningState.
class MixingState {
 public:
  virtual ~MixingState() = default;

  /// Takes the recorded paths of one work unit. Called in the order of work units.
  virtual void absorb(const PathLog& log) = 0;
  /// Ends an iteration. The next models have `regions` regions in all; region i came from region
  /// `origins[i]`. If `origins` is empty, the regions are the same as before. `last`: no other
  /// training iteration follows.
  virtual void update(std::uint32_t regions, std::span<const std::uint32_t> origins, bool last) = 0;
  /// Takes note that method `method` is left out of the rest of the render: it is not asked any
  /// more, so its share goes to waste. Called before update(). The default ignores this; renders
  /// with the model file that the render writes then ask the method again.
  virtual void leave_out(std::size_t /*method*/) {}
  /// Called instead of the last update(), if guiding is turned off then. The state may drop records
  /// that wait for update(). The model file stores what was learned before, and renders that use it
  /// do not learn, so shares() should return shares for a final image. The default does nothing.
  virtual void end_learning() {}
  /// Returns the shares as of the last call of update() or end_learning().
  virtual std::shared_ptr<const MixingShares> shares() const = 0;
  /// Saves the state, or loads it into a state that MixingPolicy::begin() made for the same render
  /// and that has been updated for the number of regions that was saved.
  virtual void archive(Archive& archive) = 0;
};

/// Contract: how unguided sampling and the guiding methods share the samples.
class MixingPolicy : public Component {
 public:
  static constexpr std::string_view contract_name = "mixing";

  /// Returns the state of a new render. `weights` are the weights that the config gives the
  /// methods; all of them are positive.
  virtual std::unique_ptr<MixingState> begin(std::span<const float> weights) const = 0;
};

/// Gives unguided sampling the share `unguided` and divides the rest in proportion to the weights
/// of the methods that know something at the vertex. If no method knows anything, unguided sampling
/// gets the share 1.
inline void share_by_weight(std::span<const float> weights, std::span<const Place> places,
                            float unguided, std::span<float> shares) {
  float total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    shares[1 + i] = places[i].evidence > 0 ? weights[i] : 0;
    total += shares[1 + i];
  }
  shares[0] = total > 0 ? unguided : 1;
  for (std::size_t i = 0; total > 0 && i < weights.size(); ++i) {
    shares[1 + i] *= (1 - unguided) / total;
  }
}

}  // namespace pharos
