#include "scenes/import/SceneJsonParts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/ranges.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/AreaLight.h"
#include "scenes/LookAt.h"
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
        // The step must not vanish by rounding at a far eye.
        targetWS += direction->direction() * std::max(1.0, glm::length(eyeWS));
    } else {
        targetWS = object.require("target").vector3();
        if (targetWS == eyeWS) target->fail("is the camera's own position; give another point");
    }
    glm::dvec3 upWS(0.0, 1.0, 0.0);
    if (const auto up = object.find("up")) upWS = up->direction();
    return worldFromLookAt(eyeWS, targetWS, upWS);
}

LightType readType(const JsonValue& value) {
    const std::string name = value.text();
    if (name == "area") {
        std::vector<std::string_view> areas;
        for (const LightTypeInfo& info : lightTypes())
            if (info.isArea) areas.push_back(info.name);
        value.fail("'area' names no shape; types of area lights are {}", fmt::join(areas, ", "));
    }
    if (name == "environment")
        value.fail("light from everywhere is no light of this list; give the document a key 'environment'");
    return value.oneOf<LightType>("light type", kLightTypes);
}

float readCoefficient(JsonObject& object, std::string_view key) {
    const std::optional<JsonValue> value = object.find(key);
    if (!value) return 0.0f;
    if (value->number() < 0.0)
        value->fail("the attenuation coefficient {} is {}; it must not be negative", key, value->number());
    return value->single();
}

void readFalloff(const JsonValue& value, Light& light) {
    JsonObject object = value.object();
    const JsonValue type = object.require("type");
    light.falloff = type.oneOf<Falloff>("falloff", kFalloffs);
    const LightTypeInfo& info = infoOf(light.type);
    if (info.isArea && light.falloff != Falloff::InverseSquare)
        type.fail("a {} light has no falloff '{}', since its shape decides how its light falls off; "
                  "inverse_square may end it by a range",
                  info.name, type.text());
    if (light.falloff == Falloff::InverseSquare) {
        if (const auto range = object.find("range")) light.rangeMetres = range->single(0.0);
        object.done("an inverse_square falloff");
        return;
    }
    light.attenuation = {readCoefficient(object, "A"), readCoefficient(object, "B"), readCoefficient(object, "C")};
    object.done("an attenuation falloff");
    if (light.attenuation == glm::vec3(0.0f))
        value.fail("the attenuation coefficients A, B and C are all 0, which divides by 0; give at least one above 0");
}

std::vector<glm::dvec3> readPoints(const JsonValue& value, std::size_t least) {
    std::vector<glm::dvec3> points;
    for (const JsonValue& point : value.elements(least)) points.push_back(point.vector3());
    return points;
}

/// Reads a key's value, or its tangent: the change per second.
glm::dvec3 readKey(const JsonValue& value, const LightKeyedInfo& member, bool isTangent) {
    if (member.isOnSphere && !isTangent) return value.direction();
    if (member.member == LightKeyed::Position || isTangent)
        return member.width() == 3 ? value.vector3() : glm::dvec3(value.number(), 0.0, 0.0);
    if (member.width() == 1) return {value.number(0.0, kAnyNumber), 0.0, 0.0};
    const std::vector<JsonValue> channels = value.elements(3, 3);
    return {channels[0].number(0.0, kAnyNumber), channels[1].number(0.0, kAnyNumber),
            channels[2].number(0.0, kAnyNumber)};
}

/// `valuesKey`: the key of the values in the object.
LightKeys readKeys(JsonObject& object, LightKeyed of, const char* valuesKey) {
    LightKeys keys;
    keys.of = of;
    const JsonValue times = object.require("times");
    for (const JsonValue& time : times.elements(1)) {
        keys.timesSeconds.push_back(time.number());
        const std::size_t count = keys.timesSeconds.size();
        if (count > 1 && !(keys.timesSeconds[count - 1] > keys.timesSeconds[count - 2]))
            time.fail("is {}, which does not follow {}; times must ascend", keys.timesSeconds[count - 1],
                      keys.timesSeconds[count - 2]);
    }
    const auto readByKey = [&](const char* key, bool isTangent) {
        const JsonValue value = object.require(key);
        std::vector<glm::dvec3> values;
        for (const JsonValue& element : value.elements(1)) values.push_back(readKey(element, infoOf(of), isTangent));
        if (values.size() != keys.timesSeconds.size())
            value.fail("has {} elements for {} times; give one for each", values.size(), keys.timesSeconds.size());
        return values;
    };
    keys.values = readByKey(valuesKey, false);
    if (const auto interpolation = object.find("interpolation"))
        keys.interpolation = interpolation->oneOf<Interpolation>("interpolation", kInterpolations);
    if (keys.interpolation == Interpolation::CubicSpline) {
        keys.inTangents = readByKey("inTangents", true);
        keys.outTangents = readByKey("outTangents", true);
    }
    if (const auto repeat = object.find("repeat")) keys.repeat = repeat->oneOf<KeyRepeat>("repeat", kKeyRepeats);
    return keys;
}

