#include <chrono>
#include <filesystem>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "base/Error.h"
#include "engine/Settings.h"
#include "scenes/Defaults.h"
#include "tests/image/ImageTest.h"
#include "tests/support/AnimatedModels.h"
#include "tests/support/TempFolder.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

std::vector<std::filesystem::path> modelsBelow(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> models;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        const bool model = extension == ".gltf" || extension == ".glb" || extension == ".obj";
        if (entry.is_regular_file() && model) models.push_back(entry.path());
    }
    std::ranges::sort(models);
    return models;
}

constexpr const char* kSunName = "sun of the test";

/// Light for models without any: a studio, whose programs take long to compile, or a sun along the view.
enum class LitBy { Studio, Sun };

void addSun(scenes::Scene& scene) {
    scenes::Light& sun = scene.lights.emplace_back();
    sun.name = kSunName;
    sun.type = scenes::LightType::Directional;
    sun.intensity = 3.0f;
    sun.directionWS = -glm::dvec3(scene.cameras[0].worldFromCamera[2]);
}

/// The scene from the opposite side, for surfaces that all face away from the default camera.
scenes::Scene fromBehind(scenes::Scene scene) {
    const scenes::Box3 bounds = scenes::worldBounds(scene);
    const glm::dvec3 centerWS = 0.5 * (bounds.min + bounds.max);
    const glm::dvec3 eyeWS = 2.0 * centerWS - glm::dvec3(scene.cameras[0].worldFromCamera[3]);
    scene.cameras[0].worldFromCamera = glm::inverse(glm::lookAt(eyeWS, centerWS, glm::dvec3(0, 1, 0)));
    for (scenes::Light& light : scene.lights)
        if (light.name == kSunName) light.directionWS = -light.directionWS;
    return scene;
}

enum class Verdict { Drawn, DrawsNothing, Refused, Wrong };

bool hasArea(const scenes::Scene& scene) {
    return std::ranges::any_of(scene.meshes, [](const scenes::Mesh& mesh) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto corner = [&](std::size_t at) { return mesh.positionsOS[mesh.indices[i + at]]; };
            if (glm::cross(corner(1) - corner(0), corner(2) - corner(0)) != glm::vec3(0.0f)) return true;
        }
        return false;
    });
}

class Models : public ImageTest {
protected:
    /// Loads and draws one model and prints its line.
    Verdict judge(const std::filesystem::path& model, const std::string& shownName, LitBy light) {
        const auto start = std::chrono::steady_clock::now();
        std::size_t triangles = 0;
        std::string why;
        const Verdict verdict = tryModel(model, light, triangles, why);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        fmt::print("{:<62} {:>8} {:>5.1f} s  {}\n", shownName, triangles, seconds, why);
        return verdict;
    }

    /// All models of a folder, or every fourth by name.
    void sweep(const std::filesystem::path& folder, LitBy light) {
        std::size_t drawn = 0, refused = 0, empty = 0;
        for (const std::filesystem::path& model : everyNth(modelsBelow(folder), 4)) {
            const std::string name = std::filesystem::relative(model, folder).string();
            SCOPED_TRACE(name);
            const Verdict verdict = judge(model, name, light);
            drawn += verdict == Verdict::Drawn;
            refused += verdict == Verdict::Refused;
            empty += verdict == Verdict::DrawsNothing;
        }
        fmt::print("{} drawn, {} draw nothing, {} refused\n", drawn, empty, refused);
        EXPECT_GT(drawn, 0u);
    }

private:
    Verdict tryModel(const std::filesystem::path& model, LitBy light, std::size_t& triangles, std::string& why) {
        try {
            scenes::LoadOptions options;
            options.defaultLight = light == LitBy::Studio;
            scenes::Scene scene = scenes::loadScene(model.string(), options);
            if (light == LitBy::Sun && scene.lights.empty()) addSun(scene);
            triangles = scenes::triangleCount(scene);
            if (!hasArea(scene)) {
                why = "draws nothing: no triangles with an area";
                return Verdict::DrawsNothing;
            }
            return draw(scene, why);
        } catch (const InputError& error) {
            why = fmt::format("refused: {}", error.what());
            EXPECT_STRNE(error.what(), "");
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "not one line: " << error.what();
            return Verdict::Refused;
        } catch (const std::exception& error) {
            why = fmt::format("FAILED: {}", error.what());
            ADD_FAILURE() << "neither drawn nor refused as input: " << error.what();
            return Verdict::Wrong;
        }
    }

