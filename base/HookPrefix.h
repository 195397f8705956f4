#pragma once
#include <string_view>

namespace tessera {

/// Prefix that shader programs give to names declared by a scene's hook (docs/hooks.md), to avoid collisions.
inline constexpr std::string_view kHookPrefix = "ofHook";

} // namespace tessera
