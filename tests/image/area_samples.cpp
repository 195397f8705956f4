// Sampled area lights against closed forms, the integral over a light, and linearly transformed cosines.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/PrepareView.h"
#include "renderer/graph/Plan.h"
#include "scenes/LookAt.h"
#include "tests/image/AreaLightTest.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/support/AreaLights.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using std::numbers::pi;
using namespace test;

/// A mean over pixels, and its standard error.
struct SampledMean {
    double mean = 0.0, standardError = 0.0;
};

SampledMean meanOf(const std::vector<double>& values) {
    double sum = 0.0, squares = 0.0;
    for (const double value : values) {
        sum += value;
        squares += value * value;
    }
    const double count = double(values.size()), mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

class AreaSamples : public EnvironmentTest {
protected:
    static frame::FrameSettings sampledSettings(int side, int samples) {
        frame::FrameSettings settings;
        settings.sizePixels = {side, side};
        settings.area = {frame::AreaLights::Sampled, samples};
        return settings;
    }

    /// A quad of 2 x 2 m in z = 0; every pixel shows its centre, viewed at this cosine.
    static scenes::Scene pointOf(const scenes::Material& material, double cosView) {
        scenes::Scene scene = quadScene(material);
        scenes::Camera& camera = scene.cameras[0];
        camera.projection = scenes::Projection::Orthographic;
        camera.halfHeightMetres = 1e-5;
        const glm::dvec3 toViewer(std::sqrt(1.0 - cosView * cosView), 0.0, cosView);
        camera.worldFromCamera = scenes::worldFromLookAt(3.0 * toViewer, glm::dvec3(0.0));
        return scene;
    }

    /// Radiance that the point reflects from one light, over the pixels of a square image.
    SampledMean seen(scenes::Scene& scene, engine::Renderer& renderer, const scenes::Light& light, int samples = 16,
                     int side = 16) {
        scene.lights = {light};
        scene.lights[0].isSeen = false;
        const std::vector<float> radiance =
            renderer.render(Technique::Deferred, sampledSettings(side, samples)).radiance;
        std::vector<double> values;
        for (std::size_t i = 0; i < radiance.size(); i += 4) values.push_back(double(radiance[i]));
        return meanOf(values);
    }
    static double integralOf(const scenes::Scene& scene) {
        frame::FrameSettings settings;
        settings.sizePixels = {1, 1};
        return double(validation::referencePicture(
                          scene, settings, [] {}, validation::Alternatives::None)
                          .picture.rgba[0]);
    }
    static void expectWithinThree(const SampledMean& shown, double wanted, double rounding = 2e-5) {
        EXPECT_LE(std::abs(shown.mean - wanted), 3.0 * shown.standardError + rounding * wanted)
            << shown.mean << " +- " << shown.standardError << ", wanted " << wanted;
    }

    void expectTheIntegralOnFloors();
    void expectTheIntegralOnBalls();
    void expectEveryFaultShows();
    void expectLightOfTouchingOnes();
};
using AreaSamplesSlow = AreaSamples;

scenes::Material sampledMatte() {
    scenes::Material material;
    material.model = scenes::MaterialModel::Lambert;
    material.doubleSided = true;
    return material;
}

// Factors from a point to areas: Howell, "A Catalog of Radiation Heat Transfer Configuration Factors".
TEST_F(AreaSamples, lightMatteSurfacesAsTheClosedFormsSay) {
    scenes::Scene scene = pointOf(sampledMatte(), 1.0);
    engine::Renderer renderer(context(), scene);
    const auto expect = [&](const scenes::Light& light, double factor, const std::string& what,
                            double rounding = 2e-5) {
        SCOPED_TRACE(what);
        SampledMean shown = seen(scene, renderer, light);
        // Few cosine samples hit a far light, each with probability `factor`, and each hit adds the same value. Their
        // number is a Poisson variable; pixels without a hit do not show its variance.
        constexpr double kSamples = 256.0 * 16.0;
        shown.standardError = std::max(shown.standardError, pi * factor * std::sqrt(factor / kSamples));
        expectWithinThree(shown, pi * factor, rounding);
        EXPECT_LE(shown.standardError, 0.02 * pi * factor);
    };
    // A parallel rectangle above the middle (B-4, four times).
    for (const double height : {0.05, 0.5, 5.0, 5000.0}) {
        scenes::Light light = areaLight(LightType::Rectangle, {0.0, 0.0, height}, {0.0, 0.0, -1.0}, 1.0f);
        light.widthMetres = 2.0f;
        light.heightMetres = 1.0f;
        const double x = 1.0 / height, y = 0.5 / height;
        const double corner = (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
                               y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
                              (2.0 * pi);
        expect(light, 4.0 * corner, fmt::format("rectangle at {}", height));
        // If rows correlate with columns, samples cover only the diagonal of the light.
        if (height == 0.5)
            for (const int samples : {1, 4}) {
                const SampledMean few = seen(scene, renderer, light, samples, 96);
                expectWithinThree(few, pi * 4.0 * corner);
                EXPECT_LE(few.standardError, 0.01 * few.mean);
            }
    }
    // A rectangle standing on the surface, or lowered by half its height (B-3, twice).
    for (const double down : {0.0, 1.0}) {
        scenes::Light light = areaLight(LightType::Rectangle, {0.0, 0.5, 1.0 - down}, {0.0, -1.0, 0.0}, 1.0f);
        light.widthMetres = light.heightMetres = 2.0f;
        const double x = 2.0, y = (2.0 - down) / 0.5;
        const double half = (std::atan(x) - std::atan(x / std::sqrt(1 + y * y)) / std::sqrt(1 + y * y)) / (2.0 * pi);
        expect(light, 2.0 * half, fmt::format("standing rectangle, let down by {}", down));
    }
    for (const double height : {0.03, 0.3, 300.0}) // B-13
        expect(areaLight(LightType::Disk, {0.0, 0.0, height}, {0.0, 0.0, -1.0}, 1.0f), 0.09 / (0.09 + height * height),
               fmt::format("disk at {}", height));
    for (const double distance : {0.7, 400.0}) // B-37
        expect(areaLight(LightType::Sphere, distance * glm::dvec3(std::sin(1.0), 0.0, std::cos(1.0)), {0.0, 0.0, -1.0},
                         1.0f),
               0.09 / (distance * distance) * std::cos(1.0), fmt::format("sphere at {}", distance));
    EXPECT_EQ(seen(scene, renderer, areaLight(LightType::Sphere, {0.0, 0.1, 0.2}, {0.0, 0.0, -1.0}, 1.0f)).mean, 0.0)
        << "within a sphere";
    // An endless tube: r/h, as for a strip of its width, up to the part missing at its ends.
    scenes::Light tube = areaLight(LightType::Tube, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, 1.0f);
    tube.lengthMetres = 2e4f;
    expect(tube, 0.3, "tube", 1e-4);
    // A short tube, against the reference for lack of a closed form: two formulas find heights on it.
    tube.positionWS.z = 0.5;
    tube.lengthMetres = 4.0f;
    const SampledMean ofLength = seen(scene, renderer, tube, 64);
    expectWithinThree(ofLength, integralOf(scene), 1e-4);
    EXPECT_LE(ofLength.standardError, 2e-3 * ofLength.mean);
    // An end cap above the point, as a disk.
    tube = areaLight(LightType::Tube, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, 1.0f);
    tube.lengthMetres = 1.0f;
    expect(tube, 0.09 / (0.09 + 0.25), "end of a tube");
    // Close below its rim (B-14).
    constexpr double kAside = 0.29, kHeight = 0.03;
    tube.positionWS = {kAside, 0.0, 0.5 + kHeight};
    const double h = kHeight / kAside, r = 0.3 / kAside, z = 1.0 + h * h + r * r;
    const double factor = 0.5 * (1.0 - (1.0 + h * h - r * r) / std::sqrt(z * z - 4.0 * r * r));
    expectWithinThree(seen(scene, renderer, tube, 64, 32), pi * factor);
    // A triangle, by its edges (Lambert 1760).
    scenes::Light triangle = areaLight(LightType::Polygon, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 1.0f);
    triangle.corners = cornersOf({{-0.4f, -0.3f}, {0.7f, 0.0f}, {0.1f, 0.6f}});
    const auto cornerWS = [&](std::size_t i) {
        const glm::dvec2 corner(triangle.corners.metres[i % 3]);
        return glm::normalize(triangle.positionWS + corner.x * triangle.alongWS +
                              corner.y * glm::cross(triangle.directionWS, triangle.alongWS));
    };
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 normal = glm::cross(cornerWS(i), cornerWS(i + 1));
        sum += std::asin(glm::length(normal)) * glm::normalize(normal).z;
    }
    expect(triangle, std::abs(sum) / (2.0 * pi), "triangle");
}

/// Lights are sampled independently: the noise of several lights is not that of one.
TEST_F(AreaSamples, ofSeveralLightsAreTakenApart) {
    scenes::Scene scene = pointOf(sampledMatte(), 1.0);
    scenes::Light light = areaLight(LightType::Rectangle, {0.0, 0.0, 0.5}, {0.0, 0.0, -1.0}, 1.0f);
    light.isSeen = false;
    const auto found = [&](std::size_t lights) {
        scene.lights.assign(lights, light);
        engine::Renderer renderer(context(), scene);
        const std::vector<float> radiance = renderer.render(Technique::Deferred, sampledSettings(32, 1)).radiance;
        std::vector<double> values;
        for (std::size_t i = 0; i < radiance.size(); i += 4) values.push_back(double(radiance[i]));
        return meanOf(values);
    };
    const SampledMean one = found(1), four = found(4);
    EXPECT_NEAR(four.mean, 4.0 * one.mean, 3.0 * std::hypot(four.standardError, 4.0 * one.standardError));
    EXPECT_NEAR(four.standardError / one.standardError, 2.0, 0.3); // 4 if they were fully correlated
}

/// A light over a floor viewed at a grazing angle, on the far side, so that its highlight is visible.
scenes::Light overFloor(LightType type) {
    scenes::Light light = areaLight(type, {-2.0, 0.1, 0.6}, {1.0, 0.0, -0.3}, 1.0f);
    if (type == LightType::Rectangle) light.isTwoSided = true;
    if (type == LightType::Tube) light.directionWS = glm::normalize(glm::dvec3(0.7, 1.0, -0.3)); // with an end cap
    if (type == LightType::Disk) light.rangeMetres = 4.0f;
    if (type == LightType::Polygon) light.corners.metres[2] = {0.1f, -0.1f}; // concave
    return light;
}

void AreaSamples::expectTheIntegralOnFloors() {
    std::size_t turn = 0;
    static constexpr std::array kCosines{0.1, 0.3};
    for (const double cosView : inTurn(kCosines, 0))
        for (const double roughness : {0.05, 0.25, 0.5, 1.0}) {
            scenes::Scene scene = pointOf(twoSidedMetal(1.0, roughness), cosView);
            engine::Renderer renderer(context(), scene);
            for (const LightType type : inTurn(kAreaTypes, turn++)) {
                SCOPED_TRACE(fmt::format("{}, roughness {}, cosine {}", scenes::infoOf(type).name, roughness, cosView));
                const SampledMean shown = seen(scene, renderer, overFloor(type), 64);
                expectWithinThree(shown, integralOf(scene), 2e-4);
            }
        }
}
TEST_F(AreaSamples, agreeWithTheIntegralOnFloorsThatAreSeenFlat) {
    expectTheIntegralOnFloors();
}
TEST_F(AreaSamplesSlow, agreeWithTheIntegralOnFloorsThatAreSeenFlat) {
    expectTheIntegralOnFloors();
}

struct SampledCase {
    std::string name;
    scenes::Material material;
};

std::vector<SampledCase> sampledMaterials() {
    using scenes::MaterialModel;
    std::vector<SampledCase> cases{{"coat", coatedSheet()}, {"velvet", velvet()}};
    const auto add = [&](const char* name, MaterialModel model) -> scenes::Material& {
        scenes::Material& material = cases.emplace_back(SampledCase{name, {}}).material;
        material.model = model;
        material.baseColor = glm::vec4(0.5f, 0.4f, 0.3f, 1.0f);
        return material;
    };
    scenes::Material& brushed = add("brushed", MaterialModel::MetallicRoughness);
    brushed.metallic = 1.0f;
    brushed.perceptualRoughness = 0.4f;
    brushed.anisotropyStrength = 0.8f;
    brushed.anisotropyRotationRadians = 0.7f;
    add("dielectric", MaterialModel::MetallicRoughness).perceptualRoughness = 0.3f;
    cases.back().material.metallic = 0.0f;
    for (const scenes::MaterialModelInfo& model : scenes::materialModels())
        if (model.isLit && model.model != MaterialModel::MetallicRoughness)
            add(std::string(model.name).c_str(), model.model);
    scenes::Material& wrapped = add("wrapped", MaterialModel::Lambert);
    wrapped.subsurface.method = scenes::SubsurfaceMethod::Wrap;
    wrapped.subsurface.bodyRadiusMetres = 1.0f;
    return cases;
}

/// Relative errors by pixel of a ball, so that no highlight dominates.
void AreaSamples::expectTheIntegralOnBalls() {
    std::size_t turn = 0;
    for (const auto& [name, material] : everyNth(sampledMaterials(), 4))
        for (const LightType type : inTurn(kAreaTypes, turn++)) {
            SCOPED_TRACE(fmt::format("{} under a {}", name, scenes::infoOf(type).name));
            scenes::Scene scene = ballUnderSky(material);
            scene.lights = {areaLight(type, {1.2, 1.5, 2.0}, {-1.2, -1.5, -2.0}, 1.0f)};
            scene.lights[0].isSeen = false;
            const frame::FrameSettings settings = sampledSettings(24, 64);
            const validation::ReferencePicture truth = validation::referencePicture(
                scene, settings, [] {}, validation::Alternatives::None);
            engine::Renderer renderer(context(), scene);
            const std::vector<float> radiance = renderer.render(Technique::Deferred, settings).radiance;
            std::vector<double> errors;
            for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
                const double own = double(radiance[4 * i]), other = double(truth.picture.rgba[4 * i]);
                if (truth.picture.covered[i] != 0 && own + other > 0.0)
                    errors.push_back(2.0 * (own - other) / (own + other + 1e-3));
            }
            const SampledMean error = meanOf(errors);
            fmt::print("{:24} {:9} {:+.1e} of {:.1e}\n", name, scenes::infoOf(type).name, error.mean,
                       error.standardError);
            EXPECT_LE(std::abs(error.mean), 3.0 * error.standardError + 2e-5);
            EXPECT_LE(error.standardError, 5e-3);
        }
}
TEST_F(AreaSamples, ofEveryModelAgreeWithTheIntegralOnABall) {
    expectTheIntegralOnBalls();
}
TEST_F(AreaSamplesSlow, ofEveryModelAgreeWithTheIntegralOnABall) {
    expectTheIntegralOnBalls();
}

