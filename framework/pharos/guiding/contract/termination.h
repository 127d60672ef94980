#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/archive.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// A vertex at which a rule decides how a path goes on. Everything in it is a function of the
/// prefix of the path.
struct TerminationQuery {
  Vec2 film;                 ///< film position of the path [pixels]; zero for paths from lights
  Point3 position;           ///< of the vertex
  Vec3 towards_previous;     ///< unit
  std::uint16_t bounce = 1;  ///< number of the vertex; the first vertex after the lens is 1
  bool discrete = false;     ///< all events of the vertex are discrete, as at mirrors
  /// f/p of the path up to the vertex: [1] for paths from the sensor, a power for paths from
  /// lights.
  Rgb throughput;
  float first_throughput = 1;  ///< largest component of the throughput after the first step
  /// Density of evenly chosen film positions over the density with which the path has got its own
  /// [1]. It is part of the throughput, and differs from 1 only if guides of the camera choose film
  /// positions.
  float film_weight = 1;
  /// Expected number of branches into which the path has split so far: the product of all factors
  /// above 1 [1].
  float branches = 1;
  /// Product of the factors by which refraction has compressed solid angles so far, inverted. Times
  /// this number, the throughput shows how much light was lost on the way [1]. It is 1 for rules of
  /// the stage `vertex`.
  float solid_angle_scale = 1;
};

/// The expected numbers q of steps that a path takes from a vertex, and of light samples there [1].
/// Each of them is weighted by 1 / q, so the image is unbiased for any q > 0:
///
/// - q < 1: Russian roulette. There is one with probability q.
/// - q > 1: stochastic splitting. There are floor(q) or floor(q) + 1, q on average.
///
/// If both factors are equal, there is a light sample for each step. Otherwise the numbers are
/// drawn independently of each other.
struct BranchFactors {
  float steps = 1, lights = 1;
  friend bool operator==(const BranchFactors&, const BranchFactors&) = default;
};

/// Decides where paths end and where they split, frozen for one iteration: constant and
/// thread-safe.
class TerminationRule {
 public:
  virtual ~TerminationRule() = default;

  /// The time at which a rule is asked.
  enum class Stage {
    vertex,  ///< before steps are drawn. Only then can a path split
    step     ///< after the step was drawn. The factor of steps is at most 1, the other is not used
  };
  virtual Stage stage() const { return Stage::vertex; }

  /// The largest factor that a rule may return. Each branch that waits takes memory.
  static constexpr float kMostFactor = 1000;

  /// Returns the factors at a vertex, each from 0 to kMostFactor. 0 is right only if what it rules
  /// out has no value: the rest of the path, or light samples, on which the weights of light that
  /// steps hit count. At mirrors and the like, and where the integrator cannot split, factors of
  /// steps above 1 count as 1.
  virtual BranchFactors factors(const TerminationQuery& query) const = 0;
};

/// The state of a termination during one render. Threads use it in the same way as LearningState.
class TerminationState {
 public:
  virtual ~TerminationState() = default;

  /// Takes the recorded paths of one work unit. Called in the order of work units.
  virtual void absorb(const PathLog& log) = 0;
  /// Ends a training iteration.
  virtual void update(const TrainingStage& stage) = 0;
  /// Returns the rule as of the last call of update(), or the rule of the first iteration. Null:
  /// paths neither end nor split.
  virtual std::shared_ptr<const TerminationRule> rule() const = 0;
  /// Saves the state, or loads it into a state that Termination::begin() made for the same render.
  virtual void archive(Archive& archive) = 0;
  /// Saves what rule() depends on, or loads it into a state that Termination::begin() made for the
  /// same render and that learns no more. Other processes of a render get it before each iteration,
  /// so it should be small. By default, it is the whole state.
  virtual void archive_rule(Archive& archive) { this->archive(archive); }
};

/// Contract: where paths end by Russian roulette, and where they split.
class Termination : public Component {
 public:
  static constexpr std::string_view contract_name = "termination";

  /// Returns whether the rule is learned from recorded paths. If not, neither absorb() nor update()
  /// is called.
  virtual bool learns() const = 0;
  virtual std::unique_ptr<TerminationState> begin(const LearningContext& context) const = 0;
};

}  // namespace pharos
