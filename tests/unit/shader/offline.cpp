// Checks every shader that a built-in scene can need with the reference compiler instead of the local driver.
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <glslang/Include/Types.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "engine/ChooseLighting.h"
#include "engine/ChooseSamples.h"
#include "engine/ChooseView.h"
#include "engine/HookProgram.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"
#include "renderer/shader/HookFault.h"
#include "scenes/Load.h"
#include "shaders/shared/slots.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"
#include "validation/lower_bound/LowerBoundGeometry.h"
#include "validation/lower_bound/LowerBoundLighting.h"

namespace tessera {
namespace {

using Programs = std::map<std::string, shader::ProgramDesc>; ///< by their keys

void add(Programs& programs, const shader::ProgramDesc& desc) {
    programs.emplace(desc.key(), desc);
}
void addFrame(Programs& programs, const scenes::Scene& scene, engine::Technique technique,
              const frame::FrameSettings& settings) {
    for (const shader::ProgramDesc& desc : engine::framePrograms(scene, technique, settings)) add(programs, desc);
}

frame::FrameSettings smallFrame() {
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    return settings;
}

/// Settings whose programs differ: layouts x views, and each switch that affects a shader.
std::vector<frame::FrameSettings> settingsThatMatter() {
    std::vector<frame::FrameSettings> all;
    for (const frame::LayoutInfo& layout : frame::layoutTable()) {
        frame::FrameSettings settings = smallFrame();
        settings.layout = layout.layout;
        for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
            frame::FrameSettings& ofView = all.emplace_back(settings);
            ofView.view = view.view;
            ofView.prune = !view.needsGBuffer; // a scene may lack the displayed channel
        }
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
    frame::FrameSettings several = smallFrame();
    several.samples = 4;
    all.push_back(several);
    for (const frame::RefractionInfo& info : frame::refractionTable())
        all.emplace_back(smallFrame()).refraction = info.refraction;
    several.prune = false;
    all.push_back(several);
    return all;
}

/// Adds the programs of the measured lower bound of a frame.
void addLowerBoundPrograms(Programs& programs, const frame::FrameSpec& spec) {
    add(programs, validation::LowerBoundGeometry::program(spec));
    if (!spec.features.litModels()) return;
    for (const validation::LightStoreInfo& store : validation::lightStoreTable())
        add(programs, validation::LowerBoundLighting::program(spec, store));
}

/// Techniques and settings of light culling by every method and builder, and of lighting in compute shaders.
std::vector<std::pair<engine::Technique, frame::FrameSettings>> listBuildersAndStages() {
    std::vector<std::pair<engine::Technique, frame::FrameSettings>> all;
    frame::FrameSettings settings = smallFrame();
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        if (engine::infoOf(technique.technique).choosesStage) settings.lightOn = frame::LightingStage::Compute;
        for (const culling::Method method : technique.methods) {
            settings.culling.method = method;
            settings.culling.builder = culling::Builder::Compute;
            for (const int lanes : {64, 1}) {
                settings.culling.lanes = lanes;
                all.emplace_back(technique.technique, settings);
            }
        }
        settings.lightOn.reset();
    }
    return all;
}

/// Adds the program variants of the scene's frames, by their key. A reduced sweep takes every third of the settings,
/// starting at `turn`.
void addPrograms(Programs& programs, const scenes::Scene& scene, std::size_t turn) {
    for (const frame::FrameSettings& settings : settingsThatMatter()) {
        if (!test::isWholeSweep() && turn++ % 3 != 0) continue;
        if (settings.view == frame::DebugView::Final && settings.samples == 1)
            addLowerBoundPrograms(programs, engine::prepareView(scene, engine::Technique::Forward, settings).spec);
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            if (engine::supportsSamples(technique, settings.samples) && engine::supportsView(technique, settings.view))
                addFrame(programs, scene, technique.technique, settings);
        }
    }
    for (const auto& [technique, settings] : listBuildersAndStages()) {
        if (!test::isWholeSweep() && turn++ % 3 != 0) continue;
        addFrame(programs, scene, technique, settings);
    }
}

/// Adds the programs of a visible light surface, which no built-in scene has.
void addSeenLightPrograms(Programs& programs) {
    scenes::Scene scene = test::evenScene();
    const glm::dmat4& eye = scene.cameras[0].worldFromCamera;
    scenes::Light& light = scene.lights.emplace_back();
    light.type = scenes::LightType::Sphere;
    light.radiusMetres = 0.1f;
    light.positionWS = glm::dvec3(eye[3] - 2.0 * eye[2]);
    bool isThere = false;
    for (const int samples : {1, 4}) {
        frame::FrameSettings settings = smallFrame();
        settings.samples = samples;
        for (const shader::ProgramDesc& desc : engine::framePrograms(scene, engine::Technique::Forward, settings)) {
            add(programs, desc);
            isThere = isThere || desc.name == "seen_lights";
        }
    }
    EXPECT_TRUE(isThere);
}

