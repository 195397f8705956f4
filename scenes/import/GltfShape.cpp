#include "scenes/import/GltfShape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "scenes/Error.h"

namespace tessera::scenes::gltf {
namespace {

using Json = nlohmann::json;

enum class Kind { Object, Array, Integer, Number, Numbers, String, Boolean, Index, Choice, IntegerChoice };

constexpr double kAny = std::numeric_limits<double>::max();
constexpr double kMaxInteger = 9007199254740992.0; ///< 2^53: JSON numbers are exact to here
constexpr double kMaxInt = std::numeric_limits<int>::max();

/// What must hold at a path. Path segments: a key, "*" (every array element) or "@" (every value of an object). A path
/// that begins with '!' is required wherever its parent is. `choices` names the array that an Index counts in, or the
/// values allowed, separated by '|'.
struct Rule {
    std::string_view path;
    Kind kind;
    double min = -kAny;
    double max = kAny;
    std::string_view choices = {};
    std::size_t length = 0; ///< Numbers: exactly so many
};

constexpr Rule integer(std::string_view path, double min = 0, double max = kMaxInteger) {
    return {path, Kind::Integer, min, max};
}
constexpr Rule number(std::string_view path, double min = -kAny, double max = kAny) {
    return {path, Kind::Number, min, max};
}
constexpr Rule numbers(std::string_view path, std::size_t length, double min = -kAny) {
    return {path, Kind::Numbers, min, kAny, {}, length};
}
constexpr Rule string(std::string_view path) {
    return {path, Kind::String};
}
constexpr Rule boolean(std::string_view path) {
    return {path, Kind::Boolean};
}
constexpr Rule object(std::string_view path) {
    return {path, Kind::Object};
}
constexpr Rule array(std::string_view path) {
    return {path, Kind::Array};
}
constexpr Rule index(std::string_view path, std::string_view into) {
    return {path, Kind::Index, 0, kMaxInt, into};
}
constexpr Rule choice(std::string_view path, std::string_view values) {
    return {path, Kind::Choice, -kAny, kAny, values};
}
constexpr Rule integerChoice(std::string_view path, std::string_view values) {
    return {path, Kind::IntegerChoice, -kAny, kAny, values};
}

// Source of names, ranges and defaults: glTF 2.0 specification, section 5, and the extensions' README schemas.
constexpr Rule kRules[] = {
    object("!asset"),
    string("!asset/version"),
    string("asset/minVersion"),
    string("extensionsUsed/*"),
    string("extensionsRequired/*"),
    object("extensions"),

    index("scene", "scenes"),
    object("scenes/*"),
    string("scenes/*/name"),
    index("scenes/*/nodes/*", "nodes"),

    object("nodes/*"),
    string("nodes/*/name"),
    index("nodes/*/children/*", "nodes"),
    index("nodes/*/mesh", "meshes"),
    index("nodes/*/camera", "cameras"),
    index("nodes/*/skin", "skins"),
    numbers("nodes/*/matrix", 16),
    numbers("nodes/*/translation", 3),
    numbers("nodes/*/rotation", 4),
    numbers("nodes/*/scale", 3),
    object("nodes/*/extensions"),
    object("nodes/*/extensions/KHR_lights_punctual"),
    index("!nodes/*/extensions/KHR_lights_punctual/light", "extensions/KHR_lights_punctual/lights"),

    object("meshes/*"),
    string("meshes/*/name"),
    array("!meshes/*/primitives"),
    object("meshes/*/primitives/*"),
    object("!meshes/*/primitives/*/attributes"),
    index("meshes/*/primitives/*/attributes/@", "accessors"),
    index("meshes/*/primitives/*/indices", "accessors"),
    index("meshes/*/primitives/*/material", "materials"),
    integer("meshes/*/primitives/*/mode", 0, 6),
    array("meshes/*/primitives/*/targets"),
    object("meshes/*/primitives/*/extensions"),

    object("accessors/*"),
    string("accessors/*/name"),
    index("accessors/*/bufferView", "bufferViews"),
    integer("accessors/*/byteOffset"),
    integerChoice("!accessors/*/componentType", "5120|5121|5122|5123|5125|5126"),
    integer("!accessors/*/count", 1),
    choice("!accessors/*/type", "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4"),
    boolean("accessors/*/normalized"),
    object("accessors/*/sparse"),
    integer("!accessors/*/sparse/count", 1, kMaxInt),
    object("!accessors/*/sparse/indices"),
    index("!accessors/*/sparse/indices/bufferView", "bufferViews"),
    integer("accessors/*/sparse/indices/byteOffset", 0, kMaxInt),
    integerChoice("!accessors/*/sparse/indices/componentType", "5121|5123|5125"),
    object("!accessors/*/sparse/values"),
    index("!accessors/*/sparse/values/bufferView", "bufferViews"),
    integer("accessors/*/sparse/values/byteOffset", 0, kMaxInt),

    object("bufferViews/*"),
    index("!bufferViews/*/buffer", "buffers"),
    integer("bufferViews/*/byteOffset"),
    integer("!bufferViews/*/byteLength", 1),
    integer("bufferViews/*/byteStride", 4, 252),
    object("bufferViews/*/extensions"),
    object("bufferViews/*/extensions/EXT_meshopt_compression"),
    index("!bufferViews/*/extensions/EXT_meshopt_compression/buffer", "buffers"),
    integer("bufferViews/*/extensions/EXT_meshopt_compression/byteOffset"),
    integer("!bufferViews/*/extensions/EXT_meshopt_compression/byteLength", 1),
    integer("!bufferViews/*/extensions/EXT_meshopt_compression/byteStride", 1, 256),
    integer("!bufferViews/*/extensions/EXT_meshopt_compression/count", 1),
    choice("!bufferViews/*/extensions/EXT_meshopt_compression/mode", "ATTRIBUTES|TRIANGLES|INDICES"),
    choice("bufferViews/*/extensions/EXT_meshopt_compression/filter", "NONE|OCTAHEDRAL|QUATERNION|EXPONENTIAL"),

    object("buffers/*"),
    integer("!buffers/*/byteLength", 1),
    string("buffers/*/uri"),

    object("images/*"),
    string("images/*/name"),
    string("images/*/uri"),
    index("images/*/bufferView", "bufferViews"),
    string("images/*/mimeType"),
    object("textures/*"),
    string("textures/*/name"),
    index("textures/*/source", "images"),
    index("textures/*/sampler", "samplers"),
    object("samplers/*"),
    integerChoice("samplers/*/magFilter", "9728|9729"),
    integerChoice("samplers/*/minFilter", "9728|9729|9984|9985|9986|9987"),
    integerChoice("samplers/*/wrapS", "33071|33648|10497"),
    integerChoice("samplers/*/wrapT", "33071|33648|10497"),

    object("materials/*"),
    string("materials/*/name"),
    object("materials/*/pbrMetallicRoughness"),
    numbers("materials/*/pbrMetallicRoughness/baseColorFactor", 4, 0),
    number("materials/*/pbrMetallicRoughness/metallicFactor", 0, 1),
    number("materials/*/pbrMetallicRoughness/roughnessFactor", 0, 1),
    number("materials/*/normalTexture/scale"),
    number("materials/*/occlusionTexture/strength"),
    numbers("materials/*/emissiveFactor", 3, 0),
    choice("materials/*/alphaMode", "OPAQUE|MASK|BLEND"),
    number("materials/*/alphaCutoff", 0),
    boolean("materials/*/doubleSided"),
    object("materials/*/extensions"),
    object("materials/*/extensions/KHR_materials_unlit"),
    object("materials/*/extensions/KHR_materials_emissive_strength"),
    number("materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", 0),
    object("materials/*/extensions/KHR_materials_ior"),
    number("materials/*/extensions/KHR_materials_ior/ior", 0),
    object("materials/*/extensions/KHR_materials_specular"),
    number("materials/*/extensions/KHR_materials_specular/specularFactor", 0, 1),
    numbers("materials/*/extensions/KHR_materials_specular/specularColorFactor", 3, 0),

    object("cameras/*"),
    string("cameras/*/name"),
    choice("!cameras/*/type", "perspective|orthographic"),
    number("!cameras/*/perspective/yfov"),
    number("!cameras/*/perspective/znear"),
    number("cameras/*/perspective/zfar"),
    number("!cameras/*/orthographic/xmag"),
    number("!cameras/*/orthographic/ymag"),
    number("!cameras/*/orthographic/znear"),
    number("!cameras/*/orthographic/zfar"),

    object("extensions/KHR_lights_punctual"),
    array("!extensions/KHR_lights_punctual/lights"),
    object("extensions/KHR_lights_punctual/lights/*"),
    string("extensions/KHR_lights_punctual/lights/*/name"),
    choice("!extensions/KHR_lights_punctual/lights/*/type", "directional|point|spot"),
    numbers("extensions/KHR_lights_punctual/lights/*/color", 3, 0),
    number("extensions/KHR_lights_punctual/lights/*/intensity", 0),
    number("extensions/KHR_lights_punctual/lights/*/range", 0),
    object("extensions/KHR_lights_punctual/lights/*/spot"),
    number("extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", 0),
    number("extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", 0),

    object("skins/*"),
    object("animations/*"),
};

/// The places a texture is used at; each must look like a textureInfo.
constexpr std::string_view kTextureInfos[] = {
    "materials/*/pbrMetallicRoughness/baseColorTexture",
    "materials/*/pbrMetallicRoughness/metallicRoughnessTexture",
    "materials/*/normalTexture",
    "materials/*/occlusionTexture",
    "materials/*/emissiveTexture",
    "materials/*/extensions/KHR_materials_specular/specularTexture",
    "materials/*/extensions/KHR_materials_specular/specularColorTexture",
};
constexpr Rule kTextureInfoRules[] = {
    index("!index", "textures"),
    integer("texCoord", 0, kMaxInt),
    object("extensions"),
    object("extensions/KHR_texture_transform"),
    numbers("extensions/KHR_texture_transform/offset", 2),
    numbers("extensions/KHR_texture_transform/scale", 2),
    number("extensions/KHR_texture_transform/rotation"),
    integer("extensions/KHR_texture_transform/texCoord", 0, kMaxInt),
};

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

class Checker {
public:
    Checker(Json& document, const std::string& file) : document_(document), file_(file) {}

