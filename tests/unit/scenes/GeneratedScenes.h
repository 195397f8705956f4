#pragma once
#include "scenes/Load.h"

namespace tessera::scenes::test {

/// For built-in scenes without the scans that this machine may have.
inline LoadOptions withoutAssets() {
    LoadOptions options;
    options.useAssets = false;
    return options;
}

/// The same, with a number of lights.
inline LoadOptions withLights(int count) {
    LoadOptions options = withoutAssets();
    options.lights = count;
    return options;
}

} // namespace tessera::scenes::test
