#pragma once
#include <string>
#include <vector>

#include "viewer/session/State.h"

namespace tessera::viewer {

/// An environment map to choose.
struct MapChoice {
    std::string name;   ///< as given to --environment
    std::string source; ///< scenes::Environment::source of a scene that uses it; empty: none
    std::string label;  ///< name in lists
    std::string meaning;
};

/// None, the built-in maps, and files used since the program started, the latest first.
std::vector<MapChoice> mapChoices(const State& state);

/// Moves a scene's environment, if it comes from a file, to the front of the used ones (State::maps).
void noteMap(std::vector<std::string>& maps, const scenes::Scene& scene);

} // namespace tessera::viewer
