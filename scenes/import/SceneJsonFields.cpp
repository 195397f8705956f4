
#include <type_traits>

#include "scenes/import/SceneJsonNames.h"
#include "scenes/import/SceneJsonParts.h"

namespace tessera::scenes::scenejson {
namespace {

/// A struct whose members are listed in SceneJsonNames.h.
template <typename Struct>
concept HasMembers = requires(Struct& object) {
    visitMembers([](const char*, auto&) {}, object);
};

template <HasMembers Struct>
void read(const JsonValue& value, Struct& members);

void read(const JsonValue& value, std::string& text) {
    text = value.textOrEmpty();
}

void read(const JsonValue& value, bool& flag) {
    flag = value.boolean();
}

void read(const JsonValue& value, int& index) {
    index = value.integer(kNone, std::numeric_limits<int>::max());
}

/// Reads a number; null is infinity, which JSON lacks.
void read(const JsonValue& value, double& number) {
    number = value.isNull() ? std::numeric_limits<double>::infinity() : value.number();
}

void read(const JsonValue& value, float& number) {
    number = value.isNull() ? kInfinity : value.single();
}

template <glm::length_t Length, typename Number>
void read(const JsonValue& value, glm::vec<Length, Number>& vector) {
    const std::vector<JsonValue> numbers = value.elements(std::size_t(Length), std::size_t(Length));
    for (glm::length_t i = 0; i < Length; ++i) read(numbers[std::size_t(i)], vector[i]);
}

void read(const JsonValue& value, glm::dmat4& matrix) {
    matrix = readMatrix(value);
}

template <typename Choice>
requires std::is_enum_v<Choice>
void read(const JsonValue& value, Choice& choice) {
    choice = value.oneOf<Choice>("choice", choicesOf(choice));
}

template <typename Element>
void read(const JsonValue& value, std::vector<Element>& list) {
    list.clear();
    for (const JsonValue& element : value.elements()) read(element, list.emplace_back());
}

void read(const JsonValue& value, LightCorners& corners) {
    corners.count = 0;
    for (const JsonValue& corner : value.elements(0, LightCorners::kMost)) {
        glm::vec2 metres;
        read(corner, metres);
        corners.add(metres);
    }
}

void read(const JsonValue& value, LightTexture&) {
    value.fail("is no field; name the picture by the light's own key 'texture'");
}

template <typename Value>
void read(const JsonValue& value, std::optional<Value>& optional) {
    optional.reset();
    if (!value.isNull()) read(value, optional.emplace());
}

/// Reads the members that an object names.
template <HasMembers Struct>
void readMembers(const JsonValue& value, const char* what, Struct& members) {
    JsonObject object = value.object();
    visitMembers(
        [&](const char* key, auto& member) {
            if (const auto found = object.find(key)) read(*found, member);
        },
        members);
    object.done(what);
}

template <HasMembers Struct>
void read(const JsonValue& value, Struct& members) {
    readMembers(value, "an object of fields", members);
}

} // namespace

void readFields(JsonObject& object, Light& light) {
    if (const auto value = object.find("fields")) readMembers(*value, "a light's fields", light);
}

void readFields(JsonObject& object, Camera& camera) {
    if (const auto value = object.find("fields")) readMembers(*value, "a camera's fields", camera);
}

void readFields(JsonObject& object, Material& material) {
    if (const auto value = object.find("fields")) readMembers(*value, "a material's fields", material);
}

} // namespace tessera::scenes::scenejson
