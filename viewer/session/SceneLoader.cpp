#include "viewer/session/SceneLoader.h"

#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include "renderer/frame/ComputedCache.h"
#include "renderer/gpu/Timer.h"

namespace tessera::viewer {
namespace {

/// Removes a file's folder from a text, except for its first mention.
std::string namedOnce(std::string text, const std::string& file) {
    const std::string folder = (std::filesystem::path(file).parent_path() / "").string();
    std::size_t at = text.find(folder);
    if (folder.size() < 2 || at == std::string::npos) return text;
    while ((at = text.find(folder, at + 1)) != std::string::npos)
        if (std::string_view(" '\"(").find(text[at - 1]) != std::string_view::npos) text.erase(at, folder.size());
    return text;
}

SceneLoader::Result load(const std::string& source, const scenes::LoadOptions& options, EnvironmentProgress& progress) {
    SceneLoader::Result result;
    result.source = source;
    result.load = options;
    result.load.stop = {}; // it belongs to this load
    const gpu::CpuTimer clock;
    try {
        const auto report = [&](bool isFiltering, double done) {
            if (options.stop.stop_requested()) throw scenes::LoadStopped();
            progress.report({isFiltering, done});
        };
        scenes::LoadOptions reporting = options;
        reporting.environmentProgress = [&report](double done) { report(false, done); };
        result.scene = scenes::loadScene(source, reporting);
        result.origin = scenes::originOf(source, options, *result.scene);
        if (result.scene->environment)
            result.filtered = std::make_shared<frame::FilteredEnvironment>(frame::cachedEnvironment(
                result.scene->environment->map, frame::cacheFolder(), [&report](double done) { report(true, done); }));
    } catch (const std::bad_alloc&) {
        result.scene.reset();
        result.error = source + ": the memory is not enough for it; close other programs or open a smaller scene";
    } catch (const std::exception& error) {
        result.scene.reset();
        result.error = namedOnce(error.what(), source);
    }
    result.seconds = clock.elapsedMs() / 1000.0;
    return result;
}

} // namespace

SceneLoader::~SceneLoader() {
    const std::lock_guard lock(mutex_);
    waiting_.reset();
    stop_.request_stop();
}

void SceneLoader::start(const std::string& source, const scenes::LoadOptions& options) {
    const std::lock_guard lock(mutex_);
    // Waiting here for the end of an abandoned load would block the window.
    stop_.request_stop();
    result_.reset();
    waiting_ = {source, options};
    if (isWorking_) return;
    thread_ = std::jthread([this] { work(); }); // joins the previous thread, which no longer needs the mutex
    isWorking_ = true;
}

void SceneLoader::work() {
    for (;;) {
        Request request;
        {
            const std::lock_guard lock(mutex_);
            isWorking_ = waiting_.has_value();
            if (!isWorking_) return;
            request = *std::exchange(waiting_, std::nullopt);
            stop_ = std::stop_source();
            progress_.begin();
            request.options.stop = stop_.get_token();
        }
        Result result = load(request.source, request.options, progress_);
        {
            const std::lock_guard lock(mutex_);
            if (request.options.stop.stop_requested()) continue;
            result_ = std::move(result);
        }
        done_();
    }
}

std::optional<EnvironmentShare> SceneLoader::environmentShare() const {
    const std::lock_guard lock(mutex_);
    return isWorking_ && !waiting_ ? progress_.latest() : std::nullopt;
}

bool SceneLoader::hasResult() const {
    const std::lock_guard lock(mutex_);
    return result_.has_value();
}

const scenes::Scene* SceneLoader::scene() const {
    const std::lock_guard lock(mutex_);
    return result_ && result_->scene ? &*result_->scene : nullptr;
}

std::optional<SceneLoader::Result> SceneLoader::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

} // namespace tessera::viewer
