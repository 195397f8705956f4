// Debug views of shadow maps: the face that a pixel reads, and the atlas itself. And the settings that change shadows.
#include <array>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/Settings.h"
#include "renderer/frame/ShadowCameras.h"
#include "renderer/frame/ShadowMaps.h"
#include "shaders/shared/face_colors.h"
#include "tests/image/ShadowTest.h"
#include "validation/reference/CameraRays.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::DebugView;
using frame::ShadowFilter;
using namespace test;

/// The face of a pixel's colour in the view `cascades`, however dark; none where it is grey.
std::optional<int> faceOf(const glm::vec3& shown) {
    const glm::vec3 direction = glm::normalize(shown);
    float most = glm::dot(direction, glm::normalize(shared::noFaceColor()));
    std::optional<int> face;
    for (int i = 0; i < 6; ++i) {
        const float likeness = glm::dot(direction, glm::normalize(shared::faceColor(i)));
        if (likeness > most) face = i;
        most = std::max(most, likeness);
    }
    return face;
}

class ShadowViews : public ShadowTest {
protected:
    ShadowViews() {
        settings.sizePixels = {161, 91};
        settings.shadows = kAllLightsCast;
        settings.shadowFilter = ShadowFilter::Pcf;
        settings.shadowMaps.resolutionTexels = 256;
    }
    /// Point lights and, as the last light, a sun.
    static scenes::Scene pointsAndSun() {
        scenes::Scene scene = latticeOf(3);
        scenes::Light sun = scene.lights[0];
        sun.type = scenes::LightType::Directional;
        sun.directionWS = glm::normalize(glm::dvec3(-0.5, -1.0, -0.3));
        sun.intensity = 1.0f;
        scene.lights.push_back(sun);
        return scene;
    }
    /// A ball around the eye and a lamp.
    static scenes::Scene aroundALamp() {
        scenes::Scene scene = ballUnderSun();
        scene.meshes.resize(1);
        scene.meshes[0] = {};
        scenes::builtin::appendSphere(scene.meshes[0], glm::dvec3(0.0), 5.0, 64, 32);
        scene.nodes[0].instances = {{0, 0}};
        for (scenes::Material& material : scene.materials) material.doubleSided = true;
        scene.lights = {pointLight({}, 10.0f)};
        return scene;
    }
    std::vector<float> shown(engine::Renderer& renderer, DebugView view, Technique technique = Technique::Deferred) {
        settings.view = view;
        return renderer.render(technique, settings).radiance;
    }
    glm::vec4 pixel(const std::vector<float>& rgba, int x, int y) const {
        const float* p = &rgba[std::size_t(4 * (y * settings.sizePixels.x + x))];
        return {p[0], p[1], p[2], p[3]};
    }
    frame::FrameSettings settings;
};

TEST_F(ShadowViews, areTheSameInEveryTechniqueToTheLastBit) {
    const scenes::Scene scene = pointsAndSun();
    engine::Renderer renderer(context(), scene);
    for (const DebugView view : {DebugView::Cascades, DebugView::ShadowAtlas})
        for (const int light : {0, int(scene.lights.size()) - 1}) {
            settings.soloLight = light;
            const std::vector<float> truth = shown(renderer, view, Technique::Forward);
            for (const engine::TechniqueInfo& info : engine::techniqueTable())
                EXPECT_TRUE(shown(renderer, view, info.technique) == truth)
                    << frame::debugViewInfo(view).name << " of light " << light << " with " << info.name;
        }
}

TEST_F(ShadowViews, areTheSameWhateverElseIsLeftOut) {
    const scenes::Scene scene = latticeOf(64);
    engine::Renderer renderer(context(), scene);
    settings.shadows = {scenes::ShadowRequest::Kind::First, 16};
    settings.shadowFilter = ShadowFilter::Hard;
    settings.soloLight = 0; // its range covers part of the view
    for (const DebugView view : {DebugView::Shadow, DebugView::Cascades, DebugView::ShadowAtlas}) {
        SCOPED_TRACE(int(view));
        settings.view = view;
        expectPruningIsUnseen(renderer, settings);
    }
}

