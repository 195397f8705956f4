#pragma once
#include <string_view>

namespace tessera::viewer {

/// The tooltip of a panel's row, by its label; empty if the label is sufficient, or the row's widgets have tooltips.
std::string_view meaningOf(std::string_view label);

} // namespace tessera::viewer
