#include "scenes/RigLinks.h"

#include <algorithm>
#include <cassert>

namespace tessera::scenes {

namespace {

/// Detaches all cameras from the rig.
void leaveCameras(Rig& rig) {
    rig.cameras.clear();
    for (RestNumber& rest : rig.numbers)
        if (infoOf(rest.property).owner == AnimatedOwner::Camera) rest.element = kNone;
}

/// Renumbers the lights of the links; kNone: the light was removed.
template <typename NumberAfter>
LightLinks renumbered(LightLinks links, const NumberAfter& numberAfter) {
    for (Carried& carried : links.carried) carried.element = numberAfter(carried.element);
    std::erase_if(links.carried, [](const Carried& carried) { return carried.element == kNone; });
    for (int& light : links.numbers)
        if (light != kNone) light = numberAfter(light);
    return links;
}

} // namespace

LightLinks lightLinks(const Rig& rig) {
    LightLinks links{rig.lights, {}};
    for (const RestNumber& rest : rig.numbers)
        links.numbers.push_back(infoOf(rest.property).owner == AnimatedOwner::Light ? rest.element : kNone);
    return links;
}

void setLightLinks(Rig& rig, const LightLinks& links) {
    assert(links.numbers.size() == rig.numbers.size());
    rig.lights = links.carried;
    for (std::size_t i = 0; i < rig.numbers.size(); ++i)
        if (infoOf(rig.numbers[i].property).owner == AnimatedOwner::Light) rig.numbers[i].element = links.numbers[i];
}

LightLinks linksAfterEdit(const Rig& rig, std::size_t first, std::span<const Light> before,
                          std::span<const Light> after) {
    assert(before.size() == after.size());
    const auto isEdited = [&](int light) { return std::size_t(light) - first < before.size() && light != kNone; };
    LightLinks links = lightLinks(rig);
    std::erase_if(links.carried, [&](const Carried& carried) {
        if (!isEdited(carried.element)) return false;
        const std::size_t i = std::size_t(carried.element) - first;
        return before[i].positionWS != after[i].positionWS || before[i].directionWS != after[i].directionWS;
    });
    for (std::size_t i = 0; i < rig.numbers.size(); ++i) {
        if (!isEdited(links.numbers[i])) continue;
        const std::size_t light = std::size_t(links.numbers[i]) - first;
        const AnimatedMember& member = infoOf(rig.numbers[i].property).member;
        if (numberOf(before[light], member) != numberOf(after[light], member)) links.numbers[i] = kNone;
    }
    return links;
}

LightLinks linksAfterReplacing(const Rig& rig, std::size_t first, std::size_t taken, std::size_t put) {
    return renumbered(lightLinks(rig), [&](int light) {
        if (light >= int(first + taken)) return light + int(put) - int(taken);
        return light >= int(first) ? kNone : light;
    });
}

LightLinks linksAfterDeleting(const Rig& rig, std::span<const std::size_t> deleted) {
    return renumbered(lightLinks(rig), [&](int light) {
        const auto place = std::ranges::lower_bound(deleted, std::size_t(light));
        if (place != deleted.end() && *place == std::size_t(light)) return kNone;
        return light - int(place - deleted.begin());
    });
}

void keepLights(Scene& scene, std::size_t count) {
    if (count >= scene.lights.size()) return;
    setLightLinks(scene.rig, linksAfterReplacing(scene.rig, count, scene.lights.size() - count, 0));
    scene.lights.resize(count);
}

void leaveLightsAndCameras(Scene& scene) {
    setLightLinks(scene.rig, linksAfterReplacing(scene.rig, 0, scene.lights.size(), 0));
    leaveCameras(scene.rig);
}

void dropCameras(Scene& scene) {
    scene.cameras.clear();
    leaveCameras(scene.rig);
}

void ownCamera(Scene& scene, std::size_t camera, const Camera& before) {
    Rig& rig = scene.rig;
    const Camera& now = scene.cameras[camera];
    if (now.worldFromCamera != before.worldFromCamera)
        std::erase_if(rig.cameras, [&](const Carried& carried) { return std::size_t(carried.element) == camera; });
    for (RestNumber& rest : rig.numbers) {
        const AnimatedPropertyInfo& info = infoOf(rest.property);
        const bool isOfIt = info.owner == AnimatedOwner::Camera && rest.element == int(camera);
        if (isOfIt && numberOf(now, info.member) != numberOf(before, info.member)) rest.element = kNone;
    }
}

std::size_t elementCount(const Scene& scene, AnimatedOwner owner) {
    if (owner == AnimatedOwner::Light) return scene.lights.size();
    return owner == AnimatedOwner::Camera ? scene.cameras.size() : scene.materials.size();
}

} // namespace tessera::scenes
