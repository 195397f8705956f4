// The refracted background of glass bodies: closed forms of refracted rays, and the reference.
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/GlassBehindTest.h"

namespace tessera {
namespace {

using frame::Refraction;
using scenes::Material;
using scenes::Scene;
using namespace test;

class GlassBehindTruth : public GlassBehindTest {};

/// Viewed straight on, only reflection and absorption dim the background, whatever the index.
TEST_F(GlassBehindTruth, seenStraightOnShowsWhatItsClosedFormLeaves) {
    Material glass = clearGlass();
    glass.baseColor = {0.9f, 0.7f, 0.5f, 1.0f};
    glass.transmission = 0.75f;
    glass.thicknessMetres = 0.5f;
    glass.attenuationDistanceMetres = 0.25f;
    glass.attenuationColor = {0.5f, 0.8f, 1.0f};
    const std::vector<float> plain = drawn(checkedWall(), seeing(Refraction::OneSide));
    for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides})
        for (const float ior : {1.5f, 2.0f}) {
            glass.ior = ior;
            const double contrast = (double(ior) - 1.0) / (double(ior) + 1.0);
            const std::vector<float> shown = drawn(coveredByGlass(checkedWall(), glass), seeing(refraction));
            for (int y = 0; y < kBehindPixels; ++y)
                for (int x = 0; x < kBehindPixels; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const double left = std::pow(double(glass.attenuationColor[c]), 2.0);
                        const double wanted =
                            0.75 * double(glass.baseColor[c]) * left * (1.0 - contrast * contrast) * at(plain, x, y)[c];
                        ASSERT_NEAR(at(shown, x, y)[c], wanted, kGlassRounding * std::max(wanted, 1e-3))
                            << ior << " at " << x << ", " << y;
                    }
        }
}

/// Shifts by a whole number of pixels, so that no texel is interpolated. What would come from beyond the image's edge
/// is unknown: there the body shows the background.
TEST_F(GlassBehindTruth, withAFarSideMovesThePictureAsideByTheClosedForm) {
    constexpr int kMoved = 3;
    const frame::FrameSettings settings = seeing(Refraction::TwoSides);
    const std::vector<float> plain = drawn(checkedWall(), settings);
    const double cosine = std::cos(kBehindTiltRadians);
    for (const double ior : {1.3, 1.5, 2.4}) {
        Material glass = clearGlass();
        glass.ior = float(ior);
        glass.thicknessMetres =
            float(kMoved * kBehindPixelMetres / asideMetres(1.0, double(glass.ior), kBehindTiltRadians));
        const double straight = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
        const double share = 1.0 - (straight + (1.0 - straight) * std::pow(1.0 - cosine, 5.0));
        const std::vector<float> shown = drawn(coveredByGlass(checkedWall(), glass, kBehindTiltRadians), settings);
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                const glm::dvec3 behind = x < kMoved ? glm::dvec3(0.125, 0.375, 0.625) : at(plain, x - kMoved, y);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(at(shown, x, y)[c], share * behind[c], 1e-5) << ior << " at " << x << ", " << y;
            }
    }
}

/// Half of twice the thickness is the thickness; a thickness of 0 shifts nothing.
TEST_F(GlassBehindTruth, withAFarSideIsAsThickAsItsTextureSays) {
    const frame::FrameSettings settings = seeing(Refraction::TwoSides);
    const auto shownOf = [&](float thickness, std::optional<float> texel) {
        Material glass = bareGlass(1.5);
        glass.thicknessMetres = thickness;
        Scene scene = coveredByGlass(checkedWall(), glass, kBehindTiltRadians);
        if (texel) {
            scene.images.push_back(floatImage({0.7f, *texel, 0.3f, 0.1f}));
            scene.materials.back().texture(scenes::TextureSlot::Thickness).image = int(scene.images.size()) - 1;
        }
        return drawn(scene, settings);
    };
    const auto expectAlike = [](const std::vector<float>& own, const std::vector<float>& wanted) {
        for (std::size_t i = 0; i < own.size(); ++i) ASSERT_NEAR(own[i], wanted[i], 1e-5f) << i;
    };
    const std::vector<float> plain = drawn(checkedWall(), settings), moved = shownOf(0.5f, std::nullopt);
    EXPECT_NE(moved, plain);
    expectAlike(shownOf(1.0f, 0.5f), moved);
    expectAlike(shownOf(0.5f, 0.0f), plain);
}

