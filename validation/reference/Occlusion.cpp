#include "validation/reference/Occlusion.h"

#include <cmath>
#include <numbers>

#include "validation/reference/MaterialAt.h"
#include "validation/reference/Slots.h"
#include "validation/reference/Trees.h"

namespace tessera::reference {

namespace {

/// Of a light with a size: where rounding moves less, it decides nothing.
constexpr double kDecisiveShare = 0.01;

/// From a point to where the light is, or past all casters. Relative to the casters' centre.
struct Segment {
    glm::dvec3 from{0.0}, along{0.0};
};

/// The conditions for a candidate to count.
struct ShadowQuery : RTCIntersectContext {
    Segment segment;
    glm::dvec3 centreRWS{0.0};
    const Object* ownObject = nullptr; ///< of the surface that is lit, with its triangle
    std::uint32_t ownTriangle = 0;
    const Textures* textures = nullptr;
    bool isHidden = false;
    bool isUndecided = false; ///< a mask may have another texel there
};

/// The triangle that a point of a surface lies on. It hides what lies on the other side of it than the viewer.
struct OwnTriangle {
    glm::dvec3 normal{0.0}; ///< unit, towards the viewer; 0 of a triangle without area
    /// A program stores the normal in 24 bits, and finds it from rounded corners or from rounded points of pixels.
    double leewayRadians = 0.0;

    OwnTriangle(const Hit& surface, const glm::dvec3& toViewer) {
        // Twice what two octahedral coordinates of 12 bits move a direction by.
        constexpr double kStored = 2.2e-3;
        glm::dvec3 corners[3];
        for (int i = 0; i < 3; ++i) corners[i] = surface.object->cornerRWS(surface.triangle, i);
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double area = glm::length(across);
        if (area == 0.0) return;
        normal = across / (glm::dot(across, toViewer) < 0.0 ? -area : area);
        double longest = 0.0;
        for (int i = 0; i < 3; ++i) longest = std::max(longest, glm::length(corners[(i + 1) % 3] - corners[i]));
        leewayRadians = kStored + 4.0 * surface.roundingMetres * longest / area + surface.roundingPixels;
    }
    bool hides(const glm::dvec3& toPlace) const { return glm::dot(normal, toPlace) < 0.0; }
    /// Whether a program may say otherwise of a place, if it also moves the way there by so many metres.
    bool isUndecided(const glm::dvec3& toPlace, double metres) const {
        return std::abs(glm::dot(normal, toPlace)) <= leewayRadians * glm::length(toPlace) + metres;
    }
};

/// Where the segment crosses a triangle, between its ends; by the signed volumes of the tetrahedra over the triangle's
/// edges.
std::optional<Hit> crossingOf(const Object& object, std::uint32_t triangle, const ShadowQuery& query) {
    const auto& [from, along] = query.segment;
    glm::dvec3 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = object.cornerRWS(triangle, i) - query.centreRWS - from;
    const double volumes[3] = {glm::dot(along, glm::cross(corners[2], corners[1])),
                               glm::dot(along, glm::cross(corners[0], corners[2])),
                               glm::dot(along, glm::cross(corners[1], corners[0]))};
    const bool isInside = (volumes[0] >= 0.0 && volumes[1] >= 0.0 && volumes[2] >= 0.0) ||
                          (volumes[0] <= 0.0 && volumes[1] <= 0.0 && volumes[2] <= 0.0);
    const double sum = volumes[0] + volumes[1] + volumes[2];
    if (!isInside || sum == 0.0) return {};
    Hit hit;
    hit.object = &object;
    hit.triangle = triangle;
    for (int i = 0; i < 3; ++i) hit.weights[i] = volumes[i] / sum;
    const glm::dvec3 place = hit.weights.x * corners[0] + hit.weights.y * corners[1] + hit.weights.z * corners[2];
    const double share = glm::dot(place, along) / glm::dot(along, along);
    if (!(share > 0.0 && share < 1.0)) return {};
    return hit;
}

void judgeCrossing(const RTCFilterFunctionNArguments* arguments) {
    auto& query = *static_cast<ShadowQuery*>(arguments->context);
    const auto& object = *static_cast<const Object*>(arguments->geometryUserPtr);
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    arguments->valid[0] = 0; // it goes on until the answer is known
    if (query.isHidden || (&object == query.ownObject && triangle == query.ownTriangle)) return;
    const std::optional<Hit> hit = crossingOf(object, triangle, query);
    if (!hit) return;
    if (object.material->alphaMode == scenes::AlphaMode::Mask) {
        if (reference::isUndecided(*hit, *query.textures)) query.isUndecided = true;
        const double cutoff = double(object.material->alphaCutoff);
        const double opacity = opacityAt(*hit, *query.textures);
        // Three weights, two blends and a product, each rounded to 2^-24 of at most 1.
        if (std::abs(opacity - cutoff) < 16.0 * 0x1p-24 * std::max(1.0, cutoff)) query.isUndecided = true;
        if (opacity < cutoff) return;
    }
    query.isHidden = true;
    arguments->valid[0] = -1;
}

} // namespace

struct Occlusion::Casters {
    Textures textures;           ///< a shadow has no size in pixels, so level 0 counts
    Anchor anchor;               ///< Embree's origin: the digits are where the pixels look
    double radiusMetres = 0.0;   ///< around it, all casters
    double originMetres = 0.0;   ///< from it to the product's origin of casters, their corners' median on each axis
    double roundingMetres = 0.0; ///< by how much rounding may move what is drawn, beyond that of its distance from both
    Device device;
    Tree tree; ///< null without casters

