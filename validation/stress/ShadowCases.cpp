// Shadows with difficult rounding, sizes or counts: contacts, far and tiny scenes, flat casters, lights in surfaces.
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "validation/stress/StressCase.h"
#include "validation/stress/StressRandom.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

frame::FrameSettings shadowedSettings(glm::ivec2 sizePixels = {64, 45}) {
    frame::FrameSettings settings;
    settings.sizePixels = sizePixels;
    settings.display = false;
    settings.shadows = {scenes::ShadowRequest::Kind::All};
    return settings;
}

std::vector<StressPicture> shadowPlaces(StressEffort) {
    std::vector<StressPicture> pictures;
    for (int exponent = -4; exponent <= 4; exponent += 2) {
        pictures.push_back({fmt::format("1e{} times as large", exponent), stressScene(), shadowedSettings()});
        moveScene(pictures.back().scene, std::pow(10.0, exponent), glm::dvec3(0.0));
    }
    for (const double metres : {1e3, 1e6}) {
        pictures.push_back({fmt::format("at {:g} m", metres), stressScene(), shadowedSettings()});
        moveScene(pictures.back().scene, 1.0, glm::dvec3(metres, -metres, metres));
    }
    return pictures;
}

std::vector<StressPicture> shadowLights(StressEffort) {
    std::vector<StressPicture> pictures;
    const auto add = [&](std::string what, const scenes::Light& light) {
        scenes::Scene scene = stressScene();
        scene.lights = {stressLight({0.3, 4.0, 0.2}, 8.0f), light};
        pictures.push_back({std::move(what), std::move(scene), shadowedSettings({65, 45})});
    };
    for (const double metres : {0.0, 1e-6, 1e-3})
        add(fmt::format("{:g} m above the floor", metres), stressLight({0.0, metres, 1.5}, 1e-3f));
    add("below the floor", stressLight({0.0, -1.0, 0.0}, 1.0f));
    add("1e6 m away", stressLight({6e5, 8e5, 0.0}, 1e12f));
    for (const double degrees : {1e-3, 0.1, 1.0, 89.0}) {
        scenes::Light sun = stressLight({}, 1.0f);
        sun.type = scenes::LightType::Directional;
        const double angle = glm::radians(degrees);
        sun.directionWS = {-std::cos(angle), -std::sin(angle), 0.0};
        add(fmt::format("a sun {:g} degrees above the floor", degrees), sun);
    }
    return pictures;
}

/// Replaces the floor by strips, each of two triangles so thin that the cross product of their long edges keeps few
/// digits.
void cutIntoStrips(scenes::Scene& scene, int strips) {
    scenes::Mesh& floor = scene.meshes[std::size_t(scene.nodes[0].instances[0].mesh)];
    floor = {};
    floor.name = "strips";
    for (int i = 0; i <= strips; ++i) {
        const float x = float(4.0 * i / strips - 2.0);
        for (const float z : {-2.0f, 2.0f}) floor.positionsOS.emplace_back(x, 0.0f, z);
    }
    for (std::uint32_t i = 0; i < std::uint32_t(strips); ++i)
        floor.indices.insert(floor.indices.end(), {2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 3, 2 * i + 2, 2 * i});
    floor.normalsOS.assign(floor.positionsOS.size(), glm::vec3(0.0f, 1.0f, 0.0f));
    floor.texCoords[0].assign(floor.positionsOS.size(), glm::vec2(0.0f));
}

