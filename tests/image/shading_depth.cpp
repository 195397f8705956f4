#include <numeric>
#include <set>

#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "passes/DepthPrepass.h"
#include "passes/UploadPass.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/GraphBackend.h"
#include "renderer/graph/Execute.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

constexpr int kWidth = 65, kHeight = 37;

/// Depths of one pixel after the prepass, by sample.
struct Pixel {
    std::vector<float> depth, shadingDepth;
    bool covered() const {
        return std::none_of(depth.begin(), depth.end(), [](float d) { return d == 0.0f; });
    }
};

class ShadingDepth : public ImageTest {
protected:
    frame::FrameSettings settings(int samples) {
        frame::FrameSettings requested = withSamples(ofSize(kWidth, kHeight), samples);
        return engine::settingsOn(context().capabilities(), requested);
    }

    /// Pixels in GL's order, rows from the bottom.
    std::vector<Pixel> prepassed(const scenes::Scene& scene, const frame::FrameSettings& settings) {
        const frame::PreparedView prepared = engine::prepareView(scene, Technique::ForwardPrepass, settings);
        const frame::FrameSpec& spec = prepared.spec;
        scenes::ClosedMeshes closedMeshes;
        const frame::SceneGpu sceneGpu(scene, closedMeshes, spec.features);
        frame::DrawnView view;
        view.prepared = prepared;
        view.scene = &sceneGpu;
        view.draws = frame::makeViewDraws(sceneGpu.drawList(), prepared.camera, false);
        shader::ProgramLibrary programs;
        gpu::GraphBackend backend;
        graph::Graph graph;
        const passes::UploadViewPass::Outputs uploaded = passes::UploadViewPass::add(graph, spec, &view);
        const frame::FrameSpec* const specs[] = {&spec};
        const frame::SurfaceHandles surfaces{
            &view, frame::importScene(graph, specs, &sceneGpu), {uploaded.constants}, uploaded.rows, uploaded.commands,
            {}};
        const passes::DepthPrepass::Outputs drawn = passes::DepthPrepass::add(graph, spec, {true}, {surfaces});
        const graph::BufferHandle read = readBack(graph, drawn, spec.samples);
        graph.output(read);
        const graph::CompiledGraph compiled = graph::compile(graph);
        graph::Execution execution(graph, compiled, backend, &programs);
        execution.run();
        const std::vector<float> values =
            execution.buffer(read).downloadAs<float>(std::size_t(kWidth) * kHeight * std::size_t(spec.samples) * 2);
        std::vector<Pixel> pixels(std::size_t(kWidth) * kHeight);
        for (std::size_t i = 0; i < values.size(); i += 2) {
            Pixel& pixel = pixels[i / 2 / std::size_t(spec.samples)];
            pixel.depth.push_back(values[i]);
            pixel.shadingDepth.push_back(values[i + 1]);
        }
        return pixels;
    }

private:
    struct Read {
        graph::TextureHandle depth, shadingDepth;
        graph::BufferHandle values;
    };
    /// Copies both textures, sample by sample, into a buffer of pairs.
    graph::BufferHandle readBack(graph::Graph& graph, const passes::DepthPrepass::Outputs& drawn, int samples) {
        const std::string kind = samples > 1 ? "sampler2DMS" : "sampler2D";
        copy_ = std::make_unique<gpu::Program>(
            "copy", std::vector<gpu::StageSource>{
                        {gpu::Stage::Compute,
                         "#version 450 core\nlayout(local_size_x = 1) in;\nlayout(binding = 0) uniform " + kind +
                             " depth;\nlayout(binding = 1) uniform " + kind +
                             " shadingDepth;\nlayout(binding = 0, std430) buffer V { float values[]; };\n"
                             "void main() {\n"
                             "    ivec2 p = ivec2(gl_WorkGroupID.xy);\n"
                             "    int sampleIndex = int(gl_WorkGroupID.z);\n"
                             "    uint i = 2u * ((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x)\n"
                             "                   * gl_NumWorkGroups.z + gl_WorkGroupID.z);\n"
                             "    values[i] = texelFetch(depth, p, sampleIndex).r;\n"
                             "    values[i + 1u] = texelFetch(shadingDepth, p, sampleIndex).r;\n"
                             "}\n"}});
        return graph
            .addPass<Read>(
                "read",
                [&](graph::PassBuilder& pass, Read& data) {
                    data.depth = pass.read(drawn.depth);
                    data.shadingDepth = pass.read(drawn.shadingDepth.value());
                    const std::size_t floats = std::size_t(kWidth) * kHeight * std::size_t(samples) * 2;
                    data.values = pass.create("values", graph::BufferDesc{floats * sizeof(float)});
                },
                [this, samples](const Read& data, const graph::PassContext& context) {
                    gpu::useProgram(*copy_);
                    gpu::bindTexture(0, context.texture(data.depth));
                    gpu::bindTexture(1, context.texture(data.shadingDepth));
                    gpu::bindStorageBuffer(0, context.buffer(data.values));
                    gpu::dispatch(kWidth, kHeight, std::uint32_t(samples));
                })
            .values;
    }
    std::unique_ptr<gpu::Program> copy_;
};

