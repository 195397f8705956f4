#pragma once
#include <functional>
#include <optional>

#include "viewer/session/Facts.h"
#include "viewer/session/FigureJob.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Measurements that are too slow for every frame: made when the images are idle, and only if a panel shows them.
class Measurements {
public:
    /// `done` is called on another thread when a new result waits for update().
    explicit Measurements(std::function<void()> done) : figureJob_(std::move(done)) {}

    bool hasResult() const { return figureJob_.hasResult(); }
    /// Updates the facts for the displayed images, which match `wanted` if `isWhole`. Returns whether a fact changed.
    /// Throws what measuring throws.
    bool update(Facts& facts, const State& state, const Screen& screen, const Screen::Wanted& wanted, bool isWhole);
    /// Checks the light lists of a frame at a quarter of its size, by testing every light at every pixel. Throws what
    /// drawing throws.
    void judgeLights(Facts& facts, Screen& screen, const Look& look);
    /// Discards all results.
    void clear(Facts& facts);

private:
    struct Planned {
        Look look;
        std::uint64_t sceneRevision;
        bool operator==(const Planned&) const = default;
    };
    bool updatePlan(Facts& facts, const State& state, const Screen& screen, const Screen::Wanted& wanted);
    bool updateCounts(Facts& facts, const Screen& screen, const Screen::Wanted& wanted);
    bool updateFigures(Facts& facts, const Screen& screen, const Screen::Wanted& wanted);

    std::optional<Planned> planned_;
    std::optional<Screen::Wanted> counted_;  ///< whose largest counts are displayed
    std::optional<Screen::Wanted> measured_; ///< the pair whose figures are displayed, or being measured
    FigureJob figureJob_;
};

} // namespace tessera::viewer
