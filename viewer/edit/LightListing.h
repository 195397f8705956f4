#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "viewer/edit/LightList.h"

/// The list of a scene's lights: search, order and groups.
namespace tessera::viewer {

/// Above this number, lights are searched, sorted and grouped; fewer are visible at a glance.
inline constexpr std::size_t kFewLights = 7;

enum class LightOrder : std::uint8_t {
    Scene,
    Name, ///< in natural order: "lamp 2" before "lamp 10"
    Kind,
    Intensity, ///< brightest first
    Count
};
const char* nameOf(LightOrder order);

struct LightListing {
    std::string search; ///< contained in names or types of lights; case-insensitive
    LightOrder order = LightOrder::Scene;
    std::set<std::string> unfolded; ///< names of groups
    bool operator==(const LightListing&) const = default;
};

/// A row of the list.
struct ListedLight {
    int light = scenes::kNone; ///< none: the heading of a group
    std::string group;         ///< empty: none
    std::vector<int> lights;   ///< of a heading: the lights of its group
};

/// The rows of a listing. Three or more lights of one type, or with names that differ only by a number, form a group; a
/// folded group has only its heading. During a search all groups are unfolded.
std::vector<ListedLight> listedLights(const Lights& lights, const LightListing& listing);

/// The group of a light; empty if the order has no groups.
std::string groupOf(const Lights& lights, std::size_t index, LightOrder order);

/// The lights of the rows, in their order, including those of folded groups.
std::vector<int> lightsIn(const std::vector<ListedLight>& rows);

} // namespace tessera::viewer
