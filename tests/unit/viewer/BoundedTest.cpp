#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scenes/Error.h"
#include "scenes/Scene.h"
#include "viewer/edit/Bounded.h"
#include "viewer/edit/MaterialModel.h"

namespace tessera::viewer {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Bounded, whatIsTypedAlwaysStaysBetweenItsBounds) {
    EXPECT_EQ(bounded(0.5f, 0.1f, 0.0f, 1.0f), 0.5f);
    EXPECT_EQ(bounded(-5.0f, 0.1f, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(bounded(7.0f, 0.1f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(bounded(kInfinity, 0.1f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(bounded(-double(kInfinity), 2.0, -kMostSeconds, kMostSeconds), -kMostSeconds);
}

TEST(Bounded, whatIsNoNumberAlwaysLeavesTheValueAsItWas) {
    EXPECT_EQ(bounded(NAN, 0.3f, 0.0f, 1.0f), 0.3f);
}

TEST(Bounded, aChannelThatWasNotEditedNeverChangesAlsoBeyondTheBounds) {
    const glm::vec3 before(2.0f, 0.25f, 0.5f);
    EXPECT_EQ(bounded(glm::vec3(2.0f, -1.0f, NAN), before, 0.0f, 1.0f), glm::vec3(2.0f, 0.0f, 0.5f));
}

TEST(Bounded, aSceneEditedToEveryBoundCanAlwaysBeSaved) {
    for (const bool isMost : {false, true}) {
        scenes::Scene scene;
        scenes::Material& material = scene.materials.emplace_back();
        material.emissive = glm::vec3(isMost ? kMostRadiance : 0.0f);
        material.baseColor = material.emissive.x > 0.0f ? glm::vec4(1.0f) : glm::vec4(0.0f);
        material.specularColor = material.sheenColor = glm::vec3(material.baseColor);
        scenes::Light& light = scene.lights.emplace_back();
        light.color = glm::vec3(isMost ? kMostLightColor : 0.0f);
        light.positionWS = glm::dvec3(isMost ? kMostMetres : -kMostMetres);
        EXPECT_NO_THROW(scenes::checkScene(scene));
        const glm::vec3 position(light.positionWS);
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
