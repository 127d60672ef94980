#pragma once

#include <string>

#include <pharos/config/node.h>
#include <pharos/core/rgb.h>
#include <pharos/core/transform.h>
#include <pharos/core/vec.h>

/// Nodes of a config, with their location in the file of the other program.
namespace pharos::importing {

ConfigNode number_node(double value, const Location& where);
/// Returns a list of three numbers.
ConfigNode rgb_node(Rgb value, const Location& where);
ConfigNode triple_node(Vec3 value, const Location& where);
ConfigNode transform_node(const Transform& value, const Location& where);
ConfigNode text_node(std::string text, const Location& where);
/// Returns a mapping whose only entry is `type`.
ConfigNode plugin_node(const char* type, const Location& where);

}  // namespace pharos::importing
