#include "scenes/Rest.h"

#include <optional>
#include <utility>

#include "scenes/Pose.h"
#include "scenes/RigNumbers.h"

namespace tessera::scenes {
namespace {

/// Writes a rest value, which already lies within its bounds.
void setRest(auto& owner, const RestNumber& rest) {
    setMember(owner, infoOf(rest.property).member, rest.number, [](auto, double value) { return value; });
}

/// Calls `use` for each rest value that an active clip changes, if its element still exists.
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

void restPlayed(Scene& scene) {
    forEachPlayed(scene.rig,
                  [&](const RestNumber& rest) { useOwner(scene, rest, [&](auto& owner) { setRest(owner, rest); }); });
}

void restLights(Scene& scene) {
    for (const RestNumber& rest : scene.rig.numbers) {
        if (infoOf(rest.property).owner == AnimatedOwner::Light && rest.element != kNone)
            setRest(scene.lights[std::size_t(rest.element)], rest);
    }
}

} // namespace tessera::scenes
