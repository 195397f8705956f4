#include "viewer/edit/LightFigure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/AreaLight.h"
#include "viewer/edit/HandlePlacer.h"

namespace tessera::viewer {
namespace {

constexpr double kArm = 70.0;       ///< from a light's middle or end to its direction handle
constexpr double kMoveArm = 100.0;  ///< the same to the ends of the move arms, if seen from the side
constexpr double kMostArm = 0.2;    ///< of both, fraction of the image's shorter side: they must not reach the viewer
constexpr double kSunInset = 100.0; ///< of a directional light's sun from the image's right and upper edge
constexpr double kSunRoom = 3.0;    ///< least width and height of an image with room for it, in insets
constexpr int kCircleSteps = 48;

using Outline = std::vector<glm::dvec3>;

/// A closed line; the half axes are perpendicular.
Outline ellipseWS(const glm::dvec3& centreWS, const glm::dvec3& halfWS, const glm::dvec3& otherHalfWS) {
    Outline ellipse;
    for (int step = 0; step <= kCircleSteps; ++step) {
        const double angle = 2.0 * std::numbers::pi * (step % kCircleSteps) / kCircleSteps;
        ellipse.push_back(centreWS + std::cos(angle) * halfWS + std::sin(angle) * otherHalfWS);
    }
    return ellipse;
}

/// Where lines of sight touch a circle, in its plane: metres from its centre towards the eye, and sideways.
struct Rim {
    double towards = 0.0, aside = 0.0;
};
/// None if the eye is inside. Its distance from the centre may be infinite (orthographic).
std::optional<Rim> rimOf(double radiusMetres, double eyeMetres) {
    if (!(eyeMetres > radiusMetres)) return std::nullopt;
    const double cosine = radiusMetres / eyeMetres;
    return Rim{radiusMetres * cosine, radiusMetres * std::sqrt(1.0 - cosine * cosine)};
}

/// Adds the parts of a light's type to a figure.
class FigureMaker {
public:
    FigureMaker(const scenes::Light& light, const PictureView& view, double scale, LightFigure& figure)
        : light_(light), view_(view), scale_(scale), figure_(figure), placer_(light, view, scale, figure) {}

    void make() {
        const scenes::LightTypeInfo& info = scenes::infoOf(light_.type);
        if (info.hasPosition())
            figure_.middleWS = light_.positionWS;
        else if (!placeSun())
            return;
        double reachMetres = 0.0; // extent of the outline along the direction
        switch (light_.type) {
        case scenes::LightType::Spot:
            addCone();
            break;
        case scenes::LightType::Rectangle:
            addRectangle();
            break;
        case scenes::LightType::Disk:
            addDisk();
            break;
        case scenes::LightType::Sphere:
            addSphere();
            break;
        case scenes::LightType::Tube:
            addTube();
            reachMetres = 0.5 * double(light_.lengthMetres);
            break;
        case scenes::LightType::Polygon:
            addPolygon();
            break;
        default:
            break;
        }
        if (info.hasDirection) addDirection(reachMetres);
        if (info.hasPosition()) addArms(); // last: they yield to the other handles
        if (info.hasPosition() && light_.falloff != scenes::Falloff::Attenuation && std::isfinite(light_.rangeMetres))
            addRange();
    }

private:
    bool placeSun() {
        const double inset = kSunInset * scale_;
        if (std::min(view_.size().x, view_.size().y) < kSunRoom * inset) return false;
        figure_.sun = glm::dvec2(view_.size().x - inset, inset);
        const SightLine line = view_.sightLineAt(*figure_.sun);
        // Any depth will do at which the arm does not reach back to the near plane.
        const double nearMetres = std::max(view_.nearMetres(), 1e-3);
        figure_.middleWS = line.originWS + 10.0 * nearMetres * line.directionWS;
        if (!view_.isPerspective()) figure_.middleWS += 2.0 * armMetres(kArm).value_or(0.0) * line.directionWS;
        return true;
    }

    /// World length of an arm with this length in a side view; none if the middle lies behind the camera.
    std::optional<double> armMetres(double lengthUnits) const {
        const std::optional<double> metresPerUnit = view_.metresPerUnit(figure_.middleWS);
        if (!metresPerUnit) return std::nullopt;
        const double shorterSide = std::min(view_.size().x, view_.size().y);
        return std::min(lengthUnits * scale_, kMostArm * shorterSide) * *metresPerUnit;
    }

    const scenes::LightParameter* parameterOf(float scenes::Light::*member) const {
        const scenes::LightTypeInfo& info = scenes::infoOf(light_.type);
        const auto found = std::ranges::find(info.parameters, member, &scenes::LightParameter::member);
        return found != info.parameters.end() ? &*found : scenes::sizeParameter(info);
    }

