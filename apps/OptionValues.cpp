#include "apps/OptionValues.h"

#include <algorithm>
#include <string_view>

#include "apps/Commands.h"
#include "apps/Completion.h"
#include "apps/Options.h"
#include "engine/Settings.h"
#include "engine/Techniques.h"
#include "scenes/Environment.h"
#include "scenes/ImportOptions.h"
#include "scenes/Load.h"
#include "validation/stress/StressCase.h"

namespace tessera::app {

namespace {

template <typename Table>
std::vector<std::string> namesOfRows(const Table& table) {
    std::vector<std::string> names;
    for (const auto& row : table) names.emplace_back(row.name);
    return names;
}

std::vector<std::string> with(std::vector<std::string> names, std::string_view more) {
    names.emplace_back(more);
    return names;
}

ValueText oneTechnique() {
    return {.names = namesOfRows(engine::techniqueTable())};
}
ValueText someTechniques() {
    return {.names = namesOfRows(engine::techniqueTable()), .isList = true};
}
ValueText techniqueOrReference() {
    return {.names = with(namesOfRows(engine::techniqueTable()), kReferenceName)};
}
ValueText truthOfCompare() {
    return {.names = techniqueOrReference().names, .isFile = true};
}
ValueText truthOfBench() {
    return {.names = {kReferenceName, std::string(infoOf(engine::Technique::Forward).name)}};
}
ValueText contexts() {
    return {.names = contextNames()};
}
ValueText environments() {
    return {.names = with(namesOfRows(scenes::builtinEnvironments()), scenes::kNoEnvironment), .isFile = true};
}
ValueText lightUnits() {
    return {.names = namesOfRows(scenes::kLightUnits)};
}
ValueText objColours() {
    return {.names = namesOfRows(scenes::kObjColours)};
}
ValueText shells() {
    return {.names = namesOfRows(shellTable())};
}

/// Cases of the stability suite, and their groups.
ValueText stressNames() {
    ValueText text;
    for (const validation::StressCase& row : validation::stressCases()) {
        const std::string group = row.name.substr(0, row.name.find('/'));
        if (std::ranges::find(text.names, group) == text.names.end()) text.names.push_back(group);
        if (row.name != group) text.names.push_back(row.name);
    }
    return text;
}

/// Values of options that are not settings.
struct OwnValues {
    std::string_view command; ///< empty: every command
    std::string_view option;  ///< its name, or the type of an operand
    ValueText (*values)();
};
constexpr OwnValues kOwnValues[] = {
    {"render", "--technique", techniqueOrReference},
    {"", "--techniques", someTechniques}, // before --technique, its alias in `stress`
    {"", "--technique", oneTechnique},
    {"compare", "--against", truthOfCompare},
    {"bench", "--against", truthOfBench},
    {"stress", "--case", stressNames},
    {"", "--context", contexts},
    {"", "--environment", environments},
    {"", "--light-units", lightUnits},
    {"", "--obj-colours", objColours},
    {"", "SHELL", shells},
};

ValueText valuesOfKind(const engine::ChoiceKind& kind) {
    return {.names = namesOfRows(kind.entries)};
}
ValueText valuesOfKind(const engine::SwitchKind&) {
    return {.names = {"on", "off"}};
}
ValueText valuesOfKind(const engine::NumberKind&) {
    return {};
}
ValueText valuesOfKind(const engine::SizeKind&) {
    return {};
}
ValueText valuesOfKind(const engine::CameraKind&) {
    return {};
}

} // namespace

ValueText valuesOf(const std::string& command, const OptionText& option) {
    const std::string name = option.names.empty() ? option.type : option.names.back();
    for (const OwnValues& row : kOwnValues) {
        const bool isNamed = row.option == name || std::ranges::find(option.names, row.option) != option.names.end();
        if (isNamed && (row.command.empty() || row.command == command)) return row.values();
    }
    for (const engine::Setting& setting : engine::settingTable()) {
        if (setting.flag != name) continue;
        ValueText text = std::visit([](const auto& kind) { return valuesOfKind(kind); }, setting.value.kind);
        const std::string open(setting.value.open);
        if (!open.empty() && std::ranges::find(text.names, open) == text.names.end()) text.names.push_back(open);
        return text;
    }
    if (option.type == "SCENE") return {.names = namesOfRows(scenes::builtinScenes()), .isFile = true};
    return {.isFile = option.type == "FILE", .isFolder = option.type == "DIR"};
}

} // namespace tessera::app
