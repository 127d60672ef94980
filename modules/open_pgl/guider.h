#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>

namespace pharos::open_pgl {

struct OpenPglGuiderSettings {
  bool cosine = true;
  static void describe(Schema<OpenPglGuiderSettings>& schema);
};

/// Samples directions from a field of Open PGL.
class OpenPglGuider final : public Guider {
 public:
  using Settings = OpenPglGuiderSettings;
  explicit OpenPglGuider(const Settings& settings) : settings_(settings) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::open_pgl
