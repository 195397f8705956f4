#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include "tests/cli/program/Cli.h"
#include "tests/support/Sweep.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::test {
namespace {

class Render : public Cli {
protected:
    OIIO::ImageSpec specOf(const std::string& name) const {
        const auto input = OIIO::ImageInput::open(path(name));
        EXPECT_TRUE(input) << OIIO::geterror();
        return input ? input->spec() : OIIO::ImageSpec();
    }
    /// For both filters that take samples in a whole sweep, else for one.
    void expectCauseOfTooManyIterationsNamed();
};
using RenderSlow = Render;

TEST_F(Render, picturesHaveTheRequestedSizeAndFormat) {
    EXPECT_EQ(runGood({"render", "lattice", "--lights", "8", "--size", "161x91", "-o", "a.exr"}), "");
    EXPECT_EQ(runGood({"render", "lattice", "--lights", "8", "--size", "161x91", "-o", "a.png"}), "");
    const OIIO::ImageSpec exr = specOf("a.exr"), png = specOf("a.png");
    EXPECT_EQ(exr.width, 161);
    EXPECT_EQ(exr.height, 91);
    EXPECT_EQ(exr.nchannels, 4);
    EXPECT_EQ(exr.format, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT));
    EXPECT_EQ(exr.get_string_attribute("oiio:ColorSpace"), "Linear");
    EXPECT_EQ(png.width, 161);
    EXPECT_EQ(png.height, 91);
    EXPECT_EQ(png.nchannels, 3);
    EXPECT_EQ(png.format, OIIO::TypeDesc(OIIO::TypeDesc::UINT8));
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(Render, exrIsTheLinearPictureThatPngShows) {
    // Unlit colour c is exactly radiance c, displayed as sRGB of c.
    writeQuad(R"({"name": "paint", "model": "single_color", "color": [0.5, 0.25, 4]})", "[]");
    runGood({"render", "quad.json", "--size", "16x9", "-o", "a.exr"});
    runGood({"render", "quad.json", "--size", "16x9", "-o", "a.png"});
    const Picture exr = picture("a.exr"), png = picture("a.png");
    const float step = 0.005f; // one step of 8-bit sRGB near 1/2
    for (std::size_t i = 0; i < exr.pixelCount(); ++i) {
        ASSERT_EQ(exr.pixel(i)[0], 0.5f);
        ASSERT_EQ(exr.pixel(i)[1], 0.25f);
        ASSERT_EQ(exr.pixel(i)[2], 4.0f);
        ASSERT_NEAR(png.pixel(i)[0], 0.5f, step);
        ASSERT_NEAR(png.pixel(i)[1], 0.25f, step);
        ASSERT_EQ(png.pixel(i)[2], 1.0f);
    }
}

TEST_F(Render, theReferenceShowsThePictureOfEveryTechniqueAndWritesSequencesToo) {
    const Words frame{"render", "room", "--camera", "corner", "--size", "64x36", "--exposure", "1"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), frame.begin(), frame.end());
        return more;
    };
    EXPECT_EQ(runGood(with({"-o", "own.exr"})), "");
    EXPECT_THAT(runGood(with({"--technique", "reference", "-o", "true_%d.exr", "--frames", "2"})),
                testing::StartsWith("2 frames: 2 drawn, 0 skipped, median "));
    const Picture own = picture("own.exr"), reference = picture("true_0.exr");
    // fp32 lighting of a room of matt walls: ten roundings.
    EXPECT_LE(validation::errorFigures(own, reference).p999Rel, 1e-5);
    EXPECT_EQ(text("true_0.exr"), text("true_1.exr"));
    for (const std::string map : {"none", "khronos_neutral", "aces", "agx"}) {
        SCOPED_TRACE(map);
        runGood(with({"--tonemap", map, "-o", "own.png"}));
        runGood(with({"--tonemap", map, "--technique", "reference", "-o", "true.png"}));
        const Picture ownShown = picture("own.png"), shown = picture("true.png");
        for (std::size_t i = 0; i < shown.pixelCount(); ++i)
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown.pixel(i)[c], ownShown.pixel(i)[c], 0.01f); // one 8-bit step
    }
    expectError(2, with({"--technique", "reference", "--view", "depth", "-o", "b.png"}), {"reference", "depth"});
}

