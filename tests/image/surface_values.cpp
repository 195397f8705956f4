#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/import/Importers.h"
#include "tests/image/FlatTest.h"
#include "tests/image/ImageTest.h"
#include "tests/support/UnderLedger.h"

namespace tessera {
namespace {

using scenes::Material;
using scenes::MaterialModel;
using scenes::NormalMapSpace;
using scenes::Scene;
using scenes::TextureSlot;
using namespace test;

class SurfaceValues : public FlatTest {};

TEST_F(SurfaceValues, alphaMaskKeepsTexelsThatReachTheCutoff) {
    Scene scene = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, image8([](int x, int) {
                                    return std::array<int, 4>{255, 255, 255, 32 * x};
                                }));
    scene.materials[0].alphaMode = scenes::AlphaMode::Mask;
    for (const float cutoff : {0.0f, 0.3f, 0.5f, 1.0f}) {
        scene.materials[0].alphaCutoff = cutoff;
        const engine::RenderedFrame shown = frame(scene);
        for (int x = 0; x < kSide; ++x)
            EXPECT_EQ(pixel(shown, x, 3).a, float(32 * x) / 255.0f >= cutoff ? 1.0f : 0.0f) << x;
    }
}

TEST_F(SurfaceValues, blendingWeighsTheSurfaceByItsOpacity) {
    Scene scene = flatScene(unlit());
    scene.background = {0.2f, 0.4f, 0.8f};
    scene.materials[0].baseColor = {1.0f, 0.5f, 0.25f, 0.25f};
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    const glm::vec3 wanted = 0.25f * glm::vec3(1.0f, 0.5f, 0.25f) + 0.75f * scene.background;
    EXPECT_NEAR(glm::distance(glm::vec3(center(scene)), wanted), 0.0f, 1e-6f);
    scene.materials[0].alphaMode = scenes::AlphaMode::Opaque; // opacity is ignored then
    EXPECT_EQ(glm::vec3(center(scene)), glm::vec3(1.0f, 0.5f, 0.25f));
}

TEST_F(SurfaceValues, aBackFaceIsLitAsAFrontWhenDoubleSidedAndNeverDrawnOtherwise) {
    Material material = lambert();
    Scene scene = flatScene(material);
    scene.lights = {pointLight({0.1, 0.2, 1.0}, 1.0f)};
    const glm::vec4 front = center(scene);
    EXPECT_GT(front.r, 0.1f);
    scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0, 1, 0));
    EXPECT_EQ(center(scene), glm::vec4(0.0f));
    scene.materials[0].doubleSided = true;
    EXPECT_NEAR(center(scene).r, front.r, 1e-6f * front.r);
}

TEST_F(SurfaceValues, coloursAboveOneKeepTheirLightInEveryLayout) {
    for (const MaterialModel model : {MaterialModel::Lambert, MaterialModel::Microfacet}) {
        Material material;
        material.model = model;
        material.baseColor = {3.14f, 1.5f, 0.5f, 1.0f};
        material.specularColor = {2.0f, 4.0f, 1.0f};
        Scene scene = flatScene(material);
        scene.lights = {pointLight({0.1, 0.2, 1.0}, 1.0f)};
        frame::FrameSettings settings = ofSize(kSide, kSide);
        const glm::vec4 exact = center(scene);
        engine::Renderer renderer(context(), scene);
        for (const frame::LayoutInfo& layout : frame::layoutTable()) {
            settings.layout = layout.layout;
            const glm::vec4 found = pixel(renderer.render(engine::Technique::Deferred, settings), kSide / 2, kSide / 2);
            // Quantisation of the other channels: half a percent covers that of slim.
            EXPECT_LE(glm::distance(found, exact), 0.005f * glm::length(exact)) << layout.name << " " << int(model);
        }
    }
}

TEST_F(SurfaceValues, aCoatOnABackFaceIsLitAsOnAFront) {
    Material material; // black below the coat, to isolate it
    material.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
    material.specularFactor = 0.0f;
    material.clearcoat = 1.0f;
    material.clearcoatPerceptualRoughness = 0.6f;
    material.doubleSided = true;
    Scene scene = flatScene(material);
    scene.lights = {pointLight({0.1, 0.2, 1.0}, 1.0f)};
    const glm::vec4 front = center(scene);
    EXPECT_GT(front.r, 1e-3f);
    scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0, 1, 0));
    EXPECT_NEAR(center(scene).r, front.r, 1e-5f * front.r); // the turned normal is off by 6e-8, times the lobe's slope
}