/// Rays refracted once meet a wall, upright or leaning, where a plane and a line meet.
TEST_F(GlassBehindTruth, bentOnceShowsWhereTheRayMeetsTheWall) {
    constexpr double kIor = 1.5;
    const double bend = std::tan(kBehindTiltRadians - std::asin(std::sin(kBehindTiltRadians) / kIor));
    for (const double leanRadians : {0.0, -0.6, 0.6}) {
        Scene wall = rampWall();
        placeQuad(wall.nodes[0], -kBehindWallMetres, 4.0, leanRadians);
        const frame::FrameSettings settings = seeing(Refraction::OneSide);
        const std::vector<float> plain = drawn(wall, settings);
        const std::vector<float> shown = drawn(coveredByGlass(wall, bareGlass(kIor), kBehindTiltRadians), settings);
        const double slope = -std::tan(leanRadians); // of the wall's z by x
        SCOPED_TRACE(leanRadians);
        const int met = expectPlaces(shown, plain, 0.05, 1e-5, [&](int x, int) -> std::optional<double> {
            // The ray begins on the glass, at z = -x tan(tilt), and goes to the left as it goes back.
            const double begin = metresOf(x), above = -begin * std::tan(kBehindTiltRadians) + kBehindWallMetres;
            const double place = (begin - above * bend) / (1.0 - slope * bend);
            if (place < -1.0 + kBehindPixelMetres) return {};
            return place;
        });
        EXPECT_GT(met, kBehindPixels * kBehindPixels / 3);
    }
}

/// A body thicker than the distance to the wall: rays meet the wall inside, before they would leave the body behind it.
TEST_F(GlassBehindTruth, withAFarSideBehindTheWallShowsWhereTheRayMeetsTheWallInside) {
    constexpr double kIor = 1.5;
    const double bend = std::tan(kBehindTiltRadians - std::asin(std::sin(kBehindTiltRadians) / kIor));
    Material deep = bareGlass(kIor);
    deep.thicknessMetres = 8.0f;
    const frame::FrameSettings settings = seeing(Refraction::TwoSides);
    const Scene covered = coveredByGlass(rampWall(), deep, kBehindTiltRadians);
    const std::vector<float> plain = drawn(rampWall(), settings), shown = drawn(covered, settings);
    const std::vector<float> truth = strictRadiance(covered, settings);
    const auto placeOf = [&](int x, int) -> std::optional<double> {
        const double begin = metresOf(x), above = -begin * std::tan(kBehindTiltRadians) + kBehindWallMetres;
        const double place = begin - above * bend;
        if (place < -1.0 + kBehindPixelMetres) return {};
        return place;
    };
    EXPECT_GT(expectPlaces(shown, plain, 0.05, 1e-5, placeOf), kBehindPixels * kBehindPixels / 3);
    SCOPED_TRACE("reference");
    expectPlaces(truth, plain, 0.0, 1e-4, placeOf);
    // For hits inside the body, only the roughness of its near side blurs.
    deep.perceptualRoughness = 0.4f;
    const Scene rough = coveredByGlass(rampWall(), deep, 0.0);
    EXPECT_EQ(drawn(rough, settings), drawn(rough, seeing(Refraction::OneSide)));
}

