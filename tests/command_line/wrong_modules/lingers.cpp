// A module that delays the end of the process, as an unmount or a busy disk would.

#include <chrono>
#include <thread>

#include <pharos/config/module.h>
#include <pharos/rendering/integrator.h>

namespace pharos {
namespace {

struct Lingering {
  ~Lingering() { std::this_thread::sleep_for(std::chrono::seconds(1)); }
} lingering;

class Black final : public Integrator {
 public:
  using Settings = NoSettings;
  explicit Black(const Settings&) {}

  IntegratorTraits traits() const override { return {}; }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget&) const override {
    return nullptr;
  }
};

}  // namespace
}  // namespace pharos

PHAROS_MODULE(registry) {
  registry.add<pharos::Black>("black", "Is never prepared");
}
