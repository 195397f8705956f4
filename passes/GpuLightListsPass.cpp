#include "passes/GpuLightListsPass.h"

#include <algorithm>

#include "passes/ListRoom.h"
#include "passes/ListStep.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

using graph::Access;
using Lanes = ListStep::Lanes;

/// The compute steps of a culling method; zbin builds masks instead of lists.
struct Steps {
    ListStep reach, depths, count, scan, sizes, fill, binMasks, tileMasks;

    explicit Steps(const frame::FrameSpec& spec)
        : reach(spec, "reach", Lanes::One), depths(spec, "depths", Lanes::AsChosen),
          count(spec, "count", Lanes::AsChosen), scan(spec, "scan", Lanes::Group),
          sizes(spec, "sizes", Lanes::AsChosen), fill(spec, "fill", Lanes::AsChosen),
          binMasks(spec, "bin_masks", Lanes::AsChosen), tileMasks(spec, "tile_masks", Lanes::AsChosen) {}
};

/// The resources passed from step to step.
struct Handles {
    GpuLightListsPass::Inputs read;
    frame::LightListHandles lists;
    graph::BufferHandle cullLights; ///< shared::CullLight each
    graph::BufferHandle reach;      ///< uvec2 per light: the tile columns and rows that it may touch
    graph::BufferHandle tileDepths; ///< vec2 per tile
    graph::BufferHandle tileCounts; ///< uvec2 per tile
    graph::BufferHandle totals;     ///< uvec4

    /// Declares the constants of view and lights, which every step reads.
    void readConstants(graph::PassBuilder& pass) const {
        read.view.read(pass);
        pass.read(read.lighting, Access::UniformRead);
    }
    void readLights(graph::PassBuilder& pass) const {
        pass.read(cullLights, Access::TexelRead);
        pass.read(reach, Access::TexelRead);
    }
    void bindConstants(const graph::PassContext& context) const {
        read.view.bind(context);
        gpu::bindUniformBuffer(UNIFORM_LIGHTING, context.buffer(read.lighting), 0, sizeof(shared::LightingConstants));
    }
    void bindLights(const graph::PassContext& context) const {
        gpu::bindTexelBuffer(TEXTURE_UNIT_CULL_LIGHTS, context.buffer(cullLights).texels(graph::Format::Rgba32Float));
        gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_REACH, context.buffer(reach).texels(graph::Format::Rg32Uint));
    }
    /// Binds tiles, and the parts of cells and entries that are in use.
    void bindLists(const graph::PassContext& context) const {
        const auto bind = [&](std::uint32_t slot, graph::BufferHandle handle, std::size_t least) {
            gpu::bindStorageBuffer(slot, context.buffer(handle), 0, std::max(context.bytes(handle), least));
        };
        gpu::bindStorageBuffer(STORAGE_LIGHT_TILES, context.buffer(lists.tiles));
        bind(STORAGE_LIGHT_CELLS, lists.cells, sizeof(glm::uvec2));
        bind(STORAGE_LIGHT_ENTRIES, lists.entries, sizeof(std::uint32_t));
    }
};

struct Builder {
    graph::Graph& graph;
    const frame::FrameSpec& spec;
    const frame::DrawnView* drawn;
    Steps steps;
    Handles handles;

    bool isZbin() const { return spec.culling.method == culling::Method::Zbin; }
    std::size_t tiles() const { return frame::lightTileCount(spec); }
    graph::BufferDesc twoWordsATile() const { return {tiles() * sizeof(glm::uvec2)}; }
    /// The tiles as a grid of items, with layers stacked vertically.
    glm::uvec2 tileItems() const {
        const int side = spec.culling.tilePixels;
        const auto columns = std::uint32_t((spec.settings.sizePixels.x + side - 1) / side);
        return {columns, std::uint32_t(tiles()) / columns};
    }

    void findReach();
    void findDepths();
    void count(const glm::uvec4& round);
    void scan();
    void makeListRoom();
    void size(const glm::uvec4& round);
    void fill(const glm::uvec4& round);
    void fillMasks();
};

void Builder::findReach() {
    const std::size_t lights = std::max<std::size_t>(spec.lights, 1);
    handles = graph.addPass<Handles>(
        "light_reach",
        [&](graph::PassBuilder& pass, Handles& out) {
            pass.program(steps.reach.program());
            out = handles;
            out.readConstants(pass);
            out.cullLights = pass.create("cull_lights", {lights * sizeof(shared::CullLight), true}, Access::Upload);
            pass.read(out.cullLights, Access::TexelRead);
            out.reach = pass.create("light_reach", {lights * sizeof(glm::uvec2), true});
        },
        [step = steps.reach, used = drawn, lights](const Handles& out, const graph::PassContext& context) {
            context.buffer(out.cullLights).upload(used->prepared.cullLights);
            out.bindConstants(context);
            gpu::bindTexelBuffer(TEXTURE_UNIT_CULL_LIGHTS,
                                 context.buffer(out.cullLights).texels(graph::Format::Rgba32Float));
            gpu::bindStorageBuffer(STORAGE_LIGHT_REACH, context.buffer(out.reach));
            // Without lights, one row runs and finds none.
            step.run(context, {ListStep::kLightsARow,
                               std::uint32_t((lights + ListStep::kLightsARow - 1) / ListStep::kLightsARow)});
        });
}

