#pragma once
#include <optional>
#include <span>
#include <vector>

#include "validation/reference/CameraRays.h"
#include "validation/reference/LightAt.h"

namespace tessera::reference {

/// The surfaces of area lights, as the rays of a camera meet them. Rays that light is gathered by do not: what a
/// surface gets of lights is integrated elsewhere.
class SeenLights {
public:
    /// The lights must outlive it.
    SeenLights(std::span<const ShiningLight> lights, const CameraRays& rays);

    struct Met {
        std::size_t light = 0; ///< its number among the lights
        double depthMetres = 0.0;
        glm::dvec3 factor{1.0}; ///< of its radiance there: that of its picture
    };
    /// The nearest surface within the camera's depths and not behind `depthMetres`; of several in one place the last.
    /// Flat lights are met from sides that shine, solids from outside alone.
    std::optional<Met> before(const Ray& ray, double depthMetres) const;
    /// The same along any other ray, from its origin on.
    std::optional<Met> ahead(const Ray& ray, double depthMetres) const;

    bool areThere() const { return !shown_.empty(); }

    /// A box around each of them, wherever the camera looks.
    static std::vector<scenes::Box3> boxesRWS(std::span<const ShiningLight> lights);

private:
    std::optional<Met> between(const Ray& ray, double nearMetres, double farMetres) const;

    std::span<const ShiningLight> lights_;
    std::vector<std::size_t> shown_; ///< those of them that have a surface to be seen
    double nearMetres_, farMetres_;
};

} // namespace tessera::reference