    /// Adds handles on both sides of the middle that change a length along an axis.
    void addPair(float scenes::Light::*member, const glm::dvec3& axisWS, double share) {
        for (const double side : {1.0, -1.0}) {
            LightHandle handle;
            handle.parameter = parameterOf(member);
            handle.axisWS = side * axisWS;
            handle.share = share;
            handle.positionWS = figure_.middleWS + share * double(light_.*member) * handle.axisWS;
            placer_.add(handle);
        }
    }

    /// Draws the cone as far as the direction handle.
    void addCone() {
        constexpr double kWidestRadians = 1.4; // wider cones would fill the image
        const std::optional<double> arm = armMetres(kArm);
        if (!arm || double(light_.outerConeRadians) > kWidestRadians) return;
        const double radiusMetres = *arm * std::tan(double(light_.outerConeRadians));
        const glm::dvec3 alongWS = radiusMetres * scenes::usualAlong(light_.directionWS);
        const glm::dvec3 acrossWS = glm::cross(light_.directionWS, alongWS);
        const glm::dvec3 endWS = figure_.middleWS + *arm * light_.directionWS;
        figure_.outlinesWS.push_back(ellipseWS(endWS, alongWS, acrossWS));
        figure_.outlinesWS.push_back({endWS + alongWS, figure_.middleWS, endWS - alongWS});
        figure_.outlinesWS.push_back({endWS + acrossWS, figure_.middleWS, endWS - acrossWS});
    }

    /// For a spot its cone, for other lights the outline of a sphere, or its horizontal circle if the eye is inside.
    void addRange() {
        const double rangeMetres = light_.rangeMetres, coneRadians = light_.outerConeRadians;
        const glm::dvec3& middleWS = figure_.middleWS;
        if (light_.type == scenes::LightType::Spot && coneRadians < 0.5 * std::numbers::pi) {
            const glm::dvec3 alongWS = rangeMetres * std::sin(coneRadians) * scenes::usualAlong(light_.directionWS);
            const glm::dvec3 acrossWS = glm::cross(light_.directionWS, alongWS);
            const glm::dvec3 endWS = middleWS + rangeMetres * std::cos(coneRadians) * light_.directionWS;
            figure_.rangeWS.push_back(ellipseWS(endWS, alongWS, acrossWS));
            figure_.rangeWS.push_back({endWS + alongWS, middleWS, endWS - alongWS});
            figure_.rangeWS.push_back({endWS + acrossWS, middleWS, endWS - acrossWS});
            return;
        }
        glm::dvec3 rightWS(1.0, 0.0, 0.0), upWS(0.0, 0.0, 1.0), centreWS = middleWS;
        double radiusMetres = rangeMetres;
        if (const std::optional<Rim> rim = rimOf(rangeMetres, eyeMetres(view_.eyeWS() - middleWS))) {
            const glm::dvec3 towardsWS = view_.towardsViewerWS(middleWS);
            if (const auto acrossWS = scenes::acrossFrom(towardsWS, view_.rightWS())) {
                rightWS = *acrossWS;
                upWS = glm::cross(towardsWS, rightWS);
                centreWS += rim->towards * towardsWS;
                radiusMetres = rim->aside;
            }
        }
        figure_.rangeWS.push_back(ellipseWS(centreWS, radiusMetres * rightWS, radiusMetres * upWS));
    }

    void addRectangle() {
        const glm::dvec3 acrossWS = glm::cross(light_.directionWS, light_.alongWS);
        const glm::dvec3 halfWS = 0.5 * double(light_.widthMetres) * light_.alongWS;
        const glm::dvec3 otherHalfWS = 0.5 * double(light_.heightMetres) * acrossWS;
        const glm::dvec3 firstWS = figure_.middleWS + halfWS + otherHalfWS;
        figure_.outlinesWS.push_back({firstWS, firstWS - 2.0 * halfWS, figure_.middleWS - halfWS - otherHalfWS,
                                      firstWS - 2.0 * otherHalfWS, firstWS});
        addPair(&scenes::Light::widthMetres, light_.alongWS, 0.5);
        addPair(&scenes::Light::heightMetres, acrossWS, 0.5);
    }

    void addPolygon() {
        const glm::dvec3 acrossWS = glm::cross(light_.directionWS, light_.alongWS);
        Outline outline;
        for (const glm::vec2& corner : light_.corners.all())
            outline.push_back(figure_.middleWS + double(corner.x) * light_.alongWS + double(corner.y) * acrossWS);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            LightHandle handle;
            handle.corner = int(i);
            handle.positionWS = outline[i];
            placer_.add(handle);
        }
        outline.push_back(outline.front());
        figure_.outlinesWS.push_back(outline);
    }