void Builder::findDepths() {
    handles = graph.addPass<Handles>(
        "light_depths",
        [&](graph::PassBuilder& pass, Handles& out) {
            pass.program(steps.depths.program());
            out = handles;
            out.readConstants(pass);
            out.read.depths = handles.read.depths.read(pass, spec);
            out.lists.tiles = pass.create("light_tiles", graph::BufferDesc{tiles() * sizeof(shared::LightTile)});
            out.tileDepths = pass.create("tile_depths", twoWordsATile());
        },
        [step = steps.depths, items = tileItems()](const Handles& out, const graph::PassContext& context) {
            requireWritable("light tiles", context.bytes(out.lists.tiles));
            requireReadable("light tiles",
                            LIGHT_TILE_TEXELS * context.bytes(out.lists.tiles) / sizeof(shared::LightTile));
            out.bindConstants(context);
            out.read.depths.bind(context);
            gpu::bindStorageBuffer(STORAGE_LIGHT_TILES, context.buffer(out.lists.tiles));
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            step.run(context, items);
        });
}

void Builder::count(const glm::uvec4& round) {
    handles = graph.addPass<Handles>(
        "light_count",
        [&](graph::PassBuilder& pass, Handles& out) {
            pass.program(steps.count.program());
            out = handles;
            out.readConstants(pass);
            out.readLights(pass);
            out.lists.tiles = pass.read(handles.lists.tiles);
            out.tileDepths = pass.read(handles.tileDepths);
            out.tileCounts = handles.tileCounts ? pass.write(handles.tileCounts, Access::StorageWrite)
                                                : pass.create("tile_counts", twoWordsATile());
        },
        [step = steps.count, items = tileItems(), round](const Handles& out, const graph::PassContext& context) {
            out.bindConstants(context);
            out.bindLights(context);
            gpu::bindStorageBuffer(STORAGE_LIGHT_TILES, context.buffer(out.lists.tiles));
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            gpu::bindStorageBuffer(STORAGE_TILE_COUNTS, context.buffer(out.tileCounts));
            context.constants(UNIFORM_PASS, round);
            step.run(context, items);
        });
}

void Builder::scan() {
    handles = graph.addPass<Handles>(
        "light_scan",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            out.readConstants(pass);
            pass.program(steps.scan.program());
            if (isZbin())
                out.tileDepths = pass.read(handles.tileDepths);
            else
                out.tileCounts = pass.write(handles.tileCounts, Access::StorageWrite);
            out.totals = pass.create("light_totals", graph::BufferDesc{sizeof(glm::uvec4)});
        },
        [step = steps.scan, zbin = isZbin()](const Handles& out, const graph::PassContext& context) {
            out.bindConstants(context);
            gpu::bindStorageBuffer(zbin ? STORAGE_TILE_DEPTHS : STORAGE_TILE_COUNTS,
                                   context.buffer(zbin ? out.tileDepths : out.tileCounts));
            gpu::bindStorageBuffer(STORAGE_LIST_TOTALS, context.buffer(out.totals));
            step.run(context, {1, 1});
        });
}

struct Totals {
    std::size_t cells, entries;
};

Totals totalsOf(const frame::FrameSpec& spec, const glm::uvec4& scanned, const shared::LightingConstants& lighting) {
    if (spec.culling.method != culling::Method::Zbin)
        return {scanned.x, std::size_t(scanned.z) << 32 | std::size_t(scanned.y)};
    const std::size_t bins = scanned.y;
    return {bins, (bins + std::size_t(lighting.tileGrid.x) * lighting.tileGrid.y) * lighting.lights.w};
}

/// The unbounded lights, which precede the entries of cells.
std::vector<std::uint32_t> lightsEverywhere(const frame::PreparedView& view) {
    std::vector<std::uint32_t> everywhere;
    for (std::size_t i = 0; i < view.cullLights.size(); ++i)
        if (view.cullLights[i].sphere.w < 0.0f) everywhere.push_back(std::uint32_t(i));
    return everywhere;
}

/// Allocates the lists once their size is known.
void Builder::makeListRoom() {
    handles = graph.addPass<Handles>(
        "light_room",
        [&](graph::PassBuilder& pass, Handles& out) {
            out = handles;
            out.totals = pass.read(handles.totals, Access::Download);
            out.lists.cells = pass.create(frame::kLightCellsName, kGrowing, Access::Upload);
            out.lists.entries = pass.create(frame::kLightEntriesName, kGrowing, Access::Upload);
        },
        [used = drawn, frame = spec, zbin = isZbin()](const Handles& out, const graph::PassContext& context) {
            const frame::PreparedView& view = used->prepared;
            const glm::uvec4 scanned = context.buffer(out.totals).downloadAs<glm::uvec4>(1).front();
            const Totals totals = totalsOf(frame, scanned, view.lighting);
            requireWritable("light entries", totals.entries * sizeof(std::uint32_t));
            const gpu::Buffer& cells =
                makeBlockRoom(context, out.lists.cells, "light cells", totals.cells * sizeof(glm::uvec2));
            const gpu::Buffer& entries =
                makeTexelRoom(context, out.lists.entries, "light entries", totals.entries, graph::Format::R32Uint);
            if (zbin) return;
            cells.uploadValue(glm::uvec2(0u)); // the empty cell
            entries.upload(lightsEverywhere(view));
        });
}

