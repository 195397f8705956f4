#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "apps/Keywords.h"
#include "apps/OutputFolder.h"
#include "apps/Version.h"
#include "base/Error.h"
#include "base/OneLine.h"
#include "python/Arguments.h"
#include "python/Log.h"
#include "python/PictureClass.h"
#include "python/Work.h"

/// The Python module's interface. Work.h declares the functions behind it.
namespace tessera::python {

namespace {

namespace py = pybind11;

// ---- Scenes --------------------------------------------------------------------------------------------------------

/// tessera.Scene.
struct PyScene {
    SceneObject object;
    SceneFacts facts;
    explicit PyScene(app::FrameOptions options) : object(std::move(options)) {}
};

std::shared_ptr<PyScene> loadScene(const py::handle& source, const py::object& progress, const py::kwargs& keywords) {
    app::FrameOptions options;
    options.scene = pathOf(source, "source");
    takeKeywords(keywords, "load", options, {"progress"});
    auto scene = std::make_shared<PyScene>(std::move(options));
    Worker::get().run(progress, [&](Job& job) { scene->facts = load(scene->object, job); });
    return scene;
}

/// The given scene, or one loaded by name for this call only, and its options extended by the keywords.
struct Given {
    std::shared_ptr<PyScene> scene;
    app::FrameOptions options;
};

Given given(const py::handle& scene, const py::kwargs& keywords, std::string_view function,
            const std::vector<std::string_view>& further) {
    Given taken;
    if (py::isinstance<PyScene>(scene)) {
        taken.scene = scene.cast<std::shared_ptr<PyScene>>();
        taken.options = taken.scene->object.options();
    } else {
        taken.options.scene = pathOf(scene, "scene");
        taken.scene = std::make_shared<PyScene>(taken.options);
    }
    takeKeywords(keywords, function, taken.options, further);
    return taken;
}

// ---- Functions -----------------------------------------------------------------------------------------------------

py::object parsedJson(const std::string& text) {
    return py::module_::import("json").attr("loads")(text);
}

std::unique_ptr<Rendered> renderPicture(const py::handle& scene, const py::object& progress,
                                        const py::kwargs& keywords) {
    const Given what = given(scene, keywords, "render", {"progress"});
    auto rendered = std::make_unique<Rendered>();
    Worker::get().run(progress, [&](Job& job) { *rendered = render(what.scene->object, what.options, job); });
    return rendered;
}

/// A str, or several joined: "forward,deferred".
std::string techniquesOf(const py::object& techniques) {
    std::string text;
    if (techniques.is_none()) return text;
    for (const std::string& name : pathsOf(techniques, "techniques")) text += (text.empty() ? "" : ",") + name;
    return text;
}

py::object comparePictures(const py::handle& scene, const py::object& techniques, const py::object& against,
                           const py::object& progress, const py::kwargs& keywords) {
    const Given what = given(scene, keywords, "compare", {"techniques", "against", "progress"});
    app::ComparisonOptions options;
    options.frame = what.options;
    options.techniques = techniquesOf(techniques);
    options.against = pathOf(against, "against");
    std::string json;
    Worker::get().run(progress, [&](Job& job) { json = compareJson(what.scene->object, options, job); });
    return parsedJson(json);
}

py::object planFrame(const py::handle& scene, const py::object& also, bool measure, const py::kwargs& keywords) {
    const Given what = given(scene, keywords, "plan", {"also", "measure"});
    app::PlanningOptions options;
    options.frame = what.options;
    options.measure = measure;
    if (PyUnicode_Check(also.ptr()) || PyIndex_Check(also.ptr()))
        options.also = {nameOrNumberOf(also, "also")};
    else
        for (const py::handle camera : also) options.also.push_back(nameOrNumberOf(camera, "also"));
    std::string json;
    Worker::get().run(py::none(), [&](Job& job) { json = planJson(what.scene->object, options, job); });
    return parsedJson(json);
}

/// A folder of the given name, or a temporary one that the destructor removes.
class BenchFolder {
public:
    explicit BenchFolder(const py::object& output) : isOwn_(output.is_none()) {
        path_ = isOwn_ ? pathOf(py::module_::import("tempfile").attr("mkdtemp")("", "tessera-bench-"), "output")
                       : pathOf(output, "output");
        if (!isOwn_) app::makeFolder(path_);
    }
    ~BenchFolder() {
        std::error_code ignored;
        if (isOwn_) std::filesystem::remove_all(path_, ignored);
    }
    BenchFolder(const BenchFolder&) = delete;
    BenchFolder& operator=(const BenchFolder&) = delete;
    const std::string& path() const { return path_; }

private:
    bool isOwn_;
    std::string path_;
};

py::object benchScenes(const py::handle& scenes, const py::object& matrix, const py::object& against,
                       const py::object& frames, const py::object& output, bool resume, const py::object& progress,
                       const py::kwargs& keywords) {
    BenchRequest request;
    takeKeywords(keywords, "bench", request.options.frame,
                 {"matrix", "against", "frames", "output", "resume", "progress"});
    request.options.scenes = pathsOf(scenes, "scenes");
    if (request.options.scenes.empty()) throw InputError("bench needs a scene to measure");
    if (!matrix.is_none()) request.matrix = py::module_::import("json").attr("dumps")(matrix).cast<std::string>();
    if (!against.is_none()) request.options.against = pathOf(against, "against");
    request.options.frames = wholeNumberOf(frames, "frames");
    if (resume && output.is_none()) throw InputError("resume needs output: the folder of the run to go on with");
    request.resumes = resume;
    request.command = "tessera.bench() of Python";
    const BenchFolder folder(output);
    request.folder = folder.path();
    std::string json;
    Worker::get().run(progress, [&](Job& job) { json = benchJson(request, job); });
    return parsedJson(json);
}

// ---- Tables --------------------------------------------------------------------------------------------------------

py::list listScenes() {
    py::list rows;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes())
        rows.append(py::dict(py::arg("name") = builtin.name, py::arg("purpose") = builtin.purpose));
    return rows;
}

py::list listTechniques() {
    py::list names;
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) names.append(py::str(std::string(info.name)));
    names.append(py::str(app::kReferenceName));
    return names;
}

