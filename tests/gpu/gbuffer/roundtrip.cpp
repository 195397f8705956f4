// Surfaces through a real render into the channels of the table and back.
#include <algorithm>
#include <cstring>
#include <memory>

#include <gtest/gtest.h>

#include "renderer/frame/GBufferLayout.h"
#include "shaders/shared/models.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

/// In the order of store.frag; compared as it is.
struct StoredSurface {
    glm::vec3 albedo{0.5f};
    float metallic = 0.0f;
    glm::vec3 normal{0, 0, 1};
    float alpha = 0.25f;
    glm::vec3 specular{0.5f};
    float iorOrF90 = 1.0f;
    glm::vec3 emission{0.0f};
    float model = float(MODEL_MICROFACET);
    glm::vec3 normalTexel{0.5f, 0.5f, 1.0f};
    float exponent = 0.0f;
    glm::vec3 tangent{1, 0, 0};
    float alphaBitangent = 0.25f;
    glm::vec2 coatNormal{0.0f}; ///< octahedral
    float coatFactor = 0.0f;
    float coatAlpha = 0.25f;
    glm::vec3 sheenColor{0.0f};
    float sheenAlpha = 0.25f;
    float masking = 0.0f;
    glm::vec3 unused{0.0f};
};
constexpr std::size_t kVectors = 9;
static_assert(sizeof(StoredSurface) == kVectors * sizeof(glm::vec4));

const shader::Defines kEveryMember{{"HAS_BLINN_PHONG", "1"},
                                   {"HAS_MICROFACET", "1"},
                                   {"HAS_MICROFACET_ANISOTROPIC", "1"},
                                   {"HAS_METALLIC_ROUGHNESS", "1"},
                                   {"HAS_MASKING_OPTIONS", "1"},
                                   {"HAS_ANISOTROPY", "1"},
                                   {"HAS_CLEARCOAT", "1"},
                                   {"HAS_SHEEN", "1"}};

class GBufferTest : public test::GlTest {
protected:
    /// All channels, the normal-map texel in a run of its own: OpenGL guarantees eight attachments.
    std::vector<StoredSurface> roundTrip(const std::vector<StoredSurface>& surfaces, frame::Encoding encoding) {
        std::vector<frame::Channel> channels;
        for (const frame::ChannelInfo& info : frame::channelTable())
            if (info.channel != frame::Channel::NormalTexel) channels.push_back(info.channel);
        std::vector<StoredSurface> result = roundTrip(surfaces, encoding, channels);
        const std::vector<StoredSurface> texels = roundTrip(surfaces, encoding, {frame::Channel::NormalTexel});
        for (std::size_t i = 0; i < result.size(); ++i) result[i].normalTexel = texels[i].normalTexel;
        return result;
    }

    std::vector<StoredSurface> roundTrip(const std::vector<StoredSurface>& surfaces, frame::Encoding encoding,
                                         const std::vector<frame::Channel>& channels) {
        constexpr int kWidth = 512;
        const int height = (int(surfaces.size()) + kWidth - 1) / kWidth;
        std::vector<StoredSurface> padded = surfaces;
        padded.resize(std::size_t(kWidth * height));

        frame::GBufferLayout layout;
        layout.encoding.fill(encoding);
        std::vector<std::unique_ptr<gpu::Texture>> textures;
        gpu::Attachments attachments;
        for (const frame::Channel channel : channels) {
            const graph::TextureDesc desc{layout.format(channel), kWidth, height, 1};
            const std::string_view name = frame::channelTable()[std::size_t(channel)].name;
            textures.push_back(std::make_unique<gpu::Texture>(std::string(name), desc));
            attachments.colors.push_back(textures.back().get());
        }
        shader::Defines defines = frame::channelDefines(layout, channels);
        defines.insert(defines.end(), kEveryMember.begin(), kEveryMember.end());
        defines.emplace_back("WIDTH", std::to_string(kWidth));

        const gpu::Program& store =
            bench.programs().get({"store", "passes/fullscreen.vert", "test/store.frag", "", defines});
        const gpu::Buffer in = gpu::Buffer::of("surfaces", padded);
        gpu::FramebufferCache framebuffers;
        gpu::bindFramebuffer(framebuffers.get(attachments));
        gpu::setState({});
        gpu::useProgram(store);
        gpu::bindStorageBuffer(0, in);
        gpu::drawFullscreenTriangle();

        for (std::size_t i = 0; i < textures.size(); ++i)
            gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), *textures[i]);
        const std::vector<glm::vec4> out = bench.run("load.comp", defines, {glm::vec4(0.0f)}, padded.size(), kVectors);
        std::vector<StoredSurface> result(padded.size());
        std::memcpy(static_cast<void*>(result.data()), out.data(), result.size() * sizeof(StoredSurface));
        result.resize(surfaces.size());
        return result;
    }

    test::ShaderBench bench;
};