    void check(const Rule& rule) {
        std::string_view path = rule.path;
        const bool required = path.starts_with('!');
        if (required) path.remove_prefix(1);
        walk(document_, split(path, '/'), 0, "", required, rule);
    }

private:
    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        throw InputError(fmt::format("{}: {}: {}", file_, place.empty() ? "/" : place, what));
    }

    void requireType(bool good, const std::string& place, std::string_view type, const Json& value) const {
        if (!good) fail(place, fmt::format("must be {}, but is {}", type, value.type_name()));
    }

    void walk(Json& value, const std::vector<std::string_view>& path, std::size_t depth, const std::string& place,
              bool required, const Rule& rule) {
        if (depth == path.size()) return test(value, place, rule);
        const std::string_view segment = path[depth];
        if (segment == "*") {
            requireType(value.is_array(), place, "an array", value);
            for (std::size_t i = 0; i < value.size(); ++i)
                walk(value[i], path, depth + 1, fmt::format("{}/{}", place, i), required, rule);
            return;
        }
        requireType(value.is_object(), place, "an object", value);
        if (segment == "@") {
            for (auto& [key, member] : value.items())
                walk(member, path, depth + 1, fmt::format("{}/{}", place, key), required, rule);
            return;
        }
        const auto member = value.find(segment);
        if (member != value.end())
            walk(*member, path, depth + 1, fmt::format("{}/{}", place, segment), required, rule);
        else if (required && depth + 1 == path.size())
            fail(place, fmt::format("the required property '{}' is missing", segment));
    }