/// Refracted once, or offset by a far side, with a perspective camera, with a far plane and without.
TEST_F(GlassBehindTruth, throughALensShowsWhereTheRayMeetsTheWall) {
    constexpr double kIor = 1.5, kThicknessMetres = 0.4, kEyeMetres = 3.0, kFovYRadians = 0.5;
    const double half = std::tan(0.5 * kFovYRadians), wallHalf = half * (kEyeMetres + kBehindWallMetres);
    for (const double farMetres : {std::numeric_limits<double>::infinity(), 20.0})
        for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides})
            for (const double tiltRadians : {0.0, kBehindTiltRadians}) {
                Scene wall = rampWall();
                wall.cameras[0].projection = scenes::Projection::Perspective;
                wall.cameras[0].fovYRadians = kFovYRadians;
                wall.cameras[0].farMetres = farMetres;
                Material glass = bareGlass(kIor);
                glass.thicknessMetres = float(kThicknessMetres);
                const frame::FrameSettings settings = seeing(refraction);
                const std::vector<float> plain = drawn(wall, settings);
                const std::vector<float> shown = drawn(coveredByGlass(wall, glass, tiltRadians), settings);
                const glm::dvec3 normal(std::sin(tiltRadians), 0.0, std::cos(tiltRadians));
                const glm::dvec3 eye(0.0, 0.0, kEyeMetres);
                SCOPED_TRACE(fmt::format("{}, tilt {}, to {} m", infoOf(refraction).name, tiltRadians, farMetres));
                const int met = expectPlaces(shown, plain, 0.05, 1e-5, [&](int x, int y) -> std::optional<double> {
                    const glm::dvec3 ray = glm::normalize(glm::dvec3(half * metresOf(x), -half * metresOf(y), -1.0));
                    glm::dvec3 from = eye - glm::dot(eye, normal) / glm::dot(ray, normal) * ray;
                    glm::dvec3 along = *bentDirection(-ray, kIor, normal);
                    if (refraction == Refraction::TwoSides) {
                        from -= kThicknessMetres / glm::dot(along, normal) * along;
                        along = ray;
                    }
                    const glm::dvec3 place = from - (from.z + kBehindWallMetres) / along.z * along;
                    const glm::dvec2 seen = glm::dvec2(place) / wallHalf;
                    if (std::max(std::abs(seen.x), std::abs(seen.y)) > 1.0 - kBehindPixelMetres) return {};
                    return seen.x;
                });
                EXPECT_GT(met, kBehindPixels * kBehindPixels / 2);
            }
}