py::list listViews() {
    py::list rows;
    for (const frame::DebugViewInfo& view : frame::debugViewTable())
        rows.append(py::dict(py::arg("name") = view.name, py::arg("meaning") = view.meaning));
    return rows;
}

py::list listSettings() {
    py::list rows;
    for (const engine::Setting& setting : engine::settingTable()) {
        py::object values = py::none();
        if (const auto* choice = std::get_if<engine::ChoiceKind>(&setting.value.kind)) {
            py::list names;
            for (const engine::ChoiceKind::Entry& entry : choice->entries) names.append(py::str(entry.name));
            values = names;
        }
        rows.append(py::dict(py::arg("keyword") = app::keywordOf(setting.flag), py::arg("flag") = setting.flag,
                             py::arg("key") = setting.key, py::arg("type") = setting.type,
                             py::arg("default") = setting.text(engine::ViewRequest()), py::arg("values") = values,
                             py::arg("range") = setting.range(), py::arg("help") = app::withKeywords(setting.help)));
    }
    return rows;
}

py::list listLoadOptions() {
    py::list rows;
    for (const app::LoadKeyword& row : app::loadKeywords())
        rows.append(py::dict(py::arg("keyword") = row.keyword, py::arg("help") = row.help));
    return rows;
}

// ---- Errors --------------------------------------------------------------------------------------------------------

/// Raises a Python error, with flags replaced by keywords. File names in it may hold bytes that are not UTF-8.
void raise(PyObject* type, const char* what) {
    const std::string text = app::withKeywords(what);
    const auto message =
        py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "replace"));
    PyErr_SetObject(type, message.ptr());
}

void translateErrors(py::module_& module) {
    // Never destroyed: static destructors run after the interpreter has ended.
    static const auto* const inputError = new py::exception<InputError>(module, "InputError", PyExc_ValueError);
    inputError->attr("__doc__") =
        "What was given cannot be used: a missing or broken file, an unknown name, a value out "
        "of range. The text says what, where, and what to do.";
    py::register_exception_translator([](std::exception_ptr error) {
        try {
            if (error) std::rethrow_exception(error);
        } catch (const InputError& bad) {
            raise(inputError->ptr(), bad.what());
        } catch (const Stopped& stopped) {
            raise(PyExc_KeyboardInterrupt, stopped.what());
        }
    });
}

void defineScene(py::module_& module) {
    py::class_<PyScene, std::shared_ptr<PyScene>> scene(module, "Scene", R"(A scene that load() has read.

It is kept in memory with all that was derived from it: programs, textures, the filtered environment. Keywords that
load() was given hold for all that is done with it, unless they are said anew.)");
    const auto fact = [&scene](const char* name, auto member, const char* meaning) {
        scene.def_property_readonly(
            name, [member](const PyScene& self) { return self.facts.*member; }, meaning);
    };
    scene.def_property_readonly(
        "name", [](const PyScene& self) { return fileNameOf(self.facts.name); },
        "Its name: that of its file, without the ending, unless the file says another.");
    fact("triangles", &SceneFacts::triangles, "How many triangles it draws.");
    fact("lights", &SceneFacts::lights, "How many lights it has.");
    fact("materials", &SceneFacts::materials, "How many materials it has.");
    fact("cameras", &SceneFacts::cameras, "Names of its cameras, in order.");
    fact("notes", &SceneFacts::notes, "What the load did that is good to know.");
    scene.def_property_readonly(
        "files",
        [](const PyScene& self) {
            py::list files;
            for (const std::string& file : self.facts.files) files.append(fileNameOf(file));
            return files;
        },
        "The files that it was read from.");
    scene.def("__repr__", [](const PyScene& self) {
        return fmt::format("<tessera.Scene {}: {} triangles, {} lights>", oneLine(self.facts.name),
                           self.facts.triangles, self.facts.lights);
    });
}

