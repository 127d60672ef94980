#pragma once

#include "values.h"

/// Each function adds a part of the module.
namespace pharos::python {

void add_exceptions();
void add_renders(py::module_& module);
void add_comparisons(py::module_& module);
void add_models(py::module_& module);
void add_laboratory(py::module_& module);

}  // namespace pharos::python