TEST_F(SurfaceValues, aMirroredNodeIsDrawnMirroredWithTheSameLighting) {
    Material material = lambert();
    Scene scene = texturedScene(flatScene(material), TextureSlot::BaseColor, mapImage());
    scene.lights = {pointLight({0.0, 0.2, 1.0}, 1.0f)};
    const engine::RenderedFrame straight = frame(scene);
    scene.nodes[0].parentFromNode = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const engine::RenderedFrame mirrored = frame(scene);
    for (int x = 0; x < kSide; ++x) {
        EXPECT_NEAR(glm::distance(pixel(mirrored, x, 5), pixel(straight, kSide - 1 - x, 5)), 0.0f, 1e-6f) << x;
    }
    EXPECT_GT(pixel(straight, 7, 5).r, 0.1f);
}

/// A normal that leans towards +y, as a texel.
constexpr std::array<int, 4> kLeaning = {128, 192, 238, 255};
constexpr std::array<int, 4> kFlipped = {128, 63, 238, 255};

TEST_F(SurfaceValues, theGreenOfANormalMapPointsUpInBothSpaces) {
    for (const scenes::NormalMapSpace space : {scenes::NormalMapSpace::Tangent, scenes::NormalMapSpace::Object}) {
        SCOPED_TRACE(space == scenes::NormalMapSpace::Tangent ? "tangent" : "object");
        Material material = lambert();
        material.normalMapSpace = space;
        Scene lit = flatScene(material);
        lit.lights = {pointLight({0.0, 2.0, 1.0}, 4.0f)};
        const float flat = center(lit).r;
        const float leaning = center(texturedScene(lit, TextureSlot::Normal, uniformImage(kLeaning))).r;
        const float flipped = center(texturedScene(lit, TextureSlot::Normal, uniformImage(kFlipped))).r;
        EXPECT_GT(leaning, 1.2f * flat); // n.l goes from 0.45 to 0.83, and to 0
        EXPECT_LT(flipped, 0.2f * flat);
    }
}

TEST_F(SurfaceValues, anObjectSpaceMapTurnsWithItsObjectAndATangentSpaceMapWithItsTexture) {
    Material material = lambert();
    Scene scene = texturedScene(flatScene(material), TextureSlot::Normal, uniformImage(kLeaning));
    scene.lights = {pointLight({0.0, 2.0, 1.0}, 4.0f)};
    for (const scenes::NormalMapSpace space : {scenes::NormalMapSpace::Tangent, scenes::NormalMapSpace::Object}) {
        scene.materials[0].normalMapSpace = space;
        scene.nodes[0].parentFromNode = glm::dmat4(1.0);
        const float upright = center(scene).r;
        scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0, 0, 1));
        EXPECT_LT(center(scene).r, 0.5f * upright); // upside down: leans away from the light
    }
    // A texture turned upside down on the same quad: only its content rotates.
    scene.nodes[0].parentFromNode = glm::dmat4(1.0);
    scene.materials[0].normalMapSpace = scenes::NormalMapSpace::Object;
    const float objectSpace = center(scene).r;
    for (glm::vec2& uv : scene.meshes[0].texCoords[0]) uv = 1.0f - uv;
    EXPECT_EQ(center(scene).r, objectSpace);
    scene.materials[0].normalMapSpace = scenes::NormalMapSpace::Tangent;
    EXPECT_LT(center(scene).r, 0.5f * objectSpace);
}

/// A normal that leans to the right and, more, upwards.
constexpr std::array<int, 4> kTiltedTexel = {176, 208, 216, 255};

