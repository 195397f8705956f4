#include <memory>

#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/ShadowMaps.h"
#include "tests/image/ShadowTest.h"
#include "validation/stress/StressScene.h"
#include "validation/timing/Interleave.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using namespace test;

class ShadowTimesSlow : public ShadowTest {
protected:
    static constexpr int kRounds = 9;

    /// GPU milliseconds of the latest frame's passes of this name.
    static double passMs(engine::Renderer& renderer, std::string_view name) {
        double sum = 0.0;
        for (const gpu::PassTiming& pass : renderer.backend().passTimings())
            if (pass.name == name) sum += pass.gpuMs.value_or(0.0);
        return sum;
    }
    static double median(std::vector<double> values) {
        std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
        return values[values.size() / 2];
    }
    static scenes::Scene shadowed(const char* name, std::optional<int> lights) {
        scenes::LoadOptions options;
        options.lights = lights;
        scenes::Scene scene = scenes::loadScene(name, options);
        // A material without instances: changing whether it casts shadows redraws all maps.
        scene.materials.push_back(scene.materials.front());
        return scene;
    }
    /// The scene with a camera per face, which sees as far as its light's range, and without lights.
    static scenes::Scene withFaceCameras(const scenes::Scene& scene, const frame::ShadowMaps& maps) {
        scenes::Scene seen = scene;
        seen.cameras.clear();
        for (const frame::ShadowFace& face : maps.faces) {
            seen.cameras.push_back(face.camera);
            seen.cameras.back().farMetres = std::min(face.camera.farMetres, face.reachMetres);
        }
        seen.lights.clear();
        return seen;
    }
};

TEST_F(ShadowTimesSlow, mapsTakeAtMostHalfAsLongAgainAsDepthAlone) {
    const std::pair<const char*, scenes::ShadowRequest> tries[] = {
        {"lattice", {scenes::ShadowRequest::Kind::First, 16}}, {"hall", {scenes::ShadowRequest::Kind::Scene}}};
    for (const auto& [name, shadows] : tries) {
        scenes::Scene scene = shadowed(name, {});
        frame::FrameSettings settings = ofSize(1280, 720);
        settings.shadows = shadows;
        settings.shadowFilter = ShadowFilter::Hard;
        const std::vector<frame::SurfaceBounds> bounds = frame::surfaceBounds(scene);
        const frame::CameraView view =
            frame::makeCameraView(scene.cameras[0], settings.sizePixels, settings.space, glm::vec3(0.0f), bounds);
        const frame::PackedLights lights = frame::packLights(scene, view, settings);
        const frame::ShadowMaps maps = frame::makeShadowMaps(scene, lights, view, settings, bounds);
        const scenes::Scene seen = withFaceCameras(scene, maps);
        engine::Renderer drawsMaps(context(), scene), drawsDepth(context(), seen);
        drawsMaps.backend().setProfiling(true);
        drawsDepth.backend().setProfiling(true);
        std::vector<double> mapsMs, depthMs;
        for (int round = 0; round <= kRounds; ++round) {
            scene.materials.back().castsShadow = round % 2 == 0;
            drawsMaps.materialsChanged();
            drawsMaps.draw(Technique::ClusteredDeferred, settings);
            double depth = 0.0;
            for (std::size_t i = 0; i < maps.faces.size(); ++i) {
                frame::FrameSettings ofFace;
                ofFace.camera = int(i);
                ofFace.sizePixels = glm::ivec2(maps.faces[i].sideTexels);
                drawsDepth.draw(Technique::ForwardPrepass, ofFace);
                depth += passMs(drawsDepth, "depth_prepass");
            }
            // The first round compiles programs and allocates memory.
            if (round == 0) continue;
            mapsMs.push_back(passMs(drawsMaps, "shadow_maps"));
            depthMs.push_back(depth);
        }
        fmt::print("{}: {} faces, {} x {} texels: maps {:.2f} ms, depth alone {:.2f} ms, ratio {:.2f}\n", name,
                   maps.faces.size(), maps.atlasTexels.x, maps.atlasTexels.y, median(mapsMs), median(depthMs),
                   median(mapsMs) / median(depthMs));
        EXPECT_GT(median(mapsMs), 0.0);
        EXPECT_LE(median(mapsMs), 1.5 * median(depthMs)) << name;
    }
}

/// Shadow filters whose look-ups are timed, `none` first.
struct Way {
    const char* name;
    std::optional<ShadowFilter> filter;
    float sizeMetres = 0.0f; ///< of lamps; without a size pcss is hard
};
constexpr Way kWays[] = {{"none", {}},
                         {"hard", ShadowFilter::Hard},
                         {"pcf, 3 texels", ShadowFilter::Pcf},
                         {"pcss, 16 samples", ShadowFilter::Pcss, 0.05f},
                         {"traced", ShadowFilter::Traced}};

