#include "passes/DiffusionPasses.h"

#include <functional>

#include <fmt/format.h>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/TexelBuffer.h"
#include "shaders/shared/diffusion.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

using graph::Access;
using graph::TextureHandle;

namespace {

constexpr graph::Format kFormat = graph::Format::Rgba32Float;

graph::TextureDesc square(int sideTexels, graph::Format format = kFormat) {
    return {format, sideTexels, sideTexels};
}

shader::ProgramDesc lightProgram(const frame::FrameSpec& spec) {
    frame::Defines defines{{"DEPTH_ONLY", "0"}, {"BLENDED", "0"}};
    frame::addCursorDefines(spec, false, defines);
    return frame::frameProgram(spec, "diffusion_light", "passes/geometry.vert", "passes/diffusion_light.frag", defines);
}

shader::ProgramDesc halveProgram() {
    return shader::screenProgram("diffusion_halve", "passes/diffusion_halve.frag");
}
shader::ProgramDesc fillProgram() {
    return shader::screenProgram("diffusion_fill", "passes/diffusion_fill.frag");
}
shader::ProgramDesc storeProgram(bool sums) {
    return shader::screenProgram("diffusion_store", "passes/diffusion_store.frag", {{"SUMS", sums ? "1" : "0"}});
}
shader::ProgramDesc blurProgram(bool alongV) {
    return shader::screenProgram(alongV ? "diffusion_along_v" : "diffusion_along_u", "passes/diffusion_blur.frag",
                                 {{"SUMS", alongV ? "1" : "0"}});
}

/// Suffix of the names of an object's passes and resources.
std::string suffixOf(std::size_t cell) {
    return cell == 0 ? "" : fmt::format(", object {}", cell + 1);
}

/// Rectangles of tiles, in texels.
using Rectangles = std::vector<gpu::Rectangle>;

void drawWithin(const Rectangles& rectangles) {
    for (const gpu::Rectangle& rectangle : rectangles) {
        gpu::setScissor(rectangle);
        gpu::drawFullscreenTriangle();
    }
}

/// Adds the diffusion passes of an object.
struct Object {
    graph::Graph& graph;
    const frame::FrameSpec& spec;
    std::string suffix; ///< of the names of its passes
    TextureHandle steps, continued;

    using Light = DiffusionPasses::Light;
    /// Relights tiles.
    Light light(const DiffusionPasses::Inputs& inputs, Light light, const frame::TileSet& tiles,
                const std::function<void()>& done) const;

