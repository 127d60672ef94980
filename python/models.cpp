#include "models.h"

#include <algorithm>
#include <cmath>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <pharos/core/error.h>
#include <pharos/experiments/pictures/learned_file.h>

#include "bindings.h"

namespace pharos::python {
namespace {

LearnedModel read_model(const std::filesystem::path& path, std::size_t index) {
  const Registry& plugins = registry();
  const py::gil_scoped_release release;
  LearnedFile file = read_learned_file(path, plugins);
  if (index >= file.models.size()) {
    throw InputError(
        fmt::format("index: expected a number below {}, the number of models, found {}",
                    file.models.size(), index));
  }
  return {file.head.models[index].learner, std::move(file.models[index])};
}

py::dict facts_of(const ModelInfo& info) {
  py::dict facts;
  for (const ModelFact& fact : info.facts) facts[py::str(fact.name)] = fact.value;
  return facts;
}

/// Returns two corners, or None if the model has no bounds.
py::object bounds_of(const ModelInfo& info) {
  if (info.bounds.empty()) return py::none();
  const auto corner = [](Point3 p) { return py::make_tuple(p.x, p.y, p.z); };
  return py::make_tuple(corner(info.bounds.low), corner(info.bounds.high));
}

constexpr const char* kReadHelp =
    R"(Reads a model file, which a render writes as output.model.

A file with several models has them in the order of the config. Raises InputError.)";

constexpr const char* kDensityHelp =
    R"(Returns the learned density at points of shape (n, 3), or for a direction at each point.

It is known up to a constant factor. Directions may have any length above zero. One point or one
direction goes with all of the others. Raises InputError for other shapes and for numbers that are
not finite.)";

/// Returns the direction of a vector of any finite length above zero.
Vec3 unit_vector(Vec3 v) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) throw InputError("directions: expected none of length zero");
  return normalize(v / largest);
}

}  // namespace

GuidingModel::GuidingModel(const std::filesystem::path& file, std::size_t index)
    : learned_(read_model(file, index)) {}

Doubles GuidingModel::density(const Floats& points, const std::optional<Floats>& directions) const {
  const std::vector<Vec3> at = vectors_of(points, "points");
  std::vector<Vec3> toward;
  if (directions) toward = vectors_of(*directions, "directions");
  const bool may_pair = at.size() == toward.size() || at.size() == 1 || toward.size() == 1;
  if (directions && !may_pair) {
    throw InputError(
        fmt::format("directions: expected 1 or {}, found {}", at.size(), toward.size()));
  }
  for (Vec3& d : toward) d = unit_vector(d);
  const bool is_empty = at.empty() || (directions && toward.empty());
  const std::size_t count = is_empty ? 0 : std::max(at.size(), toward.size());
  Doubles densities(static_cast<py::ssize_t>(count));
  double* const values = densities.mutable_data();
  const py::gil_scoped_release release;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const Vec3* direction = directions ? &toward[toward.size() == 1 ? 0 : i] : nullptr;
    values[i] = learned_.model->density(at[at.size() == 1 ? 0 : i], direction);
  });
  return densities;
}

void add_models(py::module_& module) {
  const auto info_of = [](const auto& get) {
    return [get](const GuidingModel& model) { return get(model.info()); };
  };
  py::class_<GuidingModel>(module, "GuidingModel", "A model that guides have learned.")
      .def(py::init<const std::filesystem::path&, std::size_t>(), py::arg("file"),
           py::arg("index") = 0, kReadHelp)
      .def_property_readonly("learner", &GuidingModel::learner, "The name of the learner.")
      .def_property_readonly("name", info_of([](const ModelInfo& info) { return info.name; }),
                             "The kind of model.")
      .def_property_readonly("bytes", info_of([](const ModelInfo& info) { return info.bytes; }),
                             "Memory in use [bytes].")
      .def_property_readonly("regions", info_of([](const ModelInfo& info) { return info.regions; }),
                             "The number of spatial cells.")
      .def_property_readonly("facts", info_of(facts_of), "Further facts by name, as text.")
      .def_property_readonly(
          "bounds", info_of(bounds_of),
          "The lower and the upper corner of the region with positive density, or None.")
      .def("density", &GuidingModel::density, py::arg("points"), py::arg("directions") = py::none(),
           kDensityHelp)
      .def("__repr__", [](const GuidingModel& m) {
        return fmt::format("<pharos.GuidingModel '{}', learned by '{}', {} regions>", m.info().name,
                           m.learner(), m.info().regions);
      });
}

}  // namespace pharos::python