    ShadowQuery ask(const Segment& segment, const Hit& surface) const {
        ShadowQuery query{};
        rtcInitIntersectContext(&query);
        query.segment = segment;
        query.centreRWS = anchor.centreRWS;
        query.ownObject = surface.object;
        query.ownTriangle = surface.triangle;
        query.textures = &textures;
        RTCRay ray{};
        ray.org_x = float(segment.from.x);
        ray.org_y = float(segment.from.y);
        ray.org_z = float(segment.from.z);
        ray.dir_x = float(segment.along.x);
        ray.dir_y = float(segment.along.y);
        ray.dir_z = float(segment.along.z);
        ray.tnear = 0.0f;
        ray.tfar = 1.00001f; // the judge knows the end in double
        ray.mask = ~0u;
        rtcOccluded1(tree.get(), &query, &ray);
        return query;
    }

    /// A program holds the point and the light to single precision relative to an origin of its own, and the casters to
    /// another: twice eight roundings of both. It may call a triangle's plane the point's own within as much again.
    double leewayMetres(const glm::dvec3& placeRWS) const {
        const double common = kPositionRounding * (originMetres + anchor.otherOriginMetres) + roundingMetres;
        const double reach = glm::length(placeRWS - anchor.centreRWS) + anchor.otherOriginMetres;
        return 4.0 * (common + 2.0 * kPositionRounding * reach);
    }

    /// The same of the other end of a way to a light: its place, or (not placed) what the way there is turned by. A
    /// direction is rounded as a position is.
    double leewayMetres(bool isPlaced, const ShiningLight& light, const glm::dvec3& pointRWS, double wayMetres) const {
        return isPlaced ? leewayMetres(light.positionRWS) : leewayMetres(pointRWS) + kPositionRounding * wayMetres;
    }

