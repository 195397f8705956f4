#include <numbers>
#include <type_traits>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/FlatTest.h"
#include "tests/image/ShadowTest.h"
#include "validation/stress/StressScene.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using scenes::ShadowRequest;
using namespace test;

constexpr int kOutlinePixels = 64;

/// A shadow filter without penumbrae, and how far it may displace an outline on the plate.
struct OutlineWay {
    ShadowFilter filter;
    double toleranceMetres;
};
/// A face spans at most 3.4 m: the scene's bounding sphere has a radius of 1.44 m, which is 1.68 m in the size steps of
/// cascades. So one of 2048 texels is 1.7 mm wide, and on the plate, which all lights meet obliquely, at most 3 mm.
constexpr OutlineWay kOutlineWays[] = {{ShadowFilter::Traced, 0.0}, {ShadowFilter::Hard, 3e-3}};
constexpr int kMapTexels = 2048;

/// A square of 2 m in the plane z = 0 that fills the image of parallel rays from above, and a square of 0.4 m above it
/// at height 0.5. The expected shadow follows from the light's position alone.
class ShadowOutline : public FlatTest {
protected:
    static constexpr glm::dvec3 kCasterWS{-0.4, 0.1, 0.5};
    static constexpr double kHalfSide = 0.2;

    static scenes::Scene plateUnder(const scenes::Light& light) {
        scenes::Material ground;
        ground.name = "ground";
        ground.model = scenes::MaterialModel::Lambert;
        scenes::Scene scene = flatScene(ground);
        ground.name = "plate";
        scene.materials.push_back(ground);
        scenes::Node& plate = scene.nodes.emplace_back();
        plate.name = "plate";
        plate.parentFromNode =
            glm::translate(glm::dmat4(1.0), kCasterWS) * glm::scale(glm::dmat4(1.0), glm::dvec3(kHalfSide));
        plate.instances = {{0, 1}};
        scene.lights = {light};
        scene.lights[0].castsShadow = true;
        return scene;
    }
    static scenes::Light sun() {
        scenes::Light light = sunLight(glm::dvec3(1.0, 0.2, -1.0), 3.0f);
        return light;
    }
    static scenes::Light lamp() { return pointLight({-1.2, 0.0, 1.5}, 3.0f); }

    /// Where the line from a point of the ground to the light crosses the plane of the plate, in the plate's
    /// coordinates -1 .. 1.
    static glm::dvec2 onPlate(const scenes::Light& light, const glm::dvec3& pointWS) {
        const bool isFar = light.type == scenes::LightType::Directional;
        const glm::dvec3 toLight = isFar ? -light.directionWS : light.positionWS - pointWS;
        const glm::dvec3 crossing = pointWS + toLight * (kCasterWS.z / toLight.z);
        return (glm::dvec2(crossing) - glm::dvec2(kCasterWS)) / kHalfSide;
    }

    static bool isInSquare(const glm::dvec2& place) { return std::max(std::abs(place.x), std::abs(place.y)) < 1.0; }
    static bool isNever(const glm::dvec2&) { return false; }