TEST_F(Render, runToRunPicturesAreTheSameAndReplaceOlderOnes) {
    folder_.write("a.exr", "an older picture");
    const Words words{"render", "lattice", "--lights", "8", "--size", "160x90", "-o", "a.exr"};
    runGood(words);
    const std::string first = text("a.exr");
    folder_.write("a.exr", "an older picture");
    runGood(words);
    EXPECT_TRUE(text("a.exr") == first);
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(Render, frameKOfASequenceIsThePictureAtItsTime) {
    writeQuad(R"({"name": "paint", "model": "lambert"})",
              R"([{"type": "point", "position": [2, 0, 1], "intensity": 3,
                   "animation": {"type": "orbit", "center": [0, 0, 1], "axis": [0, 0, 1], "periodSeconds": 4}}])");
    const Words common{"render", "quad.json", "--size", "32x18"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), common.begin(), common.end());
        return more;
    };
    runGood(with({"--frames", "3", "--fps", "2", "-o", "f_%04d.exr"}));
    EXPECT_EQ(files().size(), 6u) << "the scene's two, the frames, and what is known of them";
    std::map<std::string, std::string> made = files();
    EXPECT_TRUE(made["f_0000.exr"] != made["f_0001.exr"] && made["f_0001.exr"] != made["f_0002.exr"] &&
                made["f_0000.exr"] != made["f_0002.exr"]);
    const char* times[] = {"0", "0.5", "1"};
    for (int k = 0; k < 3; ++k) {
        runGood(with({"--time", times[k], "-o", "t.exr"}));
        EXPECT_TRUE(text("t.exr") == made["f_000" + std::to_string(k) + ".exr"]) << "frame " << k;
    }
    runGood(with({"--time", "0.5", "--frames", "1", "-o", "g%d.exr"}));
    EXPECT_TRUE(text("g0.exr") == made["f_0001.exr"]) << "--time is where a sequence starts";
}

