#include "scenes/import/SceneJsonFields.h"

#include <type_traits>

#include "scenes/import/SceneJsonNames.h"
#include "scenes/import/SceneJsonParts.h"

namespace tessera::scenes::scenejson {
namespace {

void read(const JsonValue& value, LightKeys& keys);
void read(const JsonValue& value, LightAnimation& animation);
void read(const JsonValue& value, LightFlicker& flicker);
void read(const JsonValue& value, TextureUse& use);
void read(const JsonValue& value, DiffusionGaussian& gaussian);
void read(const JsonValue& value, Subsurface& subsurface);

void read(const JsonValue& value, std::string& text) {
    text = value.isText() ? value.textOrEmpty() : value.text();
}

void read(const JsonValue& value, bool& flag) {
    flag = value.boolean();
}

void read(const JsonValue& value, int& index) {
    index = value.integer(kNone, std::numeric_limits<int>::max());
}

/// Numbers; null is infinity, which JSON lacks.
void read(const JsonValue& value, double& number) {
    number = value.isNull() ? std::numeric_limits<double>::infinity() : value.number();
}

void read(const JsonValue& value, float& number) {
    number = value.isNull() ? kInfinity : value.single();
}

template <glm::length_t Length, typename Number>
void read(const JsonValue& value, glm::vec<Length, Number>& vector) {
    const std::vector<JsonValue> numbers = value.elements(std::size_t(Length), std::size_t(Length));
    for (glm::length_t i = 0; i < Length; ++i) read(numbers[static_cast<std::size_t>(i)], vector[i]);
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

/// A visitor that reads the members an object names.
auto readerOf(JsonObject& object) {
    return [&object](const char* key, auto& member) {
        if (const auto value = object.find(key)) read(*value, member);
    };
}

void read(const JsonValue& value, LightKeys& keys) {
    JsonObject object = value.object();
    visitKeys(readerOf(object), keys);
    object.done("the fields of keyframes");
}

void read(const JsonValue& value, LightAnimation& animation) {
    JsonObject object = value.object();
    visitAnimation(readerOf(object), animation);
    object.done("an animation's fields");
}

void read(const JsonValue& value, LightFlicker& flicker) {
    JsonObject object = value.object();
    visitFlicker(readerOf(object), flicker);
    object.done("a flicker's fields");
}

void read(const JsonValue& value, TextureUse& use) {
    JsonObject object = value.object();
    visitTextureUse(readerOf(object), use);
    object.done("a texture's fields");
}

void read(const JsonValue& value, DiffusionGaussian& gaussian) {
    JsonObject object = value.object();
    visitGaussian(readerOf(object), gaussian);
    object.done("a Gaussian's fields");
}

void read(const JsonValue& value, Subsurface& subsurface) {
    JsonObject object = value.object();
    visitSubsurface(readerOf(object), subsurface);
    object.done("a subsurface's fields");
}

} // namespace

void readFields(JsonObject& object, Light& light) {
    const std::optional<JsonValue> value = object.find("fields");
    if (!value) return;
    JsonObject fields = value->object();
    visitLight(readerOf(fields), light);
    fields.done("a light's fields");
}

void readFields(JsonObject& object, Camera& camera) {
    const std::optional<JsonValue> value = object.find("fields");
    if (!value) return;
    JsonObject fields = value->object();
    visitCamera(readerOf(fields), camera);
    fields.done("a camera's fields");
}

void readFields(JsonObject& object, Material& material) {
    const std::optional<JsonValue> value = object.find("fields");
    if (!value) return;
    JsonObject fields = value->object();
    visitMaterial(readerOf(fields), material);
    fields.done("a material's fields");
}

} // namespace tessera::scenes::scenejson