    /// Counts of ground pixels: those that are dark, those that are wrong, and those so near to an outline that either
    /// is right.
    struct Outline {
        int dark = 0, wrong = 0, undecided = 0;
    };
    template <typename IsHidden>
    Outline outline(const scenes::Scene& scene, const scenes::Light& light, const IsHidden& isHidden,
                    const OutlineWay& way, frame::FrameSettings settings) {
        settings.sizePixels = glm::ivec2(kOutlinePixels);
        settings.shadowFilter = way.filter;
        settings.shadowMaps.resolutionTexels = kMapTexels;
        settings.shadowMaps.budgetMiB = 1024.0;
        const engine::RenderedFrame picture = frameOf(scene, settings);
        Outline found;
        for (int y = 0; y < kOutlinePixels; ++y)
            for (int x = 0; x < kOutlinePixels; ++x) {
                const glm::dvec3 pointWS((x + 0.5) * 2.0 / kOutlinePixels - 1.0, 1.0 - (y + 0.5) * 2.0 / kOutlinePixels,
                                         0.0);
                const glm::dvec2 apart = glm::abs(glm::dvec2(pointWS) - glm::dvec2(kCasterWS));
                if (std::max(apart.x, apart.y) < kHalfSide) continue; // the plate itself
                const bool isDark = picture.radiance[4 * std::size_t(y * kOutlinePixels + x)] == 0.0f;
                const glm::dvec2 place = onPlate(light, pointWS);
                const bool hidden = isHidden(place);
                const double tolerance = way.toleranceMetres / kHalfSide;
                bool isUndecided = false;
                for (const glm::dvec2& step : {glm::dvec2(1.0), glm::dvec2(1.0, -1.0)})
                    for (const double side : {-tolerance, tolerance})
                        isUndecided = isUndecided || isHidden(place + side * step) != hidden;
                found.dark += isDark;
                found.undecided += isUndecided;
                found.wrong += !isUndecided && isDark != hidden;
            }
        return found;
    }
    /// Expects a shadow there, or (`isNever`) none, with every filter of kOutlineWays.
    template <typename IsHidden>
    void expectShadowAt(const scenes::Scene& scene, const scenes::Light& light, const IsHidden& isHidden,
                        const frame::FrameSettings& settings = {}) {
        for (const OutlineWay& way : kOutlineWays) {
            SCOPED_TRACE(infoOf(way.filter).name);
            const Outline found = outline(scene, light, isHidden, way, settings);
            EXPECT_EQ(found.wrong, 0);
            if constexpr (!std::is_same_v<IsHidden, decltype(isNever)>) {
                EXPECT_GT(found.dark, 50);
                EXPECT_LT(found.undecided, found.dark / 4);
            }
        }
    }
    void expectShadow(const scenes::Scene& scene, const frame::FrameSettings& settings = {}) {
        expectShadowAt(scene, scene.lights[0], isInSquare, settings);
    }
    void expectNone(const scenes::Scene& scene, const frame::FrameSettings& settings = {}) {
        expectShadowAt(scene, scene.lights[0], isNever, settings);
    }
};

TEST_F(ShadowOutline, isWhereStraightLinesToTheLightCrossTheCaster) {
    scenes::Light spot = lamp();
    spot.type = scenes::LightType::Spot;
    spot.directionWS = glm::normalize(glm::dvec3(1.0, 0.0, -1.5));
    spot.outerConeRadians = spot.innerConeRadians = 1.4f;
    for (const scenes::Light& light : {sun(), lamp(), spot}) expectShadow(plateUnder(light));
}

TEST_F(ShadowOutline, isTheSameOfMirroredAndTurnedAndTwoSidedCasters) {
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0.0, 1.0, 0.0));
    for (const glm::dmat4& change : {mirror, turn, turn * mirror}) {
        scenes::Scene scene = plateUnder(lamp());
        scene.nodes[1].parentFromNode *= change;
        // Facing away, its single side is not drawn: the ground below shows, and it casts all the same.
        expectShadow(scene);
        scene.materials[1].doubleSided = true;
        expectShadow(scene);
    }
}

TEST_F(ShadowOutline, hasTheHolesOfAMask) {
    scenes::Scene scene = plateUnder(sun());
    scene.images = {image8([](int x, int y) { return std::array{255, 255, 255, (x + y) % 2 == 0 ? 255 : 0}; })};
    scene.materials[1].alphaMode = scenes::AlphaMode::Mask;
    scenes::TextureUse& use = scene.materials[1].texture(scenes::TextureSlot::BaseColor);
    use.image = 0;
    use.sampler.magnification = scenes::Filter::Nearest;
    for (const scenes::Wrap wrap : {scenes::Wrap::Repeat, scenes::Wrap::MirroredRepeat, scenes::Wrap::ClampToEdge}) {
        use.sampler.wrapU = use.sampler.wrapV = wrap;
        use.transform.offset = {1.0f, 0.0f}; // another repetition of the texture
        const auto isHidden = [&](const glm::dvec2& place) {
            if (!isInSquare(place)) return false;
            const int row = int(4.0 * (1.0 - place.y));
            int column = int(4.0 * (place.x + 1.0));
            if (wrap == scenes::Wrap::MirroredRepeat) column = 7 - column;
            if (wrap == scenes::Wrap::ClampToEdge) column = 7;
            return (column + row) % 2 == 0;
        };
        SCOPED_TRACE(int(wrap));
        expectShadowAt(scene, scene.lights[0], isHidden);
    }
    // All of the mask's opacity is below the cutoff.
    scene.materials[1].baseColor.w = 0.25f;
    expectNone(scene);
}