/// Reads keyframes of the members of the light's type, except the position, which "animation" moves.
std::vector<LightKeys> readKeyframes(const JsonValue& value, const LightTypeInfo& type) {
    JsonObject object = value.object();
    std::vector<LightKeys> all;
    for (const LightKeyedInfo& member : keyedMembers()) {
        if (member.member == LightKeyed::Position || !member.isOf(type)) continue;
        const auto keys = object.find(member.name);
        if (!keys) continue;
        JsonObject ofMember = keys->object();
        all.push_back(readKeys(ofMember, member.member, "values"));
        ofMember.done(fmt::format("an object of keys of {}", member.name));
    }
    object.done(fmt::format("an object of keyframes of a {} light", type.name));
    return all;
}

LightAnimation readAnimation(const JsonValue& value, const Light& light) {
    JsonObject object = value.object();
    LightAnimation animation;
    const JsonValue type = object.require("type");
    animation.kind = type.oneOf<LightAnimationKind>("animation", kAnimations);
    if (animation.kind == LightAnimationKind::Keyframes) {
        animation.keys = readKeys(object, LightKeyed::Position, "points");
    } else {
        animation.periodSeconds = object.require("periodSeconds").positive();
        if (const auto phase = object.find("phase")) animation.phase = phase->number(0.0, 1.0);
    }
    if (animation.kind == LightAnimationKind::Orbit) {
        if (const auto center = object.find("center")) animation.centerWS = center->vector3();
        if (const auto axis = object.find("axis")) animation.axisWS = axis->direction();
    } else if (animation.kind == LightAnimationKind::Wobble) {
        animation.amplitudeMetres = object.require("amplitude").vector3();
    } else if (animation.kind == LightAnimationKind::Path) {
        const JsonValue points = object.require("points");
        animation.pointsWS = readPoints(points, 2);
        if (!hasLength(animation)) points.fail("are all one place, and a path needs a length; move one of them");
        if (const auto line = object.find("line")) animation.line = line->oneOf<PathLine>("line of a path", kPathLines);
        if (const auto open = object.find("open")) animation.isOpen = open->boolean();
        if (const auto ahead = object.find("lookAhead")) {
            animation.looksAhead = ahead->boolean();
            if (animation.looksAhead && !infoOf(light.type).hasDirection)
                ahead->fail("a {} light has no direction; leave this out", infoOf(light.type).name);
            if (animation.looksAhead && hasKeys(light, LightKeyed::Direction))
                ahead->fail("the light's direction has keyframes; keep one of both");
        }
    }
    object.done(fmt::format("a {} animation", type.text()));
    return animation;
}

void readDirection(JsonObject& object, Light& light) {
    const std::optional<JsonValue> direction = object.find("direction");
    const std::optional<JsonValue> target = infoOf(light.type).hasPosition() ? object.find("target") : std::nullopt;
    if (direction && target) target->fail("is given beside 'direction'; keep one");
    if (target) {
        const glm::dvec3 toTargetWS = target->vector3() - light.positionWS;
        if (toTargetWS == glm::dvec3(0.0)) target->fail("is the light's own position; give another point");
        light.directionWS = glm::normalize(toTargetWS);
    } else {
        light.directionWS = object.require("direction").direction();
    }
}

void readAlong(JsonObject& object, Light& light) {
    light.alongWS = usualAlong(light.directionWS);
    const auto along = object.find("along");
    if (!along) return;
    const std::optional<glm::dvec3> across = acrossFrom(light.directionWS, along->direction());
    if (!across) {
        const glm::dvec3 given = along->vector3();
        along->fail("is ({:g}, {:g}, {:g}), which runs along the light's direction; give a vector across it", given.x,
                    given.y, given.z);
    }
    light.alongWS = *across;
}

