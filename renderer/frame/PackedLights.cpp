#include "renderer/frame/PackedLights.h"

#include <algorithm>
#include <cmath>

#include "scenes/AreaLight.h"
#include "scenes/Shadows.h"
#include "shaders/shared/culling.h"

namespace tessera::frame {

namespace {

bool isDark(const scenes::Light& light, double reach) {
    if (glm::vec3(mostColor(light)) == glm::vec3(0.0f) || reach == 0.0) return true;
    return scenes::infoOf(light.type).reach == scenes::LightReach::Cone && !(light.outerConeRadians > 0.0f);
}

bool isUnseen(const scenes::Light& light, double reach, const CameraView& view) {
    if (std::isinf(reach)) return false;
    const glm::dvec4 position(view.positionLS(light.positionWS), 1.0);
    // The margin covers the rounding of the packed position and of rebuilt surface positions to fp32.
    const double farthestMetres = reach + glm::length(glm::dvec3(position));
    const double margin = double(shared::roundingMargin(float(farthestMetres), view.constants.depthKey));
    return std::any_of(view.frustumPlanesLS.begin(), view.frustumPlanesLS.end(),
                       [&](const glm::dvec4& plane) { return glm::dot(plane, position) < -(reach + margin); });
}

/// 1/range^2, enlarged by eight fp32 steps: the shader multiplies it by a squared distance that three roundings may
/// have reduced, and at the range the light must be exactly 0. A range whose square nears the maximum of fp32 is packed
/// as unlimited: no position is that far.
float inverseSquaredRange(double rangeMetres) {
    if (rangeMetres > 1e18) return 0.0f;
    return float((1.0 + 0x1p-20) / (rangeMetres * rangeMetres));
}

/// All packed data of a light.
struct PackedLight {
    int sceneIndex = 0;
    shared::LightTexels texels{};
    shared::LightShapeTexels shape{};
    shared::LightShadowTexels shadow{};
};

/// Packs the cone of a LightReach::Cone type, as in KHR_lights_punctual: clamp((cos angle - cos outer) / max(0.001, cos
/// inner - cos outer), 0, 1), squared by the shader, in a form without cancellation (shared/light.h). Returns
/// LIGHT_BROAD or 0.
int packCone(const scenes::Light& light, const glm::dvec3& travelLS, shared::LightShapeTexels& shape) {
    const double outer = double(light.outerConeRadians), cosOuter = std::cos(outer);
    const double scale = 1.0 / std::max(0.001, std::cos(double(light.innerConeRadians)) - cosOuter);
    if (std::abs(cosOuter) < 0.5) {
        shape.axis = glm::vec4(glm::vec3(travelLS), float(scale));
        shape.attenuation.w = float(-cosOuter * scale);
        return LIGHT_BROAD;
    }
    const double side = cosOuter > 0.0 ? 1.0 : -1.0;
    // 2 root^2 = 1 - |cos outer|.
    const double root = cosOuter > 0.0 ? std::sin(0.5 * outer) : std::cos(0.5 * outer);
    shape.axis = glm::vec4(glm::vec3(side * travelLS), float(side * 0.5 * scale));
    shape.attenuation.w = float(side * 2.0 * root * root * scale);
    return 0;
}

/// Packs the direction and up to two parameters.
void packParameters(const scenes::Light& light, const glm::dvec3& travelLS, shared::LightShapeTexels& shape) {
    const std::span<const scenes::LightParameter> parameters = scenes::infoOf(light.type).parameters;
    const auto valueOf = [&](std::size_t i) { return i < parameters.size() ? light.*parameters[i].member : 0.0f; };
    shape.axis = glm::vec4(glm::vec3(travelLS), valueOf(0));
    shape.attenuation.w = valueOf(1);
}
static_assert(std::ranges::all_of(scenes::lightTypes(),
                                  [](const scenes::LightTypeInfo& info) { return info.parameters.size() <= 2; }),
              "more parameters need room in LightShapeTexels (shaders/shared/light.h)");

static_assert(scenes::kAreaTypeCount == 5 && scenes::kFlatTypeCount == 3,
              "a new shape needs its vectors in packArea(), and what they reach in surfaceReachMetres()");

/// Packs the surface of an area light (shared/light.h).
void packArea(const scenes::Light& light, int picture, const glm::dmat3& lsFromWorld, shared::LightShapeTexels& shape) {
    const glm::dvec3 travelLS = lsFromWorld * light.directionWS;
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const auto metres = [](const glm::dvec3& directionLS, float length) {
        return glm::vec3(directionLS * double(length));
    };
    if (info.isFlat) {
        const glm::dvec3 alongLS = lsFromWorld * scenes::alongOf(light);
        const glm::dvec3 acrossLS = glm::cross(travelLS, alongLS);
        const float radius = info.hasCorners() ? float(scenes::surfaceReachMetres(light)) : light.radiusMetres;
        const float along = info.hasSides() ? 0.5f * light.widthMetres : radius;
        const float across = info.hasSides() ? 0.5f * light.heightMetres : radius;
        const double product = double(along) * double(across);
        const double areaShare = info.hasCorners() ? std::abs(scenes::signedArea(light.corners)) / product : 0.0;
        shape.axis = glm::vec4(metres(alongLS, along), float(areaShare));
        shape.attenuation = glm::vec4(metres(acrossLS, across), packSides(light.isTwoSided, picture));
    } else {
        const float along = info.hasDirection ? 0.5f * light.lengthMetres : 0.0f;
        shape.axis = glm::vec4(metres(travelLS, along), light.radiusMetres);
    }
}

/// Packs the outline of a polygon; zeros for other types (shared/light.h).
shared::LightCornerTexels packCorners(const scenes::Light& light) {
    shared::LightCornerTexels packed{};
    if (!scenes::infoOf(light.type).hasCorners()) return packed;
    const auto perMetre = 1.0 / double(float(scenes::surfaceReachMetres(light)));
    scenes::LightCorners outline = light.corners; // counterclockwise
    if (scenes::signedArea(outline) < 0.0)
        std::reverse(outline.metres.begin(), outline.metres.begin() + std::ptrdiff_t(outline.count));
    const std::span<const glm::vec2> corners = outline.all();
    packed.outline = glm::vec4(glm::vec2(scenes::middleOf(outline) * perMetre), float(corners.size()), 0.0f);
    for (std::size_t i = 0; i < corners.size(); ++i)
        packCorner(packed.corners, i, glm::vec2(glm::dvec2(corners[i]) * perMetre));
    const auto triangles = scenes::trianglesOf(outline);
    const double area = scenes::signedArea(outline);
    std::array<float, 5> ends{1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    std::array<int, 3> numbers{};
    double sum = 0.0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        scenes::LightCorners triangle;
        triangle.count = 3;
        triangle.metres = {corners[a], corners[b], corners[c]};
        sum += area > 0.0 ? scenes::signedArea(triangle) / area : 0.0;
        if (i + 1 < triangles.size()) ends[i] = std::min(float(sum), 1.0f);
        numbers[i / 2] |= (a | b << 3 | c << 6) << (i % 2 == 0 ? 0 : 9);
    }
    packed.shareEnds = {ends[0], ends[1], ends[2], ends[3]};
    packed.lastEnd = {ends[4], float(numbers[0]), float(numbers[1]), float(numbers[2])};
    return packed;
}
static_assert(sizeof(shared::LightCornerTexels) == LIGHT_CORNER_TEXELS * sizeof(glm::vec4));
static_assert(scenes::LightCorners::kMost == 2 * std::size(shared::LightCornerTexels{}.corners));

PackedLight packLight(const scenes::Light& light, int picture, double reach, const CameraView& view) {
    PackedLight result;
    shared::LightTexels& packed = result.texels;
    const glm::dvec3 travelLS = view.lsFromWorld * light.directionWS;
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    int kind = int(light.type);
    if (!info.hasPosition()) {
        packed.position = glm::vec4(glm::vec3(-travelLS), 0.0f);
    } else {
        packed.position = glm::vec4(glm::vec3(view.positionLS(light.positionWS)), inverseSquaredRange(reach));
        if (light.falloff == scenes::Falloff::Attenuation) {
            kind |= LIGHT_ATTENUATION;
            result.shape.attenuation = glm::vec4(light.attenuation, 0.0f);
        }
    }
    result.shadow.shadow.x =
        float(info.hasPosition() ? scenes::shadowRadiusMetres(light) : std::tan(double(light.angularRadiusRadians)));
    if (info.reach == scenes::LightReach::Cone)
        kind |= packCone(light, travelLS, result.shape);
    else if (info.isArea)
        packArea(light, picture, view.lsFromWorld, result.shape);
    else if (info.hasShape())
        packParameters(light, travelLS, result.shape);
    packed.color = glm::vec4(isDark(light, reach) ? glm::vec3(0.0f) : glm::vec3(lightColor(light)), float(kind));
    return result;
}

void addFeatures(FeatureSet& features, const scenes::Light& light) {
    features.add(featureOf(light.type));
    features.add(Feature::AttenuationLights,
                 scenes::infoOf(light.type).hasPosition() && light.falloff == scenes::Falloff::Attenuation);
}

void addShadow(const scenes::Light& light, const FrameSettings& settings, PackedLight& packed, FeatureSet& features) {
    packed.texels.color.w += float(LIGHT_SHADOWED);
    features.add(Feature::Shadows);
    features.add(Feature::ShadowMaps, infoOf(settings.shadowFilter).usesMaps);
    features.add(Feature::SoftShadows, scenes::hasSize(light) && infoOf(settings.shadowFilter).usesSizes);
}

} // namespace

float surfaceReachMetres(scenes::LightType type, const shared::LightShapeTexels& shape) {
    const scenes::LightTypeInfo& info = scenes::infoOf(type);
    if (!info.isArea) return 0.0f;
    const float along = glm::length(glm::vec3(shape.axis));
    if (info.hasCorners()) return along;
    if (info.hasSides()) return std::hypot(along, glm::length(glm::vec3(shape.attenuation)));
    return AREA_OUTLINE_REACH * (info.isFlat ? along : std::hypot(along, shape.axis.w));
}

void packCorner(std::span<glm::vec4> pairs, std::size_t number, const glm::vec2& corner) {
    glm::vec4& two = pairs[number / 2];
    (number % 2 == 0 ? two.x : two.z) = corner.x;
    (number % 2 == 0 ? two.y : two.w) = corner.y;
}

static_assert(scenes::kLightTypeCount <= LIGHT_TYPE_MASK + 1);

scenes::LightType typeOf(const shared::LightTexels& light) {
    return scenes::LightType(int(light.color.w) & LIGHT_TYPE_MASK);
}

PackedLights packLights(const scenes::Scene& scene, const CameraView& view, const FrameSettings& settings) {
    PackedLights lights;
    LightPictures pictures = lightPictures(scene);
    std::vector<PackedLight> all;
    std::optional<bool> hasCasters; // computed once a light casts shadows
    int firstOn = -1, firstShadowed = -1;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const bool solo = settings.soloLight == int(i);
        const scenes::Light light = lightAtTime(scene.lights[i], settings.timeSeconds);
        if (!light.enabled || (settings.soloLight && !solo)) {
            ++lights.off;
            continue;
        }
        if (firstOn < 0) firstOn = int(i);
        lights.truncated.add(light, settings.rangeTolerance);
        const double reach = reachMetres(light, settings.rangeTolerance);
        const bool casts = scenes::castsShadow(scene, i, settings.shadows);
        const bool dark = isDark(light, reach), unseen = isUnseen(light, reach, view);
        if (firstShadowed < 0 && casts && !dark && !unseen) firstShadowed = int(i);
        if (settings.prune && dark) {
            ++lights.dark;
        } else if (settings.prune && unseen) {
            ++lights.unseen;
        } else {
            const int picture = pictures.numberOf(i);
            PackedLight packed = packLight(light, picture, reach, view);
            packed.sceneIndex = int(i);
            packed.shadow.shadow.y = float(i);
            if (casts) {
                if (!hasCasters) hasCasters = scenes::hasCasters(scene);
                if (*hasCasters) addShadow(light, settings, packed, lights.features);
            }
            all.push_back(packed);
            addFeatures(lights.features, light);
            lights.features.add(Feature::LightPictures, picture >= 0);
        }
    }
    lights.pictures = std::move(pictures.shown);
    // Lighting runs shadow code only for the first lights.
    const auto isShadowed = [](const PackedLight& packed) {
        return (int(packed.texels.color.w) & LIGHT_SHADOWED) != 0;
    };
    lights.shadowed = std::size_t(std::stable_partition(all.begin(), all.end(), isShadowed) - all.begin());
    for (const PackedLight& packed : all) {
        lights.texels.push_back(packed.texels);
        lights.shapes.push_back(packed.shape);
        if (lights.features[scenes::LightType::Polygon])
            lights.corners.push_back(packCorners(scene.lights[std::size_t(packed.sceneIndex)]));
        lights.shadows.push_back(packed.shadow);
        lights.sceneIndex.push_back(packed.sceneIndex);
        // Directional lights and infinite ranges.
        if (packed.texels.position.w == 0.0f) ++lights.everywhere;
    }
    const int wanted = showsShadowsOfOne(settings.view) && firstShadowed >= 0 ? firstShadowed : firstOn;
    const auto shown = std::find(lights.sceneIndex.begin(), lights.sceneIndex.end(), wanted);
    lights.shown = int(shown - lights.sceneIndex.begin());
    return lights;
}

} // namespace tessera::frame
