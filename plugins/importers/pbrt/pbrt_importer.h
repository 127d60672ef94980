#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/importer.h>

namespace pharos {

/// See pbrt_importer.cpp.
class PbrtImporter final : public SceneImporter {
 public:
  using Settings = NoSettings;
  explicit PbrtImporter(const Settings& = {}) {}
  Import import(const std::filesystem::path& file) const override;
};

}  // namespace pharos
