#include "scenes/import/SceneJsonParts.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <system_error>

#include <glm/trigonometric.hpp>

#include "scenes/MaterialLayers.h"
#include "scenes/import/Importers.h"
#include "scenes/import/SceneJsonNames.h"

namespace tessera::scenes::scenejson {
namespace {

TextureTransform readTextureTransform(const JsonValue& value) {
    JsonObject object = value.object();
    TextureTransform transform;
    if (const auto offset = object.find("offset")) transform.offset = offset->vector2();
    if (const auto scale = object.find("scale")) transform.scale = scale->vector2();
    if (const auto rotation = object.find("rotationDegrees"))
        transform.rotationRadians = glm::radians(rotation->single());
    object.done("a texture transform");
    return transform;
}

Sampler readSampler(const JsonValue& value) {
    JsonObject object = value.object();
    Sampler sampler;
    if (const auto filter = object.find("magFilter"))
        sampler.magnification = filter->oneOf<Filter>("magnification filter", std::span(kFilters).first<2>());
    if (const auto filter = object.find("minFilter"))
        sampler.minification = filter->oneOf<Filter>("minification filter", kFilters);
    if (const auto wrap = object.find("wrapU")) sampler.wrapU = wrap->oneOf<Wrap>("wrap mode", kWraps);
    if (const auto wrap = object.find("wrapV")) sampler.wrapV = wrap->oneOf<Wrap>("wrap mode", kWraps);
    object.done("a sampler");
    return sampler;
}

/// Reads one material's parameters, each either a factor or {factor, texture}.
class Parameters {
public:
    Parameters(JsonObject& object, Material& material, Images& images)
        : object_(object), material_(material), images_(images) {}

    /// Calls `readFactor` with the factor, if one is given. Slot Count: textures are not allowed.
    template <typename ReadFactor>
    void read(std::string_view key, TextureSlot slot, ReadFactor readFactor) {
        const std::optional<JsonValue> value = object_.find(key);
        if (!value) return;
        if (slot == TextureSlot::Count || !value->isObject()) return readFactor(*value);
        JsonObject parts = value->object();
        if (const auto factor = parts.find("factor")) readFactor(*factor);
        if (const auto texture = parts.find("texture")) setTexture(*texture, slot);
        parts.done("a parameter with a texture");
    }

    /// Reads a parameter of the model's table.
    void parameter(const MaterialParameter& parameter) {
        read(parameter.key, parameter.slot, [&](const JsonValue& value) {
            std::visit([&](auto member) { setFactor(value, parameter.kind, member); }, parameter.member);
        });
    }

    /// Reads RGB, or RGB and opacity.
    void baseColor(std::string_view key) {
        read(key, TextureSlot::BaseColor, [&](const JsonValue& value) {
            const std::vector<JsonValue> channels = value.elements(3, 4);
            for (glm::length_t i = 0; i < 3; ++i) material_.baseColor[i] = channels[std::size_t(i)].single(0.0);
            if (channels.size() == 4) material_.baseColor.w = channels[3].single(0.0, 1.0);
        });
    }

    /// Reads a texture; null: none.
    void texture(std::string_view key, TextureSlot slot) {
        if (const auto value = object_.find(key)) setTexture(*value, slot);
    }

    void anisotropy() {
        if (const auto strength = object_.find("anisotropyStrength"))
            material_.anisotropyStrength = strength->single(0.0, 1.0);
        if (const auto rotation = object_.find("anisotropyRotationDegrees"))
            material_.anisotropyRotationRadians = float(glm::radians(rotation->number()));
        texture("anisotropyTexture", TextureSlot::Anisotropy);
    }

    void normalMap() {
        const std::optional<JsonValue> value = object_.find("normalMap");
        if (!value) return;
        if (!value->isNull()) {
            material_.normalMapSpace = NormalMapSpace::Tangent;
            material_.normalScale = 1.0f;
        }
        if (value->isNull() || value->isText()) return setTexture(*value, TextureSlot::Normal);
        JsonObject map = value->object();
        if (const auto space = map.find("space"))
            material_.normalMapSpace = space->oneOf<NormalMapSpace>("normal map space", kNormalMapSpaces);
        if (const auto scale = map.find("scale")) {
            if (material_.normalMapSpace == NormalMapSpace::Object)
                scale->fail("only a tangent-space normal map can be scaled; remove it");
            material_.normalScale = scale->single();
        }
        material_.texture(TextureSlot::Normal) = readTexture(map, images_);
        map.done("a normal map");
    }

    /// Reads a texture, or an object with the keys of a texture and of its strength.
    void scaledMap(std::string_view key, TextureSlot slot, std::string_view strengthKey, float& strength) {
        const std::optional<JsonValue> value = object_.find(key);
        if (!value) return;
        strength = 1.0f;
        if (!value->isObject()) return setTexture(*value, slot);
        JsonObject map = value->object();
        if (const auto stated = map.find(strengthKey)) strength = stated->single();
        material_.texture(slot) = readTexture(map, images_);
        map.done(fmt::format("the map '{}'", key));
    }

