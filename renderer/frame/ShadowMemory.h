#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/frame/SceneGpu.h"
#include "renderer/frame/ShadowMaps.h"

namespace tessera::frame {

/// What the faces of an atlas are drawn from, all of them behind one another.
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

/// Which faces the atlas of a view holds from earlier frames. A face holds as long as its camera, its place and the
/// casters are the same.
class ShadowMemory {
public:
    /// Collects the faces to draw, all of them where the atlas is not held. Returns whether there are any.
    bool begin(const ShadowMaps& maps, const SceneGpu& scene, bool holdsAtlas, bool culls);
    const ShadowDraws& draws() const { return draws_; }
    /// They are drawn.
    void end() {
        held_ = std::move(begun_);
        drawnFaces_ = draws_.faces.size();
    }
    /// Faces drawn since begin().
    std::size_t drawnFaces() const { return drawnFaces_; }
    /// Of its atlas, unique among living memories; the first is 0.
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

/// A memory for each view of a frame and each way to make maps, so that settings whose frames run in turn keep their
/// faces.
class ShadowMemories {
public:
    /// Valid until it was not asked for in kMostIdleFrames frames.
    ShadowMemory& of(std::size_t view, const FrameSettings& settings);
    void beginFrame();
    /// All faces are to be drawn again.
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
