#include "renderer/frame/FrameHandles.h"

#include <algorithm>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/light_lists.h"
#include "shaders/shared/slots.h"
#include "shaders/shared/subsurface.h"

namespace tessera::frame {

using graph::Access;
using graph::Format;

namespace {

template <typename Handle>
std::optional<Handle> readWhereThere(graph::PassBuilder& pass, const std::optional<Handle>& handle, Access access) {
    return handle ? std::optional<Handle>(pass.read(*handle, access)) : std::nullopt;
}

void bindTexels(const graph::PassContext& context, std::uint32_t unit, graph::BufferHandle handle, Format format) {
    gpu::bindTexelBuffer(unit, context.buffer(handle).texels(format));
}

} // namespace

ViewHandles ViewHandles::read(graph::PassBuilder& pass) const {
    return {pass.read(constants, Access::UniformRead)};
}

void ViewHandles::bind(const graph::PassContext& context) const {
    gpu::bindUniformBuffer(UNIFORM_VIEW, context.buffer(constants), 0, sizeof(shared::ViewConstants));
}

SurfaceHandles SurfaceHandles::readGeometry(graph::PassBuilder& pass) const {
    SurfaceHandles result{drawn,
                          scene,
                          view.constants ? view.read(pass) : view,
                          pass.read(rows, Access::VertexRead),
                          pass.read(commands, Access::IndirectRead),
                          {},
                          {},
                          {}};
    for (graph::BufferHandle& stream : result.scene.vertices) stream = pass.read(stream, Access::VertexRead);
    result.scene.indices = pass.read(scene.indices, Access::IndexRead);
    return result;
}

SurfaceHandles SurfaceHandles::read(graph::PassBuilder& pass) const {
    SurfaceHandles result = readGeometry(pass);
    result.scene.materials = pass.read(scene.materials, Access::UniformRead);
    result.scene.facetNormals = readWhereThere(pass, scene.facetNormals, Access::VertexRead);
    result.diffusedLight = readWhereThere(pass, diffusedLight, Access::ImageRead);
    result.hook = readWhereThere(pass, hook, Access::UniformRead);
    return result;
}

SurfaceHandles SurfaceHandles::readDepth(graph::PassBuilder& pass,
                                         const std::vector<shader::ProgramDesc>& programs) const {
    SurfaceHandles result = readGeometry(pass);
    for (const shader::ProgramDesc& program : programs) result.depthPrograms.push_back(pass.program(program));
    if (programs.size() > 1) result.scene.materials = pass.read(scene.materials, Access::UniformRead);
    return result;
}

void SurfaceHandles::drawDepth(const graph::PassContext& context, Kind kind, const gpu::PipelineState& state) const {
    view.bind(context);
    drawDepth(context, kind == Kind::Opaque ? drawn->draws.opaque : drawn->draws.transparent, state);
}

void SurfaceHandles::drawDepth(const graph::PassContext& context, std::span<const Batch> batches,
                               const gpu::PipelineState& state) const {
    drawn->scene->drawDepth(
        buffers(context), batches, state,
        {context.program(depthPrograms[0]), depthPrograms.size() > 1 ? &context.program(depthPrograms[1]) : nullptr});
}

void SurfaceHandles::bind(const graph::PassContext& context) const {
    view.bind(context);
    if (hook) gpu::bindUniformBuffer(UNIFORM_HOOK, context.buffer(*hook), 0, sizeof(shared::HookConstants));
    if (diffusedLight)
        gpu::bindImage(IMAGE_UNIT_DIFFUSED_LIGHT, context.texture(*diffusedLight), gpu::ImageAccess::Read);
}

void SurfaceHandles::draw(const graph::PassContext& context, Kind kind, const gpu::PipelineState& state,
                          std::optional<gpu::Blend> transmitting) const {
    bind(context);
    const ViewDraws& draws = drawn->draws;
    drawn->scene->draw(buffers(context), kind == Kind::Opaque ? draws.opaque : draws.transparent, state, transmitting);
}

void SurfaceHandles::drawOpaqueInParts(const graph::PassContext& context, const gpu::PipelineState& state) const {
    const std::vector<gpu::DrawIndexedCommand> all = drawn->scene->commandsOf(drawn->draws);
    const std::vector<Batch>& batches = drawn->draws.opaque;
    std::size_t triangles = 0;
    for (const Batch& batch : batches)
        for (int i = 0; i < batch.count; ++i) triangles += trianglesIn(all[std::size_t(batch.first + i)]);
    gpu::drawInParts(triangles, [&](std::size_t first, std::size_t count) {
        if (count == triangles) return draw(context, Kind::Opaque, state);
        bind(context);
        drawn->scene->drawPart(buffers(context), batches, state, {all, first, count});
    });
}

LightListHandles LightListHandles::read(graph::PassBuilder& pass) const {
    pass.read(tiles, Access::TexelRead);
    return {pass.read(tiles, Access::StorageRead), pass.read(cells, Access::StorageRead),
            pass.read(entries, Access::TexelRead)};
}

void LightListHandles::bind(const graph::PassContext& context) const {
    // Binds only the used bytes: a growing buffer may exceed the maximum block size.
    const auto bindUsed = [&](std::uint32_t slot, graph::BufferHandle handle, std::size_t least) {
        gpu::bindStorageBuffer(slot, context.buffer(handle), 0, std::max(context.bytes(handle), least));
    };
    bindUsed(STORAGE_LIGHT_TILES, tiles, sizeof(shared::LightTile));
    bindUsed(STORAGE_LIGHT_CELLS, cells, sizeof(glm::uvec2));
    bindTexels(context, TEXTURE_UNIT_LIGHT_TILES, tiles, Format::Rg32Uint);
    bindTexels(context, TEXTURE_UNIT_LIGHT_ENTRIES, entries, Format::R32Uint);
}

CasterTreeHandles CasterTreeHandles::read(graph::PassBuilder& pass) const {
    return {pass.read(constants, Access::UniformRead), pass.read(casters, Access::TexelRead)};
}

void CasterTreeHandles::bind(const graph::PassContext& context) const {
    gpu::bindUniformBuffer(UNIFORM_CASTER_TREE, context.buffer(constants), 0, sizeof(shared::CasterTreeConstants));
    bindTexels(context, TEXTURE_UNIT_SHADOWS, casters, Format::Rgba32Uint);
}

EnvironmentHandles EnvironmentHandles::read(graph::PassBuilder& pass) const {
    EnvironmentHandles result{pass.read(constants, Access::UniformRead), {}, {}, {}};
    result.map = readWhereThere(pass, map, Access::Sampled);
    result.filtered = readWhereThere(pass, filtered, Access::Sampled);
    result.samples = readWhereThere(pass, samples, Access::TexelRead);
    return result;
}

void EnvironmentHandles::bind(const graph::PassContext& context) const {
    gpu::bindUniformBuffer(UNIFORM_ENVIRONMENT, context.buffer(constants), 0, sizeof(shared::EnvironmentConstants));
    if (map) gpu::bindTexture(TEXTURE_UNIT_ENVIRONMENT, context.texture(*map));
    if (filtered) gpu::bindTexture(TEXTURE_UNIT_ENVIRONMENT_FILTERED, context.texture(*filtered));
    if (samples) bindTexels(context, TEXTURE_UNIT_ENVIRONMENT_SAMPLES, *samples, Format::Rgba32Float);
}

LobeHandles LobeHandles::read(graph::PassBuilder& pass) const {
    return {lobes, readWhereThere(pass, table, Access::Sampled), readWhereThere(pass, shapes, Access::Sampled)};
}

void LobeHandles::bind(const graph::PassContext& context) const {
    if (table) gpu::bindTexture(TEXTURE_UNIT_LOBES, context.texture(*table), &lobes->smooth());
    if (shapes) gpu::bindTexture(TEXTURE_UNIT_LOBE_SHAPES, context.texture(*shapes), &lobes->smooth());
}

LightingInputs LightingInputs::read(graph::PassBuilder& pass) const {
    LightingInputs result{view.read(pass),
                          pass.read(constants, Access::UniformRead),
                          pass.read(lights, Access::TexelRead),
                          readWhereThere(pass, materialTable, Access::TexelRead),
                          readWhereThere(pass, subsurfaces, Access::UniformRead),
                          {},
                          {},
                          readWhereThere(pass, shadowAtlas, Access::Sampled),
                          {},
                          lobes.read(pass),
                          readWhereThere(pass, lightPictures, Access::TexelRead)};
    if (environment) result.environment = environment->read(pass);
    if (lists) result.lists = lists->read(pass);
    if (casterTree) result.casterTree = casterTree->read(pass);
    return result;
}

void LightingInputs::bind(const graph::PassContext& context) const {
    view.bind(context);
    gpu::bindUniformBuffer(UNIFORM_LIGHTING, context.buffer(constants), 0, sizeof(shared::LightingConstants));
    bindTexels(context, TEXTURE_UNIT_LIGHTS, lights, Format::Rgba32Float);
    if (materialTable) bindTexels(context, TEXTURE_UNIT_MATERIALS, *materialTable, Format::Rgba32Uint);
    if (subsurfaces)
        gpu::bindUniformBuffer(UNIFORM_SUBSURFACE, context.buffer(*subsurfaces), 0,
                               SUBSURFACE_MOST * sizeof(shared::SubsurfaceConstants));
    if (lists) lists->bind(context);
    if (casterTree) casterTree->bind(context);
    if (shadowAtlas) gpu::bindTexture(TEXTURE_UNIT_SHADOWS, context.texture(*shadowAtlas));
    if (environment) environment->bind(context);
    lobes.bind(context);
    if (lightPictures) bindLightPictures(context, *lightPictures);
}

GBufferHandles GBufferHandles::read(graph::PassBuilder& pass, const FrameSpec& spec, Access depthAccess) const {
    GBufferHandles result;
    const std::vector<GBufferTexture> stored = spec.gbufferTextures();
    for (std::size_t i = 0; i < textures.size(); ++i) {
        pass.expect(textures[i], spec.texture(stored[i].format));
        result.textures.push_back(pass.read(textures[i]));
    }
    pass.expect(depth, spec.texture(Format::Depth32Float));
    result.depth = pass.read(depth, depthAccess);
    return result;
}

void GBufferHandles::bind(const graph::PassContext& context) const {
    for (std::size_t i = 0; i < textures.size(); ++i)
        gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), context.texture(textures[i]));
    gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(depth));
}