    void tangents() {
        if (const auto value = object_.find("tangents"))
            material_.tangents = value->oneOf<TangentMethod>("way to derive tangents", kTangentMethods);
    }

    void setTexture(const JsonValue& value, TextureSlot slot) {
        material_.texture(slot) = value.isNull() ? TextureUse{} : readTexture(value, images_);
    }

    void emission() {
        read("emissive", TextureSlot::Emissive, [&](const JsonValue& value) { material_.emissive = value.color(); });
        if (const auto strength = object_.find("emissiveStrength")) {
            const double factor = strength->number(0.0);
            const glm::dvec3 radiance = glm::dvec3(material_.emissive) * factor;
            if (std::max({radiance.x, radiance.y, radiance.z}) > std::numeric_limits<float>::max())
                strength->fail("emissive times emissiveStrength is not finite in single precision; lower it");
            material_.emissive = glm::vec3(radiance);
        }
    }

    void layers() {
        emission();
        for (const MaterialLayer& layer : materialLayers())
            for (const LayerParameter& parameter : layer) {
                if (parameter.isNormalMap)
                    scaledMap(parameter.key, parameter.slot, "scale",
                              material_.*std::get<float Material::*>(parameter.member));
                else
                    read(parameter.key, parameter.slot, [&](const JsonValue& value) {
                        std::visit([&](auto member) { setBounded(value, member); }, parameter.member);
                    });
            }
    }

private:
    void setBounded(const JsonValue& value, float Material::*member) {
        const auto field = fieldOf(kMaterialFields, member);
        material_.*member = value.single(field.least, field.most);
    }
    void setBounded(const JsonValue& value, glm::vec3 Material::*member) {
        const auto field = fieldOf(kMaterialFields, member);
        material_.*member = value.color(field.least, field.most);
    }

    void setFactor(const JsonValue& value, MaterialParameter::Kind kind, float Material::*member) {
        using Kind = MaterialParameter::Kind;
        if (kind == Kind::Ior) value.positive();
        float& factor = material_.*member =
                            value.single(fieldOf(kMaterialFields, member).least,
                                         kind == Kind::Number ? fieldOf(kMaterialFields, member).most : kAnyNumber);
        if (kind == Kind::IorOrPerfect && factor > 0.0f && factor < 1.0f)
            value.fail("is {}; 0 or at least 1 is needed", factor);
    }
    void setFactor(const JsonValue& value, MaterialParameter::Kind, glm::vec3 Material::*member) {
        material_.*member = value.color();
    }
    void setFactor(const JsonValue& value, MaterialParameter::Kind, Masking Material::*member) {
        std::vector<Named<Masking>> taken;
        std::ranges::copy_if(kMaskings, std::back_inserter(taken), [&](const Named<Masking>& masking) {
            return supportsMasking(material_.model, masking.second);
        });
        material_.*member = value.oneOf<Masking>("masking", taken);
    }

