#pragma once
#include <functional>
#include <optional>

#include "viewer/session/Facts.h"
#include "viewer/session/FigureJob.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// What takes too long to be measured in every frame: made when the pictures rest, and only where a panel shows it.
class Measurements {
public:
    /// `done` is called on another thread when something new waits for update().
    explicit Measurements(std::function<void()> done) : figureJob_(std::move(done)) {}

    bool hasResult() const { return figureJob_.hasResult(); }
    /// Brings the facts up to date with the pictures, which are those of `wanted` where they are whole. Whether a fact
    /// changed. Throws what measuring throws.
    bool update(Facts& facts, const State& state, const Screen& screen, const Screen::Wanted& wanted, bool isWhole);
    /// Judges the light lists of a frame at a quarter of its size, by trying every light at every pixel. Throws what
    /// drawing throws.
    void judgeLights(Facts& facts, Screen& screen, const Look& look);
    /// Nothing that was measured holds any more.
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
    std::optional<Screen::Wanted> counted_;  ///< whose largest counts are shown
    std::optional<Screen::Wanted> measured_; ///< the pair whose figures are shown, or being made
    FigureJob figureJob_;
};

} // namespace tessera::viewer
