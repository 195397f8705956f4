#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "apps/Request.h"

/// What Python's callers give, as the options of the command line; and names of files that they are given.
namespace tessera::python {

/// Adds keywords to the options; None says nothing. Throws TypeError, as Python does, for a word that is no keyword of
/// `function`, with the nearest ones, and for values of another type; InputError as the command line does. `further`
/// are keywords that the function has besides.
void takeKeywords(const pybind11::kwargs& keywords, std::string_view function, app::FrameOptions& options,
                  const std::vector<std::string_view>& further = {});

/// The path or name that a str or os.PathLike stands for. Throws TypeError, or InputError for one that no file can
/// have.
std::string pathOf(const pybind11::handle& value, std::string_view called);
/// A str, or what is iterated over, each such a path or name. Throws TypeError.
std::vector<std::string> pathsOf(const pybind11::handle& value, std::string_view called);
/// A camera of the scene or a clip: a name, or a number counted from 0. Throws TypeError.
std::string nameOrNumberOf(const pybind11::handle& value, std::string_view called);

/// A whole number, or nothing for None. Throws TypeError, or InputError for one that no int holds.
std::optional<int> wholeNumberOf(const pybind11::handle& value, std::string_view called);

/// A name of a file, or one that may come from there, as os.fsdecode() gives it: it may hold bytes that are no UTF-8.
pybind11::str fileNameOf(const std::string& name);

} // namespace tessera::python
