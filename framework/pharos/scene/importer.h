#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/config/component.h>
#include <pharos/config/node.h>

namespace pharos {

/// An object of another program's scene and the Pharos object that represents it.
struct ImportedObject {
  Location where;
  std::string what;    ///< name in that program, such as "bsdf roughplastic 'Lamp'"
  std::string stands;  ///< name in Pharos, such as "bsdf rough_plastic"; "nothing" if the object is
                       ///< left out
};

/// A part of the scene that Pharos renders differently from what the file says.
struct ImportNote {
  Location where;       ///< place of the first occurrence
  std::string message;  ///< what is approximated or left out, and what replaces it
  int times = 1;        ///< number of occurrences; notes of the same kind are merged

  /// Returns "file:line:column: message (3 times)".
  std::string to_string() const {
    const std::string count = times > 1 ? " (" + std::to_string(times) + " times)" : "";
    return where.to_string() + ": " + message + count;
  }
};

/// A scene of another program as a Pharos render config.
struct Import {
  /// Holds `scene`, `film`, `sampler`, `integrator` and `budget` as far as the file states them.
  /// Every node has the location of the statement in the file, so that later errors name that
  /// place.
  ConfigNode config;
  std::vector<ImportedObject> objects;  ///< in the order of the file
  std::vector<ImportNote> notes;
};

/// Contract: reads scenes of another program. The plugin's name is the extension of that program's
/// files, without the dot and in lower case.
class SceneImporter : public Component {
 public:
  static constexpr std::string_view contract_name = "importer";

  /// Reads the scene. Throws InputError with file, line and column if a part cannot be read.
  virtual Import import(const std::filesystem::path& file) const = 0;
};

}  // namespace pharos
