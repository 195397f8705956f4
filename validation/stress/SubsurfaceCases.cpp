// Subsurface scattering with extreme widths, sizes, shapes and light counts. Diffusion must stay finite and conserve
// energy: it does not change uniform light, and loses none of partial light.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/Rendering.h"
#include "scenes/builtin/Author.h"
#include "scenes/builtin/Shapes.h"
#include "validation/stress/StressCase.h"
#include "validation/stress/StressRandom.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

using scenes::SubsurfaceMethod;

constexpr int kSideTexels = 64;
constexpr double kFloorMetres = 2.2;

frame::FrameSettings diffusionSettings(int sideTexels = kSideTexels) {
    frame::FrameSettings settings;
    settings.sizePixels = {48, 48};
    settings.display = false;
    settings.shadows = {scenes::ShadowRequest::Kind::All};
    settings.diffusion.sideTexels = sideTexels;
    return settings;
}

/// A profile of one Gaussian, `sigmaTexels` texels of the floor wide.
scenes::Subsurface diffusing(double sigmaTexels, int sideTexels = kSideTexels) {
    scenes::Subsurface subsurface;
    subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    const double millimetres = 1e3 * sigmaTexels * kFloorMetres / sideTexels;
    subsurface.profile = {{float(millimetres * millimetres), glm::vec3(1.0f)}};
    return subsurface;
}

/// A floor with one texture, centred and fully in view.
scenes::Scene diffusionFloor(const scenes::Subsurface& subsurface) {
    scenes::Scene scene = stressFloor();
    for (glm::vec2& texCoord : scene.meshes[0].texCoords[0]) texCoord /= float(kFloorMetres);
    scene.materials[0].subsurface = subsurface;
    scene.cameras[0].halfHeightMetres = 1.25;
    return scene;
}

/// Adds a sun straight above: irradiance is the same everywhere.
scenes::Scene& underASun(scenes::Scene& scene) {
    scenes::Light sun = stressLight({}, 3.0f);
    sun.type = scenes::LightType::Directional;
    sun.directionWS = {0.0, -1.0, 0.0};
    scene.lights.push_back(sun);
    return scene;
}

/// From a hundredth of a texel to ten times the atlas.
constexpr double kWidthsTexels[] = {0.01, 0.1, 0.4, 1.0, 8.0, double(kSideTexels), 10.0 * kSideTexels};

/// Images under uniform light. The first one, without diffusion, is the truth of the others.
std::vector<StressPicture> evenly(std::vector<std::pair<std::string, scenes::Scene>> scenes,
                                  int sideTexels = kSideTexels) {
    std::vector<StressPicture> pictures;
    scenes::Scene still = diffusionFloor({});
    pictures.push_back({"light that is not diffused", underASun(still), diffusionSettings(sideTexels)});
    for (auto& [what, scene] : scenes) pictures.push_back({what, underASun(scene), diffusionSettings(sideTexels), 0});
    return pictures;
}

std::vector<StressPicture> diffusionWidths(StressEffort) {
    std::vector<std::pair<std::string, scenes::Scene>> scenes;
    for (const double texels : kWidthsTexels)
        scenes.emplace_back(fmt::format("{:g} texels", texels), diffusionFloor(diffusing(texels)));
    return evenly(std::move(scenes));
}

/// The floor with a further triangle below the visible surface.
scenes::Scene withTriangles(const std::array<glm::vec3, 3>& cornersOS, const std::array<glm::vec2, 3>& texCoords) {
    scenes::Scene scene = diffusionFloor(diffusing(8.0));
    scenes::Mesh& mesh = scene.meshes[0];
    for (std::size_t c = 0; c < 3; ++c) {
        mesh.indices.push_back(std::uint32_t(mesh.positionsOS.size()));
        mesh.positionsOS.push_back(cornersOS[c]);
        mesh.texCoords[0].push_back(texCoords[c]);
        mesh.normalsOS.emplace_back(0.0f, 1.0f, 0.0f);
    }
    return scene;
}

std::vector<StressPicture> diffusionShapes(StressEffort) {
    std::vector<std::pair<std::string, scenes::Scene>> scenes;
    for (const double stretch : {10.0, 100.0}) {
        scenes::Scene stretched = diffusionFloor(diffusing(8.0));
        for (glm::vec2& texCoord : stretched.meshes[0].texCoords[0])
            texCoord.x = float(0.5 + (double(texCoord.x) - 0.5) / stretch);
        scenes.emplace_back(fmt::format("a texture stretched {:g}:1", stretch), std::move(stretched));
    }
    const glm::vec3 low(0.0f, -0.5f, 0.0f), beside(0.3f, -0.5f, 0.0f), behind(0.0f, -0.5f, 0.3f);
    const glm::vec2 middle(0.5f, 0.5f);
    scenes.emplace_back("a triangle without area", withTriangles({low, low, low}, {middle, middle, middle}));
    scenes.emplace_back("a triangle without area in the texture alone",
                        withTriangles({low, behind, beside}, {middle, middle, middle}));
    scenes.emplace_back("a chart that is a line", withTriangles({low, behind, beside}, {{{0, 0}, {1, 1}, {0.5, 0.5}}}));
    scenes::Scene mirrored = diffusionFloor(diffusing(8.0));
    for (glm::vec2& texCoord : mirrored.meshes[0].texCoords[0]) texCoord.x = 1.0f - texCoord.x;
    scenes.emplace_back("a mirrored texture", std::move(mirrored));
    scenes::Scene dot = diffusionFloor(diffusing(8.0));
    for (glm::vec2& texCoord : dot.meshes[0].texCoords[0]) texCoord = glm::vec2(0.5f) + 1e-3f * (texCoord - 0.5f);
    scenes.emplace_back("a texture within one texel", std::move(dot));
    return evenly(std::move(scenes));
}

