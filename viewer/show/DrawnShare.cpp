#include "viewer/show/DrawnShare.h"

#include <algorithm>

namespace tessera::viewer {

std::optional<double> drawnShare(std::span<const gpu::PassTiming> before, const gpu::BandProgress& progress) {
    double all = 0.0, done = 0.0;
    for (std::size_t pass = 0; pass < before.size(); ++pass) {
        const double ms = before[pass].gpuMs.value_or(before[pass].cpuMs);
        all += ms;
        if (pass < progress.passes)
            done += ms;
        else if (pass == progress.passes)
            done += progress.share * ms;
    }
    if (!(all > 0.0)) return std::nullopt;
    return std::clamp(done / all, 0.0, 1.0);
}

} // namespace tessera::viewer
