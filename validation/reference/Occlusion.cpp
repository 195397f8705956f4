#include "validation/reference/Occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "scenes/Shadows.h"
#include "validation/reference/Casters.h"
#include "validation/reference/LightFace.h"
#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

namespace {

/// Lights with a size: a smaller change of the visible fraction by rounding does not count as undecided.
constexpr double kDecisiveShare = 0.01;

/// Shadow rays of wrapped light start above the surface: by (this - n.l) radii of the body, where n.l is less.
constexpr double kLiftCosine = 0.1;
/// Error of a program's normals, besides that of their texture.
constexpr double kNormalRounding = 4e-6;

/// Twice the angular error of a direction stored as two octahedral coordinates of 12 bits.
constexpr double kStoredFacetRadians = 2.2e-3;

double liftMetres(const SurfacePoint& surface, const glm::dvec3& toLight) {
    if (surface.wrap == glm::dvec3(0.0)) return 0.0;
    const double cosine = glm::dot(surface.normal, toLight) / glm::length(toLight);
    return std::max(kLiftCosine - cosine, 0.0) * surface.bodyRadiusMetres;
}

/// Whether the triangle's corners have different normals, all close enough to the geometric one, in the mesh's space.
bool isLifted(const Hit& hit) {
    const scenes::Mesh& mesh = *hit.object->mesh;
    glm::dvec3 corners[3], normals[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = mesh.indices[3 * std::size_t(hit.triangle) + i];
        corners[i] = glm::dvec3(mesh.positionsOS[vertex]);
        normals[i] = glm::dvec3(mesh.normalsOS[vertex]);
    }
    if (normals[0] == normals[1] && normals[1] == normals[2]) return false;
    const glm::dvec3 facet = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double least = std::cos(glm::radians(scenes::kMostLiftedDegrees)) * glm::length(facet);
    return least > 0.0 && std::ranges::all_of(normals, [&](const glm::dvec3& normal) {
               return glm::dot(normal, facet) >= least * glm::length(normal);
           });
}

/// Softened terminators: height above a smooth-shaded triangle at which shadow rays start. Hanika 2021 ("Hacking the
/// Shadow Terminator", Ray Tracing Gems II, chapter 4) projects the point onto each corner's tangent plane and blends
/// the three projections by the barycentric weights. Here that is a height along the triangle's normal. Heights below
/// the triangle are subtracted; a negative sum lifts the point by its magnitude.
double terminatorLift(const Hit& hit) {
    if (!isLifted(hit)) return 0.0;
    const scenes::Mesh& mesh = *hit.object->mesh;
    glm::dvec3 normals[3], point(0.0), blended(0.0);
    for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = mesh.indices[3 * std::size_t(hit.triangle) + std::size_t(corner)];
        normals[corner] = hit.object->normalFromObject * glm::dvec3(mesh.normalsOS[vertex]);
        point += hit.weights[corner] * hit.object->cornerRWS(hit.triangle, corner);
        blended += hit.weights[corner] * normals[corner];
    }
    double height = 0.0;
    for (int corner = 0; corner < 3; ++corner)
        height += hit.weights[corner] * glm::dot(normals[corner], hit.object->cornerRWS(hit.triangle, corner) - point);
    const double length = glm::length(blended);
    return length > 0.0 ? std::abs(height) / length : 0.0;
}

/// A program quantises that height to twelve steps per power of two. Its error is half a twelfth, and little more.
constexpr double kLiftSteps = 0.045;
/// In pixel widths: a program may store smaller heights as 0.
constexpr double kLiftLeastPixels = 1.0 / 4096.0;

/// Distance between the surface points of neighbouring pixels, the larger of the two directions.
double pixelMetres(const Hit& hit) {
    glm::dvec3 across(0.0), up(0.0);
    for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 place = hit.object->cornerRWS(hit.triangle, corner);
        across += hit.weightsDx[corner] * place;
        up += hit.weightsDy[corner] * place;
    }
    return std::max(glm::length(across), glm::length(up));
}

/// A plane through a surface point that hides lights on the side away from the viewer: that of its triangle, or of
/// its shading normal.
struct OwnPlane {
    glm::dvec3 normal{0.0}; ///< unit, towards the viewer; 0 if the triangle has no area
    /// A program stores the normal in 24 bits, and derives it from rounded corners or from rounded points of pixels.
    double toleranceRadians = 0.0;