/// A floor up to the horizon of a level camera, which crosses the pixels of the middle row.
scenes::Scene endlessFloor() {
    scenes::Scene scene = everythingScene();
    scene.nodes.resize(1);
    scene.nodes[0].parentFromNode = glm::dmat4(1e7) * scene.nodes[0].parentFromNode;
    scene.nodes[0].parentFromNode[3] = {0, -1, 0, 1};
    scene.cameras[0].worldFromCamera = glm::dmat4(1.0);
    return scene;
}

TEST_F(ShadingDepth, everyCoveredSampleHasTheDepthOfItsFragmentAndTheOthersHaveNone) {
    const frame::FrameSettings four = settings(4);
    const std::vector<Pixel> pixels = prepassed(endlessFloor(), four);
    int partial = 0, partialOfOne = 0, whole = 0;
    for (const Pixel& pixel : pixels) {
        // Depth is linear over a plane, so that at the centre of the covered samples is their mean. If several
        // triangles share a pixel, it lies between the least and the most.
        std::vector<double> depths;
        for (const float depth : pixel.depth)
            if (depth > 0.0f) depths.push_back(double(depth));
        const double mean = std::accumulate(depths.begin(), depths.end(), 0.0) / double(depths.size());
        const std::set<float> lit(pixel.shadingDepth.begin(), pixel.shadingDepth.end());
        const bool isOne = lit.size() == (depths.size() < pixel.depth.size() ? 2u : 1u);
        for (std::size_t i = 0; i < pixel.depth.size(); ++i) {
            EXPECT_EQ(pixel.depth[i] == 0.0f, pixel.shadingDepth[i] == 0.0f);
            if (pixel.depth[i] == 0.0f) continue;
            // One per mille for the rounding of derivatives.
            if (isOne) {
                EXPECT_NEAR(pixel.shadingDepth[i], mean, 1e-3 * mean);
                continue;
            }
            EXPECT_GE(pixel.shadingDepth[i], 0.999 * *std::ranges::min_element(depths));
            EXPECT_LE(pixel.shadingDepth[i], 1.001 * *std::ranges::max_element(depths));
        }
        partialOfOne += isOne && !pixel.covered() && !depths.empty();
        whole += pixel.covered();
        partial += !pixel.covered() && *std::max_element(pixel.depth.begin(), pixel.depth.end()) > 0.0f;
    }
    EXPECT_GT(whole, kWidth * kHeight / 3);
    EXPECT_GT(partial, kWidth / 2) << "the horizon does not cross pixels";
    EXPECT_GT(partialOfOne, 8);
}

TEST_F(ShadingDepth, aPixelIsLitAtTheDepthThatThePrepassSays) {
    frame::FrameSettings four = settings(4);
    const scenes::Scene scene = endlessFloor();
    const std::vector<Pixel> pixels = prepassed(scene, four);
    four.view = frame::DebugView::Depth;
    const engine::RenderedFrame shown = frameOf(scene, four, Technique::ForwardPrepass);
    const double nearMetres = scene.cameras[0].nearMetres;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const Pixel& pixel = pixels[std::size_t(y * kWidth + x)];
            // Reverse-Z depth without far plane; uncovered samples show 0.
            double mean = 0.0;
            for (const float depth : pixel.shadingDepth)
                mean += depth == 0.0f ? 0.0 : nearMetres / double(depth) / double(pixel.depth.size());
            const double metres = shown.radiance[std::size_t(4 * ((kHeight - 1 - y) * kWidth + x))];
            // fp32: some ten roundings of 2^-24 from depth to position and its projection on the view axis.
            EXPECT_NEAR(metres, mean, 1e-6 * mean) << x << " " << y;
        }
}

/// A wall that leans back to the right, cut by the near plane just right of the centres of a pixel column. Rasterisers
/// snap the cut to their grid of 1/256 pixel, which covers the centres, and there the wall's plane lies in front of the
/// near plane. The depth buffer stores such fragments at the near plane.
TEST_F(ShadingDepth, aFragmentThatRoundingPutsBeforeTheNearPlaneIsLitAtIt) {
    scenes::Scene scene = quadScene(scenes::Material{});
    makeOrthographic(scene.cameras[0], 1.0);
    scene.cameras[0].nearMetres = 3.0; // distance of the wall's middle, which the middle column's centres show
    scene.cameras[0].farMetres = 4.0;  // so that a thousandth of a pixel is hundreds of depth steps
    scene.nodes[0].parentFromNode[0].z = -0.5;
    constexpr double kPixelMetres = 2.0 / kHeight;
    int atPlane = 0;
    for (const double rightPixels : {1.0 / 4096, 1.0 / 2048, 1.0 / 1024}) {
        scene.nodes[0].parentFromNode[3].z = 0.5 * rightPixels * kPixelMetres;
        for (const Pixel& pixel : prepassed(scene, settings(1))) {
            EXPECT_EQ(pixel.depth, pixel.shadingDepth);
            atPlane += pixel.depth[0] == 1.0f;
        }
    }
    EXPECT_GT(atPlane, 0) << "the cut meets no pixel's centre";
}

TEST_F(ShadingDepth, withOneSampleItIsExactlyTheDepth) {
    for (const Pixel& pixel : prepassed(everythingScene(), settings(1))) {
        ASSERT_EQ(pixel.depth.size(), 1u);
        EXPECT_EQ(pixel.depth, pixel.shadingDepth);
    }
}

} // namespace
} // namespace tessera
