// Every shader that a built-in scene can ask for, checked by the reference compiler instead of the driver at hand.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/recipes/ChooseLighting.h"
#include "passes/recipes/ChooseSamples.h"
#include "passes/recipes/ChooseView.h"
#include "passes/recipes/PreparedFrame.h"
#include "passes/recipes/Renderer.h"
#include "renderer/shader/ProgramDesc.h"
#include "scenes/Load.h"
#include "tests/support/TempFolder.h"
#include "tests/support/TestScenes.h"
#include "validation/FloorGeometry.h"
#include "validation/FloorLighting.h"

namespace tessera {
namespace {

struct CommandResult {
    int status = -1;
    std::string output;
};

CommandResult runCommand(const std::string& command) {
    CommandResult result;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return result;
    std::array<char, 4096> chunk;
    while (const std::size_t size = std::fread(chunk.data(), 1, chunk.size(), pipe))
        result.output.append(chunk.data(), size);
    result.status = pclose(pipe);
    return result;
}

/// The settings whose programs differ: layouts x views, and each switch that a shader knows.
std::vector<frame::FrameSettings> settingsThatMatter() {
    std::vector<frame::FrameSettings> all;
    for (const frame::LayoutInfo& layout : frame::layoutTable()) {
        for (const frame::ViewInfo& view : frame::viewTable()) {
            frame::FrameSettings settings;
            settings.sizePixels = {64, 36};
            settings.layout = layout.layout;
            settings.view = view.view;
            settings.prune = !view.needsGBuffer; // a scene may not need the channel that is shown
            all.push_back(settings);
        }
        frame::FrameSettings settings;
        settings.sizePixels = {64, 36};
        settings.layout = layout.layout;
        settings.prune = false;
        all.push_back(settings);
        settings.filter = frame::TextureFilter::Exact;
        all.push_back(settings);
        settings.prune = true;
        all.push_back(settings);
        settings.filter = frame::TextureFilter::Hardware;
        settings.specular = false;
        all.push_back(settings);
    }
    frame::FrameSettings several;
    several.sizePixels = {64, 36};
    several.samples = 4;
    all.push_back(several);
    several.prune = false;
    all.push_back(several);
    return all;
}

/// Those that the measured floor of a frame would use.
void addFloorPrograms(std::map<std::string, shader::ProgramDesc>& programs, const frame::FrameSpec& spec) {
    const shader::ProgramDesc geometry = validation::FloorGeometry::program(spec);
    programs.emplace(geometry.key(), geometry);
    if (!spec.features.litModels()) return;
    for (const validation::LightStoreInfo& store : validation::lightStoreTable()) {
        const shader::ProgramDesc lighting = validation::FloorLighting::program(spec, store);
        programs.emplace(lighting.key(), lighting);
    }
}

/// Those of light culling by every method and builder, and of lighting in compute shaders.
std::vector<std::pair<recipes::Technique, frame::FrameSettings>> listBuildersAndStages() {
    struct Lanes {
        culling::Builder builder;
        int lanes;
    };
    std::vector<std::pair<recipes::Technique, frame::FrameSettings>> all;
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    for (const recipes::TechniqueInfo& technique : recipes::techniqueTable()) {
        if (recipes::takesLightingStage(technique.technique)) settings.lightOn = frame::LightingStage::Compute;
        for (const culling::Method method : technique.methods) {
            settings.culling.method = method;
            for (const Lanes lanes : {Lanes{culling::Builder::Compute, 64}, Lanes{culling::Builder::Compute, 1},
                                      Lanes{culling::Builder::Fragment, 1}}) {
                settings.culling.builder = lanes.builder;
                settings.culling.lanes = lanes.lanes;
                all.emplace_back(technique.technique, settings);
            }
        }
        settings.lightOn.reset();
    }
    return all;
}

/// Adds the variants that frames of the scene would use, by their key.
void addPrograms(std::map<std::string, shader::ProgramDesc>& programs, const scenes::Scene& scene) {
    for (const frame::FrameSettings& settings : settingsThatMatter()) {
        if (settings.view == frame::View::Final && settings.samples == 1)
            addFloorPrograms(programs, recipes::prepareFrame(scene, recipes::Technique::Forward, settings).spec);
        for (const recipes::TechniqueInfo& technique : recipes::techniqueTable()) {
            if (!recipes::takesSamples(technique, settings.samples)) continue;
            if (!recipes::takesView(technique, settings.view)) continue;
            for (const shader::ProgramDesc& desc : recipes::framePrograms(scene, technique.technique, settings))
                programs.emplace(desc.key(), desc);
        }
    }
    for (const auto& [technique, settings] : listBuildersAndStages())
        for (const shader::ProgramDesc& desc : recipes::framePrograms(scene, technique, settings))
            programs.emplace(desc.key(), desc);
}

std::map<std::string, shader::ProgramDesc> requestedPrograms() {
    std::map<std::string, shader::ProgramDesc> programs;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        scenes::LoadOptions options;
        options.useAssets = false;
        addPrograms(programs, scenes::loadScene(std::string(builtin.name), options));
    }
    addPrograms(programs, test::evenScene()); // materials by number beside maps and layers
    return programs;
}

/// Writes a program's stages and compiles and links them together. Empty when all is well.
std::string faultsOf(const shader::ProgramDesc& desc, const test::TempFolder& folder, int number) {
    const shader::SourceTree tree = shader::SourceTree::embedded();
    std::string command = "glslangValidator -l";
    for (const shader::ExpandedStage& stage : shader::expandStages(tree, desc)) {
        const char* suffix = stage.stage == gpu::Stage::Vertex     ? "vert"
                             : stage.stage == gpu::Stage::Geometry ? "geom"
                             : stage.stage == gpu::Stage::Fragment ? "frag"
                                                                   : "comp";
        const std::string file = fmt::format("{}.{}", number, suffix);
        folder.write(file, stage.source.text);
        command += " '" + (folder.path() / file).string() + "'";
    }
    const CommandResult result = runCommand(command);
    return result.status == 0 ? std::string() : desc.key() + "\n" + result.output;
}

TEST(Offline, everyProgramOfEveryBuiltinSceneAlwaysSatisfiesTheReferenceCompiler) {
    if (runCommand("glslangValidator --version").status != 0)
        GTEST_SKIP() << "glslangValidator is not installed (Debian: glslang-tools)";
    const std::map<std::string, shader::ProgramDesc> programs = requestedPrograms();
    ASSERT_FALSE(programs.empty());
    RecordProperty("variants", int(programs.size()));
    fmt::print("{} distinct program variants\n", programs.size());

    std::vector<const shader::ProgramDesc*> work;
    for (const auto& [key, desc] : programs) work.push_back(&desc);
    std::vector<std::string> faults(work.size());
    const test::TempFolder folder;
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads;
    for (std::size_t worker = 0; worker < workers; ++worker) {
        threads.emplace_back([&, worker] {
            for (std::size_t i = worker; i < work.size(); i += workers) faults[i] = faultsOf(*work[i], folder, int(i));
        });
    }
    threads.clear();
    for (const std::string& fault : faults) EXPECT_EQ(fault, "");
}

TEST(Offline, aFaultyProgramIsAlwaysSeenByTheReferenceCompiler) {
    if (runCommand("glslangValidator --version").status != 0)
        GTEST_SKIP() << "glslangValidator is not installed (Debian: glslang-tools)";
    const test::TempFolder folder;
    // Without the defines of a frame, material code refers to what was never declared.
    const shader::ProgramDesc broken{
        "broken", "passes/geometry.vert", "passes/gbuffer.frag", "", {{"GBUFFER_ALBEDO", "x"}}};
    EXPECT_NE(faultsOf(broken, folder, 0), "");
}

} // namespace
} // namespace tessera
