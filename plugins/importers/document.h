#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/core/rgb.h>
#include <pharos/core/transform.h>
#include <pharos/core/vec.h>

/// A Mitsuba scene file as a tree of objects with typed properties, the same for both dialects
/// (0.5/0.6 and 2/3): variables, includes and references are resolved, names are those of dialect
/// 2/3 (`toWorld` reads as `to_world`, `intIOR` as `int_ior`), tags too (`luminaire` reads as
/// `emitter`, `camera` as `sensor`).
namespace pharos::mitsuba {

struct Object;

/// A colour, and how it was written.
struct Spectrum {
  Rgb value;                  ///< linear Rec.709
  bool is_grey = false;       ///< written as one number
  bool approximated = false;  ///< a list over wavelengths or a temperature, brought to RGB
};

/// A vector or point.
struct Triple {
  Vec3 value;
};

struct Property {
  using Value = std::variant<bool, std::int64_t, double, std::string, Triple, Transform, Spectrum,
                             std::shared_ptr<const Object>>;
  std::string name;  ///< may be empty for nested objects
  Location where;
  Value value;
};

/// One object: a shape, bsdf, emitter and so on. An object that is referenced from several places
/// is one object.
struct Object {
  std::string tag;   ///< "scene", "shape", "bsdf", "emitter", "sensor", "texture", "film", …
  std::string type;  ///< "roughplastic"; empty for the scene
  std::string id;    ///< empty when there is none
  Location where;
  std::vector<Property> properties;  ///< nested objects among them, in order

  /// The property of this name; null when there is none.
  const Property* find(std::string_view name) const;
};

struct Document {
  std::shared_ptr<const Object> scene;
  /// Folder that file names in the scene are relative to: that of the outermost file.
  std::filesystem::path folder;
};

/// Reads a scene file. Throws InputError with file, line and column: bad XML, unknown tags (with
/// the nearest known one), bad numbers, unknown variables and ids, cyclic includes, nesting deeper
/// than 64, entities, more than a million elements.
Document read_document(const std::filesystem::path& file);

}  // namespace pharos::mitsuba
