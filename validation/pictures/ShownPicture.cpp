#include "validation/pictures/ShownPicture.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "validation/pictures/HeatMap.h"

namespace tessera::validation {
namespace {

/// "12.3 lights a pixel, at most 40: hall, clustered_deferred".
std::string countTitle(const std::string& counted, const std::string& of, const Picture& counts) {
    double sum = 0.0, covered = 0.0, most = 0.0;
    for (std::size_t i = 0; i < counts.pixelCount(); ++i) {
        if (!counts.covered[i]) continue;
        covered += 1.0;
        sum += counts.pixel(i)[0];
        most = std::max(most, double(counts.pixel(i)[0]));
    }
    // The figures first: a small picture's title is cut.
    return fmt::format("{:.1f} {} a pixel, at most {:.0f}: {}", sum / std::max(covered, 1.0), counted, most, of);
}

} // namespace

DisplayImage shownPicture(const engine::RenderedFrame& frame, const std::string& sceneName, engine::Technique technique,
                          frame::DebugView view) {
    const std::string of = fmt::format("{}, {}", sceneName, infoOf(technique).name);
    const Picture picture = toPicture(frame);
    switch (view) {
    case frame::DebugView::Lights:
        return countHeatMap(picture, countTitle("lights", of, picture));
    case frame::DebugView::Overdraw:
        return countHeatMap(picture, countTitle("surfaces", of, picture));
    case frame::DebugView::Faults:
        return faultMap(picture, toDisplayImage(frame), of);
    default:
        return toDisplayImage(frame);
    }
}

} // namespace tessera::validation