/// A bar in front of the glass does not block rays that pass behind it, viewed by parallel rays or through a lens.
TEST_F(GlassBehindTruth, raysPassBehindWhatStandsBeforeIt) {
    constexpr double kIor = 2.4, kEyeMetres = 6.0, kBarZ = 1.5, kBarMetres = 0.05; // half its width
    const glm::dvec3 normal(std::sin(kBehindTiltRadians), 0.0, std::cos(kBehindTiltRadians));
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    for (const double perMetre : {0.0, 1.0 / kEyeMetres}) { // decrease along z of the image's half width
        SCOPED_TRACE(perMetre);
        const auto halfWidth = [&](double z) { return 1.0 - perMetre * z; };
        Scene wall = rampWall();
        if (perMetre > 0.0) wall.cameras[0].projection = scenes::Projection::Perspective;
        wall.cameras[0].fovYRadians = 2.0 * std::atan(perMetre);
        wall.cameras[0].worldFromCamera[3].z = kEyeMetres;
        Scene covered = coveredByGlass(wall, bareGlass(kIor), kBehindTiltRadians);
        scenes::Material bright = unlit();
        bright.emissive = glm::vec3(50.0f);
        scenes::Node& bar = addNode(covered, bright);
        placeQuad(bar, kBarZ, 4.0);
        bar.parentFromNode[0] *= kBarMetres / 4.0;
        const std::vector<float> plain = drawn(wall, settings), shown = drawn(covered, settings);
        int crossing = 0, beside = 0;
        expectPlaces(shown, plain, 0.0, 2e-3, [&](int x, int y) -> std::optional<double> {
            const glm::dvec2 begin(metresOf(x), -metresOf(y));
            const glm::dvec3 ray = glm::normalize(glm::dvec3(perMetre * begin, -1.0));
            const glm::dvec3 onGlass = glm::dvec3(begin, 0.0) - begin.x * normal.x / glm::dot(ray, normal) * ray;
            const glm::dvec3 along = *bentDirection(-ray, kIor, normal);
            const glm::dvec3 onWall = onGlass - (onGlass.z + kBehindWallMetres) / along.z * along;
            const glm::dvec2 place = glm::dvec2(onWall) / halfWidth(-kBehindWallMetres);
            const auto isClear = [&](double metres, double pixels = 1.5) {
                return std::abs(metres) > kBarMetres / halfWidth(kBarZ) + pixels * kBehindPixelMetres;
            };
            if (isClear(begin.x) && isClear(place.x, 0.0) && !isClear(place.x, 0.5)) {
                EXPECT_LT(at(shown, x, y).r, 1.0) << "light of the bar beside it";
                ++beside;
            }
            const double rim = std::max(std::abs(place.x), std::abs(place.y));
            if (rim > 1.0 - kBehindPixelMetres || !isClear(begin.x) || !isClear(place.x)) return {};
            crossing += begin.x > 0.0 && place.x < 0.0 ? 1 : 0;
            return place.x;
        });
        EXPECT_GT(crossing, kBehindPixels);
        EXPECT_GT(beside, 0);
    }
}

/// A bar between glass and wall, its left edge nearer, leans so steeply that its depth changes by 0.07 m from pixel to
/// pixel. A ray from the right continues to the wall if it is farther behind the bar's right edge than the tolerance of
/// that slope.
TEST_F(GlassBehindTruth, raysPassBehindTheEdgeOfWhatLeans) {
    constexpr double kIor = 2.4, kLeanRadians = 1.05, kBarMetres = 0.2, kBarZ = -0.3; // half its length
    // Four pixels, twice a step of the bar's depth, and one pixel more.
    const double allowedMetres = (5.0 + 2.0 * std::tan(kLeanRadians)) * kBehindPixelMetres;
    const double bend = std::tan(kBehindTiltRadians - std::asin(std::sin(kBehindTiltRadians) / kIor));
    const Scene wall = rampWall();
    Scene covered = coveredByGlass(wall, bareGlass(kIor), kBehindTiltRadians);
    scenes::Node& bar = addNode(covered, unlit());
    placeQuad(bar, kBarZ, kBarMetres, kLeanRadians);
    bar.parentFromNode[1] *= 4.0 / kBarMetres;
    const double edge = kBarMetres * std::cos(kLeanRadians), farZ = kBarZ - kBarMetres * std::sin(kLeanRadians);
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const std::vector<float> plain = drawn(wall, settings), shown = drawn(covered, settings);
    const int passing = expectPlaces(shown, plain, 0.0, 2e-3, [&](int x, int) -> std::optional<double> {
        const double begin = metresOf(x), beginZ = -begin * std::tan(kBehindTiltRadians);
        const double place = begin - (kBehindWallMetres + beginZ) * bend;
        const double atEdgeZ = beginZ - (begin - edge) / bend; // of the ray
        if (begin < edge || place > -edge - 1.5 * kBehindPixelMetres || atEdgeZ > farZ - allowedMetres) return {};
        return place;
    });
    EXPECT_GE(passing, kBehindPixels);
}

