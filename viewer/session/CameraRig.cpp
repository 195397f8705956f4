#include "viewer/session/CameraRig.h"

#include <cmath>

namespace tessera::viewer {
namespace {

constexpr double kZoomPerStep = 0.88; ///< distance factor per wheel step

} // namespace

CameraRig::CameraRig(const scenes::Camera& start, const CameraPose& home, const scenes::Box3& boundsWS)
    : start_(start), home_(home), boundsWS_(boundsWS), orbit_(home, start), fly_(home, start, boundsWS) {}

void CameraRig::setMode(Mode mode) {
    if (mode == mode_) return;
    fly_.hold({});
    if (mode == Mode::Fly) {
        fly_.jumpTo(orbit_.pose());
        fly_.goTo(orbit_.goal());
    } else {
        orbit_.jumpTo(fly_.pose());
        orbit_.goTo(fly_.goal());
    }
    mode_ = mode;
}

void CameraRig::moveAs(const CameraRig& other) {
    setMode(other.mode_);
    fly_.takeSpeedFactor(other.fly_);
}

void CameraRig::rotate(const glm::dvec2& dragPixels, double heightPixels) {
    mode_ == Mode::Orbit ? orbit_.rotate(dragPixels, heightPixels) : fly_.look(dragPixels, heightPixels);
}

void CameraRig::pan(const glm::dvec2& dragPixels, double heightPixels) {
    if (mode_ == Mode::Orbit) orbit_.pan(dragPixels, heightPixels);
}

void CameraRig::zoom(double factor, const glm::dvec2& cursorFromCenterPixels, double heightPixels) {
    if (mode_ == Mode::Orbit) orbit_.zoom(factor, cursorFromCenterPixels, heightPixels);
}

void CameraRig::wheel(double steps, const glm::dvec2& cursorFromCenterPixels, double heightPixels) {
    if (mode_ == Mode::Orbit)
        orbit_.zoom(std::pow(kZoomPerStep, steps), cursorFromCenterPixels, heightPixels);
    else
        fly_.changeSpeed(steps);
}

void CameraRig::hold(const FlyKeys& keys) {
    fly_.hold(mode_ == Mode::Fly ? keys : FlyKeys{});
}

void CameraRig::frame(const scenes::Box3& boundsWS, double aspect) {
    const CameraPose from = mode_ == Mode::Orbit ? orbit_.goal() : fly_.goal();
    goTo(frameBounds(boundsWS, from, start_, aspect));
}

void CameraRig::turnAbout(const glm::dvec3& pivotWS) {
    if (mode_ == Mode::Fly) return;
    CameraPose pose = orbit_.goal();
    const glm::dvec3 forwardWS = pose.heading.forwardWS();
    const double depthMetres = glm::dot(pivotWS - pose.eyeWS, forwardWS);
    if (!(depthMetres > 0.0)) return;
    pose.focusMetres = depthMetres;
    pose.eyeWS = pivotWS - depthMetres * forwardWS;
    goTo(pose);
}

void CameraRig::look(const Heading& heading, double aspect) {
    CameraPose pose = mode_ == Mode::Orbit ? orbit_.goal() : fly_.goal();
    const glm::dvec3 pivotWS = pose.eyeWS + pose.focusMetres * pose.heading.forwardWS();
    pose.heading = heading;
    const bool isWithin = glm::all(glm::lessThanEqual(boundsWS_.min, pose.eyeWS)) &&
                          glm::all(glm::lessThanEqual(pose.eyeWS, boundsWS_.max));
    if (!boundsWS_.empty() && !isWithin) return goTo(frameBounds(boundsWS_, pose, start_, aspect));
    pose.eyeWS = pivotWS - pose.focusMetres * heading.forwardWS();
    goTo(pose);
}

void CameraRig::goHome() {
    goTo(home_);
}

void CameraRig::goTo(const CameraPose& pose) {
    mode_ == Mode::Orbit ? orbit_.goTo(pose) : fly_.goTo(pose);
}

void CameraRig::jumpTo(const CameraPose& pose) {
    mode_ == Mode::Orbit ? orbit_.jumpTo(pose) : fly_.jumpTo(pose);
}

void CameraRig::advance(double stepSeconds, double heightPixels) {
    mode_ == Mode::Orbit ? orbit_.advance(stepSeconds, heightPixels) : fly_.advance(stepSeconds, heightPixels);
}

bool CameraRig::isAtRest() const {
    return mode_ == Mode::Orbit ? orbit_.isAtRest() : fly_.isAtRest();
}

void CameraRig::startAt(const scenes::Camera& start, const CameraPose& home) {
    start_ = start;
    home_ = home;
}

const CameraPose& CameraRig::pose() const {
    return mode_ == Mode::Orbit ? orbit_.pose() : fly_.pose();
}

} // namespace tessera::viewer