std::vector<StressPicture> diffusionTexels(StressEffort effort) {
    std::vector<StressPicture> pictures;
    for (const int side : {1, 16, 2048}) {
        if (effort == StressEffort::Quick && side > 1024) continue;
        scenes::Scene scene = diffusionFloor(diffusing(1.0, side));
        pictures.push_back(
            {fmt::format("an atlas of {0}x{0} texels", side), underASun(scene), diffusionSettings(side)});
    }
    pictures.insert(pictures.begin(), evenly({}).front());
    for (std::size_t i = 1; i < pictures.size(); ++i) pictures[i].sameAs = 0;
    return pictures;
}

/// A ball lit from behind, so that light is transmitted and diffused. The scene is scaled by `scale`, and scaleMetres
/// keeps the ball's size in metres.
scenes::Scene glowingBall(SubsurfaceMethod method, double scale, const glm::dvec3& offsetWS) {
    scenes::Scene scene = diffusionFloor({});
    scenes::Material flesh = scenes::builtin::lambert("flesh", glm::vec3(0.8f));
    flesh.subsurface.method = method;
    flesh.subsurface.profile = {{400.0f, {0.4f, 0.6f, 0.8f}}, {6400.0f, {0.6f, 0.4f, 0.2f}}};
    flesh.subsurface.absorptionPerMillimetre = {1e-3f, 3e-3f, 6e-3f};
    flesh.subsurface.scaleMetres = float(1.0 / scale);
    scenes::Mesh ball;
    scenes::builtin::appendSphere(ball, {0.0, 0.6, 0.0}, 0.5, 24, 16);
    glm::vec2 most(0.0f);
    for (const glm::vec2& texCoord : ball.texCoords[0]) most = glm::max(most, texCoord);
    for (glm::vec2& texCoord : ball.texCoords[0]) texCoord /= most;
    const int mesh = scenes::builtin::addMesh(scene, "ball", std::move(ball));
    scenes::builtin::addNode(scene, "ball", glm::dmat4(1.0), {{mesh, scenes::builtin::addMaterial(scene, flesh)}});
    scene.lights = {stressLight({0.3, 4.0, 0.2}, 20.0f), stressLight({-3.0, 0.4, -1.0}, 60.0f)};
    for (scenes::Light& light : scene.lights) light.castsShadow = true;
    moveScene(scene, scale, offsetWS);
    return scene;
}

std::vector<StressPicture> ballsElsewhere(SubsurfaceMethod method) {
    std::vector<StressPicture> pictures;
    const auto add = [&](std::string what, double scale, const glm::dvec3& offsetWS) {
        StressPicture picture{std::move(what), glowingBall(method, scale, offsetWS), diffusionSettings()};
        pictures.push_back(std::move(picture));
    };
    add("in its place", 1.0, glm::dvec3(0.0));
    for (const int exponent : {-4, -2, 2, 4})
        add(fmt::format("1e{} times as large", exponent), std::pow(10.0, exponent), glm::dvec3(0.0));
    add("at 1e6 m", 1.0, {1e6, -1e6, 1e6});
    return pictures;
}

std::vector<StressPicture> diffusionPlaces(StressEffort) {
    return ballsElsewhere(SubsurfaceMethod::TextureSpaceDiffusion);
}
std::vector<StressPicture> passingPlaces(StressEffort) {
    return ballsElsewhere(SubsurfaceMethod::DepthMap);
}
std::vector<StressPicture> wrappedPlaces(StressEffort) {
    return ballsElsewhere(SubsurfaceMethod::Wrap);
}

/// Lights with short ranges over the floor.
void addCrowd(scenes::Scene& scene, int count) {
    StressRandom random(47);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 placeWS(random.between(-0.8, 0.8), random.between(0.2, 0.5), random.between(-0.8, 0.8));
        scene.lights.push_back(stressLight(placeWS, 4.0f / float(count)));
        scene.lights.back().castsShadow = false;
        scene.lights.back().rangeMetres = 0.6f;
    }
}

/// Renders the scene and returns the sum of its radiance; counts its pixels.
double sumOf(StressBench& bench, const scenes::Scene& scene, const frame::FrameSettings& settings,
             StressFigures& figures) {
    engine::Renderer renderer(bench.context(), scene, bench.shaders());
    const Picture picture = engine::toPicture(renderer.render(engine::Technique::Deferred, settings));
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
        const float* const radiance = picture.pixel(i);
        figures.count(std::span(radiance, 3));
        for (int c = 0; c < 3; ++c) sum += double(radiance[c]);
    }
    return sum;
}

