#pragma once
#include <utility>

#include "scenes/Load.h"

// Beside LoadOptions, so that calls find it.
namespace tessera::scenes {

/// Options with this value of one of them.
template <typename Member, typename Value>
LoadOptions loading(Member LoadOptions::*member, Value value) {
    LoadOptions options;
    options.*member = std::move(value);
    return options;
}

} // namespace tessera::scenes

namespace tessera::scenes::test {

/// For built-in scenes without the scans that this machine may have.
inline LoadOptions withoutAssets() {
    return loading(&LoadOptions::useAssets, false);
}

/// The same, with a number of lights.
inline LoadOptions withLights(int count) {
    LoadOptions options = withoutAssets();
    options.lights = count;
    return options;
}

} // namespace tessera::scenes::test
