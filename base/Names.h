#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// At most three candidates: those within one edit of `name`; else those that begin with it; else the nearest by edit
/// distance, up to a third of the longer name. Names of more than 128 bytes are not compared by edits.
std::vector<std::string_view> nearestNames(std::string_view name, std::span<const std::string_view> candidates);

/// The end of an error message about an unknown name: "did you mean 'a' or 'b'?" of nearestNames(), or "valid are a, b,
/// c" when none is near.
std::string suggestNames(std::string_view name, std::span<const std::string_view> candidates);

} // namespace tessera
