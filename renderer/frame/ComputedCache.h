#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/EnvironmentFilter.h"

/// A disk cache of results that take seconds to compute and never change. Its folder may be deleted at any time. Files
/// that cannot be read or written are no error; takeCacheFault() reports failed writes.
namespace tessera::frame {

/// $XDG_CACHE_HOME/tessera if that is an absolute path, else ~/.cache/tessera; none if neither variable is set.
std::optional<std::filesystem::path> cacheFolder();

/// filterEnvironment() with a cache: reads the result of an earlier call for a map of the same texels from the folder,
/// else computes and stores it. Stores nothing if `progress` throws.
FilteredEnvironment cachedEnvironment(
    const scenes::Image& map, const std::optional<std::filesystem::path>& folder,
    const std::function<void(double)>& progress = [](double) {});

/// makeLobeTable() with the same cache.
std::vector<glm::vec4> cachedLobeTable(const std::optional<std::filesystem::path>& folder);

/// Returns the message of the first failed write, with file and reason, and clears it; later failures are not reported.
/// Empty if there is none. Thread-safe.
std::string takeCacheFault();

} // namespace tessera::frame
