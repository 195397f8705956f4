#include "renderer/frame/ShadowMaps.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/ShadowCameras.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "tests/support/TestScenes.h"

namespace tessera::frame {
namespace {

scenes::Scene latticeOf(int lights) {
    scenes::LoadOptions options;
    options.lights = lights;
    return scenes::loadScene("lattice", options);
}

/// The lattice with a sun as its only light.
scenes::Scene latticeUnderSun() {
    scenes::Scene scene = latticeOf(1);
    scene.lights[0].type = scenes::LightType::Directional;
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(-0.4, -1.0, 0.3));
    return scene;
}

struct MapsTest : testing::Test {
    FrameSettings settings;
    ShadowMaps mapsOf(const scenes::Scene& scene) {
        settings.shadows = {scenes::ShadowRequest::Kind::All};
        settings.shadowFilter = ShadowFilter::Hard;
        const std::vector<SurfaceBounds> bounds = surfaceBounds(scene);
        view = makeCameraView(scene.cameras[0], settings.sizePixels, settings.space, glm::vec3(0.0f), bounds);
        lights = packLights(scene, view, settings);
        return makeShadowMaps(scene, lights, view, settings, bounds);
    }
    /// Same, with a budget in MiB.
    ShadowMaps mapsWithin(double mebibytes, const scenes::Scene& scene) {
        settings.shadowMaps.budgetMiB = mebibytes;
        return mapsOf(scene);
    }
    CameraView view;
    PackedLights lights;
};

std::size_t bytesOf(const ShadowMaps& maps) {
    return graph::descBytes(maps.atlas());
}

void expectApart(const ShadowMaps& maps) {
    std::vector<char> taken(std::size_t(maps.atlasTexels.x / kLeastFaceTexels) *
                            std::size_t(maps.atlasTexels.y / kLeastFaceTexels));
    for (const ShadowFace& face : maps.faces) {
        ASSERT_GE(std::min(face.cornerTexels.x, face.cornerTexels.y), 0);
        ASSERT_LE(face.cornerTexels.x + face.sideTexels, maps.atlasTexels.x);
        ASSERT_LE(face.cornerTexels.y + face.sideTexels, maps.atlasTexels.y);
        for (int y = face.cornerTexels.y; y < face.cornerTexels.y + face.sideTexels; y += kLeastFaceTexels)
            for (int x = face.cornerTexels.x; x < face.cornerTexels.x + face.sideTexels; x += kLeastFaceTexels) {
                char& place = taken[std::size_t(y / kLeastFaceTexels * (maps.atlasTexels.x / kLeastFaceTexels) +
                                                x / kLeastFaceTexels)];
                ASSERT_FALSE(place) << "two faces at " << x << ", " << y;
                place = 1;
            }
    }
}

TEST_F(MapsTest, facesNeverOverlapAndNeverExceedTheBudget) {
    for (const int count : {1, 7, 64, 256, 1000}) {
        const scenes::Scene scene = latticeOf(count);
        for (const double mebibytes : {0.001, 0.1, 1.0, 4.0, 16.0, 64.0, 300.0}) {
            const ShadowMaps maps = mapsWithin(mebibytes, scene);
            SCOPED_TRACE(testing::Message() << count << " lights in " << mebibytes << " MiB");
            EXPECT_LE(double(bytesOf(maps)), mebibytes * 1048576.0);
            expectApart(maps);
            std::size_t faces = 0;
            for (const ShadowedLight& light : maps.lights) faces += light.sideTexels > 0 ? std::size_t(light.faces) : 0;
            EXPECT_EQ(maps.faces.size(), faces);
        }
    }
}

/// A tap reads half of its square and a texel beside it; wider borders waste texels.
TEST_F(MapsTest, bordersAreAsWideAsTheirTapsAndATexel) {
    for (const ShadowFilter filter : {ShadowFilter::Hard, ShadowFilter::Pcf})
        for (const int widthTexels : kShadowWidths) {
            settings.shadowFilter = filter;
            settings.shadowMaps.widthTexels = widthTexels;
            const int reachTexels = filter == ShadowFilter::Hard ? 0 : (widthTexels - 1) / 2 + 1;
            EXPECT_EQ(shadowTapTexels(settings), reachTexels + 1) << widthTexels;
        }
}
TEST_F(MapsTest, aSmallerBudgetLeavesNearerLightsMoreTexelsAndDropsNone) {
    const scenes::Scene scene = latticeOf(256);
    const ShadowMaps all = mapsWithin(1024.0, scene);
    const auto distanceOf = [&](const ShadowedLight& light) {
        const std::size_t index = std::size_t(lights.sceneIndex[light.light]);
        return glm::distance(scene.lights[index].positionWS, view.eyeWS);
    };
    for (const double mebibytes : {64.0, 16.0, 4.0}) {
        const ShadowMaps maps = mapsWithin(mebibytes, scene);
        EXPECT_EQ(maps.unmapped(), 0u) << mebibytes;
        for (std::size_t i = 0; i < maps.lights.size(); ++i) {
            EXPECT_EQ(maps.lights[i].wantedTexels, all.lights[i].wantedTexels);
            // All lights have the same range. Equally important lights may differ by one halving.
            for (std::size_t k = 0; k < maps.lights.size(); ++k)
                if (distanceOf(maps.lights[i]) < distanceOf(maps.lights[k])) {
                    EXPECT_GE(2 * maps.lights[i].sideTexels, maps.lights[k].sideTexels) << mebibytes;
                }
        }
        EXPECT_GT(2 * bytesOf(maps), std::size_t(mebibytes * 1048576.0)) << "half of the budget is left";
    }
}

TEST_F(MapsTest, aSunThatReachesThePictureKeepsNoFewerTexelsThanLampsThatReachPartsOfIt) {
    const scenes::Scene scene = scenes::loadScene("hall");
    for (const double mebibytes : {64.0, 16.0, 4.0}) {
        const ShadowMaps maps = mapsWithin(mebibytes, scene);
        int ofSun = 0, mostOfLamps = 0;
        for (const ShadowedLight& light : maps.lights) {
            const bool isSun =
                scene.lights[std::size_t(lights.sceneIndex[light.light])].type == scenes::LightType::Directional;
            (isSun ? ofSun : mostOfLamps) = std::max(isSun ? ofSun : mostOfLamps, light.sideTexels);
        }
        EXPECT_GE(ofSun, mostOfLamps) << mebibytes;
        EXPECT_GT(mostOfLamps, 0);
    }
}

TEST_F(MapsTest, aFarLampThatReachesTheSceneKeepsNoFewerTexelsThanOnesThatReachPartsOfIt) {
    scenes::Scene scene = latticeOf(16);
    scenes::Light far = test::pointLight({0.0, 1000.0, 0.0}, 1e6f);
    far.rangeMetres = 2000.0f;
    scene.lights.push_back(far);
    for (const double mebibytes : {16.0, 4.0}) {
        const ShadowMaps maps = mapsWithin(mebibytes, scene);
        int ofFar = 0, mostOfOthers = 0;
        for (const ShadowedLight& light : maps.lights)
            (lights.sceneIndex[light.light] == 16 ? ofFar : mostOfOthers) = light.sideTexels;
        EXPECT_GE(ofFar, mostOfOthers) << mebibytes;
        EXPECT_GT(ofFar, 0);
    }
}

TEST_F(MapsTest, atlasesBeyondWhatAnIntHoldsAreReducedToo) {
    scenes::Scene scene = latticeOf(1);
    scene.lights.assign(200000, test::pointLight({}, 5.0f));
    settings.shadowMaps.resolutionTexels = 8192;
    const ShadowMaps maps = mapsWithin(64.0, scene);
    EXPECT_LE(double(bytesOf(maps)), 64.0 * 1048576.0);
    std::size_t texels = 0;
    for (const ShadowFace& face : maps.faces) texels += std::size_t(face.sideTexels) * std::size_t(face.sideTexels);
    EXPECT_LE(4 * texels, bytesOf(maps));
}

TEST_F(MapsTest, aLightWithoutRoomHasNoFaceAndIsCounted) {
    const scenes::Scene scene = latticeOf(64);
    const ShadowMaps maps = mapsWithin(0.01, scene);
    EXPECT_GT(maps.unmapped(), 0u);
    EXPECT_LT(maps.unmapped(), maps.lights.size());
    const std::size_t firstTexel = lightBytes(lights.features, lights.texels.size()) / sizeof(glm::vec4);
    packFaces(maps, view, firstTexel, surfaceBounds(scene), lights);
    for (const ShadowedLight& light : maps.lights) {
        EXPECT_EQ(lights.shadows[light.light].shadow.z == 0.0f, light.sideTexels == 0);
        // Shaders skip the shadow lookup of lights without a map.
        EXPECT_EQ((int(lights.texels[light.light].color.w) & LIGHT_SHADOWED) == 0, light.sideTexels == 0);
    }
}

TEST_F(MapsTest, aLampFarFromTheSceneHasAMapOfNoUse) {
    scenes::Scene scene = latticeOf(1);
    for (const double metres : {1e2, 1e9}) {
        scene.lights = {test::pointLight({0.0, 0.0, metres}, 5.0f)};
        const ShadowMaps maps = mapsOf(scene);
        ASSERT_EQ(maps.lights.size(), 1u);
        EXPECT_GT(maps.lights[0].sideTexels, 0);
        EXPECT_EQ(maps.useless(), metres > 1e8 ? 1u : 0u) << "fp32 rounds its distances by 64 m";
    }
}

TEST_F(MapsTest, everyDirectionFromAPointLightFallsIntoTheFaceThatShadersChoose) {
    scenes::Scene scene = latticeOf(1);
    scene.lights = {test::pointLight({0.3, 0.2, -0.1}, 5.0f)};
    const ShadowMaps maps = mapsOf(scene);
    ASSERT_EQ(maps.faces.size(), 6u);
    for (int i = 0; i < 200; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / 200.0, turn = 2.399963229728653 * i, across = std::sqrt(1.0 - z * z);
        const glm::dvec3 direction(across * std::cos(turn), across * std::sin(turn), z), size = glm::abs(direction);
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t face = std::size_t(2 * axis + (direction[axis] < 0.0 ? 1 : 0));
        const CameraView camera = faceView(maps.faces[face]);
        const glm::dvec4 clip =
            camera.clipFromLS * glm::dvec4(camera.positionLS(scene.lights[0].positionWS + direction), 1.0);
        EXPECT_GT(clip.w, 0.0);
        EXPECT_LT(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w) << "face " << face;
    }
}

TEST_F(MapsTest, aRecordFindsTheTexelAndDepthThatTheFacesCameraDraws) {
    scenes::Scene scene = latticeOf(3);
    scene.lights.resize(3);
    scene.lights[0] = test::pointLight({0.3, 0.2, -0.1}, 5.0f);
    scene.lights[1] = test::pointLight({0.0, 3.0, 0.5}, 5.0f);
    scene.lights[1].type = scenes::LightType::Spot;
    scene.lights[1].directionWS = glm::normalize(glm::dvec3(0.2, -1.0, 0.1));
    scene.lights[1].outerConeRadians = 0.6f;
    scene.lights[2].type = scenes::LightType::Directional;
    scene.lights[2].directionWS = glm::normalize(glm::dvec3(-0.4, -1.0, 0.3));
    const ShadowMaps maps = mapsOf(scene);
    ASSERT_EQ(maps.faces.size(), 6u + 1u + 4u);
    const std::vector<shared::ShadowFaceTexels> records = packFaces(maps, view, 100, surfaceBounds(scene), lights);
    for (std::size_t i = 0; i < maps.faces.size(); ++i) {
        const ShadowFace& face = maps.faces[i];
        const CameraView camera = faceView(face);
        const glm::dmat4& worldFromFace = face.camera.worldFromCamera;
        const glm::dvec3 pointWS(worldFromFace * glm::dvec4(0.2, -0.35, -1.5, 1.0));
        const glm::dvec4 clip = camera.clipFromLS * glm::dvec4(camera.positionLS(pointWS), 1.0);
        const glm::dvec2 texel =
            glm::dvec2(face.cornerTexels) + (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * double(face.sideTexels);
        const glm::vec4 positionRWS(glm::vec3(pointWS - view.originWS), 1.0f);
        const shared::ShadowFaceTexels& record = records[i];
        const float ahead = glm::dot(record.forward, positionRWS);
        const bool isParallel = record.place.w < 0.0f;
        const glm::vec2 across(glm::dot(record.right, positionRWS), glm::dot(record.up, positionRWS));
        const glm::vec2 found = glm::vec2(record.place) + record.place.z * (isParallel ? across : across / ahead);
        EXPECT_NEAR(found.x, texel.x, 0.01) << i;
        EXPECT_NEAR(found.y, texel.y, 0.01) << i;
        const double depth = isParallel ? 1.0 + double(record.place.w) * double(ahead) : double(record.place.w / ahead);
        EXPECT_NEAR(depth, clip.z / clip.w, 1e-5 * depth) << i;
    }
}

TEST_F(MapsTest, cascadesMoveByWholeTexelsAndKeepTheirSizeAsTheCameraMoves) {
    scenes::Scene scene = latticeUnderSun();
    const ShadowMaps first = mapsOf(scene);
    ASSERT_EQ(first.faces.size(), 4u);
    const glm::dmat4 before = scene.cameras[0].worldFromCamera;
    int moved = 0;
    for (int i = 1; i <= 64; ++i) {
        scene.cameras[0].worldFromCamera[3] = before[3] + glm::dvec4(0.0021 * i, 0.0007 * i, -0.0013 * i, 0.0);
        const ShadowMaps maps = mapsOf(scene);
        for (std::size_t cascade = 0; cascade < maps.faces.size(); ++cascade) {
            const scenes::Camera &a = first.faces[cascade].camera, &b = maps.faces[cascade].camera;
            ASSERT_EQ(a.halfHeightMetres, b.halfHeightMetres);
            const double texelMetres = 2.0 * a.halfHeightMetres / maps.faces[cascade].sideTexels;
            const glm::dvec3 offset(b.worldFromCamera[3] - a.worldFromCamera[3]);
            for (int axis = 0; axis < 2; ++axis) {
                const double texels = glm::dot(offset, glm::dvec3(a.worldFromCamera[axis])) / texelMetres;
                EXPECT_NEAR(texels, std::round(texels), 1e-6);
                moved += std::abs(texels) > 0.5;
            }
            EXPECT_NEAR(glm::dot(offset, glm::dvec3(a.worldFromCamera[2])), 0.0, 1e-9);
        }
    }
    EXPECT_GT(moved, 0) << "the camera did not move a cascade";
}

TEST_F(MapsTest, everyCascadeHoldsTheDepthsOfAllCasters) {
    const scenes::Scene scene = latticeUnderSun();
    const ShadowMaps maps = mapsOf(scene);
    ASSERT_EQ(maps.faces.size(), 4u);
    for (const ShadowFace& face : maps.faces) {
        const CameraView camera = faceView(face);
        for (const SurfaceBounds& bounds : surfaceBounds(scene))
            for (const glm::dvec3& cornerWS : {bounds.boxWS.min, bounds.boxWS.max}) {
                const double depth = (camera.clipFromLS * glm::dvec4(camera.positionLS(cornerWS), 1.0)).z;
                EXPECT_GT(depth, 0.0); // 0 stands for no caster
                EXPECT_LT(depth, 1.0);
            }
    }
}

TEST_F(MapsTest, cascadesHoldAllThatIsSeen) {
    scenes::Scene scene = scenes::loadScene("hall");
    for (scenes::Light& light : scene.lights) light.enabled = light.name == "evening sun";
    settings.shadowMaps.cascades = 3;
    const ShadowMaps maps = mapsOf(scene);
    ASSERT_EQ(maps.faces.size(), 3u);
    const CameraView last = faceView(maps.faces.back());
    for (const SurfaceBounds& bounds : surfaceBounds(scene)) {
        const glm::dvec3 middle = 0.5 * (bounds.boxWS.min + bounds.boxWS.max);
        const glm::dvec4 seen = view.clipFromLS * glm::dvec4(view.positionLS(middle), 1.0);
        if (!(seen.w > 0.0) || std::max(std::abs(seen.x), std::abs(seen.y)) > seen.w) continue;
        const glm::dvec4 clip = last.clipFromLS * glm::dvec4(last.positionLS(middle), 1.0);
        EXPECT_LT(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w);
    }
}

// A cascade's centre snaps to whole texels, up to a texel beside the ball's centre. Filter taps at any point of the
// ball must still lie inside. A radius of 1 m is one of the quantised cascade sizes, which adds no other margin.
TEST_F(MapsTest, aCascadeHoldsItsBallAndTheTapsAroundItWhereverTheBallLies) {
    const scenes::Scene scene = latticeOf(1);
    const CameraView far =
        makeCameraView(scene.cameras[0], settings.sizePixels, settings.space, glm::vec3(0.0f), surfaceBounds(scene));
    const glm::dvec3 aheadWS = far.eyeWS + 20.0 * (glm::transpose(far.lsFromWorld) * far.forwardLS);
    constexpr int kFaceTexels = 128, kBorderTexels = 3;
    double least = kFaceTexels;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 directionWS = glm::normalize(glm::dvec3(std::sin(1.7 * i), -1.0, std::cos(2.3 * i)));
        const Ball ball{aheadWS + glm::dvec3(0.37 * std::sin(5.1 * i), 0.31 * std::cos(3.7 * i), 0.0), 1.0};
        const scenes::Camera camera =
            cascadeCameras(directionWS, 1, ball, far, settings.sizePixels, 0.1, kFaceTexels, kBorderTexels)[0];
        const double texelMetres = 2.0 * camera.halfHeightMetres / kFaceTexels;
        const glm::dvec3 asideWS = ball.centreWS - glm::dvec3(camera.worldFromCamera[3]);
        for (const int axis : {0, 1}) {
            const double farthest = std::abs(glm::dot(asideWS, glm::dvec3(camera.worldFromCamera[axis]))) + 1.0;
            least = std::min(least, (camera.halfHeightMetres - farthest) / texelMetres);
        }
    }
    EXPECT_GE(least, kBorderTexels - 1e-6);
    EXPECT_LT(least, kBorderTexels + 0.1) << "no ball lay a texel aside";
}

} // namespace
} // namespace tessera::frame