TEST_F(ShadowOutline, isThereOnlyWhereLightMaterialAndNodeCastOne) {
    const auto with = [&](const auto& change) {
        scenes::Scene scene = plateUnder(lamp());
        change(scene);
        return scene;
    };
    expectNone(with([](scenes::Scene& scene) { scene.lights[0].castsShadow = false; }));
    expectNone(with([](scenes::Scene& scene) { scene.materials[1].castsShadow = false; }));
    expectNone(with([](scenes::Scene& scene) { scene.nodes[1].instances[0].castsShadow = false; }));
    expectNone(with([](scenes::Scene& scene) { scene.materials[1].alphaMode = scenes::AlphaMode::Blend; }));
    frame::FrameSettings settings;
    settings.shadows = {ShadowRequest::Kind::None};
    expectNone(plateUnder(lamp()), settings);
    settings.shadows = {ShadowRequest::Kind::First, 0};
    expectNone(plateUnder(lamp()), settings);
    const scenes::Scene unshadowed = with([](scenes::Scene& scene) { scene.lights[0].castsShadow = false; });
    settings.shadows = {ShadowRequest::Kind::First, 1};
    expectShadow(unshadowed, settings);
    settings.shadows = kAllLightsCast;
    expectShadow(unshadowed, settings);
}

TEST_F(ShadowOutline, isPlannedOnlyWhereThereIsOne) {
    const auto mentions = [](const scenes::Scene& scene) {
        const graph::Plan plan = engine::planFrame(scene, Technique::ClusteredDeferred, {});
        int count = 0;
        for (const graph::Plan::Resource& resource : plan.resources)
            count += resource.name == "shadows" || resource.name == "casters";
        for (const graph::Plan::Choice& choice : plan.choices) count += choice.what == "shadows";
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::ClusteredDeferred, {}))
            for (const auto& [name, value] : program.defines) count += name == "HAS_SHADOWS" && value == "1";
        return count;
    };
    scenes::Scene scene = plateUnder(lamp());
    EXPECT_GE(mentions(scene), 4);
    for (scenes::Material& material : scene.materials) material.castsShadow = false;
    EXPECT_EQ(mentions(scene), 0) << "nothing casts";
    scene = plateUnder(lamp());
    scene.lights[0].castsShadow = false;
    EXPECT_EQ(mentions(scene), 0) << "no light casts";
}

// For a lamp in a ceiling, rounding would decide whether it shines. Maps do not contain edge-on triangles.
TEST_F(ShadowOutline, isNotThatOfATriangleWhosePlaneHoldsTheLamp) {
    for (int i = 0; i < 8; ++i) {
        scenes::Scene scene = plateUnder(lamp());
        glm::dmat4& plate = scene.nodes[1].parentFromNode;
        plate *= glm::rotate(glm::dmat4(1.0), 0.3 + 0.1 * i, glm::normalize(glm::dvec3(1.0, 0.3, 0.2)));
        scene.lights[0].positionWS = glm::dvec3(plate * glm::dvec4(0.31, 0.07 * i - 0.2, 0.0, 1.0));
        SCOPED_TRACE(i);
        EXPECT_EQ(outline(scene, scene.lights[0], isNever, kOutlineWays[0], {}).wrong, 0);
    }
}

