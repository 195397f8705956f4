// Values that the encodings of the G-buffer keep exactly.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/gpu/gbuffer/Surfaces.h"

namespace tessera {
namespace {

using test::GBufferTest;
using test::StoredSurface;

constexpr frame::Encoding kCoarse[] = {frame::Encoding::Packed, frame::Encoding::Slim};

bool isMicrofacetModel(const StoredSurface& surface) {
    return surface.model == float(scenes::MaterialModel::Microfacet) ||
           surface.model == float(scenes::MaterialModel::MicrofacetAnisotropic);
}

TEST_F(GBufferTest, theExactLayoutKeepsEveryBit) {
    const std::vector<StoredSurface> surfaces = test::randomSurfaces(100000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Exact);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        ASSERT_EQ(std::memcmp(&surfaces[i], &back[i], sizeof(StoredSurface)), 0) << "surface " << i;
}

TEST_F(GBufferTest, everyLayoutKeepsModelAndMasking) {
    for (const frame::Encoding encoding : kCoarse) {
        std::vector<StoredSurface> surfaces = test::randomSurfaces(20000);
        for (const scenes::MaterialModelInfo& model : scenes::materialModels()) {
            StoredSurface surface;
            surface.model = float(model.model);
            surfaces.push_back(surface);
        }
        const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            ASSERT_EQ(back[i].model, surfaces[i].model) << "surface " << i;
            if (isMicrofacetModel(surfaces[i])) {
                ASSERT_EQ(back[i].masking, surfaces[i].masking) << "surface " << i;
            }
        }
    }
}

// The values of a scene without a channel must come back from the channel to the last bit, or leaving it out would
// change the image: no emission, no coat, no sheen, k_s 1, F0 0.04, F90 1.
TEST_F(GBufferTest, everyLayoutKeepsTheValuesOfAbsentChannelsExactly) {
    for (const frame::Encoding encoding : kCoarse) {
        std::vector<StoredSurface> surfaces(4);
        surfaces[0].specular = glm::vec3(1.0f);
        surfaces[0].albedo = glm::vec3(0.0f, 1.0f, 0.04f);
        surfaces[1].specular = glm::vec3(0.04f);
        surfaces[1].model = surfaces[2].model = float(scenes::MaterialModel::MetallicRoughness);
        surfaces[1].metallic = 1.0f;
        surfaces[2].iorOrF90 = 0.0f;
        surfaces[2].sheenColor = glm::vec3(1.0f);
        surfaces[2].coatFactor = 1.0f;
        surfaces[2].coatNormal = {1.0f, -1.0f};
        surfaces[3].model = float(scenes::MaterialModel::BlinnPhong);
        for (StoredSurface& surface : surfaces) surface.alpha = surface.coatAlpha = surface.sheenAlpha = 1.0f;
        const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            EXPECT_EQ(back[i].emission, glm::vec3(0.0f)) << i;
            EXPECT_EQ(back[i].coatFactor, surfaces[i].coatFactor) << i;
            EXPECT_EQ(back[i].coatNormal, surfaces[i].coatNormal) << i;
            EXPECT_EQ(back[i].sheenColor, surfaces[i].sheenColor) << i;
            EXPECT_EQ(back[i].metallic, surfaces[i].metallic) << i;
            EXPECT_EQ(back[i].exponent, 0.0f) << i;
            EXPECT_EQ(back[i].iorOrF90, surfaces[i].iorOrF90) << i;
            EXPECT_EQ(back[i].alpha, 1.0f) << i;
            EXPECT_EQ(back[i].coatAlpha, 1.0f) << i;
        }
        EXPECT_EQ(back[0].specular, glm::vec3(1.0f));
        EXPECT_EQ(back[0].albedo, surfaces[0].albedo);
        EXPECT_EQ(back[1].specular, glm::vec3(0.04f));
    }
}

TEST_F(GBufferTest, anIsotropicLobeNeverBecomesAnisotropic) {
    for (const frame::Encoding encoding : kCoarse) {
        const std::vector<StoredSurface> surfaces = test::randomSurfaces(20000);
        const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            if (surfaces[i].alphaBitangent != surfaces[i].alpha ||
                surfaces[i].model == float(scenes::MaterialModel::BlinnPhong))
                continue;
            ASSERT_EQ(back[i].alphaBitangent, back[i].alpha) << "surface " << i;
        }
    }
}

TEST_F(GBufferTest, unditheredFieldsTakeTheNearestCode) {
    // The coat's normal in steps of its 12 or 10 bits, of whose codes all but the last are used. 0.497 of a step is
    // further from the half than fp32 rounds -1..1 at 2^11 steps (1e-4) and than the tolerance of a whole step (1e-3).
    for (const frame::Encoding encoding : kCoarse) {
        const int middle = encoding == frame::Encoding::Packed ? 2047 : 511;
        std::vector<StoredSurface> surfaces(2);
        for (const int code : {-400, -3, 0, 7, 400}) {
            surfaces[0].coatNormal = glm::vec2(float((code + 0.497) / middle), float((code - 0.497) / middle));
            surfaces[1].coatNormal = glm::vec2(float((code + 0.503) / middle), float((code - 0.503) / middle));
            const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
            const auto codeOf = [&](float x) { return int(std::lround(double(x) * middle)); };
            EXPECT_EQ(codeOf(back[0].coatNormal.x), code);
            EXPECT_EQ(codeOf(back[0].coatNormal.y), code);
            EXPECT_EQ(codeOf(back[1].coatNormal.x), code + 1);
            EXPECT_EQ(codeOf(back[1].coatNormal.y), code - 1);
        }
    }
}

TEST_F(GBufferTest, decodedDirectionsAreUnitAndAtRightAngles) {
    for (const frame::Encoding encoding : kCoarse) {
        std::vector<StoredSurface> surfaces = test::randomSurfaces(50000);
        const std::vector<StoredSurface> ends = test::surfacesAtTheEnds();
        surfaces.insert(surfaces.end(), ends.begin(), ends.end());
        const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            ASSERT_NEAR(glm::length(glm::dvec3(back[i].normal)), 1.0, 3e-7) << "surface " << i; // five fp32 roundings
            ASSERT_NEAR(glm::length(glm::dvec3(back[i].tangent)), 1.0, 3e-7) << "surface " << i;
            ASSERT_NEAR(glm::dot(back[i].tangent, back[i].normal), 0.0, 3e-7) << "surface " << i;
        }
    }
}

TEST_F(GBufferTest, noLayoutEverMakesAValueThatLightingMustNotMeet) {
    for (const frame::Encoding encoding : kCoarse) {
        std::vector<StoredSurface> surfaces = test::surfacesAtTheEnds();
        surfaces.emplace_back().emission = glm::vec3(3e38f);
        surfaces.emplace_back().exponent = 3e38f;
        surfaces.back().model = float(scenes::MaterialModel::BlinnPhong);
        surfaces.emplace_back().iorOrF90 = 3e38f;
        const std::vector<StoredSurface> back = roundTrip(surfaces, encoding);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            float values[sizeof(StoredSurface) / sizeof(float)];
            std::memcpy(values, &back[i], sizeof(StoredSurface));
            for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << "surface " << i;
            ASSERT_GE(std::min({back[i].alpha, back[i].alphaBitangent, back[i].coatAlpha, back[i].sheenAlpha}),
                      float(ALPHA_MIN))
                << "surface " << i;
        }
    }
}

} // namespace
} // namespace tessera
