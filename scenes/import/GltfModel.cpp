#include "scenes/import/GltfModel.h"

#include <fstream> // which tiny_gltf.h leaves out with TINYGLTF_NO_FS
#include <limits>
#include <type_traits>
#include <variant>

#define tinygltf tessera_tinygltf
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
#undef TINYGLTF_IMPLEMENTATION
#undef tinygltf

#include "scenes/AnimatedProperties.h"

namespace tessera::scenes::gltf {
namespace {

nlohmann::json taken(nlohmann::json& document, const char* key) {
    const auto found = document.find(key);
    if (found == document.end()) return nlohmann::json::array();
    nlohmann::json value = std::move(*found);
    document.erase(found);
    return value;
}

/// Gives accessors without a buffer view an extra one, the last: tinygltf 2.7 refuses index accessors without one.
/// Returns whether it added one. Source: tinygltf, issues 324 and 378.
bool addMissingView(nlohmann::json& document) {
    if (!document.contains("accessors")) return false;
    nlohmann::json& views = document["bufferViews"];
    bool isMissing = false;
    for (nlohmann::json& accessor : document["accessors"]) {
        if (accessor.contains("bufferView")) continue;
        accessor["bufferView"] = views.size();
        isMissing = true;
    }
    if (isMissing) views.push_back({{"buffer", 0}, {"byteLength", 1}});
    return isMissing;
}

/// Adds node -1 to channels without a node, as of KHR_animation_pointer, which tinygltf would drop.
void addMissingNodes(nlohmann::json& document) {
    if (!document.contains("animations")) return;
    for (nlohmann::json& animation : document["animations"])
        for (nlohmann::json& channel : animation["channels"])
            if (nlohmann::json& target = channel["target"]; !target.contains("node")) target["node"] = -1;
}

TextureInfo textureInfo(int texture, int texCoordSet, const tiny::Value* transform) {
    TextureInfo info{texture, integerOf(valueAt(transform, "texCoord"), texCoordSet), {}};
    info.transform.offset = vectorOf(numbersOf(valueAt(transform, "offset")), info.transform.offset);
    info.transform.scale = vectorOf(numbersOf(valueAt(transform, "scale")), info.transform.scale);
    info.transform.rotationRadians = float(numberOf(valueAt(transform, "rotation"), 0.0));
    return info;
}

/// From one of tinygltf's three texture info types.
TextureInfo textureInfo(const auto& stored) {
    return textureInfo(stored.index, stored.texCoord, valueAt(stored.extensions, "KHR_texture_transform"));
}

TextureInfo textureInfo(const tiny::Value* stored) {
    return textureInfo(integerOf(valueAt(stored, "index")), integerOf(valueAt(stored, "texCoord"), 0),
                       valueAt(stored, "extensions/KHR_texture_transform"));
}

constexpr std::string_view kExtensions = "extensions/";

TextureInfo textureAt(const tiny::Material& stored, const TexturePlace& place) {
    const tiny::PbrMetallicRoughness& metallicRoughness = stored.pbrMetallicRoughness;
    if (place.slot == TextureSlot::BaseColor) return textureInfo(metallicRoughness.baseColorTexture);
    if (place.slot == TextureSlot::MetallicRoughness) return textureInfo(metallicRoughness.metallicRoughnessTexture);
    if (place.slot == TextureSlot::Normal) return textureInfo(stored.normalTexture);
    if (place.slot == TextureSlot::Emissive) return textureInfo(stored.emissiveTexture);
    if (place.slot == TextureSlot::Occlusion) return textureInfo(stored.occlusionTexture);
    return textureInfo(valueAt(stored.extensions, place.path.substr(kExtensions.size())));
}

SpecularGlossiness specularGlossinessOf(const tiny::Value* stored) {
    return {vectorOf(numbersOf(valueAt(stored, "diffuseFactor")), glm::vec4(1.0f)),
            vectorOf(numbersOf(valueAt(stored, "specularFactor")), glm::vec3(1.0f)),
            float(numberOf(valueAt(stored, "glossinessFactor"), 1.0)), textureInfo(valueAt(stored, "diffuseTexture")),
            textureInfo(valueAt(stored, "specularGlossinessTexture"))};
}

/// Reads all extension values that have a member in the material.
void readExtensions(const tiny::ExtensionMap& extensions, Material& material) {
    for (const AnimatedPropertyInfo& property : animatedProperties()) {
        if (property.owner != AnimatedOwner::Material || !property.path.starts_with(kExtensions)) continue;
        const tiny::Value* const value = valueAt(extensions, property.path.substr(kExtensions.size()));
        if (value == nullptr) continue;
        if (const auto* number = std::get_if<float Material::*>(&property.member))
            material.*(*number) = float(value->GetNumberAsDouble());
        if (const auto* color = std::get_if<glm::vec3 Material::*>(&property.member))
            material.*(*color) = vectorOf(numbersOf(value), material.*(*color));
    }
}

} // namespace

tiny::Model tinyModel(nlohmann::json document, const std::string& file, LoadLedger& ledger) {
    taken(document, "buffers");
    document["asset"]["version"] = "2.0"; // for any version 2.x
    const nlohmann::json images = taken(document, "images");
    const bool hasExtraView = addMissingView(document);
    addMissingNodes(document);
    tiny::Model model;
    if (document.contains("nodes")) model.nodes.reserve(document["nodes"].size());
    const std::string text = document.dump();
    document = nullptr;
    ledger.charge(text.size(), [&] { return file + ": its JSON"; });
    if (text.size() > std::numeric_limits<unsigned>::max())
        throw InputError(fmt::format("{}: its JSON is larger than 4 GiB; split the model", file));
    std::string error, warning;
    if (!tiny::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), ""))
        throw InputError(fmt::format("{}: {}", file, error));
    if (hasExtraView) {
        model.bufferViews.pop_back();
        const int extra = int(model.bufferViews.size());
        for (tiny::Accessor& accessor : model.accessors)
            if (accessor.bufferView == extra) accessor.bufferView = kNone;
    }
    model.images.resize(images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        model.images[i].name = images[i].value("name", "");
        model.images[i].uri = images[i].value("uri", "");
        model.images[i].bufferView = images[i].value("bufferView", kNone);
    }
    return model;
}