TEST_F(ShadowOutline, fallsOnTransparentSurfaces) {
    scenes::Scene scene = plateUnder(lamp());
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    expectShadow(scene);
}

TEST_F(ShadowOutline, staysWhereItIsFarFromTheOriginAndAtAnySize) {
    for (const double scale : {1e-4, 1.0, 1e4})
        for (const glm::dvec3& placeWS : {glm::dvec3(0.0), glm::dvec3(1e6, -1e6, 1e6)}) {
            scenes::Scene scene = plateUnder(lamp());
            if (glm::length(placeWS) > 0.0 && scale < 1.0) continue; // doubles have no digits for 0.1 mm there
            validation::moveScene(scene, scale, placeWS);
            SCOPED_TRACE(fmt::format("{} times as large at {}", scale, placeWS.x));
            // In the coordinates of the original scene.
            expectShadowAt(scene, lamp(), isInSquare);
        }
}

// The filter is seven texels of 5 cm wide; a pixel of 8 mm is a fiftieth of that.
TEST_F(ShadowOutline, ofPcfIsGradualOnASlopeToo) {
    for (const double height : {2.0, 1.0, 0.5}) {
        scenes::Light light = sun();
        light.directionWS = glm::normalize(glm::dvec3(1.0, 0.0, -height));
        const scenes::Scene scene = plateUnder(light);
        frame::FrameSettings settings = withView(ofSize(256, 256), frame::DebugView::Shadow);
        settings.shadowFilter = frame::ShadowFilter::Pcf;
        settings.shadowMaps.widthTexels = 7;
        settings.shadowMaps.resolutionTexels = 64;
        settings.shadowMaps.cascades = 1;
        const std::vector<float> seen = drawn(scene, settings);
        float largest = 0.0f;
        int partly = 0;
        for (std::size_t y = 0; y < 256; ++y)
            for (std::size_t x = 0; x + 1 < 256; ++x) {
                const glm::dvec3 placeWS((double(x) + 0.5) / 128.0 - 1.0, 1.0 - (double(y) + 0.5) / 128.0, 0.0);
                const glm::dvec2 toPlate = glm::abs(glm::dvec2(placeWS - kCasterWS));
                if (std::max(toPlate.x, toPlate.y) < kHalfSide + 0.02) continue; // the plate itself
                const float here = seen[4 * (256 * y + x)], beside = seen[4 * (256 * y + x + 1)];
                partly += here > 0.0f && here < 1.0f;
                largest = std::max(largest, std::abs(here - beside));
            }
        fmt::print("pcf at {} of 45 degrees: largest step {:.3f} among {} pixels\n", height, largest, partly);
        EXPECT_GT(partly, 500);
        EXPECT_LT(largest, 0.05f) << height;
    }
}

/// Flips the plate at this height: it is drawn only from below, so that the ground is visible through it.
scenes::Scene plateSeenThrough(scenes::Scene scene, double heightMetres) {
    glm::dmat4& plate = scene.nodes[1].parentFromNode;
    plate[3].z = heightMetres;
    plate *= glm::rotate(glm::dmat4(1.0), glm::radians(180.0), glm::dvec3(1.0, 0.0, 0.0));
    return scene;
}

