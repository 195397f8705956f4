// Integrals over area lights, compared with closed forms. A surface of Lambert's model without its 1/pi reflects pi L F
// of a light of radiance L, with the light's configuration factor F.
#include "validation/reference/AreaLights.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenes/AreaLight.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Random.h"
#include "tests/unit/validation/reference/ShiningAreas.h"
#include "validation/reference/Reflectance.h"
#include "validation/reference/SeenArea.h"

namespace tessera::reference {
namespace {

using scenes::LightType;
using scenes::MaterialModel;
using std::numbers::pi;
using test::factorOf;
using test::kCubature;
using test::rectangle;
using test::shiningArea;

SurfacePoint surfaceOf(MaterialModel model, double alpha = 1.0) {
    SurfacePoint point;
    point.model = model;
    point.color = glm::dvec3(1.0);
    point.alpha = point.alphaAcross = alpha;
    point.normal = {0.0, 0.0, 1.0};
    return point;
}

glm::dvec3 viewerAt(double cosine) {
    return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
}

// ---- Configuration factors -----------------------------------------------------------------------------------------

/// Configuration factor of a rectangle of sides a and b for a parallel element at a distance c below its corner.
/// Source: Siegel and Howell 1972, "Thermal Radiation Heat Transfer".
double belowCorner(double a, double b, double c) {
    const double x = a / c, y = b / c, p = std::sqrt(1.0 + x * x), q = std::sqrt(1.0 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2.0 * pi);
}

TEST(ReferenceAreaLights, aRectangleAboveAPointHasItsPublishedFactor) {
    for (const double height : {0.05, 0.5, 2.0, 40.0}) {
        // The point's projection divides the rectangle into four, the smallest of 0.5 m by 0.25 m.
        const ShiningLight light = rectangle({0.5, 0.25, height}, {0, 0, -1}, {1, 0, 0}, 2.0f, 1.0f);
        const double wanted = belowCorner(1.5, 0.75, height) + belowCorner(0.5, 0.75, height) +
                              belowCorner(1.5, 0.25, height) + belowCorner(0.5, 0.25, height);
        EXPECT_NEAR(factorOf(light), wanted, kCubature * wanted) << height;
    }
}

TEST(ReferenceAreaLights, aRectangleAtRightAnglesHasItsPublishedFactor) {
    // Siegel and Howell 1972: a rectangle that stands on the element's plane, with a corner opposite the element; b
    // wide, a high, c away.
    for (const double c : {0.1, 1.0, 7.0}) {
        const double a = 1.5, b = 0.75, x = a / b, y = c / b;
        const double root = std::sqrt(x * x + y * y);
        const double wanted = (std::atan(1.0 / y) - y / root * std::atan(1.0 / root)) / (2.0 * pi);
        const ShiningLight light = rectangle({c, 0.5 * b, 0.5 * a}, {-1, 0, 0}, {0, 1, 0}, float(b), float(a));
        EXPECT_NEAR(factorOf(light), wanted, kCubature * wanted) << c;
        // An equal part below the horizon changes nothing.
        const ShiningLight cut = rectangle({c, 0.5 * b, 0.0}, {-1, 0, 0}, {0, 1, 0}, float(b), float(2.0 * a));
        EXPECT_NEAR(factorOf(cut), wanted, kCubature * wanted) << c;
    }
}

TEST(ReferenceAreaLights, aDiskHasItsPublishedFactor) {
    for (const double height : {0.02, 0.5, 3.0}) {
        const ShiningLight above = shiningArea(LightType::Disk, {0, 0, height});
        const double wanted = 0.25 / (0.25 + height * height);
        EXPECT_NEAR(factorOf(above), wanted, kCubature * wanted) << height;
        // Siegel and Howell 1972: an element parallel to the disk, at a distance of 0.8 from its axis.
        const double h = height / 0.8, r = 0.5 / 0.8, z = 1.0 + h * h + r * r;
        const double beside = 0.5 * (1.0 - (z - 2.0 * r * r) / std::sqrt(z * z - 4.0 * r * r));
        EXPECT_NEAR(factorOf(shiningArea(LightType::Disk, {0.8, 0, height})), beside, kCubature * beside) << height;
    }
}

/// Configuration factor of a sphere that the horizon cuts. Source: Snyder 1996, "Area Light Sources for Real-Time
/// Graphics", as in Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering".
double cutSphere(double radius, double distance, double cosine) {
    const double h = distance / radius, sine = std::sqrt(1.0 - cosine * cosine);
    const double x = std::sqrt(h * h - 1.0), y = -x * cosine / sine, root = std::sqrt(1.0 - y * y);
    return ((cosine * std::acos(y) - x * sine * root) / (h * h) + std::atan(sine * root / x)) / pi;
}

TEST(ReferenceAreaLights, aSphereHasItsPublishedFactorAndTheHorizonCutsIt) {
    for (const double distance : {0.51, 1.0, 3.0, 1e4}) {
        const double whole = 0.25 / (distance * distance);
        EXPECT_NEAR(factorOf(shiningArea(LightType::Sphere, {0, 0, distance})), whole, kCubature * whole) << distance;
        for (const double share : {-0.9, -0.3, 0.0, 0.5, 0.99}) {
            const double cosine = share * 0.5 / distance;
            const ShiningLight light = shiningArea(LightType::Sphere, distance * viewerAt(cosine));
            const double wanted = cutSphere(0.5, distance, cosine);
            EXPECT_NEAR(factorOf(light), wanted, 3.0 * kCubature * wanted) << distance << ' ' << share;
        }
        EXPECT_EQ(factorOf(shiningArea(LightType::Sphere, distance * viewerAt(-0.51 / distance))), 0.0) << distance;
    }
    EXPECT_EQ(factorOf(shiningArea(LightType::Sphere, {0, 0, 0.4})), 0.0) << "it shines outwards alone";
}

/// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors": a cylinder of this length and radius, whose
/// axis is at this distance above the element and ends over it.
double besideCylinder(double length, double radius, double distance) {
    const double l = length / radius, h = distance / radius;
    const double x = (1.0 + h) * (1.0 + h) + l * l, y = (1.0 - h) * (1.0 - h) + l * l;
    const double angle = std::atan(std::sqrt(x * (h - 1.0) / (y * (h + 1.0))));
    return std::atan(l / std::sqrt(h * h - 1.0)) / (pi * h) +
           l / pi * ((x - 2.0 * h) / (h * std::sqrt(x * y)) * angle - std::atan(std::sqrt((h - 1.0) / (h + 1.0))) / h);
}

TEST(ReferenceAreaLights, aTubeHasThePublishedFactorOfACylinderAndShinesFromItsEnds) {
    for (const double distance : {0.505, 0.8, 4.0}) {
        ShiningLight light = shiningArea(LightType::Tube, {0, 0, distance}, {1, 0, 0});
        light.light.lengthMetres = 3.0f;
        const double wanted = 2.0 * besideCylinder(1.5, 0.5, distance);
        EXPECT_NEAR(factorOf(light), wanted, kCubature * wanted) << distance;
    }
    // Upright, only its lower end is visible.
    ShiningLight light = shiningArea(LightType::Tube, {0, 0, 2.5}, {0, 0, 1});
    light.light.lengthMetres = 3.0f;
    EXPECT_NEAR(factorOf(light), 0.2, kCubature * 0.2);
}

TEST(ReferenceAreaLights, aHollowedPolygonGivesTheSumOfItsParts) {
    test::Random random(4);
    const auto withCorners = [](std::initializer_list<glm::vec2> places) {
        scenes::LightCorners corners;
        corners.count = 0;
        for (const glm::vec2& place : places) corners.add(place);
        return corners;
    };
    // A bridge, which is a square of 2 m with a notch; its parts are two legs and the bar between.
    const scenes::LightCorners whole =
        withCorners({{-1, -1}, {-0.5f, -1}, {-0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, -1}, {1, -1}, {1, 1}, {-1, 1}});
    const std::pair<glm::dvec2, glm::dvec2> parts[] = {// centre and sides
                                                       {{-0.75, -0.25}, {0.5, 1.5}},
                                                       {{0.75, -0.25}, {0.5, 1.5}},
                                                       {{0.0, 0.75}, {2.0, 0.5}}};
    for (int i = 0; i < 50; ++i) {
        ShiningLight light = shiningArea(LightType::Polygon, {}, random.direction());
        light.light.alongWS = random.around(light.light.directionWS, 0.0, 0.0);
        light.light.isTwoSided = true;
        light.light.corners = whole;
        std::rotate(light.light.corners.metres.begin(), light.light.corners.metres.begin() + i % 8,
                    light.light.corners.metres.end());
        if (i % 2 == 1) std::ranges::reverse(light.light.corners.metres);
        light.positionRWS = random.around({0, 0, 1}, 0.3, 1.0) * random.between(1.5, 4.0);
        double sum = 0.0;
        for (const auto& [middle, sides] : parts) {
            ShiningLight part = light;
            part.light.type = LightType::Rectangle;
            part.light.widthMetres = float(sides.x);
            part.light.heightMetres = float(sides.y);
            part.positionRWS +=
                middle.x * light.light.alongWS + middle.y * glm::cross(light.light.directionWS, light.light.alongWS);
            sum += factorOf(part);
        }
        EXPECT_NEAR(factorOf(light), sum, 1e-4 * sum + 1e-9) << i; // the horizon cuts some
    }
}

TEST(ReferenceAreaLights, farAwayEveryLightGivesItsProjectedArea) {
    test::Random random(3);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 direction = random.direction();
        ShiningLight light = shiningArea(LightType(int(LightType::Rectangle) + i % 5), {0, 0, 0}, direction);
        light.light.alongWS = random.around(direction, 0.0, 0.0);
        light.light.isTwoSided = true;
        light.light.lengthMetres = 2.0f;
        light.positionRWS = 1e4 * random.around({0, 0, 1}, 0.1, 1.0);
        const Incident small = incidentAt(light, glm::dvec3(0.0));
        const double wanted = small.irradiance.g * small.toLight.z / pi;
        // Its ends are up to 1e-4 of the distance nearer or farther than its centre. Directions to them differ as much,
        // which matters where it is viewed nearly edge-on.
        const double most = 4.0 / (1e8 * pi);
        EXPECT_NEAR(factorOf(light), wanted, 4e-4 * most) << i;
    }
}

TEST(ReferenceAreaLights, flatLightsShineForwardUnlessTheyHaveTwoSides) {
    for (const LightType type : test::kFlatTypes) {
        ShiningLight light = shiningArea(type, {0.3, 0.2, 1.0}, {0, 0, -1});
        const double front = factorOf(light);
        EXPECT_GT(front, 0.1);
        light.light.directionWS = {0, 0, 1};
        EXPECT_EQ(factorOf(light), 0.0);
        EXPECT_EQ(incidentAt(light, glm::dvec3(0.0)).irradiance, glm::dvec3(0.0));
        light.light.isTwoSided = true;
        // A rectangle and a disk keep their squares. Reversing mirrors a polygon's outline, so its triangles have the
        // other diagonal. The integrator guarantees Settings::areaTolerance alone; where no lobe and no horizon cuts a
        // light, its rule of seven points per side errs by 1e-11 of the integral for any triangles.
        EXPECT_NEAR(factorOf(light), front, 1e-10 * front);
        EXPECT_GT(incidentAt(light, glm::dvec3(0.0)).irradiance.g, 0.0);
        light.positionRWS = {0.3, 0.2, 0.0}; // above the horizon is a lune of the directions before it
        EXPECT_NEAR(factorOf(light, {0.6, 0.0, 0.8}), 0.5 * (1.0 - 0.8), 1e-6);
        light.positionRWS.x = 3.0;
        EXPECT_EQ(factorOf(light, {0.6, 0.0, 0.8}), 0.0) << "edge-on nothing is seen from beside it";
    }
}

// ---- Lobes ---------------------------------------------------------------------------------------------------------

SurfacePoint whiteMetal(double alpha) {
    SurfacePoint point = surfaceOf(MaterialModel::MetallicRoughness, alpha);
    point.metallic = 1.0;
    return point;
}

double shownBy(const SurfacePoint& point, const ShiningLight& light, const glm::dvec3& toViewer) {
    return reflectedOf(light, point, glm::dvec3(0.0), toViewer, true, false, Settings()).light.g;
}

TEST(ReferenceAreaLights, aMirrorShowsALightsRadianceInsideItsOutlineAndNothingOutside) {
    const SurfacePoint mirror = whiteMetal(1e-3);
    const glm::dvec3 toViewer = viewerAt(0.8);
    const glm::dvec3 reflection(-toViewer.x, -toViewer.y, toViewer.z);
    const glm::dvec3 aside = glm::normalize(glm::cross(reflection, {0, 1, 0}));
    for (const LightType type : test::kAreaTypes) {
        ShiningLight light = shiningArea(type, 2.0 * reflection, -reflection);
        light.light.alongWS = aside;
        light.light.lengthMetres = 1.0f;
        // The fraction 1 - 1/(1 + (t/alpha)^2) of a peak's light is within half vectors of slope t. Here t is at least
        // 0.1, so all but 1e-4 is. Masking takes the rest, alpha^2 / 4.
        for (const double offset : {0.0, 0.15, -0.25}) {
            light.positionRWS = 2.0 * reflection + offset * aside;
            EXPECT_NEAR(shownBy(mirror, light, toViewer), 1.0, 3e-4) << scenes::infoOf(type).name << ' ' << offset;
        }
        light.positionRWS = 2.0 * reflection + 1.0 * aside;
        const double outside = shownBy(mirror, light, toViewer);
        EXPECT_GT(outside, 0.0) << scenes::infoOf(type).name;
        EXPECT_LT(outside, 1e-4) << scenes::infoOf(type).name;
    }
}

TEST(ReferenceAreaLights, highlightsAreFoundInLargeLightsHoweverSmallTheyAre) {
    // A light that spans thousands of highlight widths, with highlights far from its centre.
    const ShiningLight light = rectangle({2.9, 1.7, 1.0}, {0, 0, -1}, {1, 0, 0}, 20.0f, 14.0f);
    SurfacePoint coated = whiteMetal(1.0);
    coated.coatNormal = coated.normal;
    coated.coatAlpha = 1e-3;
    const double bare = shownBy(coated, light, viewerAt(0.8));
    coated.coat = 1.0;
    const double weight = 0.04 + 0.96 * std::pow(0.2, 5);
    EXPECT_NEAR(shownBy(coated, light, viewerAt(0.8)), (1.0 - weight) * bare + weight, 5e-5);
    // The integral of (n.h)^p over all l with the viewer along n, where dl = 4 n.h dh; the light covers all of it.
    SurfacePoint shiny = surfaceOf(MaterialModel::BlinnPhong);
    for (const double exponent : {1e2, 1e4, 1e6}) {
        shiny.roughness = exponent;
        shiny.color = glm::dvec3(1.0);
        const double ground = pi * factorOf(light), peak = 8.0 * pi / (exponent + 2.0);
        EXPECT_NEAR(shownBy(shiny, light, {0, 0, 1}) - ground, peak, 1e-4 * peak + 2.0 * kCubature) << exponent;
        shiny.color = glm::dvec3(0.0);
        EXPECT_NEAR(shownBy(shiny, light, {0, 0, 1}), peak, 1e-4 * peak) << exponent;
    }
}

/// Six rectangles that close a box around the origin, which is off its centre.
std::vector<ShiningLight> boxOfLights() {
    std::vector<ShiningLight> sides;
    const glm::dvec3 least(-0.7, -1.3, -0.4), most(0.9, 0.6, 1.1), middle = 0.5 * (least + most);
    for (int axis = 0; axis < 3; ++axis) {
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 place = middle, inwards(0.0), along(0.0);
            place[axis] = sign < 0.0 ? least[axis] : most[axis];
            inwards[axis] = -sign;
            along[x] = 1.0;
            sides.push_back(rectangle(place, inwards, along, float(most[x] - least[x]), float(most[y] - least[y])));
        }
    }
    return sides;
}

