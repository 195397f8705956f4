#include "validation/reference/Facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/reference/Microfacet.h"

namespace tessera::reference {

glm::dvec3 Facets::direction(const glm::dvec2& random) const {
    const double slope = std::sqrt(random.x / (1.0 - random.x)) * alpha_, angle = 2.0 * std::numbers::pi * random.y;
    const glm::dvec3 half =
        frame_.out(glm::normalize(glm::dvec3(slope * std::cos(angle), slope * std::sin(angle), 1.0)));
    const double cosine = glm::dot(half, toViewer_);
    if (!(cosine > 0.0)) return glm::dvec3(0.0);
    if (send_ == Send::Back) return glm::normalize(2.0 * cosine * half - toViewer_);
    if (ior_ == 0.0) return -half;
    const double cosine2 = 1.0 - (1.0 - cosine * cosine) / (ior_ * ior_);
    if (!(cosine2 > 0.0)) return glm::dvec3(0.0);
    return glm::normalize((cosine / ior_ - std::sqrt(cosine2)) * half - toViewer_ / ior_);
}

Facets::Met Facets::met(const glm::dvec3& direction) const {
    const bool isThrough = send_ == Send::Through;
    const double cosNormal = glm::dot(direction, frame_.z) * (isThrough ? -1.0 : 1.0);
    if (!(cosNormal > 0.0)) return {};
    glm::dvec3 half = isThrough ? (ior_ == 0.0 ? -direction : -(toViewer_ + ior_ * direction)) : toViewer_ + direction;
    const double length = glm::length(half);
    if (!(length > 0.0)) return {};
    half /= glm::dot(half, frame_.z) < 0.0 ? -length : length;
    const double ofViewer = glm::dot(half, toViewer_), ofDirection = glm::dot(half, direction);
    if (!(ofViewer > 0.0) || (ofDirection > 0.0) == isThrough) return {};
    if (!isThrough) return {half, 1.0 / (4.0 * ofViewer), cosNormal};
    if (ior_ == 0.0) return {half, 1.0, cosNormal};
    const double across = ofViewer + ior_ * ofDirection;
    return {half, ior_ * ior_ * std::abs(ofDirection) / (across * across), cosNormal};
}

double Facets::density(const glm::dvec3& direction) const {
    const Met found = met(direction);
    const double cosine = glm::dot(found.half, frame_.z);
    return found.perHalf > 0.0 ? distributionGgx(alpha_, cosine) * cosine * found.perHalf : 0.0;
}

double Facets::share(const glm::dvec3& direction) const {
    const Met found = met(direction);
    if (!(found.perHalf > 0.0)) return 0.0;
    const double ofViewer = glm::dot(found.half, toViewer_), cosView = glm::dot(frame_.z, toViewer_);
    if (!(cosView > 0.0)) return 0.0;
    const double reflected = ior_ == 0.0 ? 0.0 : fresnelDielectric(ior_, ofViewer);
    return ofViewer / cosView * (send_ == Send::Through ? 1.0 - reflected : reflected) * maskingSmith(alpha_, cosView) *
           maskingSmith(alpha_, found.cosNormal) * distributionGgx(alpha_, glm::dot(found.half, frame_.z)) *
           found.perHalf;
}

double Facets::whole() const {
    constexpr int kSlopes = 64, kTurns = 16;
    double sum = 0.0;
    for (int i = 0; i < kSlopes * kTurns; ++i) {
        const glm::dvec3 way = direction({(i % kSlopes + 0.5) / kSlopes, (double(i / kSlopes) + 0.5) / kTurns});
        const double ownDensity = density(way);
        if (ownDensity > 0.0) sum += share(way) / ownDensity;
    }
    return sum / (kSlopes * kTurns);
}

} // namespace tessera::reference
