#pragma once
#include <optional>

#include <nlohmann/json.hpp>

/// What the sources that write a benchmark's JSON share. Only for sources: it brings the whole JSON library.
namespace tessera::validation {

using Json = nlohmann::ordered_json; ///< fields stay in the order in which they are written

template <typename T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

} // namespace tessera::validation
