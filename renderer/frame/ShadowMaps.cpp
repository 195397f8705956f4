#include "renderer/frame/ShadowMaps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>

#include "renderer/frame/CasterTree.h"
#include "renderer/frame/LightRange.h"

namespace tessera::frame {

namespace {

/// The largest side of a face that follows from a picture. A larger one can be asked for.
constexpr int kMostFaceTexels = 2048;
/// Widest half angle of a spot light that one face holds: its tangent is 2.7, so texels at the rim are 8 times as large
/// as in the middle. Wider cones have six faces, as point lights.
constexpr double kMostSpotRadians = 1.22;
/// By how much the ball around all that is drawn is enlarged for rounding.
constexpr double kSceneRoom = 1.001;
/// Between even cascades (0) and ones that grow by equal ratios (1): Zhang et al. 2006, "Parallel-split shadow maps".
constexpr double kSplitByRatio = 0.8;
/// The first cascade begins no nearer than this share of the farthest depth: it would be of millimetres.
constexpr double kNearestSplit = 0.01;
/// Lengths that cascades follow from are steps of this ratio, so that a moving camera does not change their texels.
constexpr double kStep = 1.189207115002721; // 2^(1/4)

double steppedUp(double metres) {
    return metres > 0.0 ? std::pow(kStep, std::ceil(std::log(metres) / std::log(kStep) - 1e-9)) : 0.0;
}

double steppedDown(double metres) {
    return metres > 0.0 ? std::pow(kStep, std::floor(std::log(metres) / std::log(kStep) + 1e-9)) : 0.0;
}

struct Ball {
    glm::dvec3 centreWS{0.0};
    double radiusMetres = 0.0;
};

Ball ballAround(std::span<const SurfaceBounds> bounds) {
    scenes::Box3 box;
    for (const SurfaceBounds& one : bounds) {
        box.extend(one.boxWS.min);
        box.extend(one.boxWS.max);
    }
    if (box.empty()) return {};
    return {0.5 * (box.min + box.max), 0.5 * glm::length(box.max - box.min)};
}

/// A camera that looks along `forwardWS`, with `upWS` up as far as that is possible.
scenes::Camera lookingAlong(const glm::dvec3& fromWS, const glm::dvec3& forwardWS, const glm::dvec3& upWS) {
    const glm::dvec3 right = glm::normalize(glm::cross(forwardWS, upWS));
    scenes::Camera camera;
    camera.worldFromCamera = {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(right, forwardWS), 0.0),
                              glm::dvec4(-forwardWS, 0.0), glm::dvec4(fromWS, 1.0)};
    return camera;
}

/// The coordinate axis farthest from a direction.
glm::dvec3 axisAcross(const glm::dvec3& directionWS) {
    const glm::dvec3 size = glm::abs(directionWS);
    return size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
           : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                : glm::dvec3(0.0, 0.0, 1.0);
}

int automaticSideTexels(double texels) {
    const double held = std::clamp(texels, double(kLeastFaceTexels), double(kMostFaceTexels));
    return int(std::bit_ceil(unsigned(std::ceil(held))));
}

/// A face that holds all that a light with a place reaches.
struct Cone {
    glm::dvec3 forwardWS{0.0};
    double tangent = 1.0; ///< of its half angle
};

/// What lights are planned from.
struct Wanted {
    scenes::Light light; ///< at the frame's time
    double reachMetres = 0.0;
    std::optional<Cone> cone; ///< without one it takes a face for each direction of the axes
    double texels = 0.0;      ///< side of a face that its pixels in the picture want
    double pixels = 0.0;      ///< of the picture that it may reach
};

/// The cone of a spot light, or the narrower one around all that is drawn, seen from beside it.
std::optional<Cone> coneOf(const scenes::Light& light, const Ball& scene) {
    std::optional<Cone> cone;
    const double widest = std::tan(kMostSpotRadians);
    if (scenes::infoOf(light.type).reach == scenes::LightReach::Cone &&
        double(light.outerConeRadians) < kMostSpotRadians)
        cone = {glm::normalize(light.directionWS), std::tan(std::max(double(light.outerConeRadians), 1e-3))};
    const glm::dvec3 toScene = scene.centreWS - light.positionWS;
    const double metres = glm::length(toScene), radius = kSceneRoom * scene.radiusMetres;
    if (!(metres > radius)) return cone;
    const double tangent = radius / std::sqrt((metres - radius) * (metres + radius));
    if (tangent < (cone ? cone->tangent : widest)) cone = {toScene / metres, tangent};
    return cone;
}

int faceCount(const Wanted& wanted, const FrameSettings& settings) {
    if (!scenes::infoOf(wanted.light.type).hasPosition()) return settings.shadowMaps.cascades;
    return wanted.cone ? 1 : 6;
}

/// How much of the picture a light may reach, and how wide a face's end is there at most: as seen from the nearest
/// place that the light reaches, but from no nearer than a quarter of its reach.
void setInfluence(Wanted& wanted, const CameraView& view, const glm::ivec2& sizePixels, const Ball& scene) {
    const double side = double(std::max(sizePixels.x, sizePixels.y));
    const double all = double(sizePixels.x) * double(sizePixels.y);
    wanted.texels = side;
    wanted.pixels = all;
    if (!scenes::infoOf(wanted.light.type).hasPosition()) return;
    const double reach = std::min(wanted.reachMetres, 2.0 * scene.radiusMetres);
    const double distance = glm::distance(wanted.light.positionWS, view.eyeWS);
    const double fromEye =
        std::max(distance - wanted.reachMetres, glm::distance(scene.centreWS, view.eyeWS) - scene.radiusMetres);
    const double metresPerPixel = double(view.constants.rayFromPixel.x); // a metre ahead, or anywhere
    const bool isParallel = view.constants.forwardLS.w != 0.0f;
    const double pixelMetres = isParallel ? metresPerPixel : std::max(fromEye, 0.25 * reach) * metresPerPixel;
    const double widthMetres =
        std::min(2.0 * wanted.reachMetres * (wanted.cone ? wanted.cone->tangent : 1.0), 2.0 * scene.radiusMetres);
    if (pixelMetres > 0.0) wanted.texels = std::min(widthMetres / pixelMetres, side);
    // What lies both within its reach and in the scene is seen within the smaller disk of the two balls.
    const auto diskPixels = [&](double metres, double radius) {
        const double ahead = isParallel ? 1.0 : std::sqrt(std::max((metres - radius) * (metres + radius), 0.0));
        const double radiusPixels = radius / std::max(ahead * metresPerPixel, 1e-30);
        return std::numbers::pi * radiusPixels * radiusPixels;
    };
    wanted.pixels = std::min({diskPixels(distance, wanted.reachMetres),
                              diskPixels(glm::distance(scene.centreWS, view.eyeWS), scene.radiusMetres), all});
}

// ---- Cameras of faces ----

/// A perspective camera whose picture ends `borderTexels` behind what it is looked up for, which is as wide as twice
/// the tangent.
void setLens(scenes::Camera& camera, double tangent, int sideTexels, int borderTexels) {
    const double within = std::max(1.0 - 2.0 * borderTexels / double(sideTexels), 0.25);
    camera.fovYRadians = 2.0 * std::atan(tangent / within);
}

void addCameras(const Wanted& wanted, int sideTexels, int borderTexels, std::vector<scenes::Camera>& cameras) {
    const scenes::Light& light = wanted.light;
    const auto add = [&](const glm::dvec3& forwardWS, const glm::dvec3& upWS, double tangent) {
        scenes::Camera camera = lookingAlong(light.positionWS, forwardWS, upWS);
        camera.nearMetres = kFaceNearShare * wanted.reachMetres;
        setLens(camera, tangent, sideTexels, borderTexels);
        cameras.push_back(camera);
    };
    if (wanted.cone) {
        add(wanted.cone->forwardWS, axisAcross(wanted.cone->forwardWS), wanted.cone->tangent);
        return;
    }
    // +x, -x, +y, -y, +z, -z, as lib/shadow/shadow_map.glsl numbers them.
    for (int face = 0; face < 6; ++face) {
        glm::dvec3 forwardWS(0.0);
        forwardWS[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
        glm::dvec3 upWS(0.0);
        upWS[(face / 2 + 1) % 3] = 1.0;
        add(forwardWS, upWS, 1.0);
    }
}

/// Depths [near, far] of a view from which the cascades are made, and spheres around what it sees between them.
struct Slices {
    double nearMetres = 0.0, farMetres = 0.0;

    double split(int i, int count) const {
        const double first = std::max(nearMetres, kNearestSplit * farMetres), share = double(i) / double(count);
        if (i == 0) return nearMetres;
        return kSplitByRatio * first * std::pow(farMetres / first, share) +
               (1.0 - kSplitByRatio) * (first + (farMetres - first) * share);
    }
};

Slices slicesOf(const CameraView& view, const Ball& scene, double cameraNearMetres) {
    const glm::dvec3 forwardWS = glm::transpose(view.lsFromWorld) * view.forwardLS;
    const double middle = glm::dot(forwardWS, scene.centreWS - view.eyeWS);
    Slices slices;
    slices.nearMetres = std::max(steppedDown(middle - scene.radiusMetres), cameraNearMetres);
    slices.farMetres = std::max(steppedUp(middle + scene.radiusMetres), slices.nearMetres * kStep);
    if (!(slices.farMetres > 0.0)) slices.farMetres = 1.0;
    return slices;
}

/// Around what the view sees between two depths.
Ball ballAround(const CameraView& view, const glm::ivec2& sizePixels, double nearMetres, double farMetres) {
    const glm::dvec3 forwardWS = glm::transpose(view.lsFromWorld) * view.forwardLS;
    const double halfDiagonal = 0.5 * glm::length(glm::dvec2(sizePixels) * glm::dvec2(view.constants.rayFromPixel));
    const bool isParallel = view.constants.forwardLS.w != 0.0f;
    if (isParallel)
        return {view.eyeWS + 0.5 * (nearMetres + farMetres) * forwardWS,
                glm::length(glm::dvec2(halfDiagonal, 0.5 * (farMetres - nearMetres)))};
    // As far from the corners of the near end as from those of the far one, or in the middle of the far one.
    const double middle = std::min(0.5 * (nearMetres + farMetres) * (1.0 + halfDiagonal * halfDiagonal), farMetres);
    return {view.eyeWS + middle * forwardWS, glm::length(glm::dvec2(farMetres - middle, halfDiagonal * farMetres))};
}

/// Faces of a directional light. Each is a square around a sphere, so that it does not change as the camera turns, and
/// its middle lies on whole texels of a grid that is fixed in the world, so that it does not as the camera moves.
void addCascades(const Wanted& wanted, int sideTexels, int borderTexels, const CameraView& view,
                 const FrameSettings& settings, const Ball& scene, double cameraNearMetres,
                 std::vector<scenes::Camera>& cameras) {
    const glm::dvec3 travelWS = glm::normalize(wanted.light.directionWS);
    const Slices slices = slicesOf(view, scene, cameraNearMetres);
    const int count = settings.shadowMaps.cascades;
    for (int i = 0; i < count; ++i) {
        Ball seen = ballAround(view, settings.sizePixels, slices.split(i, count), slices.split(i + 1, count));
        if (!(seen.radiusMetres < scene.radiusMetres)) seen = scene;
        seen.radiusMetres = std::max(steppedUp(seen.radiusMetres), 1e-9);
        // A texel more, since the middle is moved by up to one.
        const double within = std::max(1.0 - 2.0 * (borderTexels + 1) / double(sideTexels), 0.25);
        const double halfMetres = seen.radiusMetres / within;
        const double texelMetres = 2.0 * halfMetres / double(sideTexels);
        scenes::Camera camera = lookingAlong(glm::dvec3(0.0), travelWS, axisAcross(travelWS));
        const glm::dvec3 right(camera.worldFromCamera[0]), up(camera.worldFromCamera[1]);
        const auto onGrid = [&](const glm::dvec3& axis) {
            return std::floor(glm::dot(axis, seen.centreWS) / texelMetres) * texelMetres;
        };
        // All casters lie ahead.
        const double halfDepthMetres = std::max(kSceneRoom * scene.radiusMetres, 1e-9);
        const double nearAlong = glm::dot(travelWS, scene.centreWS) - halfDepthMetres;
        camera.worldFromCamera[3] = glm::dvec4(onGrid(right) * right + onGrid(up) * up + nearAlong * travelWS, 1.0);
        camera.projection = scenes::Projection::Orthographic;
        camera.halfHeightMetres = halfMetres;
        camera.nearMetres = 0.0;
        camera.farMetres = 2.0 * halfDepthMetres;
        cameras.push_back(camera);
    }
}

// ---- The atlas ----

/// Every other bit of a Morton number.
int everyOtherBit(std::uint64_t bits) {
    int result = 0;
    for (int i = 0; i < 31; ++i) result |= int((bits >> (2 * i)) & 1u) << i;
    return result;
}

std::size_t bytesOf(const glm::ivec2& atlasTexels) {
    return std::size_t(atlasTexels.x) * std::size_t(atlasTexels.y) * kShadowTexelBytes;
}

glm::ivec2 atlasOf(std::uint64_t texels, int largestSide) {
    if (texels == 0) return {0, 0};
    const std::uint64_t block = std::uint64_t(largestSide) * std::uint64_t(largestSide);
    const std::uint64_t blocks = (texels + block - 1) / block;
    const auto mostInRow = std::uint64_t(kLargestSidePixels / largestSide);
    const std::uint64_t rows = (blocks + mostInRow - 1) / mostInRow;
    const std::uint64_t inRow = (blocks + rows - 1) / rows;
    // Beyond what an int holds it fits no budget either way.
    const auto side = [&](std::uint64_t count) {
        return int(std::min(count * std::uint64_t(largestSide), std::uint64_t(1) << 30));
    };
    return {side(inRow), side(rows)};
}

/// Reduces what lights got until the atlas is within the budget. An outline is off by part of a texel, which is as many
/// pixels as a face wants texels for each that it has. The cost of halving a light's faces is that error, times the
/// pixels that the light may reach, for each texel saved; the cheapest halving comes first. Pixels and texels are
/// rounded to powers of two, so that the order seldom changes as the camera moves.
void fitBudget(std::vector<ShadowedLight>& lights, std::span<const Wanted> wanted, double budgetBytes) {
    struct Halving {
        double cost;
        std::size_t light;
        bool operator<(const Halving& other) const { // the one with the least cost is on top; of equal ones the last
            return cost != other.cost ? cost > other.cost : light < other.light;
        }
    };
    std::uint64_t texels = 0;
    std::map<int, int> sides; // how many lights have it
    const auto count = [&](const ShadowedLight& light, int sign) {
        const auto side = std::uint64_t(light.sideTexels);
        texels += std::uint64_t(sign) * std::uint64_t(light.faces) * side * side;
        if ((sides[light.sideTexels] += sign) == 0) sides.erase(light.sideTexels);
    };
    const auto fits = [&] {
        const glm::ivec2 atlas = atlasOf(texels, sides.empty() ? 1 : std::max(sides.rbegin()->first, 1));
        return double(bytesOf(atlas)) <= budgetBytes && atlas.y <= kLargestSidePixels;
    };
    std::priority_queue<Halving> halvings;
    const auto offer = [&](std::size_t i) {
        const double side = double(lights[i].sideTexels);
        if (lights[i].sideTexels <= kLeastFaceTexels) return;
        const double pixels = std::exp2(std::ceil(std::log2(std::max(wanted[i].pixels, 1.0))));
        const double pixelsPerTexel = double(automaticSideTexels(wanted[i].texels)) / side;
        halvings.push({pixels * pixelsPerTexel / (side * side * double(lights[i].faces)), i});
    };
    for (std::size_t i = 0; i < lights.size(); ++i) {
        count(lights[i], 1);
        offer(i);
    }
    while (!halvings.empty() && !fits()) {
        const std::size_t i = halvings.top().light;
        halvings.pop();
        count(lights[i], -1);
        lights[i].sideTexels /= 2;
        count(lights[i], 1);
        offer(i);
    }
    for (std::size_t i = lights.size(); i-- > 0 && !fits();) {
        count(lights[i], -1);
        lights[i].sideTexels = 0;
        count(lights[i], 1);
    }
}

} // namespace

std::size_t ShadowMaps::reduced() const {
    return std::size_t(std::ranges::count_if(
        lights, [](const ShadowedLight& l) { return l.sideTexels > 0 && l.sideTexels < l.wantedTexels; }));
}

std::size_t ShadowMaps::unmapped() const {
    return std::size_t(std::ranges::count(lights, 0, &ShadowedLight::sideTexels));
}

std::string shadowFaceName(int i, int faces) {
    constexpr const char* kAxes[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    if (faces == 1) return "only map";
    return faces == 6 ? kAxes[i] : "cascade " + std::to_string(i + 1) + (i == 0 ? " (nearest)" : "");
}

int shadowBorderTexels(const FrameSettings& settings, int sideTexels) {
    if (settings.shadowFilter == ShadowFilter::Pcss) return sideTexels / SHADOW_PENUMBRA_PARTS;
    // Half of the square, and a texel into which a tap between texels reaches.
    const int texels = settings.shadowFilter == ShadowFilter::Hard ? 1 : settings.shadowMaps.widthTexels / 2 + 2;
    return std::min(texels, sideTexels / 4);
}

glm::ivec2 placeFaces(std::span<const int> sidesTexels, std::vector<glm::ivec2>& cornersTexels) {
    cornersTexels.assign(sidesTexels.size(), glm::ivec2(0));
    // Squares of powers of two, the larger ones first, leave no gap along a Morton curve.
    std::vector<std::size_t> order(sidesTexels.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sidesTexels[a] > sidesTexels[b]; });
    if (order.empty() || sidesTexels[order.front()] == 0) return {0, 0};
    const int largest = sidesTexels[order.front()];
    const std::uint64_t block = std::uint64_t(largest) * std::uint64_t(largest);
    std::uint64_t used = 0;
    for (const int side : sidesTexels) used += std::uint64_t(side) * std::uint64_t(side);
    const glm::ivec2 atlas = atlasOf(used, largest);
    const int inRow = atlas.x / largest;
    used = 0;
    for (const std::size_t i : order) {
        const auto side = std::uint64_t(sidesTexels[i]);
        const int number = int(used / block);
        const std::uint64_t within = used % block;
        cornersTexels[i] = glm::ivec2(number % inRow, number / inRow) * largest +
                           glm::ivec2(everyOtherBit(within), everyOtherBit(within >> 1));
        used += side * side;
    }
    return atlas;
}

ShadowMaps makeShadowMaps(const scenes::Scene& scene, const PackedLights& lights, const CameraView& view,
                          const FrameSettings& settings, std::span<const SurfaceBounds> bounds) {
    const Ball all = ballAround(bounds);
    ShadowMaps maps;
    std::vector<Wanted> wanted; // parallel to maps.lights
    for (std::size_t i = 0; i < lights.texels.size(); ++i) {
        if ((int(lights.texels[i].color.w) & LIGHT_SHADOWED) == 0) continue;
        Wanted own;
        own.light = lightAtTime(scene.lights[std::size_t(lights.sceneIndex[i])], settings.timeSeconds);
        if (scenes::infoOf(own.light.type).hasPosition()) {
            const double farthestMetres = glm::distance(own.light.positionWS, all.centreWS) + all.radiusMetres;
            own.reachMetres = std::max(std::min(reachMetres(own.light, settings.rangeTolerance), farthestMetres), 1e-9);
            own.cone = coneOf(own.light, all);
        }
        setInfluence(own, view, settings.sizePixels, all);
        const int side = settings.shadowMaps.resolutionTexels.value_or(automaticSideTexels(own.texels));
        maps.lights.push_back({i, 0, faceCount(own, settings), side, side});
        wanted.push_back(own);
    }
    fitBudget(maps.lights, wanted, settings.shadowMaps.budgetMiB * 1024.0 * 1024.0);
    std::vector<int> sides;
    const double cameraNear = scene.cameras[std::size_t(settings.camera)].nearMetres;
    for (std::size_t i = 0; i < maps.lights.size(); ++i) {
        ShadowedLight& light = maps.lights[i];
        light.firstFace = maps.faces.size();
        if (light.sideTexels == 0) continue;
        std::vector<scenes::Camera> cameras;
        const int border = shadowBorderTexels(settings, light.sideTexels);
        if (scenes::infoOf(wanted[i].light.type).hasPosition())
            addCameras(wanted[i], light.sideTexels, border, cameras);
        else
            addCascades(wanted[i], light.sideTexels, border, view, settings, all, cameraNear, cameras);
        for (scenes::Camera& camera : cameras) {
            maps.faces.push_back({std::move(camera), {}, light.sideTexels});
            sides.push_back(light.sideTexels);
        }
    }
    std::vector<glm::ivec2> corners;
    // A texture has a texel, also where no light is left to have a face.
    maps.atlasTexels = glm::max(placeFaces(sides, corners), glm::ivec2(1));
    for (std::size_t i = 0; i < maps.faces.size(); ++i) maps.faces[i].cornerTexels = corners[i];
    return maps;
}

CameraView faceView(const ShadowFace& face) {
    CameraView view = makeCameraView(face.camera, glm::ivec2(face.sideTexels), LightingSpace::World, glm::vec3(0.0f));
    // Pixels are those of the atlas.
    view.constants.rayFromPixel.z += float(face.cornerTexels.x);
    view.constants.rayFromPixel.w += float(face.cornerTexels.y);
    return view;
}

std::vector<shared::ShadowFaceTexels> packFaces(const ShadowMaps& maps, const CameraView& view, std::size_t firstTexel,
                                                std::span<const SurfaceBounds> bounds, PackedLights& lights) {
    double objectMetres = 0.0; // of which vertices are added up
    for (const SurfaceBounds& one : bounds) objectMetres = std::max(objectMetres, one.reachMetres);
    for (const ShadowedLight& light : maps.lights) {
        glm::vec4& texel = lights.shadows[light.light].shadow;
        if (light.sideTexels == 0) {
            lights.texels[light.light].color.w -= float(LIGHT_SHADOWED);
            continue;
        }
        double faceMetres = 0.0; // the faces of a directional light begin at different places
        for (std::size_t i = light.firstFace; i < light.firstFace + std::size_t(light.faces); ++i)
            faceMetres =
                std::max(faceMetres, glm::distance(glm::dvec3(maps.faces[i].camera.worldFromCamera[3]), view.originWS));
        const double metres = objectMetres + faceMetres + double(view.constants.depthKey.y);
        texel.z = float(firstTexel + light.firstFace * SHADOW_FACE_TEXELS);
        texel.w = float(kPositionRounding * metres);
        if (light.faces == 6) lights.texels[light.light].color.w += float(LIGHT_SIX_FACES);
    }
    std::vector<shared::ShadowFaceTexels> packed;
    for (const ShadowFace& face : maps.faces) {
        const scenes::Camera& camera = face.camera;
        const bool isParallel = camera.projection == scenes::Projection::Orthographic;
        const double half = isParallel ? camera.halfHeightMetres : std::tan(0.5 * camera.fovYRadians);
        const glm::dvec3 fromOrigin = view.originWS - glm::dvec3(camera.worldFromCamera[3]);
        const auto row = [&](const glm::dvec3& axis) { return glm::vec4(axis, glm::dot(axis, fromOrigin)); };
        const float halfTexels = 0.5f * float(face.sideTexels);
        packed.push_back({row(glm::dvec3(camera.worldFromCamera[0]) / half),
                          row(glm::dvec3(camera.worldFromCamera[1]) / half),
                          row(-glm::dvec3(camera.worldFromCamera[2])),
                          glm::vec4(glm::vec2(face.cornerTexels) + halfTexels, halfTexels,
                                    isParallel ? float(-1.0 / camera.farMetres) : float(camera.nearMetres))});
    }
    return packed;
}

} // namespace tessera::frame
