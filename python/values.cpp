#include "values.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/config/values.h>
#include <pharos/core/error.h>
#include <pharos/laboratory/integrands/add_integrands.h>

namespace pharos::python {
namespace {

std::string type_of(const py::handle& value) {
  return py::str(py::type::of(value).attr("__name__"));
}

/// The place of a value in a config: its path of keys and its depth.
struct Place {
  std::string path;
  int depth = 0;

  Place inner(const std::string& key) const { return {path.empty() ? key : path + key, depth + 1}; }
};

ConfigNode node_at(const py::handle& value, const Place& place);

ConfigNode mapping_of(const py::dict& dictionary, const Place& place) {
  const Location where{place.path};
  ConfigNode node = ConfigNode::mapping(where);
  for (const auto& [key, value] : dictionary) {
    if (!py::isinstance<py::str>(key)) {
      throw InputError(where, fmt::format("expected keys that are strings, found a key of type {}",
                                          type_of(key)));
    }
    const auto name = key.cast<std::string>();
    const Place inner = place.inner(place.path.empty() ? name : "." + name);
    node.set(name, node_at(value, inner), {inner.path});
  }
  return node;
}

ConfigNode sequence_of(const py::sequence& list, const Place& place) {
  ConfigNode node = ConfigNode::sequence({place.path});
  for (std::size_t i = 0; i < list.size(); ++i) {
    node.items().push_back(node_at(list[i], place.inner(fmt::format("[{}]", i))));
  }
  return node;
}

/// Returns a number as YAML writes it, with all its digits.
ConfigNode number_of(const py::handle& value, const Location& where) {
  const std::string text = number_text(value.cast<double>());
  if (text.empty()) throw InputError(where, "expected a finite number");
  return ConfigNode::scalar(text, where);
}

ConfigNode node_at(const py::handle& value, const Place& place) {
  constexpr int kDeepest = 64;
  const Location where{place.path};
  if (place.depth > kDeepest) throw InputError(where, "values are nested deeper than 64 levels");
  if (value.is_none()) return ConfigNode::null(where);
  if (py::isinstance<py::bool_>(value)) {
    return ConfigNode::scalar(value.cast<bool>() ? "true" : "false", where);
  }
  if (py::isinstance<py::str>(value)) return ConfigNode::scalar(value.cast<std::string>(), where);
  if (py::isinstance<py::int_>(value)) {
    return ConfigNode::scalar(py::str(value).cast<std::string>(), where);
  }
  if (py::isinstance<py::float_>(value)) return number_of(value, where);
  if (py::isinstance<py::dict>(value)) {
    return mapping_of(py::reinterpret_borrow<py::dict>(value), place);
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    return sequence_of(py::reinterpret_borrow<py::sequence>(value), place);
  }
  const Place same{place.path, place.depth + 1};
  if (py::hasattr(value, "tolist")) return node_at(value.attr("tolist")(), same);  // of numpy
  if (is_path(value)) return node_at(value.attr("__fspath__")(), same);
  throw InputError(where, fmt::format("expected a dictionary, a list, a string, a number or None, "
                                      "found a value of type {}",
                                      type_of(value)));
}

py::object scalar_of(const std::string& text) {
  if (text == "true" || text == "false") return py::bool_(text == "true");
  if (!is_number(text)) return py::str(text);
  long long whole = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, whole);
  if (error == std::errc() && rest == end) return py::int_(whole);
  return py::float_(py::str(text));
}

/// The channels of an image that form a layer.
struct LayerChannels {
  std::string name;
  std::vector<int> channels;
};

std::vector<LayerChannels> layers_in(const Image& image) {
  std::vector<LayerChannels> all;
  for (int c = 0; c < image.channel_count(); ++c) {
    const std::string& channel = image.channels()[c];
    const std::size_t dot = channel.rfind('.');
    const std::string name = dot == std::string::npos ? "image" : channel.substr(0, dot);
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const LayerChannels& layer) { return layer.name == name; });
    if (known != all.end()) known->channels.push_back(c);
    if (known == all.end()) all.push_back({name, {c}});
  }
  return all;
}

}  // namespace

const Registry& registry() {
  static const Registry loaded = [] {
    Registry all = load_default_modules();
    laboratory::add_integrands(all);
    return all;
  }();
  return loaded;
}

bool is_path(const py::handle& value) {
  return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
}

ConfigNode node_of(const py::handle& value) {
  return node_at(value, {});
}

py::object object_of(const ConfigNode& node) {
  switch (node.kind()) {
    case ConfigNode::Kind::null:
      return py::none();
    case ConfigNode::Kind::scalar:
      return scalar_of(node.text());
    case ConfigNode::Kind::sequence: {
      py::list list;
      for (const ConfigNode& item : node.items()) list.append(object_of(item));
      return list;
    }
    default: {
      py::dict dictionary;
      for (const ConfigNode::Entry& entry : node.entries()) {
        dictionary[py::str(entry.key)] = object_of(entry.value);
      }
      return dictionary;
    }
  }
}

ConfigNode plugin_node(const std::string& type, const py::kwargs& settings) {
  ConfigNode node = node_of(settings);
  node.set("type", ConfigNode::scalar(type));
  return node;
}

py::dict layers_of(const Image& image) {
  py::dict layers;
  for (const auto& [name, channels] : layers_in(image)) {
    std::vector<py::ssize_t> shape{image.height(), image.width()};
    const auto depth = static_cast<py::ssize_t>(channels.size());
    if (depth > 1) shape.push_back(depth);
    py::array_t<float> layer(shape);
    float* value = layer.mutable_data();
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        for (const int c : channels) *value++ = image.pixel(x, y)[c];
      }
    }
    layers[py::str(name)] = layer;
  }
  return layers;
}

Image image_of(const py::object& value, const char* name) {
  if (is_path(value)) {
    const auto path = value.cast<std::filesystem::path>();
    const py::gil_scoped_release release;
    return read_image(path);
  }
  const auto array = Floats::ensure(value);
  const bool is_gray = array && array.ndim() == 2;
  if (!array || !(is_gray || (array.ndim() == 3 && array.shape(2) == 3)) || array.size() == 0) {
    PyErr_Clear();  // of the conversion
    throw InputError(fmt::format("{}: expected a file or an array of height x width x 3", name));
  }
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), {"R", "G", "B"});
  std::vector<float>& values = image.values();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = array.data()[is_gray ? i / 3 : i];
  return image;
}

std::vector<Vec3> vectors_of(const Floats& array, const char* name) {
  const bool is_one = array.ndim() == 1 && array.shape(0) == 3;
  if (!is_one && !(array.ndim() == 2 && array.shape(1) == 3)) {
    throw InputError(fmt::format("{}: expected an array of shape (n, 3)", name));
  }
  std::vector<Vec3> vectors(static_cast<std::size_t>(array.size() / 3));
  const float* value = array.data();
  for (Vec3& v : vectors) {
    v = {value[0], value[1], value[2]};
    if (!is_finite(v)) throw InputError(fmt::format("{}: expected finite numbers", name));
    value += 3;
  }
  return vectors;
}

}  // namespace pharos::python
