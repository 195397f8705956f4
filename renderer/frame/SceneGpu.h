#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "renderer/frame/CasterTree.h"
#include "renderer/frame/DrawList.h"
#include "renderer/frame/Features.h"
#include "renderer/frame/Tangents.h"
#include "renderer/frame/VertexStreams.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/PipelineState.h"
#include "renderer/gpu/Sampler.h"
#include "renderer/gpu/Texture.h"
#include "renderer/gpu/VertexArray.h"
#include "scenes/ClosedBodies.h"

namespace tessera::frame {

inline std::size_t trianglesIn(const gpu::DrawIndexedCommand& command) {
    return command.indexCount / 3;
}

/// A scene's geometry, materials and textures on the GPU. What `features` does not hold is not uploaded, nor meshes and
/// textures that nothing drawn uses, and a table of materials only where they do not vary. With
/// TextureFilter::Exact 8-bit colours are uploaded as the code values they are, since drivers decode sRGB formats only
/// approximately, and no levels beyond the first, which the filter does not read. The scene and its
/// closed meshes must outlive the object.
class SceneGpu {
public:
    SceneGpu(const scenes::Scene& scene, scenes::ClosedMeshes& closedMeshes, const FeatureSet& features,
             TextureFilter filter = TextureFilter::Hardware, scenes::SubsurfaceRequest subsurface = {});

    /// Uploads the scene's current materials; their textures and features must be unchanged. Derives tangents anew
    /// where a material follows others than before. Throws as makeVertexStreams() does, and std::runtime_error when
    /// memory runs out; then all is as it was.
    void updateMaterials();

    /// Uploads the scene's current meshes, nodes and materials; which instances there are, their attributes, triangles
    /// and textures must be unchanged. Throws as updateMaterials(); then all is as it was.
    void updateGeometry();

    const DrawList& drawList() const { return draws_.list; }
    /// One for each draw that a view may see. Its baseInstance selects the draw's rows.
    std::vector<gpu::DrawIndexedCommand> commandsOf(const ViewDraws& draws) const;

    /// What commandsOf() and ViewDraws::rows say of a view, on the GPU.
    struct ViewBuffers {
        const gpu::Buffer& rows;
        const gpu::Buffer& commands;
    };
    /// Binds the vertex streams; then each batch of `batches` with its material, textures, winding and cull state.
    /// `state` is the pass's pipeline state, of which culling and winding are the batch's, and with `transmitting` the
    /// blending of materials that transmit.
    void draw(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
              std::optional<gpu::Blend> transmitting = {}) const;
    /// Triangles [first, first + count) of all that batches draw, in their order.
    struct Part {
        std::span<const gpu::DrawIndexedCommand> commands; ///< commandsOf() the view
        std::size_t first = 0;
        std::size_t count = 0;
    };
    /// The same as draw() of a part. Blended surfaces cannot be divided: of each batch one side comes before the other.
    void drawPart(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                  const Part& part) const;
    /// What depth alone is drawn with.
    struct DepthPrograms {
        const gpu::Program& bare;             ///< samples nothing and takes no material
        const gpu::Program* masked = nullptr; ///< of materials with holes; null where there are none, or where
                                              ///< a hole may count as surface, as in bounds of depths
    };
    /// The same as draw() for passes that want depth alone: materials are bound only where they have holes.
    void drawDepth(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                   const DepthPrograms& programs) const;

    std::span<const gpu::Buffer* const> vertices() const { return geometry_.streams; }
    const gpu::Buffer& indices() const { return *geometry_.indices; }
    const gpu::Buffer& materials() const { return *materials_.constants; }
    /// The constants of all materials by their numbers (shaders/lib/material/material_table.glsl); null where frames of
    /// the features do not need them.
    const gpu::Buffer* materialTable() const { return materials_.tabled.get(); }

    /// SubsurfaceConstants of all materials; null where frames of the features do not need them.
    const gpu::Buffer* subsurfaces() const { return materials_.subsurfaces.get(); }

    /// Whether what is drawn hides light (scenes/Shadows.h).
    bool isCaster(const Draw& draw) const;
    /// Changes where materials or geometry change what hides light; no two scenes share one.
    std::uint64_t casterRevision() const { return casterRevision_; }

