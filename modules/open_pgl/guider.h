#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/guider.h>

namespace pharos::pgl {

struct PglGuiderSettings {
  bool cosine = true;
  static void describe(Schema<PglGuiderSettings>& schema);
};

/// Samples directions from a field of Open PGL.
class PglGuider final : public Guider {
 public:
  using Settings = PglGuiderSettings;
  explicit PglGuider(const Settings& settings) : settings_(settings) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::pgl
