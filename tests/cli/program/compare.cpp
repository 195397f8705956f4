#include <filesystem>
#include <set>

#include "engine/Techniques.h"
#include "tests/cli/program/Cli.h"
#include "tests/support/AnimatedModels.h"
#include "tests/support/Sweep.h"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::set<std::string> keysOf(const Json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
}

bool usesGBuffer(const std::string& technique) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        if (info.name == technique) return info.usesGBuffer();
    return false;
}

class Compare : public Cli {
protected:
    static Words lattice(const Words& more) {
        Words words{"compare", "lattice", "--lights", "8", "--size", "160x90"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
};

TEST_F(Compare, theJsonHasExactlyTheDocumentedFields) {
    const std::string table = runGood(lattice({"--json", "c.json", "--layout", "packed"}));
    EXPECT_THAT(table, testing::HasSubstr("deferred vs forward"));
    const Json record = json("c.json");
    EXPECT_EQ(keysOf(record),
              (std::set<std::string>{"schema", "scene", "size", "samples", "renderer", "pairs", "left_out"}));
    EXPECT_EQ(record["schema"], 1);
    EXPECT_EQ(record["scene"], "lattice");
    EXPECT_EQ(record["size"], Json::parse("[160, 90]"));
    EXPECT_FALSE(record["renderer"].get<std::string>().empty());
    // `missed` and `why` explain verdicts and nulls; `channels` exists only if a channel is packed.
    const std::set<std::string> fields{
        "a",      "b",        "maxAbs",   "maxRel",   "rmse",       "relMse",        "p50Rel",
        "p99Rel", "p999Rel",  "bias",     "bitEqual", "flip",       "psnr",          "nan",
        "inf",    "negative", "excluded", "litShare", "litCovered", "meanLuminance", "tolerance",
        "ok",     "missed",   "why",      "culling",  "biasNoise"};
    ASSERT_EQ(record["pairs"].size(), engine::techniqueTable().size() - 1);
    for (const Json& pair : record["pairs"]) {
        std::set<std::string> keys = keysOf(pair);
        EXPECT_EQ(keys.erase("channels"), usesGBuffer(pair["a"]) ? 1u : 0u);
        EXPECT_EQ(keys, fields);
        EXPECT_EQ(keysOf(pair["tolerance"]),
                  (std::set<std::string>{"maxRel", "bitEqual", "relMse", "p999Rel", "bias", "biasNoises"}));
        EXPECT_EQ(pair["b"], "forward");
        EXPECT_EQ(pair["ok"], true);
        EXPECT_EQ(pair["missed"], Json::array());
        for (const char* share : {"bitEqual", "excluded", "litShare", "litCovered"}) {
            EXPECT_GE(pair[share], 0.0);
            EXPECT_LE(pair[share], 1.0);
        }
        EXPECT_GE(pair["litShare"], 0.1);
        for (const auto& [key, value] : pair.items()) EXPECT_TRUE(!value.is_null() || pair["why"].contains(key)) << key;
    }
    EXPECT_EQ(record["pairs"][0]["a"], "forward_prepass");
    EXPECT_EQ(record["pairs"][0]["bitEqual"], 1.0);
}

TEST_F(Compare, everyPairReportsItsCullingAndNoneIsSilentlyChanged) {
    runGood(lattice({"--json", "c.json", "--culling", "zbin", "--tile", "32", "--cull-on", "compute"}));
    const Json record = json("c.json");
    for (const Json& pair : record["pairs"]) {
        const bool clustered = pair["a"].get<std::string>().starts_with("clustered");
        EXPECT_EQ(pair["culling"], clustered ? Json("zbin, tile 32, lists built by compute") : Json()) << pair["a"];
    }
    ASSERT_EQ(record["left_out"].size(), 2u);
    EXPECT_EQ(record["left_out"][0]["technique"], "tiled_deferred");
    EXPECT_EQ(record["left_out"][0]["why"], "it does not support culling zbin");
    expectError(2, lattice({"--techniques", "tiled_deferred", "--culling", "zbin"}),
                {"tiled_deferred does not support culling zbin"});
    expectError(2, lattice({"--view", "lights"}), {"--view lights", "render it"});
}

TEST_F(Compare, optionsOfLightListsAreRefusedWhereThereAreNone) {
    expectError(2, {"render", "room", "-o", "a.png", "--technique", "forward", "--tile", "16"},
                {"technique forward does not support tile 16, since it has no light lists", "tiled_deferred"});
    expectError(2, {"plan", "room", "--cull-on", "compute"},
                {"technique deferred does not support cull-on compute, since it has no light lists"});
}

TEST_F(Compare, severalSamplesLeaveOutTheTechniquesThatTakeOneAndSaySo) {
    const std::string table = runGood(lattice({"--samples", "4", "--json", "c.json"}));
    EXPECT_THAT(table, testing::HasSubstr("forward_prepass vs forward"));
    EXPECT_THAT(table, testing::HasSubstr("left out: deferred: it does not support samples 4\n"));
    const Json record = json("c.json");
    EXPECT_GE(record["samples"], 4);
    for (const Json& pair : record["pairs"]) EXPECT_EQ(pair["bitEqual"], 1.0);
    std::set<std::string> leftOut;
    for (const Json& item : record["left_out"]) leftOut.insert(item["technique"]);
    EXPECT_TRUE(leftOut.contains("deferred"));
    EXPECT_FALSE(leftOut.contains("forward"));
}

TEST_F(Compare, theRequestedTechniquesAreComparedWithAHeatMapEach) {
    runGood(lattice({"--techniques", "deferred,forward", "--against", "forward_prepass", "--json", "c.json",
                     "--heatmap", "maps/of"}));
    const Json pairs = json("c.json")["pairs"];
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_EQ(pairs[0]["a"], "deferred");
    EXPECT_EQ(pairs[1]["a"], "forward");
    EXPECT_EQ(pairs[1]["b"], "forward_prepass");
    for (const char* name :
         {"maps/of/deferred.png", "maps/of/deferred_flip.png", "maps/of/forward.png", "maps/of/forward_flip.png"})
        EXPECT_GE(picture(name).width, 160) << name;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "maps/of"), fs::directory_iterator()), 4);
}