    struct Pair {
        Picture forward, deferred;
        std::ptrdiff_t covered = 0; ///< pixels
    };
    Pair drawBoth(const scenes::Scene& scene, const glm::ivec2& sizePixels = {160, 90}) {
        frame::FrameSettings settings = ofSize(sizePixels);
        engine::Renderer renderer(context(), scene);
        Pair pair;
        pair.forward = engine::toPicture(renderer.render(Technique::Forward, settings));
        pair.deferred = engine::toPicture(renderer.render(Technique::Deferred, settings));
        pair.covered = std::ranges::count(pair.forward.covered, 1);
        return pair;
    }

    Verdict draw(const scenes::Scene& scene, std::string& why) {
        Pair pair = drawBoth(scene);
        const bool suppliedCamera = scene.cameras[0].name == scenes::kDefaultName;
        const bool turned = pair.covered == 0 && suppliedCamera;
        if (turned) pair = drawBoth(fromBehind(scene));
        if (pair.covered == 0) pair = drawBoth(scene, {640, 360}); // points may be thinner than a pixel
        const validation::ErrorFigures figures = validation::errorFigures(pair.deferred, pair.forward);
        const bool finite = figures.bad.sum() + figures.badOutside.sum() == 0;
        const bool alike = pair.deferred.rgba == pair.forward.rgba && pair.deferred.covered == pair.forward.covered;
        EXPECT_TRUE(finite) << "NaN, infinite or negative pixels";
        EXPECT_TRUE(alike) << "deferred differs from forward";
        EXPECT_GT(pair.covered, 0) << "no triangle is in view";
        EXPECT_GT(figures.meanLuminance, 0.0) << "a black picture";
        const double share = 100.0 * double(pair.covered) / double(pair.forward.pixelCount());
        why = fmt::format("drawn{}: {:.1f} % covered, mean luminance {:.2g}, {} light(s)", turned ? " from behind" : "",
                          share, figures.meanLuminance, scene.lights.size());
        return finite && alike && pair.covered > 0 && figures.meanLuminance > 0.0 ? Verdict::Drawn : Verdict::Wrong;
    }
};

using ModelsSlow = Models;

/// Fraction of the covered pixels of a model's first image that are displayed as black: codes below 0.02.
double blackShare(gpu::Context& context, const scenes::LoadOptions& options) {
    const scenes::Scene scene = scenes::loadScene((ownModelsFolder() / "three_metals.gltf").string(), options);
    engine::ViewRequest request;
    engine::applyRequestedOptions(scene, scene.name, request, [](const engine::Setting&) { return false; });
    request.settings.sizePixels = {160, 90};
    request.settings.display = true;
    engine::Renderer renderer(context, scene);
    const engine::RenderedFrame frame = renderer.render(Technique::Forward, request.settings);
    std::size_t covered = 0, black = 0;
    for (std::size_t at = 0; at < frame.radiance.size(); at += 4) {
        if (frame.radiance[at + 3] == 0.0f) continue;
        ++covered;
        black += std::max({frame.display[at], frame.display[at + 1], frame.display[at + 2]}) <= 5;
    }
    EXPECT_GT(covered, 1000u);
    return double(black) / double(covered);
}

TEST_F(Models, metalsAndFilmsUnderOneLampOfTheirOwnAreNotBlack) {
    scenes::LoadOptions alone;
    alone.defaultLight = false;
    const double lit = blackShare(context(), {}), unlit = blackShare(context(), alone);
    fmt::print("black: {:.1f} % beside the studio, {:.1f} % without it\n", 100.0 * lit, 100.0 * unlit);
    EXPECT_LE(lit, 0.05);
    EXPECT_GE(unlit, 0.5);
}

constexpr const char* kPackagedModels = "/usr/share/assimp/models"; ///< Debian's assimp-testmodels

TEST_F(Models, everyFourthPackagedModelIsDrawnAlikeByForwardAndDeferredOrRefused) {
    if (!std::filesystem::exists(kPackagedModels)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    sweep(kPackagedModels, LitBy::Sun);
}
TEST_F(ModelsSlow, everyPackagedModelIsDrawnAlikeByForwardAndDeferredOrRefused) {
    if (!std::filesystem::exists(kPackagedModels)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    sweep(kPackagedModels, LitBy::Sun);
}

TEST_F(Models, everyFourthModelOfTheAssetsFolderOrTheRepositoryIsDrawnAlikeByForwardAndDeferredOrRefused) {
    sweep(sweptFolder(), LitBy::Studio);
}
TEST_F(ModelsSlow, everyModelOfTheAssetsFolderOrTheRepositoryIsDrawnAlikeByForwardAndDeferredOrRefused) {
    sweep(sweptFolder(), LitBy::Studio);
}

/// OBJ models as common programs write them, compared by pixels.
class ObjModels : public ImageTest {
protected:
    static constexpr int kSide = 64;

    /// Renders the model unlit with the default camera, with this material in its MTL file.
    std::vector<float> shown(const std::string& mtl, const std::string& obj,
                             const scenes::ImportOptions& importOptions = {}) {
        folder_.write("m.mtl", "newmtl m\nillum 0\n" + mtl);
        scenes::LoadOptions options;
        options.import = importOptions;
        const scenes::Scene scene =
            scenes::loadScene(folder_.write("m.obj", "mtllib m.mtl\nusemtl m\n" + obj).string(), options);
        frame::FrameSettings settings = ofSize(kSide, kSide);
        return drawn(scene, settings);
    }
    static glm::vec3 center(const std::vector<float>& radiance) {
        const float* p = &radiance[4 * (kSide / 2 * kSide + kSide / 2)];
        return {p[0], p[1], p[2]};
    }
    static std::size_t litPixels(const std::vector<float>& radiance) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < radiance.size(); i += 4) count += radiance[i] > 0.5f;
        return count;
    }

    const TempFolder folder_;
};