TEST_F(SurfaceValues, aTangentSpaceMapTiltsAlongItsTextureWhereverTheMirroringIs) {
    Material material = lambert();
    const glm::dvec3 lightWS(0.8, 1.1, 1.0);
    for (const bool mirroredTexture : {false, true}) {
        // Tangent space has x along u and y along -v, which is up in all four of these.
        glm::dvec3 normalWS =
            glm::normalize(glm::dvec3(kTiltedTexel[0], kTiltedTexel[1], kTiltedTexel[2]) * 2.0 / 255.0 - 1.0);
        if (mirroredTexture) normalWS.x = -normalWS.x;
        for (const bool mirroredNode : {false, true})
            for (const bool authored : {false, true}) {
                SCOPED_TRACE(testing::Message() << "texture " << mirroredTexture << ", node " << mirroredNode
                                                << ", authored tangents " << authored);
                Scene scene = texturedScene(flatScene(material), TextureSlot::Normal, uniformImage(kTiltedTexel));
                scene.lights = {pointLight(lightWS, 2.0f)};
                scene.cameras[0].farMetres = 4.0; // an orthographic depth has steps of its range / 2^24
                scenes::Mesh& mesh = scene.meshes[0];
                if (mirroredTexture) {
                    for (glm::vec2& uv : mesh.texCoords[0]) uv.x = 1.0f - uv.x;
                }
                if (mirroredNode) { // the geometry in world space stays the same
                    scene.nodes[0].parentFromNode = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
                    for (glm::vec3& positionOS : mesh.positionsOS) positionOS.x = -positionOS.x;
                    std::ranges::reverse(mesh.indices);
                }
                const float along = mirroredTexture != mirroredNode ? -1.0f : 1.0f; // u, on the object's x axis
                if (authored) mesh.tangentsOS.assign(4, {along, 0.0f, 0.0f, along});
                const engine::RenderedFrame shown = frame(scene);
                for (int y = 0; y < kSide; ++y)
                    for (int x = 0; x < kSide; ++x) {
                        const glm::dvec3 positionWS(2.0 * (x + 0.5) / kSide - 1.0, 1.0 - 2.0 * (y + 0.5) / kSide, 0.0);
                        const glm::dvec3 toLight = lightWS - positionWS;
                        const double distance = glm::length(toLight);
                        const double cosine = std::max(0.0, glm::dot(normalWS, toLight) / distance);
                        // Roundings of position, normal and falloff, ten of 2^-24 on values below 2.
                        EXPECT_NEAR(pixel(shown, x, y).r, 2.0 * cosine / (distance * distance), 2e-6) << x << "," << y;
                    }
            }
    }
}

/// KHR_texture_transform, with the resulting directions of u and -v, found by hand: coordinates that turn
/// counter-clockwise turn the image clockwise.
TEST_F(SurfaceValues, aTransformOfANormalMapTurnsAndMirrorsItsNormals) {
    struct Case {
        glm::vec2 scale;
        float degrees;
        glm::dvec3 alongU, againstV;
    };
    const glm::dvec3 right(1, 0, 0), up(0, 1, 0);
    Material material = lambert();
    const glm::dvec3 sunWS = glm::normalize(glm::dvec3(0.5, 0.8, 1.0));
    for (const Case& each :
         {Case{{1, 1}, 0.0f, right, up}, Case{{1, -1}, 0.0f, right, -up}, Case{{-1, 1}, 0.0f, -right, up},
          Case{{1, 1}, 90.0f, -up, right}, Case{{1, -1}, 90.0f, up, right}, Case{{-3, -3}, 90.0f, up, -right}}) {
        for (const bool authored : {false, true}) {
            SCOPED_TRACE(testing::Message()
                         << each.scale.x << ' ' << each.scale.y << ' ' << each.degrees << ' ' << authored);
            Scene scene = texturedScene(flatScene(material), TextureSlot::Normal, uniformImage(kTiltedTexel));
            scene.materials[0].texture(TextureSlot::Normal).transform = {{}, each.scale, glm::radians(each.degrees)};
            if (authored) scene.meshes[0].tangentsOS.assign(4, {1.0f, 0.0f, 0.0f, 1.0f});
            scenes::Light sun;
            sun.type = scenes::LightType::Directional;
            sun.directionWS = -sunWS;
            scene.lights = {sun};
            const glm::dvec3 texel = glm::dvec3(kTiltedTexel[0], kTiltedTexel[1], kTiltedTexel[2]) * 2.0 / 255.0 - 1.0;
            const glm::dvec3 normalWS =
                glm::normalize(texel.x * each.alongU + texel.y * each.againstV + texel.z * glm::dvec3(0, 0, 1));
            EXPECT_NEAR(center(scene).r, std::max(0.0, glm::dot(normalWS, sunWS)), 2e-6); // fp32, also for 90 degrees
        }
    }
}

