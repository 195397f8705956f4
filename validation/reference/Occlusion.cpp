#include "validation/reference/Occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenes/AreaLight.h"
#include "scenes/Shadows.h"
#include "validation/reference/MaterialAt.h"
#include "validation/reference/SeenArea.h"
#include "validation/reference/Slots.h"
#include "validation/reference/Trees.h"

namespace tessera::reference {

namespace {

/// Of a light with a size: where rounding moves less, it decides nothing.
constexpr double kDecisiveShare = 0.01;

/// Wrapped light is asked for from above the surface: (this - n.l) radii of the body, where n.l is less.
constexpr double kLiftCosine = 0.1;
/// How far a program's normals are off, beside their texture.
constexpr double kNormalRounding = 4e-6;

double liftMetres(const SurfacePoint& surface, const glm::dvec3& toLight) {
    if (surface.wrap == glm::dvec3(0.0)) return 0.0;
    const double cosine = glm::dot(surface.normal, toLight) / glm::length(toLight);
    return std::max(kLiftCosine - cosine, 0.0) * surface.bodyRadiusMetres;
}

/// From a point to where the light is, or past all casters. Relative to the casters' centre.
struct Segment {
    glm::dvec3 from{0.0}, along{0.0};
};

/// The conditions for a candidate to count.
struct ShadowQuery : RTCIntersectContext {
    Segment segment;
    glm::dvec3 centreRWS{0.0};
    const Object* ownObject = nullptr; ///< of the surface that the segment begins on, with its triangle
    std::uint32_t ownTriangle = 0;
    const Textures* textures = nullptr;
    const scenes::Material* passed = nullptr; ///< what has it hides nothing, and its crossings are kept
    std::vector<double> crossings;            ///< shares of the segment; minus those where it goes in
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

/// The share of the segment up to a crossing; minus that where it goes in, past the side from which the corners run
/// counter-clockwise.
double signedShare(const Object& object, std::uint32_t triangle, const Hit& hit, const ShadowQuery& query) {
    glm::dvec3 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = object.cornerRWS(triangle, i) - query.centreRWS - query.segment.from;
    const glm::dvec3& along = query.segment.along;
    const glm::dvec3 place = hit.weights.x * corners[0] + hit.weights.y * corners[1] + hit.weights.z * corners[2];
    const double share = glm::dot(place, along) / glm::dot(along, along);
    const glm::dvec3 front = object.handedness * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    return glm::dot(front, along) < 0.0 ? -share : share;
}

/// The share of a segment that lies inside. Triangles that meet in an edge are crossed once.
double shareInside(std::vector<double> crossings) {
    std::ranges::sort(crossings, {}, [](double crossing) { return std::abs(crossing); });
    const auto isSame = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(a); };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), isSame), crossings.end());
    return std::max(std::accumulate(crossings.begin(), crossings.end(), 0.0), 0.0);
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
    if (object.material == query.passed) {
        query.crossings.push_back(signedShare(object, triangle, *hit, query));
        return;
    }
    query.isHidden = true;
    arguments->valid[0] = -1;
}

} // namespace

