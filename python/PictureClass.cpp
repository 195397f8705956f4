#include "python/PictureClass.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "base/Error.h"
#include "base/Extension.h"
#include "base/OneLine.h"
#include "base/PictureFile.h"
#include "python/Arguments.h"
#include "python/Work.h"

namespace py = pybind11;

namespace tessera::python {

namespace {

/// A read-only array that refers to the image's memory and keeps the image alive.
template <typename T>
py::array viewOf(const py::object& owner, const T* data, std::vector<py::ssize_t> shape,
                 std::vector<py::ssize_t> strides) {
    py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// `channels` channels of RGBA from channel `first`: height x width x channels, or height x width for one channel.
py::array channelsOf(const py::object& self, int first, int channels) {
    const auto& picture = self.cast<const Rendered&>().picture;
    constexpr py::ssize_t kFloat = sizeof(float);
    std::vector<py::ssize_t> shape{picture.height, picture.width}, strides{4 * kFloat * picture.width, 4 * kFloat};
    if (channels > 1) {
        shape.push_back(channels);
        strides.push_back(kFloat);
    }
    return viewOf(self, picture.rgba.data() + first, std::move(shape), std::move(strides));
}

py::array displayOf(const py::object& self) {
    const DisplayImage& image = self.cast<const Rendered&>().shown;
    return viewOf(self, image.rgb.data(), {image.height, image.width, 3}, {3 * image.width, 3, 1});
}

py::bytes pngOf(const Rendered& rendered) {
    std::vector<std::uint8_t> bytes;
    {
        const py::gil_scoped_release unlocked;
        bytes = encodePng(rendered.shown).bytes;
    }
    return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void savePicture(const Rendered& rendered, const py::handle& to) {
    const std::string path = pathOf(to, "path");
    const std::string extension = extensionOf(path);
    if (extension != ".exr" && extension != ".png")
        throw InputError(
            fmt::format("{}: pictures end in .exr (linear, 32 bit) or .png (as a display shows it)", path));
    const py::gil_scoped_release unlocked;
    if (extension == ".png")
        writePng(path, rendered.shown);
    else
        writeExr(path, rendered.picture);
}

} // namespace

void definePicture(py::module_& module) {
    py::class_<Rendered>(module, "Picture", R"(A picture that render() has made. Rows run from the top.

Arrays are views of the picture's own memory, which they keep alive; they cannot be written to. A notebook shows the
picture as a display does.)")
        .def_property_readonly(
            "width", [](const Rendered& self) { return self.picture.width; }, "Pixels in a row.")
        .def_property_readonly(
            "height", [](const Rendered& self) { return self.picture.height; }, "Rows.")
        .def_property_readonly(
            "scene", [](const Rendered& self) { return fileNameOf(self.scene); }, "Name of the scene.")
        .def_readonly("technique", &Rendered::technique, "Name of the technique.")
        .def_readonly("view", &Rendered::view, "Name of the view: final, or a debug view.")
        .def_property_readonly(
            "rgba", [](const py::object& self) { return channelsOf(self, 0, 4); },
            "float32, height x width x 4: linear Rec.709 radiance before exposure, or the values of a debug view; A is "
            "the share of the pixel that is covered.")
        .def_property_readonly(
            "rgb", [](const py::object& self) { return channelsOf(self, 0, 3); }, "The first three channels of rgba.")
        .def_property_readonly(
            "alpha", [](const py::object& self) { return channelsOf(self, 3, 1); }, "The last channel of rgba.")
        .def_property_readonly("display", &displayOf,
                               "uint8, height x width x 3: as a display shows it, with exposure and tone map. Views "
                               "with a legend are larger than the picture.")
        .def("png", &pngOf, "The display picture as the bytes of a PNG file.")
        .def("_repr_png_", &pngOf)
        .def("save", &savePicture, py::arg("path"),
             "Writes the picture whole or not at all: .exr is linear, 32 bits a channel, .png as a display shows it.")
        .def(
            "__array__",
            [](const py::object& self, const py::object& dtype, const py::object& copy) {
                const py::object array = channelsOf(self, 0, 4);
                const bool copies = !copy.is_none() && copy.cast<bool>();
                const py::object type = dtype.is_none() ? py::object(array.attr("dtype")) : dtype;
                return py::object(array.attr("astype")(type, py::arg("copy") = copies));
            },
            py::arg("dtype") = py::none(), py::arg("copy") = py::none())
        .def("__repr__", [](const Rendered& self) {
            return fmt::format("<tessera.Picture {}x{} of {}, {}, {}>", self.picture.width, self.picture.height,
                               oneLine(self.scene), self.technique, self.view);
        });
}

} // namespace tessera::python
