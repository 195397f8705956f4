#pragma once
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {

/// The triangle of tinyScene() with a skin of two joints and a morph target. Its first vertex follows joint `hip`, its
/// second joint `knee`, its third both alike. The clip `bend` turns the knee about z from 0 to 90 degrees and raises
/// the weight of the target, which lifts the third vertex by 1 along z, from 0 to 1 within a second; it doubles the
/// intensity of the light, which the knee carries with the camera.
inline Scene riggedScene() {
    Scene scene = tinyScene();
    scene.name = "rigged";
    scene.lights.emplace_back().name = "lamp";
    scene.cameras.emplace_back().name = "eye";
    const auto addNode = [&](const char* name, int parent, const glm::dvec3& translation) {
        Node& node = scene.nodes.emplace_back();
        node.name = name;
        node.parent = parent;
        node.parentFromNode[3] = glm::dvec4(translation, 1.0);
    };
    addNode("hip", kNone, {0.0, 0.0, 0.0});     // 1
    addNode("knee", 1, {1.0, 0.0, 0.0});        // 2
    addNode("skinned", kNone, {0.0, 0.0, 0.0}); // 3
    scene.nodes[3].instances = std::move(scene.nodes[0].instances);
    scene.nodes[0].instances.clear();

    Rig& rig = scene.rig;
    Shape& shape = rig.shapes.emplace_back();
    shape.rest = scene.meshes[0];
    shape.influences = 4;
    shape.joints = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
    shape.weights = {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
    shape.targets.emplace_back().positionsOS = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    Skin& skin = rig.skins.emplace_back();
    skin.name = "leg";
    skin.joints = {1, 2};
    skin.jointFromBind.assign(2, glm::dmat4(1.0));
    skin.jointFromBind[1][3].x = -1.0;
    rig.nodes.push_back({2, {1.0, 0.0, 0.0}});
    rig.weights.push_back({0.0f});
    rig.numbers.push_back({AnimatedProperty::LightIntensity, 0, glm::vec4(1.0f, 0.0f, 0.0f, 0.0f)});
    rig.deformed.push_back({0, 0, 0, 3, 0, 0});
    rig.lights.push_back({0, 2});
    rig.cameras.push_back({0, 2});
    Clip& clip = rig.clips.emplace_back();
    clip.name = "bend";
    constexpr float kHalf = 0.70710678f;
    clip.samplers = {{Interpolation::Linear, 4, {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0, kHalf, kHalf}},
                     {Interpolation::Linear, 1, {0.0f, 1.0f}, {0, 1}},
                     {Interpolation::Linear, 1, {0.0f, 1.0f}, {1, 2}}};
    clip.channels = {{AnimatedProperty::Rotation, 0, 0},
                     {AnimatedProperty::Weights, 0, 1},
                     {AnimatedProperty::LightIntensity, 0, 2}};
    rig.playing = {0};
    return scene;
}

} // namespace tessera::scenes