    void test(Json& value, const std::string& place, const Rule& rule) {
        switch (rule.kind) {
        case Kind::Object:
            return requireType(value.is_object(), place, "an object", value);
        case Kind::Array:
            return requireType(value.is_array(), place, "an array", value);
        case Kind::String:
            return requireType(value.is_string(), place, "a string", value);
        case Kind::Boolean:
            return requireType(value.is_boolean(), place, "true or false", value);
        case Kind::Number:
            return testNumber(value, place, rule);
        case Kind::Numbers:
            requireType(value.is_array(), place, "an array of numbers", value);
            if (value.size() != rule.length)
                fail(place, fmt::format("must hold {} numbers, but holds {}", rule.length, value.size()));
            for (std::size_t i = 0; i < value.size(); ++i) testNumber(value[i], fmt::format("{}/{}", place, i), rule);
            return;
        case Kind::Integer:
            return testInteger(value, place, rule);
        case Kind::Index:
            return testIndex(value, place, rule);
        case Kind::Choice: {
            requireType(value.is_string(), place, "a string", value);
            const auto allowed = split(rule.choices, '|');
            const std::string& chosen = value.get_ref<const std::string&>();
            if (std::ranges::find(allowed, chosen) == allowed.end())
                fail(place, fmt::format("is '{}'; valid are {}", chosen, fmt::join(allowed, ", ")));
            return;
        }
        case Kind::IntegerChoice: {
            testInteger(value, place, rule);
            const auto allowed = split(rule.choices, '|');
            if (std::ranges::find(allowed, value.dump()) == allowed.end())
                fail(place, fmt::format("is {}; valid are {}", value.dump(), fmt::join(allowed, ", ")));
            return;
        }
        }
    }

