#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/Settings.h"

/// The rows of settingTable() by topic, in the order of --help and panels.
namespace tessera::engine {

std::vector<Setting> frameSettings(); ///< technique, culling, size, samples, camera, area lights, view
std::vector<Setting> environmentSettings();
std::vector<Setting> shadowSettings();
std::vector<Setting> subsurfaceSettings();
std::vector<Setting> pictureSettings(); ///< shading terms, filtering, exposure and tone map

// ---- For their help ------------------------------------------------------------------------------------------------

template <typename Row>
std::string namesOf(std::span<const Row> table) {
    std::string names;
    for (const Row& row : table) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

/// "none (what it does), ..."
template <typename Row>
std::string listed(std::span<const Row> table) {
    std::string text;
    for (const Row& row : table) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", row.name, row.summary);
    return text;
}

} // namespace tessera::engine
