#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/rendering/integrator.h>

namespace pharos {

/// The plugin `light`; see light.cpp.
class LightIntegrator final : public Integrator {
 public:
  struct Settings {
    std::uint16_t max_depth = 12;
    Ref<Termination> termination;  ///< null: paths end at `max_depth` only
    static void describe(Schema<Settings>& s);
  };
  /// Throws InputError if the termination learns.
  explicit LightIntegrator(const Settings& settings);

  IntegratorTraits traits() const override { return {}; }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
