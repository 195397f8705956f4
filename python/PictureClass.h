#pragma once
#include <pybind11/pybind11.h>

namespace tessera::python {

/// Adds the class tessera.Picture, which wraps Rendered.
void definePicture(pybind11::module_& module);

} // namespace tessera::python
