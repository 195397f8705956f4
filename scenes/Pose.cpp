#include "scenes/Pose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Names.h"
#include "scenes/CheckElement.h"
#include "scenes/Deform.h"
#include "scenes/Transform.h"

namespace tessera::scenes {
namespace {

/// Every node's transform into the space of the node that skinned meshes stand below, of those that are in one: there
/// joints and meshes meet. Elsewhere into the world.
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
    std::vector<std::vector<glm::dmat4x3>> fromBind(scene.rig.skins.size()); // by skin and joint, where one was needed
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
    }
}

/// Writes numbers into a member of `owner` if it has that member, each component by way of `bounded`.
template <typename Owner>
void setMember(Owner& owner, const AnimatedMember& member, const glm::dvec4& number, const auto& bounded) {
    std::visit(
        [&](auto memberOfAny) {
            if constexpr (requires { owner.*memberOfAny; }) {
                auto& value = owner.*memberOfAny;
                using Value = std::decay_t<decltype(value)>;
                if constexpr (std::is_floating_point_v<Value>)
                    value = Value(bounded(memberOfAny, number.x));
                else
                    for (glm::length_t i = 0; i < value.length(); ++i)
                        value[i] = float(bounded(memberOfAny, number[i]));
            }
        },
        member);
}

/// What a clip says. Splines go past their keys; a member that has bounds stays within them, and no other number of a
/// light or material is negative.
template <typename Owner>
void setPosed(Owner& owner, const AnimatedPropertyInfo& info, const glm::dvec4& number) {
    setMember(owner, info.member, number, [&](auto member, double value) {
        double least = info.least, most = info.most;
        const auto narrow = [&](const auto& field) {
            least = std::max(least, field.what != nullptr ? field.least : 0.0);
            if (field.what != nullptr) most = std::min(most, field.most);
        };
        if constexpr (std::is_same_v<Owner, Light>) narrow(fieldOf(kLightFields, member));
        if constexpr (std::is_same_v<Owner, Material>) narrow(fieldOf(kMaterialFields, member));
        value = std::clamp(value, least, most);
        return std::isinf(value) ? value : std::clamp(value, -kAnyNumber, kAnyNumber); // a range may be infinite
    });
}

/// What it is by itself, which keeps to its bounds.
void setRest(auto& owner, const RestNumber& rest) {
    setMember(owner, infoOf(rest.property).member, rest.number, [](auto, double value) { return value; });
}

/// Calls `use` with what of a material has a number at rest: the material, or its use of a texture.
void usePartOf(auto& material, const RestNumber& rest, const auto& use) {
    if (rest.slot == TextureSlot::Count)
        use(material);
    else
        use(material.texture(rest.slot).transform);
}

/// Calls `use` with the part of a scene that a number at rest, of an element that is there, belongs to.
void useOwner(auto& scene, const RestNumber& rest, const auto& use) {
    const auto element = std::size_t(rest.element);
    switch (infoOf(rest.property).owner) {
    case AnimatedOwner::Light:
        return use(scene.lights[element]);
    case AnimatedOwner::Material:
    case AnimatedOwner::Texture:
        return usePartOf(scene.materials[element], rest, use);
    case AnimatedOwner::Camera:
        return use(scene.cameras[element]);
    case AnimatedOwner::Node:
    case AnimatedOwner::Weights:
        return; // have lists of their own
    }
}

/// Lets no inner cone be wider than its outer one. What the pose says of the outer one counts where it says both.
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

/// Lets every far plane lie beyond the near one.
void separatePlanes(Scene& scene, const Pose& pose) {
    for (std::size_t i = 0; i < scene.rig.numbers.size(); ++i) {
        const RestNumber& rest = scene.rig.numbers[i];
        if (infoOf(rest.property).owner != AnimatedOwner::Camera || rest.element == kNone || !pose.numbers[i]) continue;
        Camera& camera = scene.cameras[std::size_t(rest.element)];
        constexpr double kLeastRatio = 1.0 + 1e-6;
        camera.farMetres = std::max(camera.farMetres, kLeastRatio * camera.nearMetres);
    }
}

