// OBJ models as people's programs write them, as pixels.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "scenes/Load.h"
#include "tests/support/GlContext.h"
#include "tests/support/TempFolder.h"

namespace tessera {
namespace {

class ObjModels : public test::GlTest {
protected:
    static constexpr int kSide = 64;

    /// The model seen by the supplied camera, unlit: an MTL file of this material stands beside it.
    std::vector<float> shown(const std::string& mtl, const std::string& obj, const scenes::ImportWishes& wishes = {}) {
        folder_.write("m.mtl", "newmtl m\nillum 0\n" + mtl);
        scenes::LoadOptions options;
        options.import = wishes;
        const scenes::Scene scene =
            scenes::loadScene(folder_.write("m.obj", "mtllib m.mtl\nusemtl m\n" + obj).string(), options);
        frame::FrameSettings settings;
        settings.sizePixels = {kSide, kSide};
        return engine::Renderer(context(), scene).render(engine::Technique::Deferred, settings).radiance;
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

    const test::TempFolder folder_;
};

constexpr const char* kQuad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";

TEST_F(ObjModels, vertexColoursAreSrgbOrLinear) {
    std::string quad;
    for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"}) quad += fmt::format("v {} 0 0.7353606 0 1\n", corner);
    quad += "f 1 2 3 4\n";
    // Half of an 8-bit step of the G-buffer.
    EXPECT_NEAR(center(shown("", quad)).x, 0.5f, 0.003f);
    scenes::ImportWishes linear;
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
    // Both fill the picture alike; pixels at the edge are in or out.
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
