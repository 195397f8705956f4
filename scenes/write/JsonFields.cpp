#include "scenes/write/JsonFields.h"

#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "scenes/import/SceneJsonNames.h"

namespace tessera::scenes::write {
namespace {

Json fieldOf(const LightKeys& keys);
Json fieldOf(const LightAnimation& animation);
Json fieldOf(const LightFlicker& flicker);
Json fieldOf(const TextureUse& use);
Json fieldOf(const DiffusionGaussian& gaussian);
Json fieldOf(const Subsurface& subsurface);

Json fieldOf(const std::string& text) {
    return text;
}

Json fieldOf(bool flag) {
    return flag;
}

Json fieldOf(int index) {
    return index;
}

Json fieldOf(float value) {
    return number(value);
}

Json fieldOf(double value) {
    return number(value);
}

template <glm::length_t Length, typename Number>
Json fieldOf(const glm::vec<Length, Number>& vector) {
    return numbers(vector);
}

Json fieldOf(const glm::dmat4& matrix) {
    return numbers(matrix);
}

template <typename Choice>
requires std::is_enum_v<Choice> Json fieldOf(Choice choice) {
    return scenejson::nameOf(choice);
}

Json fieldOf(const LightCorners& corners) {
    Json array = Json::array();
    for (const glm::vec2& corner : corners.all()) array.push_back(numbers(corner));
    return array;
}

Json fieldOf(const LightTexture& texture) {
    return texture ? Json(texture->source) : Json();
}

template <typename Element>
Json fieldOf(const std::vector<Element>& list) {
    Json array = Json::array();
    for (const Element& element : list) array.push_back(fieldOf(element));
    return array;
}

template <typename Value>
Json fieldOf(const std::optional<Value>& optional) {
    return optional ? fieldOf(*optional) : Json();
}

/// A visitor that writes the members in which two objects differ.
auto differencesInto(Json& json) {
    return [&json](const char* key, const auto& wanted, const auto& got) {
        if (!(wanted == got)) json[key] = fieldOf(wanted);
    };
}

Json fieldOf(const LightKeys& keys) {
    Json json = Json::object();
    const LightKeys none;
    scenejson::visitMembers(differencesInto(json), keys, none);
    return json;
}

Json fieldOf(const LightAnimation& animation) {
    Json json = Json::object();
    const LightAnimation none;
    scenejson::visitMembers(differencesInto(json), animation, none);
    return json;
}

Json fieldOf(const LightFlicker& flicker) {
    Json json = Json::object();
    const LightFlicker none;
    scenejson::visitMembers(differencesInto(json), flicker, none);
    return json;
}

Json fieldOf(const TextureUse& use) {
    Json json = Json::object();
    // All members, since the reader changes an existing object.
    scenejson::visitMembers([&json](const char* key, const auto& member) { json[key] = fieldOf(member); }, use);
    return json;
}

// All members, as for textures.
Json fieldOf(const DiffusionGaussian& gaussian) {
    Json json = Json::object();
    scenejson::visitMembers([&json](const char* key, const auto& member) { json[key] = fieldOf(member); }, gaussian);
    return json;
}

Json fieldOf(const Subsurface& subsurface) {
    Json json = Json::object();
    scenejson::visitMembers([&json](const char* key, const auto& member) { json[key] = fieldOf(member); }, subsurface);
    return json;
}

} // namespace

Json number(double value) {
    return std::isinf(value) ? Json() : Json(value); // dump() writes the shortest text of a double
}

Json number(float value) {
    if (std::isinf(value)) return {};
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double shortest = 0.0;
    std::from_chars(text.data(), end, shortest);
    // Text near the middle of two floats, read as a double and rounded to fp32, may become the other one.
    return static_cast<float>(shortest) == value ? Json(shortest) : Json(static_cast<double>(value));
}

Json numbers(const glm::dmat4& matrix) {
    Json list = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) list.push_back(number(matrix[column][row]));
    return list;
}

Json fieldsThatDiffer(const Light& wanted, const Light& got) {
    Json json;
    scenejson::visitMembers(differencesInto(json), wanted, got);
    return json;
}

Json fieldsThatDiffer(const Camera& wanted, const Camera& got) {
    Json json;
    scenejson::visitMembers(differencesInto(json), wanted, got);
    return json;
}

Json fieldsThatDiffer(const Material& wanted, const Material& got) {
    Json json;
    scenejson::visitMembers(differencesInto(json), wanted, got);
    return json;
}

} // namespace tessera::scenes::write
