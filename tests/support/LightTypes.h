#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "scenes/Light.h"

namespace tessera::test {

namespace detail {
template <bool scenes::LightTypeInfo::*has>
constexpr auto typesThat() {
    std::array<scenes::LightType, std::size_t(std::ranges::count(scenes::lightTypes(), true, has))> types{};
    std::size_t count = 0;
    for (const scenes::LightTypeInfo& info : scenes::lightTypes())
        if (info.*has) types[count++] = info.type;
    return types;
}
} // namespace detail

/// The types of the table that shine from a surface, and those of them that have a front and a back.
inline constexpr auto kAreaTypes = detail::typesThat<&scenes::LightTypeInfo::isArea>();
inline constexpr auto kFlatTypes = detail::typesThat<&scenes::LightTypeInfo::isFlat>();

} // namespace tessera::test
