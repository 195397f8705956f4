#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/frame/SceneGpu.h"
#include "renderer/frame/ShadowMaps.h"

namespace tessera::frame {

/// Draw data of the atlas faces to render, concatenated.
struct ShadowDraws {
    struct Face {
        glm::ivec2 corner{0}; ///< texels of the atlas
        int side = 0;
        shared::ViewConstants view{};
        std::vector<Batch> batches; ///< of `commands`
    };
    std::vector<DrawRows> rows;
    std::vector<gpu::DrawIndexedCommand> commands;
    std::vector<Face> faces;
};

/// The faces of a view's atlas that are valid from earlier frames. A face is valid as long as its camera, its place and
/// the casters are the same.
class ShadowMemory {
public:
    /// Collects the faces to draw, all of them if the atlas was not kept. True if there are any or it was not kept.
    bool begin(const ShadowMaps& maps, const SceneGpu& scene, bool holdsAtlas, bool culls);
    const ShadowDraws& draws() const { return draws_; }
    /// Marks the collected faces as drawn.
    void end() {
        held_ = std::move(begun_);
        drawnFaces_ = draws_.faces.size();
    }
    /// Faces drawn since begin().
    std::size_t drawnFaces() const { return drawnFaces_; }
    /// Number of its atlas, unique among existing memories; the first is 0.
    std::size_t number() const { return number_; }

private:
    friend class ShadowMemories;

    struct Held {
        std::uint64_t casters = 0; ///< SceneGpu::casterRevision()
        std::vector<ShadowFace> faces;
    };
    Held held_, begun_;
    ShadowDraws draws_;
    std::size_t number_ = 0;
    std::size_t drawnFaces_ = 0;
};

/// One memory per view of a frame and per shadow map settings, so that alternating settings keep their faces.
class ShadowMemories {
public:
    /// Valid until unused for kMostIdleFrames frames.
    ShadowMemory& of(std::size_t view, const FrameSettings& settings);
    void beginFrame();
    /// Invalidates all faces.
    void forget();

    static constexpr int kMostIdleFrames = 16;

private:
    struct Way {
        std::size_t view = 0;
        ShadowFilter filter = ShadowFilter::Hard;
        ShadowMapSettings maps;
        std::unique_ptr<ShadowMemory> memory;
        int idleFrames = 0;
    };
    std::vector<Way> ways_;
};

} // namespace tessera::frame
