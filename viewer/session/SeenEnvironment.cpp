#include "viewer/session/SeenEnvironment.h"

#include <algorithm>
#include <utility>

#include "scenes/write/SceneText.h"

namespace tessera::viewer {
namespace {

void setOwnView(scenes::Environment& environment, const scenes::EnvironmentView& own) {
    environment.rotationDegrees = own.rotationDegrees;
    environment.intensity = own.intensity;
}

void takeViewAsOwn(std::optional<scenes::Environment>& environment, scenes::EnvironmentView& view) {
    if (environment) setOwnView(*environment, scenes::asSeen(scenes::ownViewOf(*environment), view));
    view = {};
}

} // namespace

void Surrounding::takeAsSeen() {
    takeViewAsOwn(environment, view);
}

Surrounding SeenEnvironment::replacedBy(ChosenEnvironment chosen) const {
    if (chosen.environment) scenes::layAs(own_, *chosen.environment);
    return {std::move(chosen.environment), view_, false, std::move(chosen.filtered), std::move(chosen.warnings)};
}

void SeenEnvironment::exchange(Surrounding& other) {
    std::swap(scene_.environment, other.environment);
    std::swap(view_, other.view);
    std::swap(scene_.supplied.light, other.isSupplied);
    std::swap(filtered_, other.filtered);
    std::erase_if(scene_.warnings,
                  [&](const std::string& warning) { return std::ranges::find(warnings_, warning) != warnings_.end(); });
    std::swap(warnings_, other.warnings);
    scene_.warnings.insert(scene_.warnings.end(), warnings_.begin(), warnings_.end());
    ++revision_;
}

void SeenEnvironment::exchange(scenes::EnvironmentView& own, scenes::EnvironmentView& view) {
    const scenes::EnvironmentView before = scenes::ownViewOf(*scene_.environment);
    if (own != before) ++revision_; // a file was saved in between
    setOwnView(*scene_.environment, std::exchange(own, before));
    std::swap(view_, view);
}

void SeenEnvironment::takeAsSeen() {
    takeViewAsOwn(scene_.environment, view_);
    scenes::removeEnvironmentView(scene_.options);
    own_ = scenes::ownEnvironmentOf(scene_);
}

} // namespace tessera::viewer