    OwnPlane(const glm::dvec3& litNormal, double tolerance) : normal(litNormal), toleranceRadians(tolerance) {}
    OwnPlane(const Hit& surface, const glm::dvec3& toViewer) {
        glm::dvec3 corners[3];
        for (int i = 0; i < 3; ++i) corners[i] = surface.object->cornerRWS(surface.triangle, i);
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double area = glm::length(across);
        if (area == 0.0) return;
        normal = across / (glm::dot(across, toViewer) < 0.0 ? -area : area);
        double longest = 0.0;
        for (int i = 0; i < 3; ++i) longest = std::max(longest, glm::length(corners[(i + 1) % 3] - corners[i]));
        toleranceRadians = kStoredFacetRadians + 4.0 * surface.roundingMetres * longest / area + surface.roundingPixels;
    }
    bool hides(const glm::dvec3& toPlace) const { return glm::dot(normal, toPlace) < 0.0; }
    /// Whether a program may decide otherwise, if it also moves the direction to the place by `metres`.
    bool isUndecided(const glm::dvec3& toPlace, double metres) const {
        return std::abs(glm::dot(normal, toPlace)) <= toleranceRadians * glm::length(toPlace) + metres;
    }
};

/// The fraction of a segment that lies inside. Crossings of triangles that share an edge are merged.
double shareInside(std::vector<double> crossings) {
    std::ranges::sort(crossings, {}, [](double crossing) { return std::abs(crossing); });
    const auto isSame = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(a); };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), isSame), crossings.end());
    return std::max(std::accumulate(crossings.begin(), crossings.end(), 0.0), 0.0);
}

/// A segment with its ends moved by these distances: across it, which decides edges, and along it, which decides
/// contacts.
std::array<Segment, 6> movedEnds(const Segment& segment, double pointMetres, double lightMetres) {
    const glm::dvec3 ahead = glm::normalize(segment.along), aside = besideOf(ahead), up = glm::cross(aside, ahead);
    const auto moved = [&](const glm::dvec3& pointStep, const glm::dvec3& lightStep) {
        return Segment{segment.from + pointStep, segment.along + lightStep - pointStep};
    };
    const auto across = [&](const glm::dvec3& way) { return moved(pointMetres * way, lightMetres * way); };
    return {across(aside),
            across(-aside),
            across(up),
            across(-up),
            moved(-pointMetres * ahead, lightMetres * ahead),
            moved(pointMetres * ahead, -lightMetres * ahead)};
}

Occlusion::Answer decided(double share) {
    return {share, share, share};
}

/// Rounding error of a ray's start: `metres` in every direction, and for a lifted point this step up or down.
struct PointTolerance {
    double metres = 0.0;
    glm::dvec3 liftStep{0.0};
    double reachMetres() const { return metres + glm::length(liftStep); }
};

/// Visibility of the light at one end of a segment, 0 or 1. `own` is null where the point's own plane does not count.
Occlusion::Answer decide(const Casters& casters, const Segment& segment, bool isPlaced, const ShiningLight& light,
                         const Hit* surface, const OwnPlane* own, const PointTolerance& point, bool findsAlternatives) {
    const bool isBehind = own && own->hides(segment.along);
    if (isBehind && !findsAlternatives) return decided(0.0);
    const Casters::Met exact = casters.meet(segment, surface);
    const double share = exact.isHidden || isBehind ? 0.0 : 1.0;
    if (!findsAlternatives) return decided(share);
    const Occlusion::Answer undecided{share, 0.0, 1.0, true};
    if (exact.isUndecided) return undecided;
    const glm::dvec3& along = segment.along;
    const double lightMetres = casters.toleranceMetres(isPlaced, light, point.metres, glm::length(along));
    // Where casters hide the light, the point's own triangle does not matter.
    const bool isOwnUndecided = own && own->isUndecided(along, point.reachMetres() + lightMetres);
    if (isBehind && !isOwnUndecided) return decided(0.0);
    if (isOwnUndecided && !exact.isHidden) return undecided;
    const auto isOtherwise = [&](const glm::dvec3& step) {
        const Segment lifted{segment.from + step, isPlaced ? along - step : along};
        return std::ranges::any_of(movedEnds(lifted, point.metres, lightMetres), [&](const Segment& moved) {
            const Casters::Met other = casters.meet(moved, surface);
            return other.isHidden != exact.isHidden || other.isUndecided;
        });
    };
    const bool isLifted = point.liftStep != glm::dvec3(0.0);
    if (isOtherwise(point.liftStep) || (isLifted && isOtherwise(-point.liftStep))) return undecided;
    return decided(share);
}

/// Transmittance along a segment that begins on the surface, by channel.
glm::dvec3 passageAlong(const Casters& casters, const Segment& segment, const Hit& hit, const SurfacePoint& surface) {
    Casters::Met met = casters.meet(segment, &hit, hit.object->material);
    if (met.isHidden) return glm::dvec3(0.0);
    const double metres = shareInside(std::move(met.crossings)) * glm::length(segment.along);
    return glm::exp(-metres * surface.absorptionPerMetre);
}

} // namespace