TEST_F(Compare, techniqueChoosesTheOneThatIsCompared) {
    runGood(lattice({"--technique", "deferred_volumes", "--json", "c.json"}));
    const Json pairs = json("c.json")["pairs"];
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0]["a"], "deferred_volumes");
}

TEST_F(Compare, aPictureOfIntegersIsWarnedOf) {
    for (const auto& [name, warnings] : {std::pair{"truth.png", 1}, {"truth.exr", 0}}) {
        runGood({"render", "lattice", "--lights", "8", "--size", "160x90", "-o", name});
        const ProcessResult result = run(lattice({"--techniques", "forward", "--against", name}));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), warnings) << result.err;
        if (warnings == 0) continue;
        EXPECT_THAT(result.err, testing::AllOf(testing::HasSubstr("truth.png: holds integers"),
                                               testing::HasSubstr("give an .exr")));
    }
}

TEST_F(Compare, aPictureThatRenderWroteEqualsEveryTechniqueBitForBit) {
    runGood({"render", "lattice", "--lights", "8", "--size", "160x90", "-o", "truth.exr"});
    runGood(lattice({"--against", "truth.exr", "--json", "c.json"}));
    const Json pairs = json("c.json")["pairs"];
    ASSERT_EQ(pairs.size(), engine::techniqueTable().size());
    for (const Json& pair : pairs) {
        EXPECT_EQ(pair["bitEqual"], 1.0) << pair["a"];
        EXPECT_EQ(pair["b"], "truth.exr");
    }
}

TEST_F(Compare, picturesMeetTheReferenceToleranceAndTheExcludedShareIsReported) {
    const std::string table = runGood({"compare", "head", "--size", "96x54", "--against", "reference", "--techniques",
                                       "deferred,forward", "--json", "c.json", "--heatmap", "maps"});
    EXPECT_THAT(table, testing::HasSubstr("deferred vs reference"));
    EXPECT_THAT(table, testing::ContainsRegex("\nexcluded: [0-9.]+ % of the covered pixels"));
    const Json pairs = json("c.json")["pairs"];
    ASSERT_EQ(pairs.size(), 3u);
    EXPECT_EQ(pairs[2]["a"], "deferred (hardware filter)");
    for (const Json& pair : pairs) {
        EXPECT_EQ(pair["b"], "reference");
        EXPECT_EQ(pair["ok"], true);
        EXPECT_LT(pair["excluded"], 0.02);
    }
    EXPECT_LE(pairs[0]["p999Rel"], 1e-3);
    for (const char* name : {"maps/deferred.png", "maps/forward.png", "maps/deferred_hardware_filter.png"})
        EXPECT_GE(picture(name).width, 96) << name;
}

