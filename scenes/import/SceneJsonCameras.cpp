#include "scenes/import/SceneJsonParts.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/LookAt.h"
#include "scenes/import/SceneJsonFields.h"
#include "scenes/import/SceneJsonNames.h"

namespace tessera::scenes::scenejson {
namespace {

glm::dquat readQuaternion(const JsonValue& value) {
    const std::vector<JsonValue> xyzw = value.elements(4, 4);
    const glm::dquat quaternion(xyzw[3].number(), xyzw[0].number(), xyzw[1].number(), xyzw[2].number()); // w first
    const double length = glm::length(quaternion);
    if (!(length > 0.0) || !std::isfinite(length)) value.fail("has no length; give a unit quaternion x, y, z, w");
    return quaternion / length;
}

glm::dquat readEuler(const JsonValue& value) {
    const glm::dvec3 radians = glm::radians(value.vector3());
    return glm::angleAxis(radians.z, glm::dvec3(0.0, 0.0, 1.0)) * glm::angleAxis(radians.y, glm::dvec3(0.0, 1.0, 0.0)) *
           glm::angleAxis(radians.x, glm::dvec3(1.0, 0.0, 0.0));
}

glm::dmat4 readParts(const JsonValue& value) {
    JsonObject object = value.object();
    glm::dvec3 translationMetres(0.0);
    glm::dvec3 scale(1.0);
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (const auto translation = object.find("translation")) translationMetres = translation->vector3();
    const std::optional<JsonValue> quaternion = object.find("rotation");
    const std::optional<JsonValue> euler = object.find("eulerDegrees");
    if (quaternion && euler) euler->fail("is given beside 'rotation'; keep one");
    if (quaternion) rotation = readQuaternion(*quaternion);
    if (euler) rotation = readEuler(*euler);
    if (const auto factor = object.find("scale")) {
        scale = factor->isNumber() ? glm::dvec3(factor->number()) : factor->vector3();
    }
    object.done("a transform");

    const glm::dmat3 turned = glm::mat3_cast(rotation);
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 3; ++column) matrix[column] = glm::dvec4(turned[column] * scale[column], 0.0);
    matrix[3] = glm::dvec4(translationMetres, 1.0);
    return matrix;
}

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

glm::dmat4 readMatrix(const JsonValue& value) {
    const std::vector<JsonValue> numbers = value.elements(16, 16);
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) matrix[column][row] = numbers[std::size_t(column * 4 + row)].number();
    if (glm::dvec4(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w) != glm::dvec4(0.0, 0.0, 0.0, 1.0))
        value.fail("is not affine: its fourth row, every fourth number, must be 0, 0, 0, 1; write it column by column");
    return matrix;
}

glm::dmat4 readTransform(JsonObject& object) {
    const std::optional<JsonValue> transform = object.find("transform");
    const std::optional<JsonValue> matrix = object.find("matrix");
    if (transform && matrix) matrix->fail("is given beside 'transform'; keep one");
    if (transform) return readParts(*transform);
    if (!matrix) return glm::dmat4(1.0);
    return readMatrix(*matrix);
}

bool isRigid(const glm::dmat4& matrix) {
    constexpr double kTolerance = 1e-3; // what files with a few decimals lose
    const glm::dmat3 rotation(matrix);
    for (int column = 0; column < 3; ++column)
        if (!(std::abs(glm::length(rotation[column]) - 1.0) <= kTolerance)) return false;
    return std::abs(glm::determinant(rotation) - 1.0) <= 3.0 * kTolerance;
}

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
            if (degrees >= 180.0) fov->fail("is {}; less than 180 is needed", degrees);
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
            far->fail("is {}, not beyond the near plane at {}; move it away", camera.farMetres, camera.nearMetres);
    }
    readFields(object, camera);
    object.done(fmt::format("a {} camera", type));
    return camera;
}

} // namespace tessera::scenes::scenejson
