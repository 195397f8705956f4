#pragma once
#include <string_view>

namespace tessera {

/// What programs put before the names that a scene's hook declares (docs/hooks.md), so that none is one of the
/// program's.
inline constexpr std::string_view kHookPrefix = "ofHook";

} // namespace tessera
