#include "viewer/edit/Brightness.h"

#include <algorithm>

#include "scenes/Illuminance.h"

namespace tessera::viewer {
std::optional<int> brightestAt(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS,
                               double timeSeconds) {
    std::optional<int> brightest;
    double most = 0.0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!lights[i].enabled) continue;
        const double here = scenes::illuminanceAt(scenes::lightAtTime(lights[i], timeSeconds), positionWS);
        if (!(here > most)) continue;
        most = here;
        brightest = int(i);
    }
    return brightest;
}

std::size_t lightsReaching(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS, double timeSeconds) {
    return std::size_t(std::ranges::count_if(lights, [&](const scenes::Light& light) {
        return light.enabled && scenes::illuminanceAt(scenes::lightAtTime(light, timeSeconds), positionWS) > 0.0;
    }));
}

} // namespace tessera::viewer
