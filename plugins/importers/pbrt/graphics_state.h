#pragma once

#include <map>
#include <memory>
#include <string>

#include <pharos/core/transform.h>

#include "colors.h"
#include "statements.h"

namespace pharos::pbrt {

/// What later directives depend on; AttributeBegin saves it.
struct GraphicsState {
  Transform to_world;  ///< the current transformation matrix
  bool reverse_orientation = false;
  std::string material;  ///< an entry of `materials`; empty: the default
  std::shared_ptr<const Statement> area_light;
  std::string inside, outside;  ///< names of media; empty: vacuum
  ColorSpace space = ColorSpace::srgb;
  /// Parameters by `Attribute`, for "shape", "light", "material", "medium" and "texture".
  std::map<std::string, Parameters> attributes;
};

}  // namespace pharos::pbrt
