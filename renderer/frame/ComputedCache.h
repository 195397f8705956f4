#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/EnvironmentFilter.h"

/// What takes seconds to compute and never changes, kept in files: in a folder that may be deleted at any time. One
/// that cannot be written or read is no error; takeCacheFault() tells of it.
namespace tessera::frame {

/// $XDG_CACHE_HOME/tessera where that is absolute, else ~/.cache/tessera; none where neither is known.
std::optional<std::filesystem::path> cacheFolder();

/// As filterEnvironment(), from a file of the folder where an earlier call left it for a map of the same texels, else
/// left there, unless `progress` throws.
FilteredEnvironment cachedEnvironment(
    const scenes::Image& map, const std::optional<std::filesystem::path>& folder,
    const std::function<void(double)>& progress = [](double) {});

/// As makeLobeTable(), likewise.
std::vector<glm::vec4> cachedLobeTable(const std::optional<std::filesystem::path>& folder);

/// Where and why a file could not be left in its folder, the first time that one could not: given once to whoever asks
/// first, from any thread; else empty.
std::string takeCacheFault();

} // namespace tessera::frame
