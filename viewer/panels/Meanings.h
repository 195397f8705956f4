#pragma once
#include <string_view>

namespace tessera::viewer {

/// What a row of the panels is about, by its label, as the box beside the pointer says it; empty where the label says
/// all, or the row's own widgets tell more.
std::string_view meaningOf(std::string_view label);

} // namespace tessera::viewer
