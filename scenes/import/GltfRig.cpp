#include "scenes/import/GltfRig.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "scenes/Rest.h"

namespace tessera::scenes::gltf {
namespace {

constexpr std::string_view kIdentity = "what is not there counts as the identity";

bool anyMorphs(const std::vector<double>& weights, std::size_t targets) {
    const auto counted = std::span(weights).first(std::min(weights.size(), targets));
    return std::ranges::any_of(counted, [](double weight) { return float(weight) != 0.0f; });
}

} // namespace

Rigging::Rigging(Context& context, Materials& materials, std::vector<int> sceneNodes)
    : context_(context), materials_(materials), sceneNodes_(std::move(sceneNodes)),
      hasAnimatedWeights_(sceneNodes_.size()), isHiddenByClips_(nodesHiddenByClips(context.document.model)) {
    const tiny::Model& model = context.document.model;
    for (const tiny::Mesh& mesh : model.meshes) {
        std::size_t targets = 0;
        for (const tiny::Primitive& primitive : mesh.primitives) targets = std::max(targets, primitive.targets.size());
        targetCounts_.push_back(targets);
        isMorphed_.push_back(anyMorphs(mesh.weights, targets));
    }
    for (const tiny::Animation& animation : model.animations)
        for (const tiny::AnimationChannel& channel : animation.channels)
            if (const auto node = nodeOfWeights(channel); node && *node < hasAnimatedWeights_.size())
                hasAnimatedWeights_[*node] = true;
}

// ---- Deformed meshes -----------------------------------------------------------------------------------------------

std::vector<float> Rigging::restWeights(int index) const {
    const tiny::Model& model = context_.document.model;
    const tiny::Node& node = elementAt(model.nodes, index);
    const tiny::Mesh& mesh = elementAt(model.meshes, node.mesh);
    const std::vector<double>& stated = node.weights.empty() ? mesh.weights : node.weights;
    const std::size_t targets = targetCounts_[std::size_t(node.mesh)];
    std::vector<float> weights(targets, 0.0f);
    std::transform(stated.begin(), stated.begin() + std::ptrdiff_t(std::min(stated.size(), targets)), weights.begin(),
                   [](double weight) { return float(weight); });
    return weights;
}

/// Takes constant time per node: all nodes of a file may show the same large mesh.
Deforms Rigging::deformsOf(int index) const {
    const tiny::Node& node = elementAt(context_.document.model.nodes, index);
    const auto mesh = std::size_t(node.mesh);
    const bool isMorphed = node.weights.empty() ? isMorphed_[mesh] : anyMorphs(node.weights, targetCounts_[mesh]);
    const bool mayMorph = targetCounts_[mesh] > 0 && hasAnimatedWeights_[std::size_t(index)];
    return {isMorphed || mayMorph, node.skin != kNone};
}

const std::vector<Rigging::Drawn>& Rigging::shapesOf(int mesh, Deforms deforms, std::size_t joints) {
    const auto [entry, isNew] = shapes_.try_emplace({mesh, deforms, joints});
    if (!isNew) return entry->second;
    const auto& primitives = elementAt(context_.document.model.meshes, mesh).primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        std::optional<Shape> imported = importPrimitive(context_, mesh, int(i), deforms);
        if (!imported) continue;
        std::vector<Shape>& shapes = context_.scene.rig.shapes;
        const ShownMaterial shown = materials_.shownBy(primitives[i], imported->rest);
        shapes.push_back(std::move(*imported));
        entry->second.push_back({int(shapes.size()) - 1, materials_.material(shown), &primitives[i], shown.lostSets});
    }
    return entry->second;
}

void Rigging::readMatrices(int accessor, int skin, std::vector<glm::dmat4>& jointFromBind) const {
    const Document& document = context_.document;
    const std::string place = fmt::format("/skins/{}/inverseBindMatrices", skin);
    const Elements matrices = context_.accessors.elements(accessor);
    constexpr std::size_t kEntries = 16;
    if (matrices.components != kEntries) document.fail(place, "accessor {} must be of MAT4", accessor);
    if (matrices.count < jointFromBind.size())
        document.repair(place, kIdentity, "accessor {} has {} matrices for {} joints", accessor, matrices.count,
                        jointFromBind.size());
    for (std::size_t joint = 0; joint < std::min(jointFromBind.size(), matrices.count); ++joint) {
        const auto numbers = std::span(matrices.values).subspan(joint * kEntries, kEntries);
        if (!std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); })) {
            document.repair(place, kIdentity, "the matrix of joint {} is not finite", joint);
            continue;
        }
        for (std::size_t i = 0; i < kEntries; ++i) {
            const auto column = glm::length_t(i / 4), row = glm::length_t(i % 4);
            if (row < 3) jointFromBind[joint][column][row] = numbers[i];
        }
    }
}

