#include "passes/GpuLightListsPass.h"

#include <algorithm>

#include <fmt/format.h>

#include "passes/ListStep.h"
#include "passes/ScanTiles.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Context.h"
#include "scenes/Error.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

using graph::Access;
using Lanes = ListStep::Lanes;

/// The steps of a frame's method; zbin has masks instead of runs.
struct Steps {
    ListStep reach, depths, count, scan, sizes, fill, binMasks, tileMasks;

    explicit Steps(const frame::FrameSpec& spec)
        : reach(spec, "reach", Lanes::One), depths(spec, "depths", Lanes::AsChosen),
          count(spec, "count", Lanes::AsChosen), scan(spec, "scan", Lanes::Group),
          sizes(spec, "sizes", Lanes::AsChosen), fill(spec, "fill", Lanes::AsChosen),
          binMasks(spec, "bin_masks", Lanes::AsChosen), tileMasks(spec, "tile_masks", Lanes::AsChosen) {}
};

/// What the passes hand on to one another.
struct Handles {
    GpuLightListsPass::Inputs read;
    frame::LightListHandles lists;
    graph::BufferHandle tileDepths; ///< vec2 a tile
    graph::BufferHandle tileCounts; ///< uvec2 a tile
    graph::BufferHandle totals;     ///< uvec4
};

struct Builder {
    graph::Graph& graph;
    const frame::FrameSpec& spec;
    const frame::FrameResources* resources;
    Steps steps;
    Handles handles;

    bool isZbin() const { return spec.culling.method == culling::Method::Zbin; }
    graph::BufferDesc twoWordsATile() const { return {frame::lightTileCount(spec) * sizeof(glm::uvec2)}; }

    void findReach();
    void findDepths();
    void count();
    void scan();
    void fill();
};

/// Tiles as a grid of items, the layers below one another.
glm::uvec2 tileItems(const frame::FrameSpec& spec, const frame::FrameResources& resources) {
    const auto columns = resources.constants.tileGrid.x;
    return {columns, std::uint32_t(frame::lightTileCount(spec)) / columns};
}

void bindLights(const frame::LightListBuffers& lists) {
    gpu::bindTexelBuffer(TEXTURE_UNIT_CULL_LIGHTS, lists.cullLights.texels());
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_REACH, lists.reach.texels());
}

void Builder::findReach() {
    const graph::BufferHandle reach =
        frame::importLightReach(graph, spec.lights, resources ? &resources->lightLists : nullptr);
    handles = graph.addPass<Handles>(
        "light_reach",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            out.lists.reach = pass.write(reach, Access::StorageWrite);
        },
        [step = steps.reach, used = resources](const Handles& out, const graph::PassContext& context) {
            frame::LightListBuffers& lists = used->lightLists;
            const std::size_t texelsALight = sizeof(shared::CullLight) / sizeof(glm::vec4);
            lists.cullLights.require(used->cullLights.size() * texelsALight);
            lists.cullLights.buffer().upload(used->cullLights);
            lists.reach.require(used->cullLights.size());
            gpu::bindTexelBuffer(TEXTURE_UNIT_CULL_LIGHTS, lists.cullLights.texels());
            gpu::bindStorageBuffer(STORAGE_LIGHT_REACH, context.buffer(*out.lists.reach));
            const std::uint32_t rows = (used->constants.lights.x + ListStep::kLightsARow - 1) / ListStep::kLightsARow;
            step.run(*used, {ListStep::kLightsARow, std::max(rows, 1u)}); // no lights: a row that finds none
        });
}

void Builder::findDepths() {
    handles = graph.addPass<Handles>(
        "light_depths",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            out.read.depths = frame::readLitDepths(pass, spec, handles.read.depths);
            out.lists.tiles = pass.write(handles.lists.tiles, Access::StorageWrite);
            out.tileDepths = pass.create("tile_depths", twoWordsATile());
        },
        [step = steps.depths, used = resources, frame = spec](const Handles& out, const graph::PassContext& context) {
            used->lightLists.requireTiles(frame::lightTileCount(frame));
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.read.depths.opaque));
            if (out.read.depths.transparent)
                gpu::bindTexture(TEXTURE_UNIT_TRANSPARENT_DEPTH, context.texture(*out.read.depths.transparent));
            gpu::bindStorageBuffer(STORAGE_LIGHT_TILES, context.buffer(out.lists.tiles));
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            step.run(*used, tileItems(frame, *used));
        });
}

