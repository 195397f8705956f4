#include "passes/DiffusionPasses.h"

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

shader::ProgramDesc screenProgram(const std::string& name, const std::string& file, frame::Defines defines = {}) {
    shader::ProgramDesc program;
    program.name = name;
    program.vertex = "passes/fullscreen.vert";
    program.fragment = "passes/" + file;
    program.defines = std::move(defines);
    return program;
}
shader::ProgramDesc halveProgram() {
    return screenProgram("diffusion_halve", "diffusion_halve.frag");
}
shader::ProgramDesc fillProgram() {
    return screenProgram("diffusion_fill", "diffusion_fill.frag");
}
shader::ProgramDesc blurProgram(bool alongV) {
    return screenProgram(alongV ? "diffusion_along_v" : "diffusion_along_u", "diffusion_blur.frag",
                         {{"SUMS", alongV ? "1" : "0"}});
}

/// What an object's passes have in common.
struct Object {
    graph::Graph& graph;
    const frame::FrameSpec& spec;
    std::string suffix; ///< of the names of its passes
    TextureHandle steps, continued;

    /// Light that enters the surface, and the sum of what leaves it.
    struct Light {
        TextureHandle entering, sum;
    };
    Light light(const DiffusionPasses::Inputs& inputs, const frame::DiffusionAtlas* atlas) const;
    Light halve(Light light) const;
    TextureHandle fill(const std::string& name, TextureHandle light) const;
    /// Fills into the object's cell of a view's atlas, and says there what else pixels ask for.
    TextureHandle store(TextureHandle light, TextureHandle atlas, const frame::DiffusedCells& cells, std::size_t cell,
                        const std::function<void()>& done) const;
    /// Light spread by one more level; adds it to the sum.
    Light spread(std::size_t level, Light light) const;

private:
    struct FillData {
        TextureHandle steps, continued, light, filled;
    };
    TextureHandle addFill(const std::string& name, TextureHandle light, std::optional<TextureHandle> target,
                          const std::function<void(const FillData&, const graph::PassContext&)>& run) const;
    static void drawFilled(const FillData& data, const graph::PassContext& context,
                           const shared::DiffusionFillConstants& constants);
};

Object::Light Object::light(const DiffusionPasses::Inputs& inputs, const frame::DiffusionAtlas* atlas) const {
    struct Data {
        frame::SurfaceHandles surfaces;
        frame::LightingInputs lighting;
        std::optional<graph::BufferHandle> triangleNormals;
        Light light;
    };
    const gpu::Buffer* const normals = atlas ? &atlas->triangleNormals : nullptr;
    const graph::BufferHandle imported =
        graph.import("triangle_normals" + suffix, graph::BufferDesc{normals ? normals->bytes() : 0}, normals);
    return graph
        .addPass<Data>(
            "diffusion_light" + suffix,
            [&](graph::PassBuilder& pass, Data& out) {
                pass.program(lightProgram(spec));
                out.surfaces = inputs.surfaces.read(pass);
                out.lighting = inputs.lighting.read(pass);
                if (spec.features[frame::Feature::Shadows])
                    out.triangleNormals = pass.read(imported, Access::TexelRead);
                out.light.entering = pass.create("entering_light", square(spec.settings.sizePixels.x));
                out.light.sum = pass.create("light_sum", square(spec.settings.sizePixels.x));
            },
            [constants = shared::DiffusionLightConstants{glm::vec4(spec.spread->unspread, 0.0),
                                                         glm::vec4(spec.spread->unblurred, 0.0)}](
                const Data& out, const graph::PassContext& context) {
                context.bindTargets();
                for (int i = 0; i < 2; ++i) gpu::clearColor(i, glm::vec4(0.0f));
                gpu::useProgram(context.program());
                out.lighting.bind(context);
                context.constants(UNIFORM_PASS, constants);
                if (out.triangleNormals)
                    gpu::bindTexelBuffer(TEXTURE_UNIT_TRIANGLE_NORMALS,
                                         context.buffer(*out.triangleNormals).texels(graph::Format::Rgba32Float));
                gpu::PipelineState state;
                state.bothSides = true;
                for (const auto kind : {frame::SurfaceHandles::Kind::Opaque, frame::SurfaceHandles::Kind::Transparent})
                    gpu::drawInBands([&] { out.surfaces.draw(context, kind, state); });
            })
        .light;
}