// The filter is a square of texels on the triangle, as viewed from the light: seven texels wide even where the light's
// own square of texels would extend 3.2 times as far along the ground. The light is 3 m aside per metre of height.
TEST_F(ShadowOutline, ofPcfIsAsWideOnASteepSlopeAsAcrossTheLight) {
    scenes::Light light = sun();
    light.directionWS = glm::normalize(glm::dvec3(3.0, 0.0, -1.0));
    constexpr double kAboveMetres = 0.1;
    const scenes::Scene scene = plateSeenThrough(plateUnder(light), kAboveMetres);
    frame::FrameSettings settings = withView(ofSize(256, 256), frame::DebugView::Shadow);
    settings.shadowFilter = frame::ShadowFilter::Pcf;
    settings.shadowMaps.widthTexels = 7;
    settings.shadowMaps.resolutionTexels = 256;
    settings.shadowMaps.cascades = 1;
    const std::vector<float> seen = drawn(scene, settings);
    // The scene's bounding sphere has a radius of 1.42 m, which is 1.68 m in the size steps of cascades.
    const double texelMetres = 2.0 * 1.68179 / (256.0 - 2.0 * 5.0);
    const std::size_t row = std::size_t((1.0 - kCasterWS.y) * 128.0);
    int partly = 0, dark = 0;
    for (std::size_t x = 0; x < 256; ++x) {
        const float share = seen[4 * (256 * row + x)];
        partly += share > 0.0f && share < 1.0f;
        dark += share == 0.0f;
    }
    const double widthMetres = partly / 2.0 / 128.0; // of one edge
    fmt::print("{:.1f} texels wide, {} pixels dark\n", widthMetres / texelMetres, dark);
    EXPECT_NEAR(widthMetres / texelMetres, 7.0, 1.0);
    // Each of its edges lies on a border between texels.
    EXPECT_NEAR((dark + 0.5 * partly) / 128.0, 2.0 * kHalfSide, std::sqrt(10.0) * texelMetres);
}

// The filter's square of texels is centred on the point.
TEST_F(ShadowOutline, ofPcfLiesInTheMiddleBelowAPlate) {
    scenes::Light light = sun();
    light.directionWS = {0.0, 0.0, -1.0};
    frame::FrameSettings settings = withView(ofSize(256, 256), frame::DebugView::Shadow);
    settings.shadowFilter = frame::ShadowFilter::Pcf;
    settings.shadowMaps.widthTexels = 7;
    settings.shadowMaps.resolutionTexels = 256;
    settings.shadowMaps.cascades = 1;
    const std::vector<float> seen = drawn(plateSeenThrough(plateUnder(light), 0.1), settings);
    glm::dvec2 sum(0.0);
    double dark = 0.0;
    for (std::size_t i = 0; i < 256 * 256; ++i) {
        const double here = 1.0 - double(seen[4 * i]);
        sum += here * glm::dvec2(double(i % 256) + 0.5, 255.5 - double(i / 256));
        dark += here;
    }
    const glm::dvec2 middleWS = sum / dark / 128.0 - 1.0;
    const double texelMetres = 2.0 * 1.68179 / (256.0 - 2.0 * 5.0);
    // Each of its edges lies on a border between texels.
    EXPECT_LT(glm::distance(middleWS, glm::dvec2(kCasterWS)), texelMetres);
}

// A light that grazes the ground, 7 m aside per metre of height, and a wall across its way. Half a texel on the ground
// is 3.5 texels deep for the light, so that the ground's depth may be as far off. But behind a wall that fills the next
// texel, on the ground's upper side, the ground is dark from a texel on. A texel covers 0.19 m of ground, within which
// the wall's foot has eight places. Every second scene is turned by 45 degrees, so that the ground is steep along the
// map's columns instead of its rows. Half a texel at each end of the wall is left out.
TEST_F(ShadowOutline, ofAWallOnAGrazedSurfaceBeginsWithinATexel) {
    scenes::Light light = sun();
    frame::FrameSettings settings = withView(ofSize(256, 256), frame::DebugView::Shadow);
    settings.shadowFilter = frame::ShadowFilter::Hard;
    settings.shadowMaps.resolutionTexels = 128;
    settings.shadowMaps.cascades = 1;
    // The scene's bounding sphere has a radius of 1.43 m, which is 1.68 m in the size steps of cascades.
    const double texelMetres = 2.0 * 1.68179 / (128.0 - 2.0 * 2.0);
    int behind = 0, lit = 0, before = 0, dark = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), glm::radians(i % 2 * 45.0), glm::dvec3(0.0, 0.0, 1.0));
        light.directionWS = glm::dmat3(turn) * glm::normalize(glm::dvec3(7.0, 0.0, -1.0));
        const glm::dvec3 foot(-0.5 + 0.024 * i, kCasterWS.y, 0.0);
        scenes::Scene scene = plateUnder(light);
        scene.nodes[1].parentFromNode = turn * glm::translate(glm::dmat4(1.0), foot) *
                                        glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(0.0, 1.0, 0.0)) *
                                        glm::scale(glm::dmat4(1.0), glm::dvec3(kHalfSide));
        const std::vector<float> seen = drawn(scene, settings);
        for (std::size_t y = 0; y < 256; ++y)
            for (std::size_t x = 0; x < 256; ++x) {
                const glm::dvec2 placeWS((double(x) + 0.5) / 128.0 - 1.0, 1.0 - (double(y) + 0.5) / 128.0);
                const glm::dvec2 place = placeWS * glm::dmat2(turn); // turned back
                if (std::abs(place.y - foot.y) > kHalfSide - 0.5 * texelMetres) continue;
                const double texels = (place.x - foot.x) / texelMetres;
                const bool isLit = seen[4 * (256 * y + x)] > 0.0f;
                behind += texels > 1.1 && texels < 3.5;
                lit += texels > 1.1 && texels < 3.5 && isLit;
                before += texels < -1.5;
                dark += texels < -1.5 && !isLit;
            }
    }
    fmt::print("{} of {} behind the wall lit, {} of {} before it dark\n", lit, behind, dark, before);
    EXPECT_GT(behind, 1000);
    EXPECT_EQ(lit, 0);
    EXPECT_EQ(dark, 0);
}

