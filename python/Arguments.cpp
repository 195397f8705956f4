#include "python/Arguments.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "apps/Keywords.h"
#include "base/Error.h"

namespace py = pybind11;

namespace tessera::python {

namespace {

[[noreturn]] void refuseType(std::string_view called, std::string_view needed, const py::handle& value) {
    throw py::type_error(fmt::format("{} is {}; {} is needed", called, Py_TYPE(value.ptr())->tp_name, needed));
}

/// The text of a str in UTF-8.
std::string textOf(const py::handle& value, std::string_view called) {
    py::ssize_t size = 0;
    const char* const text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
    if (text == nullptr) {
        PyErr_Clear();
        throw InputError(fmt::format("{} holds half of a surrogate pair, which is no character; leave it out", called));
    }
    return {text, std::size_t(size)};
}

[[noreturn]] void refuseHugeNumber(std::string_view called) {
    PyErr_Clear();
    throw InputError(fmt::format("{} is a larger number than any that has a meaning here", called));
}

bool isNumber(const py::handle& value) {
    return !PyBool_Check(value.ptr()) &&
           (PyIndex_Check(value.ptr()) || PyFloat_Check(value.ptr()) || py::hasattr(value, "__float__"));
}

double numberOf(const py::handle& value, std::string_view called) {
    if (!isNumber(value)) refuseType(called, "a number", value);
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() && PyErr_ExceptionMatches(PyExc_OverflowError)) refuseHugeNumber(called);
    if (PyErr_Occurred()) throw py::error_already_set();
    return number;
}

/// A number as command-line text; whole numbers, including NumPy's, keep all digits.
std::string numberTextOf(const py::handle& value, std::string_view called) {
    if (!PyIndex_Check(value.ptr())) return fmt::format("{}", numberOf(value, called));
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!whole) throw py::error_already_set();
    // Python refuses to format numbers of thousands of digits.
    const auto text = py::reinterpret_steal<py::str>(PyObject_Str(whole.ptr()));
    if (!text) refuseHugeNumber(called);
    return text;
}

bool isList(const py::handle& value) {
    return PySequence_Check(value.ptr()) && !PyUnicode_Check(value.ptr()) && !PyBytes_Check(value.ptr());
}

/// The items of a sequence, tuple or array, such as (640, 360).
std::vector<py::object> itemsOf(const py::handle& value) {
    std::vector<py::object> items;
    for (const py::handle item : py::iter(value)) items.push_back(py::reinterpret_borrow<py::object>(item));
    return items;
}

/// A setting's value of any kind, as command-line text.
std::string settingText(const engine::Setting& setting, std::string_view called, const py::handle& value) {
    if (PyUnicode_Check(value.ptr())) return textOf(value, called);
    if (PyBool_Check(value.ptr())) {
        if (!std::holds_alternative<engine::SwitchKind>(setting.value.kind))
            refuseType(called, "a str or a number", value);
        return value.cast<bool>() ? "on" : "off";
    }
    if (!isList(value)) { // arrays pass isNumber() too
        if (!isNumber(value)) refuseType(called, "a str, a number, a bool or (width, height)", value);
        return numberTextOf(value, called);
    }
    std::string text;
    for (const py::object& item : itemsOf(value)) text += (text.empty() ? "" : "x") + numberTextOf(item, called);
    return text;
}