TEST_F(SurfaceValues, aNormalScaleOfZeroIsTheFlatSurface) {
    Material material = lambert();
    Scene scene = flatScene(material);
    scene.lights = {pointLight({0.0, 2.0, 1.0}, 4.0f)};
    const glm::vec4 flat = center(scene);
    Scene mapped = texturedScene(scene, TextureSlot::Normal, uniformImage(kLeaning));
    mapped.materials[0].normalScale = 0.0f;
    EXPECT_NEAR(center(mapped).r, flat.r, 1e-6f * flat.r);
}

TEST_F(SurfaceValues, emissionIsAddedToReflectedLight) {
    Material material;
    material.metallic = 0.0f;
    Scene scene = flatScene(material);
    scene.lights = {pointLight({0.1, 0.2, 1.0}, 1.0f)};
    const glm::vec4 lit = center(scene);
    scene.materials[0].emissive = {0.5f, 2.0f, 0.0f};
    EXPECT_NEAR(glm::distance(center(scene) - lit, glm::vec4(0.5f, 2.0f, 0.0f, 0.0f)), 0.0f, 1e-6f);
    scene.lights.clear();
    EXPECT_EQ(glm::vec3(center(scene)), scene.materials[0].emissive);
}

/// The scanned head below TESSERA_ASSETS, whose normals were baked twice: in object space and in tangent space.
class ScanNormals : public ImageTest {
protected:
    void SetUp() override {
        const char* assets = std::getenv("TESSERA_ASSETS");
        if (assets == nullptr || *assets == '\0') GTEST_SKIP() << "TESSERA_ASSETS is not set";
        folder_ = std::filesystem::path(assets) / "LeePerrySmith";
        if (!std::filesystem::exists(folder_ / "LeePerrySmith.gltf")) GTEST_SKIP() << folder_ << " is not there";
    }

    /// Shading normals, viewed from the front.
    std::vector<float> normals(NormalMapSpace space, bool flipsGreen) {
        scenes::Scene scene = scenes::loadScene((folder_ / "LeePerrySmith.gltf").string());
        scenes::Material& skin = scene.materials[0];
        skin.normalMapSpace = space;
        scenes::Image& map = scene.images[std::size_t(skin.texture(scenes::TextureSlot::Normal).image)];
        if (space == NormalMapSpace::Object) map = underLedger(scenes::readImage, folder_ / "normal_object_2k.jpg");
        if (flipsGreen) {
            for (std::size_t i = 1; i < map.texels.size(); i += 4) map.texels[i] ^= std::byte(255);
        }
        scene.cameras[0].worldFromCamera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.1, 20.0));
        scene.cameras[0].fovYRadians = glm::radians(30.0);
        frame::FrameSettings settings = withView(ofSize(400, 400), frame::DebugView::Normal);
        return drawn(scene, settings);
    }
    static double medianDegrees(const std::vector<float>& a, const std::vector<float>& b) {
        std::vector<double> angles;
        for (std::size_t i = 0; i < a.size(); i += 4) {
            if (a[i + 3] == 0.0f) continue;
            const glm::dvec3 n(a[i], a[i + 1], a[i + 2]), m(b[i], b[i + 1], b[i + 2]);
            angles.push_back(std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m)) * 180.0 / std::numbers::pi);
        }
        EXPECT_GT(angles.size(), 10000u);
        std::nth_element(angles.begin(), angles.begin() + std::ptrdiff_t(angles.size() / 2), angles.end());
        return angles[angles.size() / 2];
    }
    std::filesystem::path folder_;
};

TEST_F(ScanNormals, bothBakesOfOneScanGiveNearlyTheSameNormalsUnlessAGreenIsFlipped) {
    const std::vector<float> object = normals(NormalMapSpace::Object, false);
    const std::vector<float> tangent = normals(NormalMapSpace::Tangent, false);
    const double agreed = medianDegrees(object, tangent);
    const double objectFlipped = medianDegrees(normals(NormalMapSpace::Object, true), tangent);
    const double tangentFlipped = medianDegrees(object, normals(NormalMapSpace::Tangent, true));
    fmt::print("median angle {:.2f} degrees; green of the object-space map flipped {:.2f}, of the tangent-space map "
               "{:.2f}\n",
               agreed, objectFlipped, tangentFlipped);
    // Measured 1.43, 3.23 with a flipped green in tangent space, which tilts normals little, and 48.6 in object space.
    // The required limit of 4 would miss the former.
    EXPECT_LE(agreed, 2.0);
    EXPECT_GT(tangentFlipped, 2.5);
    EXPECT_GT(objectFlipped, 2.5);
}

} // namespace
} // namespace tessera