    void addDisk() {
        const double radiusMetres = light_.radiusMetres;
        const glm::dvec3 alongWS = scenes::usualAlong(light_.directionWS);
        const glm::dvec3 acrossWS = glm::cross(light_.directionWS, alongWS);
        figure_.outlinesWS.push_back(ellipseWS(figure_.middleWS, radiusMetres * alongWS, radiusMetres * acrossWS));
        addPair(&scenes::Light::radiusMetres, alongWS, 1.0);
        addPair(&scenes::Light::radiusMetres, acrossWS, 1.0);
    }

    double eyeMetres(const glm::dvec3& eyeFromMiddleWS) const {
        return view_.isPerspective() ? glm::length(eyeFromMiddleWS) : std::numeric_limits<double>::infinity();
    }

    void addAtRim(const glm::dvec3& positionWS, const glm::dvec3& outwardsWS) {
        LightHandle handle;
        handle.parameter = parameterOf(&scenes::Light::radiusMetres);
        handle.axisWS = outwardsWS;
        handle.isRound = true;
        handle.positionWS = positionWS;
        placer_.add(handle);
    }

    void addSphere() {
        const std::optional<Rim> rim = rimOf(light_.radiusMetres, eyeMetres(view_.eyeWS() - figure_.middleWS));
        if (!rim) return;
        const glm::dvec3 towardsWS = view_.towardsViewerWS(figure_.middleWS);
        const std::optional<glm::dvec3> rightWS = scenes::acrossFrom(towardsWS, view_.rightWS());
        if (!rightWS) return;
        const glm::dvec3 upWS = glm::cross(towardsWS, *rightWS);
        const glm::dvec3 centreWS = figure_.middleWS + rim->towards * towardsWS;
        figure_.outlinesWS.push_back(ellipseWS(centreWS, rim->aside * *rightWS, rim->aside * upWS));
        for (const glm::dvec3& outWS : {*rightWS, upWS, -*rightWS, -upWS})
            addAtRim(centreWS + rim->aside * outWS, outWS);
    }

    void addTube() {
        const double radiusMetres = light_.radiusMetres;
        const glm::dvec3& axisWS = light_.directionWS;
        const glm::dvec3 halfWS = 0.5 * double(light_.lengthMetres) * axisWS;
        const glm::dvec3 alongWS = scenes::usualAlong(axisWS), acrossWS = glm::cross(axisWS, alongWS);
        for (const double side : {1.0, -1.0})
            figure_.outlinesWS.push_back(
                ellipseWS(figure_.middleWS + side * halfWS, radiusMetres * alongWS, radiusMetres * acrossWS));
        addPair(&scenes::Light::lengthMetres, axisWS, 0.5);
        // Its silhouette lies where lines of sight touch its cross-section.
        const glm::dvec3 eyeFromMiddleWS = view_.eyeWS() - figure_.middleWS;
        const glm::dvec3 eyeAcrossWS = eyeFromMiddleWS - glm::dot(eyeFromMiddleWS, axisWS) * axisWS;
        const std::optional<Rim> rim = rimOf(radiusMetres, eyeMetres(eyeAcrossWS));
        if (!rim) return;
        const auto towardsWS = scenes::acrossFrom(axisWS, view_.towardsViewerWS(figure_.middleWS));
        if (!towardsWS) return;
        const glm::dvec3 besideWS = glm::cross(axisWS, *towardsWS);
        for (const double side : {1.0, -1.0}) {
            const glm::dvec3 touchedWS = figure_.middleWS + rim->towards * *towardsWS + side * rim->aside * besideWS;
            figure_.outlinesWS.push_back({touchedWS - halfWS, touchedWS + halfWS});
            addAtRim(touchedWS, side * besideWS);
        }
    }

    void addDirection(double reachMetres) {
        const std::optional<double> arm = armMetres(kArm);
        if (!arm) return;
        LightHandle handle;
        handle.axisWS = light_.directionWS;
        handle.positionWS = figure_.middleWS + (reachMetres + *arm) * light_.directionWS;
        figure_.outlinesWS.push_back({figure_.middleWS + reachMetres * light_.directionWS, handle.positionWS});
        placer_.add(handle);
    }

    /// Along the world axes. For an arm that points nearly at the eye, or away, a small movement in the image is a
    /// large one in the scene.
    void addArms() {
        const std::optional<double> arm = armMetres(kMoveArm);
        if (!arm) return;
        for (int axis = 0; axis < 3; ++axis) {
            LightHandle handle;
            handle.arm = axis;
            handle.axisWS[axis] = 1.0;
            handle.positionWS = figure_.middleWS + *arm * handle.axisWS;
            placer_.add(handle);
        }
    }

    const scenes::Light& light_;
    const PictureView& view_;
    double scale_;
    LightFigure& figure_;
    HandlePlacer placer_;
};

} // namespace

LightFigure lightFigure(const scenes::Light& light, const PictureView& view, double scale) {
    LightFigure figure;
    FigureMaker(light, view, scale, figure).make();
    return figure;
}

} // namespace tessera::viewer
