#include "viewer/edit/LightListing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>

namespace tessera::viewer {
namespace {

constexpr std::size_t kLeastGroup = 3;

std::string inSmallLetters(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char letter) { return char(std::tolower(letter)); });
    return text;
}

std::string kindOf(const scenes::Light& light) {
    return std::string(scenes::infoOf(light.type).name);
}

/// A name's prefix, digit count and trailing number, which sort in natural order.
std::tuple<std::string, std::size_t, std::string> countedName(const std::string& label) {
    std::size_t end = label.size();
    while (end > 0 && std::isdigit(static_cast<unsigned char>(label[end - 1])) != 0) --end;
    return {inSmallLetters(label.substr(0, end)), label.size() - end, label.substr(end)};
}

template <typename Key>
void sortBy(std::vector<int>& lights, const Key& keyOf) {
    std::map<int, decltype(keyOf(0))> keys;
    for (const int light : lights) keys.emplace(light, keyOf(light));
    std::ranges::stable_sort(
        lights, {}, [&](int light) -> const auto& { return keys.at(light); });
}

std::vector<int> sortedLights(const Lights& lights, const LightListing& listing) {
    const std::string sought = inSmallLetters(listing.search);
    std::vector<int> found;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (inSmallLetters(lightLabel(lights, i)).find(sought) != std::string::npos ||
            kindOf(lights[i]).find(sought) != std::string::npos)
            found.push_back(int(i));
    const auto light = [&](int index) -> const scenes::Light& { return lights[std::size_t(index)]; };
    switch (listing.order) {
    case LightOrder::Name:
        sortBy(found, [&](int index) { return countedName(lightLabel(lights, std::size_t(index))); });
        break;
    case LightOrder::Kind:
        sortBy(found, [&](int index) { return light(index).type; });
        break;
    case LightOrder::Intensity:
        sortBy(found, [&](int index) { return -light(index).intensity; });
        break;
    case LightOrder::Scene:
    case LightOrder::Count:
        break;
    }
    return found;
}

} // namespace

const char* nameOf(LightOrder order) {
    constexpr std::array<const char*, std::size_t(LightOrder::Count)> kNames{"as the scene", "by name", "by kind",
                                                                             "by intensity"};
    return kNames[std::size_t(order)];
}

std::string groupOf(const Lights& lights, std::size_t index, LightOrder order) {
    if (order == LightOrder::Intensity) return {};
    if (order == LightOrder::Kind) return kindOf(lights[index]);
    return withoutNumber(lightLabel(lights, index));
}

std::vector<ListedLight> listedLights(const Lights& lights, const LightListing& listing) {
    const std::vector<int> sorted = sortedLights(lights, listing);
    std::map<std::string, std::vector<int>> groups;
    if (lights.size() > kFewLights)
        for (const int light : sorted) groups[groupOf(lights, std::size_t(light), listing.order)].push_back(light);
    groups.erase("");
    std::erase_if(groups, [](const auto& group) { return group.second.size() < kLeastGroup; });
    std::vector<ListedLight> rows;
    for (const int light : sorted) {
        const std::string group = groupOf(lights, std::size_t(light), listing.order);
        const auto known = groups.find(group);
        if (known == groups.end()) {
            rows.push_back({light, {}, {}});
        } else if (known->second.front() == light) { // the first light of a group inserts its rows
            rows.push_back({scenes::kNone, group, known->second});
            if (listing.search.empty() && !listing.unfolded.contains(group)) continue;
            for (const int one : known->second) rows.push_back({one, group, {}});
        }
    }
    return rows;
}

std::vector<int> lightsIn(const std::vector<ListedLight>& rows) {
    std::vector<int> shown;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool isFolded =
            rows[i].light == scenes::kNone && (i + 1 == rows.size() || rows[i + 1].group != rows[i].group);
        if (isFolded)
            shown.insert(shown.end(), rows[i].lights.begin(), rows[i].lights.end());
        else if (rows[i].light != scenes::kNone)
            shown.push_back(rows[i].light);
    }
    return shown;
}

} // namespace tessera::viewer
