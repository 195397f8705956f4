#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/Error.h"
#include "scenes/Scene.h"
#include "viewer/edit/Bounded.h"
#include "viewer/edit/MaterialModel.h"

namespace tessera::viewer {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Bounded, typedValuesAreClampedToTheirBounds) {
    EXPECT_EQ(bounded(0.5f, 0.1f, 0.0f, 1.0f), 0.5f);
    EXPECT_EQ(bounded(-5.0f, 0.1f, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(bounded(7.0f, 0.1f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(bounded(kInfinity, 0.1f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(bounded(-double(kInfinity), 2.0, -kMostSeconds, kMostSeconds), -kMostSeconds);
}

TEST(Bounded, textThatIsNoNumberKeepsTheValue) {
    EXPECT_EQ(bounded(NAN, 0.3f, 0.0f, 1.0f), 0.3f);
}

TEST(Bounded, aChannelThatWasNotEditedNeverChangesAlsoBeyondTheBounds) {
    const glm::vec3 before(2.0f, 0.25f, 0.5f);
    EXPECT_EQ(bounded(glm::vec3(2.0f, -1.0f, NAN), before, 0.0f, 1.0f), glm::vec3(2.0f, 0.0f, 0.5f));
}

scenes::Material materialAtBounds(bool isMost) {
    const float share = isMost ? 1.0f : 0.0f; // for members from 0 to 1
    scenes::Material material;
    material.baseColor = glm::vec4(share);
    material.specularColor = material.sheenColor = glm::vec3(share);
    material.anisotropyStrength = material.clearcoat = share;
    material.clearcoatPerceptualRoughness = material.sheenPerceptualRoughness = material.alphaCutoff = share;
    material.transmission = share;
    material.attenuationColor = glm::vec3(share);
    material.thicknessMetres = material.attenuationDistanceMetres = isMost ? kMostThicknessShown : 0.0f;
    material.iridescence = share;
    material.iridescenceIor = isMost ? kMostFilmIorShown : 1.0f;
    material.iridescenceThicknessNm = material.iridescenceLeastThicknessNm = isMost ? kMostFilmThicknessShown : 0.0f;
    material.dispersion = isMost ? kMostDispersionShown : 0.0f;
    material.emissive = glm::vec3(isMost ? kMostRadiance : 0.0f);
    for (const scenes::MaterialModelInfo& model : scenes::materialModels()) {
        for (const scenes::MaterialParameter& parameter : model.parameters) {
            if (const auto* const number = std::get_if<float scenes::Material::*>(&parameter.member))
                material.** number = isMost ? parameter.mostShown : parameter.leastShown;
        }
    }
    material.normalScale = isMost ? kMostNormalScale : 0.0f;
    return material;
}

scenes::Light lightAtBounds(bool isMost) {
    scenes::Light light;
    light.type = scenes::LightType::Spot;
    light.color = glm::vec3(isMost ? kMostLightColor : 0.0f);
    light.intensity = isMost ? kMostIntensity : 0.0f;
    light.positionWS = glm::dvec3(isMost ? kMostMetres : -kMostMetres);
    light.directionWS = glm::normalize(glm::dvec3(isMost ? kMostDirection : -kMostDirection));
    light.rangeMetres = isMost ? kMostRangeMetres : kLeastRangeMetres;
    light.attenuation = isMost ? glm::vec3(kMostAttenuation) : glm::vec3(1.0f, 0.0f, 0.0f); // never all 0
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        for (const scenes::LightParameter& parameter : type.parameters) {
            const float bound = isMost ? parameter.most : parameter.least;
            light.*parameter.member =
                parameter.kind == scenes::LightParameter::Kind::Angle ? glm::radians(bound) : bound;
        }
    }
    return light;
}

TEST(Bounded, aSceneEditedToEveryBoundCanBeSaved) {
    for (const bool isMost : {false, true}) {
        scenes::Scene scene;
        scene.materials.push_back(materialAtBounds(isMost));
        for (const scenes::Falloff falloff : {scenes::Falloff::InverseSquare, scenes::Falloff::Attenuation}) {
            scene.lights.push_back(lightAtBounds(isMost));
            scene.lights.back().falloff = falloff;
        }
        EXPECT_NO_THROW(scenes::checkScene(scene));
        const glm::vec3 position(scene.lights[0].positionWS);
        EXPECT_TRUE(std::isfinite(glm::dot(position, position)));
    }
}

TEST(MaterialModel, aModelThatIsChosenNeverKeepsAMaskingThatItCannotHave) {
    using scenes::MaterialModel;
    const MaterialModel models[] = {MaterialModel::SingleColor,       MaterialModel::Lambert,
                                    MaterialModel::BlinnPhong,        MaterialModel::Microfacet,
                                    MaterialModel::MetallicRoughness, MaterialModel::MicrofacetAnisotropic};
    for (const MaterialModel first : models) {
        for (const MaterialModel second : models) {
            scenes::Scene scene;
            scenes::Material& material = scene.materials.emplace_back();
            material.model = MaterialModel::MicrofacetAnisotropic;
            material.masking = scenes::Masking::Directional;
            changeModel(material, first);
            changeModel(material, second);
            EXPECT_EQ(material.model, second);
            EXPECT_NO_THROW(scenes::checkScene(scene));
        }
    }
    scenes::Material other;
    other.masking = scenes::Masking::HalfVector;
    changeModel(other, MaterialModel::Microfacet);
    EXPECT_EQ(other.masking, scenes::Masking::HalfVector);
}

} // namespace
} // namespace tessera::viewer
