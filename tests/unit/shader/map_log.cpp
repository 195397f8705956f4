#include <gtest/gtest.h>

#include "renderer/shader/Preprocess.h"

namespace tessera::shader {
namespace {

const std::vector<std::string> kFiles{"passes/light.frag", "lib/reflectance/brdf.glsl"};

// The first lines are messages of Mesa 22.3, NVIDIA 5xx and glslang 12 for an undeclared name.
TEST(MapLog, placesOfMesaAreMapped) {
    EXPECT_EQ(mapLog("1:12(5): error: `x' undeclared\n0:3(1): warning: w\n", kFiles),
              "shaders/lib/reflectance/brdf.glsl:12: error: `x' undeclared\nshaders/passes/light.frag:3: warning: w\n");
}

TEST(MapLog, theFileInALineNumberWinsOverMesasFileZero) {
    EXPECT_EQ(mapLog("0:1000012(5): error: cannot access field `x' of structure\n", kFiles),
              "shaders/lib/reflectance/brdf.glsl:12: error: cannot access field `x' of structure\n");
    EXPECT_EQ(mapLog("0:2000012(5): error: beyond the list", kFiles), "0:2000012(5): error: beyond the list");
}

TEST(MapLog, placesOfNvidiaAreMapped) {
    EXPECT_EQ(mapLog("1(12) : error C1503: undefined variable \"x\"\n", kFiles),
              "shaders/lib/reflectance/brdf.glsl:12: error C1503: undefined variable \"x\"\n");
}

TEST(MapLog, placesOfGlslangAreMapped) {
    EXPECT_EQ(mapLog("ERROR: 1:12: 'x' : undeclared identifier\nWARNING: 0:3: w", kFiles),
              "shaders/lib/reflectance/brdf.glsl:12: error: 'x' : undeclared identifier\nshaders/passes/light.frag:3: "
              "warning: w");
}

TEST(MapLog, linesWithoutAKnownPlaceStay) {
    const std::string log =
        "error: linking failed\n2:12(5): error: beyond the list\n99999999999(1) : error\n\nERROR: 2 errors";
    EXPECT_EQ(mapLog(log, kFiles), log);
}

// Mesa's message for a recursive function.
TEST(MapLog, lineZeroIsNoPlace) {
    EXPECT_EQ(mapLog("0:0(0): error: function `float f(float)' has static recursion\nERROR: 0:0: x", kFiles),
              "error: function `float f(float)' has static recursion\nerror: x");
}

TEST(MapLog, warningsStandBehindAllElse) {
    EXPECT_EQ(
        errorsFirst("a.glsl:9: warning: `x' used uninitialized\na.glsl:2: error: no type\nb.glsl:3: warning C7: y\n"
                    "a.glsl:4: error: a line with : warning in it\ntwo errors\n"),
        "a.glsl:2: error: no type\na.glsl:4: error: a line with : warning in it\ntwo errors\n"
        "a.glsl:9: warning: `x' used uninitialized\nb.glsl:3: warning C7: y");
    EXPECT_EQ(errorsFirst("the driver gave no reason"), "the driver gave no reason");
    EXPECT_EQ(errorsFirst(""), "");
}

} // namespace
} // namespace tessera::shader
