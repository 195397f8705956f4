#include "renderer/frame/Features.h"

#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "renderer/frame/MaterialFeatures.h"
#include "shaders/shared/material.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::frame {
namespace {

using scenes::Material;
using scenes::MaterialModel;
using scenes::TextureSlot;

/// A scene of one lambert triangle, which needs no other feature.
scenes::Scene plainScene() {
    scenes::Scene scene = scenes::tinyScene();
    scene.materials[0].model = MaterialModel::Lambert;
    return scene;
}

void addTexture(Material& material, TextureSlot slot) {
    material.texture(slot).image = 0;
}

struct Change {
    Feature feature;
    std::function<void(scenes::Scene&)> apply; ///< makes the scene need the feature
};

std::vector<Change> changes() {
    const auto material = [](const std::function<void(Material&)>& change) {
        return [change](scenes::Scene& scene) { change(scene.materials[0]); };
    };
    /// A metal with one number changed, or a body of glass.
    const auto metal = [&](float Material::*member, float value) {
        return material([=](Material& m) {
            m.model = MaterialModel::MetallicRoughness;
            m.*member = value;
        });
    };
    const auto glass = [&](float thicknessMetres, float dispersion) {
        return material([=](Material& m) {
            m.model = MaterialModel::MetallicRoughness;
            m.transmission = 0.1f;
            m.thicknessMetres = thicknessMetres;
            m.dispersion = dispersion;
        });
    };
    const auto textured = [&](TextureSlot slot, const std::function<void(scenes::TextureUse&)>& change = {}) {
        return material([=](Material& m) {
            addTexture(m, slot);
            if (change) change(m.texture(slot));
        });
    };
    const auto subsurface = [&](scenes::SubsurfaceMethod method) {
        return material([method](Material& m) { m.subsurface.method = method; });
    };
    std::vector<Change> changes = {
        {Feature::TextureTransform,
         textured(TextureSlot::BaseColor, [](auto& use) { use.transform.rotationRadians = 1.0f; })},
        {Feature::MixedFilters,
         textured(TextureSlot::BaseColor, [](auto& use) { use.sampler.magnification = scenes::Filter::Nearest; })},
        {Feature::TexCoord1, textured(TextureSlot::Emissive, [](auto& use) { use.texCoordSet = 1; })},
        {Feature::VertexColor, [](scenes::Scene& scene) { scene.meshes[0].colors.assign(3, glm::vec4(1.0f)); }},
        {Feature::TangentSpaceNormals, textured(TextureSlot::Normal)},
        {Feature::ObjectSpaceNormals, material([](Material& m) {
             addTexture(m, TextureSlot::Normal);
             m.normalMapSpace = scenes::NormalMapSpace::Object;
         })},
        {Feature::Emission, material([](Material& m) {
             m.emissive = {0.0f, 0.1f, 0.0f};
         })},
        {Feature::Specular, metal(&Material::ior, 1.4f)},
        {Feature::MaskingOptions, material([](Material& m) {
             m.model = MaterialModel::Microfacet;
             m.masking = scenes::Masking::HalfVector;
         })},
        {Feature::Anisotropy, metal(&Material::anisotropyStrength, 0.1f)},
        {Feature::Clearcoat, metal(&Material::clearcoat, 0.1f)},
        {Feature::Sheen, material([](Material& m) {
             m.model = MaterialModel::MetallicRoughness;
             m.sheenColor.z = 0.1f;
         })},
        {Feature::Iridescence, metal(&Material::iridescence, 0.1f)},
        {Feature::Transmission, glass(0.0f, 0.0f)},
        {Feature::Volume, glass(0.1f, 0.0f)},
        {Feature::Dispersion, glass(0.1f, 0.1f)},
        {Feature::Mirrors, metal(&Material::perceptualRoughness, 0.1f)},
        {Feature::AlphaMask, material([](Material& m) { m.alphaMode = scenes::AlphaMode::Mask; })},
        {Feature::Blend, material([](Material& m) { m.alphaMode = scenes::AlphaMode::Blend; })},
        {Feature::DoubleSided, material([](Material& m) { m.doubleSided = true; })},
        {Feature::Hook, [](scenes::Scene& scene) { scene.hook.emplace(); }},
        {Feature::VaryingMaterials, textured(TextureSlot::BaseColor)},
        {Feature::SubsurfaceWrap, subsurface(scenes::SubsurfaceMethod::Wrap)},
        {Feature::SubsurfacePassage, subsurface(scenes::SubsurfaceMethod::DepthMap)},
        {Feature::SubsurfaceDiffusion, subsurface(scenes::SubsurfaceMethod::TextureSpaceDiffusion)},
    };
    for (const scenes::MaterialModelInfo& info : scenes::materialModels())
        if (info.model != MaterialModel::Lambert) // the plain scene's model
            changes.push_back(
                {featureOf(info.model), material([model = info.model](Material& m) { m.model = model; })});
    for (std::size_t i = 0; i < scenes::kTextureSlotCount; ++i)
        changes.push_back({featureOf(TextureSlot(i)), [i](scenes::Scene& scene) {
                               addTexture(scene.materials[0], TextureSlot(i));
                               if (TextureSlot(i) == TextureSlot::Occlusion)
                                   scene.environment.emplace(); // occlusion dims it
                           }});
    return changes;
}

TEST(Features, aFeatureIsInTheSetExactlyWhenAMaterialInUseNeedsIt) {
    EXPECT_TRUE(materialFeatures(plainScene())[featureOf(MaterialModel::Lambert)]);
    EXPECT_EQ(materialFeatures(plainScene()).has.count(), 1u);
    for (const Change& change : changes()) {
        scenes::Scene scene = plainScene();
        EXPECT_FALSE(materialFeatures(scene)[change.feature]) << featureTable()[std::size_t(change.feature)].define;
        change.apply(scene);
        EXPECT_TRUE(materialFeatures(scene)[change.feature]) << featureTable()[std::size_t(change.feature)].define;
    }
}

TEST(Features, aFilmChangesF0FromPixelToPixel) {
    scenes::Scene scene = plainScene();
    scene.materials[0].model = MaterialModel::MetallicRoughness;
    scene.materials[0].iridescence = 0.5f;
    const FeatureSet covered = materialFeatures(scene);
    EXPECT_TRUE(covered[Feature::Iridescence] && covered[Feature::Specular] && covered[Feature::VaryingMaterials]);
    scene.materials[0].iridescenceThicknessNm = 0.0f;
    const FeatureSet bare = materialFeatures(scene);
    EXPECT_FALSE(bare[Feature::Iridescence] || bare[Feature::Specular] || bare[Feature::VaryingMaterials]);
}

TEST(Features, whatTransmitsIsDrawnWithTheTransparentSurfacesAndHasABodyOnlyByItsThickness) {
    const auto features = [](MaterialModel model, float transmission, float thicknessMetres) {
        scenes::Scene scene = plainScene();
        scene.materials[0].model = model;
        scene.materials[0].transmission = transmission;
        scene.materials[0].thicknessMetres = thicknessMetres;
        return materialFeatures(scene);
    };
    const FeatureSet sheet = features(MaterialModel::MetallicRoughness, 1.0f, 0.0f);
    EXPECT_TRUE(sheet[Feature::Transmission] && sheet[Feature::Blend] && !sheet[Feature::Volume]);
    const FeatureSet opaque = features(MaterialModel::MetallicRoughness, 0.0f, 1.0f);
    EXPECT_FALSE(opaque[Feature::Transmission] || opaque[Feature::Blend] || opaque[Feature::Volume]);
    const FeatureSet lambert = features(MaterialModel::Lambert, 1.0f, 1.0f);
    EXPECT_FALSE(lambert[Feature::Transmission] || lambert[Feature::Blend] || lambert[Feature::Volume]);
}

TEST(Features, everyFeatureOfMaterialsHasASceneWithItAndOneWithout) {
    std::set<Feature> tested{featureOf(MaterialModel::Lambert),
                             Feature::AttenuationLights, // packLights() decides the features of lights and shadows
                             Feature::LightPictures,
                             Feature::OrthographicCamera,
                             Feature::Shadows,
                             Feature::SoftShadows,
                             Feature::ShadowMaps,
                             Feature::ShadowLift,
                             Feature::Environment};
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) tested.insert(featureOf(type.type));
    for (const Change& change : changes()) tested.insert(change.feature);
    EXPECT_EQ(tested.size(), kFeatureCount);
}

