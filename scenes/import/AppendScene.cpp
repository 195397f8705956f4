#include "scenes/import/AppendScene.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/AreaLight.h"
#include "scenes/Direction.h"
#include "scenes/RigLinks.h"
#include "scenes/Transform.h"

namespace tessera::scenes {
namespace {

/// Moves the elements of the given lists.
template <typename Owner>
void moveAll(Owner& from, Owner& to, auto... lists) {
    (std::ranges::move(from.*lists, std::back_inserter(to.*lists)), ...);
}

void shift(int& index, std::size_t offset) {
    if (index != kNone) index += int(offset);
}

glm::dvec3 movedPoint(const glm::dmat4& worldFromPart, const glm::dvec3& point) {
    return glm::dvec3(worldFromPart * glm::dvec4(point, 1.0));
}

/// `what` and `name` identify the owner of the direction in errors.
glm::dvec3 movedDirection(const glm::dvec3& vector, const char* what, const std::string& name) {
    const std::optional<glm::dvec3> direction = directionOf(vector);
    if (!direction)
        throw InputError(fmt::format("its transform leaves the {} '{}' no direction; give scales that are not 0 and "
                                     "finite",
                                     what, name));
    return *direction;
}

void moveTangents(LightKeys& keys, const glm::dmat3& linear) {
    for (std::vector<glm::dvec3>* tangents : {&keys.inTangents, &keys.outTangents})
        for (glm::dvec3& tangentWS : *tangents) tangentWS = linear * tangentWS;
}

/// Normalises each key's direction and scales its tangents alike.
void moveDirections(LightKeys& keys, const glm::dmat3& linear, const std::string& name) {
    moveTangents(keys, linear);
    for (std::size_t i = 0; i < keys.values.size(); ++i) {
        const glm::dvec3 movedWS = linear * keys.values[i];
        keys.values[i] = movedDirection(movedWS, "light", name);
        const double shrinks = 1.0 / glm::length(movedWS);
        if (i < keys.inTangents.size()) keys.inTangents[i] *= shrinks;
        if (i < keys.outTangents.size()) keys.outTangents[i] *= shrinks;
    }
}

void moveLight(Light& light, const glm::dmat4& worldFromPart) {
    const glm::dmat3 linear(worldFromPart);
    light.positionWS = movedPoint(worldFromPart, light.positionWS);
    light.directionWS = movedDirection(linear * light.directionWS, "light", light.name);
    if (infoOf(light.type).isTurned())
        light.alongWS = acrossFrom(light.directionWS, movedDirection(linear * light.alongWS, "light", light.name))
                            .value_or(usualAlong(light.directionWS));
    // A mirroring transform flips the y axis of the corners.
    if (infoOf(light.type).hasCorners() && glm::determinant(linear) < 0.0)
        for (std::size_t i = 0; i < light.corners.count; ++i) light.corners.metres[i].y *= -1.0f;
    for (LightKeys& keys : light.keyframes)
        if (infoOf(keys.of).isOnSphere) moveDirections(keys, linear, light.name);
    if (!light.animation) return;
    LightAnimation& animation = *light.animation;
    animation.centerWS = movedPoint(worldFromPart, animation.centerWS);
    animation.axisWS = movedDirection(cofactorOf(linear) * animation.axisWS, "light",
                                      light.name); // mirroring reverses an orbit
    animation.amplitudeMetres = linear * animation.amplitudeMetres;
    for (glm::dvec3& pointWS : animation.pointsWS) pointWS = movedPoint(worldFromPart, pointWS);
    for (glm::dvec3& valueWS : animation.keys.values) valueWS = movedPoint(worldFromPart, valueWS);
    moveTangents(animation.keys, linear);
}

/// Transforms position and view direction exactly; up follows as far as a rotation allows.
void moveCamera(Camera& camera, const glm::dmat4& worldFromPart) {
    const glm::dmat4 moved = worldFromPart * camera.worldFromCamera;
    const glm::dvec3 back = movedDirection(glm::dvec3(moved[2]), "camera", camera.name);
    const glm::dvec3 right = movedDirection(glm::cross(glm::dvec3(moved[1]), back), "camera", camera.name);
    camera.worldFromCamera = {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0),
                              moved[3]};
}

/// Offsets the indices of a part's rig. Called before the part is moved into `whole`; its nodes follow `nodes` others.
void shiftRig(Rig& rig, const Scene& whole, std::size_t nodes) {
    const Rig& before = whole.rig;
    for (int& clip : rig.playing) shift(clip, before.clips.size());
    for (RestNode& rest : rig.nodes) shift(rest.node, nodes);
    for (RestNumber& rest : rig.numbers) shift(rest.element, elementCount(whole, infoOf(rest.property).owner));
    for (Skin& skin : rig.skins)
        for (int& joint : skin.joints) shift(joint, nodes);
    for (Deformed& deformed : rig.deformed) {
        shift(deformed.mesh, whole.meshes.size());
        shift(deformed.shape, before.shapes.size());
        shift(deformed.node, nodes);
        shift(deformed.standsAt, nodes);
        shift(deformed.skin, before.skins.size());
        shift(deformed.weights, before.weights.size());
    }
    const auto shiftCarried = [nodes](std::vector<Carried>& all, std::size_t elements) {
        for (Carried& carried : all) {
            shift(carried.element, elements);
            shift(carried.node, nodes);
        }
    };
    shiftCarried(rig.lights, whole.lights.size());
    shiftCarried(rig.cameras, whole.cameras.size());
    for (Clip& clip : rig.clips)
        for (AnimationChannel& channel : clip.channels) {
            const AnimatedOwner owner = infoOf(channel.property).owner;
            shift(channel.target, owner == AnimatedOwner::Node      ? before.nodes.size()
                                  : owner == AnimatedOwner::Weights ? before.weights.size()
                                                                    : before.numbers.size());
        }
}

} // namespace

