#include "renderer/frame/FeatureDefines.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tessera::frame {

namespace {

/// Microfacet models are contiguous, since the G-buffer numbers their maskings consecutively.
constexpr scenes::MaterialModel kFirstMicrofacet =
    std::ranges::find_if(scenes::materialModels(), &scenes::MaterialModelInfo::isMicrofacet)->model;
static_assert(std::ranges::is_partitioned(scenes::materialModels().subspan(std::size_t(kFirstMicrofacet)),
                                          &scenes::MaterialModelInfo::isMicrofacet));

// The default model of a surface (shaders/lib/surface/surface.glsl) is unlit.
static_assert(!scenes::materialModels().front().isLit);

/// The number of a model in a shader.
std::string numberOf(scenes::MaterialModel model) {
    return fmt::format("{}u", static_cast<int>(model));
}

void addModels(const FeatureSet& features, Defines& defines) {
    using scenes::Anisotropy, scenes::Highlight, scenes::Microsurface, scenes::MaterialModelInfo;
    for (const MaterialModelInfo& model : scenes::materialModels())
        defines.emplace_back("MODEL_" + inCapitals(model.name), numberOf(model.model));
    defines.emplace_back("MODEL_COUNT", fmt::format("{}u", scenes::kMaterialModelCount));
    defines.emplace_back("MODEL_FIRST_MICROFACET", numberOf(kFirstMicrofacet));
    if (features.soleModel) defines.emplace_back("SOLE_MODEL", numberOf(*features.soleModel));

    const auto addList = [&](const char* name, const char* each, const char* between, const char* none,
                             const auto& isOne) {
        std::vector<std::string> list;
        for (const MaterialModelInfo& model : scenes::materialModels())
            if (features[model.model] && isOne(model))
                list.push_back(fmt::format(fmt::runtime(each), int(model.model)));
        defines.emplace_back(name, list.empty() ? none : fmt::format("{}", fmt::join(list, between)));
    };
    const auto isLit = [](const MaterialModelInfo& model) { return model.isLit; };
    addList("LIT_MODELS", "{}u", ", ", "", isLit);
    // Macros that test a model. "false" where the scene has no such model, so that shader compilers drop the branch.
    const auto addQuestion = [&](const char* name, const auto& isOne) {
        addList(name, "(model) == {}u", " || ", "false", isOne);
        defines.back().second = "(" + defines.back().second + ")";
    };
    addQuestion("IS_UNLIT(model)", [](const MaterialModelInfo& model) { return !model.isLit; });
    addQuestion("IS_GLOSSY(model)", [](const MaterialModelInfo& model) { return model.highlight != Highlight::None; });
    addQuestion("HAS_DIELECTRIC_F0(model)",
                [](const MaterialModelInfo& model) { return model.highlight == Highlight::Dielectric; });
    addQuestion("HAS_PARAMETER(model)",
                [](const MaterialModelInfo& model) { return model.microsurface == Microsurface::Parameter; });
    addQuestion("IS_MICROFACET(model)", [](const MaterialModelInfo& model) { return model.isMicrofacet(); });
    addQuestion("HAS_METALLIC(model)",
                [](const MaterialModelInfo& model) { return model.microsurface == Microsurface::MetallicRoughness; });
    addQuestion("HAS_TWO_ALPHAS(model)",
                [](const MaterialModelInfo& model) { return model.anisotropy == Anisotropy::Alphas; });
    addQuestion("HAS_ANISOTROPY_STRENGTH(model)",
                [](const MaterialModelInfo& model) { return model.anisotropy == Anisotropy::Strength; });
    addQuestion("HAS_LAYERS(model)", [](const MaterialModelInfo& model) { return model.hasLayers; });
}

static_assert(scenes::kAreaTypeCount == 5 && scenes::kFlatTypeCount == 3,
              "a new shape needs a case in areaOutline() (shaders/lib/light/area_outline.glsl), areaFacing() "
              "(shaders/lib/light/light.glsl), shadowSurface() and surfacePlace() "
              "(shaders/lib/shadow/surface_samples.glsl) and shaders/passes/seen_lights.frag; docs/add-a-light-type.md "
              "lists everything");

void addLightTypes(const FeatureSet& features, Defines& defines) {
    std::vector<std::string> cones, areas;
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        defines.emplace_back("LIGHT_" + inCapitals(type.name), fmt::format("{}", int(type.type)));
        if (!features[type.type]) continue;
        const std::string isType = fmt::format("(type) == {}", int(type.type));
        if (type.reach == scenes::LightReach::Cone) cones.push_back(isType);
        if (type.isArea) areas.push_back(isType);
    }
    // Expressions that test a light's type.
    const auto any = [](const std::vector<std::string>& types) {
        return types.empty() ? "(false)" : fmt::format("({})", fmt::join(types, " || "));
    };
    defines.emplace_back("IS_CONE_LIGHT(type)", any(cones));
    defines.emplace_back("IS_AREA_LIGHT(type)", any(areas));
}

} // namespace

Defines featureDefines(const FeatureSet& features) {
    Defines defines;
    const auto addFlag = [&](std::string name, bool flag) { defines.emplace_back(std::move(name), flag ? "1" : "0"); };
    for (const FeatureInfo& info : featureTable()) addFlag("HAS_" + info.define, features[info.feature]);
    addFlag("HAS_LIT_MODELS", features.litModels());
    addFlag("HAS_GLOSSY_MODELS", features.glossyModels());
    addFlag("HAS_MICROSURFACES", features.microsurfaces());
    addFlag("HAS_GGX_MODELS", features.ggxModels());
    addFlag("HAS_TANGENT_FRAME", features.tangentFrame());
    addFlag("HAS_TANGENTS", features.tangents());
    addFlag("HAS_TEXTURES", features.textures());
    addFlag("HAS_TEXCOORDS", features.texCoords());
    addFlag("HAS_SUBSURFACE_ROWS", features.subsurfaceRows());
    addFlag("HAS_ENTERING_LIGHT", features.enteringLight());
    addFlag("HAS_PLACED_LIGHTS", features.placedLights());
    addFlag("HAS_CONE_LIGHTS", features.coneLights());
    addFlag("HAS_AREA_LIGHTS", features.areaLights());
    addFlag("HAS_LIGHT_SHAPES", features.lightShapes());
    addFlag("HAS_LIGHT_SHADOW_TEXELS", features.lightShadowTexels());
    for (const scenes::TextureSlotInfo& slot : scenes::kTextureSlots)
        defines.emplace_back("TEXTURE_SLOT_" + inCapitals(slot.name), fmt::format("{}", int(slot.slot)));
    addLightTypes(features, defines);
    addModels(features, defines);
    return defines;
}

} // namespace tessera::frame
