#include "scenes/Hook.h"

#include <ctime>
#include <limits>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/Fingerprint.h"
#include "tests/unit/scenes/TempFolder.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

using testing::HasSubstr;

constexpr std::string_view kGood =
    "// discard, and #include \"x\"\n/* uniform\n layout */\n"
    "float line(float version) { return version; } // C:\\caf\xc3\xa9\\gl_FragCoord ## x\n"
    "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}\n";

void expectFault(const std::string& text, std::size_t line, std::string_view why) {
    SCOPED_TRACE(text.substr(0, 200));
    const std::optional<HookFault> fault = hookFault(text);
    ASSERT_TRUE(fault.has_value());
    EXPECT_EQ(fault->line, line) << fault->why;
    EXPECT_THAT(fault->why, HasSubstr(why));
    EXPECT_EQ(fault->why.find('\n'), std::string::npos);
}

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
        EXPECT_THAT(test::inputErrorOf([&] { setHookValue(hook, tried.value); }), HasSubstr(tried.says));
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
                 {"float place() { return gl_FragCoord.x; }", "gl_FragCoord: values of a pixel"},
                 {"void hole() { gl_SampleMask[0] = 0; }", "gl_SampleMask: values of a pixel"},
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
    for (const auto& tried : cases) expectFault(std::string(kGood).append(tried.line).append("\n"), 6, tried.why);
    std::string windows(kGood);
    for (std::size_t i = 0; (i = windows.find('\n', i)) != std::string::npos; i += 2) windows.insert(i, "\r");
    EXPECT_FALSE(hookFault(windows).has_value());
    expectFault(std::string("\xef\xbb\xbf").append(kGood), 1, "byte order mark");
    expectFault("// void hookSurface()\n", 1, "defines neither hookSurface nor hookVertex");
}

constexpr std::string_view kBody = "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n{\n"
                                   "float x = inputs.uv.x;\n";

std::string repeated(std::size_t times, std::string_view text) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
}
std::string chained(int from, int to, std::string_view pattern) {
    std::string all;
    for (int i = from; i <= to; ++i) all += fmt::format(fmt::runtime(pattern), i, i - 1);
    return all;
}
std::string bodied(std::string_view statements, std::string_view before = "") {
    return fmt::format("{}{}{}}}\n", before, kBody, statements);
}

