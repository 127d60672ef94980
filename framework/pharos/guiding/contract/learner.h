#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/bounds.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Where and with which random numbers a learner works.
struct LearningContext {
  Bounds3 region;                ///< bounds of geometry and sensor [scene units]
  std::uint64_t seed = 0;        ///< random numbers are keyed by (seed, iteration, cell)
  std::uint32_t iterations = 1;  ///< of training that are planned, each ended by update()
  PixelRect window{0, 0, 1, 1};  ///< of the film that is rendered [pixels]
};

/// What is learned during one render. absorb() and update() are called by one thread at a time;
/// inside they may use TBB, but the state they leave must not depend on the number of threads.
class LearningState {
 public:
  virtual ~LearningState() = default;

  /// The model to start from; null: nothing is known before the first update().
  virtual std::shared_ptr<const GuidingModel> initial_model() const { return nullptr; }

  /// Takes the recorded paths of one work unit. Called in order of work units.
  virtual void absorb(const PathLog& log) = 0;
  /// Ends training iteration `iteration` (from 0 on); `last` when no further one follows. Returns
  /// the model for the next iteration; null while nothing is known.
  virtual std::shared_ptr<const GuidingModel> update(std::uint32_t iteration, bool last) = 0;

  /// Saved state continues training where it stopped; merge() adds what another state absorbed
  /// since the last update (both began alike and saw the same updates).
  virtual void save(std::ostream& out) const = 0;
  virtual void load(std::istream& in) = 0;
  virtual void merge(const LearningState& other) = 0;
};

/// What a learner offers and needs; checked before rendering starts.
struct LearnerTraits {
  std::string model;    ///< neutral name of the model contract that it learns
  RecordNeeds records;  ///< what paths must carry
  /// GuidingModel::version() of its models; files of another one are refused.
  std::uint32_t model_version = 1;
  std::string also = {};  ///< another model contract that its models meet; empty: none

  /// Whether guiders of this model contract can sample what it learns.
  bool suits(std::string_view contract) const {
    return contract == model || (!also.empty() && contract == also);
  }
};

/// Contract: turns recorded paths into a model.
class Learner : public Component {
 public:
  static constexpr std::string_view contract_name = "learner";

  virtual LearnerTraits traits() const = 0;
  virtual std::unique_ptr<LearningState> begin(const LearningContext& context) const = 0;
  /// Reads what GuidingModel::save() wrote. Throws InputError when it is no such model.
  virtual std::shared_ptr<const GuidingModel> load_model(std::istream& in) const = 0;
};

}  // namespace pharos
