#include "renderer/frame/SeenLights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/frame/DebugViews.h"
#include "renderer/frame/LightPictures.h"
#include "renderer/frame/LightRange.h"
#include "renderer/frame/PackedLights.h"
#include "scenes/AreaLight.h"

namespace tessera::frame {

namespace {

using Corners = std::array<glm::dvec3, 8>;

static_assert(scenes::kAreaTypeCount == 5 && scenes::kFlatTypeCount == 3,
              "a new shape needs its box in reachWS(), its back or inside in turnsAway() and its numbers in "
              "packSeenLights()");

/// Half extents of a box around the surface, centred at the light's position: three perpendicular vectors in metres;
/// the third is 0 for flat lights.
std::array<glm::dvec3, 3> reachWS(const scenes::Light& light) {
    const double radius = light.radiusMetres;
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (!info.hasDirection) return {glm::dvec3(radius, 0, 0), glm::dvec3(0, radius, 0), glm::dvec3(0, 0, radius)};
    const glm::dvec3 along = scenes::alongOf(light);
    const glm::dvec3 across = glm::cross(light.directionWS, along);
    if (info.hasCorners()) {
        glm::dvec2 most(0.0); // to either side of the position
        for (const glm::vec2& corner : light.corners.all()) most = glm::max(most, glm::abs(glm::dvec2(corner)));
        return {most.x * along, most.y * across, glm::dvec3(0.0)};
    }
    if (info.hasSides())
        return {0.5 * double(light.widthMetres) * along, 0.5 * double(light.heightMetres) * across, glm::dvec3(0.0)};
    const double length = info.isFlat ? 0.0 : double(light.lengthMetres);
    return {radius * along, radius * across, 0.5 * length * light.directionWS};
}

Corners cornersAround(const scenes::Light& light) {
    const std::array<glm::dvec3, 3> reach = reachWS(light);
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = light.positionWS;
        for (std::size_t axis = 0; axis < 3; ++axis) corners[i] += ((i >> axis & 1) != 0 ? 1.0 : -1.0) * reach[axis];
    }
    return corners;
}

/// A rectangle that is empty until places are added.
struct Window {
    glm::dvec2 least{std::numeric_limits<double>::infinity()}, most{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec2& place) {
        least = glm::min(least, place);
        most = glm::max(most, place);
    }
    bool meetsPicture() const {
        return glm::all(glm::lessThan(least, glm::dvec2(1.0))) && glm::all(glm::greaterThan(most, glm::dvec2(-1.0)));
    }
};

/// Bounds of a box's projection in normalised device coordinates: of its corners beyond the near plane, and of its
/// edges' intersections with that plane.
Window windowOf(const Corners& cornersWS, const scenes::Camera& camera, glm::ivec2 sizePixels) {
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const double halfHeight = isPerspective ? std::tan(0.5 * camera.fovYRadians) : camera.halfHeightMetres;
    const glm::dvec2 half(halfHeight * double(sizePixels.x) / double(sizePixels.y), halfHeight);
    const glm::dmat3 viewFromWorld = glm::transpose(glm::dmat3(camera.worldFromCamera));
    Corners cornersVS;
    std::ranges::transform(cornersWS, cornersVS.begin(), [&](const glm::dvec3& corner) {
        return viewFromWorld * (corner - glm::dvec3(camera.worldFromCamera[3]));
    });
    const auto ahead = [](const glm::dvec3& placeVS) { return -placeVS.z; };
    Window window;
    if (std::ranges::all_of(cornersVS, [&](const glm::dvec3& corner) { return ahead(corner) > camera.farMetres; }))
        return window;
    const auto add = [&](const glm::dvec3& placeVS) {
        window.add(glm::dvec2(placeVS) / (isPerspective ? ahead(placeVS) * half : half));
    };
    for (std::size_t i = 0; i < cornersVS.size(); ++i) {
        const glm::dvec3& from = cornersVS[i];
        if (ahead(from) >= camera.nearMetres) add(from);
        for (const std::size_t axis : {1u, 2u, 4u}) {
            if ((i & axis) != 0) continue;
            const glm::dvec3& to = cornersVS[i | axis];
            const double a = ahead(from) - camera.nearMetres, b = ahead(to) - camera.nearMetres;
            if ((a < 0.0) == (b < 0.0)) continue;
            glm::dvec3 place = from + (a / (a - b)) * (to - from);
            place.z = -camera.nearMetres;
            add(place);
        }
    }
    // Margin for fp32 rounding, and for samples away from the pixel centre.
    constexpr double kRoomPixels = 2.0;
    const glm::dvec2 room = 2.0 * kRoomPixels / glm::dvec2(sizePixels);
    window.least -= room;
    window.most += room;
    return window;
}

/// Whether no emitting side of the surface faces the eye.
bool turnsAway(const scenes::Light& light, const scenes::Camera& camera) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const glm::dvec3 toEyeWS = isPerspective ? glm::dvec3(camera.worldFromCamera[3]) - light.positionWS
                                             : glm::dvec3(camera.worldFromCamera[2]);
    const double along = glm::dot(toEyeWS, light.directionWS);
    if (info.isFlat) return light.isTwoSided ? along == 0.0 : !(along > 0.0);
    if (!isPerspective) return false; // rays start all over the image
    const double radius = light.radiusMetres;
    if (!info.hasDirection) return glm::length(toEyeWS) <= radius;
    return std::abs(along) <= 0.5 * double(light.lengthMetres) &&
           glm::length(toEyeWS - along * light.directionWS) <= radius;
}

