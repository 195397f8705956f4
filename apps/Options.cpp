#include "apps/Options.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/Numbers.h"

namespace tessera::app {

namespace {

/// "none, studio (purpose), ..."
std::string environmentNames() {
    std::string names(scenes::kNoEnvironment);
    for (const scenes::BuiltinEnvironment& builtin : scenes::builtinEnvironments())
        names += fmt::format(", {} ({})", builtin.name, builtin.purpose);
    return names;
}

void addSettings(CLI::App& command, FrameOptions& options, std::string_view group) {
    for (const engine::Setting& setting : engine::settingTable()) {
        if (setting.group != group) continue;
        const std::string byItself =
            setting.byItself.empty() ? setting.text(engine::ViewRequest()) : std::string(setting.byItself);
        const std::string range = setting.range().empty() ? "" : fmt::format(" ({})", setting.range());
        const auto say = [&options, &setting](const std::string& text) {
            options.settings.insert_or_assign(std::string(setting.key), text);
        };
        command
            .add_option_function<std::string>(std::string(setting.flag), say,
                                              fmt::format("{}{} [{}]", setting.help, range, byItself))
            ->type_name(std::string(setting.type))
            ->group(std::string(group));
        if (setting.key == "time") // next to the other light options
            addWholeNumber(command, "--lights", options.lights,
                           "Built-in scenes make this many lights, files keep their first N", "N")
                ->group(std::string(group));
        if (setting.key == "time")
            command
                .add_option(
                    "--clip", options.clip,
                    "The clip of the scene that plays, by name or counted from 0, or none [that of the scene, else "
                    "its first]")
                ->type_name("NAME")
                ->group(std::string(group));
        if (setting.key == "time")
            addHookValues(command, "--hook", options.hookValues,
                          "Sets a parameter of the scene's hook, within its bounds; may be repeated", "NAME=VALUE")
                ->group(std::string(group));
    }
}

} // namespace

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
    app.add_flag("--quiet", options.quiet, "Errors only: no warnings, no progress");
    app.add_flag("--verbose", options.verbose, "More detail; with --version the driver's limits too");
    const auto check = [&options](const std::string& name) {
        contextKind(name);
        options.context = name;
    };
    app.add_option_function<std::string>(
           "--context", check,
           "Where pictures are made: window, egl (needs no display), or auto, which tries "
           "egl first [auto]")
        ->type_name("KIND");
}

std::unique_ptr<gpu::Context> makeContext(const GlobalOptions& options) {
    gpu::ContextOptions contextOptions;
    contextOptions.kind = contextKind(options.context);
    std::unique_ptr<gpu::Context> context = gpu::Context::create(contextOptions);
    spdlog::debug("{} by {}", context->capabilities().renderer, context->capabilities().contextWay);
    return context;
}

void addFrameOptions(CLI::App& command, FrameOptions& options, const std::string& defaultScene) {
    options.scene = defaultScene;
    const std::string preset = defaultScene.empty() ? "" : " [" + defaultScene + "]";
    CLI::Option* scene = command.add_option(
        "scene", options.scene, "A .gltf, .glb, .obj or .json file, or a built-in scene (tessera scenes)" + preset);
    scene->type_name("SCENE");
    if (defaultScene.empty()) scene->required();
    addFrameSettings(command, options);
}

void addFrameSettings(CLI::App& command, FrameOptions& options) {
    addSettings(command, options, "Frame");
    command
        .add_flag("--no-default-light", options.noDefaultLight,
                  "Supplies no studio: only the scene's own lights are used")
        ->group("Frame");
    command
        .add_option("--environment", options.environment,
                    "Lights the scene from all directions: " + environmentNames() +
                        ", a picture in latitude and longitude, or a glTF model with an image-based light [the "
                        "scene's own]")
        ->type_name("NAME")
        ->group("Environment");
    addPoint(command, "--background", options.background,
             "Linear radiance behind the scene where no environment is seen [the scene's own]", "R,G,B")
        ->group("Environment");
    addSettings(command, options, "Environment");
    addSettings(command, options, "Shadows");
    addSettings(command, options, "Subsurface scattering");
    command
        .add_option("--memory-limit", options.memoryLimit,
                    "The most memory that reading a scene may take, as in 512M or 4G [half of the machine's]")
        ->type_name("SIZE")
        ->group("Reading");
    command
        .add_option("--variant", options.import.variant,
                    "Shows the models in this variant of their materials; a name that none has is refused with a list "
                    "of those there are [the materials without a variant]")
        ->type_name("NAME")
        ->group("Reading");
    command
        .add_option_function<std::string>(
            "--light-units", [&options](const std::string& name) { options.import.lightUnits = lightUnitsNamed(name); },
            "What the numbers of a glTF model's lights count: watt takes them as they are, lumen divides them by 683 "
            "[lumen for models that Blender exported, else watt]")
        ->type_name("NAME")
        ->group("Reading");
    command
        .add_option_function<std::string>(
            "--obj-colours", [&options](const std::string& name) { options.import.objColours = objColoursNamed(name); },
            "The encoding of the vertex colours of OBJ models: srgb or linear [srgb]")
        ->type_name("NAME")
        ->group("Reading");
    command
        .add_flag(
            "--strict", options.import.isStrict,
            "Refuses a model with a flaw that can be repaired, such as a picture that cannot be read; else warns of it")
        ->group("Reading");
    command
        .add_flag("--default-camera", options.defaultCamera,
                  "Shows all of the scene by the camera that one without cameras gets, in the place of its own")
        ->group("Camera");
    addPoint(command, "--eye", options.pose.eyeWS, "Moves the camera there; alone it looks the same way", "X,Y,Z")
        ->group("Camera");
    addPoint(command, "--target", options.pose.targetWS, "Turns the camera to look there", "X,Y,Z")->group("Camera");
    addPoint(command, "--up", options.pose.upWS, "What is up in the picture [0,1,0 where the camera turns]", "X,Y,Z")
        ->group("Camera");
    addNumber(command, "--fov", options.pose.fovYDegrees, "Vertical field of view of a perspective camera", "DEGREES")
        ->group("Camera");
    addNumber(command, "--half-height", options.pose.halfHeightMetres,
              "Half the height of an orthographic camera's view", "METRES")
        ->group("Camera");
    addNumber(command, "--near", options.pose.nearMetres, "Nothing nearer is drawn", "METRES")->group("Camera");
    addNumber(command, "--far", options.pose.farMetres, "Nothing farther is drawn", "METRES")->group("Camera");
    addSettings(command, options, "Display");
}

} // namespace tessera::app