Object::Light Object::halve(Light light) const {
    struct Data {
        Light light, halved;
    };
    return graph
        .addPass<Data>(
            "diffusion_halve" + suffix,
            [&](graph::PassBuilder& pass, Data& out) {
                pass.program(halveProgram());
                out.light = {pass.read(light.entering), pass.read(light.sum)};
                out.halved.entering = pass.create("halved_light", square(spec.spreadTexels()));
                out.halved.sum = pass.create("halved_sum", square(spec.spreadTexels()));
            },
            [](const Data& out, const graph::PassContext& context) {
                context.bindTargets();
                gpu::useProgram(context.program());
                gpu::setState({});
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(out.light.entering));
                gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_SUM, context.texture(out.light.sum));
                gpu::drawFullscreenTriangle();
            })
        .halved;
}

TextureHandle Object::addFill(const std::string& name, TextureHandle light, std::optional<TextureHandle> target,
                              const std::function<void(const FillData&, const graph::PassContext&)>& run) const {
    return graph
        .addPass<FillData>(
            name + suffix,
            [&](graph::PassBuilder& pass, FillData& out) {
                pass.program(fillProgram());
                out.steps = pass.read(steps);
                out.continued = pass.read(continued);
                out.light = pass.read(light);
                out.filled = target ? pass.write(*target) : pass.create("filled_light", square(spec.spreadTexels()));
            },
            run)
        .filled;
}

void Object::drawFilled(const FillData& data, const graph::PassContext& context,
                        const shared::DiffusionFillConstants& constants) {
    gpu::useProgram(context.program());
    gpu::setState({});
    context.constants(UNIFORM_PASS, constants);
    gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_STEPS, context.texture(data.steps));
    gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_CONTINUED, context.texture(data.continued));
    gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(data.light));
    gpu::drawFullscreenTriangle();
}

TextureHandle Object::fill(const std::string& name, TextureHandle light) const {
    return addFill(name, light, {}, [](const FillData& data, const graph::PassContext& context) {
        context.bindTargets();
        drawFilled(data, context, {glm::uvec4(0)});
    });
}

TextureHandle Object::store(TextureHandle light, TextureHandle atlas, const frame::DiffusedCells& cells,
                            std::size_t cell, const std::function<void()>& done) const {
    const glm::ivec2 corner = cells.corner(int(cell)), ofCell = cells.ofCell(int(cell));
    const int side = cells.sideTexels;
    const glm::vec4 values(glm::vec3(spec.spread->unspread), float(frame::borderTexels(spec.gutterTexels, side)));
    return addFill("diffusion_store", light, atlas,
                   [corner, ofCell, side, values, done](const FillData& data, const graph::PassContext& context) {
                       context.bindTargets();
                       gpu::setScissor({corner.x, corner.y, side, side});
                       drawFilled(data, context, {glm::uvec4(corner, 0, 0)});
                       gpu::setScissor({ofCell.x, ofCell.y, 1, 1});
                       gpu::clearColor(0, values);
                       if (done) done();
                   });
}

