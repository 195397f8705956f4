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

/// Plan of a view's shadow maps: their sizes and places in the atlas. Made without OpenGL.
namespace tessera::frame {

/// A square depth image of the casters, rendered from a light.
struct ShadowFace {
    scenes::Camera camera;
    glm::ivec2 cornerTexels{0}; ///< lower-left, in the atlas
    int sideTexels = 0;         ///< a power of two
    /// The light's range along the camera; casters farther away are omitted.
    double reachMetres = std::numeric_limits<double>::infinity();
    bool operator==(const ShadowFace&) const = default;
};

/// Faces of a light: one per cascade of a directional light; one around the cone of a spot light with a half angle of
/// up to 70 degrees, or around the scene if the light is outside it; else six.
struct ShadowedLight {
    std::size_t light = 0; ///< index into PackedLights::texels
    std::size_t firstFace = 0;
    int faces = 0;
    int wantedTexels = 0; ///< side of a face without a budget
    int sideTexels = 0;   ///< side within the budget; 0: does not fit, and the light casts no shadows
    /// Rounding error of a surface relative to the faces, or the texel width of the nearest cascade if that is larger.
    double errorMetres = 0.0;
};

struct ShadowMaps {
    std::vector<ShadowFace> faces;
    std::vector<ShadowedLight> lights; ///< in the order of PackedLights
    glm::ivec2 atlasTexels{0};

    graph::TextureDesc atlas() const { return {graph::Format::Depth32Float, atlasTexels.x, atlasTexels.y}; }
    std::size_t reduced() const;  ///< lights with fewer texels than wanted, but some
    std::size_t unmapped() const; ///< lights without a map
    /// Lights whose map error exceeds usualMetres, the extent of the mesh with the most triangles.
    std::size_t useless() const;
    double usualMetres = 0.0; ///< of the mesh instance with the most triangles
};

/// Name of face i of a light with so many faces: its cascade, or its axis.
std::string shadowFaceName(int i, int faces);

/// Filter radius of a map in texels, without penumbrae.
int shadowTapTexels(const FrameSettings& settings);
/// Border in texels of a light's face that lookups stay out of, for the filter radius or for penumbrae.
int shadowBorderTexels(const FrameSettings& settings, const scenes::Light& light, int sideTexels);

/// The maps of all lights with shadows. A face's side matches its width in the image at the end of the light's range,
/// or is ShadowMapSettings::resolutionTexels, within the budget (fitBudget()). `bounds` are of everything drawn.
ShadowMaps makeShadowMaps(const scenes::Scene& scene, const PackedLights& lights, const CameraView& view,
                          const FrameSettings& settings, std::span<const SurfaceBounds> bounds);

/// The view that renders a face's map.
CameraView faceView(const ShadowFace& face);

/// Writes the face locations to the lights' texels and returns the packed faces. `firstTexel` is the texel after all
/// lights.
std::vector<shared::ShadowFaceTexels> packFaces(const ShadowMaps& maps, const CameraView& view, std::size_t firstTexel,
                                                std::span<const SurfaceBounds> bounds, PackedLights& lights);

} // namespace tessera::frame
