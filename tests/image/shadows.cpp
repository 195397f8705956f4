#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/builtin/ShadowTruth.h"
#include "scenes/builtin/Shapes.h"
#include "tests/image/FlatTest.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/reference/CameraRays.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::ShadowRequest;
using test::kAllLightsCast, test::kShadowCases, test::sceneOf, test::ShadowCase, test::WrongPixels, test::wrongPixels;

class Shadows : public test::ShadowTest {};

TEST_F(Shadows, everyTechniqueCastsTheSameToTheLastBit) {
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {201, 113};
        settings.shadows = tried.shadows;
        SCOPED_TRACE(tried.scene);
        expectParity(renderer, settings);
    }
}

TEST_F(Shadows, everyTechniqueCastsTheSameOnMaskedAndTransparentSurfacesAndWithSeveralSamples) {
    const scenes::Scene scene = test::everythingScene();
    engine::Renderer renderer(context(), scene);
    for (const int samples : {1, 4}) {
        frame::FrameSettings settings;
        settings.sizePixels = {160, 90};
        settings.samples = samples;
        settings.shadows = kAllLightsCast;
        expectParity(renderer, settings);
    }
}

TEST_F(Shadows, noPixelIsWrongBeyondRounding) {
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {240, 135};
        settings.filter = frame::TextureFilter::Exact;
        settings.shadows = tried.shadows;
        const WrongPixels count = wrongPixels(renderer, settings);
        fmt::print("{}: {} pixels wrong, {} undecided, {} changed by shadows of {}\n", tried.scene, count.wrong,
                   count.undecided, count.hidden, count.covered);
        EXPECT_EQ(count.wrong, 0u) << tried.scene;
        EXPECT_LE(count.wrongWithout, count.covered / 1000) << tried.scene;
        // Measured: 0.6 % of lattice, 2.5 % of head with its hair, 0.6 % of hall.
        EXPECT_LE(count.undecided, count.covered / 25) << tried.scene;
        EXPECT_GE(count.hidden, count.covered / 200) << tried.scene << ": nothing to see";
    }
}

TEST_F(Shadows, noPixelOfMaskedMirroredAndTexturedSurfacesIsWrong) {
    const scenes::Scene scene = test::everythingScene();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {240, 135};
    settings.filter = frame::TextureFilter::Exact;
    settings.shadows = kAllLightsCast;
    const WrongPixels count = wrongPixels(renderer, settings);
    fmt::print("everything: {} pixels wrong, {} undecided, {} changed by shadows of {}\n", count.wrong, count.undecided,
               count.hidden, count.covered);
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.wrongWithout, count.covered / 1000);
    EXPECT_LE(count.undecided, count.covered / 10);
    EXPECT_GE(count.hidden, count.covered / 20);
}

TEST_F(Shadows, noSunPutsAcneOnASphereAndAPlane) {
    scenes::Scene scene = test::ballUnderSun();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.shadows = kAllLightsCast;
    constexpr int kDirections = 1000;
    std::size_t wrong = 0, undecided = 0, covered = 0;
    for (int i = 0; i < kDirections; ++i) {
        scene.lights[0].directionWS = test::sunDirection(i, kDirections);
        const WrongPixels count = wrongPixels(renderer, settings);
        wrong += count.wrong;
        undecided += count.undecided;
        covered += count.covered;
    }
    fmt::print("{} suns: {} pixels wrong, {} undecided of {}\n", kDirections, wrong, undecided, covered);
    EXPECT_EQ(wrong, 0u);
    EXPECT_LE(undecided, covered / 50);
}

// ---- Shadows whose outlines are known ------------------------------------------------------------------------------

constexpr int kOutlinePixels = 64;

