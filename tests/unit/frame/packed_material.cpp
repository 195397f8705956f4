#include "renderer/frame/PackedMaterial.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "shaders/shared/models.h"

namespace tessera::frame {
namespace {

using scenes::Material;
using scenes::MaterialModel;
using scenes::TextureSlot;

TEST(PackedMaterial, theUsualDielectricIsExactlyFourPercent) {
    const shared::MaterialConstants packed = packMaterial(Material{});
    EXPECT_EQ(packed.mixed.x, 0.04f) << "defaultSpecular() of surface.glsl, so that pruning changes no bit";
    EXPECT_EQ(packed.specular.w, 1.0f);
    Material material;
    material.ior = 1.0f;
    EXPECT_EQ(packMaterial(material).mixed.x, 0.0f);
    material.ior = 3.0f;
    material.specularColor = {1.0f, 0.5f, 0.0f};
    material.specularFactor = 0.5f;
    EXPECT_EQ(packMaterial(material).mixed.x, 0.25f);
    EXPECT_EQ(packMaterial(material).specular, glm::vec4(1.0f, 0.5f, 0.0f, 0.5f))
        << "the factor is applied after the textures";
}

TEST(PackedMaterial, whatABodyAbsorbsFollowsBeersLaw) {
    Material material;
    material.transmission = 0.5f;
    material.thicknessMetres = 3.0f;
    material.attenuationColor = {0.5f, 0.25f, 0.0f};
    const auto logarithm = [&] { return packMaterial(material).attenuation; };
    const auto expectTimes = [&](double distances) {
        EXPECT_FLOAT_EQ(logarithm().x, float(distances * std::log(0.5)));
        EXPECT_FLOAT_EQ(logarithm().y, float(distances * std::log(0.25)));
        EXPECT_EQ(logarithm().z, -1e30f) << "of nothing the logarithm has no bound";
    };
    EXPECT_EQ(packMaterial(material).transmission, glm::vec4(0.5f, 0.0f, 3.0f, 0.0f));
    EXPECT_EQ(logarithm(), glm::vec4(0.0f)) << "without a distance";
    material.attenuationDistanceMetres = 1.5f;
    expectTimes(2.0);
    material.attenuationDistanceMetres = 0.03125f;
    expectTimes(96.0);
    material.thicknessMetres = 0x1p-30f; // absorbs less than the light's rounding
    expectTimes(0x1p-25);
    material.thicknessMetres = 3.0f;
    material.attenuationDistanceMetres = 1e-38f;
    EXPECT_EQ(logarithm(), glm::vec4(-1e30f, -1e30f, -1e30f, 0.0f));
    material.thicknessMetres = 0.0f;
    EXPECT_EQ(logarithm(), glm::vec4(0.0f)) << "a sheet";
    EXPECT_EQ(packMaterial(material).transmission.z, 0.0f);
    material.alphaMode = scenes::AlphaMode::Blend;
    EXPECT_EQ(packMaterial(material).transmission.y, 1.0f) << "opacity covers";
    material.model = MaterialModel::Lambert;
    EXPECT_EQ(packMaterial(material).transmission.x, 0.0f);
}

TEST(PackedMaterial, aFilmIsStatedInMicrometres) {
    Material material;
    material.iridescence = 0.5f;
    material.iridescenceIor = 1.5f;
    material.iridescenceThicknessNm = 250.0f;
    material.iridescenceLeastThicknessNm = 125.0f;
    EXPECT_EQ(packMaterial(material).film, glm::vec4(0.5f, 1.5f, 0.25f, 0.125f));
    material.model = MaterialModel::Lambert;
    EXPECT_EQ(packMaterial(material).film.x, 0.0f);
}

TEST(PackedMaterial, onlyABodyOfWhatTransmitsDisperses) {
    Material material;
    material.dispersion = 0.5f; // an Abbe number of 40
    const auto spread = [&] { return packMaterial(material).attenuation.a; };
    EXPECT_EQ(spread(), 0.0f);
    material.transmission = 1.0f;
    EXPECT_EQ(spread(), 0.0f) << "a sheet";
    material.thicknessMetres = 0.1f;
    EXPECT_EQ(spread(), 0.0125f);
    material.model = MaterialModel::Lambert;
    EXPECT_EQ(spread(), 0.0f);
}

TEST(PackedMaterial, filtersGoToTheModesOfTheirSlot) {
    using scenes::Filter;
    const auto modes = [](Filter magnification, Filter minification) {
        Material material;
        material.textures[0].sampler.magnification = magnification;
        material.textures[0].sampler.minification = minification;
        return int(packMaterial(material).uvRow1[0].w);
    };
    EXPECT_EQ(modes(Filter::Linear, Filter::LinearMipmapNearest), 0);
    EXPECT_EQ(modes(Filter::Nearest, Filter::Linear), TEXTURE_MODE_MAGNIFIES_NEAREST);
    EXPECT_EQ(modes(Filter::Linear, Filter::Nearest), TEXTURE_MODE_MINIFIES_NEAREST);
    for (const Filter levels : {Filter::NearestMipmapNearest, Filter::NearestMipmapLinear}) {
        EXPECT_EQ(modes(Filter::Linear, levels), TEXTURE_MODE_MINIFIES_NEAREST + TEXTURE_MODE_HALF_LEVEL);
        EXPECT_EQ(modes(Filter::Nearest, levels), TEXTURE_MODE_MAGNIFIES_NEAREST + TEXTURE_MODE_MINIFIES_NEAREST);
    }
}

TEST(PackedMaterial, exactlyTheColourSlotsAreSrgb) {
    const std::set<TextureSlot> colours{TextureSlot::BaseColor, TextureSlot::Emissive, TextureSlot::SpecularColor,
                                        TextureSlot::SheenColor};
    for (std::size_t i = 0; i < scenes::kTextureSlotCount; ++i)
        EXPECT_EQ(scenes::infoOf(TextureSlot(i)).isSrgb, colours.contains(TextureSlot(i))) << i;
}

TEST(PackedSubsurfaces, letThroughWhatCastsShadowsAlone) {
    scenes::Scene scene;
    scene.meshes.resize(1);
    scene.meshes[0].positionsOS = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    scene.meshes[0].indices = {0, 1, 2};
    scene.nodes.resize(1);
    for (int i = 0; i < 4; ++i) {
        Material& material = scene.materials.emplace_back();
        material.subsurface.method =
            i < 2 ? scenes::SubsurfaceMethod::DepthMap : scenes::SubsurfaceMethod::TextureSpaceDiffusion;
        material.castsShadow = i % 2 == 0;
        scene.nodes[0].instances.push_back({0, i});
    }
    const PackedSubsurfaces packed = packSubsurfaces(scene, {});
    for (std::size_t i = 0; i < 4; ++i) {
        const bool passes = i % 2 == 0;
        EXPECT_EQ(packed.passed[i], passes ? packed.rowOf[i] : 0u) << i;
        EXPECT_TRUE(!passes || packed.rowOf[i] > 0) << i;
        EXPECT_EQ(packed.rows[packed.rowOf[i]].absorption.a, passes ? 1.0f : 0.0f) << i;
    }
}

} // namespace
} // namespace tessera::frame