TEST_F(ShadowViews, areOfTheFirstLightThatCastsShadows) {
    scenes::Scene scene = pointsAndSun();
    const int sun = int(scene.lights.size()) - 1;
    scene.lights.back().castsShadow = true;
    settings.shadows = {scenes::ShadowRequest::Kind::Scene};
    engine::Renderer renderer(context(), scene);
    for (const DebugView view : {DebugView::Cascades, DebugView::Shadow}) {
        settings.soloLight.reset();
        const std::vector<float> first = shown(renderer, view);
        ASSERT_TRUE(renderer.shadows().shown);
        EXPECT_EQ(renderer.shadows().lights[*renderer.shadows().shown].sceneIndex, sun);
        settings.soloLight = sun;
        EXPECT_TRUE(first == shown(renderer, view)) << frame::debugViewInfo(view).name;
        settings.soloLight = 0;
        EXPECT_FALSE(first == shown(renderer, view)) << frame::debugViewInfo(view).name;
    }
}

TEST_F(ShadowViews, theFartherACascadeTheFartherItsPixelsAndTheLastHoldsTheFarthest) {
    const scenes::Scene scene = pointsAndSun();
    engine::Renderer renderer(context(), scene);
    settings.soloLight = int(scene.lights.size()) - 1;
    const std::vector<float> depths = shown(renderer, DebugView::Depth);
    for (const std::size_t cascades : {4, 3, 2, 1}) {
        SCOPED_TRACE(cascades);
        settings.shadowMaps.cascades = int(cascades);
        const std::vector<float> colors = shown(renderer, DebugView::Cascades);
        std::array<double, 6> sums{}, counts{};
        float most = 0.0f;
        std::optional<int> ofFarthest;
        for (std::size_t i = 0; i < depths.size(); i += 4) {
            if (depths[i + 3] == 0.0f) continue;
            const std::optional<int> face = faceOf({colors[i], colors[i + 1], colors[i + 2]});
            ASSERT_TRUE(face) << "pixel " << i / 4;
            sums[std::size_t(*face)] += double(depths[i]);
            counts[std::size_t(*face)] += 1.0;
            if (depths[i] > most) ofFarthest = face;
            most = std::max(most, depths[i]);
        }
        EXPECT_EQ(ofFarthest, int(cascades) - 1);
        double before = 0.0;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            EXPECT_EQ(counts[i] > 0.0, i < cascades) << i;
            if (counts[i] == 0.0) continue;
            EXPECT_GT(sums[i] / counts[i], before) << i;
            before = sums[i] / counts[i];
        }
    }
}

// A pixel reads the finest cascade that contains all taps of its filter.
TEST_F(ShadowViews, aCascadePassesOverIntoTheNextInItsOuterTenthWithinTheRoomOfTaps) {
    scenes::Scene scene = ballUnderSun();
    scene.nodes[0].instances = {{1, 0}};
    scene.nodes[0].parentFromNode = glm::scale(glm::dmat4(1.0), glm::dvec3(10.0));
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
    engine::Renderer renderer(context(), scene);
    const std::vector<frame::SurfaceBounds> bounds = frame::surfaceBounds(scene);
    for (const ShadowFilter filter : mapFilters()) {
        SCOPED_TRACE(infoOf(filter).name);
        settings.shadowFilter = filter;
        settings.shadowMaps.widthTexels = 7;
        const std::vector<float> colors = shown(renderer, DebugView::Cascades);
        const frame::CameraView view =
            frame::makeCameraView(scene.cameras[0], settings.sizePixels, settings.space, glm::vec3(0.0f), bounds);
        const frame::ShadowMaps maps =
            frame::makeShadowMaps(scene, frame::packLights(scene, view, settings), view, settings, bounds);
        ASSERT_EQ(maps.faces.size(), 4u);
        const bool passesAtOnce = filter == ShadowFilter::Hard;
        const reference::CameraRays rays(scene.cameras[0], settings.sizePixels);
        std::size_t wrong = 0, mixed = 0, checked = 0;
        for (int y = 0; y < settings.sizePixels.y; ++y)
            for (int x = 0; x < settings.sizePixels.x; ++x) {
                const reference::Ray ray = rays.through(x, y);
                const double metres = -(rays.eyeWS().y + ray.originRWS.y) / ray.direction.y;
                const glm::dvec3 groundWS = rays.eyeWS() + ray.at(metres);
                if (!(metres > 0.0) || std::max(std::abs(groundWS.x), std::abs(groundWS.z)) > 19.0) continue;
                glm::dvec3 expected(0.0);
                double left = 1.0;
                for (int i = 0; i < 4; ++i) {
                    const frame::ShadowFace& face = maps.faces[std::size_t(i)];
                    const frame::CameraView seen = frame::faceView(face);
                    const glm::dvec4 clip = seen.clipFromLS * glm::dvec4(seen.positionLS(groundWS), 1.0);
                    const double border =
                        2.0 * frame::shadowBorderTexels(settings, scene.lights[0], face.sideTexels) / face.sideTexels;
                    const double room = 1.0 - border - std::max(std::abs(clip.x), std::abs(clip.y));
                    const double share = i == 3 || passesAtOnce ? double(room > 0.0) : glm::clamp(room / 0.1, 0.0, 1.0);
                    expected += left * share * glm::dvec3(shared::faceColor(i));
                    left *= 1.0 - share;
                }
                EXPECT_EQ(left, 0.0) << "no cascade";
                const glm::dvec3 color(glm::vec3(pixel(colors, x, y)));
                wrong += !(glm::distance(glm::normalize(color), glm::normalize(expected)) < 0.02);
                const glm::vec3 expectedColor(expected);
                const auto face = faceOf(expectedColor);
                mixed += face && glm::distance(expectedColor, shared::faceColor(*face)) > 0.05f;
                ++checked;
            }
        fmt::print("{}: {} pixels wrong, {} mixed of {}\n", infoOf(filter).name, wrong, mixed, checked);
        EXPECT_LE(wrong, passesAtOnce ? checked / 500 : 0u);
        EXPECT_EQ(mixed > checked / 50, !passesAtOnce);
        EXPECT_GT(checked, 5000u);
    }
}