/// A bar between glass and wall that faces the viewer, its edges between pixels. Rays of one column reach the right
/// edge just less or just more than four pixels behind it: the former hit it, the latter continue to the wall.
TEST_F(GlassBehindTruth, raysHitAnEdgeUpToFourPixelsBeforeThem) {
    constexpr double kIor = 2.4, kBarMetres = 5.0 * kBehindPixelMetres; // half its width
    constexpr int kColumn = kBehindPixels / 2 + 5 + 2;
    const double bend = std::tan(kBehindTiltRadians - std::asin(std::sin(kBehindTiltRadians) / kIor));
    const double begin = metresOf(kColumn), beginZ = -begin * std::tan(kBehindTiltRadians);
    const Scene wall = rampWall();
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const std::vector<float> plain = drawn(wall, settings);
    for (const double pixels : {3.98, 4.02}) {
        Scene covered = coveredByGlass(wall, bareGlass(kIor), kBehindTiltRadians);
        scenes::Material bright = unlit();
        bright.emissive = glm::vec3(50.0f);
        scenes::Node& bar = addNode(covered, bright);
        placeQuad(bar, beginZ - (begin - kBarMetres) / bend + pixels * kBehindPixelMetres, kBarMetres);
        bar.parentFromNode[1] *= 4.0 / kBarMetres;
        const std::vector<float> shown = drawn(covered, settings);
        if (pixels > 4.0)
            expectPlaces(shown, plain, 0.0, 2e-3, [&](int x, int) -> std::optional<double> {
                if (x != kColumn) return {};
                return begin - (kBehindWallMetres + beginZ) * bend;
            });
        else
            for (int y = 0; y < kBehindPixels; ++y) ASSERT_GT(at(shown, kColumn, y).r, 2.0) << y;
    }
}

/// A bar between glass and wall whose edge shifts by a pixel every six rows. Rays that run down and to the left reach
/// these steps from the side, far behind: they continue to the wall.
TEST_F(GlassBehindTruth, raysPassBehindTheStepsOfAnEdge) {
    constexpr double kIor = 2.4, kBarMetres = 0.06, kBarZ = -0.3, kLean = 1.0 / 6.0; // half its width
    const glm::dvec2 towards(-std::cos(0.9), -std::sin(0.9)); // a little more down than to the left
    const double bend = std::tan(kBehindTiltRadians - std::asin(std::sin(kBehindTiltRadians) / kIor));
    // Four pixels, and the distance by which a ray recedes over another one.
    const double allowedMetres = (4.0 - 1.0 / (bend * towards.x)) * kBehindPixelMetres;
    const Scene wall = rampWall();
    Scene covered = coveredByGlass(wall, bareGlass(kIor), kBehindTiltRadians);
    glm::dmat4& glass = covered.nodes[1].parentFromNode;
    glass = glm::rotate(glm::dmat4(1.0), 0.9, glm::dvec3(0.0, 0.0, 1.0)) * glass;
    scenes::Node& bar = addNode(covered, unlit());
    placeQuad(bar, kBarZ, kBarMetres);
    bar.parentFromNode[1] = glm::dvec4(4.0 * kLean, 4.0, 0.0, 0.0);
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const std::vector<float> plain = drawn(wall, settings), shown = drawn(covered, settings);
    const int passing = expectPlaces(shown, plain, 0.0, 2e-3, [&](int x, int y) -> std::optional<double> {
        const glm::dvec2 begin(metresOf(x), -metresOf(y));
        const double beginZ = glm::dot(begin, towards) * std::tan(kBehindTiltRadians);
        const double deep = kBehindWallMetres + beginZ;
        const glm::dvec2 place = begin + bend * deep * towards;
        const double from = begin.x - kLean * begin.y, to = place.x - kLean * place.y; // the bar's middle
        const double atEdgeZ = beginZ - deep * (from - kBarMetres) / (from - to);
        const double clear = kBarMetres + 1.5 * kBehindPixelMetres;
        if (from < clear || to > -clear || atEdgeZ > kBarZ - allowedMetres) return {};
        if (std::min(place.x, place.y) < kBehindPixelMetres - 1.0) return {};
        return place.x;
    });
    EXPECT_GE(passing, 8);
}

