#pragma once
#include <string>
#include <vector>

#include "viewer/session/State.h"

namespace tessera::viewer {

/// An environment to choose.
struct MapChoice {
    std::string name;   ///< as --environment takes it
    std::string source; ///< of the scene's environment where this is it (scenes::Environment::source); empty: none
    std::string label;  ///< as lists call it
    std::string meaning;
};

/// None, the built-in ones, and files that were used since the program's start, the latest first.
std::vector<MapChoice> mapChoices(const State& state);

/// The environment of a scene, where it is a file's, comes first among those that were used (State::maps).
void noteMap(std::vector<std::string>& maps, const scenes::Scene& scene);

} // namespace tessera::viewer