// ---- Values of extensions ------------------------------------------------------------------------------------------

const tiny::Value* valueAt(const tiny::Value* object, std::string_view path) {
    while (object != nullptr && !path.empty()) {
        const std::string key(path.substr(0, path.find('/')));
        path.remove_prefix(std::min(key.size() + 1, path.size()));
        object = object->Has(key) ? &object->Get(key) : nullptr;
    }
    return object;
}

const tiny::Value* valueAt(const tiny::ExtensionMap& extensions, std::string_view path) {
    const std::size_t end = path.find('/');
    const auto found = extensions.find(std::string(path.substr(0, end)));
    if (found == extensions.end()) return nullptr;
    return valueAt(&found->second, end == path.npos ? std::string_view() : path.substr(end + 1));
}

double numberOf(const tiny::Value* value, double otherwise) {
    return value != nullptr ? value->GetNumberAsDouble() : otherwise;
}

int integerOf(const tiny::Value* value, int otherwise) {
    return value != nullptr ? value->GetNumberAsInt() : otherwise;
}

std::string stringOf(const tiny::Value* value) {
    return value != nullptr ? value->Get<std::string>() : std::string();
}

std::span<const tiny::Value> elementsOf(const tiny::Value* value) {
    return value != nullptr ? std::span(value->Get<tiny::Value::Array>()) : std::span<const tiny::Value>();
}

std::vector<double> numbersOf(const tiny::Value* value) {
    std::vector<double> numbers;
    for (const tiny::Value& number : elementsOf(value)) numbers.push_back(number.GetNumberAsDouble());
    return numbers;
}

std::map<std::string, int> integersByName(const tiny::Value* value) {
    std::map<std::string, int> integers;
    if (value != nullptr)
        for (const auto& [name, integer] : value->Get<tiny::Value::Object>()) integers[name] = integer.GetNumberAsInt();
    return integers;
}

