#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

class BadOptions : public Cli {
protected:
    void SetUp() override { folder_.write("a.png", "an older picture"); }

    /// Expects `render room -o a.png` with further arguments to be refused.
    void expectRefused(const Words& more, const Words& parts) const {
        Words arguments{"render", "room", "-o", "a.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectError(kBadInput, arguments, parts);
    }
};

TEST_F(BadOptions, unknownNamesAreAnsweredWithTheNearest) {
    expectError(kBadInput, {"rendr"}, {"unknown command 'rendr'", "did you mean 'render'?"});
    expectError(kBadInput, {"--context", "egl", "plann", "room"}, {"unknown command 'plann'", "did you mean 'plan'?"});
    expectError(kBadInput, {"help", "rendr"}, {"unknown command 'rendr'", "did you mean 'render'?"});
    expectError(kBadInput, {"model.glb"}, {"'model.glb' is no command", "tessera view model.glb opens it"});
    expectError(kBadInput, {"render", "romm", "-o", "a.png"}, {"'romm'", "did you mean 'room'?"});
    expectRefused({"--technique", "defered"}, {"unknown technique 'defered'", "did you mean 'deferred'?"});
    expectRefused({"--technique", "zzz"}, {"unknown technique 'zzz'", "forward, forward_prepass, deferred"});
    expectRefused({"--layout", "pakced"}, {"unknown layout 'pakced'", "did you mean 'packed'?"});
    expectRefused({"--view", "depht"}, {"unknown view 'depht'", "did you mean 'depth'?"});
    expectRefused({"--view", "8"}, {"unknown view '8'", "1 to 7"});
    expectRefused({"--tonemap", "acess"}, {"unknown tone map 'acess'", "did you mean 'aces'?"});
    expectRefused({"--camera", "cornr"}, {"room: unknown camera 'cornr'", "did you mean 'corner'?"});
    expectRefused({"--filter", "exacct"}, {"'exacct'", "did you mean 'exact'?"});
    expectRefused({"--space", "wrld"}, {"'wrld'", "did you mean 'world'?"});
    expectRefused({"--cull-on", "comput"}, {"'comput'", "did you mean 'compute'?"});
    expectRefused({"--light-on", "framgent"}, {"unknown light-on 'framgent'", "did you mean 'fragment'?"});
    expectRefused({"--prune", "maybe"}, {"--prune 'maybe'", "on, off"});
    expectRefused({"--specular", "0"}, {"--specular '0'", "on, off"});
    expectRefused({"--light-units", "lux"}, {"unknown unit of light 'lux'", "valid are lumen, watt"});
    expectRefused({"--obj-colours", "bytes"}, {"unknown encoding of colours 'bytes'", "valid are srgb, linear"});
    expectRefused({"--background", "0.5"}, {"--background '0.5' is not three finite numbers"});
    expectRefused({"--background", "0,-1,0"}, {"cannot use the background 0,-1,0", "0 or more"});
    expectRefused({"--variant", "red"}, {"room: no model of the scene has variants, so none is called 'red'"});
    expectRefused({"--context", "elg"}, {"unknown context 'elg'", "did you mean 'egl'?"});
    expectError(kBadInput, {"scenes", "--context", "elg"}, {"unknown context 'elg'"});
    expectError(kBadInput, {"compare", "room", "--techniques", "forward,defered"}, {"'defered'", "'deferred'"});
    expectError(kBadInput, {"compare", "room", "--against", "forwad"}, {"'forwad'", "'forward'"});
}

TEST_F(BadOptions, unknownOptionsAndStrayWordsAreNamed) {
    expectRefused({"--techniqe", "deferred"}, {"unknown option '--techniqe'", "did you mean '--technique'?"});
    expectRefused({"--sise=4x4"}, {"unknown option '--sise'", "did you mean '--size'?"});
    expectRefused({"--qiet"}, {"unknown option '--qiet'", "did you mean '--quiet'?"});
    expectRefused({"--out", "b.png"}, {"unknown option '--out'", "did you mean '--output'?"});
    expectRefused({"--nonsense"}, {"unknown option '--nonsense'", "tessera render --help"});
    expectRefused({"other"}, {"render: unexpected argument 'other'"});
    expectRefused({"-o", "b.png"}, {"--output"});
    expectRefused({"--size"}, {"render: --size lacks its value: give it as --size WxH; see tessera render --help"});
    expectRefused({"--environment"}, {"--environment lacks its value: give it as --environment NAME; see"});
    expectError(kBadInput, {"render", "room", "-o=a.png"}, {"-o: takes its value behind a space"});
    expectError(kBadInput, {"--nonsense"}, {"unknown option '--nonsense'", "tessera --help"});
    expectError(kBadInput, {"render"}, {"render: ", "required", "tessera render --help"});
    expectError(kBadInput, {"render", "room"}, {"--output is required"});
}

TEST_F(BadOptions, lightingShadersOfATechniqueWithoutALightingPassAreRefused) {
    for (const char* technique : {"forward", "forward_prepass", "forward_plus", "clustered_forward"})
        for (const char* stage : {"fragment", "compute"})
            expectRefused({"--technique", technique, "--light-on", stage},
                          {std::string("technique ") + technique, std::string("light-on ") + stage, "deferred"});
}

TEST_F(BadOptions, sizesThatNoPictureHasAreRefused) {
    for (const char* size : {"0x0", "-1x5", "16385x9", "9x999999999999", "12", "16x", "16x9x3", "+16x9"})
        expectRefused({"--size", size}, {std::string("--size '") + size + "'", "1 to 16384"});
}

TEST_F(BadOptions, samplesThatCannotBeDrawnAreRefused) {
    for (const char* samples : {"0", "-1", "3", "8"})
        expectRefused({"--samples", samples, "--technique", "forward"},
                      {std::string("--samples ") + samples, "give one of 1, 2, 4"});
    expectRefused({"--samples", "four"}, {"--samples 'four' is not a whole number"});
    const Words parts{"technique deferred does not support samples 4", "forward, forward_prepass", "do"};
    expectRefused({"--samples", "4"}, parts);
    expectError(kBadInput, {"plan", "room", "--samples", "4"}, parts);
    expectError(kBadInput, {"compare", "room", "--samples", "4", "--techniques", "forward,deferred"}, parts);
    expectError(kBadInput, {"compare", "room", "--samples", "4", "--against", "deferred"}, parts);
}

TEST_F(BadOptions, malformedNumbersAreRefused) {
    for (const char* option : {"--exposure", "--time", "--range-tolerance"})
        for (const char* value : {"nan", "-inf", "1e999", "1,5"})
            expectRefused({option, value}, {std::string(option) + " '" + value + "' is not a finite number"});
    expectRefused({"--exposure", "1000"}, {"--exposure 1000", "-120 to 120"});
    expectRefused({"--range-tolerance", "-0.1"}, {"--range-tolerance -0.1 is below 0"});
    for (const char* option : {"--lights", "--frames"})
        for (const char* value : {"1.5", "99999999999"})
            expectRefused({option, value}, {std::string(option) + " '" + value + "' is not a whole number"});
    expectRefused({"--solo", "1.5"}, {"--solo '1.5' is not a whole number"});
    expectRefused({"--solo", "99999999999"}, {"--solo 99999999999: room has 1 light, counted from 0"});
    expectRefused({"--shadow-samples", "2147483648"}, {"--shadow-samples 2147483648 is above 1024; give 1 to 1024"});
}

TEST_F(BadOptions, lengthsBeyondThoseOfSinglePrecisionAreRefused) {
    expectRefused({"--environment-rotation", "1e300"}, {"--environment-rotation '1e300'", "single precision"});
    expectRefused({"--near", "1e-30"}, {"near plane at 1e-30 m", "1e-09 to 1e+15 m"});
    expectRefused({"--eye", "1e30,0,0"}, {"more than 1e+15 m from the origin"});
    folder_.write("vast.json",
                  R"({"tessera": 1, "include": [{"file": "builtin:room", "transform": {"scale": 1e30}}]})");
    expectError(kBadInput, {"render", "vast.json", "-o", "a.png"},
                {"scene 'vast'", "more than 1e+15 m from the origin"});
}

TEST_F(BadOptions, lightsThatASceneCannotHaveAreRefused) {
    expectRefused({"--lights", "-1"}, {"-1 lights", "0 to 262144"});
    expectRefused({"--lights", "262145"}, {"262145 lights", "0 to 262144"});
    expectRefused({"--solo", "1"}, {"--solo 1: room has 1 light, counted from 0"});
    expectRefused({"--solo", "-1"}, {"--solo -1: room has 1 light"});
    expectError(kBadInput, {"render", "lattice", "--lights", "0", "--solo", "0", "-o", "a.png"},
                {"lattice has 0 lights"});
}

TEST_F(BadOptions, sequencesThatCannotBeNumberedAreRefused) {
    const auto expectSequenceRefused = [&](const Words& more, const Words& parts) {
        Words arguments{"render", "room"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectError(kBadInput, arguments, parts);
    };
    for (const char* pattern : {"a.png", "a_%d_%d.png", "a_%x.png", "a_%4d.png"})
        expectSequenceRefused({"--frames", "2", "-o", pattern}, {pattern, "f_%04d.png"});
    expectSequenceRefused({"--frames", "0", "-o", "a_%d.png"}, {"--frames 0"});
    expectSequenceRefused({"--frames", "-2", "-o", "a_%d.png"}, {"--frames -2"});
    expectSequenceRefused({"--frames", "2000000000", "-o", "a_%d.png"},
                          {"--frames 2000000000 is more than 1000000 pictures"});
    expectSequenceRefused({"--frames", "5:2", "-o", "a_%d.png"}, {"--frames 5:2 ends before it begins"});
    expectSequenceRefused({"--frames", "0:5:0", "-o", "a_%d.png"}, {"--frames 0:5:0", "step is less than 1"});
    expectSequenceRefused({"--frames", "2", "--shard", "3/2", "-o", "a_%d.png"}, {"--shard 3/2", "1/4"});
    expectSequenceRefused({"--shard", "1/2", "-o", "a.png"}, {"--shard needs --frames"});
    for (const char* fps : {"0", "-1"})
        expectSequenceRefused({"--frames", "2", "--fps", fps, "-o", "a_%d.png"}, {std::string("--fps ") + fps});
    for (const char* fps : {"nan", "inf"})
        expectSequenceRefused({"--frames", "2", "--fps", fps, "-o", "a_%d.png"}, {std::string("--fps '") + fps});
    expectSequenceRefused({"--frames", "2", "--fps", "1e-320", "-o", "a_%d.png"},
                          {"frame 1 has no finite time", "--fps"});
    expectSequenceRefused({"--fps", "25", "-o", "a.png"}, {"--fps needs --frames"});
}

TEST_F(BadOptions, aNameForASequenceIsRefusedForOnePicture) {
    for (const char* name : {"x_%04d.png", "x_%d.exr"})
        expectError(kBadInput, {"render", "room", "-o", name}, {name, "place for a frame number", "--frames"});
}

TEST_F(BadOptions, aPlanOfTheReferenceIsRefusedWithTheReason) {
    expectError(kBadInput, {"plan", "room", "--technique", "reference"},
                {"the reference has no plan", "without passes"});
}

TEST_F(BadOptions, aViewerWithoutADisplaySaysThatItIsMissing) {
    const ProcessResult result = run({"view"}, {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, testing::StartsWith("tessera: error: there is no display for the viewer's window"));
}

TEST_F(BadOptions, picturesOfOtherKindsAreRefused) {
    for (const char* name : {"b.jpg", "b", ".png"})
        expectError(kBadInput, {"render", "room", "-o", name}, {".exr", ".png"});
}

TEST_F(BadOptions, comparisonsThatCannotBeMadeAreRefused) {
    expectError(kBadInput, {"compare", "room", "--techniques", "forward,forward"}, {"forward twice"});
    expectError(kBadInput, {"compare", "room", "--techniques", "forward", "--technique", "deferred"},
                {"--technique and --techniques", "give --techniques alone"});
    expectError(kBadInput, {"compare", "room", "--techniques", "forward,"}, {"unknown technique ''"});
    expectError(kBadInput, {"compare", "room", "--against", "nix.exr"}, {"nix.exr"});
    expectError(kBadInput, {"compare", "room", "--size", "16x9", "--against", "a.png"},
                {"a.png: is in no known picture format; convert the picture to png"});
    for (const char* name : {"x.null", "x.mp4"}) {
        folder_.write(name, "not a picture");
        expectError(kBadInput, {"compare", "room", "--size", "16x9", "--against", name},
                    {std::string(name) + ": the picture format " + (name + 2) + " is not supported"});
    }
    folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    ASSERT_EQ(run({"--quiet", "render", "m.obj", "--size", "160x90", "-o", "b.exr"}).exitCode, 0);
    expectError(
        kBadInput,
        {"--quiet", "compare", "m.obj", "--no-default-light", "--against", "b.exr", "--memory-limit", "600K"},
        {"b.exr: the picture of 160x90 texels", "may take 600.0 KiB; use a smaller file, or raise the memory limit"});
    folder_.write("empty.exr", "");
    expectError(kBadInput, {"compare", "room", "--size", "16x9", "--against", "empty.exr"}, {"empty.exr", "empty"});
}

TEST_F(BadOptions, aMalformedMemoryLimitIsRefused) {
    for (const char* size : {"0", "-1", "4T", "4 G", "G", "1e9", "99999999999999999999", "17179869184G"})
        expectRefused({"--memory-limit", size}, {std::string("--memory-limit '") + size + "' is no size", "as in 4G"});
    folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectError(kBadInput, {"plan", "m.obj", "--memory-limit", "512"},
                {"m.obj:", "may take 512 B; use a smaller file, or raise the memory limit"});
    EXPECT_EQ(run({"plan", "m.obj", "--no-default-light", "--memory-limit", "1M"}).exitCode, 0);
}

TEST_F(BadOptions, outputsDoNotOverwriteInputs) {
    folder_.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    folder_.write("m.mtl", "newmtl m\nmap_Kd paint.png\n");
    ASSERT_EQ(run({"render", "room", "--size", "16x9", "-o", "paint.png"}).exitCode, 0);
    std::filesystem::create_symlink("m.obj", folder_.path() / "link.json");
    const std::string written = "would be written over";
    expectError(kBadInput, {"--quiet", "render", "m.obj", "-o", "paint.png"}, {"paint.png", written});
    expectError(kBadInput, {"--quiet", "render", "m.obj", "-o", "./paint.png"}, {"paint.png"});
    expectError(kBadInput, {"--quiet", "plan", "m.obj", "--json", "m.mtl"}, {"m.mtl", written});
    expectError(kBadInput, {"--quiet", "plan", "m.obj", "--dot", "link.json"}, {"link.json", written});
    expectError(kBadInput, {"plan", "room", "--json", "p", "--dot", "./p"}, {"p", "two outputs have this name"});
    expectError(kBadInput, {"compare", "room", "--size", "16x9", "--against", "paint.png", "--json", "paint.png"},
                {"paint.png", written});
}

TEST_F(BadOptions, aBenchmarkDoesNotOverwriteItsInputs) {
    const std::string quad = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string including = R"({"tessera": 1, "include": [{"file": "../m.obj"}]})";
    folder_.write("m.obj", quad);
    folder_.write("out/bench.json", including);
    folder_.write("out/report.obj", "mtllib report.html\n" + quad);
    folder_.write("out/report.html", "newmtl paint\n");
    folder_.write("out/parts/scene.obj", quad);
    const std::string written = "would be written over";
    for (const auto& [scene, file] : {std::pair{"out/bench.json", "out/bench.json"},
                                      {"out/report.obj", "out/report.html"},
                                      {"out/parts/scene.obj", "out/parts/scene.obj"}})
        expectError(kBadInput, {"--quiet", "bench", scene, "-o", "out"}, {file, written});
    expectError(kBadInput, {"--quiet", "bench", "room", "--matrix", "out/report.html", "-o", "out"},
                {"out/report.html", written});
}

TEST_F(BadOptions, aDemonstrationDoesNotOverwriteItsInputs) {
    folder_.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    folder_.write("m.mtl", "newmtl m\nmap_Kd forward.png\n");
    folder_.write("bench/bench.json", R"({"tessera": 1, "include": [{"file": "../m.obj"}]})");
    ASSERT_EQ(run({"render", "room", "--size", "16x9", "-o", "forward.png"}).exitCode, 0);
    const std::string written = "would be written over";
    expectError(kBadInput, {"--quiet", "demo", "m.obj", "-o", "."}, {"forward.png", written});
    std::filesystem::rename(path("forward.png"), path("paint.png"));
    folder_.write("m.mtl", "newmtl m\nmap_Kd paint.png\n");
    expectError(kBadInput, {"--quiet", "demo", "bench/bench.json", "-o", "."}, {"bench/bench.json", written});
}

TEST_F(BadOptions, debugViewsAreRefusedWhereATechniqueIsRecommended) {
    for (const char* command : {"bench", "demo"})
        expectError(kBadInput, {command, "room", "--view", "normal", "-o", "out"},
                    {"--view normal", std::string(command) + " recommends a technique"});
}

TEST_F(BadOptions, heatMapsDoNotOverwriteInputsOrOtherOutputs) {
    ASSERT_EQ(run({"render", "room", "--size", "16x9", "-o", "deferred_flip.png"}).exitCode, 0);
    std::filesystem::create_directory(path("maps"));
    const Words compare{"compare", "room", "--size", "16x9", "--heatmap"};
    Words against = compare, json = compare;
    against.insert(against.end(), {".", "--against", "deferred_flip.png"});
    json.insert(json.end(), {"maps", "--json", "maps/../maps/deferred.png"});
    expectError(kBadInput, against, {"deferred_flip.png", "would be written over"});
    expectError(kBadInput, json, {"maps/deferred.png", "two outputs have this name"});
}

TEST_F(BadOptions, controlCharactersOfAMessageAreEscaped) {
    expectError(kBadInput, {"plan", "a\x1b[31m.obj"}, {"a\\x1b[31m.obj"});
    expectError(kBadInput, {"plan", "room", "--technique", "de\nf"}, {"de; f"});
}

TEST_F(BadOptions, anErrorThatCannotBePrintedKeepsItsExitCode) {
    for (const char* closed : {"2>/dev/full", "2>&-"}) {
        const ProcessResult result = runShell(std::string(kProgram) + " plan nix.obj " + closed, folder_.path());
        EXPECT_EQ(result.exitCode, kBadInput) << closed;
    }
    // A closed stream's descriptor is never reused for a file, in which messages would end.
    folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ncurv 1 2\nf 1 2 3\n");
    ASSERT_EQ(runShell(std::string(kProgram) + " plan m.obj --json p.json 2>&-", folder_.path()).exitCode, 0);
    EXPECT_EQ(json("p.json").at("scene"), "m");
}

TEST_F(BadOptions, aDriverWithoutOpenGl45IsNamedWithWhatItOffers) {
    expectError(1, {"render", "room", "-o", "a.png", "--context", "egl"},
                {"no OpenGL 4.5 context", "the driver 'softpipe' offers OpenGL", "use another driver"},
                {{"GALLIUM_DRIVER", "softpipe"}, {"LIBGL_ALWAYS_SOFTWARE", "1"}});
}

TEST_F(BadOptions, anEmptyValueIsRefused) {
    for (const char* option : {"--technique", "--size", "--camera", "--output", "--time", "--lights", "--memory-limit"})
        expectRefused({option, ""}, {option, "is empty; give a value"});
    expectError(kBadInput, {"plan", "room", "--json", ""}, {"--json", "is empty; give a value"});
    expectError(kBadInput, {"compare", "room", "--heatmap", ""}, {"--heatmap", "is empty; give a value"});
    expectError(kBadInput, {"bench", "room", "-o", "out", "--matrix", ""}, {"--matrix", "is empty; give a value"});
}

TEST_F(BadOptions, nothingBehindAnEqualsSignIsRefusedWhereverItStands) {
    const std::string said = "render: --shadow-samples: is empty; give a value";
    expectError(kBadInput, {"render", "--shadow-samples=", "room", "-o", "a.png"}, {said});
    expectError(kBadInput, {"render", "room", "--shadow-samples=", "-o", "a.png"}, {said});
    expectRefused({"--shadow-samples="}, {said});
    expectRefused({"--quiet="}, {"--quiet: is empty; give a value"});
    expectRefused({"--sise="}, {"unknown option '--sise'", "did you mean '--size'?"});
}

TEST_F(BadOptions, aMatrixThatIsNoRegularFileIsRefusedBeforeItIsRead) {
    for (const char* file : {"/dev/zero", "."})
        expectError(kBadInput, {"bench", "room", "-o", "out", "--matrix", file}, {file, "is not a regular file"});
}

} // namespace
} // namespace tessera::test
