// The integrators, built with planted faults:
//
//     integrator: { type: faulty_path, fault: mis_without_guide, settings: { max_depth: 4 } }

#include <pharos/config/module.h>

#include "../../plugins/integrators/bidirectional.h"
#include "../../plugins/integrators/light.h"
#include "../../plugins/integrators/path.h"
#include "../../plugins/integrators/planted_fault.h"
#include "faulty_guider.h"

namespace pharos {
namespace {

/// `Inner` with settings of its own under `settings`.
template <class Inner, class InnerSettings>
class Faulty final : public Integrator {
 public:
  struct Settings {
    PlantedFault fault = PlantedFault::none;
    InnerSettings inner;
    static void describe(Schema<Settings>& s) {
      s.field("fault", &Settings::fault, "What to do wrong");
      s.field("settings", &Settings::inner, "Those of the integrator");
    }
  };
  explicit Faulty(const Settings& settings) : fault_(settings.fault), inner_(settings.inner) {}

  IntegratorTraits traits() const override { return inner_.traits(); }
  const GuidingSettings* guiding() const override { return inner_.guiding(); }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override {
    planted_fault = fault_;
    return inner_.prepare(target);
  }

 private:
  PlantedFault fault_;
  Inner inner_;
};

using FaultyPath = Faulty<PathIntegrator, PathSettings>;
using FaultyLight = Faulty<LightIntegrator, LightIntegrator::Settings>;
using FaultyBidirectional = Faulty<BidirectionalIntegrator, BidirectionalIntegrator::Settings>;

}  // namespace
}  // namespace pharos

PHAROS_MODULE(registry) {
  registry.add<pharos::FaultyPath>("faulty_path", "Path tracing with a planted fault");
  registry.add<pharos::FaultyLight>("faulty_light", "Light tracing with a planted fault");
  registry.add<pharos::FaultyBidirectional>("faulty_bidirectional", "Both with a planted fault");
  registry.add<pharos::testing::FoldingGuider>("folding", "Directions of another guider, folded");
}
