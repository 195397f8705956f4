#include "viewer/show/Inspector.h"

#include <cstring>
#include <utility>

namespace tessera::viewer {
namespace {

/// Views of the leading sides whose images have radiance and the same size.
std::vector<frame::DebugView> viewsToRead(const State& state, const Screen& screen) {
    std::vector<frame::DebugView> views;
    for (int side = 0; side < state.sides(); ++side) {
        const DrawnPicture& picture = screen.picture(side);
        if (!picture.isThere() || picture.radiance() == nullptr) break;
        if (picture.display().sizePixels() != screen.picture(0).display().sizePixels()) break;
        views.push_back(picture.look().settings.view);
    }
    return views;
}

} // namespace

void Inspector::request(const Subject& subject, const Screen& screen) {
    if (!reader_) reader_.emplace();
    std::vector<const gpu::Texture*> textures;
    for (int side = 0; side < int(subject.views.size()); ++side) {
        textures.push_back(&screen.picture(side).radiance()->texture());
        textures.push_back(&screen.picture(side).display().texture());
    }
    reader_->request(textures, {subject.pixel.x, subject.sizePixels.y - 1 - subject.pixel.y});
    subject_ = subject;
    isRequested_ = true;
}

bool Inspector::take(Facts& facts) {
    const auto texels = reader_->take();
    if (!texels) return false;
    isRequested_ = false;
    awaitsRest_ = true;
    Inspection& inspection = facts.inspection.emplace();
    inspection.pixel = subject_->pixel;
    inspection.sizePixels = subject_->sizePixels;
    for (std::size_t side = 0; side < texels->size() / 2; ++side) {
        InspectedSide& values = inspection.sides[side].emplace();
        values.view = subject_->views[side];
        std::memcpy(&values.radiance, (*texels)[2 * side].data(), sizeof values.radiance);
        std::memcpy(&values.display, (*texels)[2 * side + 1].data(), sizeof values.display);
    }
    return true;
}

void Inspector::findSurface(Inspection& inspection, const State& state, const Screen& screen) const {
    const scenes::Scene& scene = state.open->scene();
    inspection.surface = surfaceAt(scene, scene.cameras[std::size_t(state.open->camera())], subject_->sizePixels,
                                   subject_->pixel, state.active().settings.timeSeconds);
    inspection.isSurfaceKnown = true;
    if (!inspection.surface) return;
    for (std::size_t side = 0; side < inspection.sides.size(); ++side) {
        const PictureLights* const lights = screen.picture(int(side)).lights();
        if (!inspection.sides[side] || lights == nullptr) continue;
        inspection.sides[side]->visitedLights = visitsOf(*inspection.surface, lights->visitedAt(subject_->pixel));
    }
}

bool Inspector::update(Facts& facts, const State& state, const Screen& screen, std::uint64_t picture, bool isAtRest) {
    const std::optional<glm::vec2> place = state.inspectedPlace();
    if (!place || !state.open) {
        subject_.reset();
        isRequested_ = awaitsRest_ = false;
        const bool wasShown = facts.inspection.has_value();
        facts.inspection.reset();
        return wasShown;
    }
    bool isChanged = isRequested_ && take(facts);
    std::vector<frame::DebugView> views = viewsToRead(state, screen);
    if (facts.inspection &&
        std::exchange(facts.inspection->isOfUnshifted, screen.showsSmoothed()) != screen.showsSmoothed())
        isChanged = true;
    if (views.empty()) awaitsRest_ = false;
    if (views.empty() || isRequested_) return isChanged;
    const glm::ivec2 size = screen.picture(0).display().sizePixels();
    const Subject subject{pixelAt(*place, size), size, picture, std::move(views)};
    if (subject_ != subject) {
        request(subject, screen);
    } else if (awaitsRest_ && isAtRest && facts.inspection) {
        awaitsRest_ = false;
        findSurface(*facts.inspection, state, screen);
        isChanged = true;
    }
    return isChanged;
}

} // namespace tessera::viewer
