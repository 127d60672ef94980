#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include <pharos/transport/path_settings.h>
#include <pharos/transport/prepared_bidirectional.h>

namespace pharos {

/// The iterations in which paths start at lights.
enum class LightPaths { always, training };
template <>
struct EnumNames<LightPaths> {
  static constexpr auto names = std::to_array<EnumName<LightPaths>>(
      {{"always", LightPaths::always}, {"training", LightPaths::training}});
};

/// The plugin `bidirectional`; see bidirectional.cpp.
class BidirectionalIntegrator final : public Integrator {
 public:
  struct Settings {
    std::uint16_t max_depth = 12;
    LightSelection light_selection = LightSelection::one;
    LightPaths light_paths = LightPaths::always;
    Ref<Termination> termination;  ///< null: paths end at `max_depth` only
    std::optional<GuidingSettings> guiding;
    static void describe(Schema<Settings>& s);

    PathSettings path_settings() const;
    LightPathRules light_path_rules() const;
  };
  /// Throws InputError if the termination learns.
  explicit BidirectionalIntegrator(Settings settings);

  IntegratorTraits traits() const override;
  const GuidingSettings* guiding() const override;
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget& target) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