/// The light at the frame's time, if its surface may be visible to any camera.
std::optional<scenes::Light> shownLight(const scenes::Scene& scene, std::size_t index, const FrameSettings& settings) {
    const scenes::Light& still = scene.lights[index];
    if (!scenes::infoOf(still.type).isArea || !still.isSeen || !still.enabled) return {};
    if (settings.soloLight && *settings.soloLight != int(index)) return {};
    const scenes::Light own = lightAtTime(still, settings.timeSeconds);
    if (!scenes::hasSurface(own) || glm::vec3(mostColor(own)) == glm::vec3(0.0f)) return {};
    if (!(reachMetres(own, settings.rangeTolerance) > 0.0)) return {};
    return own;
}

} // namespace

std::vector<SeenLight> seenLights(const scenes::Scene& scene, const scenes::Camera& camera,
                                  const FrameSettings& settings) {
    std::vector<SeenLight> seen;
    const LightPictures pictures = lightPictures(scene);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const std::optional<scenes::Light> light = shownLight(scene, i, settings);
        if (!light || turnsAway(*light, camera)) continue;
        const Corners corners = cornersAround(*light);
        const Window window = windowOf(corners, camera, settings.sizePixels);
        if (!window.meetsPicture()) continue;
        SeenLight added{*light, pictures.numberOf(i), {}, glm::max(window.least, -1.0), glm::min(window.most, 1.0)};
        for (const glm::dvec3& corner : corners) {
            added.bounds.boxWS.extend(corner);
            added.bounds.reachMetres = std::max(added.bounds.reachMetres, glm::distance(corner, light->positionWS));
        }
        added.bounds.nodeWS = light->positionWS;
        seen.push_back(added);
    }
    return seen;
}

std::vector<shared::SeenLightTexels> packSeenLights(const std::vector<SeenLight>& lights, const CameraView& view) {
    std::vector<shared::SeenLightTexels> packed;
    for (const SeenLight& seen : lights) {
        const scenes::Light& light = seen.light;
        const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
        const auto unitLS = [&](const glm::dvec3& directionWS) { return glm::vec3(view.lsFromWorld * directionWS); };
        shared::SeenLightTexels& texels = packed.emplace_back();
        texels.window = glm::vec4(seen.leastNdc, seen.mostNdc);
        texels.radiance = glm::vec4(glm::vec3(lightColor(light)), packSides(light.isTwoSided, seen.picture));
        texels.middle = glm::vec4(glm::vec3(view.positionLS(light.positionWS)), float(light.type));
        texels.along = texels.across = glm::vec4(0.0f, 0.0f, 0.0f, light.radiusMetres);
        if (info.isFlat) {
            const glm::dvec3 alongWS = scenes::alongOf(light);
            texels.along = glm::vec4(unitLS(alongWS), info.hasSides() ? 0.5f * light.widthMetres : light.radiusMetres);
            texels.across = glm::vec4(unitLS(glm::cross(light.directionWS, alongWS)),
                                      info.hasSides() ? 0.5f * light.heightMetres : light.radiusMetres);
        } else if (info.hasDirection) {
            texels.along = glm::vec4(unitLS(light.directionWS), 0.5f * light.lengthMetres);
        }
        if (info.hasCorners()) {
            const std::span<const glm::vec2> corners = light.corners.all();
            texels.along.w = float(corners.size());
            texels.across.w = float(scenes::surfaceReachMetres(light));
            for (std::size_t i = 0; i < corners.size(); ++i) packCorner(texels.corners, i, corners[i]);
        }
    }
    return packed;
}

std::string whyNoSeenLights(const scenes::Scene& scene, const FrameSettings& settings) {
    const auto isArea = [](const scenes::Light& light) { return scenes::infoOf(light.type).isArea; };
    if (std::ranges::none_of(scene.lights, isArea)) return "no light has one";
    if (!showsLitPicture(settings.view)) return "the view shows no lit picture";
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (shownLight(scene, i, settings)) return "none that shines is in view from a side that shines";
    return "no light that has one shines and is to be seen";
}

} // namespace tessera::frame
