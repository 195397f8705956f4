#pragma once
#include "scenes/import/SceneJsonNames.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {

/// A row that sets an enum of Scene.h, by its names in scene files. Returns whether it did.
template <typename Enum, typename Possible>
bool chooseNamed(const char* label, Enum& value, const Possible& isPossible) {
    const auto table = scenes::scenejson::choicesOf(value);
    std::vector<Choice> choices;
    std::size_t now = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        choices.push_back({table[i].first, "", isPossible(table[i].second)});
        if (table[i].second == value) now = i;
    }
    const auto chosen = choose(label, scenes::scenejson::nameOf(value), choices, now);
    if (chosen) value = table[*chosen].second;
    return chosen.has_value();
}
template <typename Enum>
bool chooseNamed(const char* label, Enum& value) {
    return chooseNamed(label, value, [](Enum) { return true; });
}

} // namespace tessera::viewer
