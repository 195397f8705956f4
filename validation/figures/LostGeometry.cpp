#include "validation/figures/LostGeometry.h"

#include <fmt/format.h>

namespace tessera::validation {

const char* lostName(LostKind kind) {
    constexpr const char* kNames[] = {"missing", "extra", "other triangles", "transparent"};
    return kNames[std::size_t(kind)];
}

std::string lostText(const LostGeometry& lost) {
    std::string who = "a transparent surface";
    if (lost.instance) {
        who = fmt::format("instance {}", *lost.instance);
        std::string names;
        if (!lost.node.empty()) names = fmt::format("node '{}'", lost.node);
        if (!lost.mesh.empty()) names += fmt::format("{}mesh '{}'", names.empty() ? "" : ", ", lost.mesh);
        if (!names.empty()) who += fmt::format(" ({})", names);
    }
    constexpr const char* kWhat[] = {"is missing from", "covers what the reference leaves empty in",
                                     "shows other triangles than the reference in",
                                     "differs from the reference, or another transparent one before or behind it, in"};
    return fmt::format("{} {} {} pixel{}, such as {},{}", who, kWhat[std::size_t(lost.kind)], lost.pixels,
                       lost.pixels == 1 ? "" : "s", lost.x, lost.y);
}

} // namespace tessera::validation