/// What shadows see of a light with a size (scenes/Shadows.h), from its position.
class ShadowFace {
public:
    /// `ahead` is the unit way to the light, `radius` that of a disk that faces the point.
    ShadowFace(const scenes::Light& light, const glm::dvec3& ahead, double radius)
        : type_(light.type), radius_(radius), reach_(radius), area_(std::numbers::pi * radius * radius) {
        x_ = glm::normalize(
            glm::cross(ahead, std::abs(ahead.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
        y_ = glm::cross(x_, ahead);
        const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
        if (!info.isArea || light.type == scenes::LightType::Sphere) return;
        reach_ = scenes::surfaceReachMetres(light);
        axis_ = light.directionWS;
        if (light.type == scenes::LightType::Tube) {
            radius_ = double(light.radiusMetres);
            halfLength_ = 0.5 * double(light.lengthMetres);
            return;
        }
        isFlat_ = true;
        x_ = info.isTurned() ? light.alongWS
                             : glm::normalize(glm::cross(axis_, std::abs(axis_.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0)
                                                                                        : glm::dvec3(0.0, 1.0, 0.0)));
        y_ = glm::cross(axis_, x_);
        sidesMetres_ = {light.widthMetres, light.heightMetres};
        if (!info.hasCorners()) return;
        triangles_ = trianglesWithin(light.corners);
        // The sum of these, not scenes::signedArea(), by which the product finds what is judged here.
        area_ = 0.0;
        for (const Triangle& triangle : triangles_) {
            const double area = areaOf(triangle);
            area_ += area;
            middle_ += area / 3.0 * inPlane(triangle[0] + triangle[1] + triangle[2]);
        }
        middle_ /= area_;
    }

    /// In a ring, or of what is not round a column, of so many of equal area, by the share of the way round or up and a
    /// third number from 0 to 1: of the way along a tube, or across a column.
    glm::dvec3 at(int ring, int rings, double turn, double third) const {
        const double column = (ring + third) / rings;
        if (!triangles_.empty()) return inPlane(inTriangles(column * area_, turn));
        if (type_ == scenes::LightType::Rectangle) return inPlane((glm::dvec2(column, turn) - 0.5) * sidesMetres_);
        const double angle = 2.0 * std::numbers::pi * turn, share = std::sqrt((ring + 0.5) / rings);
        return inPlane(radius_ * share * glm::dvec2(std::cos(angle), std::sin(angle))) +
               (2.0 * third - 1.0) * halfLength_ * axis_;
    }

    /// Of its area, from the light's position.
    const glm::dvec3& middle() const { return middle_; }
    double reachMetres() const { return reach_; }
    /// The most of its area, as a share, that a strip of its plane of so many metres can hold that another plane with
    /// this normal cuts out of space.
    double shareOfCut(double metres, const glm::dvec3& normal) const {
        if (halfLength_ > 0.0) return std::min(2.0 * metres / (std::numbers::pi * radius_), 1.0);
        const double sine = isFlat_ ? glm::length(glm::cross(axis_, normal)) : 1.0;
        return std::min(2.0 * reach_ * metres / (area_ * std::max(sine, 1e-12)), 1.0);
    }

private:
    using Triangle = std::array<glm::dvec2, 3>;

    static double areaOf(const Triangle& triangle) {
        return 0.5 * std::abs(glm::determinant(glm::dmat2(triangle[1] - triangle[0], triangle[2] - triangle[0])));
    }

    glm::dvec3 inPlane(const glm::dvec2& place) const { return place.x * x_ + place.y * y_; }

    /// Where so many square metres of the triangles end.
    glm::dvec2 inTriangles(double squareMetres, double turn) const {
        for (const Triangle& triangle : triangles_) {
            const auto& [a, b, c] = triangle;
            const double area = areaOf(triangle);
            if (squareMetres < area) return a + std::sqrt(squareMetres / area) * (glm::mix(b, c, turn) - a);
            squareMetres -= area;
        }
        return triangles_.back()[1];
    }

    scenes::LightType type_;
    glm::dvec3 x_{0.0}, y_{0.0}, axis_{0.0}, middle_{0.0};
    glm::dvec2 sidesMetres_{0.0};
    double radius_, halfLength_ = 0.0;
    double reach_, area_; ///< the largest that it shows
    bool isFlat_ = false;
    std::vector<Triangle> triangles_; ///< of a polygon
};

struct Occlusion::Casters {
    Textures textures;           ///< a shadow has no size in pixels, so level 0 counts
    Anchor anchor;               ///< Embree's origin: the digits are where the pixels look
    double radiusMetres = 0.0;   ///< around it, all casters
    double originMetres = 0.0;   ///< from it to the product's origin of casters, their corners' median on each axis
    double roundingMetres = 0.0; ///< by how much rounding may move what is drawn, beyond that of its distance from both
    Device device;
    Tree tree; ///< null without casters

    /// `own` is null where the segment begins above the surface.
    ShadowQuery ask(const Segment& segment, const Hit* own, const scenes::Material* passed = nullptr) const {
        ShadowQuery query{};
        rtcInitIntersectContext(&query);
        query.segment = segment;
        query.centreRWS = anchor.centreRWS;
        query.ownObject = own ? own->object : nullptr;
        query.ownTriangle = own ? own->triangle : 0;
        query.textures = &textures;
        query.passed = passed;
        RTCRay ray = rayFrom(glm::vec3(segment.from), glm::vec3(segment.along)).ray;
        ray.tfar = 1.00001f; // the judge knows the end in double
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
    double leewayMetres(bool isPlaced, const ShiningLight& light, double pointMetres, double wayMetres) const {
        return isPlaced ? leewayMetres(light.positionRWS) : pointMetres + kPositionRounding * wayMetres;
    }

    static Answer decided(double share) { return {share, share, share}; }
    /// All or nothing of the light at one end of a segment. `own` is null where the point's own triangle does not
    /// count, and `pointMetres` what rounding leaves open of the point.
    Answer decide(const Segment& segment, bool isPlaced, const ShiningLight& light, const Hit* surface,
                  const OwnTriangle* own, double pointMetres, bool leeway) const {
        const bool isBehind = own && own->hides(segment.along);
        if (isBehind && !leeway) return decided(0.0);
        const ShadowQuery exact = ask(segment, surface);
        const double share = exact.isHidden || isBehind ? 0.0 : 1.0;
        if (!leeway) return decided(share);
        const Answer undecided{share, 0.0, 1.0, true};
        if (exact.isUndecided) return undecided;
        // The ends move across the way, which decides edges, and along it, which decides contacts.
        const auto& [from, along] = segment;
        const double lightMetres = leewayMetres(isPlaced, light, pointMetres, glm::length(along));
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

    /// Of a segment that begins on the surface, by channel.
    glm::dvec3 passage(const Segment& segment, const Hit& hit, const SurfacePoint& surface) const {
        ShadowQuery query = ask(segment, &hit, hit.object->material);
        if (query.isHidden) return glm::dvec3(0.0);
        const double metres = shareInside(std::move(query.crossings)) * glm::length(segment.along);
        return glm::exp(-metres * surface.absorptionPerMetre);
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

Occlusion::Answer Occlusion::of(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface,
                                const glm::dvec3& pointRWS, const glm::dvec3& toViewer,
                                const Settings& settings) const {
    const Casters& casters = *casters_;
    if (!light.castsShadow || !casters.tree) return {};
    const bool isPlaced = scenes::infoOf(light.light.type).hasPosition();
    const auto wayFrom = [&](const glm::dvec3& placeRWS) {
        return isPlaced ? light.positionRWS - placeRWS : -light.light.directionWS;
    };
    if (wayFrom(pointRWS) == glm::dvec3(0.0)) return {};
    const double lift = liftMetres(surface, wayFrom(pointRWS));
    const glm::dvec3 fromRWS = pointRWS + lift * surface.normal;
    const glm::dvec3 from = fromRWS - casters.anchor.centreRWS;
    const glm::dvec3 toLight = wayFrom(fromRWS);
    const double distance = glm::length(toLight);
    if (distance == 0.0) return {};
    const double radius =
        isPlaced ? scenes::shadowRadiusMetres(light.light) : std::tan(double(light.light.angularRadiusRadians));
    // Past all casters, where the light has no place.
    const double reach = isPlaced ? 1.0 : 2.0 * (casters.radiusMetres + glm::length(from)) + 1.0;
    const OwnTriangle ownTriangle(hit, toViewer);
    const bool wraps = surface.wrap != glm::dvec3(0.0);
    const OwnTriangle* const own = wraps ? nullptr : &ownTriangle;
    const Hit* const start = lift > 0.0 ? nullptr : &hit;
    const double pointMetres =
        casters.leewayMetres(fromRWS) + (wraps ? kNormalRounding * surface.bodyRadiusMetres : 0.0);
    const Segment toCentre{from, toLight * reach};
    if (radius == 0.0) return casters.decide(toCentre, isPlaced, light, start, own, pointMetres, settings.leeway);
    Answer sum{0.0, 0.0, 0.0};
    double halves[2] = {0.0, 0.0}; // of every other ray
    // The outline of an area is cut at the surface already, so only what lies before the own triangle counts.
    const bool isCut = own && scenes::infoOf(light.light.type).isArea;
    const ShadowFace face(light.light, toLight / distance, radius);
    double counted = 0.0; // the share of the face
    const auto trace = [&](int rings) {
        halves[0] = halves[1] = 0.0;
        const int sectors = 4 * rings;
        int rays = 0;
        for (int ring = 0; ring < rings; ++ring) {
            for (int sector = 0; sector < sectors; ++sector) {
                // Rings are turned against each other, so that no straight edge meets many samples at once.
                const auto fraction = [](double value) { return value - std::floor(value); };
                const double turn = fraction((sector + 0.6180339887498949 * ring) / sectors);
                const double third = fraction(0.7548776662466927 * (ring * sectors + sector + 0.5));
                const glm::dvec3 place = toLight + face.at(ring, rings, turn, third);
                if (isCut && own->hides(place)) continue;
                ++rays;
                halves[(ring + sector) % 2] +=
                    casters.decide({from, place * reach}, isPlaced, light, start, own, pointMetres, false).share;
            }
        }
        counted = double(rays) / double(rings * sectors);
        sum.share = (halves[0] + halves[1]) / double(std::max(rays, 1));
    };
    trace(settings.shadowRings);
    if (sum.share > 0.0 && sum.share < 1.0 && settings.penumbraRings > settings.shadowRings) {
        trace(settings.penumbraRings);
        const double rays = counted * double(4 * settings.penumbraRings * settings.penumbraRings);
        const double error = (halves[0] - halves[1]) / rays;
        sum.noise.ofReference = error * error;
    }
    // Independent rays would stray by five of these in one case of 10^6; two rays are for distributions far from normal
    // ones. Where all agree, a program's must too.
    const double rays = std::max(counted * double(settings.shadowSamples), 1.0);
    const bool isNoisy = settings.leeway && settings.shadowSamples > 0 && sum.share > 0.0 && sum.share < 1.0;
    const double spread = sum.share * (1.0 - sum.share);
    if (isNoisy) {
        sum.noise.variance = spread / rays;
        sum.noise.fourth = spread * (1.0 - 6.0 * spread) / (rays * rays * rays);
    }
    double stray = isNoisy ? 5.0 * std::sqrt(sum.noise.variance) + 2.0 / rays : 0.0;
    // Where rounding decides whether casters hide the middle of a light, it may decide the rest. That of a polygon may
    // lie far from its position, in which no ray ends.
    const Segment toMiddle{from, (toLight + face.middle()) * reach};
    if (settings.leeway && toMiddle.along != glm::dvec3(0.0) &&
        casters.decide(toMiddle, isPlaced, light, start, nullptr, pointMetres, true).isUndecided) {
        stray = 1.0;
        sum.isUndecided = true;
    }
    // The own triangle's plane may cut the face elsewhere: by the length of the chord there, at most its diameter.
    const double metres = pointMetres + casters.leewayMetres(isPlaced, light, pointMetres, distance * reach);
    const double cut = ownTriangle.leewayRadians * std::hypot(distance, face.reachMetres()) + metres / reach;
    if (settings.leeway && own && std::abs(glm::dot(own->normal, toLight)) <= face.reachMetres() + cut) {
        const double share = face.shareOfCut(cut, own->normal) / std::max(counted, 1e-9);
        stray += share;
        sum.isUndecided = sum.isUndecided || share > kDecisiveShare;
    }
    sum.least = std::max(0.0, sum.share - stray);
    sum.most = std::min(1.0, sum.share + stray);
    return sum;
}

Occlusion::Passage Occlusion::passageOf(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface,
                                        const glm::dvec3& pointRWS, bool leeway) const {
    const Casters& casters = *casters_;
    if (!light.castsShadow || !casters.tree) return {};
    const bool isPlaced = scenes::infoOf(light.light.type).hasPosition();
    const glm::dvec3 from = pointRWS - casters.anchor.centreRWS;
    const glm::dvec3 toLight = isPlaced ? light.positionRWS - pointRWS : -light.light.directionWS;
    if (toLight == glm::dvec3(0.0)) return {};
    const glm::dvec3 along = toLight * (isPlaced ? 1.0 : 2.0 * (casters.radiusMetres + glm::length(from)) + 1.0);
    Passage passage;
    passage.share = passage.least = passage.most = casters.passage({from, along}, hit, surface);
    if (!leeway) return passage;
    const double pointMetres = casters.leewayMetres(pointRWS);
    const double lightMetres = casters.leewayMetres(isPlaced, light, pointMetres, glm::length(along));
    const glm::dvec3 ahead = glm::normalize(along);
    const glm::dvec3 aside = glm::normalize(
        glm::cross(ahead, std::abs(ahead.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(aside, ahead);
    const auto extend = [&](const glm::dvec3& pointStep, const glm::dvec3& lightStep) {
        const glm::dvec3 other = casters.passage({from + pointStep, along + lightStep - pointStep}, hit, surface);
        passage.least = glm::min(passage.least, other);
        passage.most = glm::max(passage.most, other);
    };
    for (const glm::dvec3& way : {aside, -aside, up, -up}) extend(pointMetres * way, lightMetres * way);
    extend(-pointMetres * ahead, lightMetres * ahead);
    extend(pointMetres * ahead, -lightMetres * ahead);
    // Of what light from straight behind would give.
    const glm::dvec3 open = std::abs(glm::dot(surface.normal, ahead)) * (passage.most - passage.least);
    passage.isUndecided = std::max({open.r, open.g, open.b}) > kDecisiveShare;
    return passage;
}

} // namespace tessera::reference