TEST_F(Compare, thePackedLayoutHasItsOwnToleranceAgainstTheReference) {
    runGood(lattice({"--against", "reference", "--techniques", "deferred", "--layout", "packed", "--json", "c.json"}));
    const Json pair = json("c.json")["pairs"][0];
    EXPECT_EQ(pair["tolerance"]["relMse"], 1e-4);
    EXPECT_FALSE(pair["channels"].empty());
    double shares = 0.0;
    for (const Json& channel : pair["channels"]) shares += channel["share"].get<double>();
    EXPECT_GT(shares, 0.0);
}

TEST_F(Compare, everyTechniqueShowsExactlyTheSameTriangles) {
    runGood(lattice({"--view", "ids", "--json", "c.json"}));
    const Json record = json("c.json");
    for (const Json& pair : record["pairs"]) EXPECT_EQ(pair["bitEqual"], 1.0) << pair["a"];
}

TEST_F(Compare, settingsThatTheReferenceDoesNotRenderAreRefused) {
    expectError(kBadInput, {"compare", "room", "--against", "reference", "--view", "normal"}, {"reference", "normal"});
    expectError(kBadInput, {"compare", "room", "--against", "reference", "--samples", "4"},
                {"reference", "one sample a pixel, not 4"});
    expectError(kBadInput, {"compare", "room", "--against", "referense"}, {"referense", "reference"});
}

TEST_F(Compare, shadowsOfMapsAreNotJudgedByTheReferenceAndThatIsSaid) {
    const Words words =
        lattice({"--shadows", "4", "--shadow-filter", "hard", "--technique", "forward", "--against", "reference"});
    const ProcessResult result = run(words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, testing::HasSubstr("not judged: forward"));
    Words recorded = words;
    recorded.insert(recorded.end(), {"--json", "c.json"});
    EXPECT_EQ(run(recorded).exitCode, 0) << "nothing is missed";
    const Json pair = json("c.json")["pairs"][0];
    EXPECT_TRUE(pair["ok"].is_null()) << "what is not judged is not ok";
    EXPECT_THAT(pair["why"]["ok"].get<std::string>(), testing::HasSubstr("not judged: shadow maps"));
    // Warns of lights that lose their shadows.
    Words few = words;
    few.insert(few.end(), {"--shadow-budget", "0.001"});
    EXPECT_THAT(run(few).err, testing::HasSubstr("cast no shadows; give more --shadow-budget"));
}

TEST_F(Compare, aPictureOfAnotherSizeIsRefused) {
    runGood({"render", "room", "--size", "32x18", "-o", "small.exr"});
    expectError(kBadInput, {"compare", "room", "--size", "160x90", "--against", "small.exr", "--json", "c.json"},
                {"small.exr", "32x18", "160x90"});
}

TEST_F(Compare, aPictureOfAnotherSceneFailsAndTheMissedTolerancesAreNamed) {
    runGood({"render", "room", "--size", "160x90", "-o", "room.exr"});
    const ProcessResult result =
        run(lattice({"--techniques", "deferred", "--against", "room.exr", "--json", "c.json"}));
    EXPECT_EQ(result.exitCode, kToleranceMissed);
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, testing::AllOf(testing::HasSubstr("MISSED"), testing::HasSubstr("missed: deferred vs ")));
    const Json pair = json("c.json")["pairs"][0];
    EXPECT_EQ(pair["ok"], false);
    EXPECT_FALSE(pair["missed"].empty());
}

TEST_F(Compare, aBlackPictureNeverPasses) {
    const ProcessResult result = run({"compare", "lattice", "--lights", "0", "--size", "160x90"});
    EXPECT_EQ(result.exitCode, kToleranceMissed);
    EXPECT_THAT(result.out, testing::HasSubstr("no signal"));
}

/// Directions may have negative components, radiance may not.
TEST_F(Compare, aViewOfDirectionsNeverMissesForItsSigns) {
    for (const char* view : {"normal", "normal_view", "normal_object", "depth"}) {
        SCOPED_TRACE(view);
        runGood({"compare", "room", "--size", "48x27", "--view", view, "--techniques", "deferred"});
    }
}

