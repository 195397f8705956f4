#pragma once
#include <memory>

#include "validation/reference/Hit.h"
#include "validation/reference/LightAt.h"
#include "validation/reference/MaterialAt.h"
#include "validation/reference/Settings.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

class Casters;

/// Whether casters (scenes/Shadows.h) hide lights from points. May be used by several threads.
class Occlusion {
public:
    /// The objects must outlive it. Throws as Casters.
    Occlusion(const scenes::Scene& scene, const Objects& objects);
    ~Occlusion();

    /// The share of a light that reaches a point (scenes/Shadows.h), and what rounding to fp32 allows a program
    /// besides: it may move a point, its light and the casters by some roundings, and what a mask's texture holds by
    /// those of lookups.
    struct Answer {
        double share = 1.0;
        double least = 1.0, most = 1.0;
        bool isUndecided = false; ///< rounding decides, not the noise of rays alone
        Noise noise = {};         ///< of the share that Settings::shadowSamples independent rays find
    };
    /// From a point of a surface. Its own triangle hides what lies on the other side of it than the viewer, unless the
    /// surface wraps light: then the light is asked for from a point above the surface.
    /// A smooth-shaded one is asked from above itself too, where terminators are softened.
    Answer of(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface, const glm::dvec3& pointRWS,
              const glm::dvec3& toViewer, const Settings& settings) const;

    /// The share, by channel, of a light below the horizon that passes through what has the surface's material; with
    /// what rounding allows a program besides.
    struct Passage {
        glm::dvec3 share{0.0}, least{0.0}, most{0.0};
        bool isUndecided = false;
    };
    Passage passageOf(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface,
                      const glm::dvec3& pointRWS, bool leeway) const;

private:
    struct Start;
    Answer from(const Start& start, const ShiningLight& light, const Settings& settings) const;
    std::unique_ptr<const Casters> casters_;
};

} // namespace tessera::reference
