#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/frame/EnvironmentFilter.h"
#include "scenes/Defaults.h"
#include "viewer/session/EnvironmentJob.h"

namespace tessera::viewer {

/// An environment with its associated data.
struct Surrounding {
    std::optional<scenes::Environment> environment;
    scenes::EnvironmentView view; ///< applied to it: SeenEnvironment::view()
    bool isSupplied = false;      ///< scenes::Supplied::light
    std::shared_ptr<const frame::FilteredEnvironment> filtered;
    std::vector<std::string> warnings; ///< of a chosen environment; those of the scene's file stay with the scene
    /// The view's rotation and intensity become the environment's own.
    void takeAsSeen();
};

/// The environment of an open scene, its own or a chosen one, with the rotation and intensity that looks apply to it.
class SeenEnvironment {
public:
    /// The scene's address must stay fixed. `filtered`, of its environment, may be null. `seen` is the initial rotation
    /// and intensity that looks apply.
    SeenEnvironment(scenes::Scene& scene, std::shared_ptr<const frame::FilteredEnvironment> filtered,
                    const scenes::EnvironmentView& seen)
        : scene_(scene), own_(scenes::ownEnvironmentOf(scene)), view_(seen), filtered_(std::move(filtered)) {}

    /// The rotation and intensity that looks apply.
    const scenes::EnvironmentView& view() const { return view_; }
    /// The filtered environment, if it is known; may be null.
    const std::shared_ptr<const frame::FilteredEnvironment>& filtered() const { return filtered_; }
    /// Counts changes of the environment itself.
    std::uint64_t revision() const { return revision_; }

    /// The replacement by a chosen environment, with the rotation of the scene's own (scenes::layAs()).
    Surrounding replacedBy(ChosenEnvironment chosen) const;
    /// Exchanges the environment and its associated data.
    void exchange(Surrounding& other);
    /// Exchanges its own rotation and intensity, and those that looks apply. Requires an environment.
    void exchange(scenes::EnvironmentView& own, scenes::EnvironmentView& view);
    /// After saving a file with the displayed environment: the view becomes its own, the requested view is dropped.
    void takeAsSeen();

private:
    scenes::Scene& scene_;
    scenes::OwnEnvironment own_; ///< as in the file
    scenes::EnvironmentView view_;
    std::shared_ptr<const frame::FilteredEnvironment> filtered_;
    std::vector<std::string> warnings_; ///< Surrounding::warnings
    std::uint64_t revision_ = 0;
};

} // namespace tessera::viewer
