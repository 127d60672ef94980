#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// The share of unguided samples by region, frozen for an iteration: constant, thread-safe.
class MixingFractions {
 public:
  virtual ~MixingFractions() = default;
  /// In (0, 1]: never 0, or directions that the guide misses would be lost.
  virtual float unguided_fraction(std::uint32_t region) const = 0;
};

/// What a policy has learned during one render; used like LearningState.
class MixingState {
 public:
  virtual ~MixingState() = default;
  /// Takes the recorded paths of one work unit, in order of work units. RecordedVertex::region
  /// names the region of the model in force when the path was traced.
  virtual void absorb(const PathLog& log) = 0;
  /// Ends an iteration. The next model has `region_count` regions; region i came from
  /// `origins[i]`; empty origins mean that regions are as before. Returns the fractions to use
  /// next.
  virtual std::shared_ptr<const MixingFractions> update(std::uint32_t region_count,
                                                        std::span<const std::uint32_t> origins) = 0;

  /// As for LearningState.
  virtual void save(std::ostream& out) const = 0;
  virtual void load(std::istream& in) = 0;
  virtual void merge(const MixingState& other) = 0;
};

/// Contract: how guided and unguided sampling share the samples.
class MixingPolicy : public Component {
 public:
  static constexpr std::string_view contract_name = "mixing";

  virtual std::unique_ptr<MixingState> begin() const = 0;
};

}  // namespace pharos
