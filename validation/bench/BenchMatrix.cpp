#include "validation/bench/BenchMatrix.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/Names.h"
#include "scenes/Limits.h"
#include "scenes/import/JsonText.h"

namespace tessera::validation {

namespace {

using ParsedJson = nlohmann::json;
using culling::Method;
using engine::Technique;

constexpr const char* kNoShadows =
    "benchmarks do not vary shadows yet; give --shadows, which holds for all points, and leave the key out";
constexpr const char* kNoSubsurface =
    "this version has no subsurface scattering, so there is nothing to vary; leave the key out";

[[noreturn]] void refuse(const std::string& source, const std::string& key, const std::string& why) {
    throw InputError(fmt::format("{}: \"{}\": {}", source, key, why));
}

template <typename Table>
const auto& rowNamed(const Table& table, const ParsedJson& value, const std::string& source, const std::string& key) {
    std::vector<std::string_view> names;
    for (const auto& row : table) names.push_back(row.name);
    if (!value.is_string())
        refuse(source, key, fmt::format("{} is no name; {}", value.dump(), suggestNames("", names)));
    const std::string name = value.get<std::string>();
    for (const auto& row : table) {
        if (row.name == name) return row;
    }
    refuse(source, key, fmt::format("unknown '{}': {}", name, suggestNames(name, names)));
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

/// Keys of the matrix and what reads a value of each.
struct Key {
    std::string_view name;
    std::function<void(BenchMatrix&, const ParsedJson&, const std::string& source)> add;
};

const std::vector<Key>& keys() {
    static const std::vector<Key> table{
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
        {"lights", [](BenchMatrix& m, const ParsedJson& v,
                      const std::string& s) { m.lights.push_back(numberIn(v, 0, scenes::kMostLights, s, "lights")); }},
        {"range",
         [](BenchMatrix& m, const ParsedJson& v, const std::string& s) {
             if (!v.is_number() || !std::isfinite(v.get<double>()) || v.get<double>() < 0.0)
                 refuse(s, "range",
                        fmt::format("{} is no range tolerance; give 0, which ends no light, or more", v.dump()));
             m.rangeTolerances.push_back(v.get<double>());
         }},
        {"shadow", [](BenchMatrix&, const ParsedJson&, const std::string& s) { refuse(s, "shadow", kNoShadows); }},
        {"subsurface",
         [](BenchMatrix&, const ParsedJson&, const std::string& s) { refuse(s, "subsurface", kNoSubsurface); }},
        {"size", [](BenchMatrix& m, const ParsedJson& v,
                    const std::string& s) { m.sizesPixels.push_back(sizeIn(v, s, "size")); }},
    };
    return table;
}

} // namespace

BenchMatrix parseMatrix(std::string_view json, const std::string& source, scenes::LoadLedger& ledger) {
    const ParsedJson root = scenes::parseJson(json, source, ledger);
    if (!root.is_object()) throw InputError(fmt::format("{}: must be an object of arrays", source));
    BenchMatrix matrix;
    for (const auto& [name, values] : root.items()) {
        std::vector<std::string_view> names;
        const Key* found = nullptr;
        for (const Key& key : keys()) {
            names.push_back(key.name);
            if (key.name == name) found = &key;
        }
        if (!found) throw InputError(fmt::format("{}: unknown key '{}': {}", source, name, suggestNames(name, names)));
        if (!values.is_array() || values.empty()) refuse(source, name, "must be an array with at least one entry");
        for (const ParsedJson& value : values) found->add(matrix, value, source);
    }
    return matrix;
}

} // namespace tessera::validation
