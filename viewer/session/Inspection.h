#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/DebugViews.h"
#include "scenes/Scene.h"

/// What the picture shows at one pixel.
namespace tessera::viewer {

/// Side of the part of the picture that a loupe shows, odd: the inspected pixel is its middle.
inline constexpr int kLoupeTexels = 15;

struct InspectedSide {
    glm::vec4 radiance{0.0f}; ///< linear, before exposure; its fourth number is the share that is covered
    glm::u8vec4 display{0};   ///< code values
    frame::DebugView view = frame::DebugView::Final; ///< whose values these are
    std::optional<std::size_t> visitedLights = {};   ///< by the pixel, as the surface takes light; none: nobody knows
};

/// The surface there, found by a ray; its numbers are those of no picture.
struct InspectedSurface {
    std::string material;
    double depthMetres = 0.0;        ///< along the view axis
    glm::dvec3 shadingNormalWS{0.0}; ///< that is lit: between the vertices' normals, and with the normal map
    glm::dvec3 faceNormalWS{0.0};    ///< of the triangle, towards the viewer
    std::size_t reachingLights = 0;  ///< that are on and shine so far, and that way, whatever lies between
    bool isTransparent = false;
    bool takesLight = true;
    bool mayBeMoved = false; ///< the scene's hook moves vertices: the picture may show another surface there
};

struct Inspection {
    glm::ivec2 pixel{0}; ///< from the upper left
    glm::ivec2 sizePixels{0};
    std::array<std::optional<InspectedSide>, 2> sides; ///< the second of a comparison
    bool isOfUnshifted = false;                        ///< the window shows a mean of shifted pictures in its place
    bool isSurfaceKnown = false;                       ///< it takes a moment
    std::optional<InspectedSurface> surface;           ///< none: the pixel shows none
};

/// The pixel at a place of a picture, a share of its size from the upper left.
glm::ivec2 pixelAt(const glm::vec2& place, glm::ivec2 sizePixels);

/// How many lights a pixel of this surface visits, of the lights that its opaque surface visits by light lists. None
/// where the picture may show another surface before, or in the place of, the opaque one.
std::optional<std::size_t> visitsOf(const InspectedSurface& surface, std::optional<std::size_t> ofOpaque);

/// The lines that tell it.
std::vector<std::string> inspectionLines(const Inspection& inspection);

/// The surface that a camera of the scene shows at a pixel, with the lights at a time; none where that is none. Of
/// vertices that a hook moves it takes the places where it found them.
std::optional<InspectedSurface> surfaceAt(const scenes::Scene& scene, const scenes::Camera& camera,
                                          glm::ivec2 sizePixels, glm::ivec2 pixel, double timeSeconds);

} // namespace tessera::viewer
