#pragma once
#include <functional>

#include "scenes/Image.h"

/// The built-in environments, listed in scenes/Environment.cpp. All are the same on every machine. `progress` is the
/// progress callback of drawRadiance().
namespace tessera::scenes::builtin {

inline constexpr int kMapWidth = 1024, kMapHeight = 512; ///< texels

/// A grey room with a warm key light, a broad fill, two strips behind and a soft light above, for a camera that looks
/// along -(1, 0.7, 1).
Image makeStudio(const std::function<void(double)>& progress = {});
/// A clear sky at a solar elevation of 38 degrees.
Image makeSky(const std::function<void(double)>& progress = {});

} // namespace tessera::scenes::builtin
