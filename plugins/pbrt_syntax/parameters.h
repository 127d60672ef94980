#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pharos/core/error.h>

#include "lexer.h"

namespace pharos::pbrt {

/// A parameter such as `"float fov" 45`.
struct Parameter {
  /// "integer", "float", "point2", "vector2", "point3", "vector3", "normal", "bool", "string",
  /// "texture", "spectrum", "rgb" or "blackbody". "point", "vector" and "normal3" are the same as
  /// "point3", "vector3" and "normal".
  std::string type;
  std::string name;
  Location where;  ///< of the declaration
  /// The values, unless they are texts; 0 and 1 for "bool". A value of type "rgb" is three numbers.
  std::vector<double> numbers;
  /// The values of "string" and "texture", and of a "spectrum" that is a name or a file.
  std::vector<std::string> texts;
};
using Parameters = std::vector<Parameter>;

/// Reads all parameters up to the next directive. Throws InputError for unknown types (with the
/// nearest one, or the name in version 4 of a type of version 3), for missing values, values of
/// another type, and counts that are not a multiple of the size of a value.
Parameters read_parameters(Lexer& lexer);

/// Returns the parameter of this name, or null if there is none. Of several the last one counts.
const Parameter* find(const Parameters& parameters, std::string_view name);

}  // namespace pharos::pbrt
