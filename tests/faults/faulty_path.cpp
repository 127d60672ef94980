// The integrator `path`, built with planted faults:
//
//     integrator: { type: faulty_path, fault: mis_without_guide, path: { max_depth: 4 } }

#include <pharos/config/module.h>

#include "../../plugins/integrators/path.h"
#include "../../plugins/integrators/planted_fault.h"
#include "faulty_guider.h"

namespace pharos {
namespace {

class FaultyPath final : public Integrator {
 public:
  struct Settings {
    PlantedFault fault = PlantedFault::none;
    PathSettings path;
    static void describe(Schema<Settings>& s) {
      s.field("fault", &Settings::fault, "What to do wrong");
      s.field("path", &Settings::path, "The settings of the integrator 'path'");
    }
  };
  explicit FaultyPath(const Settings& settings) : fault_(settings.fault), path_(settings.path) {}

  IntegratorTraits traits() const override { return path_.traits(); }
  const GuidingSettings* guiding() const override { return path_.guiding(); }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override {
    planted_fault = fault_;
    return path_.prepare(target);
  }

 private:
  PlantedFault fault_;
  PathIntegrator path_;
};

}  // namespace
}  // namespace pharos

PHAROS_MODULE(registry) {
  registry.add<pharos::FaultyPath>("faulty_path", "Path tracing with a planted fault");
  registry.add<pharos::testing::FoldingGuider>("folding", "Directions of another guider, folded");
}
