#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// At most three of the candidates: those that are one edit away from `name`; else those that begin with it; else those
/// nearest by edit distance, none that is far from it. Names of more than 128 bytes are near none by edits.
std::vector<std::string_view> nearestNames(std::string_view name, std::span<const std::string_view> candidates);

/// The end of an error message about an unknown name: "did you mean 'a' or 'b'?" of nearestNames(), or "valid are a, b,
/// c" when none is near.
std::string suggestNames(std::string_view name, std::span<const std::string_view> candidates);

} // namespace tessera