std::vector<StoredSurface> randomSurfaces(int count) {
    test::Random random(11);
    std::vector<StoredSurface> surfaces;
    for (int i = 0; i < count; ++i) {
        StoredSurface s;
        s.albedo = {random.unit(), random.unit() * 0.01, i % 7 == 0 ? 1.0 : random.unit()};
        s.metallic = i % 3 == 0 ? float(random.index(2)) : float(random.unit());
        s.normal = glm::vec3(random.direction());
        s.alpha = float(random.logarithmic(ALPHA_MIN, 1.0));
        s.specular = {random.unit(), random.unit(), random.unit()};
        constexpr unsigned kStoredModels[] = {MODEL_LAMBERT,     MODEL_SINGLE_COLOR,
                                              MODEL_MICROFACET,  MODEL_METALLIC_ROUGHNESS,
                                              MODEL_BLINN_PHONG, MODEL_MICROFACET_ANISOTROPIC};
        s.model = float(kStoredModels[i % 6]);
        const bool microfacet = i % 6 == 2 || i % 6 == 5;
        s.iorOrF90 = microfacet ? float(random.logarithmic(0.2, 20.0)) : float(random.unit());
        s.emission = glm::vec3(random.unit(), random.unit(), random.unit()) * float(random.logarithmic(1e-3, 1e4));
        s.normalTexel = {random.unit(), random.unit(), random.unit()};
        if (microfacet) { // never metallic
            s.metallic = 0.0f;
            s.masking = float(random.index(3));
        }
        if (s.model == float(MODEL_BLINN_PHONG)) { // no index of refraction
            s.iorOrF90 = 1.0f;
            s.exponent = i % 5 == 0 ? 0.0f : float(random.logarithmic(1e-3, 1e6));
        }
        s.tangent = glm::vec3(random.around(glm::normalize(glm::dvec3(s.normal)), 0.0, 0.0));
        s.alphaBitangent = i % 4 == 0 ? s.alpha : float(random.logarithmic(ALPHA_MIN, 1.0));
        s.coatNormal = {random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        s.coatFactor = i % 3 == 0 ? float(random.index(2)) : float(random.unit());
        s.coatAlpha = float(random.logarithmic(ALPHA_MIN, 1.0));
        s.sheenColor = {random.unit(), random.unit(), i % 3 == 0 ? 0.0 : random.unit()};
        s.sheenAlpha = float(random.logarithmic(ALPHA_MIN, 1.0));
        surfaces.push_back(s);
    }
    // The axes and the seams of the octahedron, where a sign of zero decides.
    for (const glm::vec3 n :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),
          glm::vec3(0, 0, -1), glm::vec3(-0.6f, 0, -0.8f), glm::vec3(0, 0.6f, -0.8f)}) {
        surfaces.emplace_back().normal = n;
        surfaces.back().tangent = n.x == 0.0f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    }
    return surfaces;
}

double angleDegrees(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 x(a), y(b);
    return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180.0 / test::pi;
}

TEST_F(GBufferTest, theExactLayoutAlwaysKeepsEveryBit) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(100000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Exact);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        ASSERT_EQ(std::memcmp(&surfaces[i], &back[i], sizeof(StoredSurface)), 0) << "surface " << i;
}

TEST_F(GBufferTest, packedNormalsAlwaysStayWithinTheirStep) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(200000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    double worst = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const double angle = angleDegrees(surfaces[i].normal, back[i].normal);
        worst = std::max(worst, angle);
        sum += angle;
        ASSERT_NEAR(glm::length(glm::dvec3(back[i].normal)), 1.0, 3e-7) << "surface " << i;
    }
    // Half a step of 1/32767 across the octahedral square is at most 0.0037 degrees on the sphere, 0.0013 in the mean.
    EXPECT_LE(worst, 0.0037);
    EXPECT_LE(sum / double(surfaces.size()), 0.0013 * 1.05);
}

