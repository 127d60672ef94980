// An integrator that ends the process, as a bug would.

#include <cstdlib>

#include <pharos/config/module.h>
#include <pharos/rendering/integrator.h>

namespace pharos {
namespace {

class PreparedAbort final : public PreparedIntegrator {
 public:
  void render(const WorkUnit&, const IterationContext&, WorkResult&) const override {
    std::abort();
  }
  PathTrace replay(const PathKey&, const IterationContext&) const override { return {}; }
};

class Abort final : public Integrator {
 public:
  using Settings = NoSettings;
  explicit Abort(const Settings&) {}

  IntegratorTraits traits() const override { return {}; }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget&) const override {
    return std::make_unique<const PreparedAbort>();
  }
};

}  // namespace
}  // namespace pharos

PHAROS_MODULE(registry) {
  registry.add<pharos::Abort>("abort", "Ends the process");
}