/// Calls `use` for each number at rest that a clip which plays changes, where what has it is still there.
void forEachPlayed(const Rig& rig, const auto& use) {
    std::vector<bool> isPlayed(rig.numbers.size());
    for (const int playing : rig.playing)
        for (const AnimationChannel& channel : rig.clips[std::size_t(playing)].channels)
            if (ownsNumbers(infoOf(channel.property).owner)) isPlayed[std::size_t(channel.target)] = true;
    for (std::size_t i = 0; i < isPlayed.size(); ++i)
        if (isPlayed[i] && rig.numbers[i].element != kNone) use(rig.numbers[i]);
}

bool isOf(const RestNumber& rest, std::size_t material) {
    return isOfMaterial(infoOf(rest.property).owner) && rest.element == int(material);
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

void takeRest(Scene& scene) {
    for (RestNumber& rest : scene.rig.numbers) {
        if (rest.element == kNone) continue;
        useOwner(scene, rest, [&](auto& owner) { rest.number = numberOf(owner, infoOf(rest.property).member); });
    }
}

std::vector<Material> restingMaterials(const Scene& scene) {
    std::vector<Material> materials = scene.materials;
    forEachPlayed(scene.rig, [&](const RestNumber& rest) {
        if (!isOfMaterial(infoOf(rest.property).owner)) return;
        usePartOf(materials[std::size_t(rest.element)], rest, [&](auto& part) { setRest(part, rest); });
    });
    return materials;
}

Material restingMaterial(const Scene& scene, std::size_t index) {
    Material material = scene.materials[index];
    forEachPlayed(scene.rig, [&](const RestNumber& rest) {
        if (isOf(rest, index)) usePartOf(material, rest, [&](auto& part) { setRest(part, rest); });
    });
    return material;
}

Material editedAtRest(const Scene& scene, std::size_t index, Material edited) {
    forEachPlayed(scene.rig, [&](const RestNumber& rest) {
        if (!isOf(rest, index)) return;
        glm::dvec4 posed{0.0};
        const AnimatedMember& member = infoOf(rest.property).member;
        usePartOf(scene.materials[index], rest, [&](const auto& part) { posed = numberOf(part, member); });
        usePartOf(edited, rest, [&](auto& part) {
            if (numberOf(part, member) == posed) setRest(part, rest);
        });
    });
    return edited;
}

void replaceMaterial(Scene& scene, std::size_t index, Material resting, double timeSeconds) {
    scene.materials[index] = std::move(resting);
    bool isPosed = false;
    for (RestNumber& rest : scene.rig.numbers) {
        if (!isOf(rest, index)) continue;
        isPosed = true;
        usePartOf(scene.materials[index], rest,
                  [&](auto& part) { rest.number = numberOf(part, infoOf(rest.property).member); });
    }
    if (!isPosed) return;
    const Pose pose = poseAt(scene.rig, timeSeconds);
    for (std::size_t i = 0; i < scene.rig.numbers.size(); ++i) {
        const RestNumber& rest = scene.rig.numbers[i];
        if (!isOf(rest, index) || !pose.numbers[i]) continue;
        usePartOf(scene.materials[index], rest,
                  [&](auto& part) { setPosed(part, infoOf(rest.property), *pose.numbers[i]); });
    }
}

namespace {

/// By node, whether a clip that plays moves it, or one above it: parents stand before their children.
std::vector<bool> movedNodes(const Scene& scene) {
    const Rig& rig = scene.rig;
    std::vector<bool> moves(scene.nodes.size());
    for (const int playing : rig.playing)
        for (const AnimationChannel& channel : rig.clips[std::size_t(playing)].channels)
            if (infoOf(channel.property).owner == AnimatedOwner::Node)
                moves[std::size_t(rig.nodes[std::size_t(channel.target)].node)] = true;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const int parent = scene.nodes[i].parent;
        if (parent != kNone && moves[std::size_t(parent)]) moves[i] = true;
    }
    return moves;
}

} // namespace

