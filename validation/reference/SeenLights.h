#pragma once
#include <optional>
#include <span>
#include <vector>

#include "validation/reference/CameraRays.h"
#include "validation/reference/LightAt.h"

namespace tessera::reference {

/// The visible surfaces of area lights, as camera rays meet them. Rays that gather light ignore them: the light of area
/// lights on surfaces is integrated elsewhere.
class SeenLights {
public:
    /// The lights must outlive it.
    SeenLights(std::span<const ShiningLight> lights, const CameraRays& rays);

    struct Met {
        std::size_t light = 0; ///< index of the light
        double depthMetres = 0.0;
        glm::dvec3 factor{1.0}; ///< factor of its radiance there, by its image
    };
    /// The nearest surface within the camera's depths and not behind `depthMetres`; of coincident ones the last. Flat
    /// lights are met on emitting sides, solids from outside only.
    std::optional<Met> before(const Ray& ray, double depthMetres) const;
    /// The same along any other ray, from its origin on.
    std::optional<Met> ahead(const Ray& ray, double depthMetres) const;

    bool areThere() const { return !shown_.empty(); }

    /// A box around each visible light surface, wherever the camera looks.
    static std::vector<scenes::Box3> boxesRWS(std::span<const ShiningLight> lights);

private:
    std::optional<Met> between(const Ray& ray, double nearMetres, double farMetres) const;

    std::span<const ShiningLight> lights_;
    std::vector<std::size_t> shown_; ///< indices of the lights with a visible surface
    double nearMetres_, farMetres_;
};

} // namespace tessera::reference
