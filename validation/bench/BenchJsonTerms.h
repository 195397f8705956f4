#pragma once
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"

/// Helpers shared by the sources that write a benchmark's JSON. Not for headers: includes the whole JSON library.
namespace tessera::validation {

using Json = nlohmann::ordered_json; ///< keeps fields in insertion order

template <typename T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

/// Reads an integer in [least, most]. Throws InputError otherwise: a plain conversion would wrap values beyond T, and
/// is undefined for large fractions.
template <std::integral T>
T wholeNumber(const Json& json, T least = std::numeric_limits<T>::min(), T most = std::numeric_limits<T>::max()) {
    const auto fits = [&](auto number) {
        return std::cmp_greater_equal(number, least) && std::cmp_less_equal(number, most);
    };
    if (json.is_number_unsigned() ? !fits(json.get<std::uint64_t>())
                                  : !json.is_number_integer() || !fits(json.get<std::int64_t>()))
        throw InputError(fmt::format("{} is no whole number from {} to {}", json.dump(), least, most));
    return json.get<T>();
}

} // namespace tessera::validation