Occlusion::Occlusion(const scenes::Scene& scene, const Objects& objects) : casters_(new Casters(scene, objects)) {}

Occlusion::~Occlusion() = default;

/// Start of shadow rays.
struct Occlusion::Start {
    const Hit& hit;
    const SurfacePoint& surface;
    glm::dvec3 pointRWS;
    glm::dvec3 toViewer;
    double terminatorLift = 0.0;
};

Occlusion::Answer Occlusion::of(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface,
                                const glm::dvec3& pointRWS, const glm::dvec3& toViewer,
                                const Settings& settings) const {
    if (!light.castsShadow || casters_->empty()) return {};
    const bool mayLift = settings.softensTerminators && surface.wrap == glm::dvec3(0.0);
    const double lift = mayLift ? terminatorLift(hit) : 0.0;
    const Start onTriangle{hit, surface, pointRWS, toViewer};
    if (lift == 0.0) return from(onTriangle, light, settings);
    Start above = onTriangle;
    above.terminatorLift = lift;
    Answer answer = from(above, light, settings);
    // The height's rounding error is as large as the point's.
    if (!settings.findsAlternatives || lift > kLiftLeastPixels * pixelMetres(hit) + casters_->toleranceMetres(pointRWS))
        return answer;
    const Answer exact = from(onTriangle, light, settings);
    answer.isUndecided = answer.isUndecided || std::abs(answer.share - exact.share) > kDecisiveShare;
    answer.least = std::min(answer.least, exact.least);
    answer.most = std::max(answer.most, exact.most);
    return answer;
}