TEST_F(ShadowViews, ofAPointLightEachAxisHasTheColourOfItsFace) {
    scenes::Scene scene = aroundALamp();
    for (const ShadowFilter filter : mapFilters()) {
        settings.shadowFilter = filter;
        for (int face = 0; face < 6; ++face) {
            glm::dvec3 forwardWS(0.0), upWS(0.0);
            forwardWS[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
            upWS[(face / 2 + 1) % 3] = 1.0;
            // Narrower than a face, so that none of its neighbours is in the image.
            scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({}, forwardWS, upWS);
            scene.cameras[0].fovYRadians = 0.6;
            engine::Renderer renderer(context(), scene);
            const std::vector<float> colors = shown(renderer, DebugView::Cascades);
            for (std::size_t i = 0; i < colors.size(); i += 4)
                ASSERT_EQ(faceOf({colors[i], colors[i + 1], colors[i + 2]}), face) << "pixel " << i / 4;
        }
    }
}

TEST_F(ShadowViews, areGreyWhereNoMapAnswers) {
    const scenes::Scene scene = aroundALamp();
    engine::Renderer renderer(context(), scene);
    const auto countColored = [&] {
        const std::vector<float> colors = shown(renderer, DebugView::Cascades);
        std::size_t count = 0;
        for (std::size_t i = 0; i < colors.size(); i += 4) count += colors[i] != colors[i + 1];
        return count;
    };
    EXPECT_GT(countColored(), 0u);
    settings.shadowMaps.budgetMiB = 1e-5;
    EXPECT_EQ(countColored(), 0u) << "no room";
    settings.shadowMaps.budgetMiB = 64.0;
    settings.shadowFilter = ShadowFilter::Traced;
    EXPECT_EQ(countColored(), 0u) << "traced";
    for (const float x : shown(renderer, DebugView::ShadowAtlas)) EXPECT_TRUE(x == 0.0f || x == 1.0f);
    settings.shadowFilter = ShadowFilter::Pcf;
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    EXPECT_EQ(countColored(), 0u) << "no shadows";
}

/// A lamp a metre above a floor: its face -y shows the floor straight on, and its face +y nothing.
TEST_F(ShadowViews, theAtlasShowsTheDepthsThatItStores) {
    scenes::Scene scene = ballUnderSun();
    scene.nodes[0].instances = {{1, 0}};
    scene.lights = {pointLight({0.0, 1.0, 0.0}, 10.0f)};
    scene.lights[0].rangeMetres = 3.0f;
    settings.shadowFilter = ShadowFilter::Hard;
    settings.shadowMaps.resolutionTexels = 64;
    settings.sizePixels = {6 * 64, 64}; // a pixel per texel
    engine::Renderer renderer(context(), scene);
    const std::vector<float> atlas = shown(renderer, DebugView::ShadowAtlas);
    const engine::DrawnShadows shadows = renderer.shadows();
    ASSERT_EQ(shadows.atlasTexels, settings.sizePixels);
    const double nearMetres = 3.0 * frame::kFaceNearShare;
    for (const int x : {3 * 64 + 1, 3 * 64 + 31, 3 * 64 + 62}) {
        const glm::vec4 texel = pixel(atlas, x, 32);
        EXPECT_NEAR(texel.x / nearMetres, 1.0, 1e-6) << x;
        EXPECT_NEAR(texel.y, 0.5, 1e-6) << "a third of the range";
        EXPECT_EQ(texel.z, 4.0f);
        EXPECT_EQ(texel.w, 1.0f);
    }
    EXPECT_EQ(pixel(atlas, 2 * 64 + 31, 32), glm::vec4(0, 0, 3, 1)) << "nothing above the lamp";
    EXPECT_EQ(pixel(atlas, 3 * 64, 32).z, -4.0f) << "the rim";
    // 1.5 times as wide as high: half of the faces lie below the others.
    settings.sizePixels = {3 * 32, 2 * 32};
    const std::vector<float> strips = shown(renderer, DebugView::ShadowAtlas);
    EXPECT_EQ(pixel(strips, 16, 48).z, 4.0f);
    EXPECT_EQ(pixel(strips, 80, 16), glm::vec4(0, 0, 3, 1));
    EXPECT_NEAR(pixel(strips, 16, 48).x / nearMetres, 1.0, 1e-6);
    // Outside of the atlas.
    settings.sizePixels = {100, 6};
    EXPECT_EQ(pixel(shown(renderer, DebugView::ShadowAtlas), 0, 3), glm::vec4(0.0f));
}

TEST_F(ShadowViews, andSettingsOfShadowsChangeAPictureExactlyWithTheFiltersThatUseThem) {
    constexpr std::pair<const char*, const char*> kOthers[] = {{"shadowSamples", "3"},
                                                               {"shadowWidth", "7"},
                                                               {"shadowResolution", "64"},
                                                               {"shadowBudget", "0.05"},
                                                               {"shadowCascades", "1"}};
    scenes::Scene scene = pointsAndSun();
    scene.lights[0].radiusMetres = 0.3f;
    engine::Renderer renderer(context(), scene);
    for (const frame::ShadowFilterInfo& filter : frame::shadowFilterTable()) {
        settings.shadowFilter = filter.filter;
        const engine::ViewRequest plain{Technique::Deferred, settings};
        const std::vector<float> before = renderer.render(plain.technique, plain.settings).radiance;
        for (const auto& [key, value] : kOthers) {
            engine::ViewRequest other = plain;
            engine::settingOf(key).read(other, value);
            EXPECT_EQ(renderer.render(other.technique, other.settings).radiance == before,
                      !engine::settingOf(key).whyIdle(plain).empty())
                << key << " with " << filter.name;
        }
    }
}

TEST_F(ShadowViews, aFrameReportsWhatItsLightsGotAndWhichFacesItDrew) {
    scenes::Scene scene = pointsAndSun();
    scene.lights[1].castsShadow = true;
    engine::Renderer renderer(context(), scene);
    shown(renderer, DebugView::Final);
    engine::DrawnShadows shadows = renderer.shadows();
    ASSERT_EQ(shadows.lights.size(), scene.lights.size());
    EXPECT_TRUE(shadows.hasMaps);
    EXPECT_EQ(shadows.lights.back().faces, 4);
    EXPECT_EQ(shadows.lights.back().sideTexels, 256);
    EXPECT_EQ(shadows.faces, 3u * 6u + 4u);
    EXPECT_EQ(shadows.drawnFaces, shadows.faces);
    shown(renderer, DebugView::Final);
    EXPECT_EQ(renderer.shadows().drawnFaces, 0u) << "all are kept";
    scene.lights[0].positionWS.x += 0.01;
    shown(renderer, DebugView::Final);
    EXPECT_EQ(renderer.shadows().drawnFaces, 6u) << "one light has moved";
    settings.shadows = {scenes::ShadowRequest::Kind::Scene};
    settings.shadowFilter = ShadowFilter::Traced;
    shown(renderer, DebugView::Final);
    shadows = renderer.shadows();
    EXPECT_FALSE(shadows.hasMaps);
    ASSERT_EQ(shadows.lights.size(), 1u);
    EXPECT_EQ(shadows.lights[0].sceneIndex, 1);
    EXPECT_FALSE(shadows.shown) << "the first light casts none";
    EXPECT_EQ(shadows.drawnFaces, 0u);
}

} // namespace
} // namespace tessera
