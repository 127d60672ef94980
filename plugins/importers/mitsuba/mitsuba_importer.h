#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/importer.h>

namespace pharos {

/// See mitsuba_importer.cpp.
class MitsubaImporter final : public SceneImporter {
 public:
  using Settings = NoSettings;
  explicit MitsubaImporter(const Settings& = {}) {}
  Import import(const std::filesystem::path& file) const override;
};

}  // namespace pharos
