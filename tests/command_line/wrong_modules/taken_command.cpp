// A module whose command has the name of a command of the program.
#include <pharos/config/command.h>
#include <pharos/config/module.h>

namespace {

class OtherRender final : public pharos::Command {
 public:
  using Settings = pharos::NoSettings;
  explicit OtherRender(const Settings&) {}
  pharos::CommandEnd run(const pharos::CommandControl&) const override {
    return pharos::CommandEnd::done;
  }
};

}  // namespace

PHAROS_MODULE(registry) {
  registry.add<OtherRender>("render", "Another rendering");
}