TEST_F(Render, quietSilencesWarningsAndNothingElse) {
    folder_.write("tri.obj", "mtllib none.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const ProcessResult loud = run({"render", "tri.obj", "--size", "16x9", "-o", "a.png"});
    EXPECT_EQ(loud.exitCode, 0);
    EXPECT_THAT(loud.err, testing::HasSubstr("tessera: warning: tri: ")) << "the library of materials is missing";
    EXPECT_THAT(loud.out, testing::StartsWith("no light and no camera in it: lit by the environment 'studio', "))
        << "and what the scene was given is no warning";
    const std::string first = text("a.png");
    EXPECT_EQ(runGood({"--quiet", "render", "tri.obj", "--size", "16x9", "-o", "a.png"}), "");
    EXPECT_EQ(runGood({"render", "tri.obj", "--size", "16x9", "-o", "b.png", "--quiet"}), "");
    EXPECT_TRUE(text("a.png") == first && text("b.png") == first);
    expectError(2, {"--quiet", "render", "nix.obj", "-o", "a.png"}, {"nix.obj"});
}

TEST_F(Render, aPictureOfNothingSaysWhy) {
    folder_.write("tri.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    folder_.write("clear.mtl", "newmtl air\nd 0\n");
    folder_.write("clear.obj", "mtllib clear.mtl\nusemtl air\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    folder_.write("none.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})");
    for (const char* technique : {"forward", "reference"}) {
        const auto said = [&](const char* scene, std::vector<std::string> more) {
            std::vector<std::string> arguments = {"render", scene,         "--size",  "16x9",     "-o",
                                                  "a.png",  "--technique", technique, "--filter", "exact"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            const ProcessResult result = run(arguments);
            EXPECT_EQ(result.exitCode, 0) << result.err;
            return result.err;
        };
        EXPECT_THAT(said("tri.obj", {}), testing::Not(testing::HasSubstr("a.png: ")));
        EXPECT_THAT(said("tri.obj", {"--near", "1000", "--far", "1001"}),
                    testing::HasSubstr("warning: a.png: the camera sees nothing of the scene"));
        EXPECT_THAT(said("clear.obj", {}),
                    testing::HasSubstr("warning: a.png: all surfaces of the scene are transparent"));
        EXPECT_THAT(said("none.gltf", {}), testing::HasSubstr("warning: a.png: the scene has no triangles to draw"));
    }
}

TEST_F(Render, aBlackPictureIsReportedSoButNotABlackDebugView) {
    folder_.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.write("dark.json", R"({"tessera": 1, "include": [{"file": "tri.obj"}],
        "lights": [{"type": "point", "position": [0, 0, 50], "falloff": {"type": "inverse_square", "range": 1}, "intensity": 1, "color": [1, 1, 1]}]})");
    const auto said = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", "dark.json", "--size", "16x9", "-o", "a.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    EXPECT_THAT(said({}), testing::HasSubstr("warning: a.png: is black: no light reaches the surfaces in view"));
    EXPECT_THAT(said({"--view", "diffuse"}), testing::Not(testing::HasSubstr("black")));
}

TEST_F(Render, pixelsThatAreNoNumbersAreCounted) {
    folder_.write("floor.obj", "mtllib floor.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvn 0 1 0\nusemtl mirror\n"
                               "f 4//1 3//1 2//1 1//1\n");
    folder_.write("floor.mtl", "newmtl mirror\nPm 1\nPr 0\nKd 1 1 1\n");
    const auto said = [&](const char* intensity) { // intensity of a light 1 cm above a mirror
        folder_.write(
            "s.json",
            std::string(R"({"tessera": 1, "include": [{"file": "floor.obj"}], "cameras": [{"position": [0, 1, 0],
                                      "target": [0, 0, 0], "up": [0, 0, -1]}], "lights": [{"type": "point",
                                      "position": [0, 0.01, 0], "intensity": )") +
                intensity + "}]}");
        return run({"render", "s.json", "--size", "65x37", "-o", "a.exr"}).err;
    };
    EXPECT_THAT(said("1e30"),
                testing::HasSubstr("warning: a.exr: 1 of its pixels are infinite or no numbers; a light is "
                                   "too bright or too near; dim it or move it away"));
    EXPECT_THAT(said("1e20"), testing::Not(testing::HasSubstr("pixels are infinite")));
}

TEST_F(Render, lightsThatTheBudgetLeavesWithoutShadowsAreReportedOnce) {
    const auto said = [&](const Words& more) {
        Words words{"render", "lattice", "--lights", "64",      "--shadows", "all", "--shadow-filter", "hard",
                    "--size", "16x9",    "-o",       "f%d.png", "--frames",  "2",   "--shadow-budget"};
        words.insert(words.end(), more.begin(), more.end());
        const ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    EXPECT_THAT(said({"0.01"}),
                testing::MatchesRegex("tessera: warning: f0.png: the budget of 0.01 MiB has no room for the maps of "
                                      "[0-9]+ lights, which cast no shadows; give more --shadow-budget\n"));
    EXPECT_THAT(said({"0.01", "--view", "shadow"}), testing::HasSubstr("cast no shadows"));
    EXPECT_EQ(said({"0.01", "--view", "normal"}), "") << "it shows no shadows";
    EXPECT_EQ(said({"1"}), "") << "smaller maps alone are reported by plan";
}

TEST_F(Render, aViewOfShadowsWithoutAnySaysWhy) {
    const auto said = [&](const Words& more) {
        Words words{"render", "lattice", "--lights", "64", "--size", "16x9", "-o", "a.png"};
        words.insert(words.end(), more.begin(), more.end());
        const ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    for (const char* view : {"shadow", "cascades", "shadow_atlas"})
        EXPECT_EQ(said({"--view", view}),
                  fmt::format("tessera: warning: a.png: the view {} has no shadow to show: no light in view has "
                              "castsShadow\n",
                              view));
    EXPECT_THAT(said({"--view", "shadow", "--shadows", "2", "--solo", "5"}),
                testing::HasSubstr("none of the first 2 lights is on and in view"));
    EXPECT_THAT(said({"--view", "shadow_atlas", "--shadows", "2"}),
                testing::HasSubstr("the shadow filter traced uses none; give --shadow-filter hard"));
    EXPECT_EQ(said({"--view", "shadow_atlas", "--shadows", "2", "--shadow-filter", "hard"}), "");
    EXPECT_EQ(said({"--view", "shadow", "--shadows", "2"}), "");
}

TEST_F(Render, settingsOfShadowsThatChangeNothingAreReported) {
    const auto said = [&](const Words& more) {
        Words words{"render", "lattice", "--lights", "64", "--size", "16x9", "-o", "a.png"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    EXPECT_EQ(
        said({"--shadow-width", "5"}),
        "tessera: warning: --shadow-width changes nothing. There are no shadows: no light in view has castsShadow\n");
    EXPECT_EQ(said({"--shadows", "all", "--shadow-filter", "hard", "--shadow-width", "5"}),
              "tessera: warning: --shadow-width changes nothing. Only pcf uses it; the shadow filter is hard\n");
    EXPECT_THAT(said({"--shadows", "all", "--shadow-budget", "2"}),
                testing::HasSubstr(
                    "--shadow-budget changes nothing. Only hard, pcf and pcss use it; the shadow filter is traced"));
    EXPECT_THAT(said({"--shadows", "all", "--shadow-samples", "4"}),
                testing::HasSubstr("no light with a size casts one"));
    EXPECT_THAT(said({"--shadows", "all", "--shadow-filter", "pcf", "--shadow-cascades", "2"}),
                testing::HasSubstr("No shadow of a directional light is looked up"));
    EXPECT_EQ(said({"--shadows", "all", "--shadow-filter", "pcss"}),
              "tessera: warning: --shadow-filter pcss looks up one texel, as hard does: no light in view that casts "
              "shadows has a size\n");
    EXPECT_EQ(said({"--shadow-filter", "pcf", "--technique", "reference"}),
              "tessera: warning: --shadow-filter changes nothing. The reference follows rays of its own\n");
    EXPECT_EQ(said({"--shadow-width", "5", "--view", "normal"}), "") << "the same options serve all views";
    EXPECT_EQ(said({"--shadows", "all", "--shadow-filter", "pcf", "--shadow-width", "5", "--shadow-budget", "2"}), "");
}

TEST_F(Render, settingsOfAnEnvironmentAndOfTechniquesThatChangeNothingAreReported) {
    writeQuad(R"({"name": "paint", "model": "lambert"})",
              R"([{"type": "directional", "direction": [0, 0, -1], "intensity": 1}])");
    const auto warned = [&](const std::string& why) { return "tessera: warning: " + why + "\n"; };
    const auto said = [&](const Words& more, const char* command = "render") {
        Words words{command, "quad.json", "--size", "16x9"};
        if (std::string(command) == "render") words.insert(words.end(), {"-o", "a.png"});
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    const std::string none = " changes nothing. There is no environment; choose a map";
    const std::string samples =
        warned("--environment-samples changes nothing. Only sampled uses it; the environment light is split_sum");
    const Words studio{"--environment", "studio", "--environment-samples", "4"};
    for (const char* command : {"render", "plan"}) {
        SCOPED_TRACE(command);
        EXPECT_EQ(
            said({"--environment-rotation", "90", "--environment-intensity", "2", "--backdrop", "sharp"}, command),
            warned("--environment-rotation" + none) + warned("--environment-intensity" + none) +
                warned("--backdrop" + none))
            << "sharp is the default, which is said all the same";
        EXPECT_EQ(said(studio, command), samples);
        EXPECT_EQ(said({"--environment", "studio", "--environment-samples", "4", "--environment-light", "sampled",
                        "--environment-rotation", "90", "--environment-intensity", "2", "--backdrop", "blurred"},
                       command),
                  "");
        EXPECT_EQ(said({"--refraction", "two_sides"}, command),
                  warned("--refraction changes nothing. No material that transmits has a thickness or is rough"));
        EXPECT_EQ(said({"--technique", "forward", "--layout", "packed"}, command),
                  warned("--layout changes nothing. Only deferred, deferred_volumes, tiled_deferred and "
                         "clustered_deferred use it; the technique is forward"));
        EXPECT_EQ(said({"--backdrop", "off", "--view", "normal"}, command), "") << "the same options serve all views";
        const Words studioBehind{"--environment", "studio", "--background", "1,0,0"};
        EXPECT_EQ(said(studioBehind, command),
                  warned("--background changes nothing. The environment is seen behind the scene; give --backdrop off, "
                         "or --environment none"));
        EXPECT_EQ(said({"--environment", "studio", "--background", "1,0,0", "--backdrop", "off"}, command), "");
        EXPECT_EQ(said({"--background", "1,0,0"}, command), "");
    }
    const Words compared{"--environment", "studio", "--environment-samples", "4", "--techniques", "deferred",
                         "--layout",      "packed"};
    EXPECT_THAT(said(compared, "compare"),
                testing::AllOf(testing::HasSubstr(samples), testing::Not(testing::HasSubstr("--layout"))))
        << "deferred stores surfaces";
    const std::string ofReference =
        said({"--environment", "studio", "--environment-light", "sampled", "--environment-samples", "4", "--technique",
              "reference", "--layout", "packed"});
    EXPECT_EQ(ofReference,
              warned("--layout changes nothing. The reference follows a ray a pixel, without passes") +
                  warned("--environment-samples changes nothing. The reference integrates in its own way"));
    EXPECT_EQ(said({"--technique", "reference", "--backdrop", "blurred"}), warned("--backdrop" + none));
    const std::string depth = "--glass-depth changes nothing. ";
    EXPECT_EQ(said({"--glass-depth", "2"}),
              warned(depth + "The reference alone uses it; draw by --technique reference, or compare with it"));
    EXPECT_EQ(said({"--glass-depth", "0"}), warned(depth + "No material that transmits has a thickness or is rough"));
    EXPECT_EQ(said({"--glass-depth", "2", "--technique", "reference"}),
              warned(depth + "No material that transmits has a thickness or is rough"));
    EXPECT_THAT(said({"--glass-depth", "2", "--against", "reference"}, "compare"),
                testing::HasSubstr(depth + "No material that transmits"));
}

TEST_F(Render, thatAMapIsFilteredIsReportedOnceAndNotAtAllWhereItIsQuiet) {
    writeQuad(R"({"name": "paint", "model": "lambert"})", "[]");
    runGood({"render", "room", "--size", "16x8", "-o", "map.exr"}); // so small a map is filtered quickly
    const auto said = [&](const char* command, const char* cache, const Words& more) {
        Words words{command, "quad.json", "--environment", "map.exr", "--size", "16x9"};
        words.insert(words.end(), more.begin(), more.end());
        const ProcessResult result = run(words, {{"XDG_CACHE_HOME", path(cache)}});
        EXPECT_EQ(result.exitCode, 0);
        return result.err;
    };
    const Words picture{"-o", "a.png"};
    EXPECT_EQ(said("render", "first", picture), kFilteringNote);
    EXPECT_EQ(said("render", "first", picture), "") << "it was kept";
    EXPECT_EQ(said("compare", "second", {"--techniques", "deferred"}), kFilteringNote);
    EXPECT_EQ(said("render", "third", {"-o", "a.png", "--quiet"}), "");
}

TEST_F(Render, settingsOfSubsurfaceScatteringThatChangeNothingAreReported) {
    const auto said = [&](const std::string& scene, const Words& more) {
        Words words{"render", scene, "--size", "16x9", "-o", "a.png"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    const std::string none =
        " changes nothing. No material has subsurface scattering; give one the key 'subsurface' in "
        "a scene file\n";
    EXPECT_EQ(said("lattice", {"--lights", "64", "--subsurface", "wrap", "--diffusion-texels", "64"}),
              "tessera: warning: --subsurface" + none + "tessera: warning: --diffusion-texels" + none);
    EXPECT_EQ(said("lattice", {"--lights", "64", "--subsurface", "none"}), "") << "requests what there is";
    EXPECT_EQ(said("lattice", {"--lights", "64", "--subsurface", "wrap", "--view", "normal"}), "")
        << "the same options serve all views";
    EXPECT_EQ(said("diffusion_truth", {"--subsurface", "wrap", "--shadows", "none"}), "");
    EXPECT_EQ(said("diffusion_truth", {"--subsurface", "wrap", "--shadows", "none", "--diffusion-half", "on"}),
              "tessera: warning: --diffusion-half changes nothing. No surface diffuses light; give --subsurface "
              "texture_space_diffusion\n");
    EXPECT_THAT(said("diffusion_truth", {"--diffusion-texels", "64", "--technique", "reference"}),
                testing::HasSubstr("--diffusion-texels changes nothing. The reference integrates over the surface\n"));
}

void Render::expectCauseOfTooManyIterationsNamed() {
    std::string lights;
    for (int i = 0; i < 128; ++i)
        lights += (i == 0 ? "[" : ", ") +
                  std::string(R"({"type": "point", "position": [0, 0, 1], "intensity": 0.1, "radius": 0.1,
                                  "castsShadow": true})");
    writeQuad(R"({"name": "paint", "model": "lambert"})", lights + "]");
    const auto said = [&](const Words& more) {
        Words words{"render", "quad.json", "--size", "8x8", "-o", "a.exr"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    for (const char* filter : everyNth(std::vector{"traced", "pcss"}, 2)) {
        SCOPED_TRACE(filter);
        EXPECT_THAT(said({"--shadow-filter", filter, "--shadow-samples", "1024"}),
                    testing::ContainsRegex("a.exr: [0-9]+ of its pixels are infinite or no numbers; shadows of 128 "
                                           "lights take up to [0-9]+ iterations .*; give fewer --shadow-samples or"));
        EXPECT_EQ(said({"--shadow-filter", filter, "--shadow-samples", "16"}), "");
    }
}
TEST_F(Render, whereShadowsTakeTooManyIterationsTheyAreNamedAsTheCause) {
    expectCauseOfTooManyIterationsNamed();
}
TEST_F(RenderSlow, whereShadowsTakeTooManyIterationsTheyAreNamedAsTheCause) {
    expectCauseOfTooManyIterationsNamed();
}

TEST_F(Render, warningsNeverComeBeforeAnError) {
    folder_.write("tri.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    expectError(2, {"render", "tri.obj", "--camera", "nix", "-o", "a.png"}, {"unknown camera 'nix'"});
    expectError(2, {"render", "tri.obj", "--solo", "7", "-o", "a.png"}, {"--solo 7"});
}

TEST_F(Render, namesAndSizesMeanTheSameInCapitals) {
    folder_.write("M.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const auto& [name, size] :
         {std::pair{"a.png", "16x9"}, {"A.PNG", "16X9"}, {"a.exr", "16x9"}, {"A.EXR", "16X9"}})
        runGood({"--quiet", "render", "M.OBJ", "--size", size, "-o", name});
    EXPECT_TRUE(text("a.png") == text("A.PNG"));
    EXPECT_TRUE(text("a.exr") == text("A.EXR"));
}

} // namespace
} // namespace tessera::test