TEST(Features, aMaterialMayMirrorExactlyWhenSomeLobeOfItMayBeSharperThanFilteredLight) {
    struct Case {
        bool mayMirror;
        std::function<void(Material&)> set;
    };
    const auto metal = [](float roughness) {
        return [roughness](Material& m) {
            m.model = MaterialModel::MetallicRoughness;
            m.perceptualRoughness = roughness;
        };
    };
    const auto dielectric = [](MaterialModel model, float alpha, float alphaY) {
        return [=](Material& m) {
            m.model = model;
            m.alpha = alpha;
            m.alphaY = alphaY;
        };
    };
    const auto blinn = [](float exponent) {
        return [exponent](Material& m) {
            m.model = MaterialModel::BlinnPhong;
            m.exponent = exponent;
        };
    };
    const auto also = [](auto first, const std::function<void(Material&)>& second) {
        return [=](Material& m) {
            first(m);
            second(m);
        };
    };
    const auto coat = [](float roughness) {
        return [roughness](Material& m) {
            m.clearcoat = 0.5f;
            m.clearcoatPerceptualRoughness = roughness;
        };
    };
    const auto body = [](float thicknessMetres, float ior) {
        return [=](Material& m) {
            m.transmission = 1.0f;
            m.thicknessMetres = thicknessMetres;
            m.ior = ior;
        };
    };
    const auto textured = [](TextureSlot slot) { return [slot](Material& m) { addTexture(m, slot); }; };
    const std::vector<Case> cases = {
        {true, metal(0.0f)},
        {true, metal(0.1f)}, // alpha 0.01
        {false, metal(0.11f)},
        {true, also(metal(1.0f), textured(TextureSlot::MetallicRoughness))},
        {true, also(metal(1.0f), coat(0.0f))},
        {false, also(metal(1.0f), coat(0.5f))},
        {true, also(also(metal(1.0f), coat(0.5f)), textured(TextureSlot::ClearcoatRoughness))},
        {false, also(metal(1.0f), textured(TextureSlot::ClearcoatRoughness))}, // without a coat
        {false, also(metal(1.0f), textured(TextureSlot::BaseColor))},
        {true, dielectric(MaterialModel::Microfacet, 0.01f, 1.0f)},
        {false, dielectric(MaterialModel::Microfacet, 0.02f, 0.0f)},
        {true, dielectric(MaterialModel::MicrofacetAnisotropic, 0.02f, 0.0f)},
        {false, dielectric(MaterialModel::MicrofacetAnisotropic, 0.02f, 0.02f)},
        {true, also(dielectric(MaterialModel::MicrofacetAnisotropic, 0.5f, 0.5f), textured(TextureSlot::Anisotropy))},
        {true, blinn(2e4f)}, // as wide as alpha 0.01
        {false, blinn(1e4f)},
        {true, also(blinn(1e4f), textured(TextureSlot::MetallicRoughness))},
        // An index near 1 hardly widens transmitted light.
        {true, also(metal(0.5f), body(0.1f, 1.02f))},
        {false, also(metal(0.5f), body(0.1f, 1.5f))},
        {true, also(metal(0.23f), body(0.1f, 1.5f))}, // alpha 0.053, a sixth of it for transmitted light
        {false, also(metal(0.5f), body(0.1f, 0.0f))}, // an infinite index
        {true, also(metal(0.5f), body(0.0f, 1.02f))}, // thin sheets too
        {false, also(metal(0.5f), body(0.0f, 1.5f))},
        {true, also(also(metal(0.5f), body(0.1f, 1.5f)), textured(TextureSlot::Ior))},
        {false, [](Material& m) { m.perceptualRoughness = 0.0f; }}}; // lambert has no lobe
    for (std::size_t i = 0; i < cases.size(); ++i) {
        scenes::Scene scene = plainScene();
        cases[i].set(scene.materials[0]);
        EXPECT_EQ(materialFeatures(scene)[Feature::Mirrors], cases[i].mayMirror) << "case " << i;
    }
}

