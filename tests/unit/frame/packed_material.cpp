#include "renderer/frame/PackedMaterial.h"

#include <cmath>

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

TEST(PackedMaterial, everyMemberIsTheMaterialsOwnValue) {
    Material material;
    material.model = MaterialModel::Microfacet;
    material.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
    material.emissive = {5, 6, 7};
    material.alphaCutoff = 0.75f;
    material.metallic = 0.5f;
    material.perceptualRoughness = 0.6f;
    material.alpha = 0.02f;
    material.ior = 1.33f;
    material.normalScale = 2.0f;
    material.specularColor = {0.7f, 0.8f, 0.9f};
    const shared::MaterialConstants packed = packMaterial(material);
    EXPECT_EQ(packed.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(packed.emissive, glm::vec4(5.0f, 6.0f, 7.0f, 0.75f));
    EXPECT_EQ(packed.microsurface, glm::vec4(0.5f, 0.02f, 1.33f, 2.0f)) << "alpha as it is";
    EXPECT_EQ(glm::vec3(packed.specular), glm::vec3(0.7f, 0.8f, 0.9f)) << "k_s as it is";
    EXPECT_EQ(packed.kind, glm::uvec4(unsigned(MaterialModel::Microfacet), 0u, 0u, 0u));
    material.model = MaterialModel::MetallicRoughness;
    EXPECT_EQ(packMaterial(material).microsurface.y, 0.6f)
        << "perceptual roughness, squared in the shader after its texture";
    material.exponent = 7.0f;
    material.model = MaterialModel::BlinnPhong;
    EXPECT_EQ(packMaterial(material).microsurface.y, 7.0f);
}

TEST(PackedMaterial, anisotropyCoatAndSheenAreTheMaterialsOwnValues) {
    Material material;
    material.alpha = 0.3f;
    material.alphaY = 0.7f;
    material.masking = scenes::Masking::Directional;
    material.anisotropyStrength = 0.4f;
    material.anisotropyRotationRadians = 0.5f;
    material.clearcoat = 0.6f;
    material.clearcoatPerceptualRoughness = 0.2f;
    material.clearcoatNormalScale = 3.0f;
    material.sheenColor = {0.1f, 0.8f, 0.9f};
    material.sheenPerceptualRoughness = 0.25f;
    const shared::MaterialConstants packed = packMaterial(material);
    EXPECT_EQ(packed.anisotropy, glm::vec4(0.4f, float(std::cos(double(0.5f))), float(std::sin(double(0.5f))), 1.0f));
    EXPECT_EQ(packed.clearcoat, glm::vec4(0.6f, 0.2f, 3.0f, 0.0f));
    EXPECT_EQ(packed.clearcoatTurn, glm::vec4(1.0f, 0.0f, 1.0f, 0.0f));
    EXPECT_EQ(packed.sheen, glm::vec4(0.1f, 0.8f, 0.9f, 0.25f));
    material.model = MaterialModel::MicrofacetAnisotropic;
    EXPECT_EQ(packMaterial(material).microsurface.y, 0.3f) << "alpha_x";
    EXPECT_EQ(packMaterial(material).anisotropy.x, 0.7f) << "alpha_y";
    EXPECT_EQ(packMaterial(material).kind.z, MASKING_DIRECTIONAL);
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
    material.thicknessMetres = 0x1p-30f; // absorbs less than a rounding of the light
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

TEST(PackedMaterial, transformsOfTexturesWithVectorsRotateTheVectors) {
    Material material;
    material.clearcoat = 1.0f;
    material.anisotropyStrength = 0.5f;
    material.anisotropyRotationRadians = 0.25f;
    material.texture(TextureSlot::ClearcoatNormal).image = 0;
    material.texture(TextureSlot::ClearcoatNormal).transform.rotationRadians = 0.5f;
    scenes::TextureUse& normal = material.texture(TextureSlot::Normal);
    normal.image = 0;
    normal.transform = {{0, 0}, {1, -1}, 0.0f}; // which tangents follow: all others are mirrored against it
    const shared::MaterialConstants packed = packMaterial(material);
    const auto expectNear = [](const glm::vec4& value, const glm::dvec4& expected) {
        EXPECT_LE(glm::distance(glm::dvec4(value), expected), 1e-7) << value.x << ' ' << value.y << ' ' << value.z;
    };
    // The coat's u runs 0.5 to the right of the coordinates', and so to the left of the mirrored ones'.
    expectNear(packed.clearcoatTurn, {std::cos(0.5), std::sin(0.5), -1, 0});
    expectNear(packed.anisotropy, {0.5, std::cos(0.25), -std::sin(0.25), -1});
}

TEST(PackedMaterial, flagsAreThoseOfTheMaterial) {
    const auto flags = [](const auto& change) {
        Material material;
        change(material);
        return packMaterial(material).kind.y;
    };
    EXPECT_EQ(flags([](Material&) {}), 0u);
    EXPECT_EQ(flags([](Material& m) { m.texture(TextureSlot::Normal).image = 0; }), MATERIAL_FLAG_NORMAL_MAP);
    EXPECT_EQ(flags([](Material& m) { m.normalMapSpace = scenes::NormalMapSpace::Object; }),
              MATERIAL_FLAG_OBJECT_SPACE_NORMAL);
    EXPECT_EQ(flags([](Material& m) { m.alphaMode = scenes::AlphaMode::Mask; }), MATERIAL_FLAG_ALPHA_MASK);
    EXPECT_EQ(flags([](Material& m) { m.alphaMode = scenes::AlphaMode::Blend; }), 0u);
    EXPECT_EQ(flags([](Material& m) { m.doubleSided = true; }), MATERIAL_FLAG_DOUBLE_SIDED);
    EXPECT_EQ(flags([](Material& m) { m.texture(TextureSlot::Anisotropy).image = 0; }),
              MATERIAL_FLAG_ANISOTROPY_TEXTURE);
    EXPECT_EQ(flags([](Material& m) { m.texture(TextureSlot::ClearcoatNormal).image = 0; }),
              MATERIAL_FLAG_CLEARCOAT_NORMAL_MAP);
}

TEST(PackedMaterial, textureCoordinatesAreScaledThenTurnedThenMoved) {
    Material material;
    scenes::TextureUse& use = material.texture(TextureSlot::Emissive);
    use.transform = {.offset = {0.25f, -0.5f}, .scale = {2.0f, 3.0f}, .rotationRadians = 0.7f};
    const shared::MaterialConstants packed = packMaterial(material);
    const glm::vec4 row0 = packed.uvRow0[std::size_t(TextureSlot::Emissive)],
                    row1 = packed.uvRow1[std::size_t(TextureSlot::Emissive)];
    const double c = std::cos(0.7f), s = std::sin(0.7f);
    for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(0.3, 0.9)}) {
        // KHR_texture_transform with v down: a positive angle turns u towards -v.
        const glm::dvec2 expected(0.25 + c * 2.0 * uv.x + s * 3.0 * uv.y, -0.5 - s * 2.0 * uv.x + c * 3.0 * uv.y);
        EXPECT_NEAR(row0.x * uv.x + row0.y * uv.y + row0.z, expected.x, 1e-6); // fp32 rows of order one
        EXPECT_NEAR(row1.x * uv.x + row1.y * uv.y + row1.z, expected.y, 1e-6);
    }
    EXPECT_EQ(glm::vec3(packed.uvRow0[std::size_t(TextureSlot::Normal)]), glm::vec3(1, 0, 0))
        << "other slots lie as they are";
    EXPECT_EQ(glm::vec3(packed.uvRow1[std::size_t(TextureSlot::Normal)]), glm::vec3(0, 1, 0));
}