TEST(ReferenceAreaLights, aBoxOfLightsIsAnEvenEnvironment) {
    const std::vector<ShiningLight> box = boxOfLights();
    const auto shown = [&](const SurfacePoint& point, double cosine) {
        double sum = 0.0;
        for (const ShiningLight& side : box) sum += shownBy(point, side, viewerAt(cosine));
        return sum;
    };
    // Corners of the box are rounded to fp32, 6e-8, so its seams have gaps or overlaps of that size.
    EXPECT_NEAR(shown(surfaceOf(MaterialModel::Lambert), 0.5), pi, 1e-5);
    // The published table of height-correlated masking, to its printed digits.
    EXPECT_NEAR(shown(whiteMetal(0.05), 0.1), 0.9113, 2e-4);
    EXPECT_NEAR(shown(whiteMetal(0.25), 0.25), 0.8401, 2e-4);
    EXPECT_NEAR(shown(whiteMetal(0.5), 0.5), 0.6982, 2e-4);
    EXPECT_NEAR(shown(whiteMetal(0.1), 0.75), 0.9831, 2e-4);
    for (const double cosine : {0.1, 0.4, 1.0})
        EXPECT_NEAR(shown(whiteMetal(1.0), cosine), 1.0 - cosine * std::log(1.0 + 1.0 / cosine), 1e-5) << cosine;
}

