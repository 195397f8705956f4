#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/DrawList.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/graph/Resource.h"
#include "shaders/shared/shadow_maps.h"

/// Which shadow maps a view has, how large, and where in the atlas. Made without OpenGL.
namespace tessera::frame {

/// A square picture of the casters as a light sees them.
struct ShadowFace {
    scenes::Camera camera;
    glm::ivec2 cornerTexels{0}; ///< lower-left, in the atlas
    int sideTexels = 0;         ///< a power of two
    bool operator==(const ShadowFace&) const = default;
};

/// Faces of a light: one per cascade of a directional light; one around the cone of a spot light of up to 70 degrees to
/// a side, or around all that is drawn where that is seen from beside it; else six.
struct ShadowedLight {
    std::size_t light = 0; ///< index into PackedLights::texels
    std::size_t firstFace = 0;
    int faces = 0;
    int wantedTexels = 0; ///< side of a face where the budget is no matter
    int sideTexels = 0;   ///< what it got; 0: the budget has no room for it, and it casts no shadows
};

struct ShadowMaps {
    std::vector<ShadowFace> faces;
    std::vector<ShadowedLight> lights; ///< in the order of PackedLights
    glm::ivec2 atlasTexels{0};

    graph::TextureDesc atlas() const { return {graph::Format::Depth32Float, atlasTexels.x, atlasTexels.y}; }
    std::size_t reduced() const;  ///< lights with fewer texels than wanted, but some
    std::size_t unmapped() const; ///< lights without any
};

/// The near end of a perspective face as a share of what its light reaches. Reverse-Z keeps the digits of any distance.
inline constexpr double kFaceNearShare = 0x1p-30;

/// Bytes of a texel of the atlas.
inline constexpr std::size_t kShadowTexelBytes = 4;

/// The smallest side of a face that a budget reduces one to.
inline constexpr int kLeastFaceTexels = 8;

/// What face i of a light with so many is called: its cascade, or the direction that it sees.
std::string shadowFaceName(int i, int faces);

/// Texels around the part of a face that points are looked up in, for taps of a filter beyond it.
int shadowBorderTexels(const FrameSettings& settings, int sideTexels);

/// Places faces of the sides, powers of two, so that none overlap; the corners are parallel to them. Returns the
/// size of the atlas, 0 x 0 where there are none.
glm::ivec2 placeFaces(std::span<const int> sidesTexels, std::vector<glm::ivec2>& cornersTexels);

/// The maps of all lights that cast shadows. A face's side follows from how wide it is in the picture where its light
/// ends, or is ShadowMapSettings::resolutionTexels. While the atlas exceeds the budget, the light has its faces halved
/// that saves most texels for the pixels whose outlines get coarser; where all are of kLeastFaceTexels, the last light
/// gets none.
/// `bounds` are of everything drawn.
ShadowMaps makeShadowMaps(const scenes::Scene& scene, const PackedLights& lights, const CameraView& view,
                          const FrameSettings& settings, std::span<const SurfaceBounds> bounds);

/// The camera of a face, as its map is drawn.
CameraView faceView(const ShadowFace& face);

/// Tells the lights' texels where their faces lie, and returns the records of the faces. `firstTexel` is the texel
/// behind all lights.
std::vector<shared::ShadowFaceTexels> packFaces(const ShadowMaps& maps, const CameraView& view, std::size_t firstTexel,
                                                std::span<const SurfaceBounds> bounds, PackedLights& lights);

} // namespace tessera::frame
