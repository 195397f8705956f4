#pragma once
#include <memory>

#include "validation/reference/Hit.h"
#include "validation/reference/LightAt.h"
#include "validation/reference/MaterialAt.h"
#include "validation/reference/Settings.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

class Casters;

/// Visibility of lights from points, past casters (scenes/Shadows.h). May be used by several threads.
class Occlusion {
public:
    /// The objects must outlive it. Throws as Casters.
    Occlusion(const scenes::Scene& scene, const Objects& objects);
    ~Occlusion();

    /// The fraction of a light that is visible from a point (scenes/Shadows.h), and the range that rounding to fp32
    /// allows a program: it may move the point, the light and the casters by some roundings, and a mask's texels by
    /// those of lookups.
    struct Answer {
        double share = 1.0;
        double least = 1.0, most = 1.0;
        bool isUndecided = false; ///< rounding decides, not ray noise alone
        Noise noise = {};         ///< of the fraction by Settings::shadowSamples independent rays
    };
    /// From a point of a surface. Its own triangle hides all on the side away from the viewer, unless the surface wraps
    /// light: then rays start above the surface. With softened terminators, rays of smooth-shaded triangles start above
    /// them too.
    Answer of(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface, const glm::dvec3& pointRWS,
              const glm::dvec3& toViewer, const Settings& settings) const;

    /// Transmittance by channel for a light below the horizon, through objects with the surface's material, and the
    /// range that rounding allows a program.
    struct Passage {
        glm::dvec3 share{0.0}, least{0.0}, most{0.0};
        bool isUndecided = false;
    };
    Passage passageOf(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface,
                      const glm::dvec3& pointRWS, bool findsAlternatives) const;

private:
    struct Start;
    Answer from(const Start& start, const ShiningLight& light, const Settings& settings) const;
    std::unique_ptr<const Casters> casters_;
};

} // namespace tessera::reference
