#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// One mesh at one node with one material.
struct Draw {
    int mesh = 0;
    int material = 0;
    int node = 0;
    int instance = 0;        ///< place among the mesh instances of all nodes, in document order
    bool mirrored = false;   ///< the node's transform turns the winding round
    bool castsShadow = true; ///< MeshInstance::castsShadow; the material must cast some too
    int spreadingNumber = 0; ///< 1 + its cell in the atlas of light that has spread (Diffusion.h); 0: it has none
    float largestColor = 0;  ///< of the mesh's vertex colours, any channel, 1 or more; 0 without vertex colours
    scenes::Box3 boxWS{};    ///< around the mesh's own box; empty without vertices
    double reachMetres = 0; ///< the largest sum of magnitudes that fp32 adds a vertex up from, without the node's place
    glm::dvec3 centerWS{0}; ///< of the mesh's box, for the order of transparent draws
};

/// Draws [first, first + count) of a view that share material and winding.
struct Batch {
    int first = 0;
    int count = 0;
    int material = 0;
    bool mirrored = false;
};

/// Draws [first, first + count) of a view of which passes want the depth alone.
struct DepthBatch {
    int first = 0;
    int count = 0;
    bool mirrored = false;
    bool doubleSided = false;
    std::optional<int> maskedBy; ///< the alpha-masked material to sample; none: opaque
};
/// Merges neighbouring batches that differ only in an unmasked material. The order stays.
std::vector<DepthBatch> depthBatches(const scenes::Scene& scene, std::span<const Batch> batches);

/// Everything the scene draws. Opaque and masked draws come first, gathered by material so that binds are few; the
/// transparent ones follow in document order. Every technique draws in this order.
struct DrawList {
    std::vector<Draw> draws;
    std::vector<glm::dmat4> worldFromObject; ///< by node
    int firstTransparent = 0;
};
DrawList makeDrawList(const scenes::Scene& scene);

/// By how much a draw's vertices may lie outside its box by rounding. To fp32: some 2^-24 of all that they are added up
/// from, within their object, from there to the origin of lighting space, and where they end; this is far more. The box
/// is in the coordinates of the world in double precision, of which four roundings are 2^-51.
double roundingMetres(const Draw& draw, const glm::dvec3& objectWS, const CameraView& view);

/// Per-draw vertex attributes (shaders/passes/geometry.vert): rows of RWS-from-object (world axes at the origin of
/// lighting space, as shaders/shared/frame.h says) and of the cofactor matrix of LS-from-object, which carries normals
/// through any transform, singular ones too; times the determinant's sign. Row 0's w is that sign, times 1 +
/// Draw::spreadingNumber. Row 1's w is Draw::largestColor. It also tells meshes without vertex colours: white would not
/// do, since interpolating 1 in perspective does not always give 1. Row 2's w is 1 + Draw::instance.
struct DrawRows {
    glm::vec4 position[3];
    glm::vec4 normal[3];
};

/// Pixels [low, high) of a picture, lower-left origin.
struct PixelArea {
    glm::ivec2 low{0};
    glm::ivec2 high{0};
    bool empty() const { return low.x >= high.x || low.y >= high.y; }
    bool operator==(const PixelArea&) const = default;
};

/// What a view draws of a list. Rows and batches speak of the list's draws that may be seen, in its order.
struct ViewDraws {
    std::vector<int> seen;      ///< index into DrawList::draws
    std::vector<DrawRows> rows; ///< parallel to seen
    std::vector<Batch> opaque;
    std::vector<Batch>
        transparent;        ///< one per draw, far to near by the view depth of their boxes' centres, ties by index
    PixelArea opaquePixels; ///< no pixel outside shows an opaque surface; by the draws' boxes
};
/// With `culls` draws whose boxes lie outside the view are left out.
/// With `isWanted` only those of which it is true are drawn.
ViewDraws makeViewDraws(const DrawList& list, const CameraView& view, bool culls,
                        const std::function<bool(const Draw&)>& isWanted = {});

} // namespace tessera::frame