void Builder::count() {
    handles = graph.addPass<Handles>(
        "light_count",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            out.lists.reach = pass.read(*handles.lists.reach, Access::TexelRead);
            out.lists.tiles = pass.read(handles.lists.tiles);
            out.tileDepths = pass.read(handles.tileDepths);
            out.tileCounts = pass.create("tile_counts", twoWordsATile());
        },
        [step = steps.count, used = resources, frame = spec](const Handles& out, const graph::PassContext& context) {
            bindLights(used->lightLists);
            gpu::bindStorageBuffer(STORAGE_LIGHT_TILES, context.buffer(out.lists.tiles));
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            gpu::bindStorageBuffer(STORAGE_TILE_COUNTS, context.buffer(out.tileCounts));
            step.runRounds(frame, *used, tileItems(frame, *used));
        });
}

void Builder::scan() {
    const bool onCpu = spec.culling.builder == culling::Builder::Fragment;
    handles = graph.addPass<Handles>(
        "light_scan",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            const Access read = onCpu ? Access::Download : Access::StorageRead;
            const Access write = onCpu ? Access::Upload : Access::StorageWrite;
            if (isZbin()) {
                out.tileDepths = pass.read(handles.tileDepths, read);
            } else {
                if (onCpu) pass.read(handles.tileCounts, read);
                out.tileCounts = pass.write(handles.tileCounts, write);
            }
            out.totals = pass.create("light_totals", graph::BufferDesc{sizeof(glm::uvec4)}, write);
        },
        [step = steps.scan, used = resources, zbin = isZbin(), onCpu,
         tiles = frame::lightTileCount(spec)](const Handles& out, const graph::PassContext& context) {
            const gpu::Buffer& of = context.buffer(zbin ? out.tileDepths : out.tileCounts);
            const gpu::Buffer& totals = context.buffer(out.totals);
            if (onCpu) {
                totals.uploadValue(zbin ? scanDepths(of, tiles, used->constants)
                                        : scanCounts(of, tiles, used->constants));
                return;
            }
            gpu::bindStorageBuffer(zbin ? STORAGE_TILE_DEPTHS : STORAGE_TILE_COUNTS, of);
            gpu::bindStorageBuffer(STORAGE_LIST_TOTALS, totals);
            step.run(*used, {1, 1});
        });
}

/// What a buffer must hold for shaders to write it.
void requireWritable(const char* what, std::size_t bytes) {
    const std::size_t most = gpu::Context::current()->capabilities().maxStorageBlockBytes;
    if (bytes <= most) return;
    throw InputError(
        fmt::format("light {} would take {} bytes, and shaders of this driver write {} at most: build them "
                    "on the CPU (--cull-on cpu), or use larger tiles (--tile 64) or fewer lights (--lights N)",
                    what, bytes, most));
}

struct Totals {
    std::size_t cells, entries;
};

Totals totalsOf(const frame::FrameSpec& spec, const glm::uvec4& scanned, const glm::uvec4& lights,
                const glm::uvec4& grid) {
    if (spec.culling.method != culling::Method::Zbin)
        return {scanned.x, std::size_t(scanned.z) << 32 | std::size_t(scanned.y)};
    const std::size_t bins = scanned.y;
    return {bins, (bins + std::size_t(grid.x) * grid.y) * lights.w};
}

/// The empty cell, and in front of the entries the lights that reach everywhere.
void uploadFirsts(const frame::FrameResources& resources) {
    std::vector<std::uint32_t> everywhere;
    for (std::size_t i = 0; i < resources.cullLights.size(); ++i)
        if (resources.cullLights[i].sphere.w < 0.0f) everywhere.push_back(std::uint32_t(i));
    resources.lightLists.cells.buffer().uploadValue(glm::uvec2(0u));
    resources.lightLists.entries.buffer().upload(everywhere);
}

