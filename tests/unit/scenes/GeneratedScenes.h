#pragma once
#include <utility>

#include "scenes/Load.h"

// In the namespace of LoadOptions, for argument-dependent lookup.
namespace tessera::scenes {

/// Returns options with one member set.
template <typename Member, typename Value>
LoadOptions loading(Member LoadOptions::*member, Value value) {
    LoadOptions options;
    options.*member = std::move(value);
    return options;
}

} // namespace tessera::scenes

namespace tessera::scenes::test {

/// Options for built-in scenes without installed scans.
inline LoadOptions withoutAssets() {
    return loading(&LoadOptions::useAssets, false);
}

/// Same, with a number of lights.
inline LoadOptions withLights(int count) {
    LoadOptions options = withoutAssets();
    options.lights = count;
    return options;
}

} // namespace tessera::scenes::test