void appendScene(Scene& whole, Scene part, const std::string& name, const glm::dmat4& worldFromPart) {
    if (whole.hook && part.hook)
        throw InputError(fmt::format("it has a hook, '{}', and so has what comes before it, '{}'; a scene has one: "
                                     "join them in one file",
                                     part.hook->file, whole.hook->file));
    Node root;
    root.name = name;
    root.parentFromNode = worldFromPart;
    const int rootIndex = int(whole.nodes.size());
    whole.nodes.push_back(std::move(root));

    for (Material& material : part.materials)
        for (TextureUse& use : material.textures) shift(use.image, whole.images.size());
    for (Node& node : part.nodes) {
        if (node.parent == kNone)
            node.parent = rootIndex;
        else
            shift(node.parent, std::size_t(rootIndex) + 1);
        for (MeshInstance& instance : node.instances) {
            shift(instance.mesh, whole.meshes.size());
            shift(instance.material, whole.materials.size());
        }
    }
    shiftRig(part.rig, whole, std::size_t(rootIndex) + 1);
    for (Light& light : part.lights) moveLight(light, worldFromPart);
    for (Camera& camera : part.cameras) moveCamera(camera, worldFromPart);

    if (part.hook) {
        for (int& material : part.hook->materials) shift(material, whole.materials.size());
        whole.hook = std::move(part.hook);
    }

    moveAll(part, whole, &Scene::images, &Scene::materials, &Scene::meshes, &Scene::nodes, &Scene::lights,
            &Scene::cameras, &Scene::notes, &Scene::warnings);
    moveAll(part.rig, whole.rig, &Rig::clips, &Rig::playing, &Rig::nodes, &Rig::weights, &Rig::numbers, &Rig::skins,
            &Rig::shapes, &Rig::deformed, &Rig::lights, &Rig::cameras);
    for (std::string& variant : part.variants)
        if (std::ranges::find(whole.variants, variant) == whole.variants.end())
            whole.variants.push_back(std::move(variant));
}

} // namespace tessera::scenes
