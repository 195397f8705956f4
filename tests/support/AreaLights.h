#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

#include <glm/glm.hpp>

#include "scenes/Light.h"

/// Types of area lights, and outlines of polygons.
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

/// Light types that emit from a surface, and those of them that have a front and a back.
inline constexpr auto kAreaTypes = detail::typesThat<&scenes::LightTypeInfo::isArea>();
inline constexpr auto kFlatTypes = detail::typesThat<&scenes::LightTypeInfo::isFlat>();

/// A polygon outline with these corners, in metres.
inline scenes::LightCorners cornersOf(std::initializer_list<glm::vec2> places) {
    scenes::LightCorners corners;
    corners.count = 0;
    for (const glm::vec2& place : places) corners.add(place);
    return corners;
}

} // namespace tessera::test