/// A square of 2 m in the plane z = 0, seen from above by parallel rays that it fills, and a square of 0.4 m above it
/// at height 0.5. Nothing else is known of the shadow than where the light is.
class ShadowOutline : public test::FlatTest {
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
        scenes::Light light = test::pointLight({}, 3.0f);
        light.type = scenes::LightType::Directional;
        light.directionWS = glm::normalize(glm::dvec3(1.0, 0.2, -1.0));
        return light;
    }
    static scenes::Light lamp() { return test::pointLight({-1.2, 0.0, 1.5}, 3.0f); }

    /// Where the way from a point of the ground to the light crosses the plane of the plate, in the plate's coordinates
    /// -1 .. 1.
    static glm::dvec2 onPlate(const scenes::Light& light, const glm::dvec3& pointWS) {
        const bool isFar = light.type == scenes::LightType::Directional;
        const glm::dvec3 toLight = isFar ? -light.directionWS : light.positionWS - pointWS;
        const glm::dvec3 crossing = pointWS + toLight * (kCasterWS.z / toLight.z);
        return (glm::dvec2(crossing) - glm::dvec2(kCasterWS)) / kHalfSide;
    }

    /// How many pixels of the ground are dark in the picture, and how many of them or of the others should not be so.
    struct Outline {
        int dark = 0, wrong = 0;
    };
    template <typename IsHidden>
    Outline outline(const scenes::Scene& scene, const IsHidden& isHidden, frame::FrameSettings settings = {}) {
        return outlineOf(scene, scene.lights[0], isHidden, settings);
    }
    Outline outlineOf(const scenes::Scene& scene, const scenes::Light& light) {
        return outlineOf(scene, light, isInSquare, {});
    }
    template <typename IsHidden>
    Outline outlineOf(const scenes::Scene& scene, const scenes::Light& light, const IsHidden& isHidden,
                      frame::FrameSettings settings) {
        settings.sizePixels = glm::ivec2(kOutlinePixels);
        engine::Renderer renderer(context(), scene);
        const engine::RenderedFrame picture = renderer.render(Technique::Deferred, settings);
        Outline found;
        for (int y = 0; y < kOutlinePixels; ++y) {
            for (int x = 0; x < kOutlinePixels; ++x) {
                const glm::dvec3 pointWS((x + 0.5) * 2.0 / kOutlinePixels - 1.0, 1.0 - (y + 0.5) * 2.0 / kOutlinePixels,
                                         0.0);
                const glm::dvec2 apart = glm::abs(glm::dvec2(pointWS) - glm::dvec2(kCasterWS));
                if (std::max(apart.x, apart.y) < kHalfSide) continue; // the plate itself
                const bool isDark = picture.radiance[4 * std::size_t(y * kOutlinePixels + x)] == 0.0f;
                found.dark += isDark;
                found.wrong += isDark != isHidden(onPlate(light, pointWS));
            }
        }
        return found;
    }
    static bool isInSquare(const glm::dvec2& place) { return std::max(std::abs(place.x), std::abs(place.y)) < 1.0; }
    static bool isNever(const glm::dvec2&) { return false; }
    void expectShadow(const scenes::Scene& scene, frame::FrameSettings settings = {}) {
        const Outline found = outline(scene, isInSquare, settings);
        EXPECT_EQ(found.wrong, 0);
        EXPECT_GT(found.dark, 50);
    }
    void expectNone(const scenes::Scene& scene, frame::FrameSettings settings = {}) {
        EXPECT_EQ(outline(scene, isNever, settings).wrong, 0);
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
        // Turned away its single side is not drawn: what is below it shows, and it casts all the same.
        expectShadow(scene);
        scene.materials[1].doubleSided = true;
        expectShadow(scene);
    }
}