/// Each text would crash a driver, or cost it minutes and gigabytes.
TEST(Hook, whatDriversBreakOnIsRefusedAtOnceWithItsLine) {
    const std::string doubling = chained(1, 24, "#define m{0} m{1} + m{1}\n"),
                      fullStop = "\nsurface.color = vec3(x);\n";
    const struct {
        std::string text;
        std::size_t line;
        std::string_view why;
    } cases[] = {
        {bodied("x = m24;", "#define m0 x\n" + doubling), 29, "more than 1000000 words and signs"},
        {bodied("m24", "#define m0\n" + chained(1, 24, "#define m{0} m{1} m{1}\n")), 29, "more than 1000000"},
        {bodied("x = m24(x);", "#define m0(a) a\n" + chained(1, 24, "#define m{0}(a) m{1}(a) + m{1}(a)\n")), 29,
         "more than 1000000"},
        {bodied("x = " + repeated(99, "m(") + "x" + repeated(99, ")") + ";", "#define m(a) a\n"), 5,
         "more than 64 calls"},
        {"#if " + repeated(99, "!") + "1\n#endif\n" + bodied(""), 1, "no expression of whole numbers"},
        {bodied("x = x" + repeated(20'000, " + x") + ";" + fullStop), 4, "more than 1000 operators"},
        {bodied("x = (x" + repeated(400, " + x") + ")" + repeated(400, " * x") + ";"), 4, ""},
        {bodied("x += 1.0" + repeated(600, ", x += 1.0") + ";"), 4, "more than 1000 operators"},
        {bodied("return (x" + repeated(1001, ", x") + ");"), 4, "more than 1000 operators"},
        {bodied("x = max((x += 1.0" + repeated(600, ", x += 1.0") + "), 1.0);"), 4, "more than 1000 operators"},
        {bodied("x = x * (x" + repeated(2500, " + x * (1.0") + repeated(2500, ")") + ");"), 4,
         "brackets stand in each"},
        {bodied("x = " + repeated(5000, "- ") + "x;"), 4, "more than 1000 operators"},
        {bodied(repeated(300, "if (x > 0.0) ") + "x = 1.0;"), 1, "more than 200 branches"},
        {bodied(repeated(9000, "x = x * 1.1;\n")), 8334, "more than 50000 words and signs"},
        {bodied(repeated(600, "if (x > 0.0) return;\n")), 1, "more than 200 branches"},
        {bodied(repeated(250, "x = x > 0.5 ? 0.0 : x;\n")), 1, "more than 200 branches"},
        {bodied("bool b = x > 0.0;\n" + repeated(150, "b = b && x > 1.0 || x < 0.0;\n")), 1, "more than 200 branches"},
        {bodied(repeated(30, "for (int i = 0; i < int(x); ++i) x += 1.0;\n")), 1, "more than 200 branches"},
        {bodied("mat4 m;\n" + repeated(200, "m = m * m;\n")), 1, "more than 20000 operations"},
        {bodied("mat4 m;\n" + repeated(100, "m = inverse(m);\n")), 1, "more than 20000 operations"},
        {bodied("dmat4 m;\n" + repeated(80, "m *= m;\n")), 1, "more than 20000 operations"},
        {bodied("S s;\n" + repeated(200, "s.m = s.m * s.m;\n"), "struct S { mat4 m; };\n"), 2, "more than 20000"},
        {bodied(repeated(500, "x = atan(x, x);\n")), 1, "more than 20000 operations"},
        {bodied("int n = int(x);\n" + repeated(600, "n = n / 3;\n")), 1, "more than 20000 operations"},
        {bodied(repeated(400, "x = pow(x, x);\n")), 1, "more than 20000 operations"},
        {bodied("float a[500], b[500];\n" + repeated(50, "a = b;\n")), 1, "more than 20000 operations"},
        {bodied("float a[500], b[500];\nx = float(a == b);"), 5, "names a value of more than 16 numbers"},
        {bodied("float a[500], b[500];\n" + repeated(50, "a[1] = b[2];\n")), 1, ""},
        {bodied("x = f14(x);", "float f0(float x) { return sin(x); }\n" +
                                   chained(1, 14, "float f{0}(float x) {{ return f{1}(x) + f{1}(x + 0.5); }}\n")),
         10, "more than 20000 operations"},
        {bodied("x = sin(x);", "float cos(float x) { return x; }\nfloat sin(float x) { return " +
                                   repeated(300, "cos(x) + ") +
                                   "x; }\nfloat tan(float x) { return sin(x) + sin(x) + sin(x) + sin(x) + sin(x); }\n"),
         3, "more than 20000"},
        {"float a(float x);\nfloat b(float x) { return a(x); }\nfloat a(float x) { return b(x); }\n" + bodied(""), 2,
         "GLSL has no recursion"},
        {bodied("float a[65536];"), 1, "more than 1024 numbers in arrays"},
        {bodied("float a[64][65];"), 1, "more than 1024 numbers in arrays"},
        {bodied("float b, a[kMost];", "const int kLeast = 1, kMost = 0x1001;\n"), 2,
         "more than 1024 numbers in arrays"},
        {bodied("float b, a[kMost];", "const int kLeast = 1, kMost = 99;\n"), 2, ""},
        {bodied("mat4 a[65];"), 1, "more than 1024 numbers in arrays"},
        {bodied("dvec4 a[129];"), 1, "more than 1024 numbers in arrays"},
        {bodied(chained(1, 3, "float[400] a{0};")), 1, "more than 1024 numbers in arrays"},
        {bodied("float a, S[3000];", "struct S { float x; };\n"), 2, "more than 1024 numbers in arrays"},
        {bodied("x += float[](x" + repeated(700, ", x") + ")[0];\n"), 1, "more than 20000 operations"},
        {bodied("const float a[800] = float[](1.0" + repeated(799, ", 1.0") + ");\n"), 1, "more than 1024 numbers"},
        {bodied("const float a[500] = float[500](1.0" + repeated(499, ", 1.0") + ");\n"), 4, ""},
        {bodied(repeated(3, "x += float[](0.5" + repeated(400, ", 0.5") + ")[0];\n")), 1,
         "more than 1024 numbers in arrays"},
        {bodied("f(float[9](x, x, x, x, x, x, x, x, x));", "void f(struct S s) { float a[4000]; }\n"), 1,
         "more than 1024"},
        {bodied("float a[max(1, 65536)];"), 4, "an array's size is one whole number"},
        {bodied("float a[1 + 2000000000 / (65536 * 65536 + 1)];"), 4, "an array's size is one whole number"},
        {bodied("float a[0xFFFFFFFF + 2];"), 4, "an array's size is one whole number"},
        {bodied("float a[-1];"), 4, "an array's size is one whole number"},
        {bodied("float a[4], b[a.length()];"), 4, "an array's size is one whole number"},
        {bodied("float a[];\na[2000000000] = 1.0;"), 4, "an array's size is one whole number"},
        {bodied("float a[N];", "const int N = 1;\nfloat g() { const int N = 2000000000; return 1.0; }\n"), 6,
         "a const int that is declared once"},
        {bodied("float a[N];", "const int M = 1, N = 2 * M;\n"), 5, "an array's size is one whole number"},
        {bodied("B b[17];", "struct A { vec4 a[4]; };\nstruct B { A a[4], c[12]; };\n"), 3, "more than 1024 numbers"},
        {bodied("", "struct A0 { float x; };\n" + chained(1, 20, "struct A{0} {{ A{1} a; }};\n")), 17,
         "more than 16 structures"},
        {bodied("while (bool b = x < 1.0) x += 1.0;"), 4, "the condition of a loop declares a variable"},
        {bodied("for (;\nbool b = x < 1.0;) x += 1.0;"), 5, "the condition of a loop declares a variable"},
        {bodied("F(" + repeated(199, ",") + ")", "#define F(a0" + chained(1, 299, ", a{0}") + ")\n"), 1,
         "more than 255 parameters"},
        {bodied(repeated(20'000, "F()\n"), "#define F(a)" + repeated(20'000, " a") + "\n"), 54, "more than 1000000"},
        {bodied("") + repeated(std::size_t(1) << 20, "\n"), 1, "a hook has at most 1048576"},
        {bodied("H if 0", "#define H #\n"), 1, "a # stands first in its line"},
        {bodied("E # if 0\nE # endif", "#define E\n"), 5, "a # stands first in its line"},
    };
    for (const auto& tried : cases) {
        const std::clock_t began = std::clock();
        const std::optional<HookFault> fault = hookFault(tried.text);
        EXPECT_LT(std::clock() - began, CLOCKS_PER_SEC) << tried.text.substr(0, 200);
        if (tried.why.empty())
            EXPECT_FALSE(fault.has_value()) << fault->why;
        else
            expectFault(tried.text, tried.line, tried.why);
    }
}

TEST(Hook, programsTakeItWithoutMacrosAndWithNamesOfItsOwn) {
    const std::string taken =
        hookProgramText("a.glsl", "#define FIELD color\n#define SET(what, by) surface.what = by // x\n"
                                  "const int SIZE = 2;\n#if defined(FIELD) && __VERSION__ > 400\n"
                                  "struct Own { float view[SIZE], a; Own2 b; };\n#else\n#error\n"
                                  "#endif\nvoid hookSurface(inout HookedSurface surface, HookInputs "
                                  "inputs)\n{\n    SET(FIELD,\n        vec3(view.x + hook.wind));\n}\n");
    EXPECT_EQ(taken, "\n\nconst int ofHookSIZE = 2 ; \n\nstruct ofHookOwn { float view [ ofHookSIZE ] , a ; ofHookOwn2 "
                     "b ; } ; \n\n\n\n"
                     "void hookSurface ( inout HookedSurface ofHooksurface , HookInputs ofHookinputs ) \n{ \n"
                     "ofHooksurface . color = vec3 ( ofHookview . x + hook . wind ) \n; \n} \n");
    for (const char* reached : {"view.sizePixels", "texture(baseColorTexture, inputs.uv)", "hookMovedRows[0]",
                                "__LINE__", "VIEW_MOVED_TOO_FAR", "imageStore", "HookMovedRow"}) {
        const std::string text = hookProgramText("a.glsl", bodied(fmt::format("x = {};", reached)));
        EXPECT_THAT(text, HasSubstr("x = ofHook")) << reached;
    }
}

TEST(Hook, eachLoopHasAGuard) {
    const auto taken = [](std::string_view body) {
        const std::string text = hookProgramText("a.glsl", bodied(body));
        return text.substr(text.find("uv . x ;") + 9);
    };
    EXPECT_EQ(taken("while (x < 1.0 || (x > 2.0))\nx += 1.0;"),
              "\nwhile ( ( ofHookx < 1.0 || ( ofHookx > 2.0 ) ) && hookGoesOn() ) \nofHookx += 1.0 ; } \n");
    EXPECT_EQ(taken("do x += 1.0; while (true);"), "\ndo ofHookx += 1.0 ; while ( ( true ) && hookGoesOn() ) ; } \n");
    EXPECT_EQ(taken("for (;;) break;"), "\nfor ( ; hookGoesOn() ; ) break ; } \n");
    EXPECT_EQ(taken("for (int i = int[](1, 2)[0]; i < 9; ++i) hookGoesOn();"),
              "\nfor ( int ofHooki = int [ ] ( 1 , 2 ) [ 0 ] ; ( ofHooki < 9 ) && hookGoesOn() ; ++ ofHooki ) "
              "ofHookhookGoesOn ( ) ; } \n");
    EXPECT_EQ(taken("while ();\nfor (x;);"), "\nwhile ( ) ; \nfor ( ofHookx ; ) ; } \n") << "the driver refuses it";
}

TEST(Hook, macrosExpandAsInGlsl) {
    const struct {
        std::string_view text, taken;
    } cases[] = {{"#define f(x) x + f\nA f(1)(2) f", "ofHookA 1 + ofHookf ( 2 ) ofHookf"},
                 {"#define a b\n#define b a 1\na b", "ofHooka 1 ofHookb 1"},
                 {"#define g f(2)\n#define f(x) -x\ng f (3) f", "- 2 - 3 ofHookf"},
                 {"#define two(a, b) b a\ntwo((1, 2), two(3, 4))", "4 3 ( 1 , 2 )"},
                 {"#define none() 7\nnone() none( )", "7 7"},
                 {"#define o (1)\n#undef o\no", "ofHooko"},
                 {"#if 0\n1\n#elif 2 - 1\n2\n#elif 1\n3\n#else\n4\n#endif", "2"},
                 {"#if 0\n# if 1\n1\n# else\n2\n# endif\n#else\n3\n#endif", "3"},
                 {"#if (1 << 4) == 0x10 && !defined x && 7 % 4 * 2 == 6 && 010 == 8u\n1\n#endif", "1"},
                 {"1e-5+.5-x.y", "1e-5 + .5 - ofHookx . y"}};
    for (const auto& tried : cases) {
        std::string text = hookProgramText("a.glsl", fmt::format("void hookVertex;\n{}\n", tried.text)).substr(18);
        std::string words;
        for (const char c : text)
            if (c != '\n' && !(c == ' ' && words.ends_with(' '))) words += c;
        while (words.ends_with(' ')) words.pop_back();
        EXPECT_EQ(words, tried.taken) << tried.text;
    }
    for (const auto& [text, why] :
         {std::pair("#define f(a) a\nf(1, 2)", "takes 1 arguments, not 2"),
          std::pair("#define f(a) a\nf(1", "have no end"), std::pair("#define f(a,,b) a", "names with commas between"),
          std::pair("#if 1 / 0\n#endif", "no expression of whole numbers"),
          std::pair("#warning x", "is no directive of GLSL"), std::pair("#error x", "gives up itself")}) {
        const std::optional<HookFault> fault = hookFault(fmt::format("void hookVertex;\n{}\n", text));
        ASSERT_TRUE(fault.has_value()) << text;
        EXPECT_THAT(fault->why, HasSubstr(why));
    }
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
