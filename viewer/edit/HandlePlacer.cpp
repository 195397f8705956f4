#include "viewer/edit/HandlePlacer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tessera::viewer {
namespace {

constexpr double kLeastAway = 20.0;  ///< least distance of handles from the light's marker at its middle
constexpr double kLeastTurn = 40.0;  ///< the same for its direction handle, which stays clear of the others
constexpr double kLeastApart = 20.0; ///< least distance between handles: a press grabs within 9
constexpr double kMostAside = 200.0; ///< largest offset to avoid other handles
constexpr double kLeastWay = 1.0;    ///< distance from the middle below which a free handle has no outward direction
constexpr double kLeastSeen = 0.02;  ///< least sine between a draggable axis and the line of sight: 1 degree
constexpr double kLeastArmSeen = 0.20791169081775934; ///< the same for arms: 12 degrees, 21 of their 100 visible

} // namespace

void HandlePlacer::add(LightHandle handle) {
    handle.number = count_++;
    const std::optional<glm::dvec2> shown = view_.placeOf(handle.positionWS);
    if (!shown) return;
    handle.truePlace = handle.place = *shown;
    const glm::dvec3 towardsWS = view_.towardsViewerWS(handle.moves() ? figure_.middleWS : handle.positionWS);
    if (handle.turns()) {
        standOff(handle, kLeastTurn);
    } else if (handle.isDraggedAnywhere()) { // a corner, whose plane must not be seen edge-on
        if (std::abs(glm::dot(light_.directionWS, towardsWS)) < kLeastSeen) return;
        standOff(handle, kLeastAway);
    } else {
        const double leastSeen = handle.moves() ? kLeastArmSeen : kLeastSeen;
        if (glm::length(glm::cross(handle.axisWS, towardsWS)) < leastSeen) return;
        const auto beyond = view_.placeOf(handle.positionWS + *view_.metresPerUnit(handle.positionWS) * handle.axisWS);
        if (!beyond || *beyond == *shown) return;
        handle.way = glm::normalize(*beyond - *shown);
        const bool isClear = standOff(handle, kLeastAway);
        if (handle.moves() && !isClear) return; // the light can be moved by its marker, too
    }
    if (isInPicture(handle.place)) figure_.handles.push_back(handle);
}

bool HandlePlacer::isInPicture(const glm::dvec2& place) const {
    return glm::all(glm::greaterThanEqual(place, glm::dvec2(0.0))) && glm::all(glm::lessThanEqual(place, view_.size()));
}

bool HandlePlacer::standOff(LightHandle& handle, double least) const {
    if (figure_.sun) return true;
    const std::optional<glm::dvec2> middle = view_.placeOf(figure_.middleWS);
    if (!middle) return false;
    const glm::dvec2 away = handle.truePlace - *middle;
    glm::dvec2 way = handle.way;
    if (handle.isDraggedAnywhere()) // at the middle: diagonally, between level and upright sides
        way = glm::normalize(glm::length(away) < kLeastWay * scale_ ? glm::dvec2(1.0, -1.0) : away);
    if (glm::length(away) < least * scale_) handle.place = *middle + least * scale_ * way;
    const auto isClear = [&](const glm::dvec2& place) {
        return std::ranges::none_of(figure_.handles, [&](const LightHandle& other) {
            return glm::distance(other.place, place) < kLeastApart * scale_;
        });
    };
    constexpr double kStep = 0.25 * kLeastApart;
    for (double aside = 0.0; aside <= kMostAside; aside += kStep) {
        const glm::dvec2 place = handle.place + aside * scale_ * way;
        if (!isClear(place)) continue;
        if (!isInPicture(place)) return false;
        handle.place = place;
        return true;
    }
    return false;
}

} // namespace tessera::viewer
