#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/Commands.h"
#include "scenes/Load.h"
#include "scenes/Schema.h"

namespace tessera::app {

namespace {

int listScenes() {
    fmt::print("{:<15} {:>9} {:>7} {:>10}  {}\n", "scene", "triangles", "lights", "materials", "what it is for");
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes())
        fmt::print("{:<15} {:>9} {:>7} {:>10}  {}\n", builtin.name, builtin.triangles, builtin.lights,
                   builtin.materials, builtin.purpose);
    return kGood;
}

using Json = nlohmann::ordered_json;

Json schemaOf(const engine::ChoiceKind& kind) {
    Json names = Json::array();
    for (const engine::ChoiceKind::Entry& entry : kind.entries) {
        if (kind.ofNumbers)
            names.push_back(std::stoi(entry.name));
        else
            names.push_back(entry.name);
    }
    Json named{{"enum", std::move(names)}};
    if (!kind.orCount) return named;
    return {{"anyOf", Json::array({std::move(named), Json{{"type", "integer"}, {"minimum", 0}}})}};
}

Json schemaOf(const engine::NumberKind& kind) {
    Json schema{{"type", kind.isWhole ? "integer" : "number"}};
    if (std::isfinite(kind.least)) schema["minimum"] = kind.least;
    if (std::isfinite(kind.most)) schema["maximum"] = kind.most;
    return schema;
}

Json schemaOf(const engine::SwitchKind&) {
    return {{"type", "boolean"}};
}

Json schemaOf(const engine::SizeKind&) {
    const Json side{{"type", "integer"}, {"minimum", 1}, {"maximum", frame::kLargestSidePixels}};
    return {{"type", "array"}, {"items", side}, {"minItems", 2}, {"maxItems", 2}};
}

Json schemaOf(const engine::CameraKind&) {
    return {{"$ref", "#/definitions/name"}};
}

/// Prints the scene schema with the settings added, which the scene module does not contain.
int printSchema() {
    Json schema = Json::parse(scenes::sceneSchema());
    Json& options = schema["definitions"]["options"];
    for (const engine::Setting& setting : engine::settingTable()) {
        if (!setting.isRequestable) continue;
        Json own = std::visit([](const auto& kind) { return schemaOf(kind); }, setting.value.kind);
        if (!setting.value.open.empty()) own = {{"anyOf", {std::move(own), {{"const", setting.value.open}}}}};
        if (!own.contains("$ref")) own["description"] = setting.help;
        options["properties"][std::string(setting.key)] = std::move(own);
    }
    options["additionalProperties"] = false;
    fmt::print("{}\n", schema.dump(2));
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
