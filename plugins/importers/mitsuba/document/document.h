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

/// A Mitsuba scene file as a tree of objects with typed properties, the same for both dialects (0.x
/// and 2/3, distinguished by the version of the outermost tag). Variables, includes and references
/// are resolved. Names of properties are those of dialect 2/3 (`toWorld` becomes `to_world`,
/// `intIOR` becomes `int_ior`), and so are tags (`luminaire` becomes `emitter`, `camera` becomes
/// `sensor`). Types of objects and the values of strings remain as written, except that types of
/// dialect 0.x are converted to lower case, as Mitsuba 0.x does.
namespace pharos::mitsuba {

/// The language of a scene file. Dialect 0.x writes names of properties in camelCase, 2 and 3 in
/// snake_case.
enum class Dialect { mitsuba_0, mitsuba_2 };

struct Object;

/// A color, and how the file gives it: by `rgb`, `srgb`, `spectrum` or `blackbody`.
struct Spectrum {
  Rgb value;                  ///< linear Rec.709
  bool is_gray = false;       ///< written as one number
  bool approximated = false;  ///< converted to RGB from a list over wavelengths or from a
                              ///< temperature
};

/// A vector or point.
struct Triple {
  Vec3 value;
};

/// A property of an object: a plain value, or a nested object. Plain values have names, which are
/// unique within an object.
struct Property {
  using Value = std::variant<bool, std::int64_t, double, std::string, Triple, Transform, Spectrum,
                             std::shared_ptr<const Object>>;
  std::string name;  ///< may be empty for nested objects
  Location where;    ///< of its tag; for a reference, of the tag `ref`
  Value value;
};

/// One object: a shape, bsdf, emitter and so on. All references to an object share the same Object.
/// Objects and references are nested at most 64 deep, without cycles, and expand to at most ten
/// million objects if all references are followed.
struct Object {
  /// "scene", "shape", "bsdf", "emitter", "sensor", "texture", "film", "sampler", "integrator",
  /// "rfilter", "medium", "phase", "volume", "subsurface", "field". A `spectrum` with a type is a
  /// "texture".
  std::string tag;
  std::string type;  ///< "roughplastic"; empty for the scene
  std::string id;    ///< empty if there is none
  Location where;
  std::vector<Property> properties;  ///< nested objects among them, in order

  /// Returns the property of this name, or null if there is none.
  const Property* find(std::string_view name) const;
};

/// A scene file after reading.
struct Document {
  std::shared_ptr<const Object> scene;
  /// The folder of the outermost file, to which the file names in the scene are relative.
  std::filesystem::path folder;
  /// Further folders to search before `folder`, in this order: the folders of `path` tags.
  std::vector<std::filesystem::path> resource_folders;
  Dialect dialect = Dialect::mitsuba_2;  ///< of the outermost file
  /// Notes about parts that are read differently from the file: animations, tags added by other
  /// programs.
  std::vector<ImportNote> notes;
};

/// Reads a scene file. `parameters` are values of variables by name; they take precedence over the
/// values that the file gives by `default`. Throws InputError with file, line and column for bad
/// XML, unknown tags (with the nearest known tag), bad numbers, unknown variables and ids, cyclic
/// includes and references, nesting deeper than 64, document types (they define entities), and more
/// than a million elements or 256 MiB in all files together. Also throws InputError for parameters
/// that the scene does not use.
Document read_document(const std::filesystem::path& file,
                       const std::map<std::string, std::string>& parameters = {});

}  // namespace pharos::mitsuba
