#include "scenes/CameraChange.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "base/Error.h"
#include "scenes/Direction.h"
#include "scenes/Limits.h"
#include "scenes/LookAt.h"

namespace tessera::scenes {
namespace {

[[noreturn]] void fail(const Camera& camera, const std::string& what) {
    throw InputError(fmt::format("camera '{}': {}", camera.name, what));
}

bool isFinite(const glm::dvec3& vector) {
    return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

void requireFinite(const Camera& camera, const std::optional<glm::dvec3>& vector, std::string_view what) {
    if (vector && !isFinite(*vector)) fail(camera, fmt::format("its {} is not finite; give other numbers", what));
}

void requirePositive(const Camera& camera, const std::optional<double>& number, std::string_view what) {
    if (number && !(*number > 0.0 && std::isfinite(*number)))
        fail(camera, fmt::format("its {} would be {}; more than 0 is needed", what, *number));
}

void place(Camera& camera, const CameraChange& change) {
    const glm::dmat4& old = camera.worldFromCamera;
    if (!change.targetWS && !change.upWS) {
        if (change.eyeWS) camera.worldFromCamera[3] = glm::dvec4(*change.eyeWS, 1.0);
        return;
    }
    const glm::dvec3 eyeWS = change.eyeWS.value_or(glm::dvec3(old[3]));
    // The step scales with the eye's distance, so that rounding does not absorb it.
    const glm::dvec3 aheadWS = eyeWS - glm::dvec3(old[2]) * std::max(1.0, glm::length(eyeWS));
    const glm::dvec3 targetWS = change.targetWS.value_or(aheadWS);
    if (!(glm::distance(eyeWS, targetWS) > 0.0)) fail(camera, "it cannot look at its own place; give another target");
    glm::dvec3 upWS(0.0, 1.0, 0.0);
    if (change.upWS) {
        const std::optional<glm::dvec3> direction = directionOf(*change.upWS);
        if (!direction) fail(camera, "its up has no length; give a direction");
        upWS = *direction;
    }
    camera.worldFromCamera = worldFromLookAt(eyeWS, targetWS, upWS);
}

} // namespace

Camera changedCamera(Camera camera, const CameraChange& change) {
    const bool isPerspective = camera.projection == Projection::Perspective;
    requireFinite(camera, change.eyeWS, "eye");
    requireFinite(camera, change.targetWS, "target");
    requireFinite(camera, change.upWS, "up");
    if (change.fovYDegrees && !isPerspective)
        fail(camera, "it is orthographic and has no field of view; give a half height");
    if (change.halfHeightMetres && isPerspective)
        fail(camera, "it is a perspective camera and has no half height; give a field of view");
    requirePositive(camera, change.fovYDegrees, "field of view");
    requirePositive(camera, change.halfHeightMetres, "half height");
    place(camera, change);
    if (change.fovYDegrees) {
        if (*change.fovYDegrees >= 180.0)
            fail(camera,
                 fmt::format("its field of view would be {} degrees; less than 180 is needed", *change.fovYDegrees));
        camera.fovYRadians = glm::radians(*change.fovYDegrees);
    }
    if (change.halfHeightMetres) camera.halfHeightMetres = *change.halfHeightMetres;
    // The near plane of an orthographic camera may be at the eye.
    if (isPerspective || (change.nearMetres && *change.nearMetres != 0.0))
        requirePositive(camera, change.nearMetres, "near plane");
    if (change.nearMetres) camera.nearMetres = *change.nearMetres;
    if (change.farMetres) camera.farMetres = *change.farMetres;
    if (!(camera.farMetres > camera.nearMetres))
        fail(camera, fmt::format("its far plane would be at {}, not beyond the near one at {}; move one of them",
                                 camera.farMetres, camera.nearMetres));
    if (const std::string problem = limitProblem(camera); !problem.empty()) fail(camera, problem);
    return camera;
}

} // namespace tessera::scenes