/// Coarse levels end at the image's edge, within their texels: a uniform wall keeps its colour up to the rim.
TEST_F(GlassBehindTruth, thatIsRoughLosesNoLightAtTheRimOfThePicture) {
    const Scene even = wallScene(uniformImage({200, 100, 50, 255}), 4.0);
    frame::FrameSettings settings = seeing(Refraction::OneSide);
    settings.sizePixels = {53, 47}; // no multiple of any level's texels
    const std::vector<float> plain = drawn(even, settings);
    for (const double roughness : {0.4, 0.7, 1.0}) {
        const std::vector<float> shown = drawn(coveredByGlass(even, bareGlass(1.5, roughness)), settings);
        for (std::size_t i = 0; i < plain.size(); ++i)
            ASSERT_NEAR(shown[i], plain[i], 2e-5f * plain[i]) << roughness << ", " << i;
    }
}

/// A rough body shows the colour of a uniform wall, and widens an edge as the reference does.
TEST_F(GlassBehindTruth, thatIsRoughBlursWhatStandsThere) {
    Scene even = wallScene(uniformImage({200, 100, 50, 255}), 4.0);
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const std::vector<float> plain = drawn(even, settings);
    const std::vector<float> shown = drawn(coveredByGlass(even, bareGlass(1.5, 0.3)), settings);
    for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(shown[i], plain[i], 2e-5f * plain[i]) << i;

    // Black to the left, white to the right.
    const Scene edge = wallScene(image8([](int x, int) {
                                     const int value = x < kSide / 2 ? 0 : 255;
                                     return std::array<int, 4>{value, value, value, 255};
                                 }),
                                 4.0);
    constexpr double kRoughness = 0.7, kIor = 1.5;
    const Scene rough = coveredByGlass(edge, bareGlass(kIor, kRoughness));
    const validation::ReferencePicture truth = strictReference(rough, settings);
    const auto errorOf = [&](const Scene& scene) {
        const std::vector<float> own = drawn(scene, settings);
        double sum = 0.0;
        for (std::size_t i = 0; i < own.size(); i += 4) sum += std::abs(double(own[i]) - double(truth.picture.rgba[i]));
        return sum / double(truth.picture.pixelCount());
    };
    const double blurred = errorOf(rough), sharp = errorOf(coveredByGlass(edge, bareGlass(kIor)));
    fmt::print("behind rough glass: mean error {:.3f}, {:.3f} if it were smooth\n", blurred, sharp);
    EXPECT_LT(blurred, 0.5 * sharp);

    // Of a GGX lobe (1 + s / sqrt(s^2 + alpha^2)) / 2 lies below a slope s of its half vectors along one direction.
    // They turn light by their angle minus that inside. The width spans a quarter to three quarters of the light.
    const double lean = std::atan(kRoughness * kRoughness / std::sqrt(3.0));
    const double wanted = 2.0 * kBehindWallMetres * std::tan(lean - std::asin(std::sin(lean) / kIor));
    const auto widthOf = [&](const std::vector<float>& picture) {
        std::vector<double> columns(kBehindPixels);
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x)
                columns[std::size_t(x)] += at(picture, x, y).r / double(kBehindPixels);
        const auto placeOf = [&](double share) {
            const auto next = std::ranges::find_if(columns, [&](double below) { return below > share; });
            if (next == columns.begin() || next == columns.end()) return std::numeric_limits<double>::quiet_NaN();
            const double rise = (share - *(next - 1)) / (*next - *(next - 1));
            return metresOf(int(next - columns.begin()) - 1) + rise * kBehindPixelMetres;
        };
        return placeOf(0.75) - placeOf(0.25);
    };
    // The means of columns, of 48 x 32 samples, locate each quarter to 2.6 % of the width; the lobe's cosine narrows it
    // by 2 %.
    EXPECT_NEAR(widthOf(truth.picture.rgba), wanted, 0.13 * wanted);
    EXPECT_NEAR(widthOf(drawn(rough, settings)), wanted, 0.25 * wanted) << "squares between two levels";
}

