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

/// A scene's geometry, materials and textures on the GPU. Uploads only attributes that `features` include, only meshes
/// and textures in use, and the material table only if materials do not vary. With TextureFilter::Exact, textures have
/// no mip levels, which the filter does not read, and 8-bit colours are uploaded as code values, since drivers decode
/// sRGB formats only approximately. The scene and its closed meshes must outlive the object.
class SceneGpu {
public:
    SceneGpu(const scenes::Scene& scene, scenes::ClosedMeshes& closedMeshes, const FeatureSet& features,
             TextureFilter filter = TextureFilter::Hardware, scenes::SubsurfaceRequest subsurface = {});

    /// Uploads the scene's current materials; their textures and features must be unchanged. Recomputes tangents if a
    /// material's TangentBasis changed. Throws as makeVertexStreams(), and std::runtime_error when memory runs out;
    /// nothing changes then.
    void updateMaterials();

    /// Uploads the scene's current meshes, nodes and materials; the set of instances, their attributes, triangles and
    /// textures must be unchanged. Throws as updateMaterials(); nothing changes then.
    void updateGeometry();

    const DrawList& drawList() const { return draws_.list; }
    /// One command per visible draw of a view; its baseInstance selects the draw's rows.
    std::vector<gpu::DrawIndexedCommand> commandsOf(const ViewDraws& draws) const;

    /// ViewDraws::rows and commandsOf() of a view, on the GPU.
    struct ViewBuffers {
        const gpu::Buffer& rows;
        const gpu::Buffer& commands;
    };
    /// Binds the vertex streams and draws each batch with its material, textures, winding and cull state. `state` is
    /// the pass's pipeline state; batches override its culling and winding, and `transmitting` overrides the blending
    /// of transmissive materials.
    void draw(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
              std::optional<gpu::Blend> transmitting = {}) const;
    /// Triangles [first, first + count) of all batches, in their order.
    struct Part {
        std::span<const gpu::DrawIndexedCommand> commands; ///< commandsOf() the view
        std::size_t first = 0;
        std::size_t count = 0;
    };
    /// draw() of a part. Not for blended surfaces, whose back faces must all be drawn before their front faces.
    void drawPart(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                  const Part& part) const;
    /// Programs of depth-only passes.
    struct DepthPrograms {
        const gpu::Program& bare;             ///< samples no textures and reads no material
        const gpu::Program* masked = nullptr; ///< for masked materials; null without any, or if holes may count
                                              ///< as surface, as in depth bounds
    };
    /// draw() for depth-only passes: binds only masked materials.
    void drawDepth(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                   const DepthPrograms& programs) const;

    std::span<const gpu::Buffer* const> vertices() const { return geometry_.streams; }
    const gpu::Buffer& indices() const { return *geometry_.indices; }
    const gpu::Buffer& materials() const { return *materials_.constants; }
    /// The constants of all materials by number (shaders/lib/material/material_table.glsl); null if the features do not
    /// need them.
    const gpu::Buffer* materialTable() const { return materials_.tabled.get(); }

    /// SubsurfaceConstants of all materials; null if the features do not need them.
    const gpu::Buffer* subsurfaces() const { return materials_.subsurfaces.get(); }

    /// Whether the draw casts shadows (scenes/Shadows.h).
    bool isCaster(const Draw& draw) const;
    /// Changes when materials or geometry change the casters; unique among scenes.
    std::uint64_t casterRevision() const { return casterRevision_; }

    /// The tree of shadow casters.
    struct Casters {
        CasterSpace space;
        std::unique_ptr<gpu::Buffer> texels;
    };
    /// Builds the caster tree, or rebuilds it if materials have changed the casters. Throws as makeCasterTree(), and
    /// std::runtime_error if the driver cannot read so large a buffer.
    void makeCasters();
    /// The result of the last makeCasters(); null before.
    const Casters* casters() const { return casters_ ? &*casters_ : nullptr; }

    /// Uploads VertexStreams::facetNormalsOS, the triangle normals that shadows need, and the vertices copied for them.
    /// Throws as updateGeometry().
    void makeFacetNormals();
    /// Null before makeFacetNormals(), unless the features have shadows.
    const gpu::Buffer* facetNormals() const { return geometry_.facetNormals.get(); }

private:
    struct BoundTexture {
        const gpu::Texture* texture = nullptr;
        const gpu::Sampler* sampler = nullptr;
    };
    struct Geometry {
        std::vector<std::optional<TangentBasis>> tangentBases; ///< by material, of the current streams
        VertexStreams::Ranges ranges;
        std::vector<std::unique_ptr<gpu::Buffer>> vertices;
        std::vector<const gpu::Buffer*> streams; ///< pointers to `vertices`
        std::unique_ptr<gpu::Buffer> indices;
        std::unique_ptr<gpu::Buffer> facetNormals; ///< null until makeFacetNormals()
        std::unique_ptr<gpu::VertexArray> array;
    };
    struct Draws {
        std::vector<bool> transparentMaterials; ///< by material, of the current list
        DrawList list;
        std::vector<VertexStreams::Range> ranges; ///< parallel to list.draws
    };
    struct Materials {
        std::unique_ptr<gpu::Buffer> constants; ///< per material, with a stride of a multiple of 256 bytes
        std::unique_ptr<gpu::Buffer> tabled;    ///< the first MATERIAL_TEXELS of each material in use, without gaps
        std::unique_ptr<gpu::Buffer> subsurfaces;
        std::vector<bool> closedBodies; ///< scenes::closedBodies()
    };
    /// Material properties that determine the casters: whether it casts shadows, alpha mode, cutoff, opacity, and the
    /// row of SubsurfaceConstants for transmission.
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
    std::vector<CasterMaterial> treeMaterials_;    ///< by material, of casters_
    std::vector<CasterMaterial> revisedMaterials_; ///< by material, of casterRevision_
    std::uint64_t casterRevision_ = 0;
    std::map<std::pair<int, bool>, std::unique_ptr<gpu::Texture>>
        textures_; ///< by image and whether it is decoded from sRGB
    std::vector<std::pair<scenes::Sampler, std::unique_ptr<gpu::Sampler>>> samplers_;
    std::unique_ptr<gpu::Texture> white_; ///< bound to empty slots
    std::vector<BoundTexture> bound_;     ///< material-major, kTextureSlotCount per material
};

} // namespace tessera::frame