// ---- Objects -------------------------------------------------------------------------------------------------------

int lightOf(const tiny::Node& node) {
    return integerOf(valueAt(node.extensions, "KHR_lights_punctual/light"));
}

const tiny::Value* dracoOf(const tiny::Primitive& primitive) {
    return valueAt(primitive.extensions, "KHR_draco_mesh_compression");
}

std::string pointerOf(const tiny::AnimationChannel& channel) {
    return stringOf(valueAt(channel.target_extensions, "KHR_animation_pointer/pointer"));
}

int componentsOf(const tiny::Accessor& accessor) {
    if (accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3) return 0;
    return tiny::GetNumComponentsInType(std::uint32_t(accessor.type));
}

Sampler samplerOf(const tiny::Sampler& stored) {
    const auto filterOf = [](int filter, Filter otherwise) {
        if (filter < 0) return otherwise;
        if (filter < TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST)
            return filter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::Nearest : Filter::Linear;
        constexpr Filter kMipmaps[] = {Filter::NearestMipmapNearest, Filter::LinearMipmapNearest,
                                       Filter::NearestMipmapLinear, Filter::LinearMipmapLinear};
        return kMipmaps[filter - TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST];
    };
    const auto wrapOf = [](int wrap) {
        if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::ClampToEdge;
        return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::MirroredRepeat : Wrap::Repeat;
    };
    Sampler sampler;
    sampler.magnification = filterOf(stored.magFilter, sampler.magnification);
    sampler.minification = filterOf(stored.minFilter, sampler.minification);
    sampler.wrapU = wrapOf(stored.wrapS);
    sampler.wrapV = wrapOf(stored.wrapT);
    return sampler;
}

// ---- Materials -----------------------------------------------------------------------------------------------------

/// Source: glTF 2.0 section 3.9; KHR_materials_unlit, _emissive_strength, _ior, _specular, _anisotropy, _clearcoat,
/// _sheen, _iridescence, _transmission, _volume, _dispersion.
StoredMaterial::StoredMaterial(const tiny::Material& stored) {
    const tiny::PbrMetallicRoughness& metallicRoughness = stored.pbrMetallicRoughness;
    surface.name = stored.name;
    surface.baseColor = vectorOf(metallicRoughness.baseColorFactor, surface.baseColor);
    surface.metallic = float(metallicRoughness.metallicFactor);
    surface.perceptualRoughness = float(metallicRoughness.roughnessFactor);
    surface.normalScale = float(stored.normalTexture.scale);
    surface.occlusionStrength = float(stored.occlusionTexture.strength);
    if (stored.alphaMode != "OPAQUE")
        surface.alphaMode = stored.alphaMode == "MASK" ? AlphaMode::Mask : AlphaMode::Blend;
    surface.alphaCutoff = float(stored.alphaCutoff);
    surface.doubleSided = stored.doubleSided;
    for (std::size_t i = 0; i < textures.size(); ++i) textures[i] = textureAt(stored, kTexturePlaces[i]);
    emissiveFactor = vectorOf(stored.emissiveFactor, emissiveFactor);
    emissiveStrength =
        float(numberOf(valueAt(stored.extensions, "KHR_materials_emissive_strength/emissiveStrength"), 1.0));
    // An unlit material is its base colour; the rest is a fallback for programs that do not support the extension.
    if (stored.extensions.contains("KHR_materials_unlit")) {
        surface.model = MaterialModel::SingleColor;
        return;
    }
    const double mostEmission = fieldOf(kMaterialFields, &Material::emissive).most;
    surface.emissive = glm::min(glm::dvec3(emissiveFactor) * double(emissiveStrength), mostEmission);
    readExtensions(stored.extensions, surface);
    if (const tiny::Value* const glossy = valueAt(stored.extensions, "KHR_materials_pbrSpecularGlossiness"))
        specularGlossiness = specularGlossinessOf(glossy);
}

} // namespace tessera::scenes::gltf
