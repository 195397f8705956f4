#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes {

/// One white triangle in the plane z = 0 that faces +Z: the smallest scene that passes checkScene().
inline Scene tinyScene() {
    Scene scene;
    scene.name = "tiny";
    scene.materials.emplace_back().name = "white";
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.name = "triangle";
    mesh.positionsOS = {{0.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}};
    mesh.normalsOS.assign(3, {0.0f, 0.0f, 1.0f});
    mesh.indices = {0, 1, 2};
    Node& node = scene.nodes.emplace_back();
    node.name = "root";
    node.instances.push_back({0, 0});
    return scene;
}

} // namespace tessera::scenes