TEST(ReferenceAreaLights, theRangesWindowIsThatOfTheDistanceToTheMiddle) {
    ShiningLight light = shiningArea(LightType::Tube, {0.0, 0.6, 0.8}, {0, 0, 1});
    light.light.lengthMetres = 0.4f;
    const double open = factorOf(light);
    light.rangeMetres = 2.0;
    EXPECT_NEAR(factorOf(light), open * std::pow(1.0 - 1.0 / 16.0, 2), 1e-12);
    light.rangeMetres = 1.0;
    EXPECT_EQ(factorOf(light), 0.0);
    EXPECT_EQ(shownBy(whiteMetal(0.5), light, viewerAt(0.6)), 0.0);
}

// ---- Against Monte Carlo integration -------------------------------------------------------------------------------

ShiningLight randomArea(test::Random& random, LightType type, const glm::dvec3& towards) {
    ShiningLight light = shiningArea(type, {}, random.direction());
    light.light.alongWS = random.around(light.light.directionWS, 0.0, 0.0);
    light.light.radiusMetres = float(random.logarithmic(0.02, 1.5));
    light.light.widthMetres = float(random.logarithmic(0.02, 3.0));
    light.light.heightMetres = float(random.logarithmic(0.02, 3.0));
    light.light.lengthMetres = float(random.logarithmic(0.02, 3.0));
    light.light.corners.metres[2] = {-0.2f, 0.0f}; // a reflex corner
    for (glm::vec2& corner : light.light.corners.metres)
        corner *= glm::vec2(light.light.widthMetres, light.light.heightMetres);
    light.light.isTwoSided = true;
    light.positionRWS =
        random.logarithmic(0.2, 3.0) * glm::normalize(towards + random.between(0.0, 1.5) * random.direction());
    return light;
}