int Rigging::skinOf(int index) {
    const auto [entry, isNew] = skins_.try_emplace(index, int(context_.scene.rig.skins.size()));
    if (!isNew) return entry->second;
    const Document& document = context_.document;
    const tiny::Skin& stored = elementAt(document.model.skins, index);
    // Includes the matrices of a pose.
    document.charge(stored.joints.size() * (sizeof(int) + sizeof(glm::dmat4) + sizeof(glm::dmat4x3)), "skins", index);
    Skin skin;
    skin.name = nameOr(stored.name, "skin", index);
    for (const int joint : stored.joints) skin.joints.push_back(sceneNodes_[std::size_t(joint)]);
    skin.jointFromBind.assign(skin.joints.size(), glm::dmat4(1.0));
    if (stored.inverseBindMatrices != kNone)
        document.repairs.attempt(kIdentity,
                                 [&] { readMatrices(stored.inverseBindMatrices, index, skin.jointFromBind); });
    context_.scene.rig.skins.push_back(std::move(skin));
    return entry->second;
}

void Rigging::mendInfluences(Shape& shape, int mesh, int skin, std::size_t joints) const {
    if (joints == 0) {
        shape.influences = 0;
        shape.joints.clear();
        shape.weights.clear();
    }
    for (std::size_t first = 0; first < shape.joints.size(); first += shape.influences) {
        float sum = 0.0f;
        for (std::size_t i = first; i < first + shape.influences; ++i) {
            if (shape.weights[i] > 0.0f && shape.joints[i] >= joints) {
                context_.document.repair(fmt::format("/meshes/{}", mesh), "its weight counts as 0",
                                         "vertex {} of mesh '{}' follows joint {}, but /skins/{} has only {}",
                                         first / shape.influences, shape.rest.name, shape.joints[i], skin, joints);
                shape.weights[i] = 0.0f;
            }
            sum += shape.weights[i];
        }
        if (sum > 0.0f) continue;
        shape.joints[first] = 0;
        shape.weights[first] = 1.0f;
    }
}

void Rigging::addDeformed(int index) {
    const Document& document = context_.document;
    const tiny::Node& node = elementAt(document.model.nodes, index);
    Scene& scene = context_.scene;
    const Deforms deforms = deformsOf(index);
    Deformed deformed;
    deformed.node = deformed.standsAt = sceneNodes_[std::size_t(index)];
    if (deforms.byTargets) {
        std::vector<float> rest = restWeights(index);
        // Includes the weights of a pose, in double precision.
        document.charge(2 * sizeof(rest) + rest.size() * (sizeof(float) + sizeof(double)), "nodes", index);
        deformed.weights = weights_[index] = int(scene.rig.weights.size());
        scene.rig.weights.push_back(std::move(rest));
    }
    if (deforms.byJoints) deformed.skin = skinOf(node.skin);
    const std::size_t joints = deformed.skin == kNone ? 0 : scene.rig.skins[std::size_t(deformed.skin)].joints.size();
    for (const Drawn& drawn : shapesOf(node.mesh, deforms, joints)) {
        Shape& shape = scene.rig.shapes[std::size_t(drawn.shape)];
        document.charge(bytesOf(shape.rest) + 2 * (sizeof(Deformed) + sizeof(Standing) + sizeof(Node)), "nodes", index);
        if (deformed.skin != kNone) mendInfluences(shape, node.mesh, node.skin, joints);
        deformed.shape = drawn.shape;
        deformed.mesh = int(scene.meshes.size());
        context_.noteMesh(deformed.mesh, *drawn.primitive, drawn.lostSets);
        scene.meshes.push_back(shape.rest);
        MeshInstance instance;
        instance.mesh = deformed.mesh;
        instance.material = drawn.material;
        if (deforms.byJoints)
            standing_.push_back({scene.rig.deformed.size(), instance});
        else
            scene.nodes[std::size_t(deformed.node)].instances.push_back(instance);
        scene.rig.deformed.push_back(deformed);
    }
}

/// Adds a root node per skinned mesh, which ignores the transforms of its node and ancestors.
void Rigging::addSkinnedNodes() {
    Scene& scene = context_.scene;
    for (const Standing& standing : standing_) {
        Deformed& deformed = scene.rig.deformed[standing.deformed];
        Node node;
        node.name = scene.nodes[std::size_t(deformed.node)].name;
        node.instances.push_back(standing.instance);
        deformed.standsAt = int(scene.nodes.size());
        scene.nodes.push_back(std::move(node));
    }
}

