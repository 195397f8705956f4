#include "validation/bench/BenchMatrix.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <span>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/Names.h"
#include "engine/SettingValues.h"
#include "scenes/Limits.h"
#include "scenes/import/JsonReader.h"
#include "validation/bench/MethodKey.h"

namespace tessera::validation {

namespace {

using ParsedJson = nlohmann::json;
using culling::Method;
using engine::Technique;

[[noreturn]] void refuse(const std::string& source, const std::string& key, const std::string& why) {
    throw InputError(fmt::format("{}: \"{}\": {}", source, key, why));
}

std::string nameIn(const std::vector<std::string_view>& names, const ParsedJson& value, const std::string& source,
                   const std::string& key) {
    if (!value.is_string())
        refuse(source, key, fmt::format("{} is no name; {}", value.dump(), suggestNames("", names)));
    const std::string name = value.get<std::string>();
    if (std::ranges::find(names, name) == names.end())
        refuse(source, key, fmt::format("unknown '{}': {}", name, suggestNames(name, names)));
    return name;
}

template <typename Table>
const auto& rowNamed(const Table& table, const ParsedJson& value, const std::string& source, const std::string& key) {
    std::vector<std::string_view> names;
    for (const auto& row : table) names.push_back(row.name);
    const std::string name = nameIn(names, value, source, key);
    return *std::ranges::find_if(table, [&](const auto& row) { return row.name == name; });
}

int numberIn(const ParsedJson& value, int least, int most, const std::string& source, const std::string& key) {
    if (value.is_number_integer() && value >= least && value <= most) return value.get<int>();
    refuse(source, key, fmt::format("{} is no whole number from {} to {}", value.dump(), least, most));
}

glm::ivec2 sizeIn(const ParsedJson& value, const std::string& source, const std::string& key) {
    if (value.is_string())
        if (const std::optional<glm::ivec2> size = frame::sizeIn(value.get<std::string>())) return *size;
    refuse(
        source, key,
        fmt::format("{} is no size such as \"1280x720\", each side 1 to {}", value.dump(), frame::kLargestSidePixels));
}

/// Reads a numeric setting, or the text that leaves it unset, and returns its text.
std::string numberTextIn(const engine::Setting& setting, const ParsedJson& value, const std::string& source) {
    const std::string key(setting.key);
    const bool isOpen = value.is_string() && !setting.value.open.empty() && value == setting.value.open;
    if (!isOpen && !value.is_number()) refuse(source, key, fmt::format("{} is no number", value.dump()));
    try {
        engine::ViewRequest request;
        // 2.0 is a whole number too.
        setting.read(request, isOpen ? std::string(setting.value.open) : engine::numberText(value.get<double>()));
        return setting.text(request);
    } catch (const InputError& error) {
        refuse(source, key, error.what());
    }
}

/// As numberTextIn(), for an on/off setting.
std::string switchTextIn(const ParsedJson& value, const std::string& source, const std::string& key) {
    if (value == "on" || value == "off") return value.get<std::string>();
    if (!value.is_boolean()) refuse(source, key, fmt::format("{} is neither true nor false", value.dump()));
    return value.get<bool>() ? "on" : "off";
}

void addSettingValue(BenchMatrix& matrix, std::string_view key, std::string text) {
    auto values = std::ranges::find(matrix.settings, key, &BenchMatrix::SettingValues::key);
    if (values == matrix.settings.end()) values = matrix.settings.insert(values, {key, {}});
    values->texts.push_back(std::move(text));
}

/// A key of the matrix and the parser of its values.
struct Key {
    std::string_view name;
    std::function<void(BenchMatrix&, const ParsedJson&, const std::string& source)> add;
};

/// The key of a numeric or on/off setting.
Key settingKey(std::string_view key) {
    return {key, [key](BenchMatrix& matrix, const ParsedJson& value, const std::string& source) {
                const engine::Setting& setting = engine::settingOf(key);
                const bool isSwitch = std::holds_alternative<engine::SwitchKind>(setting.value.kind);
                addSettingValue(matrix, key,
                                isSwitch ? switchTextIn(value, source, std::string(key))
                                         : numberTextIn(setting, value, source));
            }};
}

std::vector<Key> makeKeys() {
    std::vector<Key> table{
        {"technique",
         [](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
             m.techniques.push_back(rowNamed(engine::techniqueTable(), v, s, "technique").technique);
         }},
        {"culling",
         [](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
             m.methods.push_back(rowNamed(culling::methodTable(), v, s, "culling").method);
         }},
        {"tile",
         [](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
             const auto isTile = [&](int side) { return v == side; };
             if (!v.is_number_integer() ||
                 std::none_of(std::begin(culling::kTileSides), std::end(culling::kTileSides), isTile))
                 refuse(s, "tile",
                        fmt::format("{}: tiles are {} pixels wide", v.dump(), fmt::join(culling::kTileSides, ", ")));
             m.tilesPixels.push_back(v.get<int>());
         }},
        {"layout", [](BenchMatrix& m, const ParsedJson& v,
                      const std::string& s) { m.layouts.push_back(rowNamed(frame::layoutTable(), v, s, "layout")); }},
        {"lightOn",
         [](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
             m.stages.push_back(rowNamed(frame::lightingStageTable(), v, s, "lightOn").stage);
         }},
        {"lights", [](BenchMatrix& m, const ParsedJson& v,
                      const std::string& s) { m.lights.push_back(numberIn(v, 0, scenes::kMostLights, s, "lights")); }},
        {"range",
         [](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
             if (!v.is_number() || !std::isfinite(v.get<double>()) || v.get<double>() < 0.0)
                 refuse(s, "range",
                        fmt::format("{} is no range tolerance; give 0, which ends no light, or more", v.dump()));
             m.rangeTolerances.push_back(v.get<double>());
         }},
        {"size", [](BenchMatrix& m, const ParsedJson& v,
                    const std::string& s) { m.sizesPixels.push_back(sizeIn(v, s, "size")); }},
    };
    for (const MethodKindInfo& info : methodKindTable()) {
        table.push_back({info.key, [&info](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
                             addSettingValue(m, info.key, nameIn(info.names(), v, s, std::string(info.key)));
                         }});
        for (const MethodSetting& row : info.settings) table.push_back(settingKey(row.key));
    }
    return table;
}

const std::vector<Key>& keys() {
    static const std::vector<Key> table = makeKeys();
    return table;
}

} // namespace

std::string matrixKeys() {
    std::string names;
    for (const Key& key : keys()) names += (names.empty() ? "" : ", ") + std::string(key.name);
    return names;
}

BenchMatrix parseMatrix(std::string_view json, const std::string& source, scenes::LoadLedger& ledger) {
    const ParsedJson root = scenes::parseJson(json, source, ledger);
    if (!root.is_object()) throw InputError(fmt::format("{}: must be an object of arrays", source));
    BenchMatrix matrix;
    double points = 1.0;
    for (const auto& [name, values] : root.items()) {
        std::vector<std::string_view> names;
        const Key* found = nullptr;
        for (const Key& key : keys()) {
            names.push_back(key.name);
            if (key.name == name) found = &key;
        }
        if (!found) throw InputError(fmt::format("{}: unknown key '{}': {}", source, name, suggestNames(name, names)));
        if (!values.is_array() || values.empty()) {
            const bool isEntry = values.is_primitive() && !values.is_null();
            refuse(source, name,
                   fmt::format("must be an array with at least one entry{}",
                               isEntry ? fmt::format(", as in {{\"{}\": [{}]}}", name, values.dump()) : ""));
        }
        points *= double(values.size());
        if (points > double(kMostMatrixPoints)) continue; // stops reading values, but still counts points
        for (const ParsedJson& value : values) found->add(matrix, value, source);
    }
    if (!root.contains("technique")) points *= double(engine::techniqueTable().size());
    double variants = 1.0;
    for (const BenchMatrix::SettingValues& values : matrix.settings) variants *= double(values.texts.size());
    const bool hasTooManyPoints = points > double(kMostMatrixPoints);
    if (hasTooManyPoints || variants > double(kMostMatrixVariants))
        throw InputError(fmt::format("{}: needs {:.3g} {}, the product of its lists' lengths; at most {} can be "
                                     "measured: shorten the lists, or divide them over several runs",
                                     source, hasTooManyPoints ? points : variants,
                                     hasTooManyPoints ? "points" : "combinations of settings",
                                     hasTooManyPoints ? kMostMatrixPoints : kMostMatrixVariants));
    return matrix;
}

} // namespace tessera::validation
