#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/DebugViews.h"
#include "scenes/Scene.h"

/// Values of the image at one pixel.
namespace tessera::viewer {

/// Side of the square of texels that a loupe shows; odd, the inspected pixel is its centre.
inline constexpr int kLoupeTexels = 15;

struct InspectedSide {
    glm::vec4 radiance{0.0f};                        ///< linear, before exposure; w: covered fraction
    glm::u8vec4 display{0};                          ///< code values
    frame::DebugView view = frame::DebugView::Final; ///< of which these are the values
    std::optional<std::size_t> visitedLights = {};   ///< by the pixel, 0 for unlit surfaces; none: unknown
};

/// The surface at the pixel, found by a ray; its values are not read from an image.
struct InspectedSurface {
    std::string material;
    double depthMetres = 0.0;        ///< along the view axis
    glm::dvec3 shadingNormalWS{0.0}; ///< for shading: interpolated, with the normal map
    glm::dvec3 faceNormalWS{0.0};    ///< of the triangle, towards the viewer
    std::size_t reachingLights = 0;  ///< lights that are on and reach it by range and cone, occlusion ignored
    bool isTransparent = false;
    bool isLit = true;
    bool mayBeMoved = false; ///< the scene's hook moves vertices: the image may show another surface
};

struct Inspection {
    glm::ivec2 pixel{0}; ///< from the upper left
    glm::ivec2 sizePixels{0};
    std::array<std::optional<InspectedSide>, 2> sides; ///< the second side only in a comparison
    bool isOfUnshifted = false;                        ///< the window shows the mean of shifted images instead
    bool isSurfaceKnown = false;                       ///< found a moment later
    std::optional<InspectedSurface> surface;           ///< none: the pixel shows no surface
};

/// The pixel at an image position, a fraction of the image size from the upper left.
glm::ivec2 pixelAt(const glm::vec2& place, glm::ivec2 sizePixels);

/// Lights that a pixel of this surface visits, given how many its opaque surface visits by the light lists. None if the
/// image may show another surface in front of, or instead of, the opaque one.
std::optional<std::size_t> visitsOf(const InspectedSurface& surface, std::optional<std::size_t> ofOpaque);

/// The lines of text that describe an inspection.
std::vector<std::string> inspectionLines(const Inspection& inspection);

/// Values of an inspected pixel, kept until removed.
struct PinnedInspection {
    glm::vec2 place{0.0f}; ///< in the image, a fraction of its size
    std::vector<std::string> lines;
};

/// Pins the lines of a place on request; a place has one pin. Else completes a pin that was made before its surface was
/// found.
void keepPin(std::vector<PinnedInspection>& pins, const glm::vec2& place, const std::vector<std::string>& lines,
             bool isRequested);

/// The surface that a camera of the scene shows at a pixel, with the lights at a time; none without a surface. Vertices
/// that a hook moves keep their unmoved positions.
std::optional<InspectedSurface> surfaceAt(const scenes::Scene& scene, const scenes::Camera& camera,
                                          glm::ivec2 sizePixels, glm::ivec2 pixel, double timeSeconds);

} // namespace tessera::viewer
