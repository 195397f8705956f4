#include "scenes/Pose.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/CheckElement.h"
#include "scenes/Deform.h"
#include "scenes/RigNumbers.h"
#include "scenes/Transform.h"

namespace tessera::scenes {
namespace {

/// By node: its transform into the space of the nearest ancestor that is the parent of a skinned mesh, where joints and
/// meshes meet; without such an ancestor into the world.
std::vector<glm::dmat4x3> modelFromNodes(const Scene& scene) {
    std::vector<bool> holdsModel(scene.nodes.size());
    for (const Deformed& deformed : scene.rig.deformed) {
        const int above = scene.nodes[std::size_t(deformed.standsAt)].parent;
        if (deformed.skin != kNone && above != kNone) holdsModel[std::size_t(above)] = true;
    }
    std::vector<glm::dmat4> modelFromNode;
    modelFromNode.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        const bool begins = node.parent == kNone || holdsModel[std::size_t(node.parent)];
        modelFromNode.push_back(begins ? node.parentFromNode
                                       : modelFromNode[std::size_t(node.parent)] * node.parentFromNode);
    }
    return {modelFromNode.begin(), modelFromNode.end()};
}

void deformAll(Scene& scene, const Pose& pose) {
    if (scene.rig.deformed.empty()) return;
    const std::vector<glm::dmat4x3> modelFromNode = modelFromNodes(scene);
    std::vector<std::vector<glm::dmat4x3>> fromBind(scene.rig.skins.size()); // by skin and joint, filled on demand
    for (const Deformed& deformed : scene.rig.deformed) {
        const Shape& shape = scene.rig.shapes[std::size_t(deformed.shape)];
        Mesh& mesh = scene.meshes[std::size_t(deformed.mesh)];
        std::span<const double> weights;
        if (deformed.weights != kNone) weights = pose.weights[std::size_t(deformed.weights)];
        const auto requireFinite = [&](const glm::dmat4& matrix) {
            const auto areFinite = [](const auto& vectors) {
                return std::ranges::all_of(vectors, [](const auto& vector) { return allFinite(vector); });
            };
            if (!std::isfinite(matrix[3].x) || !areFinite(mesh.positionsOS) ||
                !std::ranges::all_of(mesh.texCoords, areFinite))
                throw InputError(fmt::format("scene '{}': the pose of mesh '{}' is not finite; choose another time or "
                                             "clip",
                                             scene.name, mesh.name));
        };
        if (deformed.skin == kNone) {
            requireFinite(deform(shape, weights, nullptr, mesh));
            continue;
        }
        const Skin& skin = scene.rig.skins[std::size_t(deformed.skin)];
        std::vector<glm::dmat4x3>& ofSkin = fromBind[std::size_t(deformed.skin)];
        for (std::size_t i = ofSkin.size(); i < skin.joints.size(); ++i)
            ofSkin.emplace_back(modelFromNode[std::size_t(skin.joints[i])] * skin.jointFromBind[i]);
        const VertexMatrices matrices{ofSkin, modelFromNode[std::size_t(deformed.node)]};
        glm::dmat4& parentFromNode = scene.nodes[std::size_t(deformed.standsAt)].parentFromNode;
        parentFromNode = deform(shape, weights, &matrices, mesh);
        requireFinite(parentFromNode);
        if (glm::dmat3(modelFromNode[std::size_t(deformed.node)]) == glm::dmat3(0.0)) // hidden with its node
            parentFromNode = glm::dmat4(glm::dmat3(0.0));
    }
}

/// Keeps inner cones within outer ones. If the pose sets both, the outer one stays.
void clampInnerCones(Scene& scene, const Pose& pose) {
    for (const AnimatedProperty cone : {AnimatedProperty::LightInnerCone, AnimatedProperty::LightOuterCone})
        for (std::size_t i = 0; i < scene.rig.numbers.size(); ++i) {
            const RestNumber& rest = scene.rig.numbers[i];
            if (rest.property != cone || rest.element == kNone || !pose.numbers[i]) continue;
            Light& light = scene.lights[std::size_t(rest.element)];
            if (cone == AnimatedProperty::LightInnerCone)
                light.innerConeRadians = std::min(light.innerConeRadians, light.outerConeRadians);
            else
                light.outerConeRadians = std::max(light.outerConeRadians, light.innerConeRadians);
        }
}

/// Keeps far planes beyond near ones.
void separatePlanes(Scene& scene, const Pose& pose) {
    for (std::size_t i = 0; i < scene.rig.numbers.size(); ++i) {
        const RestNumber& rest = scene.rig.numbers[i];
        if (infoOf(rest.property).owner != AnimatedOwner::Camera || rest.element == kNone || !pose.numbers[i]) continue;
        Camera& camera = scene.cameras[std::size_t(rest.element)];
        constexpr double kLeastRatio = 1.0 + 1e-6;
        camera.farMetres = std::max(camera.farMetres, kLeastRatio * camera.nearMetres);
    }
}

} // namespace