BehindHandles BehindHandles::read(graph::PassBuilder& pass, const FrameSpec& spec) const {
    pass.expect(picture, spec.texture(Format::Rgba32Float));
    if (levels) pass.expect(*levels, spec.behindLevels());
    if (depth) pass.expect(*depth, spec.texture(Format::R32Float));
    return {pass.read(picture), readWhereThere(pass, levels, Access::Sampled),
            readWhereThere(pass, depth, Access::Sampled)};
}

void BehindHandles::bind(const graph::PassContext& context) const {
    gpu::bindTexture(TEXTURE_UNIT_BEHIND, context.texture(picture));
    if (levels) gpu::bindTexture(TEXTURE_UNIT_BEHIND_LEVELS, context.texture(*levels));
}

LitDepths LitDepths::read(graph::PassBuilder& pass, const FrameSpec& spec, Access access) const {
    pass.expect(opaque, spec.texture(spec.samples > 1 ? Format::Rg32Float : Format::Depth32Float));
    if (transparent) pass.expect(*transparent, spec.texture(Format::Rg32Float));
    return {pass.read(opaque, access), readWhereThere(pass, transparent, access)};
}

void LitDepths::bind(const graph::PassContext& context) const {
    gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(opaque));
    if (transparent) gpu::bindTexture(TEXTURE_UNIT_TRANSPARENT_DEPTH, context.texture(*transparent));
}

