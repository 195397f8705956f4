#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "scenes/Shadows.h"

namespace tessera::reference {

/// How textures are read: level 0 alone, or with smaller levels as a driver's hardware does (Filtering.h).
enum class Filtering { Exact, Hardware };

/// Sampling noise of a light or a pixel by a few independent rays, as cumulants, which add up over lights.
struct Noise {
    double variance = 0.0;
    double fourth = 0.0;      ///< cumulant; the mean fourth power of the error is this plus 3 variance^2
    double ofReference = 0.0; ///< variance left by the reference's own rays, from the difference of their halves

    /// The noise of light scaled by a factor.
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

/// Runs a scene's hook on surface points. The caller provides it: a hook is the text of a shader, and the reference
/// runs none. In single precision, as a hook's numbers are, and without bounds.
using RunHook = std::function<std::vector<scenes::HookedSurface>(std::span<const scenes::HookPoint> points)>;

/// Where rays leave transmissive bodies: nowhere, so that they bend once; at a plane parallel to the near side, at the
/// body's thickness; at the back faces of any mesh; or at those of closed meshes.
enum class FarSide { None, Parallel, BackFaces, BackFacesOfClosed };

/// Settings of the reference renderer.
struct Settings {
    glm::ivec2 sizePixels{1280, 720};
    scenes::Camera camera;
    double timeSeconds = 0.0;     ///< of animated lights
    std::optional<int> soloLight; ///< index into Scene::lights: only this one shines, not the environment
    scenes::ShadowRequest shadows;
    scenes::SubsurfaceRequest subsurface;
    int diffusionPoints = 256;           ///< sample points of diffused light around a point
    bool environmentLights = true;       ///< whether the scene's environment lights surfaces
    bool environmentCompensates = false; ///< energy compensation of rough metallic_roughness lobes
    bool environmentIsSeen = true;       ///< visible where nothing is drawn
    double environmentIntensity = 1.0, environmentRotationDegrees = 0.0; ///< relative to the scene's
    int environmentPaths = 1024;                                         ///< per strategy and surface
    bool bodiesShowScene = false;    ///< bodies also show opaque surfaces that bent rays meet
    FarSide farSide = FarSide::None; ///< far side of those bodies
    int bodyPaths = 32;              ///< rays to surfaces through the lobe of a rough body
    /// How many bodies and sheets a bent ray may meet in sequence, showing each with what it transmits. The product's
    /// rays meet none.
    int glassDepth = 0;
    int areaSquares = 16384;        ///< at most, per area light and point, with 49 directions each (AreaLights.h)
    double areaTolerance = 2e-5;    ///< relative tolerance of its reflected light, where fewer squares suffice
    bool softensTerminators = true; ///< shadow rays of smooth-shaded triangles start above them
    int shadowRings = 16;           ///< of the disk of a light with a size, four times as many rays in each
    int penumbraRings = 64;         ///< the same for points that those find in the penumbra
    int shadowSamples = 0;          ///< shadow rays of the compared program: their noise is allowed; 0: none is
    bool specular = true;           ///< false leaves the specular lobe out
    Filtering filtering = Filtering::Exact;
    bool findsAlternatives = true; ///< finds Rendered::alternatives, other values that the definition allows
    double rangeTolerance = 0.0;   ///< irradiance (colour x intensity) at which A B C and area lights end; 0: nowhere
    /// Set where the scene's hook changes surfaces. Called by the rendering thread, once per batch of rows.
    RunHook runHook;
    /// Errors of light through rough glass are relative to at least this fraction of the light that enters
    /// (Rendered::errorWeights).
    double leastRoughTransmittance = 0.0;
};

} // namespace tessera::reference
