#include <algorithm>

#include <glm/trigonometric.hpp>

#include "scenes/LookAt.h"
#include "scenes/import/SceneJsonFields.h"
#include "scenes/import/SceneJsonLights.h"
#include "scenes/import/SceneJsonNames.h"
#include "scenes/import/SceneJsonTransform.h"

namespace tessera::scenes::scenejson {
namespace {

glm::dmat4 readPlacement(JsonObject& object) {
    if (const auto matrix = object.find("matrix")) {
        for (const char* key : {"position", "target", "direction", "up"})
            if (const auto other = object.find(key)) other->fail("is given beside 'matrix'; keep one");
        const glm::dmat4 worldFromCamera = readMatrix(*matrix);
        if (!isRigid(worldFromCamera)) matrix->fail("a camera's matrix must only rotate and move; remove its scale");
        return worldFromCamera;
    }
    const glm::dvec3 eyeWS = object.require("position").vector3();
    const std::optional<JsonValue> direction = object.find("direction");
    const std::optional<JsonValue> target = object.find("target");
    if (direction && target) target->fail("is given beside 'direction'; keep one");
    glm::dvec3 targetWS = eyeWS;
    if (direction) {
        // The length of the step must not vanish beside a far eye.
        targetWS += direction->direction() * std::max(1.0, glm::length(eyeWS));
    } else {
        targetWS = object.require("target").vector3();
        if (targetWS == eyeWS) target->fail("is the camera's own position; give another point");
    }
    glm::dvec3 upWS(0.0, 1.0, 0.0);
    if (const auto up = object.find("up")) upWS = up->direction();
    return worldFromLookAt(eyeWS, targetWS, upWS);
}

} // namespace

Camera readCamera(const JsonValue& value, std::size_t index) {
    JsonObject object = value.object();
    Camera camera;
    camera.name = fmt::format("camera {}", index);
    std::string type = "perspective";
    if (const auto name = object.find("name")) camera.name = name->text();
    if (const auto projection = object.find("type")) {
        type = projection->text();
        camera.projection = projection->oneOf<Projection>("projection", kProjections);
    }
    camera.worldFromCamera = readPlacement(object);
    if (camera.projection == Projection::Perspective) {
        if (const auto fov = object.find("fovYDegrees")) {
            const double degrees = fov->positive();
            if (degrees >= 180.0) fov->fail(fmt::format("is {}; less than 180 is needed", degrees));
            camera.fovYRadians = glm::radians(degrees);
        }
        if (const auto near = object.find("near")) camera.nearMetres = near->positive();
    } else {
        camera.halfHeightMetres = object.require("halfHeight").positive();
        if (const auto near = object.find("near")) camera.nearMetres = near->number(0.0);
    }
    if (const auto far = object.find("far")) {
        camera.farMetres = far->number();
        if (!(camera.farMetres > camera.nearMetres))
            far->fail(fmt::format("is {}, not beyond the near plane at {}; move it away", camera.farMetres,
                                  camera.nearMetres));
    }
    readFields(object, camera);
    object.done(fmt::format("a {} camera", type));
    return camera;
}

} // namespace tessera::scenes::scenejson