/// Measures how much diffusion changes the sum of light, for widths up to 8 of 256 texels or for wider ones.
void measureEnergyOf(StressBench& bench, StressFigures& figures, bool isWide) {
    constexpr int kFineTexels = 256;
    const auto litInPart = [](scenes::Scene scene, int lights) {
        if (lights > 0) {
            addCrowd(scene, lights);
            return scene;
        }
        // The edge falls off over many texels, so that texels and pixels have the same sum.
        scenes::Light spot = stressLight({0.1, 2.0, -0.1}, 5.0f);
        spot.type = scenes::LightType::Spot;
        spot.directionWS = {0.0, -1.0, 0.0};
        spot.innerConeRadians = 0.0f;
        spot.outerConeRadians = glm::radians(15.0f);
        spot.castsShadow = false;
        scene.lights = {spot};
        return scene;
    };
    std::vector<std::pair<std::string, std::pair<int, double>>> rows;
    const auto add = [&](const std::string& what, int lights, double texels) {
        if ((texels > 8.0) == isWide) rows.push_back({fmt::format("{}, {:g} texels", what, texels), {lights, texels}});
    };
    for (const double texels : kWidthsTexels) add("a spot of light", 0, texels);
    const int many = bench.effort() == StressEffort::Quick ? 1024 : 65536;
    for (const double texels : {0.01, 8.0, double(kFineTexels)}) add(fmt::format("{} lights", many), many, texels);
    frame::FrameSettings settings = diffusionSettings(kFineTexels);
    settings.sizePixels = {96, 96};
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    double whole = 0.0;
    int wholeOf = -1;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [what, row] = rows[i];
        const auto& [lights, texels] = row;
        if (lights != wholeOf) whole = sumOf(bench, litInPart(diffusionFloor({}), lights), settings, figures);
        wholeOf = lights;
        const scenes::Scene scene = litInPart(diffusionFloor(diffusing(texels, kFineTexels)), lights);
        const double sum = double(bench.measuredTimes()) * sumOf(bench, scene, settings, figures);
        figures.error(std::abs(sum / whole - 1.0), [&, &what = what] { return what; });
        bench.progress(double(i + 1) / double(rows.size()));
    }
}

void measureEnergy(StressBench& bench, StressFigures& figures) {
    measureEnergyOf(bench, figures, false);
}
void measureWideEnergy(StressBench& bench, StressFigures& figures) {
    measureEnergyOf(bench, figures, true);
}

} // namespace

void addSubsurfaceCases(std::vector<StressCase>& cases) {
    const auto add = [&cases](const char* name, const char* holds, double tolerance, const char* reason,
                              auto pictures) {
        cases.push_back({name, holds, StressBound::WorstRel, tolerance, reason, {}, pictures});
    };
    const char* const even = "weights of a Gaussian are divided by their sum: a rounding for each tap";
    add("subsurface/width", "even light diffused by a hundredth of a texel to ten times the atlas stays as it is", 1e-5,
        even, &diffusionWidths);
    add("subsurface/shape",
        "even light diffused over stretched and mirrored textures and charts without area stays as it is", 1e-5, even,
        &diffusionShapes);
    add("subsurface/texels", "even light diffused in atlases of one to four million texels stays as it is", 1e-5, even,
        &diffusionTexels);
    const auto addPlace = [&cases](const char* name, const char* holds, double relMse, const char* reason,
                                   auto pictures) {
        cases.push_back({name, holds, StressBound::RelMse, relMse, reason, {}, pictures});
    };
    const char* const exact = "fp32 lighting of the same surface: measured 1e-13";
    addPlace("subsurface/place", "diffused light of scenes 1e-4 to 1e4 times as large and 1000 km from the origin",
             2e-4,
             "distances along the surface are not those through the air, and the reference has noise: measured 3e-5",
             &diffusionPlaces);
    addPlace("subsurface/passing",
             "light that passes through bodies 1e-4 to 1e4 times as large and 1000 km from the origin", 1e-11, exact,
             &passingPlaces);
    addPlace("subsurface/wrapped", "wrapped light in scenes 1e-4 to 1e4 times as large and 1000 km from the origin",
             1e-11, exact, &wrappedPlaces);
    cases.push_back(
        {"subsurface/energy",
         "a spot of light and 65,536 lights, diffused by a hundredth of a texel to 8 of 256 texels, keep their "
         "energy",
         StressBound::WorstRel,
         1e-2,
         "the bar of plane truth",
         &measureEnergy,
         {}});
    cases.push_back({"subsurface/wide_energy",
                     "light diffused by a quarter of the floor to ten times the atlas nearly keeps its energy",
                     StressBound::WorstRel,
                     0.1,
                     "light is divided by the share of the profile that lies on the floor, so that even light stays "
                     "even; what would leave past the edges is no even share of it: measured 0.036",
                     &measureWideEnergy,
                     {}});
}

} // namespace tessera::validation
