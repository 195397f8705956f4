#include <cmath>

#include "scenes/AreaLight.h"
#include "scenes/Shadows.h"
#include "scenes/import/SceneJsonNames.h"
#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "scenes/write/WithFields.h"

namespace tessera::scenes::write {
namespace {

Json falloffJson(const Light& light) {
    Json json;
    json["type"] = scenejson::nameOf(light.falloff);
    if (light.falloff == Falloff::InverseSquare) {
        if (!std::isinf(light.rangeMetres)) json["range"] = number(light.rangeMetres);
    } else {
        json["A"] = number(light.attenuation.x);
        json["B"] = number(light.attenuation.y);
        json["C"] = number(light.attenuation.z);
    }
    return json;
}

Json pointsJson(const std::vector<glm::dvec3>& points) {
    Json json = Json::array();
    for (const glm::dvec3& point : points) json.push_back(numbers(point));
    return json;
}

Json cornersJson(const LightCorners& corners) {
    Json json = Json::array();
    for (const glm::vec2& corner : corners.all()) json.push_back(numbers(corner));
    return json;
}

Json valuesJson(const std::vector<glm::dvec3>& values, const LightKeyedInfo& member) {
    if (member.width() == 3) return pointsJson(values);
    Json json = Json::array();
    for (const glm::dvec3& value : values) json.push_back(number(value.x));
    return json;
}

Json keysJson(const LightKeys& keys, const char* valuesKey) {
    const LightKeyedInfo& member = infoOf(keys.of);
    Json json;
    json["times"] = keys.timesSeconds;
    json[valuesKey] = valuesJson(keys.values, member);
    if (keys.interpolation != Interpolation::Linear) json["interpolation"] = scenejson::nameOf(keys.interpolation);
    if (keys.interpolation == Interpolation::CubicSpline) {
        json["inTangents"] = valuesJson(keys.inTangents, member);
        json["outTangents"] = valuesJson(keys.outTangents, member);
    }
    if (keys.repeat != KeyRepeat::Once) json["repeat"] = scenejson::nameOf(keys.repeat);
    return json;
}

Json animationJson(const Light& light) {
    const LightAnimation& animation = *light.animation;
    Json json;
    json["type"] = scenejson::nameOf(animation.kind);
    switch (animation.kind) {
    case LightAnimationKind::Orbit:
        json["center"] = numbers(animation.centerWS);
        json["axis"] = numbers(animation.axisWS);
        break;
    case LightAnimationKind::Wobble:
        json["amplitude"] = numbers(animation.amplitudeMetres);
        break;
    case LightAnimationKind::Path:
        json["points"] = pointsJson(animation.pointsWS);
        if (animation.line != PathLine::Straight) json["line"] = scenejson::nameOf(animation.line);
        if (animation.isOpen) json["open"] = true;
        if (animation.looksAhead && infoOf(light.type).hasDirection && !hasKeys(light, LightKeyed::Direction))
            json["lookAhead"] = true;
        break;
    case LightAnimationKind::Keyframes:
        json.update(keysJson(animation.keys, "points"));
        return json;
    }
    json["periodSeconds"] = number(animation.periodSeconds);
    if (animation.phase != 0.0) json["phase"] = number(animation.phase);
    return json;
}

Json byKeys(const Light& light, const std::string& texture) {
    Json json;
    if (!light.name.empty()) json["name"] = light.name;
    json["type"] = scenejson::nameOf(light.type);
    if (!light.enabled) json["enabled"] = false;
    json["color"] = numbers(light.color);
    json["intensity"] = number(light.intensity);
    if (light.flicker)
        json["flicker"] = {{"amplitude", number(light.flicker->amplitude)},
                           {"frequencyHz", number(light.flicker->frequencyHz)},
                           {"seed", light.flicker->seed}};
    const LightTypeInfo& info = infoOf(light.type);
    for (const LightKeys& keys : light.keyframes)
        if (infoOf(keys.of).isOf(info)) json["keyframes"][std::string(infoOf(keys.of).name)] = keysJson(keys, "values");
    if (info.hasPosition()) {
        json["position"] = numbers(light.positionWS);
        const bool isDefault = light.falloff == Falloff::InverseSquare && std::isinf(light.rangeMetres);
        if (!isDefault) json["falloff"] = falloffJson(light);
        if (light.animation) json["animation"] = animationJson(light);
    }
    if (info.hasDirection) json["direction"] = numbers(light.directionWS);
    if (info.isTurned() && light.alongWS != usualAlong(light.directionWS)) json["along"] = numbers(light.alongWS);
    if (info.hasCorners()) json["corners"] = cornersJson(light.corners);
    const auto write = [&](const LightParameter& parameter) {
        const float value = light.*parameter.member;
        json[parameter.key] = parameter.kind == LightParameter::Kind::Angle ? degreesOf(value) : number(value);
    };
    for (const LightParameter& parameter : info.parameters) write(parameter);
    if (info.isFlat && light.isTwoSided) json["twoSided"] = true;
    if (info.isArea && !light.isSeen) json["seen"] = false;
    if (info.isFlat && light.texture) json["texture"] = texture;
    if (light.castsShadow) json["castsShadow"] = true;
    if (const LightParameter* size = sizeParameter(info); size != nullptr && (info.isArea || hasSize(light)))
        write(*size);
    return json;
}

} // namespace

Json lightJson(const Light& all, const std::string& texture) {
    Light light = all;
    if (!infoOf(light.type).isFlat) light.texture = {};
    Json least = {{"name", "light"}, {"type", "point"}, {"position", {0, 0, 0}}};
    if (light.texture) least.update({{"type", "rectangle"}, {"direction", {0, 0, -1}}, {"texture", texture}});
    return withFields(light, byKeys(light, texture), least, [&](const JsonValue& value) {
        return scenejson::readLight(value, 0, [&](const JsonValue&) { return light.texture; });
    });
}

} // namespace tessera::scenes::write
