#include "scenes/Defaults.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/Error.h"
#include "scenes/InUse.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"

namespace tessera::scenes {
namespace {

/// The picture's share that the bounding sphere leaves free on each side is set by this factor on the distance at which
/// the sphere would touch the frame's edges.
constexpr double kDistanceMargin = 1.2;
/// Near plane as a share of the bounds' radius: small enough to walk close to things; depth is reversed and in floating
/// point, so a small near plane costs no precision.
constexpr double kNearShare = 1e-3;
constexpr const char* kDefaultEnvironment = "studio";

const Camera& viewedCamera(const Scene& scene) {
    assert(!scene.cameras.empty());
    const std::optional<std::string>& wish = scene.options.camera;
    return scene.cameras[wish ? cameraCalled(scene, *wish).value_or(0) : 0];
}

/// Whether light changes nothing that is drawn. Emission does not count: most models that glow do so in few places,
/// and are black elsewhere without light.
bool isAllUnlit(const Scene& scene) {
    const std::vector<const Material*> materials = materialsInUse(scene);
    return !materials.empty() && std::all_of(materials.begin(), materials.end(),
                                             [](const Material* material) { return !infoOf(material->model).isLit; });
}

} // namespace

void addDefaultCamera(Scene& scene) {
    if (!scene.cameras.empty()) return;
    const Box3 boundsWS = worldBounds(scene);
    const glm::dvec3 centerWS = boundsWS.empty() ? glm::dvec3(0.0) : 0.5 * (boundsWS.min + boundsWS.max);
    double radiusMetres = boundsWS.empty() ? 0.0 : 0.5 * glm::length(boundsWS.max - boundsWS.min);
    if (!std::isfinite(radiusMetres) || !std::isfinite(glm::length(centerWS))) {
        throw InputError("scene '" + scene.name + "': its bounds are too large for a camera; check the nodes' scales");
    }
    if (radiusMetres == 0.0) radiusMetres = 1.0;

    Camera camera;
    camera.name = kDefaultName;
    camera.fovYRadians = std::numbers::pi / 4.0;
    const double distanceMetres = kDistanceMargin * radiusMetres / std::sin(camera.fovYRadians / 2.0);
    const glm::dvec3 eyeWS = centerWS + distanceMetres * glm::normalize(glm::dvec3(1.0, 0.7, 1.0));
    camera.worldFromCamera = worldFromLookAt(eyeWS, centerWS);
    camera.nearMetres = kNearShare * radiusMetres;
    scene.cameras.push_back(camera);
    scene.warnings.push_back("the scene has no camera: looking at its whole through the camera 'default'");
}

void addDefaultLight(Scene& scene, LoadLedger& ledger) {
    if (!scene.lights.empty() || scene.environment || isAllUnlit(scene)) return;
    scene.environment = loadEnvironment(std::string(kBuiltinPrefix) + kDefaultEnvironment, ledger, scene.warnings);
    // Stands around the camera as it does around that of a scene without one, which looks along longitude -45 degrees.
    const glm::dvec3 forwardWS = -glm::dvec3(viewedCamera(scene).worldFromCamera[2]);
    constexpr double kLevel = 1e-6; // a camera that looks straight up or down has no heading
    if (std::hypot(forwardWS.x, forwardWS.z) > kLevel * glm::length(forwardWS)) {
        const double longitude = glm::degrees(std::atan2(forwardWS.x, -forwardWS.z));
        scene.environment->rotationDegrees = float(std::remainder(-45.0 - longitude, 360.0));
    }
    scene.options.wishes.try_emplace("backdrop", "blurred");
    scene.warnings.emplace_back(kDefaultLightWarning);
}

} // namespace tessera::scenes
