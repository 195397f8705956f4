#pragma once
#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/image/EnvironmentTest.h"

/// A plane under a sky, with the view direction and sky radiance of each pixel in double precision.
namespace tessera::test {

/// A plane through the origin, tilted about x, that fills the image of a wide-angle camera at z = 3.
struct TiltedPlane {
    double tiltRadians, halfSideMetres;
    double fovYRadians; ///< of the camera
    int sidePixels;     ///< of the image

    scenes::Scene sceneOf(const scenes::Material& material) const {
        scenes::Scene scene = quadScene(material);
        const double cosine = std::cos(tiltRadians), sine = std::sin(tiltRadians);
        glm::dmat4& placed = scene.nodes[0].parentFromNode;
        placed = glm::dmat4(1.0);
        placed[0] = {halfSideMetres, 0.0, 0.0, 0.0};
        placed[1] = glm::dvec4(0.0, cosine, -sine, 0.0) * halfSideMetres;
        placed[2] = {0.0, sine, cosine, 0.0};
        scene.cameras[0].fovYRadians = fovYRadians;
        scene.cameras[0].nearMetres = 0.1;
        scene.cameras[0].farMetres = 1000.0;
        return scene;
    }
    glm::dvec3 normal() const { return {0.0, std::sin(tiltRadians), std::cos(tiltRadians)}; }
    /// The unit vector from the plane towards the viewer at the centre of a pixel; row 0 is at the top.
    glm::dvec3 toViewer(int x, int y) const {
        const double half = std::tan(0.5 * fovYRadians) / sidePixels;
        return -glm::normalize(
            glm::dvec3((2.0 * x + 1.0 - sidePixels) * half, (sidePixels - 1.0 - 2.0 * y) * half, -1.0));
    }
};

inline constexpr int kSkyWidth = 256, kSkyHeight = 128; ///< texels of the environment map

/// The sky radiance by column and row of its map.
using SkyRadiance = std::function<double(int, int)>;

inline scenes::Environment skyOf(const SkyRadiance& sky) {
    return environmentOf(kSkyWidth, kSkyHeight, [&](int x, int y) { return glm::dvec3(sky(x, y)); });
}

/// Sky radiance in a direction, interpolated, with the minimum and maximum of the texels around it.
struct SeenSky {
    double radiance, least, most;
};

inline SeenSky seenOfSky(const SkyRadiance& sky, const glm::dvec3& direction) {
    const glm::dvec2 place = scenes::placeInMap(direction) * glm::dvec2(kSkyWidth, kSkyHeight) - 0.5;
    const auto at = [&](int x, int y) { return sky((x + kSkyWidth) % kSkyWidth, std::clamp(y, 0, kSkyHeight - 1)); };
    SeenSky seen{};
    seen.radiance = interpolated(place, at);
    // One texel more on each side: rounding may move the lookup across a texel edge.
    seen.least = seen.most = seen.radiance;
    for (int j = -1; j <= 2; ++j)
        for (int i = -1; i <= 2; ++i) {
            const double texel = at(int(std::floor(place.x)) + i, int(std::floor(place.y)) + j);
            seen.least = std::min(seen.least, texel);
            seen.most = std::max(seen.most, texel);
        }
    return seen;
}

} // namespace tessera::test
