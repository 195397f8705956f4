#include "tests/image/ShadowTest.h"
#include "validation/stress/StressScene.h"

namespace tessera {
namespace {

using frame::ShadowFilter;
using namespace test;

/// Balls, boards and a floor under a sun, viewed by parallel rays. A camera that moves across them by whole pixels
/// shows the same points of all surfaces, shifted by as many pixels, whatever their shapes.
class ShadowCascades : public ShadowTest {
protected:
    static constexpr glm::ivec2 kSizePixels{192, 108};
    static constexpr int kMoves = 64;

    ShadowCascades() : scene(validation::stressScene()) {
        scenes::Camera& camera = scene.cameras[0];
        camera.worldFromCamera = scenes::worldFromLookAt({0.0, 2.5, 4.5}, {0.0, 0.4, 0.0});
        makeOrthographic(camera, 0.5);
        scene.lights = {validation::stressLight({}, 1.0f)};
        scene.lights[0].type = scenes::LightType::Directional;
        scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.55, -1.0, -0.35));
        settings.sizePixels = kSizePixels;
        settings.shadows = kAllLightsCast;
    }

    /// The camera's offset across the scene in pixels after so many moves.
    static glm::ivec2 offsetPixels(int moves) { return {moves, (moves + 1) / 3}; }

    /// Hue of a colour of the view `cascades` at full brightness: shadows darken it, blended cascades change its hue.
    static glm::ivec3 hue(const float* color) {
        const glm::vec3 rgb(color[0], color[1], color[2]);
        return glm::round(1000.0f * rgb / std::max({rgb.x, rgb.y, rgb.z}));
    }

    /// Counts of pixels over all moves; a change is one of the shadow by more than a hundredth.
    struct Changes {
        std::size_t all = 0;      ///< changes with the filter
        std::size_t passing = 0;  ///< of these, where one cascade blends into the next
        std::size_t shimmer = 0;  ///< of the others, where no ray to the sun changes
        std::size_t traced = 0;   ///< changes with rays to the sun
        std::size_t partly = 0;   ///< pixels in some shadow
        std::size_t compared = 0; ///< pixels
    };
    Changes changes(ShadowFilter filter) {
        const glm::dmat4 first = scene.cameras[0].worldFromCamera;
        const double pixelMetres = 2.0 * scene.cameras[0].halfHeightMetres / kSizePixels.y;
        engine::Renderer renderer(context(), scene);
        std::vector<float> before, tracedBefore, cascadesBefore;
        Changes found;
        for (int move = 0; move <= kMoves; ++move) {
            const glm::dvec2 offset = pixelMetres * glm::dvec2(offsetPixels(move));
            scene.cameras[0].worldFromCamera[3] = first[3] + offset.x * first[0] + offset.y * first[1];
            const auto seen = [&](ShadowFilter way, frame::DebugView view) {
                settings.shadowFilter = way;
                settings.view = view;
                return renderer.render(engine::Technique::Deferred, settings).radiance;
            };
            const std::vector<float> now = seen(filter, frame::DebugView::Shadow);
            const std::vector<float> traced = seen(ShadowFilter::Traced, frame::DebugView::Shadow);
            const std::vector<float> cascades = seen(filter, frame::DebugView::Cascades);
            const glm::ivec2 step = offsetPixels(move) - offsetPixels(std::max(move - 1, 0));
            for (int y = step.y; y < kSizePixels.y && move > 0; ++y)
                for (int x = 0; x < kSizePixels.x - step.x; ++x) {
                    const auto at = 4 * std::size_t(y * kSizePixels.x + x);
                    const auto was = 4 * std::size_t((y - step.y) * kSizePixels.x + x + step.x);
                    const bool isChanged = std::abs(now[at] - before[was]) > 0.01f;
                    const bool isTracedChanged = std::abs(traced[at] - tracedBefore[was]) > 0.01f;
                    const bool isPassing = isChanged && hue(&cascades[at]) != hue(&cascadesBefore[was]);
                    ++found.compared;
                    found.all += isChanged;
                    found.traced += isTracedChanged;
                    found.passing += isPassing && !isTracedChanged;
                    found.shimmer += isChanged && !isTracedChanged && !isPassing;
                    found.partly += now[at] < 1.0f;
                }
            before = now;
            tracedBefore = traced;
            cascadesBefore = cascades;
        }
        scene.cameras[0].worldFromCamera = first;
        return found;
    }

    scenes::Scene scene;
    frame::FrameSettings settings;
};

TEST_SWEEP(ShadowCascades, doNotShimmerAsTheCameraMovesByPartsOfATexel) {
    for (const int resolution : {64, 256})
        for (const int cascades : {1, 4})
            for (const ShadowFilter filter : {ShadowFilter::Hard, ShadowFilter::Pcf}) {
                const int most = (resolution == 256) + (cascades == 4) + (filter == ShadowFilter::Pcf);
                if (!isWholeSweep() && most % 3 != 0) continue;
                settings.shadowMaps.resolutionTexels = resolution;
                settings.shadowMaps.cascades = cascades;
                const Changes found = changes(filter);
                fmt::print("{} texels, {} cascades, {}: {} shimmer, {} pass over, {} of rays, {} shadowed, of {}\n",
                           resolution, cascades, infoOf(filter).name, found.shimmer, found.passing, found.traced,
                           found.partly, found.compared);
                EXPECT_GT(found.partly, found.compared / 20);
                EXPECT_EQ(found.shimmer, 0u);
                // The cascades' edges follow the camera, and so does the band in which they blend.
                EXPECT_LT(found.passing, found.compared / 1000);
            }
}

} // namespace
} // namespace tessera
