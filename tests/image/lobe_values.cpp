// Texels of exponents, anisotropy, coats and sheens: images with a texture against the textbook value of the equivalent
// material.
#include <functional>

#include "tests/image/FlatTest.h"
#include "tests/image/Textbook.h"

namespace tessera {
namespace {

using namespace test;
using scenes::Material;
using scenes::MaterialModel;
using scenes::Scene;
using scenes::TextureSlot;

/// Two dozen relative fp32 roundings of 2^-24 each, and the error of exponents (docs/numerics.md).
constexpr double kLobeRounding = 3e-6;

/// The eye straight above, the sun oblique and off the axes, so that a rotated lobe shows.
const glm::dvec3 kToSun = glm::normalize(glm::dvec3(0.35, 0.2, 1.0));

class LobeValues : public FlatTest {
protected:
    static Scene underTheSun(const Material& material) { return FlatTest::underTheSun(material, -kToSun); }
    void expectColor(const Scene& scene, const glm::dvec3& wanted) {
        const glm::vec4 found = center(scene);
        EXPECT_GT(glm::length(wanted), 1e-4) << "there is nothing to see";
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], kLobeRounding * (1e-2 + wanted[c])) << c;
    }
    /// Expects a material with a texture of one texel to look like the material `equal` without it.
    void expectTexel(const Material& material, TextureSlot slot, const glm::vec4& texel, const Material& equal) {
        expectColor(texturedScene(underTheSun(material), slot, floatImage(texel)),
                    textbook::reflected(equal, {0, 0, 1}, kToSun, {0, 0, 1}));
    }
};

constexpr glm::vec4 kTexel{0.8f, 0.6f, 0.4f, 0.7f};

Material changed(Material material, const std::function<void(Material&)>& change) {
    change(material);
    return material;
}

TEST_F(LobeValues, theExponentIsMultipliedByGreen) {
    Material material = materialOf(MaterialModel::BlinnPhong);
    material.exponent = 40.0f;
    expectTexel(material, TextureSlot::MetallicRoughness, kTexel,
                changed(material, [](Material& m) { m.exponent *= 0.6f; }));
}

TEST_F(LobeValues, theTwoAlphasAreMultipliedByGreenAndRed) {
    Material material = materialOf(MaterialModel::MicrofacetAnisotropic);
    material.alpha = 0.5f;
    material.alphaY = 0.2f;
    expectTexel(material, TextureSlot::MetallicRoughness, kTexel,
                changed(material, [](Material& m) { m.alpha *= 0.6f; }));
    expectTexel(material, TextureSlot::Anisotropy, kTexel, changed(material, [](Material& m) { m.alphaY *= 0.8f; }));
}

Material brushedSteel() {
    Material material;
    material.baseColor = {0.7f, 0.6f, 0.5f, 1.0f};
    material.perceptualRoughness = 0.4f;
    material.anisotropyStrength = 0.9f;
    material.anisotropyRotationRadians = 0.3f;
    return material;
}

TEST_F(LobeValues, theAnisotropyTextureTurnsByRedAndGreenAndWeakensByBlue) {
    const Material material = brushedSteel();
    const float angle = 0.5f;
    // Not normalised: only its direction counts.
    const glm::vec4 texel(0.5f + 0.3f * std::cos(angle), 0.5f + 0.3f * std::sin(angle), 0.75f, 1.0f);
    expectTexel(material, TextureSlot::Anisotropy, texel, changed(material, [&](Material& m) {
                    m.anisotropyRotationRadians += angle;
                    m.anisotropyStrength *= 0.75f;
                }));
    const glm::vec4 none(0.5f, 0.5f, 1.0f, 1.0f);
    expectTexel(material, TextureSlot::Anisotropy, none, material);
}

