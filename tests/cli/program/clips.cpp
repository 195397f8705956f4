#include <array>

#include <fmt/format.h>

#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

using testing::HasSubstr;

/// A white unlit triangle on black. The clip `slide` moves it from the left to the right within a second, `shrink`
/// halves its size; the camera is static.
class PlayedClips : public Cli {
protected:
    void SetUp() override {
        folder_.write("slide.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "extensionsUsed": ["KHR_materials_unlit"],
            "nodes": [{"mesh": 0, "name": "triangle"}, {"camera": 0, "name": "front", "translation": [0, 0, 5]}],
            "cameras": [{"type": "orthographic",
                         "orthographic": {"xmag": 4, "ymag": 2, "znear": 0.1, "zfar": 10}}],
            "materials": [{"extensions": {"KHR_materials_unlit": {}}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "animations": [
                {"name": "slide", "samplers": [{"input": 1, "output": 2}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
                {"name": "shrink", "samplers": [{"input": 1, "output": 3}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
                          {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
                          {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                            {"buffer": 0, "byteOffset": 44, "byteLength": 24},
                            {"buffer": 0, "byteOffset": 68, "byteLength": 24}],
            "buffers": [{"byteLength": 92, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAADAAAAAAAAAAAAAAABAAAAAAAAAAAAAAIA/AACAPwAAgD8AAAA/AAAAPwAAAD8="}]})");
    }

    static Words command(const Words& more) {
        Words words{"render", "slide.gltf", "--size", "64x32"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// Numbers of white pixels left and right of the centre.
    std::array<int, 2> sides(const std::string& name) const {
        const Picture shown = picture(name);
        std::array<int, 2> count{};
        for (std::size_t i = 0; i < shown.pixelCount(); ++i)
            if (shown.pixel(i)[0] > 0.5f) ++count[i % 64 < 32 ? 0 : 1];
        return count;
    }
};

TEST_F(PlayedClips, timeMovesTheClipThatPlays) {
    EXPECT_EQ(runGood(command({"-o", "a.exr"})), "clip 0 'slide' (of 0 to 1), 1 s\n");
    EXPECT_EQ(sides("a.exr")[1], 0);
    EXPECT_EQ(runGood(command({"-o", "b.exr", "--time", "1", "--quiet"})), "");
    EXPECT_EQ(sides("b.exr")[0], 0);
    EXPECT_EQ(sides("b.exr")[1], sides("a.exr")[0]);
    EXPECT_EQ(runGood(command({"-o", "c.exr", "--time", "1", "--clip", "1"})), "clip 1 'shrink' (of 0 to 1), 1 s\n");
    EXPECT_LT(sides("c.exr")[0] + sides("c.exr")[1], sides("a.exr")[0] / 2);
    EXPECT_EQ(runGood(command({"-o", "d.exr", "--time", "1", "--clip", "none"})), "no clip of 2\n");
    EXPECT_EQ(sides("d.exr")[0], sides("d.exr")[1]);
}

TEST_F(PlayedClips, framesOfASequenceAreThePicturesOfTheirTimes) {
    runGood(command({"--frames", "3", "--fps", "2", "-o", "f_%d.exr"}));
    for (int frame = 0; frame < 3; ++frame) {
        runGood(command({"--time", fmt::format("{}", 0.5 * frame), "-o", "one.exr"}));
        EXPECT_EQ(text("one.exr"), text(fmt::format("f_{}.exr", frame))) << frame;
    }
    EXPECT_NE(text("f_0.exr"), text("f_1.exr"));
    // The reference reads the same vertices.
    runGood({"compare", "slide.gltf", "--size", "64x32", "--time", "0.3", "--against", "reference"});
}

TEST_F(PlayedClips, framesBehindTheEndOfAClipAreReportedAndShowItAgainWhereItIsRepeated) {
    EXPECT_THAT(runGood(command({"--frames", "6", "--fps", "2", "-o", "f_%d.exr"})),
                HasSubstr("\nframes 3 to 5 lie behind the clip's end at 1 s, where it stands still; --loop begins it "
                          "again\n"));
    EXPECT_EQ(text("f_5.exr"), text("f_2.exr"));
    EXPECT_THAT(runGood(command({"--frames", "3:3", "--fps", "2", "-o", "f_%d.exr"})), HasSubstr("\nframe 3 lies "));
    const std::string said = runGood(command({"--frames", "6", "--fps", "2", "--loop", "-o", "l_%d.exr"}));
    EXPECT_THAT(said, testing::Not(HasSubstr("--loop")));
    for (int frame = 0; frame < 6; ++frame)
        EXPECT_EQ(text(fmt::format("l_{}.exr", frame)), text(fmt::format("f_{}.exr", frame % 2))) << frame;
    EXPECT_THAT(runGood(command({"--frames", "3", "--fps", "2", "-o", "f_%d.exr"})), testing::Not(HasSubstr("--loop")))
        << "the last shows the end itself";
    EXPECT_THAT(run(command({"--frames", "1", "--loop", "--clip", "none", "-o", "n_%d.exr"})).err,
                HasSubstr("--loop changes nothing. No clip plays"));
    expectError(kBadInput, command({"--loop", "-o", "a.exr"}), {"--loop needs --frames"});
}

using PlayedClipsSlow = PlayedClips;
TEST_F(PlayedClipsSlow, framesThatAreKilledAnywhereAndStartedAgainAreTheSame) {
    const auto words = [](const std::string& name) {
        return command({"--frames", "60", "--fps", "60", "-o", name + "%02d.exr"});
    };
    runGood(words("whole_"));
    EXPECT_GT(killedUntilItEnds(words("killed_")), 0);
    for (int frame = 0; frame < 60; ++frame)
        EXPECT_TRUE(text(fmt::format("killed_{:02}.exr", frame)) == text(fmt::format("whole_{:02}.exr", frame)))
            << frame;
}

TEST_F(PlayedClips, finishedFramesOfAnotherClipAreDrawnAgain) {
    runGood(command({"--frames", "2", "-o", "f_%d.exr"}));
    EXPECT_THAT(runGood(command({"--frames", "2", "-o", "f_%d.exr"})), HasSubstr("0 drawn, 2 skipped"));
    EXPECT_THAT(runGood(command({"--frames", "2", "-o", "f_%d.exr", "--clip", "shrink"})), HasSubstr("2 drawn"));
}

TEST_F(PlayedClips, aClipThatIsNotThereIsRefusedWithTheNamesOfThoseThatAre) {
    expectError(kBadInput, command({"-o", "a.exr", "--clip", "slid"}),
                {"no clip of the scene is called 'slid'", "did you mean 'slide'"});
}

} // namespace
} // namespace tessera::test