bool hasPoses(const Scene& scene) {
    return !scene.rig.clips.empty() || !scene.rig.deformed.empty();
}

bool isPlaying(const Scene& scene) {
    return !scene.rig.playing.empty();
}

void poseScene(Scene& scene, double timeSeconds) {
    if (hasPoses(scene)) applyPose(scene, poseAt(scene.rig, timeSeconds));
}

void playClip(Scene& scene, const std::string& nameOrNumber) {
    Rig& rig = scene.rig;
    forEachPlayed(rig,
                  [&](const RestNumber& rest) { useOwner(scene, rest, [&](auto& owner) { setRest(owner, rest); }); });
    rig.playing.clear();
    for (std::size_t i = 0; i < rig.clips.size(); ++i)
        if (rig.clips[i].name == nameOrNumber) rig.playing.push_back(int(i));
    if (!rig.playing.empty() || nameOrNumber == kNoClip) return;
    std::size_t number = 0;
    const char* const end = nameOrNumber.data() + nameOrNumber.size();
    const auto [rest, error] = std::from_chars(nameOrNumber.data(), end, number);
    if (error == std::errc() && rest == end && number < rig.clips.size()) {
        rig.playing.push_back(int(number));
        return;
    }
    if (rig.clips.empty())
        throw InputError(fmt::format("the scene has no clip, so none is called '{}'; leave it out", nameOrNumber));
    std::vector<std::string_view> names{kNoClip};
    for (const Clip& clip : rig.clips) names.push_back(clip.name);
    throw InputError(fmt::format("no clip of the scene is called '{}', nor is it the number of one; {}", nameOrNumber,
                                 suggestNames(nameOrNumber, names)));
}

std::string clipText(const Scene& scene) {
    const Rig& rig = scene.rig;
    if (rig.clips.empty()) return {};
    if (rig.playing.empty()) return fmt::format("no clip of {}", rig.clips.size());
    std::string text;
    for (const int playing : rig.playing) {
        const Clip& clip = rig.clips[std::size_t(playing)];
        const double seconds = lengthSeconds(clip);
        // "0 s" would look like a fault.
        const std::string length = clip.channels.empty() ? "which moves nothing"
                                   : seconds == 0.0      ? "a pose without duration"
                                                         : fmt::format("{:.3g} s", seconds);
        text += fmt::format("{}clip {} '{}' of {}, {}", text.empty() ? "" : "; ", playing, clip.name, rig.clips.size(),
                            length);
    }
    return text;
}

void restLights(Scene& scene) {
    for (const RestNumber& rest : scene.rig.numbers) {
        if (infoOf(rest.property).owner == AnimatedOwner::Light && rest.element != kNone)
            setRest(scene.lights[std::size_t(rest.element)], rest);
    }
}

bool movesCamera(const Scene& scene, int camera) {
    const std::vector<bool> moves = movedNodes(scene);
    return std::ranges::any_of(scene.rig.cameras, [&](const Carried& carried) {
        return carried.element == camera && moves[std::size_t(carried.node)];
    });
}

MovingParts movingParts(const Scene& scene) {
    const Rig& rig = scene.rig;
    MovingParts parts;
    for (const int playing : rig.playing)
        for (const AnimationChannel& channel : rig.clips[std::size_t(playing)].channels) {
            const AnimatedOwner owner = infoOf(channel.property).owner;
            parts.materials = parts.materials || isOfMaterial(owner);
            parts.geometry = parts.geometry || owner == AnimatedOwner::Weights ||
                             (owner == AnimatedOwner::Node && !rig.deformed.empty()); // it may be a joint
        }
    const std::vector<bool> moves = movedNodes(scene);
    for (std::size_t i = 0; i < moves.size(); ++i)
        parts.geometry = parts.geometry || (moves[i] && !scene.nodes[i].instances.empty());
    return parts;
}

} // namespace tessera::scenes
