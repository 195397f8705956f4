#include "viewer/session/SceneLoader.h"

#include <exception>
#include <new>
#include <utility>

#include "renderer/gpu/Timer.h"

namespace tessera::viewer {
namespace {

SceneLoader::Result load(const std::string& source, const scenes::LoadOptions& options) {
    SceneLoader::Result result;
    result.source = source;
    result.load = options;
    result.load.stop = {}; // it is this load's
    const gpu::CpuTimer clock;
    try {
        result.scene = scenes::loadScene(source, options);
        result.origin = scenes::originOf(source, options, *result.scene);
    } catch (const std::bad_alloc&) {
        result.scene.reset();
        result.error = source + ": the memory is not enough for it; close other programs or open a smaller scene";
    } catch (const std::exception& error) {
        result.scene.reset();
        result.error = error.what();
    }
    result.seconds = clock.elapsedMs() / 1000.0;
    return result;
}

} // namespace

SceneLoader::~SceneLoader() {
    for (std::jthread& thread : threads_) thread.request_stop();
}

void SceneLoader::start(const std::string& source, const scenes::LoadOptions& options) {
    {
        const std::lock_guard lock(mutex_);
        // What is given up ends soon, but waiting for it here would keep the window from answering.
        for (std::jthread& thread : threads_) thread.request_stop();
        result_.reset();
    }
    loading_ = source;
    threads_.emplace_back([this, source, options](const std::stop_token& stop) {
        scenes::LoadOptions stoppable = options;
        stoppable.stop = stop;
        Result result = load(source, stoppable);
        {
            const std::lock_guard lock(mutex_);
            if (stop.stop_requested()) return;
            result_ = std::move(result);
        }
        done_();
    });
}

bool SceneLoader::hasResult() const {
    const std::lock_guard lock(mutex_);
    return result_.has_value();
}

std::optional<SceneLoader::Result> SceneLoader::take() {
    const std::lock_guard lock(mutex_);
    if (result_) loading_.clear();
    return std::exchange(result_, std::nullopt);
}

} // namespace tessera::viewer
