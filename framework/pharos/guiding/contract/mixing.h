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

/// A vertex at which sampling techniques share the samples. It is asked before any guide is.
struct MixingQuery {
  const GuidingQuery& vertex;  ///< `region` is undefined
  /// What each method's model knows of the vertex; regions of all models are numbered through. A
  /// method that cannot be asked here has the evidence 0.
  std::span<const Place> places;
};

/// How techniques share the samples, frozen for an iteration: constant and thread-safe.
class MixingShares {
 public:
  virtual ~MixingShares() = default;

  /// Fills in the share of unguided sampling, `shares[0]`, and of each method, `shares[1 + i]`.
  /// They sum to 1. The unguided share is positive, or directions that no guide proposes would be
  /// lost. If a method turns out to know nothing, the other methods divide its share. Returns a key
  /// that tells the policy later how it decided here; see RecordedVertex::mixing_key.
  virtual std::uint32_t at(const MixingQuery& query, std::span<float> shares) const = 0;
};

/// What a policy has learned during one render. Used like LearningState.
class MixingState {
 public:
  virtual ~MixingState() = default;

  /// Takes the recorded paths of one work unit, in the order of work units.
  virtual void absorb(const PathLog& log) = 0;
  /// Ends an iteration. The next models have `regions` regions in all; region i came from
  /// `origins[i]`. Empty: the regions are the same as before.
  virtual void update(std::uint32_t regions, std::span<const std::uint32_t> origins) = 0;
  /// The shares in force since the last update().
  virtual std::shared_ptr<const MixingShares> shares() const = 0;
  /// Saves the state, or loads it into a state that MixingPolicy::begin() made for the same render
  /// and that has been updated for the number of regions that was saved.
  virtual void archive(Archive& archive) = 0;
};

/// Contract: how unguided sampling and the guiding methods share the samples.
class MixingPolicy : public Component {
 public:
  static constexpr std::string_view contract_name = "mixing";

  /// `weights`: the weights that a config gives the methods, all positive.
  virtual std::unique_ptr<MixingState> begin(std::span<const float> weights) const = 0;
};

/// Divides `guided`, the share of all methods together, in proportion to the weights of the methods
/// that know something at the vertex, and gives unguided sampling the rest; all of it if none does.
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