void readCorners(JsonObject& object, Light& light) {
    const JsonValue corners = object.require("corners");
    light.corners.count = 0;
    for (const JsonValue& corner : corners.elements(LightCorners::kLeast, LightCorners::kMost))
        light.corners.add(corner.vector2());
    const std::string problem = cornersProblem(light.corners);
    if (!problem.empty()) corners.fail(problem);
}

void readParameter(JsonObject& object, const LightParameter& parameter, Light& light) {
    const auto value = object.find(parameter.key);
    if (!value) return;
    const float number = value->single(parameter.least, parameter.most);
    light.*parameter.member = parameter.kind == LightParameter::Kind::Angle ? glm::radians(number) : number;
}

void readParameters(JsonObject& object, Light& light) {
    const std::span<const LightParameter> parameters = infoOf(light.type).parameters;
    for (const LightParameter& parameter : parameters) readParameter(object, parameter, light);
    for (const LightParameter& parameter : parameters) {
        if (parameter.within == nullptr || !(light.*parameter.member > light.*parameter.within)) continue;
        if (const auto value = object.find(parameter.key))
            value->fail("is {}, wider than {} of {} degrees; make it narrower", value->number(),
                        fieldOf(kLightFields, parameter.within).what, glm::degrees(light.*parameter.within));
    }
}

LightFlicker readFlicker(const JsonValue& value) {
    JsonObject object = value.object();
    LightFlicker flicker;
    if (const auto amplitude = object.find("amplitude")) flicker.amplitude = amplitude->number(0.0, 1.0);
    if (const auto frequency = object.find("frequencyHz")) {
        flicker.frequencyHz = frequency->positive();
        if (flicker.frequencyHz > LightFlicker::kMostHertz)
            frequency->fail("is {}; at most {} is allowed", flicker.frequencyHz, LightFlicker::kMostHertz);
    }
    if (const auto seed = object.find("seed")) flicker.seed = seed->integer(0, std::numeric_limits<int>::max());
    object.done("a flicker");
    return flicker;
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
    constexpr double kTolerance = 1e-3; // rounding in files with a few decimals
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

Light readLight(const JsonValue& value, std::size_t index) {
    return readLight(value, index, [](const JsonValue& fileName) -> LightTexture {
        fileName.fail("names a file where none is read; remove it");
    });
}

Light readLight(const JsonValue& value, std::size_t index, const ReadLightTexture& readTexture) {
    JsonObject object = value.object();
    Light light;
    const JsonValue type = object.require("type");
    light.type = readType(type);
    light.name = fmt::format("light {}", index);
    if (const auto name = object.find("name")) light.name = name->text();
    if (const auto enabled = object.find("enabled")) light.enabled = enabled->boolean();
    if (const auto color = object.find("color")) light.color = color->color();
    if (const auto intensity = object.find("intensity")) light.intensity = intensity->single(0.0);
    if (const auto flicker = object.find("flicker")) light.flicker = readFlicker(*flicker);
    const LightTypeInfo& info = infoOf(light.type);
    if (const auto keyframes = object.find("keyframes")) light.keyframes = readKeyframes(*keyframes, info);
    if (info.hasPosition()) {
        light.positionWS = object.require("position").vector3();
        if (const auto falloff = object.find("falloff")) readFalloff(*falloff, light);
        if (const auto animation = object.find("animation")) light.animation = readAnimation(*animation, light);
    }
    if (info.hasDirection) readDirection(object, light);
    if (info.isTurned()) readAlong(object, light);
    if (info.hasCorners()) readCorners(object, light);
    readParameters(object, light);
    if (info.isFlat) {
        if (const auto twoSided = object.find("twoSided")) light.isTwoSided = twoSided->boolean();
    }
    if (info.isArea) {
        if (const auto seen = object.find("seen")) light.isSeen = seen->boolean();
    }
    std::optional<JsonValue> texture;
    if (info.isFlat)
        texture = object.find("texture");
    else if (info.isArea && object.has("texture"))
        object.require("texture").fail(
            "a {} light has no texture: a picture has no one way to lie around it; rectangles, disks and polygons take "
            "one",
            info.name);
    if (const auto casts = object.find("castsShadow")) light.castsShadow = casts->boolean();
    if (const LightParameter* size = sizeParameter(info)) {
        if (info.isArea) object.require(size->key);
        readParameter(object, *size, light);
    }
    readFields(object, light);
    object.done(fmt::format("a {} light", type.text()));
    // Last, because an image takes long to read and the rest may be wrong.
    if (texture) light.texture = readTexture(*texture);
    return light;
}

} // namespace tessera::scenes::scenejson