/// Many half vectors of a broad Blinn lobe face away from a grazing viewer, and such samples have no direction to a
/// light. They must not add wrapped light, here of a sphere that fills most of the hemisphere.
TEST_F(AreaSamples, withoutADirectionAddNoLight) {
    scenes::Material wrapped = sampledMatte();
    wrapped.model = scenes::MaterialModel::BlinnPhong;
    wrapped.exponent = 0.0f;
    wrapped.subsurface.method = scenes::SubsurfaceMethod::Wrap;
    wrapped.subsurface.wrap = 1.0f;
    wrapped.subsurface.bodyRadiusMetres = 1.0f;
    scenes::Scene scene = pointOf(wrapped, 0.1);
    engine::Renderer renderer(context(), scene);
    const SampledMean shown =
        seen(scene, renderer, areaLight(LightType::Sphere, {0.0, 0.0, 0.31}, {0.0, 0.0, -1.0}, 1.0f), 64);
    expectWithinThree(shown, integralOf(scene));
    EXPECT_LE(shown.standardError, 2e-3 * shown.mean);
}

/// Sampling omits the resources of LTC, and the reverse; scenes without area lights define neither.
TEST_F(AreaSamples, andTransformedCosinesLeaveEachOtherOut) {
    const auto defineOf = [](const scenes::Scene& scene, const frame::FrameSettings& settings) {
        std::optional<std::string> samples;
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::Deferred, settings))
            for (const auto& [name, value] : program.defines)
                if (name == "AREA_SAMPLES") samples = value;
        return samples;
    };
    scenes::Scene scene = pointOf(sampledMatte(), 1.0);
    frame::FrameSettings sampled = sampledSettings(16, 64), closed = sampled;
    closed.area.lights = frame::AreaLights::Ltc;
    EXPECT_EQ(defineOf(scene, sampled), std::nullopt);
    scene.lights = {areaLight(LightType::Disk, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 1.0f)};
    EXPECT_EQ(defineOf(scene, sampled), "64");
    EXPECT_EQ(defineOf(scene, closed), "0");
    const std::string ofSampled = planText(engine::planFrame(scene, Technique::Deferred, sampled));
    const std::string ofClosed = planText(engine::planFrame(scene, Technique::Deferred, closed));
    EXPECT_EQ(ofSampled.find("lobe_"), std::string::npos) << ofSampled;
    EXPECT_NE(ofClosed.find("lobe_shapes"), std::string::npos) << ofClosed;
    EXPECT_NE(ofSampled.find("area lights      sampled"), std::string::npos) << ofSampled;
}

