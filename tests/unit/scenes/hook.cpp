#include "scenes/Hook.h"

#include <limits>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "scenes/Fingerprint.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

using testing::HasSubstr;

constexpr std::string_view kGood =
    "// discard, and #include \"x\"\n/* uniform\n layout */\n"
    "float line(float version) { return version; } // C:\\caf\xc3\xa9\\gl_FragCoord ## x\n"
    "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}\n";

TEST(Hook, commentsAndNamesLikeThoseOfDirectivesAreNoFaults) {
    EXPECT_FALSE(hookFault(kGood).has_value());
}

TEST(Hook, valuesAreTakenByNameWithinTheirBounds) {
    Hook hook;
    hook.parameters = {{"wind", 1.0f, 0.0f, 2.0f}, {"shade", 0.0f, -1.0f, 1.0f}};
    setHookValue(hook, {"shade", -1.0f});
    EXPECT_EQ(hook.parameters[1].value, -1.0f);
    EXPECT_EQ(hook.parameters[0].value, 1.0f);
    const Hook before = hook;
    const struct {
        HookValue value;
        std::string_view says;
    } cases[] = {{{"Wind", 1.0f}, "its hook has no parameter 'Wind'; valid are wind, shade"},
                 {{"wind", 2.5f}, "the parameter 'wind' of its hook cannot be 2.5; it lies between 0 and 2"},
                 {{"wind", std::numeric_limits<float>::quiet_NaN()}, "it lies between 0 and 2"}};
    for (const auto& tried : cases) {
        try {
            setHookValue(hook, tried.value);
            FAIL() << "expected an InputError";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(tried.says));
        }
        EXPECT_EQ(hook, before);
    }
}

TEST(Hook, whatWouldBreakOtherPassesIsRefusedWithItsLine) {
    const struct {
        std::string_view line, why;
    } cases[] = {{"  # include \"lib/a.glsl\"", "include: a hook is one file"},
                 {"#version 460", "version: the program gives"},
                 {"#extension GL_X : enable", "extension: the program gives"},
                 {"#line 1", "line: the program numbers lines"},
                 {"#pragma once", "pragma: the program gives"},
                 {"void hole() { discard; }", "discard: a hook makes no holes"},
                 {"void deep() { gl_FragDepth = 0.0; }", "gl_FragDepth: a hook moves no depth"},
                 {"uniform float u;", "uniform: a hook binds nothing"},
                 {"layout(binding = 0) buffer B { float b; };", "layout: a hook binds nothing"},
                 {"float d(float x) { return dFdx(x); }", "dFdx: differences between pixels"},
                 {"float d(float x) { return dFdyFine(x); }", "dFdyFine: differences between pixels"},
                 {"float d(float x) { return fwidthCoarse(x); }", "fwidthCoarse: differences between pixels"},
                 {"float d(float x) { return interpolateAtCentroid(x); }", "interpolateAtCentroid: differences"},
                 {"float place() { return gl_FragCoord.x; }", "gl_FragCoord: what OpenGL says of a pixel"},
                 {"void hole() { gl_SampleMask[0] = 0; }", "gl_SampleMask: what OpenGL says of a pixel"},
                 {"#define J(a, b) a##b", "## makes words that nothing checks"},
                 {"float \xc3\xa9 = 1.0;", "outside of comments GLSL has the letters of ASCII alone"},
                 {"#define JOINED \\", "a backslash joins lines"},
                 {"/* *\\", "a backslash joins lines"},
                 {"// so is this \\\r", "a backslash joins lines"},
                 {"// some drivers go on\rhere", "a carriage return alone ends a line for some"},
                 {"#endif", "#endif has no #if before it"},
                 {"# else\nint outside;\n#if 1", "#else has no #if before it"},
                 {"#if 1\n#if 0\n#endif", "this #if has no #endif"},
                 {"/* and on", "the comment that begins here has no end"}};
    for (const auto& tried : cases) {
        const std::optional<HookFault> fault = hookFault(std::string(kGood).append(tried.line).append("\n"));
        ASSERT_TRUE(fault.has_value()) << tried.line;
        EXPECT_EQ(fault->line, 6u) << tried.line;
        EXPECT_THAT(fault->why, HasSubstr(tried.why));
    }
    std::string windows(kGood);
    for (std::size_t i = 0; (i = windows.find('\n', i)) != std::string::npos; i += 2) windows.insert(i, "\r");
    EXPECT_FALSE(hookFault(windows).has_value());
    const std::optional<HookFault> marked = hookFault(std::string("\xef\xbb\xbf").append(kGood));
    ASSERT_TRUE(marked.has_value());
    EXPECT_EQ(marked->line, 1u);
    EXPECT_THAT(marked->why, HasSubstr("byte order mark"));
    const std::optional<HookFault> none = hookFault("// void hookSurface()\n");
    ASSERT_TRUE(none.has_value());
    EXPECT_EQ(none->line, 1u);
    EXPECT_THAT(none->why, HasSubstr("defines neither hookSurface nor hookVertex"));
}

TEST(Hook, itsFunctionsAreThoseOutsideOfComments) {
    EXPECT_TRUE(hookFunctions(kGood).surface);
    EXPECT_FALSE(hookFunctions(kGood).vertex);
    const HookFunctions functions = hookFunctions("/* hookSurface */ void hookVertex(inout vec3 p) {} // hookSurface");
    EXPECT_FALSE(functions.surface);
    EXPECT_TRUE(functions.vertex);
    EXPECT_FALSE(hookFunctions("void hookVertexes() {}").vertex);
}

TEST(Hook, aParameterIsALetterThenLettersAndDigits) {
    for (const char* good : {"a", "speed", "Speed2", "abcdefghijklmnopqrstuvwxyzabcdef"})
        EXPECT_TRUE(isHookParameterName(good)) << good;
    for (const char* bad :
         {"", "2a", "a_b", "a b", "timeSeconds", "a;", "abcdefghijklmnopqrstuvwxyzabcdefg", "\xc3\xa9"})
        EXPECT_FALSE(isHookParameterName(bad)) << bad;
}

} // namespace
} // namespace tessera::scenes