    /// Irradiance diffused by the levels so far, and its weighted sum over levels; no sum before the first level.
    struct Diffused {
        TextureHandle light;
        std::optional<TextureHandle> sum;
    };
    Diffused diffuse(std::size_t level, const Diffused& before, const frame::DiffusionWork::Level& tiles) const;
    /// Stores the result in the object's cell of the diffused irradiance atlas, and the cell's constants.
    TextureHandle store(const Diffused& diffused, TextureHandle undiffused, TextureHandle diffusionAtlas,
                        const frame::DiffusionAtlas& cells, std::size_t cell, const frame::TileSet& tiles,
                        const std::function<void()>& done) const;
    /// Marks tiles of the cell as unknown, with alpha 0.
    TextureHandle blank(TextureHandle diffusionAtlas, const frame::DiffusionAtlas& cells, std::size_t cell,
                        const frame::TileSet& tiles, const std::function<void()>& done) const;

private:
    /// The constants of a cell: DiffusionAtlas::ofCell().
    glm::vec4 cellValues(const frame::DiffusionAtlas& cells) const {
        return {glm::vec3(spec.diffusionKernel->inPixels),
                float(frame::borderTexels(spec.gutterTexels, cells.sideTexels))};
    }
    Rectangles rectanglesIn(const frame::DiffusionAtlas& cells, std::size_t cell, const frame::TileSet& tiles) const {
        const glm::ivec2 corner = cells.corner(int(cell));
        Rectangles rectangles = rectanglesOf(tiles);
        for (gpu::Rectangle& rectangle : rectangles) {
            rectangle.x += corner.x;
            rectangle.y += corner.y;
        }
        return rectangles;
    }
    Rectangles rectanglesOf(const frame::TileSet& tiles) const {
        return tiles.rectangles(frame::kDiffusionTileTexels, spec.diffusionTexels());
    }
    Light halve(Light whole, Light halved, const frame::TileSet& tiles) const;
    TextureHandle fill(const std::string& name, TextureHandle light, const frame::TileSet& tiles) const;
};

Object::Light Object::light(const DiffusionPasses::Inputs& inputs, Light light, const frame::TileSet& tiles,
                            const std::function<void()>& done) const {
    struct Data {
        frame::SurfaceHandles surfaces;
        frame::LightingInputs lighting;
        Light light;
        TextureHandle mask;
    };
    const int side = spec.settings.sizePixels.x;
    const bool isHalved = side != spec.diffusionTexels();
    const Light lit =
        graph
            .addPass<Data>(
                "diffusion_light" + suffix,
                [&](graph::PassBuilder& pass, Data& out) {
                    pass.program(lightProgram(spec));
                    out.surfaces = inputs.surfaces.read(pass);
                    out.lighting = inputs.lighting.read(pass);
                    if (isHalved)
                        out.light = {pass.create("whole_entering_light", square(side)),
                                     pass.create("whole_undiffused_light", square(side))};
                    else
                        out.light = {pass.write(light.entering), pass.write(light.undiffused)};
                    out.mask = pass.create("diffusion_mask", square(side, graph::Format::Depth32Float),
                                           Access::DepthAttachment);
                },
                [side, done, rectangles = tiles.rectangles(frame::kDiffusionTileTexels * (isHalved ? 2 : 1), side),
                 constants = shared::DiffusionLightConstants{glm::vec4(spec.diffusionKernel->inPixels, 0.0),
                                                             glm::vec4(spec.diffusionKernel->inTexels, 0.0)}](
                    const Data& out, const graph::PassContext& context) {
                    context.bindTargets();
                    // No fragment passes the test against depth 1.
                    gpu::clearDepth(1.0f);
                    for (const gpu::Rectangle& rectangle : rectangles) {
                        gpu::setScissor(rectangle);
                        gpu::clearDepth(0.0f);
                        for (int i = 0; i < 2; ++i) gpu::clearColor(i, glm::vec4(0.0f));
                    }
                    gpu::setScissor({0, 0, side, side});
                    gpu::useProgram(context.program());
                    out.lighting.bind(context);
                    context.constants(UNIFORM_PASS, constants);
                    gpu::PipelineState state;
                    state.bothSides = true;
                    state.depthTest = gpu::DepthTest::Greater;
                    for (const auto kind :
                         {frame::SurfaceHandles::Kind::Opaque, frame::SurfaceHandles::Kind::Transparent})
                        gpu::drawInBands([&] { out.surfaces.draw(context, kind, state); });
                    if (done) done();
                })
            .light;
    return isHalved ? halve(lit, light, tiles) : lit;
}

Object::Light Object::halve(Light whole, Light halved, const frame::TileSet& tiles) const {
    struct Data {
        Light whole, halved;
    };
    return graph
        .addPass<Data>(
            "diffusion_halve" + suffix,
            [&](graph::PassBuilder& pass, Data& out) {
                pass.program(halveProgram());
                out.whole = {pass.read(whole.entering), pass.read(whole.undiffused)};
                out.halved = {pass.write(halved.entering), pass.write(halved.undiffused)};
            },
            [rectangles = rectanglesOf(tiles)](const Data& out, const graph::PassContext& context) {
                context.bindTargets();
                gpu::useProgram(context.program());
                gpu::setState({});
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(out.whole.entering));
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_UNDIFFUSED, context.texture(out.whole.undiffused));
                drawWithin(rectangles);
            })
        .halved;
}

TextureHandle Object::fill(const std::string& name, TextureHandle light, const frame::TileSet& tiles) const {
    struct Data {
        TextureHandle steps, continued, light, filled;
    };
    return graph
        .addPass<Data>(
            name + suffix,
            [&](graph::PassBuilder& pass, Data& out) {
                pass.program(fillProgram());
                out.steps = pass.read(steps);
                out.continued = pass.read(continued);
                out.light = pass.read(light);
                out.filled = pass.create("filled_light", square(spec.diffusionTexels()));
            },
            [rectangles = rectanglesOf(tiles)](const Data& out, const graph::PassContext& context) {
                context.bindTargets();
                gpu::useProgram(context.program());
                gpu::setState({});
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_STEPS, context.texture(out.steps));
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_CONTINUED, context.texture(out.continued));
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(out.light));
                drawWithin(rectangles);
            })
        .filled;
}

