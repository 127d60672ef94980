#pragma once

#include <optional>

#include <pharos/rendering/integrator.h>
#include <pharos/transport/path_settings.h>

namespace pharos {

/// The plugin `path`; see path.cpp.
class PathIntegrator final : public Integrator {
 public:
  using Settings = PathSettings;
  /// Throws InputError if settings contradict each other.
  explicit PathIntegrator(Settings settings);

  IntegratorTraits traits() const override;
  const GuidingSettings* guiding() const override;
  const Termination* learned_termination() const override;
  const TrainingSettings* training() const override;
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