struct SampleFault {
    const char* fault;
    LightType type;
    double roughness; ///< of a metal; below 0: matte
    const char* file; ///< below shaders/lib/
    const char* from;
    const char* to;
};

constexpr SampleFault kSampleFaults[] = {
    {"a density without its cosine", LightType::Rectangle, -1.0, "reflectance/lobe_samples.glsl",
     "density = max(dot(seen.surface.normalLS, toLight), 0.0) * kInversePi", "density = kInversePi"},
    {"the density of the light left out", LightType::Sphere, -1.0, "light/area_samples.glsl",
     "place.density + surfaceDensity(seen, place.toLight)", "surfaceDensity(seen, place.toLight)"},
    {"the density of the lobe left out", LightType::Disk, 0.25, "reflectance/lobe_samples.glsl",
     "density += visibleDensity(lobeDistribution(seen, h), seen.nv, seen.viewerLength)", "density += 0.0"},
    {"a flat light without its facing", LightType::Disk, -1.0, "light/area_samples.glsl",
     "density = distance * distance / (source.size * facing)", "density = distance * distance / source.size"},
    {"a tube's ends counted with its mantle", LightType::Tube, -1.0, "light/area_samples.glsl",
     "mantle * perMetre / (2.0 * source.seenHalf * source.size)", "perMetre / (source.seenHalf * source.size)"},
    {"a polygon met as its rectangle", LightType::Polygon, 0.5, "light/area_samples.glsl",
     "isWithin = isWithinPolygon(within, source.light, int(lightShapeTexel(source.light, LIGHT_SHAPE_TEXELS).z));", ""},
    {"a window that is not squared", LightType::Disk, -1.0, "light/area_samples.glsl", "(window * window /",
     "(window /"},
};