TEST(Features, ofLightThatEntersAreThoseOfASurfaceWithoutLayersThatPassesLight) {
    scenes::Scene scene = plainScene();
    Material& material = scene.materials[0];
    material.model = MaterialModel::MetallicRoughness;
    material.subsurface.method = scenes::SubsurfaceMethod::TextureSpaceDiffusion;
    material.clearcoat = 0.5f;
    material.sheenColor = glm::vec3(0.5f);
    material.emissive = glm::vec3(1.0f);
    material.anisotropyStrength = 0.5f;
    material.ior = 1.4f;
    const FeatureSet drawn = materialFeatures(scene), entered = enteringFeatures(scene, 0, 0);
    for (const Feature left : {Feature::Clearcoat, Feature::Sheen, Feature::Emission, Feature::Anisotropy,
                               Feature::Specular, featureOf(MaterialModel::MetallicRoughness)}) {
        EXPECT_TRUE(drawn[left]) << int(left);
        EXPECT_FALSE(entered[left]) << int(left);
    }
    EXPECT_EQ(entered.soleModel, MaterialModel::Lambert);
    EXPECT_TRUE(entered[Feature::SubsurfacePassage]);
    EXPECT_FALSE(drawn[Feature::SubsurfacePassage]) << "diffused light has passed before";
    EXPECT_FALSE(entered[Feature::SubsurfaceDiffusion]);
}