    /// What hides lights.
    struct Casters {
        CasterSpace space;
        std::unique_ptr<gpu::Buffer> texels;
    };
    /// Sorts the casters anew where materials have changed which there are. Throws as makeCasterTree(), and
    /// std::runtime_error where the driver cannot read so large a buffer.
    void makeCasters();
    /// Those that were made last; null before.
    const Casters* casters() const { return casters_ ? &*casters_ : nullptr; }

    /// Uploads VertexStreams::facetNormalsOS, what shadows ask of the triangles that are rasterised, with the vertices
    /// that they copy. Throws as updateGeometry().
    void makeFacetNormals();
    /// Null before, unless the features have shadows.
    const gpu::Buffer* facetNormals() const { return geometry_.facetNormals.get(); }

private:
    struct BoundTexture {
        const gpu::Texture* texture = nullptr;
        const gpu::Sampler* sampler = nullptr;
    };
    struct Geometry {
        std::vector<std::optional<TangentBasis>> tangentBases; ///< by material, that the streams were made with
        VertexStreams::Ranges ranges;
        std::vector<std::unique_ptr<gpu::Buffer>> vertices;
        std::vector<const gpu::Buffer*> streams; ///< the same
        std::unique_ptr<gpu::Buffer> indices;
        std::unique_ptr<gpu::Buffer> facetNormals; ///< null until makeFacetNormals()
        std::unique_ptr<gpu::VertexArray> array;
    };
    struct Draws {
        std::vector<bool> transparentMaterials; ///< by material, that the list was made with
        DrawList list;
        std::vector<VertexStreams::Range> ranges; ///< parallel to list.draws
    };
    struct Materials {
        std::unique_ptr<gpu::Buffer> constants; ///< of each, 256 bytes or a multiple apart
        std::unique_ptr<gpu::Buffer> tabled;    ///< the first MATERIAL_TEXELS of each, without gaps
        std::unique_ptr<gpu::Buffer> subsurfaces;
        std::vector<bool> closedBodies; ///< scenes::closedBodies()
    };
    /// What of a material decides which of its surfaces hide light: its casting, its alpha mode, cutoff and opacity,
    /// and the row of SubsurfaceConstants that lets it through.
    using CasterMaterial = std::tuple<bool, scenes::AlphaMode, float, float, std::size_t>;
    std::vector<CasterMaterial> casterMaterials() const;
    static Geometry makeGeometry(const scenes::Scene& scene, const FeatureSet& features);
    Draws makeDraws(const VertexStreams::Ranges& ranges) const;
    Materials makeMaterials();
    void uploadTextures();
    void bindVertices(const ViewBuffers& view) const;
    void bindMaterial(int material) const;
    const gpu::Texture* uploadImage(int image, bool srgb);
    const gpu::Sampler* sampler(const scenes::Sampler& sampler);

    /// Whether a slot's texture holds sRGB code values that shaders decode.
    bool shadersDecode(const scenes::Material& material, std::size_t slot) const;

    const scenes::Scene& scene_;
    FeatureSet features_;
    TextureFilter filter_;
    scenes::SubsurfaceRequest subsurface_;
    scenes::ClosedMeshes& closedMeshes_;
    std::vector<bool> materialsInUse_; ///< by material; the table holds those in use, in their order
    Geometry geometry_;
    Draws draws_;
    Materials materials_;
    std::optional<Casters> casters_;
    std::vector<CasterMaterial> treeMaterials_;    ///< by material, that casters_ were made with
    std::vector<CasterMaterial> revisedMaterials_; ///< by material, of casterRevision_
    std::uint64_t casterRevision_ = 0;
    std::map<std::pair<int, bool>, std::unique_ptr<gpu::Texture>>
        textures_; ///< by image and whether it is decoded from sRGB
    std::vector<std::pair<scenes::Sampler, std::unique_ptr<gpu::Sampler>>> samplers_;
    std::unique_ptr<gpu::Texture> white_; ///< what an empty slot samples
    std::vector<BoundTexture> bound_;     ///< material-major, kTextureSlotCount a material
};

} // namespace tessera::frame
