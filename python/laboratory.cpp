#include <memory>
#include <string>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/experiments/pictures/sampled_points.h>
#include <pharos/laboratory/integrand.h>
#include <pharos/laboratory/point_stream.h>
#include <pharos/sampling/sampler.h>

#include "bindings.h"

namespace pharos::python {
namespace {

template <class Contract>
Ref<Contract> build(const std::string& type, const py::kwargs& settings) {
  BuildContext context{registry()};
  ConfigNode resolved;
  return registry().build<Contract>(plugin_node(type, settings), context, resolved);
}

/// A function on the unit square: `pharos.Integrand`.
class Integrand {
 public:
  Integrand(const std::string& type, const py::kwargs& settings)
      : integrand_(build<laboratory::Integrand>(type, settings)) {}

  double mean() const { return integrand_->mean(); }
  Doubles values(const Doubles& points) const {
    if (points.ndim() != 2 || points.shape(1) != 2) {
      throw InputError("points: expected an array of shape (n, 2)");
    }
    Doubles values(points.shape(0));
    const double* at = points.data();
    double* to = values.mutable_data();
    const py::ssize_t count = points.shape(0);
    const py::gil_scoped_release release;
    for (py::ssize_t i = 0; i < count; ++i, at += 2) to[i] = integrand_->value({at[0], at[1]});
    return values;
  }

 private:
  Ref<laboratory::Integrand> integrand_;
};

/// A generator of points: `pharos.Sampler`.
class Sampler {
 public:
  Sampler(const std::string& type, const py::kwargs& settings)
      : sampler_(build<pharos::Sampler>(type, settings)) {
    if (sampler_->needs_probe()) {
      throw InputError(
          "the sampler looks at a scene before rendering, and has no points without one");
    }
  }

  Floats points(std::uint32_t count, std::uint64_t seed) const {
    std::vector<Vec2> points;
    {
      const py::gil_scoped_release release;
      points = sampled_points(*sampler_, laboratory::kDimension, count, seed);
    }
    Floats array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
    float* to = array.mutable_data();
    for (const Vec2 p : points) *to++ = p.x, *to++ = p.y;
    return array;
  }

 private:
  Ref<pharos::Sampler> sampler_;
};

}  // namespace

void add_laboratory(py::module_& module) {
  py::class_<Integrand>(module, "Integrand",
                        "A function on the unit square whose integral is known in closed form.")
      .def(py::init<const std::string&, const py::kwargs&>(), py::arg("type"),
           "Builds an integrand by its name and settings, as `plugins()['integrand']` lists them. "
           "Raises InputError.")
      .def_property_readonly("mean", &Integrand::mean, "The exact integral.")
      .def("__call__", &Integrand::values, py::arg("points"),
           "Returns the values at points of shape (n, 2). Raises InputError for other shapes.");
  py::class_<Sampler>(module, "Sampler", "A generator of the random numbers of a render.")
      .def(py::init<const std::string&, const py::kwargs&>(), py::arg("type"),
           "Builds a sampler by its name and settings, as `plugins()['sampler']` lists them. "
           "Raises InputError, also for samplers that look at a scene before rendering.")
      .def("points", &Sampler::points, py::arg("count"), py::arg("seed") = 1,
           "Returns the points of one pixel in one pair of dimensions, in an array of shape "
           "(count, 2).");
}

}  // namespace pharos::python
