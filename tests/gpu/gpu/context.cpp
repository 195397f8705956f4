#include <cstdlib>

#include <gmock/gmock.h>

#include "renderer/gpu/Buffer.h"
#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

class ContextTest : public test::GlTest {};

TEST_F(ContextTest, capabilitiesNameTheDriverAndItsLimits) {
    const Capabilities& capabilities = context().capabilities();
    EXPECT_FALSE(capabilities.vendor.empty());
    EXPECT_FALSE(capabilities.renderer.empty());
    EXPECT_THAT(capabilities.version, testing::MatchesRegex("4\\.[5-9].*"));
    EXPECT_THAT(capabilities.glslVersion, testing::MatchesRegex("4\\.[5-9].*"));
    EXPECT_FALSE(capabilities.contextWay.empty());
    // Minimum values of OpenGL 4.5 (tables 23.53 ff.).
    EXPECT_GE(capabilities.maxTextureSize, 16384);
    EXPECT_GE(capabilities.maxTextureBufferTexels, 65536u);
    EXPECT_GE(capabilities.maxUniformBlockBytes, 16384u);
    EXPECT_GE(capabilities.maxStorageBlockBytes, std::size_t(1) << 24);
    EXPECT_GE(capabilities.maxSamples, 1);
    EXPECT_GE(capabilities.maxAnisotropy, 1.0f);
    EXPECT_EQ(capabilities.isSoftware, capabilities.renderer.find("llvmpipe") != std::string::npos);
}

/// Otherwise ./test --driver would test the first driver again if the second cannot be loaded.
TEST_F(ContextTest, aDriverThatTheEnvironmentRequestsIsTheOneInUse) {
    const char* const driver = std::getenv("MESA_LOADER_DRIVER_OVERRIDE");
    if (!driver) GTEST_SKIP() << "the environment names no driver";
    EXPECT_THAT(context().capabilities().renderer, testing::StartsWith(driver));
}

TEST_F(ContextTest, aSecondHeadlessContextNeverDisturbsTheFirst) {
    const Buffer buffer = Buffer::of("first", std::vector<int>{1, 2, 3});
    {
        const auto second = Context::create({.kind = ContextKind::Egl});
        EXPECT_EQ(Context::current(), second.get());
        EXPECT_EQ(second->windowHandle(), nullptr);
    }
    EXPECT_EQ(Context::current(), nullptr);
    context().makeCurrent();
    EXPECT_THAT(buffer.downloadAs<int>(3), testing::ElementsAre(1, 2, 3));
}

TEST_F(ContextTest, aWindowIsAContextOrAReason) {
    try {
        const auto window = Context::create({.kind = ContextKind::Window});
        EXPECT_EQ(window->capabilities().contextWay, "GLFW window");
        EXPECT_NE(window->windowHandle(), nullptr);
        EXPECT_THAT(Buffer::of("in a window", std::vector<int>{7}).downloadAs<int>(1), testing::ElementsAre(7));
        window->swapBuffers();
    } catch (const std::runtime_error& error) { // no display
        EXPECT_THAT(error.what(), testing::HasSubstr("no OpenGL 4.5 context can be made (GLFW window: "));
        EXPECT_THAT(error.what(), testing::HasSubstr("libgl1-mesa-dri"));
    }
    context().makeCurrent();
}

} // namespace
} // namespace tessera::gpu