/// A scene per shadow filter, with maps that are kept from frame to frame.
class WaysToTime {
public:
    WaysToTime(gpu::Context& context, const scenes::Scene& scene, const frame::FrameSettings& settings) {
        for (const Way& way : kWays) {
            auto own = std::unique_ptr<Seen>(new Seen{scene, settings, {}});
            for (scenes::Light& light : own->scene.lights)
                if (way.sizeMetres > 0.0f) light.*scenes::sizeParameter(infoOf(light.type))->member = way.sizeMetres;
            if (!way.filter) own->settings.shadows = {scenes::ShadowRequest::Kind::None};
            own->settings.shadowFilter = way.filter.value_or(ShadowFilter::Traced);
            own->renderer.emplace(context, own->scene);
            seen_.push_back(std::move(own));
        }
    }
    void addFrames(std::vector<validation::TimedFrame>& frames) {
        for (const auto& seen : seen_)
            frames.emplace_back(
                [&own = *seen](const glm::dvec3&) { own.renderer->draw(Technique::ClusteredDeferred, own.settings); });
    }
    /// Pairs of a pixel and a light with shadows that lights it; each needs a look-up.
    std::size_t shadowedPairs() {
        Seen& plain = *seen_[0];
        const frame::FrameSettings settings = plain.settings;
        std::size_t pairs = 0;
        for (std::size_t light = 0; light < plain.scene.lights.size(); ++light) {
            if (!scenes::castsShadow(plain.scene, light, seen_[1]->settings.shadows)) continue;
            plain.settings.soloLight = int(light);
            const std::vector<float> lit =
                plain.renderer->render(Technique::ClusteredDeferred, plain.settings).radiance;
            for (std::size_t i = 0; i < lit.size(); i += 4) pairs += lit[i] + lit[i + 1] + lit[i + 2] > 0.0f;
        }
        plain.settings = settings;
        return pairs;
    }

private:
    struct Seen {
        scenes::Scene scene;
        frame::FrameSettings settings;
        std::optional<engine::Renderer> renderer;
    };
    std::vector<std::unique_ptr<Seen>> seen_;
};

/// A floor that fills the image, below so many lamps.
scenes::Scene floorBelow(int lamps) {
    scenes::Scene scene = validation::stressFloor();
    scene.lights.clear();
    for (int i = 0; i < lamps; ++i) {
        const double angle = 2.4 * i, radius = 0.2 * std::sqrt((i + 0.5) / lamps);
        scene.lights.push_back(
            validation::stressLight({radius * std::cos(angle), 1.5, radius * std::sin(angle)}, 1.0f / float(lamps)));
        scene.lights.back().castsShadow = true;
    }
    return scene;
}

/// The minimum cost of a look-up is that of `hard` where all pixels of a floor query all lamps: the slope of the time
/// by lamps, less that without shadows.
TEST_F(ShadowTimesSlow, eachWayIsTimedByPairsAndAgainstTheFloor) {
    frame::FrameSettings settings = ofSize(1280, 720);
    settings.shadows = {scenes::ShadowRequest::Kind::Scene};
    settings.shadowMaps.resolutionTexels = 256;
    constexpr int kFewLamps = 8, kManyLamps = 24;
    WaysToTime few(context(), floorBelow(kFewLamps), settings), many(context(), floorBelow(kManyLamps), settings);
    settings.shadowMaps.resolutionTexels.reset();
    settings.shadows = {scenes::ShadowRequest::Kind::First, 16};
    WaysToTime lattice(context(), scenes::loadScene("lattice"), settings);
    settings.shadows = {scenes::ShadowRequest::Kind::Scene};
    WaysToTime hall(context(), scenes::loadScene("hall"), settings);
    std::vector<validation::TimedFrame> frames;
    for (WaysToTime* ways : {&few, &many, &lattice, &hall}) ways->addFrames(frames);
    const std::vector<std::vector<double>> ms = validation::timeInterleaved(frames, {.rounds = kRounds});
    const std::size_t count = std::size(kWays);
    const auto at = [&](std::size_t scene, std::size_t way) { return median(ms[scene * count + way]); };
    const std::size_t fewPairs = few.shadowedPairs(), manyPairs = many.shadowedPairs();
    const auto perPair = [&](std::size_t way) {
        return 1e6 * (at(1, way) - at(0, way) - at(1, 0) + at(0, 0)) / double(manyPairs - fewPairs);
    };
    const double floorNs = perPair(1);
    for (std::size_t way = 1; way < count; ++way)
        fmt::print("a floor alone, {}: {:.1f} ns a pair\n", kWays[way].name, perPair(way));
    EXPECT_GT(floorNs, 0.0);
    const std::pair<const char*, WaysToTime*> real[] = {{"lattice", &lattice}, {"hall", &hall}};
    for (std::size_t scene = 0; scene < std::size(real); ++scene) {
        const auto& [name, ways] = real[scene];
        const auto pairs = double(ways->shadowedPairs());
        const double floorMs = at(2 + scene, 0) + 1e-6 * floorNs * pairs;
        fmt::print("{}: {:.0f} shadowed pairs; {:.1f} ms without shadows, {:.1f} ms with the floor of look-ups\n", name,
                   pairs, at(2 + scene, 0), floorMs);
        for (std::size_t way = 1; way < count; ++way) {
            const double frameMs = at(2 + scene, way);
            fmt::print("{}, {}: {:.1f} ms, {:.1f} ns a pair, {:.2f} times the floor\n", name, kWays[way].name, frameMs,
                       1e6 * (frameMs - at(2 + scene, 0)) / pairs, frameMs / floorMs);
        }
    }
}

} // namespace
} // namespace tessera
