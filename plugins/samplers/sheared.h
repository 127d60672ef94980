#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/config/values.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// The purposes that have points in the square.
template <>
struct EnumNames<Purpose> {
  static constexpr std::array<std::pair<std::string_view, Purpose>, 5> names{
      {{"pixel", Purpose::pixel},
       {"lens", Purpose::lens},
       {"light_position", Purpose::light_position},
       {"bsdf_direction", Purpose::bsdf_direction},
       {"guide_direction", Purpose::guide_direction}}};
};

/// See sheared.cpp.
class ShearedSampler final : public Sampler {
 public:
  struct Settings {
    Ref<Sampler> base;
    double direction = 45;
    Purpose purpose = Purpose::light_position;
    static void describe(Schema<Settings>& s);
  };
  explicit ShearedSampler(const Settings& settings) : settings_(settings) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples() const override { return settings_.base->preferred_samples(); }
  bool needs_probe() const override { return settings_.base->needs_probe(); }

 private:
  Settings settings_;
};

}  // namespace pharos