/// A sheet has two sides, like a body whose sides lie a micrometre apart: viewed straight on they match to 1e-5, in the
/// reference too. At a slant a body refracts light once, and a sheet does not: in front of colours that are linear, its
/// blur keeps those straight behind.
TEST_F(GlassBehindTruth, aRoughSheetSpreadsLightAsTwoSidesDoAndBendsNone) {
    Material body = bareGlass(1.5, 0.3), sheet = body;
    body.thicknessMetres = 1e-6f;
    sheet.thicknessMetres = 0.0f;
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const Scene wall = checkedWall(), covered = coveredByGlass(wall, sheet);
    const std::vector<float> plain = drawn(wall, settings), shown = drawn(covered, settings);
    const frame::FrameSettings twoSides = seeing(Refraction::TwoSides);
    const std::vector<float> throughBody = drawn(coveredByGlass(wall, body), twoSides);
    const auto truthOf = [&](const Scene& scene) { return strictRadiance(scene, twoSides); };
    const std::vector<float> truth = truthOf(covered), bodyTruth = truthOf(coveredByGlass(wall, body));
    double blurred = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        ASSERT_NEAR(shown[i], throughBody[i], 1e-5f) << i;
        ASSERT_NEAR(truth[i], bodyTruth[i], 1e-5f) << i;
        blurred += double(std::abs(shown[i] - plain[i])) / double(shown.size());
    }
    EXPECT_GT(blurred, 0.05);

    const Scene ramp = rampWall();
    const std::vector<float> even = drawn(ramp, settings);
    const std::vector<float> slanted = drawn(coveredByGlass(ramp, sheet, kBehindTiltRadians), settings);
    const std::vector<float> bent = drawn(coveredByGlass(ramp, body, kBehindTiltRadians), settings);
    for (int y = 0; y < kBehindPixels; ++y)
        for (int x = kBehindPixels / 4; x < 3 * kBehindPixels / 4; ++x) // the blur ends at the image's edge
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(at(slanted, x, y)[c], at(even, x, y)[c], 2e-3) << "at " << x << ", " << y;
                if (c == 1) continue;
                ASSERT_GT(std::abs(at(bent, x, y)[c] - at(even, x, y)[c]), 0.02) << "at " << x << ", " << y;
            }
}

/// Two panes without refraction and reflection in front of a wall: each multiplies the transmitted light by its colour.
/// The reference with glass behind glass has both, without it only the nearer one, as the renderer has.
TEST_F(GlassBehindTruth, behindGlassIsInTheReferenceAsDeepAsItIsRequested) {
    Material near = bareGlass(1.0), far = bareGlass(1.0);
    near.baseColor = {0.5f, 0.75f, 1.0f, 1.0f};
    far.baseColor = {0.8f, 0.4f, 0.2f, 1.0f};
    Scene scene = coveredByGlass(checkedWall(), far);
    placeQuad(scene.nodes.back(), -1.0, 4.0);
    const std::vector<float> plain = drawn(checkedWall(), seeing(Refraction::OneSide));
    const Scene behindOne = coveredByGlass(std::move(scene), near);
    for (const int depth : {0, 1, 2}) {
        frame::FrameSettings settings = seeing(Refraction::OneSide);
        settings.glassDepth = depth;
        const validation::ReferencePicture truth = strictReference(behindOne, settings);
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double left = double(near.baseColor[c]) * (depth > 0 ? double(far.baseColor[c]) : 1.0);
                    ASSERT_NEAR(at(truth.picture.rgba, x, y)[c], left * at(plain, x, y)[c], 1e-5)
                        << depth << " at " << x << ", " << y;
                }
    }
}

} // namespace
} // namespace tessera