/// Adds the programs of a scene with a hook, in every setting that changes the hook's inputs.
void addHookedPrograms(Programs& programs) {
    scenes::Scene scene = test::everythingScene();
    scene.hook.emplace().file =
        std::filesystem::path(TESSERA_SOURCE_DIR) / "scenes" / "files" / "pulsating_lattice.glsl";
    scene.hook->parameters = {{"breathsASecond"}, {"swell"}, {"glow"}};
    scene.hook->movesVertices = true;
    const shader::ProgramDesc query = engine::hookProgram(engine::kHookSurfaces, *scene.hook);
    scenes::Hook waving;
    waving.file = std::filesystem::path(TESSERA_SOURCE_DIR) / "scenes" / "files" / "flag.glsl";
    waving.parameters = {{"wind"}};
    waving.movesVertices = true;
    const shader::ProgramDesc moving = engine::hookProgram(engine::kHookVertices, waving);
    for (const shader::ProgramDesc& desc : {query, moving}) {
        add(programs, desc);
        add(programs, shader::withEmptyHook(desc)); // checks for faulty hooks, so it must be valid
    }
    for (const frame::TextureFilter filter : {frame::TextureFilter::Hardware, frame::TextureFilter::Exact}) {
        for (const frame::DebugView view : {frame::DebugView::Final, frame::DebugView::NormalObject}) {
            frame::FrameSettings settings = smallFrame();
            settings.filter = filter;
            settings.view = view;
            settings.shadows.kind = scenes::ShadowRequest::Kind::All;
            for (const engine::Technique technique : {engine::Technique::Forward, engine::Technique::Deferred})
                addFrame(programs, scene, technique, settings);
        }
    }
}

/// Programs of all built-in scenes, or of those of a reduced sweep.
Programs requestedPrograms() {
    Programs programs;
    std::size_t turn = 0;
    for (const scenes::BuiltinScene& builtin : test::builtinsForSweep()) {
        scenes::LoadOptions options;
        options.useAssets = false;
        addPrograms(programs, scenes::loadScene(std::string(builtin.name), options), turn++);
    }
    addPrograms(programs, test::evenScene(), turn); // material numbers beside maps and layers
    addSeenLightPrograms(programs);
    addHookedPrograms(programs);
    return programs;
}

/// Khronos' compiler. It caches the built-in functions of a stage for the next shader of that stage.
class ReferenceCompiler {
public:
    ReferenceCompiler() { glslang::InitializeProcess(); }
    ~ReferenceCompiler() { glslang::FinalizeProcess(); }
    ReferenceCompiler(const ReferenceCompiler&) = delete;
    ReferenceCompiler& operator=(const ReferenceCompiler&) = delete;

    struct Verdict {
        std::string faults;      ///< empty without errors
        int sampledTextures = 0; ///< as gpu::Program::sampledTextures(), of the stage that samples most
    };
    /// Compiles a program's stages and links them together. Thread-safe.
    Verdict judge(const shader::ProgramDesc& desc) const {
        std::vector<std::unique_ptr<glslang::TShader>> stages;
        glslang::TProgram program; // destroyed before the shaders
        for (const shader::ExpandedStage& stage : shader::expandStages(tree_, desc)) {
            const char* const text = stage.source.text.c_str();
            stages.push_back(std::make_unique<glslang::TShader>(languageOf(stage.stage)));
            stages.back()->setStrings(&text, 1);
            if (!stages.back()->parse(GetDefaultResources(), kVersion, false, EShMsgDefault))
                return {desc.key() + "\n" + stages.back()->getInfoLog()};
            program.addShader(stages.back().get());
        }
        if (!program.link(EShMsgDefault)) return {desc.key() + "\n" + program.getInfoLog()};
        program.buildReflection(EShReflectionDefault);
        Verdict verdict;
        for (const std::unique_ptr<glslang::TShader>& stage : stages)
            verdict.sampledTextures = std::max(verdict.sampledTextures, sampledTextures(program, stage->getStage()));
        return verdict;
    }

private:
    static constexpr int kVersion = 110; ///< of sources without a version; all have one

    static int sampledTextures(glslang::TProgram& program, EShLanguage stage) {
        int sampled = 0;
        for (int i = 0; i < program.getNumUniformVariables(); ++i) {
            const glslang::TObjectReflection& uniform = program.getUniform(i);
            const glslang::TType& type = *uniform.getType();
            const bool isTexture = type.getBasicType() == glslang::EbtSampler && !type.isImage();
            if (isTexture && (uniform.stages & (1 << stage)) != 0) sampled += std::max(uniform.size, 1);
        }
        return sampled;
    }

