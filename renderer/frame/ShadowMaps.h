#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/DrawList.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/frame/ShadowAtlas.h"
#include "renderer/frame/ShadowCameras.h"
#include "renderer/graph/Resource.h"
#include "shaders/shared/shadow_maps.h"

/// Which shadow maps a view has, how large, and where in the atlas. Made without OpenGL.
namespace tessera::frame {

/// A square picture of the casters as a light sees them.
struct ShadowFace {
    scenes::Camera camera;
    glm::ivec2 cornerTexels{0}; ///< lower-left, in the atlas
    int sideTexels = 0;         ///< a power of two
    /// Along the camera: all that the light reaches lies nearer, and casters farther away hide nothing of it.
    double reachMetres = std::numeric_limits<double>::infinity();
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
    /// By how much rounding moves a surface against the faces, or the width of a texel of the nearest cascade where
    /// that is more.
    double errorMetres = 0.0;
};

struct ShadowMaps {
    std::vector<ShadowFace> faces;
    std::vector<ShadowedLight> lights; ///< in the order of PackedLights
    glm::ivec2 atlasTexels{0};

    graph::TextureDesc atlas() const { return {graph::Format::Depth32Float, atlasTexels.x, atlasTexels.y}; }
    std::size_t reduced() const;  ///< lights with fewer texels than wanted, but some
    std::size_t unmapped() const; ///< lights without any
    /// Lights with maps that err by more than what most triangles are around is large.
    std::size_t useless() const;
    double usualMetres = 0.0; ///< of the mesh instance with the most triangles
};

/// What face i of a light with so many is called: its cascade, or the direction that it sees.
std::string shadowFaceName(int i, int faces);

/// How far taps of a map's filter reach, but for those of penumbrae.
int shadowTapTexels(const FrameSettings& settings);
/// Texels around the part of a light's face that points are looked up in, for such taps or its penumbrae.
int shadowBorderTexels(const FrameSettings& settings, const scenes::Light& light, int sideTexels);

/// The maps of all lights that cast shadows. A face's side follows from how wide it is in the picture where its light
/// ends, or is ShadowMapSettings::resolutionTexels, within the budget (fitBudget()). `bounds` are of everything drawn.
ShadowMaps makeShadowMaps(const scenes::Scene& scene, const PackedLights& lights, const CameraView& view,
                          const FrameSettings& settings, std::span<const SurfaceBounds> bounds);

/// The camera of a face, as its map is drawn.
CameraView faceView(const ShadowFace& face);

/// Tells the lights' texels where their faces lie, and returns the records of the faces. `firstTexel` is the texel
/// behind all lights.
std::vector<shared::ShadowFaceTexels> packFaces(const ShadowMaps& maps, const CameraView& view, std::size_t firstTexel,
                                                std::span<const SurfaceBounds> bounds, PackedLights& lights);

} // namespace tessera::frame
