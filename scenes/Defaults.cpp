#include "scenes/Defaults.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "scenes/Enclosure.h"
#include "scenes/Exposure.h"
#include "scenes/Framing.h"
#include "scenes/InUse.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/RigLinks.h"

namespace tessera::scenes {
namespace {

/// Near plane as a fraction of the bounds' radius: small enough to walk close to things. Depth is reversed and in
/// floating point, so a small near plane costs no precision.
constexpr double kNearShare = 1e-3;
constexpr const char* kDefaultEnvironment = "studio";

std::string studioSource() {
    return std::string(kBuiltinPrefix) + kDefaultEnvironment;
}

const Camera& viewedCamera(const Scene& scene) {
    assert(!scene.cameras.empty());
    const std::optional<std::string>& requested = scene.options.camera;
    return scene.cameras[requested ? cameraCalled(scene, *requested).value_or(0) : 0];
}

/// Rotation of a built-in studio around the scene's camera, matching its place around a default camera, which looks
/// along longitude -45 degrees.
float degreesAroundCamera(const Scene& scene) {
    const glm::dvec3 forwardWS = -glm::dvec3(viewedCamera(scene).worldFromCamera[2]);
    constexpr double kLevel = 1e-6; // a camera that looks straight up or down has no heading
    if (std::hypot(forwardWS.x, forwardWS.z) <= kLevel * glm::length(forwardWS)) return 0.0f;
    const double longitude = glm::degrees(std::atan2(forwardWS.x, -forwardWS.z));
    return float(std::remainder(-45.0 - longitude, 360.0));
}

/// Aspect of the size requested by the scene's options, else of most screens.
double requestedAspect(const Scene& scene) {
    const auto requested = scene.options.requested.find("size");
    if (requested != scene.options.requested.end())
        if (const auto* size = std::get_if<std::vector<double>>(&requested->second))
            if (size->size() == 2 && size->at(0) >= 1.0 && size->at(1) >= 1.0) return size->at(0) / size->at(1);
    return 16.0 / 9.0;
}

/// Whether all materials in use are unlit. Emission does not count: most emissive models glow in few places and are
/// black elsewhere without light.
bool isAllUnlit(const Scene& scene) {
    const std::vector<const Material*> materials = materialsInUse(scene);
    return !materials.empty() && std::all_of(materials.begin(), materials.end(),
                                             [](const Material* material) { return !infoOf(material->model).isLit; });
}

/// Sets an option that the scene's file does not request; returns whether it was set.
bool supplyOption(Scene& scene, const char* key, OptionValue value) {
    const bool isSupplied = scene.options.requested.try_emplace(key, std::move(value)).second;
    if (isSupplied) scene.supplied.requested.insert(key);
    return isSupplied;
}

void addStudio(Scene& scene, LoadLedger& ledger) {
    scene.environment = loadEnvironment(studioSource(), ledger, scene.warnings);
    scene.environment->rotationDegrees = degreesAroundCamera(scene);
    supplyOption(scene, "backdrop", "blurred");
    scene.supplied.light = true;
}

double ownLuminance(const Scene& scene, bool areMatte) {
    return estimatedLuminance(scene, viewedCamera(scene), requestedAspect(scene), areMatte).value_or(0.0);
}

} // namespace

void addDefaultCamera(Scene& scene, std::optional<double> aspect) {
    if (!scene.cameras.empty()) return;
    Camera camera;
    camera.name = kDefaultName;
    camera.fovYRadians = std::numbers::pi / 4.0;
    const Framing whole = framingOf(scene, camera.fovYRadians, aspect.value_or(requestedAspect(scene)));
    const std::optional<Framing> inside = framingInside(scene);
    const Framing& framing = inside ? *inside : whole;
    camera.worldFromCamera = worldFromLookAt(framing.eyeWS, framing.targetWS);
    camera.nearMetres = kNearShare * framing.radiusMetres;
    scene.cameras.push_back(camera);
    scene.supplied.camera = true;
    scene.supplied.isInside = inside.has_value();
}

void leaveOutCameras(Scene& scene) {
    scene.supplied.replacesCameras = !scene.cameras.empty();
    dropCameras(scene);
    scene.options.camera.reset();
}

void addDefaultLight(Scene& scene, LoadLedger& ledger) {
    if (scene.lights.empty() && !scene.environment && !isAllUnlit(scene)) addStudio(scene, ledger);
}

void addFillLight(Scene& scene, LoadLedger& ledger) {
    if (scene.lights.empty() || scene.environment || isAllUnlit(scene)) return;
    constexpr double kOwnLightsLead = 0.25;
    const double exposure = std::exp2(scene.supplied.exposureEV);
    const double own = exposure * ownLuminance(scene, false);
    const double share = std::max(kOwnLightsLead * own, kBrightLuminance - own) / kBrightLuminance;
    addStudio(scene, ledger);
    scene.environment->intensity = static_cast<float>(share / exposure);
    scene.supplied.fillShare = share;
}

OwnEnvironment ownEnvironmentOf(const Scene& scene) {
    OwnEnvironment own;
    if (!scene.environment) {
        own.studioDegrees = chosenStudioDegrees(scene);
    } else if (scene.supplied.light) {
        own.studioDegrees = scene.environment->rotationDegrees;
    } else {
        own.source = scene.environment->source;
        own.view = ownViewOf(*scene.environment);
    }
    return own;
}

float chosenStudioDegrees(const Scene& scene) {
    return scene.supplied.camera ? degreesAroundCamera(scene) : 0.0f;
}

void layAs(const OwnEnvironment& own, Environment& chosen) {
    if (!own.source.empty()) {
        chosen.rotationDegrees = own.view.rotationDegrees;
        if (chosen.source == own.source) chosen.intensity = own.view.intensity;
    } else if (chosen.source == studioSource()) {
        chosen.rotationDegrees = own.studioDegrees;
    }
}

void addDefaultExposure(Scene& scene) {
    if (scene.environment || scene.lights.empty()) return;
    const int stops = fittingExposureEV(ownLuminance(scene, true));
    if (stops != 0 && supplyOption(scene, "exposureEV", double(stops))) scene.supplied.exposureEV = stops;
}

void addDefaultToneMap(Scene& scene) {
    if (!isAllUnlit(scene)) supplyOption(scene, "toneMap", "khronos_neutral");
}

std::string suppliedText(const Scene& scene, Advice advice) {
    const bool isOptions = advice == Advice::Options;
    const auto& [camera, light, fillShare, replacesCameras, exposureEV, isInside, requested] = scene.supplied;
    std::string lacks, given;
    if (light) {
        if (fillShare == 0.0) lacks = "no light";
        const bool isBlurred = requested.contains("backdrop");
        const std::string besides =
            fillShare == 0.0 ? "" : fmt::format(" at {:.0f} % beside its own lights", 100.0 * fillShare);
        given = fmt::format("lit by the environment '{}'{}{} ({})", kDefaultEnvironment, besides,
                            isBlurred ? ", blurred behind it" : "",
                            isOptions ? "--environment, --backdrop or --no-default-light change that"
                                      : "the panel Environment changes that");
    }
    if (camera) {
        if (!replacesCameras) lacks += lacks.empty() ? "no camera" : " and no camera";
        const bool isEmpty = triangleCount(scene) == 0;
        given += fmt::format("{}{} by the supplied camera '{}'{}{}", light ? ", " : "",
                             isEmpty    ? "seen around the origin"
                             : isInside ? "seen from inside"
                                        : "seen whole",
                             kDefaultName, replacesCameras ? " in the place of its own" : "",
                             isEmpty ? ", as there are no triangles" : "");
    }
    std::string text = lacks.empty() ? given : fmt::format("{} in it: {}", lacks, given);
    if (exposureEV != 0)
        text += fmt::format("{}its lights are too {} for a display: exposed by {:+} EV ({} chooses another)",
                            text.empty() ? "" : "; ", exposureEV > 0 ? "dim" : "bright", exposureEV,
                            isOptions ? "--exposure" : "the panel View");
    return text;
}

} // namespace tessera::scenes