// The edge of a plate in front of the sun's disk, and of another that hides none of it, 0.36 m aside, where casters are
// searched for within 0.26 m at most. The fraction of a disk that a straight edge leaves has a closed form.
TEST_F(ShadowOutline, ofPcssIgnoresCastersBesideTheLight) {
    constexpr double kTangent = 0.14, kLowMetres = 0.2, kHighMetres = 0.6, kHighEdge = 0.36;
    scenes::Light light = sun();
    light.directionWS = glm::normalize(glm::dvec3(1.0, 0.0, -1.0));
    light.angularRadiusRadians = float(std::atan(kTangent));
    scenes::Scene scene = plateUnder(light);
    const auto placed = [](const glm::dvec3& middleWS, double halfDepth) {
        return glm::translate(glm::dmat4(1.0), middleWS) * glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, halfDepth, 1.0));
    };
    scene.nodes[1].parentFromNode = placed({0.0, -0.5, kLowMetres}, 0.5);
    scene.nodes.push_back(scene.nodes[1]);
    scene.nodes[2].parentFromNode = placed({0.0, kHighEdge + 0.3, kHighMetres}, 0.3);
    frame::FrameSettings settings = withView(ofSize(256, 256), frame::DebugView::Shadow);
    settings.shadowFilter = frame::ShadowFilter::Pcss;
    settings.shadowSamples = 64;
    settings.shadowMaps.resolutionTexels = 2048;
    settings.shadowMaps.cascades = 1;
    const std::vector<float> seen = drawn(scene, settings);
    const double halfWidth = kTangent * kLowMetres * std::sqrt(2.0);
    double squares = 0.0;
    int count = 0;
    for (std::size_t y = 0; y < 256; ++y)
        for (std::size_t x = 0; x < 256; ++x) {
            const glm::dvec2 placeWS((double(x) + 0.5) / 128.0 - 1.0, 1.0 - (double(y) + 0.5) / 128.0);
            const double beside = placeWS.y / halfWidth;
            if (std::abs(placeWS.x) > 0.3 || beside < 0.1 || beside > 1.0) continue;
            const double share =
                1.0 - (std::acos(beside) - beside * std::sqrt(1.0 - beside * beside)) / std::numbers::pi;
            const double error = double(seen[4 * (256 * y + x)]) - share;
            squares += error * error;
            ++count;
        }
    const double error = std::sqrt(squares / count);
    fmt::print("RMS {:.4f} of {} pixels\n", error, count);
    EXPECT_GT(count, 200);
    EXPECT_LT(error, 0.03);
}

} // namespace
} // namespace tessera
