#pragma once
#include <span>
#include <string>
#include <string_view>

namespace tessera {

/// The end of an error message about an unknown name: "did you mean 'a' or 'b'?" with the candidates nearest to `name`
/// by edit distance, or "valid are a, b, c" when none is near. Names of more than 128 bytes are near none.
std::string suggestNames(std::string_view name, std::span<const std::string_view> candidates);

} // namespace tessera
