#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/core/rgb.h>
#include <pharos/core/transform.h>
#include <pharos/core/vec.h>
#include <pharos/scene/importer.h>

/// A Mitsuba scene file as a tree of objects with typed properties, the same for both dialects
/// (0.x and 2/3, told apart by the version of the outermost tag): variables, includes and
/// references are resolved, names of properties are those of dialect 2/3 (`toWorld` reads as
/// `to_world`, `intIOR` as `int_ior`), tags too (`luminaire` reads as `emitter`, `camera` as
/// `sensor`). Types of objects and the values of strings stay as they are written, but for types of
/// dialect 0.x, which read in lower case, as Mitsuba 0.x takes them.
namespace pharos::mitsuba {

/// The language of a scene file: 0.x writes names of properties in camelCase, 2 and 3 in
/// snake_case.
enum class Dialect { mitsuba_0, mitsuba_2 };

struct Object;

/// A color, and how it was written: by `rgb`, `srgb`, `spectrum` or `blackbody`.
struct Spectrum {
  Rgb value;                  ///< linear Rec.709
  bool is_gray = false;       ///< written as one number
  bool approximated = false;  ///< a list over wavelengths or a temperature, brought to RGB
};

/// A vector or point.
struct Triple {
  Vec3 value;
};

/// A property of an object: a plain value, or an object inside it. Plain values have a name, and
/// no two of an object the same one.
struct Property {
  using Value = std::variant<bool, std::int64_t, double, std::string, Triple, Transform, Spectrum,
                             std::shared_ptr<const Object>>;
  std::string name;  ///< may be empty for nested objects
  Location where;    ///< of its tag; for a reference of the tag `ref`
  Value value;
};

/// One object: a shape, bsdf, emitter and so on. An object that is referenced from several places
/// is one object; objects and references are nested at most 64 deep and without cycles, and stand
/// for ten million objects at most when they are followed.
struct Object {
  /// "scene", "shape", "bsdf", "emitter", "sensor", "texture", "film", "sampler", "integrator",
  /// "rfilter", "medium", "phase", "volume", "subsurface", "field"; a `spectrum` with a type is a
  /// "texture".
  std::string tag;
  std::string type;  ///< "roughplastic"; empty for the scene
  std::string id;    ///< empty when there is none
  Location where;
  std::vector<Property> properties;  ///< nested objects among them, in order

  /// The property of this name; null when there is none.
  const Property* find(std::string_view name) const;
};

/// A scene file that was read.
struct Document {
  std::shared_ptr<const Object> scene;
  /// Folder that file names in the scene are relative to: that of the outermost file.
  std::filesystem::path folder;
  /// Further folders to look for them in, before `folder`, the first one first: those of `path`
  /// tags.
  std::vector<std::filesystem::path> resource_folders;
  Dialect dialect = Dialect::mitsuba_2;  ///< of the outermost file
  /// What is read in another way than the file says: animations, tags that other programs added.
  std::vector<ImportNote> notes;
};

/// Reads a scene file. `parameters` are values of variables by name, before those that the file
/// gives by `default`. Throws InputError with file, line and column: bad XML, unknown tags (with
/// the nearest known one), bad numbers, unknown variables and ids, cyclic includes and references,
/// nesting deeper than 64, document types (they define entities), more than a million elements or
/// 256 MiB in all files together; and for parameters that the scene has no use for.
Document read_document(const std::filesystem::path& file,
                       const std::map<std::string, std::string>& parameters = {});

}  // namespace pharos::mitsuba