TextureHandle Object::store(const Diffused& diffused, TextureHandle undiffused, TextureHandle diffusionAtlas,
                            const frame::DiffusionAtlas& cells, std::size_t cell, const frame::TileSet& tiles,
                            const std::function<void()>& done) const {
    struct Data {
        TextureHandle steps, continued, undiffused, diffusionAtlas;
        std::optional<TextureHandle> sum;
    };
    const glm::ivec2 corner = cells.corner(int(cell)), ofCell = cells.ofCell(int(cell));
    return graph
        .addPass<Data>(
            "diffusion_store" + suffix,
            [&](graph::PassBuilder& pass, Data& out) {
                pass.program(storeProgram(diffused.sum.has_value()));
                out.steps = pass.read(steps);
                out.continued = pass.read(continued);
                out.undiffused = pass.read(undiffused);
                if (diffused.sum) out.sum = pass.read(*diffused.sum);
                out.diffusionAtlas = pass.write(diffusionAtlas);
            },
            [corner, ofCell, done, rectangles = rectanglesIn(cells, cell, tiles),
             values = cellValues(cells)](const Data& out, const graph::PassContext& context) {
                context.bindTargets();
                gpu::useProgram(context.program());
                gpu::setState({});
                context.constants(UNIFORM_PASS, shared::DiffusionStoreConstants{glm::uvec4(corner, 0, 0)});
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_STEPS, context.texture(out.steps));
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_CONTINUED, context.texture(out.continued));
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_UNDIFFUSED, context.texture(out.undiffused));
                if (out.sum) gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(*out.sum));
                drawWithin(rectangles);
                gpu::setScissor({ofCell.x, ofCell.y, 1, 1});
                gpu::clearColor(0, values);
                if (done) done();
            })
        .diffusionAtlas;
}

TextureHandle Object::blank(TextureHandle diffusionAtlas, const frame::DiffusionAtlas& cells, std::size_t cell,
                            const frame::TileSet& tiles, const std::function<void()>& done) const {
    struct Data {
        TextureHandle diffusionAtlas;
    };
    return graph
        .addPass<Data>(
            "diffusion_blank" + suffix,
            [&](graph::PassBuilder& pass, Data& out) { out.diffusionAtlas = pass.write(diffusionAtlas); },
            [ofCell = cells.ofCell(int(cell)), done, rectangles = rectanglesIn(cells, cell, tiles),
             values = cellValues(cells)](const Data&, const graph::PassContext& context) {
                context.bindTargets();
                for (const gpu::Rectangle& rectangle : rectangles) {
                    gpu::setScissor(rectangle);
                    gpu::clearColor(0, glm::vec4(0.0f));
                }
                gpu::setScissor({ofCell.x, ofCell.y, 1, 1});
                gpu::clearColor(0, values);
                done();
            })
        .diffusionAtlas;
}