Object::Light Object::spread(std::size_t number, Light light) const {
    struct Data {
        TextureHandle steps, light, spread, sum;
    };
    const frame::DiffusionLevel& level = spec.spread->levels[number];
    const auto constants = [&](bool alongV) {
        return shared::DiffusionBlurConstants{
            glm::vec4(float(level.varianceSquareMetres), alongV ? 1.0f : 0.0f, number == 0 ? 1.0f : 0.0f, 0.0f),
            glm::vec4(glm::vec3(level.weight), 0.0f)};
    };
    const auto run = [](const Data& out, const graph::PassContext& context,
                        const shared::DiffusionBlurConstants& values, const gpu::PipelineState& state) {
        gpu::useProgram(context.program());
        gpu::setState(state);
        context.constants(UNIFORM_PASS, values);
        gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_STEPS, context.texture(out.steps));
        gpu::bindTexture(TEXTURE_UNIT_DIFFUSION_LIGHT, context.texture(out.light));
        gpu::drawFullscreenTriangle();
    };
    const TextureHandle alongU =
        graph
            .addPass<Data>(
                fmt::format("diffusion_along_u {}{}", number + 1, suffix),
                [&](graph::PassBuilder& pass, Data& out) {
                    pass.program(blurProgram(false));
                    out.steps = pass.read(steps);
                    out.light = pass.read(light.entering);
                    out.spread = pass.create("light_along_u", square(spec.spreadTexels()));
                },
                [run, values = constants(false)](const Data& out, const graph::PassContext& context) {
                    context.bindTargets();
                    run(out, context, values, {});
                })
            .spread;
    const Data done = graph.addPass<Data>(
        fmt::format("diffusion_along_v {}{}", number + 1, suffix),
        [&](graph::PassBuilder& pass, Data& out) {
            pass.program(blurProgram(true));
            out.steps = pass.read(steps);
            out.light = pass.read(alongU);
            out.spread = pass.create("spread_light", square(spec.spreadTexels()));
            out.sum = pass.write(light.sum);
        },
        [run, values = constants(true)](const Data& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::PipelineState state;
            state.blend = gpu::Blend::Additive;
            run(out, context, values, state);
        });
    return {done.spread, done.sum};
}

} // namespace

graph::TextureDesc DiffusionPasses::atlas(const frame::FrameSpec& view) {
    const glm::ivec2 texels = view.diffusedCells().texels();
    return {kFormat, texels.x, texels.y};
}

std::vector<shader::ProgramDesc> DiffusionPasses::programs(const frame::FrameSpec& object) {
    return {lightProgram(object), halveProgram(), fillProgram(), blurProgram(false), blurProgram(true)};
}

DiffusionPasses::Outputs DiffusionPasses::add(graph::Graph& graph, const frame::FrameSpec& view, std::size_t cell,
                                              const Inputs& inputs) {
    const frame::FrameSpec& spec = view.diffused[cell];
    const frame::DrawnView::Diffused* const drawn = inputs.drawn ? &inputs.drawn->diffused[cell] : nullptr;
    const frame::DiffusionAtlas* const atlas = drawn ? drawn->atlas : nullptr;
    const int side = spec.spreadTexels();
    Object object{graph, spec, cell == 0 ? "" : fmt::format(", object {}", cell + 1), {}, {}};
    object.steps = graph.import("diffusion_steps" + object.suffix, square(side), atlas ? &atlas->steps : nullptr);
    object.continued = graph.import("diffusion_continued" + object.suffix, square(side, graph::Format::Rg32Float),
                                    atlas ? &atlas->continued : nullptr);
    Object::Light light = object.light(inputs, atlas);
    if (side != spec.settings.sizePixels.x) light = object.halve(light);
    for (std::size_t level = 0; level < spec.spread->levels.size(); ++level)
        light =
            object.spread(level, {object.fill(fmt::format("diffusion_fill {}", level + 1), light.entering), light.sum});
    std::function<void()> done;
    if (drawn) done = [memory = inputs.drawn->diffusionMemory, cell, key = drawn->key] { memory->hold(cell, key); };
    return {object.store(light.sum, inputs.atlas, view.diffusedCells(), cell, done)};
}

} // namespace tessera::passes
