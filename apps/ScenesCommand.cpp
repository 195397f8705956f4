#include <fmt/format.h>

#include "apps/Commands.h"
#include "scenes/Load.h"
#include "scenes/Schema.h"

namespace tessera::app {

namespace {

int listScenes() {
    fmt::print("{:<9} {:>9} {:>7} {:>10}  {}\n", "scene", "triangles", "lights", "materials", "what it is for");
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        const scenes::Scene scene = scenes::loadScene(std::string(builtin.name));
        fmt::print("{:<9} {:>9} {:>7} {:>10}  {}\n", builtin.name, scenes::triangleCount(scene), scene.lights.size(),
                   scene.materials.size(), builtin.purpose);
    }
    return kGood;
}

int printSchema() {
    fmt::print("{}\n", scenes::sceneSchema());
    return kGood;
}

} // namespace

void addScenesCommand(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("scenes", "Lists the built-in scenes");
    auto schema = std::make_shared<bool>(false);
    command->add_flag("--schema", *schema, "Prints the JSON Schema of .json scenes instead, for editors");
    command->callback([schema, &run] { run = *schema ? printSchema : listScenes; });
}

} // namespace tessera::app
