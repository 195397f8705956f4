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

/// An environment with all that belongs to it.
struct Surrounding {
    std::optional<scenes::Environment> environment;
    scenes::EnvironmentView view; ///< that it is seen by: SeenEnvironment::view()
    bool isSupplied = false;      ///< scenes::Supplied::light
    std::shared_ptr<const frame::FilteredEnvironment> filtered;
    std::vector<std::string> warnings; ///< that it brought; of one that a file brought they stay with the scene
    /// Makes what its view makes of the environment the environment's own.
    void takeAsSeen();
};

/// The environment of an open scene: its own or one that was chosen, and how looks turn and brighten it.
class SeenEnvironment {
public:
    /// Of a scene that stays where it is. `filtered`, of its environment, may be null. `seen` is how looks turn and
    /// brighten that to begin with.
    SeenEnvironment(scenes::Scene& scene, std::shared_ptr<const frame::FilteredEnvironment> filtered,
                    const scenes::EnvironmentView& seen)
        : scene_(scene), own_(scenes::ownEnvironmentOf(scene)), view_(seen), filtered_(std::move(filtered)) {}

    /// What looks show it by.
    const scenes::EnvironmentView& view() const { return view_; }
    /// What a renderer need not filter; may be null.
    const std::shared_ptr<const frame::FilteredEnvironment>& filtered() const { return filtered_; }
    /// Counts changes of the environment itself.
    std::uint64_t revision() const { return revision_; }

    /// What takes its place where another was chosen, which lies as the scene's own (scenes::layAs()).
    Surrounding replacedBy(ChosenEnvironment chosen) const;
    /// Exchanges all that belongs to it.
    void exchange(Surrounding& other);
    /// Exchanges how it lies and shines, its own numbers and what looks make of them; there is one.
    void exchange(scenes::EnvironmentView& own, scenes::EnvironmentView& view);
    /// A file has the environment as it is seen: that is its own, and the scene asks for no other view.
    void takeAsSeen();

private:
    scenes::Scene& scene_;
    scenes::OwnEnvironment own_; ///< as the file has it
    scenes::EnvironmentView view_;
    std::shared_ptr<const frame::FilteredEnvironment> filtered_;
    std::vector<std::string> warnings_; ///< Surrounding::warnings
    std::uint64_t revision_ = 0;
};

} // namespace tessera::viewer