/// Shaders with a fault, which compare must detect.
class Sabotage : public Cli {
protected:
    void SetUp() override {
        fs::copy(fs::path(TESSERA_SOURCE_DIR) / "shaders", folder_.path() / "shaders", fs::copy_options::recursive);
    }

    /// Replaces every `from` in a shader; the test fails if there is none.
    void replace(const std::string& file, const std::string& from, const std::string& to) const {
        std::string source = text("shaders/" + file);
        std::size_t place = source.find(from);
        ASSERT_NE(place, std::string::npos) << file << " no longer holds: " << from;
        for (; place != std::string::npos; place = source.find(from, place + to.size()))
            source.replace(place, from.size(), to);
        folder_.write("shaders/" + file, source);
    }

    void expectExitCode(int exitCode) const {
        for (const char* layout : {"exact", "packed"}) {
            SCOPED_TRACE(layout);
            const ProcessResult result =
                run({"compare", "lattice", "--size", "160x90", "--techniques", "deferred", "--layout", layout},
                    {{"TESSERA_SHADERS", path("shaders")}});
            EXPECT_EQ(result.exitCode, exitCode) << result.out;
            EXPECT_EQ(result.err, "");
            EXPECT_EQ(result.out.find("missed: ") != std::string::npos, exitCode == kToleranceMissed);
        }
    }
    void expectFaultsOfLobesMiss();
};
using SabotageSlow = Sabotage;

TEST_F(Sabotage, anUntouchedCopyOfTheShadersPasses) {
    expectExitCode(kGood);
}

TEST_F(Sabotage, swappedChannelsMissTheTolerance) {
    replace("lib/gbuffer/gbuffer_channels.glsl", "surface.albedo = texel.rgb;", "surface.albedo = texel.bgr;");
    replace("lib/gbuffer/gbuffer_channels.glsl", "surface.albedo = takeRoots(encoding.widths);",
            "surface.albedo = takeRoots(encoding.widths).bgr;");
    // No material of lattice varies, so with the exact layout its pixels store material indices.
    replace("lib/material/material_table.glsl", "material.baseColor = tabledConstants(number, 0);",
            "material.baseColor = tabledConstants(number, 0).bgra;");
    expectExitCode(kToleranceMissed);
}

TEST_F(Sabotage, oneSkippedLightMissesTheTolerance) {
    // GBUFFER_NORMAL without GBUFFER_WRITE selects the pass that reads the G-buffer.
    replace(
        "lib/light/light_cursor.glsl", "    return LightCursor(0, int(lighting.lights.x));",
        "#if !defined(GBUFFER_WRITE) && defined(GBUFFER_NORMAL)\n    return LightCursor(1, int(lighting.lights.x));\n"
        "#else\n    return LightCursor(0, int(lighting.lights.x));\n#endif");
    expectExitCode(kToleranceMissed);
}

TEST_F(Sabotage, aFaultThatAllTechniquesShareMissesTheReference) {
    replace("lib/maths/math.glsl", "kPi = 3.14159265358979323846", "kPi = 3.17300858");
    expectExitCode(kGood);
    const ProcessResult result =
        run({"compare", "lattice", "--size", "160x90", "--techniques", "deferred", "--against", "reference"},
            {{"TESSERA_SHADERS", path("shaders")}});
    EXPECT_EQ(result.exitCode, kToleranceMissed) << result.out;
}