TEST_F(ShadowOutline, hasTheHolesOfAMask) {
    scenes::Scene scene = plateUnder(sun());
    scene.images = {test::image8([](int x, int y) { return std::array{255, 255, 255, (x + y) % 2 == 0 ? 255 : 0}; })};
    scene.materials[1].alphaMode = scenes::AlphaMode::Mask;
    scenes::TextureUse& use = scene.materials[1].texture(scenes::TextureSlot::BaseColor);
    use.image = 0;
    use.sampler.magnification = scenes::Filter::Nearest;
    for (const scenes::Wrap wrap : {scenes::Wrap::Repeat, scenes::Wrap::MirroredRepeat, scenes::Wrap::ClampToEdge}) {
        use.sampler.wrapU = use.sampler.wrapV = wrap;
        use.transform.offset = {1.0f, 0.0f}; // another copy of the picture
        const auto isHidden = [&](const glm::dvec2& place) {
            if (!isInSquare(place)) return false;
            const int row = int(4.0 * (1.0 - place.y));
            int column = int(4.0 * (place.x + 1.0));
            if (wrap == scenes::Wrap::MirroredRepeat) column = 7 - column;
            if (wrap == scenes::Wrap::ClampToEdge) column = 7;
            return (column + row) % 2 == 0;
        };
        const Outline found = outline(scene, isHidden);
        EXPECT_EQ(found.wrong, 0) << int(wrap);
        EXPECT_GT(found.dark, 50);
    }
    // All of a mask's own opacity is below the cutoff.
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
    const scenes::Scene unasked = with([](scenes::Scene& scene) { scene.lights[0].castsShadow = false; });
    settings.shadows = {ShadowRequest::Kind::First, 1};
    expectShadow(unasked, settings);
    settings.shadows = kAllLightsCast;
    expectShadow(unasked, settings);
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

TEST_F(ShadowOutline, fallsOnTransparentSurfaces) {
    scenes::Scene scene = plateUnder(lamp());
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    expectShadow(scene);
}

TEST_F(ShadowOutline, staysWhereItIsFarFromTheOriginAndAtAnySize) {
    for (const double scale : {1e-4, 1.0, 1e4}) {
        for (const glm::dvec3& placeWS : {glm::dvec3(0.0), glm::dvec3(1e6, -1e6, 1e6)}) {
            scenes::Scene scene = plateUnder(lamp());
            const glm::dmat4 moved =
                glm::translate(glm::dmat4(1.0), placeWS) * glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
            if (glm::length(placeWS) > 0.0 && scale < 1.0) continue; // doubles have no digits for 0.1 mm there
            for (scenes::Node& node : scene.nodes) node.parentFromNode = moved * node.parentFromNode;
            scenes::Camera& camera = scene.cameras[0];
            camera.worldFromCamera[3] = glm::dvec4(placeWS + scale * glm::dvec3(camera.worldFromCamera[3]), 1.0);
            camera.halfHeightMetres *= scale;
            camera.nearMetres *= scale;
            scene.lights[0].positionWS = placeWS + scale * scene.lights[0].positionWS;
            scene.lights[0].intensity *= float(scale * scale);
            SCOPED_TRACE(fmt::format("{} times as large at {}", scale, placeWS.x));
            // In the coordinates of the scene as it was.
            scenes::Light here = lamp();
            const Outline found = outlineOf(scene, here);
            EXPECT_EQ(found.wrong, 0);
            EXPECT_GT(found.dark, 50);
        }
    }
}

// ---- Soft shadows --------------------------------------------------------------------------------------------------

/// The ground of the scene `shadow_truth` as a frame of the view `shadow` shows it: the shares of one light that are
/// seen there, beside the true ones.
class SoftShadows : public Shadows {
protected:
    using TruthLight = scenes::builtin::ShadowTruthLight;
    struct Share {
        double seen, truth;
    };

    static scenes::Scene truthScene() {
        scenes::Scene scene = scenes::loadScene("shadow_truth");
        // Below the plate, and above the ground in the disk's shadow.
        scenes::Camera& camera = scene.cameras[0];
        camera.projection = scenes::Projection::Orthographic;
        camera.halfHeightMetres = 0.4;
        return scene;
    }
    /// Looks where the light's shadow is.
    static void aimAt(scenes::Scene& scene, TruthLight light) {
        const glm::dvec3 targetWS =
            light == TruthLight::Lamp ? glm::dvec3(-2.55, 0.0, 0.0) : glm::dvec3(2.56, 0.0, 0.24);
        scene.cameras[0].worldFromCamera = scenes::worldFromLookAt(targetWS + glm::dvec3(0.4, 0.9, 3.0), targetWS);
    }

    static std::vector<Share> sharesOf(const scenes::Scene& scene, TruthLight light, const glm::ivec2& sizePixels,
                                       const auto& seenAt) {
        const reference::CameraRays rays(scene.cameras[0], sizePixels);
        reference::Settings settings;
        settings.sizePixels = sizePixels;
        settings.camera = scene.cameras[0];
        const reference::Probe probe(scene, settings);
        std::vector<Share> shares;
        for (int y = 0; y < sizePixels.y; ++y) {
            for (int x = 0; x < sizePixels.x; ++x) {
                if (probe.at(glm::dvec2(x + 0.5, y + 0.5)).ids.object != 1) continue; // not the ground
                const reference::Ray ray = rays.through(x, y);
                const double depth = -(rays.eyeWS().y + ray.originRWS.y) / ray.direction.y;
                const glm::dvec3 groundWS = rays.eyeWS() + ray.at(depth);
                const bool isKnown =
                    light == TruthLight::Lamp ? std::abs(groundWS.z) < 1.5 && groundWS.x > -4.0 : groundWS.x > 0.5;
                if (isKnown) shares.push_back({seenAt(x, y), shadowTruthShare(light, groundWS)});
            }
        }
        return shares;
    }

    std::vector<Share> rendered(engine::Renderer& renderer, TruthLight light, int samples) {
        frame::FrameSettings settings;
        settings.sizePixels = {256, 144};
        settings.view = frame::DebugView::Shadow;
        settings.soloLight = int(light);
        settings.shadowSamples = samples;
        const engine::RenderedFrame frame = renderer.render(Technique::Deferred, settings);
        return sharesOf(renderer.scene(), light, settings.sizePixels, [&](int x, int y) {
            return double(frame.radiance[4 * (std::size_t(y) * 256 + std::size_t(x))]);
        });
    }
};

double rootMeanSquare(const auto& shares) {
    double sum = 0.0;
    for (const auto& [seen, truth] : shares) sum += (seen - truth) * (seen - truth);
    return std::sqrt(sum / double(shares.size()));
}

TEST_F(SoftShadows, haveTheSharesOfTheirClosedFormsWithinThreeStandardErrors) {
    for (const TruthLight light : {TruthLight::Lamp, TruthLight::Sun}) {
        scenes::Scene scene = truthScene();
        aimAt(scene, light);
        engine::Renderer renderer(context(), scene);
        for (const int samples : {1, 16, 64}) {
            const std::vector<Share> shares = rendered(renderer, light, samples);
            constexpr int kBins = 8;
            int checked = 0;
            for (int bin = 0; bin < kBins; ++bin) {
                double sum = 0.0, squares = 0.0;
                int count = 0;
                for (const auto& [seen, truth] : shares) {
                    if (truth <= 0.0 || truth >= 1.0 || int(truth * kBins) != bin) continue;
                    sum += seen - truth;
                    squares += (seen - truth) * (seen - truth);
                    ++count;
                }
                if (count < 100) continue;
                ++checked;
                const double mean = sum / count, standardError = std::sqrt((squares / count - mean * mean) / count);
                EXPECT_LE(std::abs(mean), 3.0 * standardError)
                    << int(light) << ", " << samples << " samples, shares from " << double(bin) / kBins;
            }
            EXPECT_GE(checked, 6);
            fmt::print("light {}, {} samples: RMS {:.5f} of {} pixels\n", int(light), samples, rootMeanSquare(shares),
                       shares.size());
        }
    }
}

TEST_F(SoftShadows, getBetterWithSamplesAndAreAllOrNothingOutsidePenumbrae) {
    scenes::Scene scene = truthScene();
    aimAt(scene, TruthLight::Lamp);
    engine::Renderer renderer(context(), scene);
    double before = 1.0;
    for (const int samples : {1, 4, 16, 64}) {
        const std::vector<Share> shares = rendered(renderer, TruthLight::Lamp, samples);
        const double error = rootMeanSquare(shares);
        EXPECT_LT(error, before / 2.0) << samples; // of random samples half, of these less
        before = error;
        int wrong = 0;
        for (const auto& [seen, truth] : shares) wrong += (truth == 0.0 || truth == 1.0) && seen != truth;
        EXPECT_LE(wrong, int(shares.size() / 1000)) << "the edges of penumbrae, to rounding";
    }
}

TEST_F(SoftShadows, ofTheReferenceHaveTheirClosedForms) {
    for (const TruthLight light : {TruthLight::Lamp, TruthLight::Sun}) {
        scenes::Scene scene = truthScene();
        aimAt(scene, light);
        double before = 0.0;
        for (const int rings : {8, 16}) {
            reference::Settings settings;
            settings.sizePixels = {96, 54};
            settings.camera = scene.cameras[0];
            settings.soloLight = int(light);
            settings.leeway = false;
            settings.shadowRings = rings;
            const reference::Rendered shadowed = reference::render(scene, settings);
            settings.shadows = {ShadowRequest::Kind::None};
            const reference::Rendered lit = reference::render(scene, settings);
            const std::vector<Share> shares = sharesOf(scene, light, settings.sizePixels, [&](int x, int y) {
                const std::size_t at = std::size_t(y) * 96 + std::size_t(x);
                return shadowed.radiance[at].r / lit.radiance[at].r;
            });
            const double error = rootMeanSquare(shares);
            fmt::print("reference, light {}, {} rings: RMS {:.6f}\n", int(light), rings, error);
            EXPECT_LT(error, 4e-3);
            if (before > 0.0) {
                EXPECT_LT(error, 0.6 * before);
            }
            before = error;
        }
    }
}

TEST_F(SoftShadows, areTheSameWhateverElseIsLeftOut) {
    scenes::Scene scene = scenes::loadScene("shadow_truth");
    // One that gives nothing, which only frames that are not pruned evaluate, before the others.
    scenes::Light dark = scene.lights[0];
    dark.intensity = 0.0f;
    scene.lights.insert(scene.lights.begin(), dark);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {161, 91};
    settings.shadowSamples = 3;
    const std::vector<float> pruned = renderer.render(Technique::Deferred, settings).radiance;
    settings.prune = false;
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, pruned);
}

TEST_F(SoftShadows, areTheSameWithEveryTechniqueToTheLastBit) {
    const scenes::Scene scene = scenes::loadScene("shadow_truth");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {161, 91};
    settings.shadowSamples = 5;
    expectParity(renderer, settings);
}

TEST_F(SoftShadows, ofAPictureAreWithinTheirNoiseOfTheReference) {
    const scenes::Scene scene = scenes::loadScene("shadow_truth");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {160, 90};
    for (const int samples : {4, 16}) {
        settings.shadowSamples = samples;
        validation::CompareRequest request;
        request.techniques = {Technique::Forward};
        request.against = validation::Reference{};
        request.settings = settings;
        const validation::CompareRecord record =
            validation::compareTechniques(renderer, context().capabilities(), request).record;
        EXPECT_TRUE(record.ok()) << validation::compareTable(record);
    }
}

} // namespace
} // namespace tessera
