#include "scenes/MaterialLayers.h"
#include "scenes/import/SceneJsonNames.h"
#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "scenes/write/WithFields.h"

namespace tessera::scenes::write {
namespace {

Json textureJson(const TextureUse& use) {
    Json json;
    json["image"] = use.image;
    if (use.texCoordSet != 0) json["texCoord"] = use.texCoordSet;
    if (const TextureTransform& transform = use.transform; transform != TextureTransform()) {
        json["transform"]["offset"] = numbers(transform.offset);
        json["transform"]["scale"] = numbers(transform.scale);
        json["transform"]["rotationDegrees"] = degreesOf(transform.rotationRadians);
    }
    if (const Sampler& sampler = use.sampler; sampler != Sampler()) {
        json["sampler"]["magFilter"] = scenejson::nameOf(sampler.magnification);
        json["sampler"]["minFilter"] = scenejson::nameOf(sampler.minification);
        json["sampler"]["wrapU"] = scenejson::nameOf(sampler.wrapU);
        json["sampler"]["wrapV"] = scenejson::nameOf(sampler.wrapV);
    }
    return json;
}

/// Writes the keys of one material's model.
class Keys {
public:
    Keys(const Material& material, Json& json) : material_(material), json_(json) {}

    void factor(const char* key, float value) { json_[key] = number(value); }

    /// A slot of Count has no texture.
    void parameter(const char* key, Json factor, TextureSlot slot) {
        if (slot == TextureSlot::Count || material_.texture(slot).image == kNone)
            json_[key] = std::move(factor);
        else
            json_[key] = {{"factor", std::move(factor)}, {"texture", textureJson(material_.texture(slot))}};
    }

    void texture(const char* key, TextureSlot slot) {
        if (material_.texture(slot).image != kNone) json_[key] = textureJson(material_.texture(slot));
    }

    void baseColor(const char* key) { parameter(key, numbers(material_.baseColor), TextureSlot::BaseColor); }

    /// A parameter of the model's table.
    void parameter(const MaterialParameter& parameter) {
        this->parameter(parameter.key, factorOf(parameter.member), parameter.slot);
    }

    void normalMap() {
        if (material_.texture(TextureSlot::Normal).image == kNone) return;
        Json& map = json_["normalMap"] = textureJson(material_.texture(TextureSlot::Normal));
        map["space"] = scenejson::nameOf(material_.normalMapSpace);
        if (material_.normalMapSpace == NormalMapSpace::Tangent) map["scale"] = number(material_.normalScale);
    }

    void occlusionMap() {
        if (material_.texture(TextureSlot::Occlusion).image == kNone) return;
        Json& map = json_["occlusionMap"] = textureJson(material_.texture(TextureSlot::Occlusion));
        map["strength"] = number(material_.occlusionStrength);
    }

    void anisotropy() {
        if (material_.anisotropyStrength == 0.0f) return;
        factor("anisotropyStrength", material_.anisotropyStrength);
        json_["anisotropyRotationDegrees"] = degreesOf(material_.anisotropyRotationRadians);
        texture("anisotropyTexture", TextureSlot::Anisotropy);
    }

    void layers() {
        parameter("emissive", numbers(material_.emissive), TextureSlot::Emissive);
        for (const MaterialLayer& layer : materialLayers()) {
            const auto isThere = [&](auto member) {
                return material_.*member != std::remove_cvref_t<decltype(material_.*member)>(0.0f);
            };
            if (!std::visit(isThere, layer.front().member)) continue;
            for (const LayerParameter& parameter : layer) layerParameter(parameter);
        }
    }

private:
    void layerParameter(const LayerParameter& parameter) {
        if (!parameter.isNormalMap) return this->parameter(parameter.key, factorOf(parameter.member), parameter.slot);
        if (material_.texture(parameter.slot).image == kNone) return;
        json_[parameter.key] = textureJson(material_.texture(parameter.slot));
        json_[parameter.key]["scale"] = factorOf(parameter.member);
    }

    template <typename Member>
    Json factorOf(const Member& member) const {
        return std::visit([this](auto own) { return factorJson(material_.*own); }, member);
    }
    static Json factorJson(float value) { return number(value); }
    static Json factorJson(const glm::vec3& value) { return numbers(value); }
    static Json factorJson(Masking masking) { return scenejson::nameOf(masking); }

    const Material& material_;
    Json& json_;
};

Json profileJson(const DiffusionProfile& profile) {
    for (const NamedProfile& named : namedProfiles())
        if (named.profile == profile) return named.name;
    Json list = Json::array();
    for (const DiffusionGaussian& gaussian : profile)
        list.push_back({{"varianceSquareMillimetres", number(gaussian.varianceSquareMillimetres)},
                        {"weight", numbers(gaussian.weight)}});
    return list;
}

/// The method, and all values that differ from the defaults.
Json subsurfaceJson(const Subsurface& subsurface) {
    const Subsurface none;
    Json json;
    json["method"] = scenejson::nameOf(subsurface.method);
    const auto add = [&](const auto& field, auto toJson) {
        const auto& value = subsurface.*field.member;
        if (!(value == none.*field.member)) json[field.name] = toJson(value);
    };
    visitFields(kSubsurfaceFields, [&](const auto& field) {
        using Value = std::remove_cvref_t<decltype(subsurface.*field.member)>;
        if constexpr (std::is_same_v<Value, float>)
            add(field, [](float value) { return number(value); });
        else if constexpr (std::is_same_v<Value, glm::vec3>)
            add(field, [](const glm::vec3& value) { return numbers(value); });
        else if constexpr (std::is_same_v<Value, DiffusionProfile>)
            add(field, profileJson);
    });
    return json;
}

Json byKeys(const Material& material) {
    Json json;
    json["name"] = material.name;
    json["model"] = scenejson::nameOf(material.model);
    Keys keys(material, json);
    const MaterialModelInfo& model = infoOf(material.model);
    keys.baseColor(model.colorKey);
    for (const MaterialParameter& parameter : model.parameters) keys.parameter(parameter);
    if (model.microsurface == Microsurface::MetallicRoughness)
        keys.texture("metallicRoughnessTexture", TextureSlot::MetallicRoughness);
    if (model.anisotropy == Anisotropy::Strength) keys.anisotropy();
    if (model.hasLayers) keys.layers();
    if (model.isLit) keys.normalMap();
    if (model.isLit) keys.occlusionMap();
    if (model.isLit && material.tangents != TangentMethod::MikkTSpace)
        json["tangents"] = scenejson::nameOf(material.tangents);
    if (model.isLit && material.subsurface != Subsurface()) json["subsurface"] = subsurfaceJson(material.subsurface);
    json["alphaMode"] = scenejson::nameOf(material.alphaMode);
    json["alphaCutoff"] = number(material.alphaCutoff);
    json["doubleSided"] = material.doubleSided;
    if (!material.castsShadow) json["castsShadow"] = false;
    return json;
}

} // namespace

Json materialJson(const Material& material, std::size_t images) {
    const Json least = {{"name", "material"}, {"model", "metallic_roughness"}};
    return withFields(material, byKeys(material), least, [images](const JsonValue& value) {
        scenejson::Images known(images);
        return scenejson::readMaterial(value, known);
    });
}

} // namespace tessera::scenes::write
