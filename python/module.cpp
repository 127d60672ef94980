// pharos._pharos: the compiled part of the Python package. It only converts values; the work is
// done by the libraries.
#include <pharos/core/log.h>
#include <pharos/core/version.h>

#include "bindings.h"

PYBIND11_MODULE(_pharos, module) {
  using namespace pharos;
  set_log_quiet(true);
  module.attr("__version__") = version();
  python::add_exceptions();
  python::add_models(module);
  python::add_renders(module);
  python::add_comparisons(module);
  python::add_laboratory(module);
}
