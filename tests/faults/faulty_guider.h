#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

namespace pharos::testing {

enum class GuideFault {
  none,
  scaled,                   ///< the density is 3 % too large
  mirrored_branch_missing,  ///< the density omits directions that were folded
  proposal_not_folded,      ///< proposals stay below the surface, but the density folds them
  directions_of_both,       ///< half of the proposals are dropped by a number of bsdf_direction
};

struct FoldingSettings {
  GuideFault fault = GuideFault::none;
  Ref<Guider> guider;
  static void describe(Schema<FoldingSettings>& s);
};

/// A decorator of another guider. See faulty_guider.cpp.
class FoldingGuider final : public Guider {
 public:
  using Settings = FoldingSettings;
  explicit FoldingGuider(Settings settings) : settings_(std::move(settings)) {}

  GuiderTraits traits() const override { return settings_.guider->traits(); }
  std::string_view model_name() const override { return settings_.guider->model_name(); }
  const void* find(const GuidingModel& model) const override {
    return settings_.guider->find(model);
  }
  const GuidingDistribution* query_found(const void* found, const GuidingQuery& query,
                                         Arena& arena) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::testing

namespace pharos {
template <>
struct EnumNames<testing::GuideFault> {
  static constexpr auto names = std::to_array<EnumName<testing::GuideFault>>(
      {{"none", testing::GuideFault::none},
       {"scaled", testing::GuideFault::scaled},
       {"mirrored_branch_missing", testing::GuideFault::mirrored_branch_missing},
       {"proposal_not_folded", testing::GuideFault::proposal_not_folded},
       {"directions_of_both", testing::GuideFault::directions_of_both}});
};
}  // namespace pharos
