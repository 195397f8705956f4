// Programs, targets and constants of passes, and resources that live across frames.
#include "base/Error.h"
#include "tests/unit/graph/Recorder.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;

/// A program source that returns a stand-in for each program and records its name.
class Programs : public ProgramSource {
public:
    const gpu::Program& get(const ProgramDesc& desc) override {
        requested.push_back(desc.name);
        return standIn<gpu::Program>(place);
    }
    std::vector<std::string> requested;
    Place place;
};

ProgramDesc programNamed(const std::string& name) {
    ProgramDesc desc;
    desc.name = name;
    return desc;
}

TEST(Execution, aPassIsGivenItsOwnProgramsInTheOrderOfTheirDeclaration) {
    Recorder backend;
    Programs programs;
    Graph graph;
    keptPass(
        graph, "ids",
        [](const PassContext& context) {
            context.program(1);
            context.program();
        },
        [](PassBuilder& builder) {
            builder.program(programNamed("opaque"));
            builder.program(programNamed("transparent"));
        });
    declare(graph, "culled", [](PassBuilder& builder) {
        builder.program(programNamed("never"));
        builder.create("c", kColor);
    });
    const CompiledGraph compiled = compile(graph);
    ASSERT_EQ(compiled.programs.size(), 2u) << "a pass that is left out needs no program";
    EXPECT_EQ(compiled.programs[0].name, "opaque");
    EXPECT_EQ(compiled.programs[1].name, "transparent");
    Execution(graph, compiled, backend, &programs).run();
    EXPECT_THAT(programs.requested, ElementsAre("transparent", "opaque"));
}

TEST(Execution, aProgramThatAPassDidNotDeclareIsRefused) {
    Recorder backend;
    Graph undeclared;
    failingPass(undeclared, [](const PassContext& context) { context.program(); });
    EXPECT_EQ(errorOfRun<std::logic_error>(undeclared, backend),
              "pass 'broken': requested its program 0, and declared 0; name it in its setup");
    Graph without;
    keptPass(
        without, "lost", [](const PassContext& context) { context.program(); },
        [](PassBuilder& builder) { builder.program(programNamed("p")); });
    EXPECT_EQ(errorOfRun<std::logic_error>(without, backend), "pass 'lost': the execution was given no programs");
}

TEST(Execution, aPassRasterisesIntoItsDeclaredTargets) {
    Recorder backend;
    Graph graph;
    const TextureHandle input = draw(graph, "before", "input");
    keptPass(
        graph, "gbuffer", [](const PassContext& context) { context.bindTargets(); },
        [&](PassBuilder& builder) {
            builder.create("albedo", kColor);
            builder.read(input);
            builder.create("depth", kDepth, Access::DepthAttachment);
            builder.create("normal", kColor);
        });
    run(graph, backend);
    EXPECT_THAT(backend.calls, testing::Contains("targets 2 and depth"));
    Graph none;
    failingPass(none, [](const PassContext& context) { context.bindTargets(); });
    EXPECT_EQ(errorOfRun<std::logic_error>(none, backend),
              "pass 'broken': binds its targets and declared none; create or write an attachment in its setup");
}

TEST(Execution, constantsGoWithTheProgramsOfTheirPass) {
    Recorder backend;
    Programs programs;
    Graph graph;
    keptPass(
        graph, "post", [](const PassContext& context) { context.constants(2, std::array<float, 4>{}); },
        [](PassBuilder& builder) { builder.program(programNamed("post")); });
    run(graph, backend, &programs);
    EXPECT_THAT(backend.calls, testing::Contains("constants 2, 16 bytes, 1 programs"));
}

/// A frame that shades with a persistent shadow map and draws the map first unless it is held.
Graph shadowedFrame(bool holds) {
    Graph graph([holds](const std::string&, const ResourceDesc&, std::uint64_t) { return holds; });
    TextureHandle shadows = graph.persist("shadows", kDepth, 7);
    if (!graph.holds(shadows))
        declare(graph, "draw shadows",
                [&](PassBuilder& builder) { shadows = builder.write(shadows, Access::DepthAttachment); });
    graph.output(draw(graph, "shade", "image", {shadows}));
    return graph;
}

TEST(Execution, aPersistentResourceGetsItsRevisionAtTheEndOfTheFrame) {
    Recorder backend;
    const Graph first = shadowedFrame(false);
    const CompiledGraph compiled = compile(first);
    Execution(first, compiled, backend).run();
    EXPECT_THAT(backend.calls,
                ElementsAre("persistent shadows", "allocate 1", "shadows holds nothing", "begin draw shadows",
                            "end draw shadows", "begin shade", "end shade", "shadows holds 7"));
    backend.calls.clear();
    run(shadowedFrame(true), backend);
    EXPECT_THAT(backend.calls, ElementsAre("persistent shadows", "allocate 1", "begin shade", "end shade"));
    backend.failsAtEnd = true;
    EXPECT_THROW(Execution(first, compiled, backend).run(), std::runtime_error);
    EXPECT_THAT(backend.calls, testing::Not(testing::Contains("shadows holds 7")));
}

TEST(Execution, aHeldOutputIsAvailableWithoutAWriter) {
    Recorder backend;
    Graph graph([](const std::string&, const ResourceDesc&, std::uint64_t) { return true; });
    const TextureHandle shadows = graph.persist("shadows", kDepth, 7);
    graph.output(shadows);
    const CompiledGraph compiled = compile(graph);
    Execution execution(graph, compiled, backend);
    execution.run();
    EXPECT_EQ(&execution.texture(shadows), &standIn<gpu::Texture>(backend.places.back()));
}

TEST(Execution, aPersistentResourceIsNotReadBeforeItsFirstWrite) {
    Graph graph;
    const TextureHandle shadows = graph.persist("shadows", kDepth, 7);
    graph.output(draw(graph, "shade", "image", {shadows}));
    EXPECT_THAT(faultsOf(graph), ElementsAre("pass 'shade' reads version 0 of 'shadows', which no pass produces"));
}

} // namespace
} // namespace tessera::graph::test