void Builder::fill() {
    handles = graph.addPass<Handles>(
        "light_lists",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            out.lists.reach = pass.read(*handles.lists.reach, Access::TexelRead);
            out.totals = pass.read(handles.totals, Access::Download);
            if (isZbin()) {
                pass.read(handles.totals);
            } else {
                out.tileDepths = pass.read(handles.tileDepths);
                out.tileCounts = pass.read(handles.tileCounts);
            }
            out.lists.tiles = pass.write(handles.lists.tiles, Access::StorageWrite);
            out.lists.cells = pass.write(handles.lists.cells, Access::StorageWrite);
            out.lists.entries = pass.write(handles.lists.entries, Access::StorageWrite);
        },
        [all = steps, used = resources, frame = spec](const Handles& out, const graph::PassContext& context) {
            frame::LightListBuffers& lists = used->lightLists;
            const glm::uvec4 scanned = context.buffer(out.totals).downloadAs<glm::uvec4>(1).front();
            const Totals totals = totalsOf(frame, scanned, used->constants.lights, used->constants.tileGrid);
            requireWritable("cells", totals.cells * sizeof(glm::uvec2));
            requireWritable("entries", totals.entries * sizeof(std::uint32_t));
            lists.requireLists(totals.cells, totals.entries);
            bindLights(lists);
            gpu::bindStorageBuffer(STORAGE_LIGHT_TILES, context.buffer(out.lists.tiles));
            gpu::bindStorageBuffer(STORAGE_LIGHT_CELLS, context.buffer(out.lists.cells), 0,
                                   std::max<std::size_t>(totals.cells, 1) * sizeof(glm::uvec2));
            gpu::bindStorageBuffer(STORAGE_LIGHT_ENTRIES, context.buffer(out.lists.entries), 0,
                                   std::max<std::size_t>(totals.entries, 1) * sizeof(std::uint32_t));
            if (frame.culling.method == culling::Method::Zbin) {
                gpu::bindStorageBuffer(STORAGE_LIST_TOTALS, context.buffer(out.totals));
                all.binMasks.run(*used, {std::uint32_t(totals.cells), 1});
                all.tileMasks.run(*used, glm::uvec2(used->constants.tileGrid));
                return;
            }
            uploadFirsts(*used);
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            gpu::bindStorageBuffer(STORAGE_TILE_COUNTS, context.buffer(out.tileCounts));
            if (ListStep::inRounds(frame)) {
                all.sizes.runRounds(frame, *used, tileItems(frame, *used));
                gpu::memoryBarrier(graph::Barrier::ShaderStorage);
            }
            all.fill.runRounds(frame, *used, tileItems(frame, *used));
        });
}

} // namespace

std::vector<shader::ProgramDesc> GpuLightListsPass::programs(const frame::FrameSpec& spec) {
    const Steps steps(spec);
    std::vector<shader::ProgramDesc> programs{steps.reach.program(), steps.depths.program()};
    if (spec.culling.builder == culling::Builder::Compute) programs.push_back(steps.scan.program());
    if (spec.culling.method == culling::Method::Zbin) {
        programs.push_back(steps.binMasks.program());
        programs.push_back(steps.tileMasks.program());
        return programs;
    }
    programs.push_back(steps.count.program());
    if (ListStep::inRounds(spec)) programs.push_back(steps.sizes.program());
    programs.push_back(steps.fill.program());
    return programs;
}

GpuLightListsPass::Outputs GpuLightListsPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                  const Inputs& inputs, const frame::FrameResources* resources) {
    Builder builder{graph, spec, resources, Steps(spec), {}};
    builder.handles.read = inputs;
    builder.handles.lists =
        frame::importLightLists(graph, frame::lightTileCount(spec), resources ? &resources->lightLists : nullptr);
    builder.findReach();
    builder.findDepths();
    if (spec.culling.method != culling::Method::Zbin) builder.count();
    builder.scan();
    builder.fill();
    return {builder.handles.lists};
}

} // namespace tessera::passes