TEST(Features, glassPassesLightByALobeIfItMayBeRough) {
    Material clear;
    clear.transmission = 1.0f;
    clear.perceptualRoughness = 0.0f;
    Material rough = clear, textured = clear, anisotropic = clear, opaque = clear;
    rough.perceptualRoughness = 0.2f;
    addTexture(textured, TextureSlot::MetallicRoughness); // a texel may exceed 1
    anisotropic.anisotropyStrength = 0.5f;
    opaque = rough;
    opaque.transmission = 0.0f;
    EXPECT_TRUE(mayPassByLobe(rough) && mayPassByLobe(textured) && mayPassByLobe(anisotropic));
    EXPECT_FALSE(mayPassByLobe(clear) || mayPassByLobe(opaque));
}

TEST(Features, aRequestGivesItsMethodToMaterialsWithASubsurfaceAlone) {
    using Method = scenes::SubsurfaceMethod;
    const auto wraps = [](Method method, scenes::SubsurfaceRequest request, const std::function<void(Material&)>& set) {
        scenes::Scene scene = plainScene();
        scene.materials[0].subsurface.method = method;
        set(scene.materials[0]);
        return materialFeatures(scene, request)[Feature::SubsurfaceWrap];
    };
    const auto nothing = [](Material&) {};
    EXPECT_TRUE(wraps(Method::Wrap, {}, nothing));
    EXPECT_TRUE(wraps(Method::DepthMap, Method::Wrap, nothing));
    EXPECT_FALSE(wraps(Method::Wrap, Method::None, nothing));
    EXPECT_FALSE(wraps(Method::None, Method::Wrap, nothing));
    // Values without effect.
    EXPECT_FALSE(wraps(Method::Wrap, {}, [](Material& m) { m.subsurface.wrap = 0.0f; }));
    EXPECT_FALSE(wraps(Method::Wrap, {}, [](Material& m) { m.subsurface.wrapTint = glm::vec3(0.0f); }));
    EXPECT_FALSE(wraps(Method::Wrap, {}, [](Material& m) { m.model = MaterialModel::SingleColor; }));
}

TEST(Features, everyWayToChangeTheSpecularLobeIsSeen) {
    const auto changed = [](MaterialModel model, const std::function<void(Material&)>& change) {
        scenes::Scene scene = plainScene();
        scene.materials[0].model = model;
        change(scene.materials[0]);
        return materialFeatures(scene)[Feature::Specular];
    };
    using Changer = void (*)(Material&);
    const Changer nothing = [](Material&) {}, tint = [](Material&m) { m.specularColor.g = 0.5f; },
                  factor = [](Material&m) { m.specularFactor = 0.5f; }, ior = [](Material&m) { m.ior = 1.4f; },
                  factorMap = [](Material&m) { addTexture(m, TextureSlot::SpecularFactor); },
                  colorMap = [](Material&m) { addTexture(m, TextureSlot::SpecularColor); };
    for (const Changer change : {tint, factor, ior, factorMap, colorMap})
        EXPECT_TRUE(changed(MaterialModel::MetallicRoughness, change));
    EXPECT_FALSE(changed(MaterialModel::MetallicRoughness, nothing));
    EXPECT_FALSE(changed(MaterialModel::Lambert, tint));
    for (const MaterialModel model :
         {MaterialModel::Microfacet, MaterialModel::BlinnPhong, MaterialModel::MicrofacetAnisotropic}) {
        EXPECT_TRUE(changed(model, tint));
        EXPECT_TRUE(changed(model, colorMap));
        EXPECT_FALSE(changed(model, ior)) << "the microfacet model's ior is no colour of its own";
        EXPECT_FALSE(changed(model, nothing));
    }
}

