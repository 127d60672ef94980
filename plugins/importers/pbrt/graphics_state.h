#pragma once

#include <map>
#include <memory>
#include <string>

#include <pharos/config/node.h>
#include <pharos/core/transform.h>

#include "colors.h"
#include "statements.h"

namespace pharos::pbrt {

/// The settings that apply to the directives that follow. AttributeBegin saves them.
struct GraphicsState {
  Transform to_world;  ///< the current transformation matrix
  bool reverse_orientation = false;
  std::string material;                          ///< an entry of `materials`; empty: the default
  std::shared_ptr<const ConfigNode> area_light;  ///< null: none
  std::string inside, outside;                   ///< names of media; empty: vacuum
  ColorSpace space = ColorSpace::srgb;
  bool moves_start = true;  ///< whether transforms apply to the start of the exposure
  /// Parameters by `Attribute`, for "shape", "light", "material", "medium" and "texture"; null if
  /// there are none.
  std::shared_ptr<const std::map<std::string, Parameters>> attributes;
};

}  // namespace pharos::pbrt
