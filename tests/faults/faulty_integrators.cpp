// The integrators with planted faults:
//
//     integrator: { type: faulty_path, fault: mis_without_guide, settings: { max_depth: 4 } }

#include <pharos/config/module.h>
#include <pharos/transport/prepared_bidirectional.h>
#include <pharos/transport/prepared_light.h>
#include <pharos/transport/prepared_path.h>

#include "../../plugins/integrators/bidirectional.h"
#include "../../plugins/integrators/light.h"
#include "../../plugins/integrators/path.h"
#include "faulty_guider.h"
#include "faulty_learner.h"
#include "planted_fault.h"

namespace pharos {
namespace {

std::unique_ptr<const PreparedIntegrator> prepare_faulty(const PathSettings& settings,
                                                         const RenderTarget& target) {
  return std::make_unique<PreparedPath<FaultyRules>>(settings, target);
}
std::unique_ptr<const PreparedIntegrator> prepare_faulty(const LightIntegrator::Settings& settings,
                                                         const RenderTarget& target) {
  return std::make_unique<PreparedLightTracing<FaultyRules>>(settings.max_depth, target);
}
std::unique_ptr<const PreparedIntegrator> prepare_faulty(
    const BidirectionalIntegrator::Settings& settings, const RenderTarget& target) {
  return std::make_unique<PreparedBidirectional<FaultyRules>>(settings.path_settings(),
                                                              settings.light_path_rules(), target);
}

/// The integrator `Right` with a fault. Its own settings are under `settings`.
template <class Right>
class Faulty : public Integrator {
 public:
  struct Settings {
    PlantedFault fault = PlantedFault::none;
    typename Right::Settings right;
    static void describe(Schema<Settings>& s) {
      s.field("fault", &Settings::fault, "The planted fault");
      s.field("settings", &Settings::right, "Settings of the integrator");
    }
  };
  explicit Faulty(const Settings& settings) : settings_(settings), right_(settings.right) {}

  IntegratorTraits traits() const override { return right_.traits(); }
  const GuidingSettings* guiding() const override { return right_.guiding(); }
  const Termination* learned_termination() const override { return right_.learned_termination(); }
  const TrainingSettings* training() const override { return right_.training(); }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override {
    planted_fault = settings_.fault;
    return prepare_faulty(settings_.right, target);
  }

 private:
  Settings settings_;
  Right right_;
};

/// Paths from the lens are weighted as if all pixels had the same number of samples. The weights of
/// paths from lights are right.
class ShareBlind final : public Faulty<BidirectionalIntegrator> {
 public:
  using Settings = NoSettings;
  explicit ShareBlind(const Settings&)
      : Faulty(Faulty::Settings{.fault = PlantedFault::pixel_shares_forgotten, .right = {}}) {}
};

}  // namespace
}  // namespace pharos

PHAROS_MODULE(registry) {
  using namespace pharos;
  registry.add<Faulty<PathIntegrator>>("faulty_path", "Path tracing with a planted fault");
  registry.add<Faulty<LightIntegrator>>("faulty_light", "Light tracing with a planted fault");
  registry.add<Faulty<BidirectionalIntegrator>>("faulty_bidirectional",
                                                "Bidirectional path tracing with a planted fault");
  registry.add<ShareBlind>("share_blind", "Bidirectional path tracing that forgets pixel shares");
  registry.add<pharos::testing::FoldingGuider>("folding", "Directions of another guider, folded");
  registry.add<pharos::testing::RetellingLearner>("retelling", "Passes paths on to a learner");
}
