// A module that registers a name which another plugin already has.
#include <pharos/config/module.h>
#include <pharos/rendering/filter.h>

namespace {

class OtherBox final : public pharos::Filter {
 public:
  using Settings = pharos::NoSettings;
  explicit OtherBox(const Settings&) {}
  float radius() const override { return 1; }
  float evaluate(pharos::Vec2) const override { return 1; }
  float integral() const override { return 4; }
};

}  // namespace

PHAROS_MODULE(registry) {
  registry.add<OtherBox>("box", "Another box");
}
