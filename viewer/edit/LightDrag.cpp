#include "viewer/edit/LightDrag.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/edit/LightList.h"
#include "viewer/edit/NumberText.h"

namespace tessera::viewer {
namespace {

constexpr double kLeastSineSquare = 1e-4; ///< between an axis or a plane and a line: 0.6 degrees

/// The component of a vector perpendicular to a unit direction.
glm::dvec3 partAcross(const glm::dvec3& vectorWS, const glm::dvec3& directionWS) {
    return vectorWS - glm::dot(vectorWS, directionWS) * directionWS;
}

} // namespace

std::optional<double> metresAlongAxis(const SightLine& line, const glm::dvec3& middleWS, const glm::dvec3& axisWS) {
    const glm::dvec3 fromMiddleWS = line.originWS - middleWS;
    const double cosine = glm::dot(line.directionWS, axisWS), sineSquare = 1.0 - cosine * cosine;
    if (sineSquare < kLeastSineSquare) return std::nullopt;
    const double along = glm::dot(fromMiddleWS, axisWS), ahead = glm::dot(fromMiddleWS, line.directionWS);
    const double metres = (along - cosine * ahead) / sineSquare;
    const double distanceMetres = metres * cosine - ahead; // from the line's origin
    if (distanceMetres <= 0.0) return std::nullopt;
    return metres;
}

SpherePoint pointOnSphere(const SightLine& line, const glm::dvec3& middleWS, double radiusMetres, bool isFar) {
    const glm::dvec3 fromMiddleWS = line.originWS - middleWS;
    const glm::dvec3 nearestWS = partAcross(fromMiddleWS, line.directionWS); // on the line, from the middle
    const double halfSquare = radiusMetres * radiusMetres - glm::dot(nearestWS, nearestWS);
    if (halfSquare < 0.0) return {glm::normalize(nearestWS), true};
    const double halfMetres = std::sqrt(halfSquare), middleMetres = -glm::dot(fromMiddleWS, line.directionWS);
    const bool takesFar = isFar || middleMetres - halfMetres <= 0.0;
    return {glm::normalize(nearestWS + (takesFar ? halfMetres : -halfMetres) * line.directionWS), false};
}

LightDrag::LightDrag(const scenes::Light& light, const LightFigure& figure, const LightHandle& handle,
                     const PictureView& view, const glm::dvec2& pointer)
    : handle_(handle), before_(light), middleWS_(figure.middleWS),
      armMetres_(glm::distance(handle.positionWS, figure.middleWS)), grip_(pointer - handle.truePlace),
      isFar_(glm::dot(handle.axisWS, view.sightLineAt(handle.truePlace).directionWS) > 0.0) {}

bool LightDrag::drag(scenes::Light& light, double timeSeconds, const PictureView& view, const glm::dvec2& pointer,
                     bool isOneSided) {
    const scenes::Light was = light;
    const SightLine line = view.sightLineAt(pointer - grip_);
    const bool hasPosition = scenes::infoOf(before_.type).hasPosition();
    const scenes::Light shown = scenes::lightAtTime(before_, timeSeconds);
    const glm::dvec3 middleWS = hasPosition ? shown.positionWS : middleWS_;
    if (handle_.turns())
        turn(light, middleWS, line);
    else if (handle_.moves())
        slide(light, timeSeconds, shown.positionWS, line);
    else if (handle_.parameter == nullptr)
        dragCorner(light, shown, line);
    else
        resize(light, timeSeconds, {middleWS, shown.directionWS}, line, isOneSided);
    return light != was;
}

void LightDrag::turn(scenes::Light& light, const glm::dvec3& middleWS, const SightLine& line) {
    SpherePoint point = pointOnSphere(line, middleWS, armMetres_, isFar_);
    if (isBeside_ && !point.isBeside) {
        isFar_ = !isFar_;
        point = pointOnSphere(line, middleWS, armMetres_, isFar_);
    }
    isBeside_ = point.isBeside;
    light.alongWS = before_.alongWS;
    turnLight(light, point.directionWS);
}

void LightDrag::slide(scenes::Light& light, double timeSeconds, const glm::dvec3& shownWS,
                      const SightLine& line) const {
    const std::optional<double> metres = metresAlongAxis(line, middleWS_, handle_.axisWS);
    if (!metres) return;
    light.positionWS = before_.positionWS;
    light.animation = before_.animation;
    placeLight(light, timeSeconds, shownWS + (*metres - armMetres_) * handle_.axisWS);
}

void LightDrag::dragCorner(scenes::Light& light, const scenes::Light& shown, const SightLine& line) const {
    const double sine = glm::dot(line.directionWS, shown.directionWS);
    if (sine * sine < kLeastSineSquare) return;
    const double distanceMetres = glm::dot(shown.positionWS - line.originWS, shown.directionWS) / sine;
    if (distanceMetres <= 0.0) return; // behind the line's origin
    const glm::dvec3 fromMiddleWS = line.originWS + distanceMetres * line.directionWS - shown.positionWS;
    const glm::dvec3 acrossWS = glm::cross(shown.directionWS, shown.alongWS);
    const glm::dvec2 placeMetres(glm::dot(fromMiddleWS, shown.alongWS), glm::dot(fromMiddleWS, acrossWS));
    constexpr glm::dvec2 kMost(scenes::kMostRadiusMetres);
    moveCorner(light, std::size_t(handle_.corner), glm::vec2(glm::clamp(placeMetres, -kMost, kMost)));
}

std::optional<double> LightDrag::draggedMetres(const SightLine& axis, const SightLine& line) const {
    const glm::dvec3& middleWS = axis.originWS;
    if (!handle_.isRound) return metresAlongAxis(line, middleWS, handle_.axisWS);
    const glm::dvec3 fromMiddleWS = line.originWS - middleWS;
    if (before_.type != scenes::LightType::Tube) return glm::length(partAcross(fromMiddleWS, line.directionWS));
    // The distance between the tube's axis and the line.
    const glm::dvec3 normalWS = glm::cross(line.directionWS, axis.directionWS);
    const double sineSquare = glm::dot(normalWS, normalWS);
    if (sineSquare < kLeastSineSquare) return std::nullopt;
    return std::abs(glm::dot(fromMiddleWS, normalWS)) / std::sqrt(sineSquare);
}

void LightDrag::resize(scenes::Light& light, double timeSeconds, const SightLine& axis, const SightLine& line,
                       bool isOneSided) const {
    const std::optional<double> metres = draggedMetres(axis, line);
    if (!metres) return;
    const scenes::LightParameter& parameter = *handle_.parameter;
    const double before = before_.*parameter.member;
    const bool movesMiddle = isOneSided && handle_.share < 1.0; // radii have no opposite side
    const double wanted = movesMiddle ? *metres + handle_.share * before : *metres / handle_.share;
    const double value = std::clamp(wanted, double(parameter.least), double(parameter.most));
    light.*parameter.member = float(value);
    light.positionWS = before_.positionWS;
    light.animation = before_.animation;
    if (movesMiddle) placeLight(light, timeSeconds, axis.originWS + handle_.share * (value - before) * handle_.axisWS);
}

std::string LightDrag::text(const scenes::Light& light, double timeSeconds) const {
    if (handle_.parameter != nullptr)
        return fmt::format("{} {:.3g} m", handle_.parameter->label, light.*handle_.parameter->member);
    if (handle_.moves()) {
        const double metres = scenes::lightAtTime(light, timeSeconds).positionWS[handle_.arm];
        return fmt::format("Position {} {}", handle_.axisName(), numberText("%.3f m", metres));
    }
    if (!handle_.turns()) {
        const glm::vec2& corner = light.corners.metres[std::size_t(handle_.corner)];
        return fmt::format("Corner {} at {}, {}", handle_.corner, numberText("%.3g", corner.x),
                           numberText("%.3g m", corner.y));
    }
    const auto component = [&](int axis) { return numberText("%.2f", light.directionWS[axis]); };
    return fmt::format("Direction {}, {}, {}", component(0), component(1), component(2));
}

} // namespace tessera::viewer
