#pragma once
#include <cstddef>

#include "scenes/Scene.h"

/// Which lights cast shadows, and which surfaces block light. Casters are opaque wherever they are not cut out, and
/// block light from both sides. Transparent surfaces cast no shadow. The triangle of a shaded point blocks light from
/// the side that faces away from the viewer, whatever the shading normal.
///
/// The visibility of a shadow-casting light at a point is the unoccluded fraction, by area, of an emitter: of a flat
/// area light its own surface; of other lights the disk of Light::radiusMetres around the light's position that faces
/// the point, or that of Light::angularRadiusRadians around the direction to the light; of a tube such disks, evenly
/// along its axis. Without a size it is 0 or 1. It scales the unoccluded lighting: of an area light that of its whole
/// surface, of other lights that of the light without a size. All parts of a surface count alike, whatever their
/// distance. Shadow maps replace every area light by the disk of shadowRadiusMetres().
namespace tessera::scenes {

/// Selection of the lights that cast shadows.
struct ShadowRequest {
    enum class Kind : std::uint8_t {
        None,
        Scene, ///< those with Light::castsShadow
        All,
        First ///< the first `lights` of Scene::lights
    };
    Kind kind = Kind::Scene;
    int lights = 0; ///< 0 except for First
    bool operator==(const ShadowRequest&) const = default;
};

/// Whether light `light` of the scene casts shadows.
bool castsShadow(const Scene& scene, std::size_t light, const ShadowRequest& request);

/// Radius in metres of a disk that represents a light with a position: Light::radiusMetres, but for rectangles, tubes
/// and polygons that of the disk with their largest projected area.
double shadowRadiusMetres(const Light& light);

/// Whether a light's shadows are soft.
bool hasSize(const Light& light);

/// Whether surfaces of the material cast shadows.
bool castsShadow(const Material& material);

/// Whether the instance casts shadows: it is drawn, both it and its material allow it, and it is not transparent.
bool isCaster(const Scene& scene, const MeshInstance& instance);

bool hasCasters(const Scene& scene);

/// Softened terminators lift a triangle's points (docs/shadows.md) only if the normals of its corners lie within this
/// angle of the triangle's. Averaged normals at the corners of a box are 45 and 54.7 degrees off: its sides stay flat.
inline constexpr double kMostLiftedDegrees = 44.0;

/// What a scene draws, by whether it casts shadows.
struct CasterCounts {
    std::size_t triangles = 0;   ///< of casters
    std::size_t transparent = 0; ///< instances that cast no shadow because they are transparent
};
CasterCounts casterCounts(const Scene& scene);

} // namespace tessera::scenes
