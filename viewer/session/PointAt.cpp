#include "viewer/session/PointAt.h"

#include <fmt/format.h>

#include "viewer/edit/Extent.h"
#include "viewer/edit/LightList.h"
#include "viewer/edit/Pick.h"

namespace tessera::viewer {
namespace {

/// Half a side of the box framed for a light without a size, relative to the scene's size.
constexpr double kLightShare = 0.02;

std::optional<Pick> pickedAt(const State& state, const glm::vec2& place, glm::ivec2 sizePixels) {
    const glm::ivec2 pixel =
        glm::clamp(glm::ivec2(place * glm::vec2(sizePixels)), glm::ivec2(0), sizePixels - glm::ivec2(1));
    const scenes::Scene& scene = state.open->scene();
    return pickedByRay(scene, scene.cameras[std::size_t(state.open->camera())], sizePixels, pixel);
}

} // namespace

std::string selectMaterialAt(State& state, const glm::vec2& place, glm::ivec2 sizePixels) {
    const auto picked = pickedAt(state, place, sizePixels);
    state.selectedMaterial = picked ? picked->material : scenes::kNone;
    state.selectedLast = Selected::Material;
    if (picked) state.reveals = Selected::Material; // even if already selected: its panel may be folded
    return picked ? state.open->scene().materials[std::size_t(picked->material)].name : "nothing";
}

bool turnAboutPlace(State& state, const glm::vec2& place, glm::ivec2 sizePixels) {
    const auto picked = pickedAt(state, place, sizePixels);
    if (picked) state.open->turnAbout(picked->positionWS);
    return picked.has_value();
}

void frameSelection(State& state) {
    if (!state.open) return;
    OpenScene& open = *state.open;
    const scenes::Scene& scene = open.scene();
    const auto light = std::size_t(state.selectedLight), material = std::size_t(state.selectedMaterial);
    const auto frameLight = [&] {
        if (state.selectedLight == scenes::kNone || light >= scene.lights.size()) return false;
        const scenes::Box3& all = open.boundsWS();
        const double size = all.empty() ? 1.0 : glm::length(all.max - all.min);
        const scenes::Box3 boundsWS =
            boundsOfLight(scene.lights[light], state.active().settings.timeSeconds, kLightShare * size);
        if (boundsWS.empty()) return false;
        open.jumpTo(fmt::format("bring light '{}' into view", lightLabel(scene.lights, light)), boundsWS,
                    state.pictureAspect);
        return true;
    };
    const auto frameMaterial = [&] {
        if (state.selectedMaterial == scenes::kNone || material >= scene.materials.size()) return false;
        const scenes::Box3 boundsWS = boundsOfMaterial(scene, state.selectedMaterial);
        if (boundsWS.empty()) return false;
        open.jumpTo(fmt::format("bring '{}' into view", scene.materials[material].name), boundsWS, state.pictureAspect);
        return true;
    };
    const bool isFramed =
        state.selectedLast == Selected::Light ? frameLight() || frameMaterial() : frameMaterial() || frameLight();
    if (!isFramed) open.jumpToAll(state.pictureAspect);
}

} // namespace tessera::viewer
