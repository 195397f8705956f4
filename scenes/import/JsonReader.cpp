#include "scenes/import/JsonReader.h"

#include <algorithm>
#include <cmath>

#include "base/Names.h"
#include "scenes/import/JsonText.h"

namespace tessera::scenes {
namespace {

std::string_view typeOf(const nlohmann::json& value) {
    if (value.is_null()) return "null";
    if (value.is_boolean()) return "true or false";
    if (value.is_number()) return "a number";
    if (value.is_string()) return "text";
    return value.is_array() ? "an array" : "an object";
}

} // namespace

void JsonValue::fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_->string(), pointer_.empty() ? "/" : pointer_, what));
}

void JsonValue::failUnknown(std::string_view what, std::string_view name,
                            std::span<const std::string_view> known) const {
    fail("there is no {} '{}'; {}", what, name, suggestNames(name, known));
}

void JsonValue::failType(std::string_view needed) const {
    fail("is {}; {} is needed", typeOf(*value_), needed);
}

double JsonValue::number(double least, double most) const {
    if (!value_->is_number()) failType("a number");
    const double number = value_->get<double>();
    if (number < least) fail("is {}; at least {} is needed", number, least);
    if (number > most) fail("is {}; at most {} is allowed", number, most);
    return number;
}

float JsonValue::single(double least, double most) const {
    return float(number(least, most));
}

double JsonValue::positive() const {
    const double value = number();
    if (!(value > 0.0)) fail("is {}; more than 0 is needed", value);
    return value;
}

int JsonValue::integer(int least, int most) const {
    const double value = number(least, most);
    if (value != std::floor(value)) fail("is {}; a whole number is needed", value);
    return int(value);
}

bool JsonValue::boolean() const {
    if (!value_->is_boolean()) failType("true or false");
    return value_->get<bool>();
}

std::string JsonValue::textOrEmpty() const {
    if (!value_->is_string()) failType("text");
    return value_->get<std::string>();
}

std::string JsonValue::text() const {
    std::string text = textOrEmpty();
    if (text.empty()) fail("is empty; give a name");
    return text;
}

std::vector<JsonValue> JsonValue::elements(std::size_t least, std::size_t most) const {
    if (!value_->is_array()) failType(least == most ? fmt::format("an array of {}", least) : "an array");
    const std::size_t count = value_->size();
    if (least == most && count != least) fail("has {} elements; exactly {} are needed", count, least);
    if (count < least) fail("has {} elements; at least {} are needed", count, least);
    if (count > most) fail("has {} elements; at most {} are allowed", count, most);
    std::vector<JsonValue> elements;
    elements.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        elements.emplace_back((*value_)[i], *file_, jsonPointerTo(pointer_, std::to_string(i)));
    return elements;
}

glm::vec2 JsonValue::vector2() const {
    const std::vector<JsonValue> values = elements(2, 2);
    return {values[0].single(), values[1].single()};
}

glm::dvec3 JsonValue::vector3() const {
    const std::vector<JsonValue> values = elements(3, 3);
    return {values[0].number(), values[1].number(), values[2].number()};
}

glm::dvec3 JsonValue::direction() const {
    const glm::dvec3 vector = vector3();
    // Scaled first, so that squaring neither overflows nor vanishes.
    const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
    if (!(largest > 0.0)) fail("has no length; give a direction");
    return glm::normalize(vector / largest);
}

glm::vec3 JsonValue::color() const {
    const std::vector<JsonValue> values = elements(3, 3);
    return {values[0].single(0.0), values[1].single(0.0), values[2].single(0.0)};
}

JsonObject JsonValue::object() const {
    return JsonObject(*this);
}

JsonObject::JsonObject(JsonValue value) : value_(std::move(value)) {
    if (!value_.isObject()) value_.failType("an object");
}

std::optional<JsonValue> JsonObject::find(std::string_view key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
    const auto found = value_.value_->find(key);
    if (found == value_.value_->end()) return std::nullopt;
    return JsonValue(*found, *value_.file_, jsonPointerTo(value_.pointer_, key));
}

std::vector<std::string> JsonObject::keys() const {
    std::vector<std::string> keys;
    for (const auto& [key, ignored] : value_.value_->items()) keys.push_back(key);
    return keys;
}

JsonValue JsonObject::require(std::string_view key) {
    if (std::optional<JsonValue> found = find(key)) return *std::move(found);
    // The key may be there under a misspelt name.
    const std::vector<std::string> there = keys();
    std::vector<std::string_view> others;
    for (const std::string& other : there)
        if (std::ranges::find(known_, other) == known_.end()) others.push_back(other);
    if (const std::vector<std::string_view> nearest = nearestNames(key, others); !nearest.empty())
        value_.fail("has the unknown key '{}'; did you mean '{}'?", nearest.front(), key);
    value_.fail("lacks the key '{}'; add it", key);
}

void JsonObject::done(std::string_view what) const {
    const std::vector<std::string_view> known(known_.begin(), known_.end());
    for (const auto& [key, ignored] : value_.value_->items()) {
        if (std::ranges::find(known_, key) == known_.end())
            value_.fail("{} has no key '{}'; {}", what, key, suggestNames(key, known));
    }
}

} // namespace tessera::scenes
