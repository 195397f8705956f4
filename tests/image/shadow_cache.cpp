#include "renderer/frame/ShadowMemory.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using namespace test;

/// State that is kept across frames.
class ShadowCache : public ShadowTest {
protected:
    ShadowCache() {
        scenes::LoadOptions options;
        options.lights = 5;
        scene = scenes::loadScene("lattice", options);
        settings.sizePixels = {160, 90};
        settings.shadows = kAllLightsCast;
        settings.shadowFilter = ShadowFilter::Hard;
        settings.prune = true;
    }
    /// Returns whether the next frame draws maps; checks that its image is that of a new renderer.
    bool drawsMapsRightly(engine::Renderer& renderer) {
        renderer.draw(Technique::ClusteredDeferred, settings);
        const std::vector<float> kept = renderer.download().radiance;
        const std::vector<gpu::PassTiming> passes = renderer.backend().passTimings();
        EXPECT_EQ(drawn(scene, settings, Technique::ClusteredDeferred), kept);
        return std::ranges::find(passes, "shadow_maps", &gpu::PassTiming::name) != passes.end();
    }
    scenes::Scene scene;
    frame::FrameSettings settings;
};

TEST_F(ShadowCache, mapsAreDrawnAgainWhereLightsOrCastersChangeAndNowhereElse) {
    engine::Renderer renderer(context(), scene);
    EXPECT_TRUE(drawsMapsRightly(renderer)) << "the first frame";
    EXPECT_FALSE(drawsMapsRightly(renderer)) << "nothing has changed";
    scene.lights[1].positionWS += glm::dvec3(0.05, 0.02, 0.0);
    EXPECT_TRUE(drawsMapsRightly(renderer)) << "a light has moved";
    EXPECT_FALSE(drawsMapsRightly(renderer));
    scene.lights[1].color *= 0.5f;
    EXPECT_FALSE(drawsMapsRightly(renderer)) << "a colour";
    scene.materials[0].castsShadow = false;
    renderer.materialsChanged();
    EXPECT_TRUE(drawsMapsRightly(renderer)) << "a caster is none any more";
    scene.materials[0].baseColor.x *= 0.5f;
    renderer.materialsChanged();
    EXPECT_FALSE(drawsMapsRightly(renderer)) << "the colour of a material";
    settings.shadowMaps.resolutionTexels = 1024;
    EXPECT_TRUE(drawsMapsRightly(renderer)) << "another resolution";
    settings.shadowFilter = ShadowFilter::Traced;
    EXPECT_FALSE(drawsMapsRightly(renderer)) << "no maps";
    settings.shadowFilter = ShadowFilter::Hard;
    drawsMapsRightly(renderer); // the atlas may still be cached
    EXPECT_FALSE(drawsMapsRightly(renderer));
}

TEST_F(ShadowCache, mapsAreDrawnAgainWhereAnEditOfShadersHasMadeAProgramAnew) {
    const ShaderMutant shaders;
    engine::Renderer renderer(context(), scene, shaders.tree());
    EXPECT_TRUE(drawsMapsRightly(renderer)) << "the first frame";
    EXPECT_EQ(renderer.programs().reload().programs, 0u);
    EXPECT_FALSE(drawsMapsRightly(renderer)) << "nothing has changed";
    shaders.replace("passes/geometry.vert", "void main()", "void main() /* as it was */");
    EXPECT_GT(renderer.programs().reload().programs, 0u);
    EXPECT_TRUE(drawsMapsRightly(renderer));
    EXPECT_FALSE(drawsMapsRightly(renderer));
}

TEST_F(ShadowCache, timesInAnyOrderHaveThePicturesThatTheyHaveAlone) {
    for (scenes::Light& light : scene.lights) {
        light.animation.emplace();
        light.animation->kind = scenes::LightAnimationKind::Wobble;
        light.animation->periodSeconds = 4.0;
        light.animation->amplitudeMetres = {0.05, 0.02, 0.0};
    }
    engine::Renderer renderer(context(), scene);
    for (const double timeSeconds : {1.0, 0.25, 0.75, 0.0, 0.25}) {
        SCOPED_TRACE(timeSeconds);
        settings.timeSeconds = timeSeconds;
        EXPECT_TRUE(drawsMapsRightly(renderer)) << "the lights are elsewhere";
        EXPECT_FALSE(drawsMapsRightly(renderer)) << "the same time again";
    }
}

