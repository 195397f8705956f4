#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "apps/Request.h"

/// Conversion of Python arguments to command-line options, and of file names to Python strings.
namespace tessera::python {

/// Adds keywords to the options; None leaves an option unset. Throws TypeError for values of the wrong type and for
/// keywords unknown to `function`, naming the nearest ones; InputError like the command line. `further`: additional
/// keywords of the function.
void takeKeywords(const pybind11::kwargs& keywords, std::string_view function, app::FrameOptions& options,
                  const std::vector<std::string_view>& further = {});

/// The path or name in a str or os.PathLike. Throws TypeError, or InputError for a name that no file can have.
std::string pathOf(const pybind11::handle& value, std::string_view called);
/// The paths or names in a str, an os.PathLike or a sequence of them. Throws TypeError.
std::vector<std::string> pathsOf(const pybind11::handle& value, std::string_view called);
/// A camera or clip of the scene: its name, or its number counted from 0. Throws TypeError.
std::string nameOrNumberOf(const pybind11::handle& value, std::string_view called);

/// A whole number, or nothing for None. Throws TypeError, or InputError if it does not fit an int.
std::optional<int> wholeNumberOf(const pybind11::handle& value, std::string_view called);

/// A file name, or a name that may come from one, as os.fsdecode() decodes it: it may hold bytes that are not UTF-8.
pybind11::str fileNameOf(const std::string& name);

} // namespace tessera::python