    JsonObject& object_;
    Material& material_;
    Images& images_;
};

DiffusionProfile readProfile(const JsonValue& value) {
    if (value.isText()) {
        std::vector<std::string_view> names;
        for (const NamedProfile& named : namedProfiles()) {
            if (value.text() == named.name) return named.profile;
            names.push_back(named.name);
        }
        value.failUnknown("profile", value.text(), names);
    }
    DiffusionProfile profile;
    for (const JsonValue& element : value.elements(1, kMostGaussians)) {
        JsonObject object = element.object();
        DiffusionGaussian& gaussian = profile.emplace_back();
        gaussian.varianceSquareMillimetres = object.require("varianceSquareMillimetres").single(0.0, kMostVariance);
        gaussian.weight = object.require("weight").color();
        object.done("a Gaussian of a profile");
    }
    if (const std::string problem = profileProblem(profile); !problem.empty()) value.fail(problem);
    return profile;
}

/// Reads a method, or an object with a method and the parameters of methods.
void readSubsurface(const JsonValue& value, Subsurface& subsurface) {
    const auto methodOf = [](const JsonValue& method) {
        return method.oneOf<SubsurfaceMethod>("subsurface method", kSubsurfaceMethodNames);
    };
    if (value.isText()) {
        subsurface.method = methodOf(value);
        return;
    }
    JsonObject object = value.object();
    visitFields(kSubsurfaceFields, [&](const auto& field) {
        const auto found = object.find(field.name);
        if (!found) return;
        auto& member = subsurface.*field.member;
        using Member = std::remove_reference_t<decltype(member)>;
        if constexpr (std::is_same_v<Member, SubsurfaceMethod>) {
            member = methodOf(*found);
        } else if constexpr (std::is_same_v<Member, DiffusionProfile>) {
            member = readProfile(*found);
        } else if constexpr (std::is_same_v<Member, glm::vec3>) {
            member = found->color(field.least, field.most);
        } else {
            member = found->single(field.least, field.most);
        }
    });
    object.done("a subsurface");
}

void readModelParameters(JsonObject& object, Material& material, Images& images) {
    Parameters parameters(object, material, images);
    const MaterialModelInfo& model = infoOf(material.model);
    parameters.baseColor(model.colorKey);
    for (const MaterialParameter& parameter : model.parameters) parameters.parameter(parameter);
    if (model.microsurface == Microsurface::MetallicRoughness)
        parameters.texture("metallicRoughnessTexture", TextureSlot::MetallicRoughness);
    if (model.anisotropy == Anisotropy::Strength) parameters.anisotropy();
    if (model.hasLayers) parameters.layers();
    if (!model.isLit) return;
    parameters.normalMap();
    parameters.scaledMap("occlusionMap", TextureSlot::Occlusion, "strength", material.occlusionStrength);
    parameters.tangents();
    if (const auto subsurface = object.find("subsurface")) readSubsurface(*subsurface, material.subsurface);
}

} // namespace

std::filesystem::path resolveFile(const JsonValue& name) {
    constexpr std::string_view kVariable = "${TESSERA_ASSETS}";
    std::string text = name.text();
    if (const std::size_t at = text.find(kVariable); at != std::string::npos) {
        const char* folder = std::getenv("TESSERA_ASSETS");
        if (folder == nullptr || *folder == '\0')
            name.fail("needs the environment variable TESSERA_ASSETS, which is not set; set it to the folder of the "
                      "third-party models");
        text.replace(at, kVariable.size(), folder);
    }
    if (text.find("${") != std::string::npos)
        name.fail("'{}': only ${{TESSERA_ASSETS}} is replaced in file names, once", name.text());
    const std::filesystem::path file = name.file().parent_path() / text;
    std::error_code failure;
    if (!std::filesystem::exists(file, failure))
        name.fail("there is no file '{}'; names are relative to the document's folder", file.string());
    return file;
}

int Images::image(const JsonValue& fileName) {
    if (scene_ == nullptr)
        fileName.fail("names a file where only pictures of the base can be used; give the number of one as 'image'");
    const std::filesystem::path file = resolveFile(fileName);
    const auto [entry, isNew] = imageOfFile_.try_emplace(file.lexically_normal().string(), kNone);
    if (!isNew) return entry->second;
    try {
        scene_->images.push_back(readImage(file, *ledger_));
    } catch (const InputError& error) {
        fileName.fail(error.what());
    }
    return entry->second = int(scene_->images.size()) - 1;
}

int Images::baseImage(const JsonValue& index) const {
    if (baseImages_ == 0) index.fail("there is no picture of a base; name a 'file'");
    return index.integer(0, int(baseImages_) - 1);
}

TextureUse readTexture(const JsonValue& value, Images& images) {
    if (value.isText()) {
        TextureUse use;
        use.image = images.image(value);
        return use;
    }
    JsonObject object = value.object();
    const TextureUse use = readTexture(object, images);
    object.done("a texture");
    return use;
}

TextureUse readTexture(JsonObject& object, Images& images) {
    TextureUse use;
    const std::optional<JsonValue> image = object.find("image");
    const std::optional<JsonValue> file = image ? object.find("file") : object.require("file");
    if (image && file) file->fail("is given beside 'image'; keep one");
    if (const auto set = object.find("texCoord")) use.texCoordSet = set->integer(0, 1);
    if (const auto transform = object.find("transform")) use.transform = readTextureTransform(*transform);
    if (const auto sampler = object.find("sampler")) use.sampler = readSampler(*sampler);
    // Last, because an image takes long to read and the rest may be wrong.
    use.image = image ? images.baseImage(*image) : images.image(*file);
    return use;
}

Material readMaterial(const JsonValue& value, Images& images) {
    JsonObject object = value.object();
    Material material;
    material.name = object.require("name").text();
    object.require("model");
    object.find("replaces"); // read by the caller
    changeMaterial(object, material, images);
    return material;
}

void changeMaterial(JsonObject& object, Material& material, Images& images) {
    if (const auto model = object.find("model")) {
        material.model = model->oneOf<MaterialModel>("material model", kModels);
        // Overrides may change the model, and not every model has every masking-shadowing option.
        if (!supportsMasking(material.model, material.masking)) material.masking = Masking::Walter;
    }
    readModelParameters(object, material, images);
    if (const auto mode = object.find("alphaMode"))
        material.alphaMode = mode->oneOf<AlphaMode>("alpha mode", kAlphaModes);
    if (const auto cutoff = object.find("alphaCutoff")) material.alphaCutoff = cutoff->single(0.0);
    if (const auto sides = object.find("doubleSided")) material.doubleSided = sides->boolean();
    if (const auto casts = object.find("castsShadow")) material.castsShadow = casts->boolean();
    const std::string_view model = nameOf(material.model);
    readFields(object, material);
    object.done(fmt::format("a {} material", model));
}

} // namespace tessera::scenes::scenejson