TEST(PackedMaterial, setsAndWrapModesGoToTheirSlot) {
    for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
        Material material;
        material.textures[slot].texCoordSet = 1;
        material.textures[slot].sampler.wrapU = scenes::Wrap::ClampToEdge;
        material.textures[slot].sampler.wrapV = scenes::Wrap::MirroredRepeat;
        const shared::MaterialConstants packed = packMaterial(material);
        for (std::size_t other = 0; other < scenes::kTextureSlotCount; ++other) {
            EXPECT_EQ(packed.uvRow0[other].w, other == slot ? 1.0f : 0.0f);
            EXPECT_EQ(packed.uvRow1[other].w, other == slot ? 1.0f + 4.0f * 2.0f : 0.0f);
        }
    }
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
    for (const TextureSlot slot :
         {TextureSlot::BaseColor, TextureSlot::Emissive, TextureSlot::SpecularColor, TextureSlot::SheenColor})
        EXPECT_TRUE(scenes::infoOf(slot).isSrgb);
    for (const TextureSlot slot :
         {TextureSlot::Normal, TextureSlot::MetallicRoughness, TextureSlot::SpecularFactor, TextureSlot::Ior,
          TextureSlot::Anisotropy, TextureSlot::Clearcoat, TextureSlot::ClearcoatRoughness,
          TextureSlot::ClearcoatNormal, TextureSlot::SheenRoughness, TextureSlot::Occlusion})
        EXPECT_FALSE(scenes::infoOf(slot).isSrgb);
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
    for (const std::size_t i : {0u, 2u}) {
        EXPECT_EQ(packed.passed[i], packed.rowOf[i]) << i;
        ASSERT_GT(packed.rowOf[i], 0u) << i;
        EXPECT_EQ(packed.rows[packed.rowOf[i]].absorption.a, 1.0f) << i;
    }
    for (const std::size_t i : {1u, 3u}) {
        EXPECT_EQ(packed.passed[i], 0u) << i;
        EXPECT_EQ(packed.rows[packed.rowOf[i]].absorption.a, 0.0f) << i;
    }
}

} // namespace
} // namespace tessera::frame
