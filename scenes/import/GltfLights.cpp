#include "scenes/import/GltfLights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace tessera::scenes::gltf {
namespace {

/// Those of KHR_lights_punctual, which alone the file's check lets through, are called as the table calls them.
LightType typeOf(const std::string& name) {
    const std::span<const LightTypeInfo> types = lightTypes();
    return std::ranges::find(types, name, &LightTypeInfo::name)->type;
}

void setCones(Context& context, const tinygltf::Light& stored, const std::string& place, Light& light) {
    const double inner = stored.spot.innerConeAngle;
    const double outer = stored.spot.outerConeAngle;
    // Exporters round pi/2 up to float; a millionth of a radian is more than that and less than anything visible.
    constexpr double kRoundingRadians = 1e-6;
    if (!(inner < outer) || outer > std::numbers::pi / 2.0 + kRoundingRadians)
        context.document.fail(place + "/spot",
                              fmt::format("has innerConeAngle {} and outerConeAngle {}; needed is 0 <= inner < "
                                          "outer <= pi/2 radians",
                                          inner, outer));
    light.innerConeRadians = static_cast<float>(inner);
    light.outerConeRadians = static_cast<float>(outer);
}

} // namespace

void importLight(Context& context, int nodeIndex, const glm::dmat4& worldFromNode) {
    const tinygltf::Node& node = context.document.model.nodes[static_cast<std::size_t>(nodeIndex)];
    const tinygltf::Value* extension = findExtension(node.extensions, "KHR_lights_punctual");
    if (extension == nullptr) return;
    const int index = extension->Get("light").GetNumberAsInt();
    const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
    const tinygltf::Light& stored = context.document.model.lights[static_cast<std::size_t>(index)];

    Light light;
    light.name = nameOr(stored.name, "light", index);
    light.type = typeOf(stored.type);
    if (stored.color.size() == 3) light.color = glm::vec3(stored.color[0], stored.color[1], stored.color[2]);
    light.intensity = static_cast<float>(stored.intensity);
    light.falloff = Falloff::InverseSquare;
    light.positionWS = glm::dvec3(worldFromNode[3]);
    const glm::dvec3 backwardsWS(worldFromNode[2]);
    const double length = glm::length(backwardsWS);
    if (length > 0.0)
        light.directionWS = -backwardsWS / length;
    else if (infoOf(light.type).hasDirection)
        context.warn(fmt::format("/nodes/{}: its scale of zero leaves light '{}' no direction; -Z is used", nodeIndex,
                                 light.name));

    const nlohmann::json& written =
        context.document.json["extensions"]["KHR_lights_punctual"]["lights"][static_cast<std::size_t>(index)];
    if (written.contains("range") && infoOf(light.type).hasPosition()) {
        light.rangeMetres = static_cast<float>(stored.range);
        if (!(light.rangeMetres > 0.0f))
            context.document.fail(place + "/range", "must be greater than 0; leave it out for infinite");
    }
    if (light.type == LightType::Spot) setCones(context, stored, place, light);
    context.scene.lights.push_back(std::move(light));
}

} // namespace tessera::scenes::gltf