void defineFunctions(py::module_& module) {
    module.def("load", &loadScene, py::arg("source"), py::kw_only(), py::arg("progress") = py::none(),
               R"(load(source, *, progress=None, **keywords) -> Scene

Reads a scene: a built-in one's name, or the path of a .gltf, .glb, .obj or .json file. Keywords are those of the command
line: load_options() and settings() list them.)");
    module.def("render", &renderPicture, py::arg("scene"), py::kw_only(), py::arg("progress") = py::none(),
               R"(render(scene, *, progress=None, **keywords) -> Picture

Renders a scene, what load() gave or what it takes. technique='reference' renders by formulas in double precision; view
names what to show. progress(done, expected) is called where the work has steps.)");
    module.def("compare", &comparePictures, py::arg("scene"), py::kw_only(), py::arg("techniques") = py::none(),
               py::arg("against") = "forward", py::arg("progress") = py::none(),
               R"(compare(scene, *, techniques=None, against='forward', progress=None, **keywords) -> dict

Renders the scene with several techniques, all by default, and measures how they differ from the truth: a technique,
'reference', or the path of a picture. The dictionary is that of tessera compare --json.)");
    module.def("plan", &planFrame, py::arg("scene"), py::kw_only(), py::arg("also") = py::tuple(),
               py::arg("measure") = false,
               R"(plan(scene, *, also=(), measure=False, **keywords) -> dict

What a frame runs, what it leaves out and why, and what it costs; `also` names cameras of further views, `measure` fills
in milliseconds. The dictionary is that of tessera plan --json.)");
    module.def(
        "bench", &benchScenes, py::arg("scenes"), py::kw_only(), py::arg("matrix") = py::none(),
        py::arg("against") = py::none(), py::arg("frames") = py::none(), py::arg("output") = py::none(),
        py::arg("resume") = false, py::arg("progress") = py::none(),
        R"(bench(scenes, *, matrix=None, against=None, frames=None, output=None, resume=False, progress=None, **keywords) -> dict

Measures error against run time: every technique and culling method, or the combinations of a matrix such as
{'tile': [8, 16], 'lights': [64, 256]}. `output` names a folder that keeps the run, which `resume` then goes on with. The
dictionary is the bench.json of tessera bench.)");
    module.def("scenes", &listScenes, "scenes() -> list of dict\n\nThe built-in scenes: name and purpose.");
    module.def("techniques", &listTechniques, "techniques() -> list of str\n\nThe techniques, and the reference.");
    module.def("views", &listViews, "views() -> list of dict\n\nWhat the setting view shows: name and meaning.");
    module.def("settings", &listSettings,
               "settings() -> list of dict\n\nThe settings that are keywords: each with its flag of the command line, "
               "its key in scene files, default, values and help.");
    module.def("load_options", &listLoadOptions,
               "load_options() -> list of dict\n\nFurther keywords, on how a scene is loaded and the camera moved.");
    module.def(
        "use_context", [](const std::string& kind) { Worker::get().chooseContext(app::contextKind(kind)); },
        py::arg("kind"),
        "use_context(kind) -> None\n\nWhere pictures are made: 'egl', 'window' or 'auto', which tries egl first. To be "
        "called before the first picture.");
}

} // namespace

} // namespace tessera::python

PYBIND11_MODULE(tessera, module) {
    using namespace tessera::python;
    pybind11::options options;
    options.disable_function_signatures();
    module.doc() =
        "Tessera renders scenes with many lights by several techniques, and checks that their pictures agree.";
    keepLog();
    translateErrors(module);
    defineScene(module);
    definePicture(module);
    defineFunctions(module);
    module.attr("__version__") = TESSERA_VERSION;
    module.attr("__commit__") = tessera::app::kCommit;
    // Ends the worker while the interpreter still exists, as the worker's callers wait for the interpreter's lock.
    pybind11::module_::import("atexit").attr("register")(
        pybind11::cpp_function([] { Worker::get().end(); }, pybind11::call_guard<pybind11::gil_scoped_release>()));
}
