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
    bool mirrored = false;   ///< the node's transform flips the winding
    bool castsShadow = true; ///< MeshInstance::castsShadow; the material must cast shadows too
    int diffusionNumber = 0; ///< 1 + its cell in DiffusionAtlas (Diffusion.h); 0: none
    float largestColor = 0;  ///< largest vertex colour channel of the mesh, at least 1; 0 without vertex colours
    scenes::Box3 boxWS{};    ///< bounds of the mesh's transformed box; empty without vertices
    double reachMetres = 0;  ///< largest sum of term magnitudes in a vertex's fp32 transform, without the translation
    glm::dvec3 centerWS{0};  ///< of the mesh's box, for sorting transparent draws
};

/// Draws [first, first + count) of a view that share material and winding.
struct Batch {
    int first = 0;
    int count = 0;
    int material = 0;
    bool mirrored = false;
};

/// Draws [first, first + count) of a view for depth-only passes.
struct DepthBatch {
    int first = 0;
    int count = 0;
    bool mirrored = false;
    bool doubleSided = false;
    std::optional<int> maskedBy; ///< the alpha-masked material to sample; none: opaque
};
/// Merges neighbouring batches that differ only in unmasked materials; keeps the order.
std::vector<DepthBatch> depthBatches(const scenes::Scene& scene, std::span<const Batch> batches);

/// Everything the scene draws. Opaque and masked draws come first, gathered by material so that binds are few; the
/// transparent ones follow in document order. Every technique draws in this order.
struct DrawList {
    std::vector<Draw> draws;
    std::vector<glm::dmat4> worldFromObject; ///< by node
    int firstTransparent = 0;
};
DrawList makeDrawList(const scenes::Scene& scene);

/// Largest distance in metres by which rounding moves a draw's vertices out of its box. fp32 errors are about 2^-24 of
/// the vertex in its object, of the offset from the origin of lighting space, and of their sum; 1e-5 is far more. The
/// box is in double-precision world coordinates, where four roundings are 2^-51.
double roundingMetres(const Draw& draw, const glm::dvec3& objectWS, const CameraView& view);

/// Per-draw vertex attributes (shaders/passes/geometry.vert): rows of RWS-from-object (world axes at the origin of
/// lighting space, shaders/shared/frame.h) and of the cofactor matrix of LS-from-object times the sign of its
/// determinant, which transforms normals by any matrix, singular ones too. Normal row 0's w is that sign times 1 +
/// Draw::diffusionNumber. Row 1's w is Draw::largestColor; its 0 flags meshes without vertex colours, since white
/// interpolated in perspective is not always exactly 1. Row 2's w is 1 + Draw::instance.
struct DrawRows {
    glm::vec4 position[3];
    glm::vec4 normal[3];
};

/// Pixels [low, high) of an image, lower-left origin.
struct PixelArea {
    glm::ivec2 low{0};
    glm::ivec2 high{0};
    bool empty() const { return low.x >= high.x || low.y >= high.y; }
    bool operator==(const PixelArea&) const = default;
};

/// The visible draws of a view. Rows and batches index `seen`, which keeps the list's order.
struct ViewDraws {
    std::vector<int> seen;      ///< index into DrawList::draws
    std::vector<DrawRows> rows; ///< parallel to seen
    std::vector<Batch> opaque;
    std::vector<Batch>
        transparent;        ///< one per draw, far to near by the view depth of their boxes' centres, ties by index
    PixelArea opaquePixels; ///< bounds of the pixels with opaque surfaces, from the draws' boxes
};
/// `culls` omits draws whose boxes lie outside the view. `isWanted` filters draws; empty: all.
ViewDraws makeViewDraws(const DrawList& list, const CameraView& view, bool culls,
                        const std::function<bool(const Draw&)>& isWanted = {});

} // namespace tessera::frame