void Builder::size(const glm::uvec4& round) {
    handles = graph.addPass<Handles>(
        "light_sizes",
        [&](graph::PassBuilder& pass, Handles& out) {
            pass.program(steps.sizes.program());
            out = handles;
            out.readConstants(pass);
            out.readLights(pass);
            out.tileDepths = pass.read(handles.tileDepths);
            out.tileCounts = pass.read(handles.tileCounts);
            out.lists.tiles = pass.read(handles.lists.tiles);
            out.lists.entries = pass.read(handles.lists.entries);
            out.lists.cells = pass.write(handles.lists.cells, Access::StorageWrite);
        },
        [step = steps.sizes, items = tileItems(), round](const Handles& out, const graph::PassContext& context) {
            out.bindConstants(context);
            out.bindLights(context);
            out.bindLists(context);
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            gpu::bindStorageBuffer(STORAGE_TILE_COUNTS, context.buffer(out.tileCounts));
            context.constants(UNIFORM_PASS, round);
            step.run(context, items);
        });
}

void Builder::fill(const glm::uvec4& round) {
    handles = graph.addPass<Handles>(
        "light_lists",
        [&](graph::PassBuilder& pass, Handles& out) {
            pass.program(steps.fill.program());
            out = handles;
            out.readConstants(pass);
            out.readLights(pass);
            out.tileDepths = pass.read(handles.tileDepths);
            out.tileCounts = pass.read(handles.tileCounts);
            out.lists.tiles = pass.write(handles.lists.tiles, Access::StorageWrite);
            out.lists.cells = pass.write(handles.lists.cells, Access::StorageWrite);
            out.lists.entries = pass.write(handles.lists.entries, Access::StorageWrite);
        },
        [step = steps.fill, items = tileItems(), round](const Handles& out, const graph::PassContext& context) {
            out.bindConstants(context);
            out.bindLights(context);
            out.bindLists(context);
            gpu::bindStorageBuffer(STORAGE_TILE_DEPTHS, context.buffer(out.tileDepths));
            gpu::bindStorageBuffer(STORAGE_TILE_COUNTS, context.buffer(out.tileCounts));
            context.constants(UNIFORM_PASS, round);
            step.run(context, items);
        });
}

void Builder::fillMasks() {
    handles = graph.addPass<Handles>(
        "light_lists",
        [&](graph::PassBuilder& pass, Handles& out) {
            pass.program(steps.binMasks.program());
            pass.program(steps.tileMasks.program());
            out = handles;
            out.readConstants(pass);
            out.readLights(pass);
            out.totals = pass.read(handles.totals);
            out.lists.tiles = pass.write(handles.lists.tiles, Access::StorageWrite);
            out.lists.cells = pass.write(handles.lists.cells, Access::StorageWrite);
            out.lists.entries = pass.write(handles.lists.entries, Access::StorageWrite);
        },
        // The layers share the masks of a tile.
        [bins = steps.binMasks, ofTiles = steps.tileMasks, used = drawn](const Handles& out,
                                                                         const graph::PassContext& context) {
            out.bindConstants(context);
            out.bindLights(context);
            out.bindLists(context);
            gpu::bindStorageBuffer(STORAGE_LIST_TOTALS, context.buffer(out.totals));
            bins.run(context, {std::uint32_t(context.bytes(out.lists.cells) / sizeof(glm::uvec2)), 1}, 0);
            ofTiles.run(context, glm::uvec2(used->prepared.lighting.tileGrid), 1);
        });
}

} // namespace

GpuLightListsPass::Outputs GpuLightListsPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                  const Inputs& inputs, const frame::DrawnView* drawn) {
    Builder builder{graph, spec, drawn, Steps(spec), {}};
    builder.handles.read = inputs;
    builder.findReach();
    builder.findDepths();
    const std::vector<glm::uvec4> rounds = ListStep::rounds(spec);
    if (!builder.isZbin())
        for (const glm::uvec4& round : rounds) builder.count(round);
    builder.scan();
    builder.makeListRoom();
    if (builder.isZbin()) {
        builder.fillMasks();
        return {builder.handles.lists};
    }
    if (rounds.size() > 1)
        for (const glm::uvec4& round : rounds) builder.size(round);
    for (const glm::uvec4& round : rounds) builder.fill(round);
    return {builder.handles.lists};
}

} // namespace tessera::passes
