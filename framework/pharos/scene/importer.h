#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/config/node.h>

namespace pharos {

/// An object of another program's scene, and what stands for it.
struct ImportedObject {
  Location where;
  std::string what;    ///< in the words of that program, such as "bsdf roughplastic 'Lamp'"
  std::string stands;  ///< in ours, such as "bsdf rough_plastic"; "nothing" for what is left out
};

/// Something that Pharos renders in another way than the scene says.
struct ImportNote {
  Location where;       ///< the first time
  std::string message;  ///< what is approximated or left out, and what is used instead
  int times = 1;        ///< how often; notes of the same kind are told once
};

/// A scene of another program, as a render config of ours.
struct Import {
  /// `scene`, `film`, `sampler`, `integrator` and `budget` as far as the file states them. Every
  /// node stands where the file says so, so that later errors name that place.
  ConfigNode config;
  std::vector<ImportedObject> objects;  ///< in the order of the file
  std::vector<ImportNote> notes;
};

/// Contract: reads scenes of another program. Its name is the extension of their files, without
/// the dot and in lower case.
class SceneImporter : public Component {
 public:
  static constexpr std::string_view contract_name = "importer";

  /// Throws InputError with file, line and column for what cannot be read.
  virtual Import import(const std::filesystem::path& file) const = 0;
};

}  // namespace pharos
