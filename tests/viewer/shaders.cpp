// Shaders and hooks are reloaded when their files change; an error is shown while the last good image stays.
#include <fstream>
#include <sstream>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerShaders : public ViewerTest {
protected:
    void SetUp() override {
        ViewerTest::SetUp();
        std::filesystem::copy(std::filesystem::path(TESSERA_SOURCE_DIR) / "shaders", shaders(),
                              std::filesystem::copy_options::recursive);
    }
    std::filesystem::path shaders() const { return folder_.path() / "shaders"; }
    std::string text() const {
        std::stringstream all;
        all << std::ifstream(shaders() / kFile).rdbuf();
        return all.str();
    }
    void write(const std::string& text) const { std::ofstream(shaders() / kFile) << text; }

    static constexpr const char* kFile = "passes/display.frag";
};

TEST_F(ViewerShaders, aBrokenShaderNeverTakesThePictureAndItsMendingIsSeen) {
    DrivenViewer viewer = open(kSpheres, {{"TESSERA_SHADERS", shaders().string()}});
    const glm::ivec2 size = viewer.waitForWhole(0);
    const Shot good = pictureIn(viewer, size);
    const std::string source = text();

    std::size_t mark = viewer.mark();
    write(source + "\nthis is no GLSL;\n");
    const std::string fault = viewer.waitFor("shader error ", mark);
    EXPECT_NE(fault.find(std::string(kFile) + ":"), std::string::npos) << fault;
    viewer.pause(1.0);
    for (const std::string& line : viewer.lines())
        EXPECT_EQ(line.find("It is program"), std::string::npos) << "its defines bury the error: " << line;
    // The message covers the lower part; above it is the last good image.
    const glm::ivec2 upper(size.x, size.y / 2);
    const Shot broken = pictureIn(viewer, size);
    EXPECT_TRUE(broken.part({0, 0}, upper) == good.part({0, 0}, upper));
    EXPECT_GT(differingShare(broken, good), 0.01) << "nothing is said in the window";

    mark = viewer.mark();
    write(source);
    viewer.waitFor("shaders reloaded", mark);
    viewer.waitForWhole(mark);
    const Shot mended = pictureIn(viewer, size);
    EXPECT_TRUE(mended.part({0, 0}, upper) == good.part({0, 0}, upper));
    EXPECT_GT(differingShare(mended, good), 0.01) << "no message says that they are good again";
    EXPECT_LT(differingShare(mended, good), 0.12) << "a line is enough";
    viewer.key("Escape");
    viewer.pause(0.5);
    EXPECT_TRUE(pictureIn(viewer, size) == good);

    mark = viewer.mark();
    const std::size_t main = source.rfind('}');
    ASSERT_NE(main, std::string::npos);
    const std::string output = source.substr(source.find("out vec4 ") + 9,
                                             source.find(';', source.find("out vec4 ")) - source.find("out vec4 ") - 9);
    write(source.substr(0, main) + "    " + output + ".rgb = " + output + ".bgr;\n}\n");
    viewer.key("F5");
    viewer.waitFor("shaders reloaded", mark);
    viewer.waitForWhole(mark);
    const Shot swapped = pictureIn(viewer, size);
    EXPECT_GT(differingShare(swapped, good, 4), 0.3);
    const glm::ivec2 somewhere(size.x / 2, size.y / 2);
    EXPECT_EQ(swapped.at(somewhere), glm::ivec3(good.at(somewhere).z, good.at(somewhere).y, good.at(somewhere).x));
}

class ViewerHooks : public ViewerTest {};

TEST_F(ViewerHooks, anEditedHookIsReadWhileNothingElseHappensAndTheOutlineFollowsWhatItMoves) {
    const auto writeHook = [&](const std::string& metres) {
        folder_.write("lift.glsl", "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)\n{\n"
                                   "    positionOS.y += " +
                                       metres + ";\n}\n");
    };
    writeHook("0.0");
    folder_.write("card.obj", "o card\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
    folder_.write("card.json", R"({"tessera": 1, "include": [{"file": "card.obj"}],
        "materials": [{"name": "paint", "model": "single_color", "color": [0.402, 0.1, 0.3]}],
        "overrides": [{"node": "card", "material": "paint"}],
        "hook": {"file": "lift.glsl", "mayMoveMetres": 0.5},
        "cameras": [{"name": "front", "position": [0, 0, 8], "target": [0, 0, 0], "fovYDegrees": 30}]})");
    DrivenViewer viewer = open({"card.json"});
    const glm::ivec2 size = viewer.waitForWhole(0), upper(size.x, size.y / 2); // the message covers the lower part
    std::size_t mark = viewer.mark();
    viewer.click(middlePixel());
    EXPECT_EQ(viewer.waitFor("picked ", mark), "picked paint");
    viewer.waitFor("outlined paint", mark);
    viewer.pause(1.0);
    const Shot low = pictureIn(viewer, upper);
    mark = viewer.mark();
    writeHook("0.4");
    viewer.waitFor("shaders reloaded", mark);
    viewer.waitFor("outlined paint", mark);
    viewer.pause(0.5);
    EXPECT_GT(differingShare(pictureIn(viewer, upper), low), 0.02) << "the card has not moved";
}

} // namespace
} // namespace tessera::test