/// Each fault shifts a mean by more than three of its standard errors.
void AreaSamples::expectEveryFaultShows() {
    for (const SampleFault& fault : everyNth(std::vector(std::begin(kSampleFaults), std::end(kSampleFaults)), 4)) {
        SCOPED_TRACE(fault.fault);
        const ShaderMutant shaders;
        shaders.replace("lib/" + std::string(fault.file), fault.from, fault.to);
        scenes::Scene scene =
            pointOf(fault.roughness < 0.0 ? sampledMatte() : twoSidedMetal(1.0, fault.roughness), 0.3);
        engine::Renderer renderer(context(), scene, shaders.tree());
        const SampledMean shown = seen(scene, renderer, overFloor(fault.type), 64);
        const double wanted = integralOf(scene);
        EXPECT_FALSE(std::abs(shown.mean - wanted) <= 3.0 * shown.standardError + 1e-3 * wanted)
            << shown.mean << " +- " << shown.standardError << ", wanted " << wanted;
    }
}
TEST_F(AreaSamples, everyFaultOfADensityShows) {
    expectEveryFaultShows();
}
TEST_F(AreaSamplesSlow, everyFaultOfADensityShows) {
    expectEveryFaultShows();
}

/// A flat light that cuts a surface fills half of the hemisphere of points on the cut; one in the surface lights
/// nothing; one just above it fills the hemisphere of the points below. LTC, samples and reference agree.
void AreaSamples::expectLightOfTouchingOnes() {
    scenes::Scene scene = pointOf(sampledMatte(), 1.0);
    engine::Renderer renderer(context(), scene);
    struct Case {
        std::string name;
        glm::dvec3 at, towards;
        double wanted;
    };
    std::vector<Case> cases;
    for (const double side : {-1.0, 1.0}) {
        cases.push_back({"stands through the point", {}, {side, 0.0, 0.0}, 0.5 * pi});
        cases.push_back({"stands through the surface beside it", {0.0, 3.0, 0.0}, {side, 0.0, 0.0}, 0.0});
        cases.push_back({"lies in the surface", {}, {0.0, 0.0, side}, 0.0});
        cases.push_back({"lies in the surface beside it", {3.0, 0.0, 0.0}, {0.0, 0.0, side}, 0.0});
        cases.push_back({"lies below it", {0.0, 0.0, -1e-4}, {0.0, 0.0, side}, 0.0});
        cases.push_back({"lies above it", {0.0, 0.0, 1e-4}, {0.0, 0.0, side}, pi});
        cases.push_back({"lies above it, beside the point", {3.0, 0.0, 1e-4}, {0.0, 0.0, side}, 0.0});
    }
    frame::FrameSettings closed;
    closed.sizePixels = {3, 3};
    for (const LightType type : inTurn(kFlatTypes, 0))
        for (const auto& [name, at, towards, wanted] : cases) {
            SCOPED_TRACE(fmt::format("{} {}, towards {} {}", scenes::infoOf(type).name, name, towards.x, towards.z));
            scenes::Light light = areaLight(type, at, towards, 1.0f);
            light.isTwoSided = true;
            const SampledMean sampled = seen(scene, renderer, light);
            EXPECT_NEAR(sampled.mean, wanted, 3.0 * sampled.standardError + 2e-3);
            EXPECT_NEAR(integralOf(scene), wanted, 1e-3);
            EXPECT_NEAR(double(renderer.render(Technique::Deferred, closed).radiance[4 * 4]), wanted, 1e-3);
            if (wanted == 0.5 * pi) continue; // points in the light's plane are behind it
            light.isTwoSided = false;         // above the surface, one of the two faces away
            const double ofOneSide = towards.z > 0.0 ? 0.0 : wanted;
            EXPECT_NEAR(seen(scene, renderer, light).mean, ofOneSide, 2e-3);
            EXPECT_NEAR(integralOf(scene), ofOneSide, 1e-3);
            EXPECT_NEAR(double(renderer.render(Technique::Deferred, closed).radiance[4 * 4]), ofOneSide, 1e-3);
        }
}
TEST_F(AreaSamples, lightsThatTouchASurfaceGiveWhatTheyGiveFromCloseBy) {
    expectLightOfTouchingOnes();
}
TEST_F(AreaSamplesSlow, lightsThatTouchASurfaceGiveWhatTheyGiveFromCloseBy) {
    expectLightOfTouchingOnes();
}

