// uniform (learner): the mean radiance that the steps of the last iteration's paths met. Only
// pictures of the model show it: the pair `uniform` is there to be compared with, and to be copied.
//
//     guiding: { learner: uniform, guider: uniform }
#include "uniform_learner.h"

#include <utility>

#include <pharos/core/binary_stream.h>

#include "uniform_model.h"

namespace pharos {
namespace {

/// Sums over the steps recorded since the last update, folded in the order of calls: the same for
/// any number of threads.
class UniformState final : public LearningState {
 public:
  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) {
      const PathView path = log[i];
      if (path.transport != Transport::radiance) continue;
      estimate_incident_radiance(path, incident_);
      for (std::size_t k = 0; k < path.vertices.size(); ++k) {
        // Where no guide will ever be asked there is nothing to learn. Steps that met no light
        // count: they say that it is dark there.
        if (!path.vertices[k].guidable) continue;
        sums_.radiance += mean(incident_[k]);
        ++sums_.steps;
      }
    }
  }

  /// Begins anew. What had to stay for later iterations would be kept apart from the sums, since
  /// merge() takes over only what was absorbed since this call.
  std::shared_ptr<const GuidingModel> update(std::uint32_t, bool) override {
    const Sums done = std::exchange(sums_, {});
    const auto steps = static_cast<double>(done.steps);
    return std::make_shared<UniformModel>(done.steps > 0 ? done.radiance / steps : 0.0);
  }

  void save(std::ostream& out) const override {
    save_heading(out, kName, kVersion);
    save_number(out, sums_.radiance);
    save_number(out, sums_.steps);
  }
  void load(std::istream& in) override {
    expect_heading(in, kName, kVersion);
    sums_.radiance = load_finite<double>(in);
    sums_.steps = load_number<std::uint64_t>(in);
  }
  void merge(const LearningState& other) override {
    const Sums& theirs = dynamic_cast<const UniformState&>(other).sums_;
    sums_.radiance += theirs.radiance;
    sums_.steps += theirs.steps;
  }

 private:
  static constexpr const char* kName = "uniform state";
  static constexpr std::uint32_t kVersion = 1;

  struct Sums {
    double radiance = 0;
    std::uint64_t steps = 0;
  };
  Sums sums_;
  std::vector<Rgb> incident_;  ///< of one path; a member to keep its memory
};

}  // namespace

void UniformModel::save(std::ostream& out) const {
  save_heading(out, kName, kVersion);
  save_number(out, radiance_);
}

LearnerTraits UniformLearner::traits() const {
  // Light samples are a part of the radiance that steps meet: of that at their far ends.
  return {.model = UniformModel::kName, .records = {.light_samples = true}};
}

std::unique_ptr<LearningState> UniformLearner::begin(const LearningContext&) const {
  return std::make_unique<UniformState>();
}

std::shared_ptr<const GuidingModel> UniformLearner::load_model(std::istream& in) const {
  expect_heading(in, UniformModel::kName, UniformModel::kVersion);
  return std::make_shared<UniformModel>(load_finite<double>(in));
}

}  // namespace pharos
