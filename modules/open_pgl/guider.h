#pragma once

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/guider.h>

#include "model.h"

namespace pharos::open_pgl {

struct OpenPglGuiderSettings {
  bool cosine = true;
  static void describe(Schema<OpenPglGuiderSettings>& schema);
};

/// Samples directions from a field of Open PGL.
class OpenPglGuider final : public GuiderOf<OpenPglModel> {
 public:
  using Settings = OpenPglGuiderSettings;
  explicit OpenPglGuider(const Settings& settings) : settings_(settings) {}

  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const OpenPglModel& model, const GuidingQuery& query,
                                   Arena& arena) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::open_pgl