TEST_F(ShadowCache, keyframesThatTurnALightDrawItsMapAgainAndThoseOfItsColourDoNot) {
    settings.prune = false; // so that it has a map when turned away
    scenes::Light& light = scene.lights[1];
    light.type = scenes::LightType::Spot;
    scenes::LightKeys& keys = light.keyframes.emplace_back();
    keys.of = scenes::LightKeyed::Direction;
    keys.timesSeconds = {0.0, 1.0};
    keys.values = {{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}};
    engine::Renderer renderer(context(), scene);
    for (const double timeSeconds : {0.0, 0.25, 1.0}) {
        SCOPED_TRACE(timeSeconds);
        settings.timeSeconds = timeSeconds;
        EXPECT_TRUE(drawsMapsRightly(renderer)) << "the light looks elsewhere";
        EXPECT_FALSE(drawsMapsRightly(renderer)) << "the same time again";
    }
    keys.of = scenes::LightKeyed::Color;
    keys.values = {{1.0, 1.0, 1.0}, {0.5, 1.0, 0.5}};
    EXPECT_TRUE(drawsMapsRightly(renderer)) << "it looks as it did at rest";
    settings.timeSeconds = 0.25;
    EXPECT_FALSE(drawsMapsRightly(renderer)) << "another colour";
}

TEST_F(ShadowCache, settingsThatAreDrawnInTurnKeepAnAtlasEachAndGiveItBack) {
    engine::Renderer renderer(context(), scene);
    const auto draw = [&](ShadowFilter filter, int side) {
        settings.shadowFilter = filter;
        settings.shadowMaps.resolutionTexels = side;
        return drawsMapsRightly(renderer);
    };
    EXPECT_TRUE(draw(ShadowFilter::Hard, 128));
    EXPECT_TRUE(draw(ShadowFilter::Pcf, 256));
    EXPECT_FALSE(draw(ShadowFilter::Hard, 128));
    EXPECT_FALSE(draw(ShadowFilter::Pcf, 256));
    const std::size_t withMaps = renderer.backend().poolBytes();
    for (int i = 0; i <= renderer.backend().mostIdleFrames(); ++i) draw(ShadowFilter::Traced, 256);
    EXPECT_LT(renderer.backend().poolBytes(), withMaps - 256 * 256 * 4 * 6);
}

TEST_F(ShadowCache, ofALightThatMovesOnlyItsOwnFacesAreDrawn) {
    settings.shadowMaps.resolutionTexels = 64;
    engine::Renderer renderer(context(), scene);
    const std::vector<frame::SurfaceBounds> bounds = frame::surfaceBounds(scene);
    frame::ShadowMemory memory;
    const auto facesDrawn = [&](bool holdsAtlas) {
        const frame::CameraView view =
            frame::makeCameraView(scene.cameras[0], settings.sizePixels, settings.space, glm::vec3(0.0f), bounds);
        const frame::PackedLights lights = frame::packLights(scene, view, settings);
        const frame::FrameSpec spec = frame::makeFrameSpec(scene, lights, settings);
        memory.begin(frame::makeShadowMaps(scene, lights, view, settings, bounds), renderer.sceneGpu(spec), holdsAtlas,
                     true);
        memory.end();
        return memory.draws().faces.size();
    };
    const std::size_t all = facesDrawn(false);
    EXPECT_EQ(all % 6, 0u);
    EXPECT_GE(all, 12u);
    EXPECT_EQ(facesDrawn(true), 0u);
    scene.lights[1].positionWS.x += 0.01;
    EXPECT_EQ(facesDrawn(true), 6u);
    EXPECT_EQ(facesDrawn(false), all) << "the atlas is another one";
}

} // namespace
} // namespace tessera
