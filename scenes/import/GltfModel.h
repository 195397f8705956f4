#pragma once
#include <nlohmann/json.hpp>

#include "scenes/import/Repairs.h"

// Renamed: a program that links this library may contain its own tinygltf, built with other options.
#define tinygltf tessera_tinygltf
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
#undef tinygltf

/// Access to tinygltf's objects, which checkedProperties() has checked. Missing indices are kNone.
namespace tessera::scenes::gltf {

namespace tiny = tessera_tinygltf;

/// Checks the properties of a document that its scene uses (GltfSchema.cpp): JSON types, ranges, choices, and that each
/// index refers to an element. Clamps numbers; removes other flawed values with the smallest object that needs them.
/// Returns a document with only these properties: tinygltf ignores values of a wrong type without a message, keeps the
/// low 32 bits of integers, and copies all other values. Integers written with a decimal point (24.0) become integers.
/// Moves strings out of `document`. Charges the ledger for tinygltf's copy of the result. Throws InputError "file:
/// /json/pointer: what" if the load is strict.
nlohmann::json checkedProperties(nlohmann::json& document, const std::string& file, LoadLedger& ledger,
                                 Repairs& repairs);

/// Parses a document of checkedProperties() by tinygltf. `buffers` stays empty and images have only name, uri and
/// bufferView, because tinygltf would read and decode all of them at once. Throws InputError with tinygltf's message.
tiny::Model tinyModel(nlohmann::json checked, const std::string& file, LoadLedger& ledger);

template <typename Element>
const Element& elementAt(const std::vector<Element>& elements, int index) {
    return elements[std::size_t(index)];
}

// ---- Values of extensions ------------------------------------------------------------------------------------------

/// The value at a path of keys; null if there is none. Empty objects and arrays count as missing.
const tiny::Value* valueAt(const tiny::Value* object, std::string_view path);
/// The path begins with the extension's name.
const tiny::Value* valueAt(const tiny::ExtensionMap& extensions, std::string_view path);

// The content of a value, which may be null.
double numberOf(const tiny::Value* value, double otherwise);
int integerOf(const tiny::Value* value, int otherwise = kNone);
std::string stringOf(const tiny::Value* value);
std::span<const tiny::Value> elementsOf(const tiny::Value* value);
std::vector<double> numbersOf(const tiny::Value* value);
std::map<std::string, int> integersByName(const tiny::Value* value);

/// Returns `otherwise` if there are no numbers.
template <glm::length_t kLength, typename Number>
glm::vec<kLength, Number> vectorOf(const std::vector<double>& numbers, glm::vec<kLength, Number> otherwise) {
    for (glm::length_t i = 0; i < kLength && !numbers.empty(); ++i)
        otherwise[i] = static_cast<Number>(numbers[std::size_t(i)]);
    return otherwise;
}

// ---- Objects -------------------------------------------------------------------------------------------------------

inline glm::dvec3 translationOf(const tiny::Node& node) {
    return vectorOf(node.translation, glm::dvec3(0.0));
}
/// x, y, z, w of a quaternion.
inline glm::dvec4 rotationOf(const tiny::Node& node) {
    return vectorOf(node.rotation, glm::dvec4(0.0, 0.0, 0.0, 1.0));
}
inline glm::dvec3 scaleOf(const tiny::Node& node) {
    return vectorOf(node.scale, glm::dvec3(1.0));
}
/// KHR_lights_punctual.
int lightOf(const tiny::Node& node);
/// KHR_draco_mesh_compression; null without.
const tiny::Value* dracoOf(const tiny::Primitive& primitive);
/// KHR_animation_pointer; empty without.
std::string pointerOf(const tiny::AnimationChannel& channel);
/// Components per element; 16: a 4x4 matrix, 0: another matrix.
int componentsOf(const tiny::Accessor& accessor);
Sampler samplerOf(const tiny::Sampler& stored);

/// A texture property of a material. The order of the table is the order of image import.
struct TexturePlace {
    std::string_view path;
    TextureSlot slot;
};
inline constexpr TexturePlace kTexturePlaces[] = {
    {"pbrMetallicRoughness/baseColorTexture", TextureSlot::BaseColor},
    {"pbrMetallicRoughness/metallicRoughnessTexture", TextureSlot::MetallicRoughness},
    {"normalTexture", TextureSlot::Normal},
    {"emissiveTexture", TextureSlot::Emissive},
    {"occlusionTexture", TextureSlot::Occlusion},
    {"extensions/KHR_materials_specular/specularTexture", TextureSlot::SpecularFactor},
    {"extensions/KHR_materials_specular/specularColorTexture", TextureSlot::SpecularColor},
    {"extensions/KHR_materials_anisotropy/anisotropyTexture", TextureSlot::Anisotropy},
    {"extensions/KHR_materials_clearcoat/clearcoatTexture", TextureSlot::Clearcoat},
    {"extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", TextureSlot::ClearcoatRoughness},
    {"extensions/KHR_materials_clearcoat/clearcoatNormalTexture", TextureSlot::ClearcoatNormal},
    {"extensions/KHR_materials_sheen/sheenColorTexture", TextureSlot::SheenColor},
    {"extensions/KHR_materials_sheen/sheenRoughnessTexture", TextureSlot::SheenRoughness},
    {"extensions/KHR_materials_transmission/transmissionTexture", TextureSlot::Transmission},
    {"extensions/KHR_materials_volume/thicknessTexture", TextureSlot::Thickness},
    {"extensions/KHR_materials_iridescence/iridescenceTexture", TextureSlot::Iridescence},
    {"extensions/KHR_materials_iridescence/iridescenceThicknessTexture", TextureSlot::IridescenceThickness},
};

/// A use of a texture, with KHR_texture_transform.
struct TextureInfo {
    int texture = kNone;
    int texCoordSet = 0;
    TextureTransform transform;
};

/// KHR_materials_pbrSpecularGlossiness, which replaces pbrMetallicRoughness.
struct SpecularGlossiness {
    glm::vec4 diffuse{1.0f};
    glm::vec3 specular{1.0f};
    float glossiness = 1.0f;
    TextureInfo diffuseTexture;
    TextureInfo specularGlossinessTexture; ///< RGB specular (sRGB), A glossiness (linear)
};

struct StoredMaterial {
    Material surface;                                            ///< without its textures
    std::array<TextureInfo, std::size(kTexturePlaces)> textures; ///< in the order of kTexturePlaces
    glm::vec3 emissiveFactor{0.0f};
    float emissiveStrength = 1.0f; ///< already in surface.emissive, like emissiveFactor
    std::optional<SpecularGlossiness> specularGlossiness;

    explicit StoredMaterial(const tiny::Material& stored);
};

} // namespace tessera::scenes::gltf