SceneHandles importScene(graph::Graph& graph, std::span<const FrameSpec* const> specs, const SceneGpu* scene) {
    const FeatureSet& features = specs.front()->features;
    const auto import = [&](std::string name, const gpu::Buffer* buffer) {
        return graph.import(std::move(name), graph::BufferDesc{buffer ? buffer->bytes() : 0}, buffer);
    };
    SceneHandles handles;
    if (scene) {
        for (const gpu::Buffer* stream : scene->vertices()) handles.vertices.push_back(import(stream->label(), stream));
    } else {
        for (const std::string& name : streamNames(features)) handles.vertices.push_back(import(name, nullptr));
    }
    handles.indices = import("indices", scene ? &scene->indices() : nullptr);
    handles.materials = import("materials", scene ? &scene->materials() : nullptr);
    const gpu::Buffer* const table = scene ? scene->materialTable() : nullptr;
    if (!features[Feature::VaryingMaterials] && (!scene || table))
        handles.materialTable = import("material_table", table);
    if (features.enteringLight()) handles.subsurfaces = import("subsurfaces", scene ? scene->subsurfaces() : nullptr);
    if (std::ranges::any_of(specs, [](const FrameSpec* spec) { return spec->features[Feature::Shadows]; }))
        handles.facetNormals = import("facet_normals", scene ? scene->facetNormals() : nullptr);
    if (std::ranges::any_of(specs, &FrameSpec::tracesShadows))
        handles.casters = import("casters", scene ? scene->casters()->texels.get() : nullptr);
    return handles;
}

