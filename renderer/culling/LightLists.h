#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/culling/CullingMethod.h"
#include "renderer/culling/TileGrid.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/light_lists.h"

namespace tessera::culling {

/// The depths at which a picture's pixels are shaded, rows from the bottom as OpenGL reads them: one value per pixel,
/// or two when a pixel shades several surfaces (transparent ones, samples). Reverse-Z; a pixel whose nearest depth is 0
/// has no surface.
struct DepthPicture {
    std::span<const float> depth; ///< one per pixel; or two: the nearest, and the farthest negated
    bool isRange = false;
};

/// Light lists in CPU memory, as shaders/shared/light_lists.h lays them out.
struct LightLists {
    std::vector<shared::LightTile> tiles;
    std::vector<glm::uvec2> cells;
    std::vector<std::uint32_t> entries;
    std::size_t bytes() const {
        return tiles.size() * sizeof(shared::LightTile) + cells.size() * sizeof(glm::uvec2) +
               entries.size() * sizeof(std::uint32_t);
    }
};

struct BuildInput {
    FrameConstants frame;
    std::span<const shared::CullLight> lights;
    Method method = Method::Cluster;
    DepthPicture opaque;
    const DepthPicture* transparent = nullptr; ///< null: the lists have no transparent layer
};

/// Builds light lists on all cores. Keeps its scratch memory from frame to frame, and nothing else.
class LightListBuilder {
public:
    LightListBuilder();
    ~LightListBuilder();

    /// Valid until the next build. `method` must not be none.
    const LightLists& build(const BuildInput& input);

private:
    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

} // namespace tessera::culling