    static Answer decided(double share) { return {share, share, share}; }
    /// All or nothing of the light at one end of a segment. `own` is null where the point's own triangle does not
    /// count.
    Answer decide(const Segment& segment, bool isPlaced, const ShiningLight& light, const Hit& surface,
                  const OwnTriangle* own, const glm::dvec3& pointRWS, bool leeway) const {
        const bool isBehind = own && own->hides(segment.along);
        if (isBehind && !leeway) return decided(0.0);
        const ShadowQuery exact = ask(segment, surface);
        const double share = exact.isHidden || isBehind ? 0.0 : 1.0;
        if (!leeway) return decided(share);
        const Answer undecided{share, 0.0, 1.0, true};
        if (exact.isUndecided) return undecided;
        // The ends move across the way, which decides edges, and along it, which decides contacts.
        const auto& [from, along] = segment;
        const double pointMetres = leewayMetres(pointRWS);
        const double lightMetres = leewayMetres(isPlaced, light, pointRWS, glm::length(along));
        // Where casters hide the light, the own triangle does not matter.
        const bool isOwnUndecided = own && own->isUndecided(along, pointMetres + lightMetres);
        if (isBehind && !isOwnUndecided) return decided(0.0);
        if (isOwnUndecided && !exact.isHidden) return undecided;
        const glm::dvec3 ahead = glm::normalize(along);
        const glm::dvec3 aside = glm::normalize(
            glm::cross(ahead, std::abs(ahead.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
        const glm::dvec3 up = glm::cross(aside, ahead);
        const auto differs = [&](const glm::dvec3& pointStep, const glm::dvec3& lightStep) {
            const ShadowQuery other = ask({from + pointStep, along + lightStep - pointStep}, surface);
            return other.isHidden != exact.isHidden || other.isUndecided;
        };
        for (const glm::dvec3& way : {aside, -aside, up, -up})
            if (differs(pointMetres * way, lightMetres * way)) return undecided;
        if (differs(-pointMetres * ahead, lightMetres * ahead) || differs(pointMetres * ahead, -lightMetres * ahead))
            return undecided;
        return decided(share);
    }
};

Occlusion::Occlusion(const scenes::Scene& scene, const Objects& objects)
    : casters_(new Casters{Textures(scene, Filtering::Exact), objects.anchor(), 0.0, 0.0, 0.0, makeDevice(), {}}) {
    std::vector<const Object*> casting;
    std::vector<double> places[3]; // of casters' corners from the anchor
    for (const Object& object : objects.opaque()) {
        if (!object.castsShadow) continue;
        casting.push_back(&object);
        for (std::uint32_t triangle = 0; triangle < object.mesh->indices.size() / 3; ++triangle)
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 place = object.cornerRWS(triangle, corner) - casters_->anchor.centreRWS;
                casters_->radiusMetres = std::max(casters_->radiusMetres, glm::length(place));
                for (int axis = 0; axis < 3; ++axis) places[axis].push_back(place[axis]);
            }
    }
    if (casting.empty()) return;
    glm::dvec3 origin;
    for (int axis = 0; axis < 3; ++axis) {
        const auto middle = places[axis].begin() + std::ptrdiff_t(places[axis].size() / 2);
        std::nth_element(places[axis].begin(), middle, places[axis].end());
        origin[axis] = *middle;
    }
    casters_->originMetres = glm::length(origin);
    casters_->roundingMetres = objects.roundingBeyondMetres(casters_->anchor.centreRWS + origin);
    casters_->tree = makeTree(casters_->device.get(), casting, casters_->anchor.centreRWS, judgeCrossing);
}

Occlusion::~Occlusion() = default;

Occlusion::Answer Occlusion::of(const ShiningLight& light, const Hit& surface, const glm::dvec3& pointRWS,
                                const glm::dvec3& toViewer, const Settings& settings) const {
    const Casters& casters = *casters_;
    if (!light.castsShadow || !casters.tree) return {};
    const bool isPlaced = scenes::infoOf(light.light.type).hasPosition();
    const glm::dvec3 from = pointRWS - casters.anchor.centreRWS;
    const glm::dvec3 toLight = isPlaced ? light.positionRWS - pointRWS : -light.light.directionWS;
    const double distance = glm::length(toLight);
    if (distance == 0.0) return {};
    const double radius =
        isPlaced ? double(light.light.radiusMetres) : std::tan(double(light.light.angularRadiusRadians));
    // Past all casters, where the light has no place.
    const double reach = isPlaced ? 1.0 : 2.0 * (casters.radiusMetres + glm::length(from)) + 1.0;
    const glm::dvec3 ahead = toLight / distance;
    const glm::dvec3 aside = glm::normalize(
        glm::cross(ahead, std::abs(ahead.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(aside, ahead);
    const OwnTriangle own(surface, toViewer);
    const Segment toCentre{from, toLight * reach};
    if (radius == 0.0) return casters.decide(toCentre, isPlaced, light, surface, &own, pointRWS, settings.leeway);
    Answer sum{0.0, 0.0, 0.0};
    double halves[2] = {0.0, 0.0}; // of every other ray
    const auto trace = [&](int rings) {
        halves[0] = halves[1] = 0.0;
        const int sectors = 4 * rings;
        for (int ring = 0; ring < rings; ++ring) {
            const double share = std::sqrt((ring + 0.5) / rings);
            for (int sector = 0; sector < sectors; ++sector) {
                // Rings are turned against each other, so that no straight edge meets many samples at once.
                const double angle = 2.0 * std::numbers::pi * (sector + 0.6180339887498949 * ring) / sectors;
                const glm::dvec3 place = toLight + radius * share * (std::cos(angle) * aside + std::sin(angle) * up);
                halves[(ring + sector) % 2] +=
                    casters.decide({from, place * reach}, isPlaced, light, surface, &own, pointRWS, false).share;
            }
        }
        sum.share = (halves[0] + halves[1]) / double(rings * sectors);
    };
    trace(settings.shadowRings);
    if (sum.share > 0.0 && sum.share < 1.0 && settings.penumbraRings > settings.shadowRings) {
        trace(settings.penumbraRings);
        const double error = (halves[0] - halves[1]) / double(4 * settings.penumbraRings * settings.penumbraRings);
        sum.noise.ofReference = error * error;
    }
    // Independent rays would stray by five of these in one case of 10^6; two rays are for distributions far from normal
    // ones. Where all agree, a program's must too.
    const double rays = double(settings.shadowSamples);
    const bool isNoisy = settings.leeway && settings.shadowSamples > 0 && sum.share > 0.0 && sum.share < 1.0;
    const double spread = sum.share * (1.0 - sum.share);
    if (isNoisy) {
        sum.noise.variance = spread / rays;
        sum.noise.fourth = spread * (1.0 - 6.0 * spread) / (rays * rays * rays);
    }
    double stray = isNoisy ? 5.0 * std::sqrt(sum.noise.variance) + 2.0 / rays : 0.0;
    // Where rounding decides whether casters hide the middle of a light, it may decide the rest.
    if (settings.leeway && casters.decide(toCentre, isPlaced, light, surface, nullptr, pointRWS, true).isUndecided) {
        stray = 1.0;
        sum.isUndecided = true;
    }
    // The own triangle's plane may cut the disk elsewhere: by the length of the chord there, at most its diameter.
    const double metres =
        casters.leewayMetres(pointRWS) + casters.leewayMetres(isPlaced, light, pointRWS, distance * reach);
    const double cut = own.leewayRadians * distance + metres / reach;
    if (settings.leeway && std::abs(glm::dot(own.normal, toLight)) <= radius + cut) {
        const double share = 2.0 * cut / (std::numbers::pi * radius);
        stray += share;
        sum.isUndecided = sum.isUndecided || share > kDecisiveShare;
    }
    sum.least = std::max(0.0, sum.share - stray);
    sum.most = std::min(1.0, sum.share + stray);
    return sum;
}

} // namespace tessera::reference