/// Expects every fourth fault to be detected, in a whole sweep all. `models` shows every model and layer, none of them
/// large, so a fault in one changes few pixels.
void Sabotage::expectFaultsOfLobesMiss() {
    struct Fault {
        const char* file;
        const char* from;
        const char* to;
    };
    const std::vector<Fault> faults{
        {"lib/reflectance/reflectance.glsl", "surface.specular * highlight;",
         "surface.specular * highlight * directions.nl;"},
        {"lib/reflectance/reflectance.glsl",
         "visibilityHalfVector(alpha2, directions.nl, directions.nv, directions.lh)",
         "visibilitySeparable(directions.nl, smithLength(alpha2, directions.nl), directions.nv, viewerLength)"},
        {"lib/reflectance/reflectance.glsl", "if (surface.masking == MASKING_DIRECTIONAL)", "if (false)"},
        {"lib/reflectance/reflectance.glsl", "fresnelSchlick(vec3(0.04), vec3(0.96)",
         "fresnelSchlick(vec3(0.05), vec3(0.95)"},
        {"lib/material/material_lobes.glsl", "(strength * strength)", "strength"},
        {"lib/material/material_frame.glsl", "* fragment.tangentLS.w;", "* -fragment.tangentLS.w;"},
        {"lib/reflectance/sheen.glsl", "(2.0 + inverse)", "(1.0 + inverse)"},
    };
    for (const Fault& fault : everyNth(faults, 4)) {
        SCOPED_TRACE(fault.from);
        const std::string right = text("shaders/" + std::string(fault.file));
        replace(fault.file, fault.from, fault.to);
        const ProcessResult result =
            run({"compare", "models", "--size", "160x90", "--techniques", "deferred", "--against", "reference"},
                {{"TESSERA_SHADERS", path("shaders")}});
        EXPECT_EQ(result.exitCode, kToleranceMissed) << result.out;
        EXPECT_EQ(result.err, "");
        folder_.write("shaders/" + std::string(fault.file), right);
    }
}
TEST_F(Sabotage, aFaultOfOneLobeMissesTheReference) {
    expectFaultsOfLobesMiss();
}
TEST_F(SabotageSlow, aFaultOfOneLobeMissesTheReference) {
    expectFaultsOfLobesMiss();
}

/// The instance is missing in all techniques alike, and covers few pixels.
TEST_F(Sabotage, aDroppedInstanceMissesTheReferenceAndIsNamed) {
    replace("passes/geometry.vert", "gl_Position = clip;",
            "gl_Position = drawNormal2.w == 13.0 ? vec4(2.0, 2.0, 2.0, 1.0) : clip;");
    const ProcessResult result = run({"compare", "models", "--size", "160x90", "--techniques", "deferred", "--against",
                                      "reference", "--json", "c.json"},
                                     {{"TESSERA_SHADERS", path("shaders")}});
    EXPECT_EQ(result.exitCode, kToleranceMissed) << result.out;
    EXPECT_THAT(result.out, testing::ContainsRegex("geometry: instance 12 .* is missing from [0-9]+ pixels, such as "));
    const Json record = json("c.json");
    ASSERT_EQ(record["lost"].size(), 1u) << record["lost"].dump();
    const Json& lost = record["lost"][0];
    EXPECT_EQ(keysOf(lost), (std::set<std::string>{"what", "instance", "node", "mesh", "pixels", "pixel", "why"}));
    EXPECT_EQ(lost["what"], "missing");
    EXPECT_EQ(lost["instance"], 12);
    EXPECT_GT(lost["pixels"], 10);
    for (const Json& pair : record["pairs"]) EXPECT_EQ(pair["ok"], false);
}

/// Bit-equal images of models that cover less than a tenth of the frame.
TEST_F(Compare, aSmallModelHoldsAgainstItself) {
    std::vector<fs::path> models{ownModelsFolder() / "morphing_box.gltf"};
    for (const char* name :
         {"SpecularTest/SpecularTest.glb", "AlphaBlendModeTest/AlphaBlendModeTest.glb", "Cameras/Cameras.gltf"})
        if (const std::optional<fs::path> file = fileOfAssets(name)) models.push_back(*file);
    for (const fs::path& model : models) {
        const ProcessResult result = run({"compare", model.string(), "--size", "96x54", "--fov", "120", "--backdrop",
                                          "off", "--techniques", "deferred", "--json", "c.json"});
        EXPECT_EQ(result.exitCode, kGood) << result.out << result.err; // stderr warns of missing lights and cameras
        const Json pair = json("c.json")["pairs"][0];
        EXPECT_LT(pair["litShare"], 0.1) << model;
        EXPECT_GT(pair["litCovered"], 0.1) << model;
    }
}

TEST_F(Sabotage, aShaderThatDoesNotCompileIsNamedInOneLine) {
    replace("lib/light/light_cursor.glsl", "    light = cursor.next;",
            "    light = cursor.nix;\n    light = cursor.nox;");
    const ProcessResult result = run({"render", "room", "-o", "a.png"}, {{"TESSERA_SHADERS", path("shaders")}});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, testing::StartsWith("tessera: error: "));
    EXPECT_THAT(result.err, testing::HasSubstr("lib/light/light_cursor.glsl:"));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(path("a.png")));
    expectError(kBadInput, {"render", "room", "-o", "a.png"}, {"nix", "TESSERA_SHADERS"}, {{"TESSERA_SHADERS", "nix"}});
}

} // namespace
} // namespace tessera::test
