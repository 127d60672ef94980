#include <filesystem>
#include <pybind11/stl/filesystem.h>
#include <string>

#include <pharos/experiments/metrics/metrics.h>

#include "bindings.h"

namespace pharos::python {
namespace {

ImageErrors measured(const Image& image, const Image& reference, float exposure) {
  const py::gil_scoped_release release;
  return measure(image, reference, Display{exposure});
}

py::dict dictionary_of(const ImageErrors& errors) {
  py::dict all;
  for (const MetricInfo& info : metric_infos()) {
    all[py::str(std::string(info.key))] = errors[info.metric];
  }
  all["invalid_pixels"] = errors.invalid_pixels;
  return all;
}

py::dict errors(const py::object& image, const py::object& reference, float exposure) {
  return dictionary_of(
      measured(image_of(image, "image"), image_of(reference, "reference"), exposure));
}

py::dict compare(const py::object& a, const py::object& b, const py::object& reference,
                 float exposure) {
  const Image truth = image_of(reference, "reference");
  const ImageErrors of_a = measured(image_of(a, "a"), truth, exposure);
  const ImageErrors of_b = measured(image_of(b, "b"), truth, exposure);
  py::dict ratios;
  for (const MetricInfo& info : metric_infos()) {
    if (!info.has_ratios) continue;
    ratios[py::str(std::string(info.key))] = of_b[info.metric] / of_a[info.metric];
  }
  py::dict all;
  all["a"] = dictionary_of(of_a);
  all["b"] = dictionary_of(of_b);
  all["ratio"] = ratios;
  return all;
}

py::dict read_layers(const std::filesystem::path& file) {
  return layers_of(read_image(file));
}

}  // namespace

void add_comparisons(py::module_& module) {
  module.def("errors", errors, py::arg("image"), py::arg("reference"), py::kw_only(),
             py::arg("exposure") = 0.0f,
             "Returns the errors of an image by metric. Images are files, or arrays of height x "
             "width x 3. `exposure` [stops] counts for 'psnr' and 'flip'. Raises InputError.");
  module.def("compare", compare, py::arg("a"), py::arg("b"), py::arg("reference"), py::kw_only(),
             py::arg("exposure") = 0.0f,
             "Returns the errors of two images as 'a' and 'b', and as 'ratio' the errors of `b` "
             "divided by "
             "the errors of `a`. Arguments are as in `errors`.");
  module.def("read_image", read_layers, py::arg("file"),
             "Returns the layers of an image file as `render` does. Raises InputError.");
}

}  // namespace pharos::python