    /// Numbers end as 32-bit floats in the scene, so anything that overflows one is out of range.
    void testNumber(const Json& value, const std::string& place, const Rule& rule) const {
        requireType(value.is_number(), place, "a number", value);
        const double number = value.get<double>();
        if (!(std::abs(number) <= std::numeric_limits<float>::max()))
            fail(place, fmt::format("is {}, which no 32-bit number can hold", value.dump()));
        testRange(number, place, rule);
    }

    void testInteger(Json& value, const std::string& place, const Rule& rule) const {
        requireType(value.is_number(), place, "an integer", value);
        const double number = value.get<double>();
        if (!std::isfinite(number) || number != std::floor(number) || std::abs(number) > kMaxInteger)
            fail(place, fmt::format("must be an integer, but is {}", value.dump()));
        testRange(number, place, rule);
        if (!value.is_number_integer()) value = static_cast<std::int64_t>(number);
    }

    void testRange(double number, const std::string& place, const Rule& rule) const {
        if (number < rule.min) fail(place, fmt::format("is {}; it must be at least {}", number, rule.min));
        if (number > rule.max) fail(place, fmt::format("is {}; it must be at most {}", number, rule.max));
    }

    void testIndex(Json& value, const std::string& place, const Rule& rule) {
        testInteger(value, place, rule);
        const Json* target = &document_;
        for (const std::string_view segment : split(rule.choices, '/')) {
            const auto member = target->is_object() ? target->find(segment) : target->end();
            if (!target->is_object() || member == target->end())
                fail(place,
                     fmt::format("points at /{}/{}, but the document has no {}", rule.choices, value.dump(), segment));
            target = &*member;
        }
        requireType(target->is_array(), fmt::format("/{}", rule.choices), "an array", *target);
        if (value.get<std::size_t>() >= target->size())
            fail(place,
                 fmt::format("points at /{}/{}, but there are only {}", rule.choices, value.dump(), target->size()));
    }

    Json& document_;
    const std::string& file_;
};

} // namespace

void checkShape(Json& document, const std::string& file) {
    if (!document.is_object())
        throw InputError(fmt::format("{}: /: must be an object, but is {}", file, document.type_name()));
    Checker checker(document, file);
    for (const Rule& rule : kRules) checker.check(rule);
    for (const std::string_view place : kTextureInfos) {
        checker.check(object(place));
        for (const Rule& rule : kTextureInfoRules) {
            const bool required = rule.path.starts_with('!');
            const std::string path =
                fmt::format("{}{}/{}", required ? "!" : "", place, rule.path.substr(required ? 1 : 0));
            Rule placed = rule;
            placed.path = path;
            checker.check(placed);
        }
    }
}

} // namespace tessera::scenes::gltf