app::KeywordValue loadValue(app::KeywordKind kind, std::string_view called, const py::handle& value) {
    app::KeywordValue taken;
    switch (kind) {
    case app::KeywordKind::WholeNumber:
    case app::KeywordKind::Number:
        taken.number = numberOf(value, called);
        break;
    case app::KeywordKind::Switch:
        if (!PyBool_Check(value.ptr())) refuseType(called, "a bool", value);
        taken.isOn = value.cast<bool>();
        break;
    case app::KeywordKind::Text:
        taken.text = pathOf(value, called);
        break;
    case app::KeywordKind::TextOrNumber:
        taken.text = nameOrNumberOf(value, called);
        break;
    case app::KeywordKind::Point: {
        const std::vector<py::object> items = isList(value) ? itemsOf(value) : std::vector<py::object>();
        if (items.size() != 3) refuseType(called, "three numbers, such as (0, 1.5, -2),", value);
        for (glm::length_t i = 0; i < 3; ++i) taken.point[i] = numberOf(items[std::size_t(i)], called);
        break;
    }
    case app::KeywordKind::Hooks:
        if (!py::isinstance<py::dict>(value)) refuseType(called, "a dict of names and numbers", value);
        for (const auto& [name, number] : py::reinterpret_borrow<py::dict>(value)) {
            if (!PyUnicode_Check(name.ptr())) refuseType(called, "a dict of names and numbers", name);
            taken.hooks.push_back({textOf(name, called), float(numberOf(number, called))});
        }
        break;
    }
    return taken;
}

void takeOne(const std::string& word, const py::handle& value, std::string_view function,
             const std::vector<std::string_view>& further, app::FrameOptions& options) {
    for (const engine::Setting& setting : engine::settingTable()) {
        if (app::keywordOf(setting.flag) != word) continue;
        if (value.is_none()) return;
        options.settings.insert_or_assign(std::string(setting.key), settingText(setting, word, value));
        return;
    }
    for (const app::LoadKeyword& row : app::loadKeywords()) {
        if (row.keyword != word) continue;
        if (value.is_none()) return;
        app::takeKeyword(word, loadValue(row.kind, word, value), options);
        return;
    }
    throw py::type_error(
        fmt::format("{}() has no keyword '{}': {}", function, word, app::suggestKeywords(word, further)));
}

} // namespace

void takeKeywords(const py::kwargs& keywords, std::string_view function, app::FrameOptions& options,
                  const std::vector<std::string_view>& further) {
    for (const auto& [word, value] : keywords) {
        takeOne(textOf(word, "a keyword"), value, function, further, options);
    }
}

std::string pathOf(const py::handle& value, std::string_view called) {
    const auto path = py::reinterpret_steal<py::object>(PyOS_FSPath(value.ptr()));
    if (!path) {
        PyErr_Clear();
        refuseType(called, "a str or a path", value);
    }
    // File names may hold bytes that are not UTF-8.
    PyObject* encoded = nullptr;
    if (PyUnicode_FSConverter(path.ptr(), &encoded) == 0) {
        PyErr_Clear();
        throw InputError(fmt::format("{} holds a character that no name of a file can have", called));
    }
    return py::reinterpret_steal<py::bytes>(encoded);
}

std::vector<std::string> pathsOf(const py::handle& value, std::string_view called) {
    if (!isList(value)) return {pathOf(value, called)};
    std::vector<std::string> paths;
    for (const py::object& item : itemsOf(value)) paths.push_back(pathOf(item, called));
    return paths;
}

std::string nameOrNumberOf(const py::handle& value, std::string_view called) {
    return isNumber(value) ? numberTextOf(value, called) : pathOf(value, called);
}

std::optional<int> wholeNumberOf(const py::handle& value, std::string_view called) {
    if (value.is_none()) return std::nullopt;
    if (PyBool_Check(value.ptr()) || !PyIndex_Check(value.ptr())) refuseType(called, "a whole number", value);
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!whole) throw py::error_already_set();
    int overflow = 0;
    const long number = PyLong_AsLongAndOverflow(whole.ptr(), &overflow);
    if (overflow != 0 || number != long(int(number))) refuseHugeNumber(called);
    return int(number);
}

py::str fileNameOf(const std::string& name) {
    auto decoded = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<py::ssize_t>(name.size())));
    if (!decoded) throw py::error_already_set();
    return py::str(std::move(decoded));
}

} // namespace tessera::python