TEST_F(GBufferTest, packedColoursAlwaysStayWithinHalfAStepOfTheirSquareRoot) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(100000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    const auto expectClose = [](const glm::vec3& was, const glm::vec3& is, std::size_t i) {
        for (int c = 0; c < 3; ++c) {
            // 11, 11 and 10 bits hold the square root; 1e-6 for the fp32 root and its scaling.
            ASSERT_NEAR(std::sqrt(double(was[c])), std::sqrt(double(is[c])), 0.5 / (c == 2 ? 1020.0 : 2045.0) + 1e-6)
                << "surface " << i;
            if (was[c] == 0.0f || was[c] == 1.0f) {
                ASSERT_EQ(was[c], is[c]) << "surface " << i;
            }
        }
    };
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        expectClose(surfaces[i].albedo, back[i].albedo, i);
        expectClose(surfaces[i].specular, back[i].specular, i);
        if (HasFatalFailure()) return;
    }
}

TEST_F(GBufferTest, thePackedMicrosurfaceAlwaysStaysWithinHalfAStepAndKeepsItsModel) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(100000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    constexpr double kRounding = 1e-6; // of the fp32 arithmetic before the step is taken
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const StoredSurface &was = surfaces[i], &is = back[i];
        ASSERT_EQ(is.model, was.model) << "surface " << i;
        if (was.model == float(MODEL_BLINN_PHONG)) {
            // 14 bits of mantissa, rounded; 0 has none.
            ASSERT_NEAR(is.exponent, was.exponent, double(was.exponent) * 0x1p-15) << "surface " << i;
            continue;
        }
        ASSERT_EQ(is.masking, was.masking) << "surface " << i;
        ASSERT_NEAR(std::sqrt(double(is.alpha)), std::sqrt(double(was.alpha)), 0.5 / 2047.0 + kRounding)
            << "surface " << i;
        ASSERT_GE(is.alpha, float(ALPHA_MIN)) << "surface " << i;
        ASSERT_NEAR(is.metallic, was.metallic, 0.5 / 127.0 + kRounding) << "surface " << i;
        if (was.metallic == 0.0f || was.metallic == 1.0f) {
            ASSERT_EQ(is.metallic, was.metallic) << "surface " << i;
        }
        if (was.model == float(MODEL_MICROFACET) || was.model == float(MODEL_MICROFACET_ANISOTROPIC)) {
            const auto contrast = [](double ior) { return (ior - 1.0) / (ior + 1.0); };
            // (ior - 1)/(ior + 1) runs over -1..1 in 2046 steps.
            ASSERT_NEAR(contrast(is.iorOrF90), contrast(was.iorOrF90), 1.0 / 2046.0 + kRounding) << "surface " << i;
        } else {
            ASSERT_NEAR(is.iorOrF90, was.iorOrF90, 0.5 / 2046.0 + kRounding) << "surface " << i;
        }
    }
}

TEST_F(GBufferTest, specialValuesOfThePackedMicrosurfaceAreExactlyKept) {
    std::vector<StoredSurface> surfaces(4);
    surfaces[0].iorOrF90 = 1.0f;
    surfaces[1].model = surfaces[2].model = float(MODEL_METALLIC_ROUGHNESS);
    surfaces[1].iorOrF90 = 0.0f;
    surfaces[2].iorOrF90 = 1.0f;
    surfaces[2].metallic = 1.0f;
    surfaces[3].alpha = 1.0f;
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(back[i].iorOrF90, surfaces[i].iorOrF90) << i;
        EXPECT_EQ(back[i].metallic, surfaces[i].metallic) << i;
    }
    EXPECT_EQ(back[3].alpha, 1.0f);
}

TEST_F(GBufferTest, packedEmissionAlwaysStaysWithinHalfAStepOfItsLargestColour) {
    std::vector<StoredSurface> surfaces = randomSurfaces(100000);
    for (int power = -14; power < 16; ++power) // exact powers of two, and just below, where log2 may round either way
        for (const float value : {std::ldexp(1.0f, power), std::nextafter(std::ldexp(1.0f, power), 0.0f)})
            surfaces.emplace_back().emission = glm::vec3(value, 0.3f * value, 0.0f);
    surfaces.emplace_back().emission = glm::vec3(0.0f);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const glm::vec3 &was = surfaces[i].emission, &is = back[i].emission;
        const double largest = std::max({was.x, was.y, was.z});
        // 9 bits of mantissa shared: half a step is at most 1/512 of the largest colour, or of 2^-15 below the smallest
        // exponent.
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(is[c], was[c], std::max(largest, 0x1p-15) / 512.0 * (1.0 + 1e-6))
                << "surface " << i << " of " << largest;
    }
    EXPECT_EQ(back.back().emission, glm::vec3(0.0f));
}