/// A random surface of a model, with alphas from 1 to 0.02, layers and wrapped light.
SurfacePoint randomSurface(test::Random& random, MaterialModel model) {
    SurfacePoint point = surfaceOf(model, random.logarithmic(0.02, 1.0));
    point.color = {random.unit(), random.unit(), random.unit()};
    point.metallic = random.unit();
    point.roughness = model == MaterialModel::BlinnPhong ? 2.0 / (point.alpha * point.alpha) : point.alpha;
    if (model == MaterialModel::MicrofacetAnisotropic) {
        point.tangent = {0.6, 0.8, 0.0};
        point.alphaAcross = std::min(1.0, random.logarithmic(1.0, 5.0) * point.alpha);
    }
    if (model == MaterialModel::MetallicRoughness && random.unit() < 0.5) {
        point.coat = random.unit();
        point.coatAlpha = random.logarithmic(0.02, 1.0);
        point.coatNormal = random.around(point.normal, 0.9, 1.0);
        point.sheenColor = {random.unit(), random.unit(), random.unit()};
        point.sheenAlpha = random.logarithmic(0.05, 1.0);
    }
    if (random.unit() < 0.25) point.wrap = {0.5, 0.2, 0.1};
    return point;
}

TEST(ReferenceAreaLights, everyModelAndTypeAgreesWithMonteCarloIntegration) {
    test::Random random(11);
    double squares = 0.0, squaresReported = 0.0;
    int seen = 0;
    for (int i = 0; i < 240; ++i) {
        const SurfacePoint point = randomSurface(random, MaterialModel(1 + i % 5));
        const glm::dvec3 toViewer = random.around(point.normal, 0.05, 1.0);
        const ShiningLight light = randomArea(random, LightType(int(LightType::Rectangle) + (i / 5) % 5),
                                              {-toViewer.x, -toViewer.y, toViewer.z});
        const bool onlyLobes = i % 7 == 0;
        const SeenArea area(light, glm::dvec3(0.0));
        const auto ofSurface = strategiesOf(point, toViewer, true);
        std::vector<const Strategy*> strategies{&area};
        for (const auto& strategy : ofSurface) strategies.push_back(strategy.get());
        const Estimate wanted = sampled(strategies, 4096, std::uint32_t(i), [&](const glm::dvec3& direction) {
            if (!(area.density(direction) > 0.0)) return glm::dvec3(0.0);
            const glm::dvec3 all = reflected(point, direction, toViewer, true);
            return onlyLobes ? all - reflected(point, direction, toViewer, false) : all;
        });
        const Settings settings;
        const Estimate found = reflectedOf(light, point, glm::dvec3(0.0), toViewer, true, onlyLobes, settings);
        Settings finer;
        finer.areaTolerance = 1e-7;
        finer.areaSquares = 1 << 16;
        const Estimate fine =
            i % 6 == 0 ? reflectedOf(light, point, glm::dvec3(0.0), toViewer, true, onlyLobes, finer) : found;
        for (int c = 0; c < 3; ++c) {
            // Eight parts estimate a standard error to a quarter: five errors are often exceeded, nine hardly ever.
            ASSERT_NEAR(found.light[c], wanted.light[c],
                        9.0 * std::sqrt(wanted.variance[c]) + 1e-4 * wanted.light[c] + 1e-9)
                << i << ' ' << c;
        }
        if (i % 6 != 0 || !(fine.light.g > 1e-6)) continue;
        const double error = (found.light.g - fine.light.g) / fine.light.g;
        ASSERT_LE(std::abs(error), 2e-4) << i;
        squares += error * error;
        squaresReported += found.variance.g / (fine.light.g * fine.light.g);
        ++seen;
    }
    EXPECT_GT(seen, 25);
    // A tenth of the limit for images of rough metals, relMse 1e-6, and no more than the reported variance.
    EXPECT_LE(squares / seen, 1e-7);
    EXPECT_LE(squares, squaresReported);
}

} // namespace
} // namespace tessera::reference
