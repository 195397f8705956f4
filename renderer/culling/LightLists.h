#pragma once
#include <cstdint>
#include <functional>
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

/// How stored normals are written in words.
enum class NormalForm : std::uint8_t {
    Code,       ///< lib/maths/normal_code.glsl, from bit 0
    Octahedral, ///< two coordinates
    Vector      ///< x, y, z in fp32
};

/// The normals with which a picture's pixels are lit, rows from the bottom.
struct NormalPicture {
    std::span<const std::uint32_t> words;
    std::size_t wordsAPixel = 2;
    NormalForm form = NormalForm::Code;
    unsigned bit = 0, width = 0;         ///< octahedral: of the first coordinate, and of both
    glm::mat3 cullingFromLighting{1.0f}; ///< rotation
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

/// Downloads the normals of opaque surfaces, which have one depth a pixel; called at most once a build.
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
