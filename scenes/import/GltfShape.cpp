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

#include "base/Error.h"
#include "scenes/import/GltfSchema.h"

namespace tessera::scenes::gltf {
namespace {

using Json = nlohmann::json;

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

/// A place in the document, whose text is made for messages only: nearly all places are good. It refers to the one
/// above it.
class Place {
public:
    Place() = default; ///< the document
    Place(const Place& above, std::string_view key) : above_(&above), key_(key) {}
    Place(const Place& above, std::size_t index) : above_(&above), index_(index) {}

    bool isDocument() const { return above_ == nullptr; }
    std::string text() const {
        if (isDocument()) return {};
        return above_->text() + (key_.data() != nullptr ? fmt::format("/{}", key_) : fmt::format("/{}", index_));
    }

private:
    const Place* above_ = nullptr;
    std::string_view key_; ///< no data: an array's element
    std::size_t index_ = 0;
};

class Checker {
public:
    Checker(Json& document, const std::string& file) : document_(document), file_(file) {}

    void check(const Rule& rule) {
        std::string_view path = rule.path;
        const bool required = path.starts_with('!');
        if (required) path.remove_prefix(1);
        walk(document_, split(path, '/'), 0, Place(), required, rule);
    }

private:
    [[noreturn]] void fail(const Place& place, const std::string& what) const {
        throw InputError(fmt::format("{}: {}: {}", file_, place.isDocument() ? "/" : place.text(), what));
    }

    void requireType(bool good, const Place& place, std::string_view type, const Json& value) const {
        if (!good) fail(place, fmt::format("must be {}, but is {}", type, value.type_name()));
    }

    void walk(Json& value, const std::vector<std::string_view>& path, std::size_t depth, const Place& place,
              bool required, const Rule& rule) {
        if (depth == path.size()) return test(value, place, rule);
        const std::string_view segment = path[depth];
        if (segment == "*") {
            requireType(value.is_array(), place, "an array", value);
            for (std::size_t i = 0; i < value.size(); ++i)
                walk(value[i], path, depth + 1, Place(place, i), required, rule);
            return;
        }
        requireType(value.is_object(), place, "an object", value);
        if (segment == "@") {
            for (auto& [key, member] : value.items()) walk(member, path, depth + 1, Place(place, key), required, rule);
            return;
        }
        const auto member = value.find(segment);
        if (member != value.end())
            walk(*member, path, depth + 1, Place(place, segment), required, rule);
        else if (required && depth + 1 == path.size())
            fail(place, fmt::format("the required property '{}' is missing", segment));
    }

    void test(Json& value, const Place& place, const Rule& rule) {
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
            for (std::size_t i = 0; i < value.size(); ++i) testNumber(value[i], Place(place, i), rule);
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
    void testNumber(const Json& value, const Place& place, const Rule& rule) const {
        requireType(value.is_number(), place, "a number", value);
        const double number = value.get<double>();
        if (!(std::abs(number) <= std::numeric_limits<float>::max()))
            fail(place, fmt::format("is {}, which no 32-bit number can hold", value.dump()));
        testRange(number, place, rule);
    }

    void testInteger(Json& value, const Place& place, const Rule& rule) const {
        requireType(value.is_number(), place, "an integer", value);
        const double number = value.get<double>();
        if (!std::isfinite(number) || number != std::floor(number))
            fail(place, fmt::format("must be an integer, but is {}", value.dump()));
        if (std::abs(number) > kMaxInteger)
            fail(place, fmt::format("is {}, farther from 0 than {}", value.dump(), std::int64_t(kMaxInteger)));
        testRange(number, place, rule);
        if (!value.is_number_integer()) value = static_cast<std::int64_t>(number);
    }

    void testRange(double number, const Place& place, const Rule& rule) const {
        if (number < rule.min) fail(place, fmt::format("is {}; it must be at least {}", number, rule.min));
        if (number > rule.max) fail(place, fmt::format("is {}; it must be at most {}", number, rule.max));
    }

    void testIndex(Json& value, const Place& place, const Rule& rule) {
        testInteger(value, place, rule);
        const Json* target = &document_;
        for (const std::string_view segment : split(rule.choices, '/')) {
            const auto member = target->is_object() ? target->find(segment) : target->end();
            if (!target->is_object() || member == target->end())
                fail(place,
                     fmt::format("points at /{}/{}, but the document has no {}", rule.choices, value.dump(), segment));
            target = &*member;
        }
        requireType(target->is_array(), Place(Place(), rule.choices), "an array", *target);
        if (value.get<std::size_t>() >= target->size())
            fail(place,
                 fmt::format("points at /{}/{}, but there are only {}", rule.choices, value.dump(), target->size()));
    }

    Json& document_;
    const std::string& file_;
};

/// What the rules' table cannot say: properties that others make necessary.
void checkConditions(const Json& document, const std::string& file) {
    const auto fail = [&](const std::string& place, const std::string& what) {
        throw InputError(fmt::format("{}: {}: {}", file, place, what));
    };
    const auto elementsAt = [&](const char* pointer) {
        const Json::json_pointer place(pointer);
        return document.contains(place) ? document[place] : Json::array();
    };
    const Json cameras = elementsAt("/cameras");
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (const auto type = cameras[i]["type"].get<std::string>(); !cameras[i].contains(type))
            fail(fmt::format("/cameras/{}", i), fmt::format("the required property '{}' is missing", type));
    const Json lights = elementsAt("/extensions/KHR_lights_punctual/lights");
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i]["type"] == "spot" && !lights[i].contains("spot"))
            fail(fmt::format("/extensions/KHR_lights_punctual/lights/{}", i),
                 "the required property 'spot' is missing");
    const Json views = elementsAt("/bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i)
        if (const auto stride = views[i].value("byteStride", 4); stride % 4 != 0)
            fail(fmt::format("/bufferViews/{}/byteStride", i),
                 fmt::format("is {}; it must be a multiple of 4", stride));
}

} // namespace

void checkShape(Json& document, const std::string& file) {
    if (!document.is_object())
        throw InputError(fmt::format("{}: /: must be an object, but is {}", file, document.type_name()));
    Checker checker(document, file);
    for (const Rule& rule : documentRules()) checker.check(rule);
    for (const std::string_view place : textureInfoPlaces()) {
        checker.check({place, Kind::Object});
        for (const Rule& rule : textureInfoRules()) {
            const bool required = rule.path.starts_with('!');
            const std::string path =
                fmt::format("{}{}/{}", required ? "!" : "", place, rule.path.substr(required ? 1 : 0));
            Rule placed = rule;
            placed.path = path;
            checker.check(placed);
        }
    }
    checkConditions(document, file);
}

} // namespace tessera::scenes::gltf
