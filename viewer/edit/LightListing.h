#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "viewer/edit/LightList.h"

/// The list of a scene's lights as people look for one in it.
namespace tessera::viewer {

/// More lights than these are searched, sorted and grouped; so many are seen at a glance.
inline constexpr std::size_t kFewLights = 7;

enum class LightOrder : std::uint8_t {
    Scene,
    Name, ///< numbers in names by their value: "lamp 2" before "lamp 10"
    Kind,
    Intensity, ///< the brightest first
    Count
};
const char* nameOf(LightOrder order);

struct LightListing {
    std::string search; ///< what names of lights, or of their kinds, contain; capitals are as good as small letters
    LightOrder order = LightOrder::Scene;
    std::set<std::string> unfolded; ///< groups
    bool operator==(const LightListing&) const = default;
};

/// A row of the list.
struct ListedLight {
    int light = scenes::kNone; ///< none: it heads a group
    std::string group;         ///< none: empty
    std::vector<int> lights;   ///< of a heading: those of its group
};

/// The rows of a listing. Lights of one kind, or of names that differ by a number alone, make a group where there are
/// three or more; a folded one shows its heading alone. While one searches all are unfolded.
std::vector<ListedLight> listedLights(const Lights& lights, const LightListing& listing);

/// The group that a light would be of: empty in an order without groups.
std::string groupOf(const Lights& lights, std::size_t index, LightOrder order);

/// The lights that rows show, in their order; of a folded group all.
std::vector<int> lightsIn(const std::vector<ListedLight>& rows);

} // namespace tessera::viewer