constexpr const char* kQuad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";

TEST_F(ObjModels, vertexColoursAreSrgbOrLinear) {
    std::string quad;
    for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"}) quad += fmt::format("v {} 0 0.7353606 0 1\n", corner);
    quad += "f 1 2 3 4\n";
    // Half of an 8-bit step of the G-buffer.
    EXPECT_NEAR(center(shown("", quad)).x, 0.5f, 0.003f);
    scenes::ImportOptions linear;
    linear.objColours = scenes::ObjColours::Linear;
    EXPECT_NEAR(center(shown("", quad, linear)).x, 0.7353606f, 0.003f);
}

/// Bars of 0.25 m around 10 m, in survey coordinates, where single precision has steps of 0.5 m.
TEST_F(ObjModels, farModelsLookAsNearOnes) {
    const auto frameAt = [&](double x, double y, double z) {
        std::string text;
        int vertex = 0;
        for (const glm::dvec4& bar : {glm::dvec4(-5, -5, 0.25, 10), glm::dvec4(4.75, -5, 0.25, 10),
                                      glm::dvec4(-5, -5, 10, 0.25), glm::dvec4(-5, 4.75, 10, 0.25)}) {
            for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
                text += fmt::format("v {:.3f} {:.3f} {:.3f}\n", x + bar.x + corner.x * bar.z,
                                    y + bar.y + corner.y * bar.w, z);
            text += fmt::format("f {} {} {} {}\n", vertex + 1, vertex + 2, vertex + 3, vertex + 4);
            vertex += 4;
        }
        return shown("Kd 1 1 1\n", text);
    };
    const std::vector<float> near = frameAt(0, 0, 0), far = frameAt(500'000, 5'400'000, 300);
    EXPECT_GT(litPixels(near), 200u);
    EXPECT_EQ(near, far);
}

TEST_F(ObjModels, linesAndPointsAreSeen) {
    // A line is 1/400 of the model wide, less than a tenth of a pixel: slanted ones cross some centres of pixels.
    std::string fan = "v -1 -1 0\n";
    for (int i = 0; i < 12; ++i) fan += fmt::format("v {} 1 0\nl 1 {}\n", 0.163 * i - 0.9, i + 2);
    EXPECT_GT(litPixels(shown("Kd 1 1 1\n", fan)), 20u);
    // A point covers a twentieth of a pixel.
    std::string points;
    for (int i = 0; i < 400; ++i) points += fmt::format("v {} {} 0\n", 0.0971 * (i % 20), 0.1037 * (i / 20));
    EXPECT_GT(litPixels(shown("Kd 1 1 1\n", points)), 5u);
}

TEST_F(ObjModels, polygonsOfManyCornersCoverTheirArea) {
    std::string disc, face = "f";
    for (int i = 0; i < 2000; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 2000;
        disc += fmt::format("v {:.7f} {:.7f} 0\n", std::cos(angle), std::sin(angle));
        face += fmt::format(" {}", i + 1);
    }
    const std::size_t square = litPixels(shown("Kd 1 1 1\n", kQuad));
    const std::size_t round = litPixels(shown("Kd 1 1 1\n", disc + face + "\n"));
    // Both fill the image alike; pixels at the edge are in or out.
    EXPECT_NEAR(double(round) / double(square), std::numbers::pi / 4.0, 0.03);
}

TEST_F(ObjModels, oneBadFaceAndNumbersOutOfRangeLeaveTheRest) {
    const std::size_t whole = litPixels(shown("Kd 1 1 1\n", kQuad));
    EXPECT_EQ(
        litPixels(shown("Kd 1 1 1 # white\nd 1.0001\nNs nan\nmap_Kd\n",
                        std::string(kQuad) + "v nan 0 0\nvn nan 0 0\nf 1 2 99\nf 1 2 5\nf 1//1 2//1 3//1 # again\n")),
        whole);
}

} // namespace
} // namespace tessera