TEST_F(LobeValues, theDirectionTurnsWithItsNodeAndIsMirroredWithIt) {
    const Material material = brushedSteel();
    Scene scene = underTheSun(material);
    const double turn = 0.7;
    scene.nodes[0].parentFromNode = glm::dmat4({std::cos(turn), std::sin(turn), 0, 0},
                                               {-std::sin(turn), std::cos(turn), 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
    const glm::dvec3 tangent(std::cos(turn), std::sin(turn), 0.0);
    expectColor(scene, textbook::reflected(material, {0, 0, 1}, kToSun, {0, 0, 1}, tangent));
    // The bitangent points the other way, and the lobe turns clockwise.
    scene.nodes[0].parentFromNode = glm::dmat4(glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    const Material clockwise = changed(material, [](Material& m) { m.anisotropyRotationRadians *= -1.0f; });
    expectColor(scene, textbook::reflected(clockwise, {0, 0, 1}, kToSun, {0, 0, 1}));
}

/// A coat over a surface that reflects nothing.
Material lacquer() {
    Material material = blackDielectric();
    material.specularFactor = 0.0f;
    material.clearcoat = 0.8f;
    material.clearcoatPerceptualRoughness = 0.6f;
    return material;
}

TEST_F(LobeValues, theCoatIsMultipliedByRedAndItsRoughnessByGreen) {
    const Material material = lacquer();
    expectTexel(material, TextureSlot::Clearcoat, kTexel, changed(material, [](Material& m) { m.clearcoat *= 0.8f; }));
    expectTexel(material, TextureSlot::ClearcoatRoughness, kTexel,
                changed(material, [](Material& m) { m.clearcoatPerceptualRoughness *= 0.6f; }));
}

TEST_F(LobeValues, theCoatFollowsItsOwnNormalMapAndNeverThatBelow) {
    Material material = lacquer();
    const glm::dvec3 plain = textbook::reflected(material, {0, 0, 1}, kToSun, {0, 0, 1});
    const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
    const glm::vec4 texel(glm::vec3(tilted * 0.5 + 0.5), 1.0f);
    expectColor(texturedScene(underTheSun(material), TextureSlot::Normal, floatImage(texel)), plain);
    // The textbook's coat lies in the frame of its own normal.
    const glm::dvec3 ownTilt = textbook::reflected(material, tilted, kToSun, {0, 0, 1});
    expectColor(texturedScene(underTheSun(material), TextureSlot::ClearcoatNormal, floatImage(texel)), ownTilt);
    material.clearcoatNormalScale = 0.5f;
    const glm::dvec3 half = glm::normalize(tilted * glm::dvec3(0.5, 0.5, 1.0));
    expectColor(texturedScene(underTheSun(material), TextureSlot::ClearcoatNormal, floatImage(texel)),
                textbook::reflected(material, half, kToSun, {0, 0, 1}));
}

/// Each vector map is rotated by its own transform, whichever map the tangents follow.
TEST_F(LobeValues, aTransformOfOneMapDoesNotRotateAnother) {
    const scenes::TextureTransform mirrored{{}, {1, -1}, 0.0f}, quarter{{}, {1, 1}, glm::radians(90.0f)};
    const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
    const glm::vec4 texel(glm::vec3(tilted * 0.5 + 0.5), 1.0f);
    Scene coated = texturedScene(underTheSun(lacquer()), TextureSlot::ClearcoatNormal, floatImage(texel));
    coated.materials[0].texture(TextureSlot::Normal) = coated.materials[0].texture(TextureSlot::ClearcoatNormal);
    const auto expectTilt = [&](const glm::dvec3& normal) {
        expectColor(coated, textbook::reflected(lacquer(), normal, kToSun, {0, 0, 1}));
    };
    expectTilt(tilted);
    coated.materials[0].texture(TextureSlot::Normal).transform = mirrored;
    expectTilt(tilted);
    coated.materials[0].texture(TextureSlot::ClearcoatNormal).transform = mirrored;
    expectTilt({tilted.x, -tilted.y, tilted.z});
    coated.materials[0].texture(TextureSlot::ClearcoatNormal).transform = quarter; // u along -y, -v along x
    expectTilt({tilted.y, -tilted.x, tilted.z});

    const Material steel = brushedSteel();
    Scene brushed = texturedScene(underTheSun(steel), TextureSlot::Normal, floatImage({0.5f, 0.5f, 1.0f, 1.0f}));
    const glm::dvec3 plain = textbook::reflected(steel, {0, 0, 1}, kToSun, {0, 0, 1});
    for (const scenes::TextureTransform& transform : {mirrored, quarter}) {
        brushed.materials[0].texture(TextureSlot::Normal).transform = transform;
        expectColor(brushed, plain);
    }
}

TEST_F(LobeValues, theSheenIsMultipliedByRedGreenAndBlueAndItsRoughnessByAlpha) {
    Material material = blackDielectric();
    material.specularFactor = 0.0f;
    material.sheenColor = {0.9f, 0.8f, 0.7f};
    material.sheenPerceptualRoughness = 0.9f;
    expectTexel(material, TextureSlot::SheenColor, kTexel,
                changed(material, [](Material& m) { m.sheenColor *= glm::vec3(kTexel); }));
    expectTexel(material, TextureSlot::SheenRoughness, kTexel,
                changed(material, [](Material& m) { m.sheenPerceptualRoughness *= 0.7f; }));
}

} // namespace
} // namespace tessera