/// For any light, radiance is finite and within the noise of a hemisphere of the light's radiance.
TEST_F(AreaSamplesSlow, extremeSizesAndPlacesGiveFiniteLight) {
    for (const double roughness : {0.0, 0.3, 1.0}) {
        scenes::Scene scene = pointOf(twoSidedMetal(0.5, roughness), 0.1);
        engine::Renderer renderer(context(), scene);
        for (const LightType type : kAreaTypes)
            for (const float size : {1e-6f, 1e-2f, 1.0f, 1e3f, 1e6f})
                for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1e-5), glm::dvec3(0.0, 0.0, -0.1),
                                             glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(1e5, 0.0, 1.0)}) {
                    scenes::Light light = areaLight(type, at, {0.3, 0.0, -1.0}, 1.0f);
                    light.alongWS = glm::normalize(glm::cross(light.directionWS, glm::dvec3(0.0, 1.0, 0.0)));
                    light.widthMetres = light.heightMetres = light.lengthMetres = light.radiusMetres = size;
                    for (glm::vec2& corner : light.corners.metres) corner *= size;
                    const double radiance = seen(scene, renderer, light, 4).mean;
                    EXPECT_TRUE(std::isfinite(radiance) && radiance >= 0.0 && radiance <= 2.0)
                        << scenes::infoOf(type).name << " of " << size << " at " << at.x << " " << at.z << ": "
                        << radiance;
                }
    }
}

} // namespace
} // namespace tessera
