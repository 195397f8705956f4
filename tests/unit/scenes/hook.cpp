#include "scenes/Hook.h"

#include <gmock/gmock.h>

#include "base/Error.h"
#include "scenes/Fingerprint.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

using testing::HasSubstr;

constexpr std::string_view kGood = "// discard, and #include \"x\"\n/* uniform\n layout */\n"
                                   "float line(float version) { return version; }\n"
                                   "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}\n";

TEST(Hook, commentsAndNamesLikeThoseOfDirectivesAreNoFaults) {
    EXPECT_FALSE(hookFault(kGood).has_value());
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
                 {"#define JOINED \\", "a backslash joins lines"}};
    for (const auto& tried : cases) {
        const std::optional<HookFault> fault = hookFault(std::string(kGood).append(tried.line).append("\n"));
        ASSERT_TRUE(fault.has_value()) << tried.line;
        EXPECT_EQ(fault->line, 6u) << tried.line;
        EXPECT_THAT(fault->why, HasSubstr(tried.why));
    }
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
