#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include <pharos/config/node.h>
#include <pharos/config/registry.h>
#include <pharos/core/image.h>
#include <pharos/core/vec.h>

/// Conversions between Python's values and those of Pharos. All functions need the GIL.
namespace pharos::python {

namespace py = pybind11;

/// Arrays of floats in C order. Other arrays and lists of numbers are converted.
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Returns the plugins of all default folders, and the integrands of the laboratory. They are
/// loaded at the first call.
const Registry& registry();

/// Returns a dictionary, list, string, number, truth value, path or None as a config. The location
/// of each node is its path of keys in place of a file. Throws InputError for other values, and for
/// values nested deeper than 64 levels.
ConfigNode node_of(const py::handle& value);
/// Returns a config as dictionaries, lists, strings, numbers, truth values and None.
py::object object_of(const ConfigNode& node);

/// Returns the settings of a plugin as a config: `type` and the keyword arguments.
ConfigNode plugin_node(const std::string& type, const py::kwargs& settings);

/// Returns the layers of an image as arrays: "image" for the channels R, G and B, and the others by
/// the part of their names before the dot. Layers of one channel have two dimensions.
py::dict layers_of(const Image& image);
/// Returns whether a value names a file: a string or a path.
bool is_path(const py::handle& value);
/// Reads an image file, or takes an array of height x width x 3, or of height x width for gray.
/// Throws InputError that calls the image `name`.
Image image_of(const py::object& value, const char* name);

/// Returns an array of shape (n, 3), or one point of shape (3), as vectors. Throws InputError that
/// calls the array `name`, also if a number is not finite.
std::vector<Vec3> vectors_of(const Floats& array, const char* name);

}  // namespace pharos::python