    static EShLanguage languageOf(gpu::Stage stage) {
        switch (stage) {
        case gpu::Stage::Vertex:
            return EShLangVertex;
        case gpu::Stage::Geometry:
            return EShLangGeometry;
        case gpu::Stage::Fragment:
            return EShLangFragment;
        case gpu::Stage::Compute:
            return EShLangCompute;
        }
        return EShLangVertex;
    }

    shader::SourceTree tree_ = shader::SourceTree::embedded();
};

/// Checks every program; a reduced sweep checks every twelfth.
void expectValidPrograms() {
    const Programs programs = requestedPrograms();
    ASSERT_FALSE(programs.empty());
    std::vector<const shader::ProgramDesc*> work;
    std::size_t turn = 0;
    for (const auto& [key, desc] : programs)
        if (test::isWholeSweep() || turn++ % 12 == 0) work.push_back(&desc);
    std::vector<ReferenceCompiler::Verdict> verdicts(work.size());
    const ReferenceCompiler compiler;
    tbb::parallel_for(std::size_t(0), work.size(), [&](std::size_t i) { verdicts[i] = compiler.judge(*work[i]); });
    int mostSampled = 0;
    for (std::size_t i = 0; i < work.size(); ++i) {
        EXPECT_EQ(verdicts[i].faults, "");
        EXPECT_LE(verdicts[i].sampledTextures, TEXTURE_UNITS_A_STAGE) << work[i]->key();
        mostSampled = std::max(mostSampled, verdicts[i].sampledTextures);
    }
    // One stage samples all of these: every texture of a material; lights, entries of light lists, and casters; both
    // lobe tables; the environment's map, plain and filtered; and the scene behind glass, sharp and blurred, with its
    // depths and the back faces of glass.
    if (test::isWholeSweep()) {
        EXPECT_EQ(mostSampled, TEXTURE_SLOT_COUNT + 3 + 2 + 2 + 4);
    }
}

TEST(Offline, programsOfEveryBuiltinSceneAlwaysSatisfyTheReferenceCompilerAndSampleNoMoreThanAStageMay) {
    expectValidPrograms();
}
/// With every kind of light and texture, pruned and not, where a stage samples no more than OpenGL guarantees.
TEST(Offline, programsKeepToTheFewestTexturesThatADriverMayOfferAStage) {
    scenes::LoadOptions options;
    options.useAssets = false;
    scenes::Scene scene = scenes::loadScene("glass", options);
    for (scenes::Material& material : scene.materials) {
        if (scenes::isTransmissive(material)) material.iridescence = 1.0f;
        for (scenes::TextureUse& use : material.textures) use.image = 0;
    }
    if (scene.images.empty()) scene.images.push_back({"texel", {}, 1, 1, std::vector<std::byte>(4)});
    const ReferenceCompiler compiler;
    for (const bool prune : {true, false}) {
        frame::FrameSettings settings = smallFrame();
        settings.prune = prune;
        settings.shadows.kind = scenes::ShadowRequest::Kind::All;
        settings.texturesAStage = TEXTURE_UNITS_GUARANTEED;
        int mostSampled = 0;
        for (const engine::Technique technique : {engine::Technique::Deferred, engine::Technique::ForwardPlus})
            for (const shader::ProgramDesc& desc : engine::framePrograms(scene, technique, settings)) {
                const ReferenceCompiler::Verdict verdict = compiler.judge(desc);
                EXPECT_EQ(verdict.faults, "");
                EXPECT_LE(verdict.sampledTextures, TEXTURE_UNITS_GUARANTEED) << desc.key();
                mostSampled = std::max(mostSampled, verdict.sampledTextures);
            }
        if (!prune) {
            EXPECT_EQ(mostSampled, TEXTURE_UNITS_GUARANTEED) << "more than needed is left out";
        }
    }
}

TEST(OfflineSlow, programsOfEveryBuiltinSceneAlwaysSatisfyTheReferenceCompilerAndSampleNoMoreThanAStageMay) {
    expectValidPrograms();
}

TEST(Offline, aFaultyProgramIsSeenByTheReferenceCompiler) {
    const ReferenceCompiler compiler;
    // Without the defines of a frame, material code refers to undeclared names.
    const shader::ProgramDesc broken{
        "broken", "passes/geometry.vert", "passes/gbuffer.frag", "", {{"GBUFFER_ALBEDO", "x"}}};
    EXPECT_NE(compiler.judge(broken).faults, "");
}

} // namespace
} // namespace tessera
