#include "apps/FilterEnvironment.h"

#include <atomic>
#include <memory>

#include "apps/Progress.h"
#include "renderer/frame/ComputedCache.h"

namespace tessera::app {

void filterEnvironment(const Request& request, engine::Renderer& renderer, bool quiet) {
    if (!frame::makeFrameSpec(request.scene, {}, request.settings).usesFilteredEnvironment()) return;
    constexpr std::size_t kSteps = 1000;
    Progress progress("filtering the environment", kSteps, quiet);
    std::atomic<std::size_t> done = 0;
    const auto advance = [&](double share) {
        const auto now = std::size_t(share * double(kSteps));
        for (std::size_t before = done; before < now;)
            if (done.compare_exchange_weak(before, now)) {
                progress.advance(now - before);
                break;
            }
    };
    renderer.environmentChanged(std::make_shared<frame::FilteredEnvironment>(
        frame::cachedEnvironment(request.scene.environment->map, frame::cacheFolder(), advance)));
}

} // namespace tessera::app
