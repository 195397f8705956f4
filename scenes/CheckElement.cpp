#include "scenes/CheckElement.h"

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::scenes {

void CheckedElement::require(bool holds, std::string_view problemAndRemedy) const {
    if (holds) return;
    const std::string quoted = name_.empty() ? std::string() : fmt::format(" '{}'", name_);
    throw InputError(fmt::format("scene '{}': {} {}{}: {}", scene_.name, kind_, index_, quoted, problemAndRemedy));
}

void CheckedElement::requireIndex(int index, std::size_t count, std::string_view kind) const {
    if (index >= 0 && static_cast<std::size_t>(index) < count) return;
    require(false, fmt::format("refers to {} {}, but there are {}", kind, index, count));
}

std::string boundsText(double least, double most) {
    if (most < kAnyNumber) return fmt::format("between {:g} and {:g}", least, most);
    return least < 0.0 ? "finite" : "finite and not negative";
}

} // namespace tessera::scenes