// ---- Lights and cameras --------------------------------------------------------------------------------------------

void Rigging::addLight(int index) {
    const int element = int(context_.scene.lights.size()) - 1;
    carriedLights_.push_back({element, sceneNodes_[std::size_t(index)]});
    lights_[lightOf(elementAt(context_.document.model.nodes, index))].push_back(element);
}

void Rigging::addCamera(int index) {
    const int element = int(context_.scene.cameras.size()) - 1;
    carriedCameras_.push_back({element, sceneNodes_[std::size_t(index)]});
    cameras_[elementAt(context_.document.model.nodes, index).camera].push_back(element);
}

/// Keeps the lights and cameras that a clip may move.
void Rigging::carryAll() {
    Scene& scene = context_.scene;
    std::vector<bool> moves(scene.nodes.size());
    for (const RestNode& rest : scene.rig.nodes) moves[std::size_t(rest.node)] = true;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const int parent = scene.nodes[i].parent;
        if (parent != kNone && moves[std::size_t(parent)]) moves[i] = true;
    }
    const auto keep = [&](const std::vector<Carried>& all, std::vector<Carried>& kept) {
        std::ranges::copy_if(all, std::back_inserter(kept),
                             [&](const Carried& carried) { return bool(moves[std::size_t(carried.node)]); });
    };
    keep(carriedLights_, scene.rig.lights);
    keep(carriedCameras_, scene.rig.cameras);
}

// ---- Visibility ---------------------------------------------------------------------------------------------------

std::vector<bool> nodesHiddenByClips(const tiny::Model& model) {
    std::vector<bool> areHidden(model.nodes.size());
    for (const tiny::Animation& animation : model.animations)
        for (const tiny::AnimationChannel& channel : animation.channels) {
            const std::string changed = changedBy(channel);
            std::string_view path = changed;
            const std::optional<std::size_t> node = cutIndex(path, kNodesPointer);
            if (node && *node < areHidden.size() && path == infoOf(AnimatedProperty::NodeVisibility).path)
                areHidden[*node] = model.nodes[*node].matrix.empty();
        }
    return areHidden;
}

void Rigging::findHiddenLights() {
    const std::vector<Node>& nodes = context_.scene.nodes;
    std::vector<int> hiddenBy(nodes.size(), kNone); // document node, by scene node
    for (std::size_t index = 0; index < sceneNodes_.size(); ++index)
        if (isHiddenByClips_[index] && sceneNodes_[index] != kNone)
            hiddenBy[std::size_t(sceneNodes_[index])] = int(index);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (hiddenBy[i] == kNone && nodes[i].parent != kNone) hiddenBy[i] = hiddenBy[std::size_t(nodes[i].parent)];
    for (const Carried& light : carriedLights_)
        if (const int by = hiddenBy[std::size_t(light.node)]; by != kNone) lightsHidden_[by].push_back(light.element);
}

/// Multiplies the node's scale and the intensity of the lights below, which a scale does not affect.
Rigging::Animated Rigging::visibilityOf(int index) {
    Animated animated{AnimatedProperty::NodeVisibility, 1};
    const glm::vec3 scale(scaleOf(elementAt(context_.document.model.nodes, index)));
    animated.multiplied.push_back({AnimatedProperty::Scale, restNode(index), {scale.x, scale.y, scale.z}});
    for (const int light : lightsHidden_[index])
        animated.multiplied.push_back({AnimatedProperty::LightIntensity,
                                       restNumber(AnimatedProperty::LightIntensity, light),
                                       {context_.scene.lights[std::size_t(light)].intensity}});
    return animated;
}

/// Hides, in the rest pose, invisible nodes that clips may show: they are part of the scene.
void Rigging::hideAtRest() {
    for (const auto& [index, number] : nodes_) {
        if (!isHiddenByClips_[std::size_t(index)] || isVisible(elementAt(context_.document.model.nodes, index)))
            continue;
        context_.scene.rig.nodes[std::size_t(number)].scale = glm::dvec3(0.0);
        for (const int light : lightsHidden_[index]) context_.scene.lights[std::size_t(light)].intensity = 0.0f;
    }
}

void Rigging::finish() {
    addSkinnedNodes();
    findHiddenLights();
    Rig& rig = context_.scene.rig;
    for (std::size_t i = 0; i < context_.document.model.animations.size(); ++i) rig.clips.push_back(clip(int(i)));
    hideAtRest();
    takeRest(context_.scene);
    if (!rig.clips.empty()) rig.playing.push_back(0);
    warnOfMorphless();
    warnOfLeftOut();
    carryAll();
}

} // namespace tessera::scenes::gltf