TEST(Features, materialsVaryByEverythingThatChangesMoreThanNormals) {
    const auto varies = [](const std::function<void(scenes::Scene&)>& change) {
        scenes::Scene scene = plainScene();
        change(scene);
        return materialFeatures(scene)[Feature::VaryingMaterials];
    };
    EXPECT_FALSE(varies([](scenes::Scene&) {}));
    for (std::size_t i = 0; i < scenes::kTextureSlotCount; ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        const bool bends = slot == TextureSlot::Normal || slot == TextureSlot::ClearcoatNormal;
        const auto textured = [&](scenes::Scene& scene) {
            addTexture(scene.materials[0], slot);
            scene.environment.emplace(); // without one nothing reads occlusion
        };
        EXPECT_EQ(varies(textured), !bends) << i;
    }
    EXPECT_TRUE(varies([](scenes::Scene& scene) { scene.meshes[0].colors.assign(3, glm::vec4(1.0f)); }));
    EXPECT_TRUE(varies([](scenes::Scene& scene) { scene.materials[0].model = MaterialModel::MicrofacetAnisotropic; }));
    const auto brushed = [](MaterialModel model) {
        return [model](scenes::Scene& scene) {
            scene.materials[0].model = model;
            scene.materials[0].anisotropyStrength = 0.5f;
        };
    };
    EXPECT_TRUE(varies(brushed(MaterialModel::MetallicRoughness)));
    EXPECT_FALSE(varies(brushed(MaterialModel::Microfacet)));
    // A pixel has 11 bits for the number of its material.
    const auto inUse = [](int count) {
        return [count](scenes::Scene& scene) {
            scene.materials.resize(std::size_t(count));
            for (int material = 1; material < count; ++material) scene.nodes[0].instances.push_back({0, material});
        };
    };
    EXPECT_FALSE(varies(inUse(2048)));
    EXPECT_TRUE(varies(inUse(2049)));
}

TEST(Features, layersAndMaskingNeverCountForAModelThatLacksThem) {
    scenes::Scene scene = plainScene();
    Material& material = scene.materials[0];
    material.anisotropyStrength = material.clearcoat = material.iridescence = 1.0f;
    material.sheenColor = glm::vec3(1.0f);
    material.masking = scenes::Masking::HalfVector;
    EXPECT_EQ(materialFeatures(scene), materialFeatures(plainScene()));
}

TEST(Features, tangentsAreNeededExactlyByMapsInTangentSpaceAndByAnisotropy) {
    for (const FeatureInfo& info : featureTable()) {
        FeatureSet set;
        set.add(info.feature);
        const bool frame =
            info.feature == featureOf(MaterialModel::MicrofacetAnisotropic) || info.feature == Feature::Anisotropy;
        const bool map =
            info.feature == Feature::TangentSpaceNormals || info.feature == featureOf(TextureSlot::ClearcoatNormal);
        EXPECT_EQ(set.tangentFrame(), frame) << info.define;
        EXPECT_EQ(set.tangents(), frame || map) << info.define;
    }
}

TEST(Features, theSoleModelIsSetExactlyWhenEverySurfaceHasIt) {
    scenes::Scene scene = plainScene();
    EXPECT_EQ(materialFeatures(scene).soleModel, MaterialModel::Lambert);
    scene.materials.emplace_back().model = MaterialModel::Lambert;
    scene.nodes[0].instances.push_back({0, 1});
    EXPECT_EQ(materialFeatures(scene).soleModel, MaterialModel::Lambert);
    scene.materials.emplace_back().model = MaterialModel::Microfacet;
    scene.nodes[0].instances.push_back({0, 2});
    EXPECT_EQ(materialFeatures(scene).soleModel, std::nullopt);
    scene.nodes.clear();
    EXPECT_EQ(materialFeatures(scene).soleModel, std::nullopt);
}

TEST(Features, materialsThatNothingDrawsNeverCount) {
    scenes::Scene scene = plainScene();
    const FeatureSet features = materialFeatures(scene);
    ASSERT_FALSE(features[Feature::VaryingMaterials]);
    scene.materials.resize(scene.materials.size() + MATERIAL_TABLE_MOST);
    scene.materials.back().emissive = glm::vec3(1.0f);
    scene.materials.back().doubleSided = true;
    EXPECT_EQ(materialFeatures(scene), features);
    scene.meshes.emplace_back().name = "no triangles";
    scene.nodes[0].instances.push_back({int(scene.meshes.size()) - 1, int(scene.materials.size()) - 1});
    EXPECT_EQ(materialFeatures(scene), features);
    scene.nodes[0].instances.back().mesh = 0;
    EXPECT_TRUE(materialFeatures(scene)[Feature::Emission]);
    scene = plainScene();
    scene.materials[0].texture(TextureSlot::BaseColor).transform.rotationRadians = 1.0f;
    EXPECT_EQ(materialFeatures(scene), features) << "an empty slot's transform moves nothing";
}

} // namespace
} // namespace tessera::frame