std::vector<StressPicture> shadowCasters(StressEffort) {
    const auto scaled = [](double x, double y, double z) { return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z)); };
    const std::pair<const char*, glm::dmat4> changes[] = {{"mirrored", scaled(-1.0, 1.0, 1.0)},
                                                          {"stretched 100:1", scaled(1.0, 0.01, 1.0)},
                                                          {"without area, a line", scaled(1.0, 0.0, 0.0)},
                                                          {"without area, a point", scaled(0.0, 0.0, 0.0)}};
    std::vector<StressPicture> pictures;
    for (const auto& [what, change] : changes) {
        scenes::Scene scene = stressScene();
        // All except the floor, which keeps the image from being empty.
        for (std::size_t i = 1; i < scene.nodes.size(); ++i)
            scene.nodes[i].parentFromNode = scene.nodes[i].parentFromNode * change;
        pictures.push_back({fmt::format("casters {}", what), std::move(scene), shadowedSettings()});
    }
    for (const int strips : {60, 1000}) {
        pictures.push_back({fmt::format("a floor of {} strips", strips), stressScene(), shadowedSettings()});
        cutIntoStrips(pictures.back().scene, strips);
        // Rotated, so that no coordinate is 0.
        scenes::Node& node = pictures.back().scene.nodes[0];
        node.parentFromNode = glm::rotate(node.parentFromNode, 0.3, glm::dvec3(0.0, 1.0, 0.0));
    }
    return pictures;
}

std::vector<StressPicture> shadowTargets(StressEffort) {
    std::vector<StressPicture> pictures;
    for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(8193, 1), glm::ivec2(1, 8193)})
        pictures.push_back({fmt::format("{}x{}", size.x, size.y), stressScene(), shadowedSettings(size)});
    return pictures;
}

/// Lights with short ranges above the floor between the balls.
std::vector<StressPicture> shadowCrowds(StressEffort effort) {
    std::vector<StressPicture> pictures;
    for (const int count : {257, 4097}) {
        if (effort == StressEffort::Quick && count > 1024) continue;
        StressRandom random(43);
        scenes::Scene scene = stressScene();
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 placeWS(random.between(-1.9, 1.9), random.between(0.05, 1.0), random.between(-1.9, 1.9));
            scene.lights.push_back(stressLight(placeWS, 4.0f / float(count)));
            scene.lights.back().rangeMetres = float(random.between(0.2, 0.6));
        }
        pictures.push_back({fmt::format("{} lights with shadows", count), std::move(scene), shadowedSettings()});
    }
    return pictures;
}

std::vector<StressPicture> softShadows(StressEffort) {
    std::vector<StressPicture> pictures;
    for (const float radius : {1e-6f, 0.3f, 1e3f}) {
        StressPicture picture{fmt::format("lights of {:g} m", radius), stressScene(), shadowedSettings()};
        for (scenes::Light& light : picture.scene.lights) light.radiusMetres = radius;
        picture.settings.shadowSamples = 64;
        pictures.push_back(std::move(picture));
    }
    StressPicture inside{"a light in a surface, larger than its distance", stressScene(), shadowedSettings()};
    inside.scene.lights.push_back(stressLight({0.0, 1e-4, 1.5}, 1e-3f));
    inside.scene.lights.back().radiusMetres = 0.5f;
    inside.settings.shadowSamples = 64;
    pictures.push_back(std::move(inside));
    return pictures;
}

} // namespace

void addShadowCases(std::vector<StressCase>& cases) {
    const auto add = [&cases](const char* name, const char* holds, auto pictures) {
        cases.push_back({name, holds, StressBound::WorstRel, kBallTolerance, kBallReason, {}, pictures});
    };
    add("shadow/place", "shadows 1000 km from the origin and in scenes 1e-4 to 1e4 times as large", &shadowPlaces);
    add("shadow/light", "shadows of lights on and below a surface, far away, and of suns that graze it", &shadowLights);
    add("shadow/caster", "shadows of casters that are mirrored, stretched, of thin triangles and without area",
        &shadowCasters);
    add("shadow/target", "shadows in pictures of one pixel and of 8193 in a row", &shadowTargets);
    add("shadow/crowd", "257 and 4097 lights that cast shadows", &shadowCrowds);
    cases.push_back({"shadow/soft",
                     "soft shadows of lights with a radius of 1e-6 to 1000 m, and of one larger than its distance",
                     StressBound::RelMse,
                     1e-2,
                     "64 ways to a light leave 1e-2 of its light as noise, and rings of the reference 2e-3",
                     {},
                     &softShadows});
}

} // namespace tessera::validation
