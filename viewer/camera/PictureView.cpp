#include "viewer/camera/PictureView.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tessera::viewer {
namespace {

/// Clips a line to the image. Source: Liang and Barsky 1984, "A New Concept and Method for Line Clipping".
std::optional<std::pair<glm::dvec2, glm::dvec2>> insidePicture(const glm::dvec2& a, const glm::dvec2& b,
                                                               const glm::dvec2& size) {
    const glm::dvec2 step = b - a;
    double from = 0.0, to = 1.0;
    for (glm::length_t i = 0; i < 2; ++i) {
        if (step[i] == 0.0) {
            if (a[i] < 0.0 || a[i] > size[i]) return std::nullopt;
            continue;
        }
        const double atLeast = -a[i] / step[i], atMost = (size[i] - a[i]) / step[i];
        from = std::max(from, std::min(atLeast, atMost));
        to = std::min(to, std::max(atLeast, atMost));
    }
    if (!(from <= to)) return std::nullopt;
    return std::pair(a + from * step, a + to * step);
}

} // namespace

PictureView::PictureView(const scenes::Camera& camera, const glm::dvec2& size)
    : worldFromCamera_(camera.worldFromCamera), cameraFromWorld_(glm::inverse(camera.worldFromCamera)), size_(size),
      isPerspective_(camera.projection == scenes::Projection::Perspective), nearMetres_(camera.nearMetres),
      halfHeight_(isPerspective_ ? std::tan(0.5 * camera.fovYRadians) : camera.halfHeightMetres) {
    assert(size.x > 0.0 && size.y > 0.0);
}

double PictureView::halfHeightMetres(double depthMetres) const {
    return isPerspective_ ? halfHeight_ * depthMetres : halfHeight_;
}

glm::dvec2 PictureView::placeOfVS(const glm::dvec3& positionVS) const {
    const double unitsPerMetre = 0.5 * size_.y / halfHeightMetres(-positionVS.z);
    return {0.5 * size_.x + unitsPerMetre * positionVS.x, 0.5 * size_.y - unitsPerMetre * positionVS.y};
}

std::optional<glm::dvec2> PictureView::placeOf(const glm::dvec3& positionWS) const {
    const glm::dvec3 positionVS(cameraFromWorld_ * glm::dvec4(positionWS, 1.0));
    if (-positionVS.z <= nearMetres_) return std::nullopt;
    return placeOfVS(positionVS);
}

std::optional<std::pair<glm::dvec2, glm::dvec2>> PictureView::lineBetween(const glm::dvec3& aWS,
                                                                          const glm::dvec3& bWS) const {
    glm::dvec3 aVS(cameraFromWorld_ * glm::dvec4(aWS, 1.0)), bVS(cameraFromWorld_ * glm::dvec4(bWS, 1.0));
    const double beyondA = -aVS.z - nearMetres_, beyondB = -bVS.z - nearMetres_; // depth behind the near plane
    const auto atNearPlane = [&] {
        glm::dvec3 crossingVS = glm::mix(aVS, bVS, beyondA / (beyondA - beyondB));
        crossingVS.z = -nearMetres_;
        return crossingVS;
    };
    if (beyondA <= 0.0 && beyondB <= 0.0) return std::nullopt;
    if (beyondA < 0.0)
        aVS = atNearPlane();
    else if (beyondB < 0.0)
        bVS = atNearPlane();
    return insidePicture(placeOfVS(aVS), placeOfVS(bVS), size_);
}

SightLine PictureView::sightLineAt(const glm::dvec2& place) const {
    const double metresPerUnitAt1 = 2.0 * halfHeight_ / size_.y;
    const double x = metresPerUnitAt1 * (place.x - 0.5 * size_.x), y = metresPerUnitAt1 * (0.5 * size_.y - place.y);
    const glm::dmat3 turn(worldFromCamera_);
    if (isPerspective_) return {eyeWS(), glm::normalize(turn * glm::dvec3(x, y, -1.0))};
    return {eyeWS() + turn * glm::dvec3(x, y, 0.0), turn * glm::dvec3(0.0, 0.0, -1.0)};
}

glm::dvec3 PictureView::towardsViewerWS(const glm::dvec3& positionWS) const {
    return isPerspective_ ? glm::normalize(eyeWS() - positionWS) : glm::dvec3(worldFromCamera_[2]);
}

std::optional<double> PictureView::metresPerUnit(const glm::dvec3& positionWS) const {
    const double depthMetres = -(cameraFromWorld_ * glm::dvec4(positionWS, 1.0)).z;
    if (depthMetres <= nearMetres_) return std::nullopt;
    return 2.0 * halfHeightMetres(depthMetres) / size_.y;
}

} // namespace tessera::viewer
