#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/core/archive.h>
#include <pharos/core/bounds.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// The scene and the random numbers of one training.
struct LearningContext {
  Bounds3 region;                ///< bounds of geometry and sensor [scene units]
  std::uint64_t seed = 0;        ///< random numbers are keyed by (seed, iteration, cell)
  PixelRect window{0, 0, 1, 1};  ///< the part of the film that is rendered [pixels]
};

/// The place of a training iteration in the training.
struct TrainingStage {
  std::uint32_t iteration = 0;  ///< counted from 0
  /// Expected number of training iterations that follow. It may turn out larger or smaller, because
  /// time budgets and the gain of the guides decide when training ends, but 0 is certain.
  std::uint32_t left = 0;

  bool is_last() const { return left == 0; }
};

/// The result of one training iteration.
struct Learned {
  std::shared_ptr<const GuidingModel> model;  ///< null while nothing is known
  /// Maps each region of the model to the region of the previous model from which it came. If
  /// empty, the regions are the same as before.
  std::vector<std::uint32_t> region_origins = {};
};

/// The state of a learner during one render. Only one thread at a time calls its functions. They
/// may use TBB, but the state they leave must not depend on the number of threads.
class LearningState {
 public:
  virtual ~LearningState() = default;

  /// Takes the recorded paths of one work unit. Called in the order of work units.
  virtual void absorb(const PathLog& log) = 0;
  /// Ends a training iteration.
  virtual Learned update(const TrainingStage& stage) = 0;
  /// Called when the model is not used any more in this render. Neither absorb() nor update() is
  /// called afterwards, but archive() and end_learning() may be. The state may drop records that
  /// wait for update(). The default does nothing.
  virtual void end_learning() {}
  /// Saves the state, or loads it into a state that Learner::begin() made for the same render.
  virtual void archive(Archive& archive) = 0;
};

/// The requirements of a learner. The framework checks them before rendering starts.
struct LearnerTraits {
  RecordNeeds records;  ///< records that integrators must make
};

/// Contract: turns recorded paths into a model.
class Learner : public Component {
 public:
  static constexpr std::string_view contract_name = "learner";

  virtual LearnerTraits traits() const = 0;
  virtual std::unique_ptr<LearningState> begin(const LearningContext& context) const = 0;
  /// Returns a model that knows nothing, of the type that this learner learns. Saved models are
  /// loaded into it.
  virtual std::shared_ptr<GuidingModel> empty_model() const = 0;
};

}  // namespace pharos
