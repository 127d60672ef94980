#include "nodes.h"

#include <initializer_list>
#include <utility>

#include <pharos/config/values.h>

namespace pharos::importing {
namespace {

ConfigNode floats_node(std::initializer_list<float> values, const Location& where) {
  ConfigNode list = ConfigNode::sequence(where);
  for (const float x : values) list.items().push_back(ConfigNode::scalar(number_text(x), where));
  return list;
}

}  // namespace

ConfigNode number_node(double value, const Location& where) {
  return ConfigNode::scalar(number_text(value), where);
}

ConfigNode rgb_node(Rgb value, const Location& where) {
  return floats_node({value.r, value.g, value.b}, where);
}

ConfigNode triple_node(Vec3 value, const Location& where) {
  return floats_node({value.x, value.y, value.z}, where);
}

ConfigNode transform_node(const Transform& value, const Location& where) {
  ConfigNode list = ConfigNode::sequence(where);
  for (const auto& row : value.matrix()) {
    for (const float x : row) list.items().push_back(ConfigNode::scalar(number_text(x), where));
  }
  ConfigNode step = ConfigNode::mapping(where);
  step.set("matrix", std::move(list), where);
  return step;
}

ConfigNode text_node(std::string text, const Location& where) {
  return ConfigNode::scalar(std::move(text), where);
}

ConfigNode plugin_node(const char* type, const Location& where) {
  ConfigNode mapping = ConfigNode::mapping(where);
  mapping.set("type", text_node(type, where), where);
  return mapping;
}

}  // namespace pharos::importing