TEST_F(GBufferTest, packedEmissionBeyondItsRangeIsAlwaysHeldAtTheLargestValue) {
    std::vector<StoredSurface> surfaces(2);
    surfaces[0].emission = glm::vec3(65408.0f, 1.0f, 0.0f);
    surfaces[1].emission = glm::vec3(1e20f, 1e30f, 0.0f);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    EXPECT_EQ(back[0].emission.x, 65408.0f); // 511/512 of 2^16, the largest value of the format
    EXPECT_EQ(back[1].emission, glm::vec3(65408.0f, 65408.0f, 0.0f));
}

TEST_F(GBufferTest, packedTangentsAlwaysStayWithinTheirStepAndThatOfTheirNormal) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(200000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    double worst = 0.0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const StoredSurface &was = surfaces[i], &is = back[i];
        // A tangent has no sign.
        const double angle = angleDegrees(was.tangent, is.tangent);
        worst = std::max(worst, std::min(angle, 180.0 - angle));
        ASSERT_NEAR(glm::dot(is.tangent, is.normal), 0.0, 3e-7) << "surface " << i;
        ASSERT_NEAR(std::sqrt(double(is.alphaBitangent)), std::sqrt(double(was.alphaBitangent)), 0.5 / 2047.0 + 1e-6)
            << "surface " << i;
        if (was.alphaBitangent == was.alpha && was.model != float(MODEL_BLINN_PHONG)) {
            ASSERT_EQ(is.alphaBitangent, is.alpha) << "an isotropic lobe stays one, surface " << i;
        }
    }
    // Half a step of the diamond, 1/65534, is an angle of at most twice that: 0.0018 degrees. The packed normal is off
    // by up to 0.0037 degrees: the tangent leans as far with it, and the frame turns by up to 0.71 of that, the tangent
    // of the normal's elevation over the plane at right angles to its axis (at most 35.3 degrees).
    EXPECT_LE(worst, std::hypot(0.0037, 0.0018 + 0.71 * 0.0037));
    EXPECT_GT(worst, 0.001) << "nothing was packed";
}

TEST_F(GBufferTest, packedCoatsAlwaysStayWithinHalfAStep) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(100000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    constexpr double kRounding = 3e-7; // three fp32 roundings each way of values around 1
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const StoredSurface &was = surfaces[i], &is = back[i];
        for (int c = 0; c < 2; ++c) ASSERT_NEAR(is.coatNormal[c], was.coatNormal[c], 0.5 / 32767.0 + kRounding);
        ASSERT_NEAR(is.coatFactor, was.coatFactor, 0.5 / 65535.0 + kRounding);
        if (was.coatFactor == 0.0f || was.coatFactor == 1.0f) {
            ASSERT_EQ(is.coatFactor, was.coatFactor) << "surface " << i;
        }
        ASSERT_NEAR(std::sqrt(double(is.coatAlpha)), std::sqrt(double(was.coatAlpha)), 0.5 / 65535.0 + kRounding);
    }
}

TEST_F(GBufferTest, packedSheenAlwaysStaysWithinHalfAStep) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(100000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const StoredSurface &was = surfaces[i], &is = back[i];
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(std::sqrt(double(is.sheenColor[c])), std::sqrt(double(was.sheenColor[c])), 0.5 / 255.0 + 1e-6);
            if (was.sheenColor[c] == 0.0f) {
                ASSERT_EQ(is.sheenColor[c], 0.0f);
            }
        }
        // The floor of alpha lies above the least step.
        ASSERT_NEAR(std::sqrt(double(is.sheenAlpha)), std::sqrt(double(was.sheenAlpha)), 0.5 / 255.0 + 1e-6);
    }
}

TEST_F(GBufferTest, packedNormalTexelsAlwaysStayWithinHalfAStep) {
    const std::vector<StoredSurface> surfaces = randomSurfaces(20000);
    const std::vector<StoredSurface> back = roundTrip(surfaces, frame::Encoding::Packed);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(back[i].normalTexel[c], surfaces[i].normalTexel[c], 0.5 / 255.0 + 1e-6);
}

} // namespace
} // namespace tessera
