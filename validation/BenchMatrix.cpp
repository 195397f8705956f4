#include "validation/BenchMatrix.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "passes/recipes/ChooseCulling.h"
#include "scenes/Error.h"
#include "scenes/Names.h"

namespace tessera::validation {

namespace {

using Json = nlohmann::json;
using culling::Method;
using recipes::Technique;

constexpr int kMostLights = 65536;
constexpr int kLargestSide = 16384;

[[noreturn]] void refuse(const std::string& source, const std::string& key, const std::string& why) {
    throw InputError(fmt::format("{}: \"{}\": {}", source, key, why));
}

template <typename Table>
const auto& rowNamed(const Table& table, const Json& value, const std::string& source, const std::string& key) {
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

int numberIn(const Json& value, int least, int most, const std::string& source, const std::string& key) {
    if (value.is_number_integer() && value >= least && value <= most) return value.get<int>();
    refuse(source, key, fmt::format("{} is no whole number from {} to {}", value.dump(), least, most));
}

glm::ivec2 sizeIn(const Json& value, const std::string& source, const std::string& key) {
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    glm::ivec2 size(0);
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.y);
        const bool fits = std::min(size.x, size.y) >= 1 && std::max(size.x, size.y) <= kLargestSide;
        if (height.ec == std::errc() && height.ptr == end && fits) return size;
    }
    refuse(source, key,
           fmt::format("{} is no size such as \"1280x720\", each side 1 to {}", value.dump(), kLargestSide));
}

/// Keys of the matrix and what reads a value of each.
struct Key {
    std::string_view name;
    std::function<void(BenchMatrix&, const Json&, const std::string& source)> add;
};

const std::vector<Key>& keys() {
    static const std::vector<Key> table{
        {"technique",
         [](BenchMatrix& m, const Json& v, const std::string& s) {
             m.techniques.push_back(rowNamed(recipes::techniqueTable(), v, s, "technique").technique);
         }},
        {"culling",
         [](BenchMatrix& m, const Json& v, const std::string& s) {
             m.methods.push_back(rowNamed(culling::methodTable(), v, s, "culling").method);
         }},
        {"tile",
         [](BenchMatrix& m, const Json& v, const std::string& s) {
             const auto isTile = [&](int side) { return v == side; };
             if (!v.is_number_integer() ||
                 std::none_of(std::begin(culling::kTileSides), std::end(culling::kTileSides), isTile))
                 refuse(s, "tile",
                        fmt::format("{}: tiles are {} pixels wide", v.dump(), fmt::join(culling::kTileSides, ", ")));
             m.tilesPixels.push_back(v.get<int>());
         }},
        {"layout", [](BenchMatrix& m, const Json& v,
                      const std::string& s) { m.layouts.push_back(rowNamed(frame::layoutTable(), v, s, "layout")); }},
        {"lights", [](BenchMatrix& m, const Json& v,
                      const std::string& s) { m.lights.push_back(numberIn(v, 0, kMostLights, s, "lights")); }},
        {"size",
         [](BenchMatrix& m, const Json& v, const std::string& s) { m.sizesPixels.push_back(sizeIn(v, s, "size")); }},
    };
    return table;
}

/// The list, or one entry that says nothing.
template <typename T>
std::vector<std::optional<T>> orDefault(const std::vector<T>& list) {
    if (list.empty()) return {std::nullopt};
    return {list.begin(), list.end()};
}

const recipes::TechniqueInfo& infoOf(Technique technique) {
    return recipes::techniqueTable()[std::size_t(technique)];
}

/// Methods to run a technique with, and why others of the matrix are not.
std::vector<Method> methodsOf(const BenchMatrix& matrix, Technique technique, const frame::FrameSettings& settings,
                              std::vector<SkippedPoint>& skipped) {
    const recipes::TechniqueInfo& info = infoOf(technique);
    if (matrix.methods.empty()) {
        if (settings.culling.method && recipes::takesMethod(technique, *settings.culling.method))
            return {*settings.culling.method};
        return {info.methods.begin(), info.methods.end()};
    }
    std::vector<Method> methods;
    for (const Method method : matrix.methods) {
        if (recipes::takesMethod(technique, method)) {
            methods.push_back(method);
            continue;
        }
        skipped.push_back({fmt::format("{}, {}", info.name, culling::methodTable()[std::size_t(method)].name),
                           "the technique does not take this culling method"});
    }
    return methods;
}

/// The points of one light count and size.
void addGroup(const BenchMatrix& matrix, const BenchPoint& common, BenchPlan& plan, bool notesSkipped) {
    std::vector<SkippedPoint> skipped;
    for (const Technique technique : matrix.techniques) {
        for (const Method method : methodsOf(matrix, technique, common.settings, skipped)) {
            const bool hasTiles = method != Method::None;
            for (const std::optional<int>& tile : hasTiles ? orDefault(matrix.tilesPixels) : orDefault<int>({})) {
                for (const std::optional<frame::LayoutInfo>& layout : orDefault(matrix.layouts)) {
                    BenchPoint point = common;
                    point.technique = technique;
                    point.settings.culling.method = method;
                    if (tile) point.settings.culling.tilePixels = *tile;
                    if (layout) point.settings.layout = layout->layout;
                    if (!infoOf(technique).usesGBuffer && layout && layout->name != frame::layoutTable()[0].name) {
                        skipped.push_back({fmt::format("{}, {}", pointName(point), layout->name),
                                           "the technique has no G-buffer to lay out"});
                        continue;
                    }
                    plan.points.push_back(point);
                }
            }
        }
    }
    if (notesSkipped) plan.skipped = std::move(skipped);
}

} // namespace

BenchMatrix parseMatrix(std::string_view json, const std::string& source) {
    const Json root = Json::parse(json, nullptr, false);
    if (root.is_discarded()) throw InputError(fmt::format("{}: is no JSON", source));
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
        for (const Json& value : values) found->add(matrix, value, source);
    }
    return matrix;
}

BenchPlan planBench(const BenchMatrix& matrix, const std::string& scene, std::optional<int> lights,
                    const frame::FrameSettings& settings) {
    BenchMatrix whole = matrix;
    if (whole.techniques.empty())
        for (const recipes::TechniqueInfo& info : recipes::techniqueTable()) whole.techniques.push_back(info.technique);
    BenchPlan plan;
    for (const std::optional<int>& count : orDefault(whole.lights)) {
        for (const std::optional<glm::ivec2>& size : orDefault(whole.sizesPixels)) {
            BenchPoint common;
            common.scene = scene;
            common.lights = count ? count : lights;
            common.settings = settings;
            common.settings.display = false;
            if (size) common.settings.sizePixels = *size;
            addGroup(whole, common, plan, plan.points.empty());
        }
    }
    return plan;
}

std::string pointName(const BenchPoint& point) {
    std::string name(infoOf(point.technique).name);
    const Method method = point.settings.culling.method.value_or(Method::None);
    if (method == Method::None) return name;
    name += fmt::format(", {}", culling::methodTable()[std::size_t(method)].name);
    if (point.settings.culling.tilePixels) name += fmt::format(", {}", *point.settings.culling.tilePixels);
    return name;
}

} // namespace tessera::validation
