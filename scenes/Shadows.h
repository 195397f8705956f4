#pragma once
#include <cstddef>

#include "scenes/Scene.h"

/// Which lights cast shadows, and what hides them. A caster is opaque where it is there at all, and hides light from
/// either of its sides. Transparent surfaces hide none from others. The triangle that a point lies on hides what lies
/// on the other side of it than the viewer, whatever normal the point is lit with.
///
/// What reaches a point of a light that casts shadows is the share, by area, of a surface that casters leave in sight:
/// of a flat area light of its own, as large as it is; of other lights of the disk around the light's position that
/// faces the point, of Light::radiusMetres, or around the direction to the light, of Light::angularRadiusRadians; of a
/// tube of such disks, evenly along its axis. Where there is no size, all or nothing. The light that it shares out is
/// that of the light without a size, and of an area light that of its surface without anything in the way. All of an
/// area counts alike, also what is nearer. Shadow maps take every area light for the disk of shadowRadiusMetres().
namespace tessera::scenes {

/// Which of a scene's lights are to cast shadows.
struct ShadowRequest {
    enum class Kind : std::uint8_t {
        None,
        Asked, ///< those with Light::castsShadow
        All,
        First ///< the first `lights` of Scene::lights
    };
    Kind kind = Kind::Asked;
    int lights = 0; ///< 0 but for First
    bool operator==(const ShadowRequest&) const = default;
};

/// Whether light `light` of the scene casts shadows.
bool castsShadow(const Scene& scene, std::size_t light, const ShadowRequest& request);

/// The radius in metres of a disk that stands for a light with a position: Light::radiusMetres, or of a rectangle, a
/// tube and a polygon that of the disk of the largest area that they show.
double shadowRadiusMetres(const Light& light);

/// Whether a light's shadows are soft.
bool hasSize(const Light& light);

/// Whether surfaces of the material hide light.
bool castsShadow(const Material& material);

/// Whether the instance hides light: it is drawn, both it and its material may, and it is not transparent.
bool isCaster(const Scene& scene, const MeshInstance& instance);

bool hasCasters(const Scene& scene);

/// Softened terminators lift a triangle's points (docs/shadows.md) only where the normals of its corners lie within
/// this angle of its own. The corners of a box with averaged normals are 45 and 54.7 degrees off: its sides stay flat.
inline constexpr double kMostLiftedDegrees = 44.0;

/// What a scene draws, by whether it hides light.
struct CasterCounts {
    std::size_t triangles = 0;   ///< of casters
    std::size_t transparent = 0; ///< instances that cast no shadow for being transparent
};
CasterCounts casterCounts(const Scene& scene);

} // namespace tessera::scenes