EnvironmentHandles importEnvironment(graph::Graph& graph, std::span<const FrameSpec* const> specs,
                                     EnvironmentGpu* environment) {
    EnvironmentHandles handles;
    const auto some = [&](bool (FrameSpec::*uses)() const) {
        return std::ranges::any_of(specs, [&](const FrameSpec* spec) { return (spec->*uses)(); });
    };
    const auto shaped =
        std::ranges::find_if(specs, [](const FrameSpec* spec) { return spec->environment.has_value(); });
    if (shaped == specs.end()) return handles;
    const EnvironmentShape& shape = *(*shaped)->environment;
    if (some(&FrameSpec::usesEnvironmentMap))
        handles.map = graph.import("environment_map", shape.map, environment ? &environment->map() : nullptr);
    if (some(&FrameSpec::usesEnvironmentSamples))
        handles.samples = graph.import("environment_samples", graph::BufferDesc{shape.sampleBytes},
                                       environment ? &environment->samples() : nullptr);
    if (some(&FrameSpec::usesFilteredEnvironment))
        handles.filtered =
            graph.import("environment_filtered", shape.filtered, environment ? &environment->filtered() : nullptr);
    return handles;
}

LobeHandles importLobes(graph::Graph& graph, std::span<const FrameSpec* const> specs, LobesGpu* lobes) {
    LobeHandles handles{lobes, {}, {}};
    const auto some = [&](bool (FrameSpec::*uses)() const) {
        return std::ranges::any_of(specs, [&](const FrameSpec* spec) { return (spec->*uses)(); });
    };
    if (some(&FrameSpec::usesLobeTable))
        handles.table = graph.import("lobe_table", LobesGpu::tableDesc(), lobes ? &lobes->table() : nullptr);
    if (some(&FrameSpec::usesLobeShapes))
        handles.shapes = graph.import("lobe_shapes", LobesGpu::shapesDesc(), lobes ? &lobes->shapes() : nullptr);
    return handles;
}

std::optional<graph::BufferHandle> importLightPictures(graph::Graph& graph, std::span<const FrameSpec* const> specs,
                                                       const DrawnView* drawn) {
    const auto uses = std::ranges::find_if(specs, [](const FrameSpec* spec) { return spec->usesLightPictures(); });
    if (uses == specs.end()) return {};
    const gpu::Buffer* const texels = drawn ? &drawn->lightPictures->texels(drawn->prepared.lights.pictures) : nullptr;
    return graph.import("light_pictures", graph::BufferDesc{(*uses)->lightPictureBytes}, texels);
}

void bindLightPictures(const graph::PassContext& context, graph::BufferHandle pictures) {
    bindTexels(context, TEXTURE_UNIT_LIGHT_PICTURES, pictures, Format::Rgba32Float);
}

} // namespace tessera::frame
