#include "apps/FilterEnvironment.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "apps/ErrorLine.h"
#include "apps/Progress.h"
#include "renderer/frame/ComputedCache.h"

namespace tessera::app {

void filterEnvironment(const Request& request, engine::Renderer& renderer, bool quiet) {
    if (!frame::makeFrameSpec(request.scene, {}, request.settings).usesFilteredEnvironment()) return;
    constexpr std::size_t kSteps = 1000;
    std::once_flag begun;
    std::optional<Progress> progress;
    std::atomic<std::size_t> done = 0;
    const auto advance = [&](double share) { // called only if the map is not in the cache
        std::call_once(begun, [&] {
            if (!quiet) printProblem("note: filtering the environment, once for each map: that takes seconds");
            progress.emplace("filtering the environment", kSteps, quiet);
        });
        const auto now = std::size_t(share * double(kSteps));
        for (std::size_t before = done; before < now;)
            if (done.compare_exchange_weak(before, now)) {
                progress->advance(now - before);
                break;
            }
    };
    renderer.environmentChanged(std::make_shared<frame::FilteredEnvironment>(
        frame::cachedEnvironment(request.scene.environment->map, frame::cacheFolder(), advance)));
}

} // namespace tessera::app