Pose poseAt(const Rig& rig, double timeSeconds) {
    Pose pose;
    std::vector<RestNode> nodes = rig.nodes;
    for (const std::vector<float>& rest : rig.weights) pose.weights.emplace_back(rest.begin(), rest.end());
    pose.numbers.resize(rig.numbers.size());
    std::vector<double> value;
    for (const int number : rig.playing) {
        const Clip& clip = rig.clips[std::size_t(number)];
        for (const AnimationChannel& channel : clip.channels) {
            const AnimationSampler& sampler = clip.samplers[std::size_t(channel.sampler)];
            value.resize(std::size_t(sampler.width));
            valueAt(sampler, channel.property == AnimatedProperty::Rotation, timeSeconds, value);
            if (channel.factor != kNone) {
                double factor = 1.0;
                valueAt(clip.samplers[std::size_t(channel.factor)], false, timeSeconds, std::span(&factor, 1));
                for (double& one : value) one *= factor;
            }
            const auto target = std::size_t(channel.target);
            switch (channel.property) {
            case AnimatedProperty::Translation:
                nodes[target].translation = {value[0], value[1], value[2]};
                break;
            case AnimatedProperty::Rotation:
                nodes[target].rotation = {value[0], value[1], value[2], value[3]};
                break;
            case AnimatedProperty::Scale:
                nodes[target].scale = {value[0], value[1], value[2]};
                break;
            case AnimatedProperty::Weights:
                pose.weights[target] = value;
                break;
            default:
                glm::dvec4& changed = pose.numbers[target].emplace(0.0);
                for (std::size_t i = 0; i < value.size(); ++i) changed[glm::length_t(i)] = value[i];
            }
        }
    }
    for (const RestNode& node : nodes)
        pose.parentFromNode.push_back(transformOf(node.translation, node.rotation, node.scale));
    return pose;
}

void applyPose(Scene& scene, const Pose& pose) {
    const Rig& rig = scene.rig;
    for (std::size_t i = 0; i < rig.nodes.size(); ++i)
        scene.nodes[std::size_t(rig.nodes[i].node)].parentFromNode = pose.parentFromNode[i];
    for (std::size_t i = 0; i < rig.numbers.size(); ++i) {
        const RestNumber& rest = rig.numbers[i];
        const std::optional<glm::dvec4>& number = pose.numbers[i];
        if (rest.element == kNone || !number) continue;
        useOwner(scene, rest, [&](auto& owner) { setPosed(owner, infoOf(rest.property), *number); });
    }
    clampInnerCones(scene, pose);
    separatePlanes(scene, pose);
    deformAll(scene, pose);
    if (!rig.lights.empty() || !rig.cameras.empty()) {
        const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
        for (const Carried& carried : rig.lights)
            placeAtNode(scene.lights[std::size_t(carried.element)], worldFromNode[std::size_t(carried.node)]);
        for (const Carried& carried : rig.cameras) {
            bool isDegenerate = false;
            scene.cameras[std::size_t(carried.element)].worldFromCamera =
                rigidOf(worldFromNode[std::size_t(carried.node)], isDegenerate);
        }
    }
    checkPlaces(scene);
}

bool hasPoses(const Scene& scene) {
    return !scene.rig.clips.empty() || !scene.rig.deformed.empty();
}

void poseScene(Scene& scene, double timeSeconds) {
    if (hasPoses(scene)) applyPose(scene, poseAt(scene.rig, timeSeconds));
}

} // namespace tessera::scenes
