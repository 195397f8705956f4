#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "scenes/Shadows.h"

namespace tessera::reference {

/// How textures are read: the picture alone, or with smaller levels as a driver's hardware does (see Filtering.h).
enum class Filtering { Exact, Hardware };

/// The spread of what a few independent rays find of a light or a pixel, as cumulants, which add up over lights.
struct Noise {
    double variance = 0.0;
    double fourth = 0.0;      ///< cumulant; the mean fourth power of the error is this and 3 variance^2
    double ofReference = 0.0; ///< variance that is left of the reference's own rays, by how far their halves differ

    /// Of so many times as much light.
    Noise times(double factor) const {
        const double square = factor * factor;
        return {square * variance, square * square * fourth, square * ofReference};
    }
    Noise& operator+=(const Noise& other) {
        variance += other.variance;
        fourth += other.fourth;
        ofReference += other.ofReference;
        return *this;
    }
};

/// What a scene's hook makes of surfaces, by point. Whoever renders a scene with a hook brings it: a hook is the text
/// of a shader, and the reference runs none. In single precision, as a hook's numbers are, and without bounds.
using RunHook = std::function<std::vector<scenes::HookedSurface>(std::span<const scenes::HookPoint> points)>;

/// Where rays leave bodies of what transmits: nowhere, so that they bend once; at a plane along the near side, as thick
/// as the body below it; or at the back faces of its mesh,
/// of any or of closed ones.
enum class FarSide { None, Parallel, BackFaces, BackFacesOfClosed };

/// What is rendered of a scene.
struct Settings {
    glm::ivec2 sizePixels{1280, 720};
    scenes::Camera camera;
    double timeSeconds = 0.0;     ///< of animated lights
    std::optional<int> soloLight; ///< index into Scene::lights: only this one shines, not the environment
    scenes::ShadowRequest shadows;
    scenes::SubsurfaceRequest subsurface;
    int diffusionPoints = 256;           ///< of the surface around a point that light spreads to
    bool environmentLights = true;       ///< surfaces, where the scene has an environment
    bool environmentCompensates = false; ///< rough metallic_roughness for light that meets it more than once
    bool environmentIsSeen = true;       ///< where nothing is drawn
    double environmentIntensity = 1.0, environmentRotationDegrees = 0.0; ///< besides the scene's own
    int environmentPaths = 1024;                                         ///< of each kind, from every surface
    bool bodiesShowScene = false;    ///< bodies of what transmits show opaque surfaces too, where they bend rays to
    FarSide farSide = FarSide::None; ///< of those bodies, where rays leave them
    int bodyPaths = 32;              ///< of the lobe of a rough one, to surfaces
    /// How many bodies and sheets a ray that one has bent may meet in turn, and shows with all that they pass. The
    /// renderer's rays meet none.
    int glassDepth = 0;
    int areaSquares = 16384;     ///< of an area light as seen from a point, at most, 49 directions each (AreaLights.h)
    double areaTolerance = 2e-5; ///< of what is reflected of it, where fewer will do
    bool softensTerminators = true; ///< shadows of smooth-shaded triangles are asked for from above them
    int shadowRings = 16;           ///< on the disk of a light with a size, four times as many rays each
    int penumbraRings = 64;         ///< of points that those find to see part of it
    int shadowSamples = 0;          ///< rays that a program tries: their noise is allowed it too; 0: none is
    bool specular = true;           ///< false leaves the specular lobe out
    Filtering filtering = Filtering::Exact;
    bool leeway = true;          ///< whether to find other values that the definition allows (Rendered::alternatives)
    double rangeTolerance = 0.0; ///< unit of colour x intensity: A B C and area lights end where they fall to it;
                                 ///< 0: nowhere
    /// Where the scene's hook changes surfaces, and only there. Called by the thread that renders, once in many rows.
    RunHook runHook;
    /// Errors of light that passes rough glass count in parts of at least so much of the light that enters
    /// (Rendered::errorWeights).
    double leastRoughTransmittance = 0.0;
};

} // namespace tessera::reference