Object::Diffused Object::diffuse(std::size_t number, const Diffused& before,
                                 const frame::DiffusionWork::Level& tiles) const {
    struct Data {
        TextureHandle steps, light, diffused;
        std::optional<TextureHandle> sum;
    };
    const frame::DiffusionLevel& level = spec.diffusionKernel->levels[number];
    const frame::LevelReach reach = frame::levelReach(*spec.diffusionKernel, number);
    const auto constants = [&](bool alongV) {
        return shared::DiffusionBlurConstants{
            glm::vec4(float(reach.toSquareMetres), alongV ? 1.0f : 0.0f, float(reach.fromSquareMetres), 0.0f),
            glm::vec4(glm::vec3(level.weight), float(frame::texelVariance(spec.settings.diffusion.half)))};
    };
    const auto run = [](const Data& out, const graph::PassContext& context, const Rectangles& rectangles,
                        const shared::DiffusionBlurConstants& values, const gpu::PipelineState& state) {
        gpu::useProgram(context.program());
        gpu::setState(state);
        context.constants(UNIFORM_PASS, values);
        gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_STEPS, context.texture(out.steps));
        gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(out.light));
        drawWithin(rectangles);
    };
    const TextureHandle filled = fill(fmt::format("diffusion_fill {}", number + 1), before.light, tiles.fill);
    const TextureHandle alongU =
        graph
            .addPass<Data>(
                fmt::format("diffusion_along_u {}{}", number + 1, suffix),
                [&](graph::PassBuilder& pass, Data& out) {
                    pass.program(blurProgram(false));
                    out.steps = pass.read(steps);
                    out.light = pass.read(filled);
                    out.diffused = pass.create("light_along_u", square(spec.diffusionTexels()));
                },
                [run, rectangles = rectanglesOf(tiles.alongU),
                 values = constants(false)](const Data& out, const graph::PassContext& context) {
                    context.bindTargets();
                    run(out, context, rectangles, values, {});
                })
            .diffused;
    const Data done = graph.addPass<Data>(
        fmt::format("diffusion_along_v {}{}", number + 1, suffix),
        [&](graph::PassBuilder& pass, Data& out) {
            pass.program(blurProgram(true));
            out.steps = pass.read(steps);
            out.light = pass.read(alongU);
            out.diffused = pass.create("diffused_light", square(spec.diffusionTexels()));
            out.sum =
                before.sum ? pass.write(*before.sum) : pass.create("sum_of_light", square(spec.diffusionTexels()));
        },
        [run, isFirst = !before.sum, rectangles = rectanglesOf(tiles.alongV),
         values = constants(true)](const Data& out, const graph::PassContext& context) {
            context.bindTargets();
            for (int i = 0; i < (isFirst ? 2 : 1); ++i) gpu::clearColor(i, glm::vec4(0.0f));
            gpu::PipelineState state;
            state.blend = gpu::Blend::Additive;
            run(out, context, rectangles, values, state);
        });
    return {done.diffused, done.sum};
}

} // namespace

graph::TextureDesc DiffusionPasses::diffusionAtlas(const frame::FrameSpec& view) {
    const glm::ivec2 texels = view.diffusionAtlas().texels();
    return {kFormat, texels.x, texels.y};
}

std::array<std::string, 2> DiffusionPasses::keptNames(std::size_t view, std::size_t cell) {
    const std::string suffix = suffixOf(cell) + (view == 0 ? "" : fmt::format(" ({})", view + 1));
    return {"entering_light" + suffix, "undiffused_light" + suffix};
}

DiffusionPasses::Light DiffusionPasses::kept(graph::Graph& graph, const frame::FrameSpec& view, std::size_t viewNumber,
                                             std::size_t cell) {
    const graph::TextureDesc desc = square(view.diffusionViews[cell].diffusionTexels());
    const auto [entering, undiffused] = keptNames(viewNumber, cell);
    return {graph.persist(entering, desc, frame::kDiffusedLightRevision),
            graph.persist(undiffused, desc, frame::kDiffusedLightRevision)};
}

DiffusionPasses::Outputs DiffusionPasses::add(graph::Graph& graph, const frame::FrameSpec& view, const Params& params,
                                              const Inputs& inputs) {
    const frame::DiffusionTask& task = params.task;
    const frame::DiffusionWork& work = task.work;
    const frame::FrameSpec& spec = view.diffusionViews[params.cell];
    const frame::DiffusionAtlas cells = view.diffusionAtlas();
    const int side = spec.diffusionTexels();
    Object object{graph, spec, suffixOf(params.cell), {}, {}};
    object.steps = graph.import("diffusion_steps" + object.suffix, square(side),
                                inputs.uvAtlas ? &inputs.uvAtlas->steps : nullptr);
    object.continued = graph.import("diffusion_continued" + object.suffix, square(side, graph::Format::Rg32Float),
                                    inputs.uvAtlas ? &inputs.uvAtlas->continued : nullptr);
    Light light = inputs.light;
    if (task.lights) light = object.light(inputs, light, work.light, task.lit);
    TextureHandle written = inputs.diffusionAtlas;
    if (!work.blank.isEmpty()) written = object.blank(written, cells, params.cell, work.blank, task.blanked);
    if (!task.diffuses) {
        // Kept for a later frame.
        if (task.lights) {
            graph.output(light.entering);
            graph.output(light.undiffused);
        }
        return {written};
    }
    Object::Diffused diffused{light.entering, {}};
    for (std::size_t level = 0; level < work.levels.size(); ++level)
        diffused = object.diffuse(level, diffused, work.levels[level]);
    return {object.store(diffused, light.undiffused, written, cells, params.cell, work.store, task.stored)};
}

} // namespace tessera::passes
