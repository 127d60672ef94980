#include <exception>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include <pharos/core/error.h>

#include "bindings.h"

namespace pharos::python {
namespace {

py::object exception_class(const char* name) {
  return py::module_::import("pharos.exceptions").attr(name);
}

void raise(const InputError& error, const std::vector<std::string>& flaws) {
  const Location where = error.where();
  const auto known = [](int number) {
    return number > 0 ? py::object(py::int_(number)) : py::none();
  };
  const py::object type = exception_class("InputError");
  const py::object file = where.file.empty() ? py::object(py::none()) : py::str(where.file);
  const py::object raised = type(error.what(), file, known(where.line), known(where.column), flaws);
  PyErr_SetObject(type.ptr(), raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const InputErrors& errors) {
    std::vector<std::string> flaws;
    for (const InputError& error : errors.all()) flaws.emplace_back(error.what());
    raise(errors, flaws);
  } catch (const InputError& error) {
    raise(error, {error.what()});
  } catch (const RunError& error) {
    PyErr_SetString(exception_class("RunError").ptr(), error.what());
  }
}

}  // namespace

void add_exceptions() {
  py::register_exception_translator(translate);
}

}  // namespace pharos::python
