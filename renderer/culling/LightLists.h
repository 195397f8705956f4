#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "renderer/culling/CullingMethod.h"
#include "renderer/culling/SurfacePictures.h"
#include "renderer/culling/TileGrid.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/light_lists.h"

namespace tessera::culling {

/// Light lists in CPU memory, in the layout of shaders/shared/light_lists.h.
struct LightLists {
    std::vector<shared::LightTile> tiles;
    std::vector<glm::uvec2> cells;
    std::vector<std::uint32_t> entries;
    std::size_t bytes() const {
        return tiles.size() * sizeof(shared::LightTile) + cells.size() * sizeof(glm::uvec2) +
               entries.size() * sizeof(std::uint32_t);
    }
};

/// Downloads the normals of opaque surfaces (one depth per pixel). Called at most once per build.
using ReadNormals = std::function<NormalPicture()>;

struct BuildInput {
    FrameConstants frame;
    std::span<const shared::CullLight> lights;
    Method method = Method::Cluster;
    DepthPicture opaque;
    const DepthPicture* transparent = nullptr; ///< null: the lists have no transparent layer
    /// Off, or method zbin: normals are not read.
    NormalTest normalTest = NormalTest::Off;
    ReadNormals readNormals;
};

/// Builds light lists on all CPU cores. Keeps only scratch memory between builds.
class LightListBuilder {
public:
    LightListBuilder();
    ~LightListBuilder();

    /// Builds the lists, which stay valid until the next build. `method` must not be none.
    const LightLists& build(const BuildInput& input);

private:
    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

} // namespace tessera::culling