Occlusion::Answer Occlusion::from(const Start& begin, const ShiningLight& light, const Settings& settings) const {
    const Casters& casters = *casters_;
    const auto& [hit, surface, pointRWS, toViewer, terminatorLift] = begin;
    const bool isPlaced = scenes::infoOf(light.light.type).hasPosition();
    const auto wayFrom = [&](const glm::dvec3& placeRWS) {
        return isPlaced ? light.positionRWS - placeRWS : -light.light.directionWS;
    };
    if (wayFrom(pointRWS) == glm::dvec3(0.0)) return {};
    const double lift = liftMetres(surface, wayFrom(pointRWS));
    const OwnPlane ownTriangle(hit, toViewer);
    const glm::dvec3 fromRWS = pointRWS + lift * surface.normal + terminatorLift * ownTriangle.normal;
    const glm::dvec3 from = fromRWS - casters.centreRWS();
    const glm::dvec3 toLight = wayFrom(fromRWS);
    const double distance = glm::length(toLight);
    if (distance == 0.0) return {};
    const double radius =
        isPlaced ? scenes::shadowRadiusMetres(light.light) : std::tan(double(light.light.angularRadiusRadians));
    // Without a position the ray ends beyond all casters.
    const double reach = isPlaced ? 1.0 : 2.0 * (casters.radiusMetres() + glm::length(from)) + 1.0;
    const bool wraps = surface.wrap != glm::dvec3(0.0);
    const OwnPlane ownPlane = terminatorLift > 0.0 ? OwnPlane(surface.normal, kNormalRounding) : ownTriangle;
    const OwnPlane* const own = wraps ? nullptr : &ownPlane;
    // A lifted point may be hidden by its own triangle, but only from places behind it.
    const bool isBeforeOwn = glm::dot(ownTriangle.normal, toLight) >
                             ownTriangle.toleranceRadians * distance + radius + 2.0 * casters.toleranceMetres(fromRWS);
    const Hit* const start = lift > 0.0 || (terminatorLift > 0.0 && !isBeforeOwn) ? nullptr : &hit;
    // The error of the triangle's normal also moves a lifted point sideways.
    const double asideMetres =
        terminatorLift > 0.0 ? 0.5 * kStoredFacetRadians * terminatorLift + 2.0 * hit.roundingMetres : 0.0;
    const PointTolerance point{casters.toleranceMetres(fromRWS) +
                                   (wraps ? kNormalRounding * surface.bodyRadiusMetres : 0.0) + asideMetres,
                               kLiftSteps * terminatorLift * ownTriangle.normal};
    const Segment toCentre{from, toLight * reach};
    if (radius == 0.0) return decide(casters, toCentre, isPlaced, light, start, own, point, settings.findsAlternatives);
    Answer sum{0.0, 0.0, 0.0};
    double halves[2] = {0.0, 0.0}; // sums of alternating rays
    // An area light's outline is already clipped at the surface, so only samples in front of ownPlane count.
    const bool isCut = own && scenes::infoOf(light.light.type).isArea;
    const LightFace face(light.light, toLight / distance, radius);
    double counted = 0.0; // fraction of the samples
    const auto trace = [&](int rings) {
        halves[0] = halves[1] = 0.0;
        const int sectors = 4 * rings;
        int rays = 0;
        for (int ring = 0; ring < rings; ++ring) {
            for (int sector = 0; sector < sectors; ++sector) {
                // Rings are rotated against each other, so that a straight edge meets few samples at once.
                const auto fraction = [](double value) { return value - std::floor(value); };
                const double turn = fraction((sector + 0.6180339887498949 * ring) / sectors);
                const double third = fraction(0.7548776662466927 * (ring * sectors + sector + 0.5));
                const glm::dvec3 place = toLight + face.at(ring, rings, turn, third);
                if (isCut && own->hides(place)) continue;
                ++rays;
                halves[(ring + sector) % 2] +=
                    decide(casters, {from, place * reach}, isPlaced, light, start, own, point, false).share;
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
    // Independent rays exceed five standard deviations in one case of 10^6; two rays are added for distributions far
    // from normal. Where all rays agree, a program's must too.
    const double rays = std::max(counted * double(settings.shadowSamples), 1.0);
    const bool isNoisy = settings.findsAlternatives && settings.shadowSamples > 0 && sum.share > 0.0 && sum.share < 1.0;
    const double spread = sum.share * (1.0 - sum.share);
    if (isNoisy) {
        sum.noise.variance = spread / rays;
        sum.noise.fourth = spread * (1.0 - 6.0 * spread) / (rays * rays * rays);
    }
    double stray = isNoisy ? 5.0 * std::sqrt(sum.noise.variance) + 2.0 / rays : 0.0;
    // Where rounding decides whether casters hide the middle of a light, it may decide the rest. The middle of a
    // polygon may lie far from its position, where no ray ends.
    const Segment toMiddle{from, (toLight + face.middle()) * reach};
    if (settings.findsAlternatives && toMiddle.along != glm::dvec3(0.0) &&
        decide(casters, toMiddle, isPlaced, light, start, nullptr, point, true).isUndecided) {
        stray = 1.0;
        sum.isUndecided = true;
    }
    // ownPlane may clip the face elsewhere, along a chord of at most the face's diameter.
    const double metres =
        point.reachMetres() + casters.toleranceMetres(isPlaced, light, point.metres, distance * reach);
    const double cut = ownPlane.toleranceRadians * std::hypot(distance, face.reachMetres()) + metres / reach;
    if (settings.findsAlternatives && own && std::abs(glm::dot(own->normal, toLight)) <= face.reachMetres() + cut) {
        const double share = face.shareOfCut(cut, own->normal) / std::max(counted, 1e-9);
        stray += share;
        sum.isUndecided = sum.isUndecided || share > kDecisiveShare;
    }
    sum.least = std::max(0.0, sum.share - stray);
    sum.most = std::min(1.0, sum.share + stray);
    return sum;
}

Occlusion::Passage Occlusion::passageOf(const ShiningLight& light, const Hit& hit, const SurfacePoint& surface,
                                        const glm::dvec3& pointRWS, bool findsAlternatives) const {
    const Casters& casters = *casters_;
    if (!light.castsShadow || casters.empty()) return {};
    const bool isPlaced = scenes::infoOf(light.light.type).hasPosition();
    const glm::dvec3 from = pointRWS - casters.centreRWS();
    const glm::dvec3 toLight = isPlaced ? light.positionRWS - pointRWS : -light.light.directionWS;
    if (toLight == glm::dvec3(0.0)) return {};
    const glm::dvec3 along = toLight * (isPlaced ? 1.0 : 2.0 * (casters.radiusMetres() + glm::length(from)) + 1.0);
    Passage passage;
    passage.share = passage.least = passage.most = passageAlong(casters, {from, along}, hit, surface);
    if (!findsAlternatives) return passage;
    const double pointMetres = casters.toleranceMetres(pointRWS);
    const double lightMetres = casters.toleranceMetres(isPlaced, light, pointMetres, glm::length(along));
    for (const Segment& moved : movedEnds({from, along}, pointMetres, lightMetres)) {
        const glm::dvec3 other = passageAlong(casters, moved, hit, surface);
        passage.least = glm::min(passage.least, other);
        passage.most = glm::max(passage.most, other);
    }
    // As a fraction of the transmitted light if it came from straight behind.
    const glm::dvec3 open = std::abs(glm::dot(surface.normal, glm::normalize(along))) * (passage.most - passage.least);
    passage.isUndecided = std::max({open.r, open.g, open.b}) > kDecisiveShare;
    return passage;
}

} // namespace tessera::reference
