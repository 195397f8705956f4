#include <cstdlib>
#include <filesystem>

#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Demo : public Cli {};

TEST_F(Demo, theReportAndItsPicturesAreWrittenWhereItSays) {
    const std::string said = runGood({"demo", "lattice", "--lights", "8", "--size", "160x90", "-o", "out/report"});
    EXPECT_THAT(said, HasSubstr("report    out/report/index.html\n"));
    EXPECT_THAT(said, HasSubstr("pictures  out/report/*.png\n"));
    EXPECT_THAT(said, HasSubstr(" take "));
    const std::string page = text("out/report/index.html");
    EXPECT_THAT(page.substr(0, 200), HasSubstr("<!DOCTYPE html>"));
    EXPECT_THAT(page, HasSubstr("tessera compare lattice"));
    EXPECT_THAT(page, HasSubstr("Error against run time"));
    // forward and forward_plus once, and both deferred techniques in two layouts.
    EXPECT_EQ(json("out/report/bench/bench.json")["points"].size(), 6u);
    for (const char* name :
         {"forward", "tiled_deferred", "forward_plus", "clustered_deferred", "tiled_deferred_packed"})
        EXPECT_EQ(picture(std::string("out/report/") + name + ".png").width, 160) << name;
    EXPECT_EQ(picture("out/report/lattice.exr").height, 90);
}

TEST_F(Demo, theNameThatAFileGivesASceneNeverLeadsOutOfTheFolder) {
    folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.write("s.json", R"json({"tessera": 1, "name": "../../a $(b)", "include": [{"file": "m.obj"}]})json");
    runGood({"--quiet", "demo", "s.json", "--size", "32x18", "-o", "out/report"});
    EXPECT_EQ(picture("out/report/_._.._a_$b.exr").width, 32);
    EXPECT_THAT(text("out/report/index.html"), HasSubstr("tessera compare s.json"));
}

TEST_F(Demo, aWindowsContextGivesThePictureOfEglBitForBit) {
    if (runShell("command -v xvfb-run", folder_.path()).exitCode != 0) GTEST_SKIP() << "xvfb-run is not installed";
    runGood({"render", "lattice", "--lights", "8", "--size", "160x90", "--context", "egl", "-o", "egl.exr"});
    const std::string render = " render lattice --lights 8 --size 160x90 --context window -o window.exr";
    const ProcessResult window = runShell("exec xvfb-run -a " + std::string(kProgram) + render, folder_.path());
    EXPECT_EQ(window.exitCode, 0) << window.err;
    EXPECT_TRUE(text("window.exr") == text("egl.exr"));
}

} // namespace
} // namespace tessera::test
