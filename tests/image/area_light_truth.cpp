// Area lights against known answers and the integral over a light.
#include <numbers>

#include <glm/ext/matrix_transform.hpp>

#include "tests/image/AreaLightTest.h"
#include "tests/support/RoughestLobe.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using std::numbers::pi;
using namespace test;

class AreaLightTruth : public MiddleOfQuadTest {};

/// Irradiance does not depend on the viewer. Nearly along a normal that is no axis, the viewer's projection has hardly
/// any digits: the normal's rounding residue in it would shear the frame of integration.
TEST_F(AreaLightTruth, aMatteSurfaceIsLitAlikeFromStraightAboveAndAside) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)));
    const auto turned = [&](const glm::dvec3& direction) { return glm::dmat3(turn) * direction; };
    scenes::Scene scene = quadScene(matte());
    scene.nodes[0].parentFromNode = turn;
    scene.lights = {areaLight(LightType::Rectangle, turned({0.4, 0.3, 0.5}), turned({0.0, 0.0, -1.0}), 1.0f)};
    scene.lights[0].isSeen = false;
    scenes::Camera& camera = scene.cameras[0];
    makeOrthographic(camera, 1e-4);
    engine::Renderer renderer(context(), scene);
    const auto shown = [&](double angle, double azimuth) {
        const glm::dvec3 toViewer(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                                  std::cos(angle));
        camera.worldFromCamera = scenes::worldFromLookAt(turned(3.0 * toViewer), glm::dvec3(0.0));
        return double(renderer.render(Technique::Forward, ofSize(3, 3)).radiance[4 * 4]);
    };
    const double aside = shown(0.5, 0.0);
    EXPECT_GT(aside, 0.1);
    for (const double angle : {1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 3e-6})
        for (const double azimuth : {0.0, 1.0, 2.5})
            EXPECT_NEAR(shown(angle, azimuth) / aside, 1.0, 2e-4) << angle << ", " << azimuth;
}

// Factors from a point to areas: Howell, "A Catalog of Radiation Heat Transfer Configuration Factors".
TEST_F(AreaLightTruth, matteSurfacesAreLitAsTheClosedFormsSay) {
    constexpr double kRelative = 1e-4; // for round outlines; straight ones are within 2e-6
    // A parallel rectangle a x b above one of its corners (B-4), four times.
    for (const double height : {0.05, 0.5, 2.0, 50.0}) {
        scenes::Light light = areaLight(LightType::Rectangle, {0.0, 0.0, height}, {0.0, 0.0, -1.0}, 1.0f);
        light.widthMetres = 2.0f;
        light.heightMetres = 1.0f;
        const double x = 1.0 / height, y = 0.5 / height;
        const double corner = (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
                               y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
                              (2.0 * pi);
        EXPECT_NEAR(seen(matte(), {light}) / (4.0 * pi * corner), 1.0, kRelative) << "rectangle at " << height;
    }
    // A perpendicular rectangle that stands on the surface's plane, viewed from in front of the middle of its edge
    // (B-3, twice). Lowered by half its height, half of it is below the horizon.
    for (const double distance : {0.1, 0.5, 3.0})
        for (const double down : {0.0, 1.0}) {
            scenes::Light light = areaLight(LightType::Rectangle, {0.0, distance, 1.0 - down}, {0.0, -1.0, 0.0}, 1.0f);
            light.widthMetres = 2.0f;
            light.heightMetres = 2.0f;
            const double high = 2.0 - down, x = 1.0 / distance, y = high / distance;
            const double half =
                (std::atan(x) - std::atan(x / std::sqrt(1 + y * y)) / std::sqrt(1 + y * y)) / (2.0 * pi);
            EXPECT_NEAR(seen(matte(), {light}) / (2.0 * pi * half), 1.0, kRelative)
                << "standing rectangle at " << distance << ", let down by " << down;
        }
    // A parallel disk above the point (B-13).
    for (const double height : {0.03, 0.3, 3.0, 300.0}) {
        const scenes::Light light = areaLight(LightType::Disk, {0.0, 0.0, height}, {0.0, 0.0, -1.0}, 1.0f);
        const double factor = 0.09 / (0.09 + height * height);
        EXPECT_NEAR(seen(matte(), {light}) / (pi * factor), 1.0, kRelative) << "disk at " << height;
    }
    // A sphere entirely above the horizon: (r/d)^2 cos (B-37).
    for (const double angle : {0.0, 0.5, 1.0})
        for (const double distance : {0.7, 5.0, 400.0}) {
            const scenes::Light light =
                areaLight(LightType::Sphere, distance * glm::dvec3(std::sin(angle), 0.0, std::cos(angle)),
                          {0.0, 0.0, -1.0}, 1.0f);
            const double factor = 0.09 / (distance * distance) * std::cos(angle);
            EXPECT_NEAR(seen(matte(), {light}) / (pi * factor), 1.0, kRelative)
                << "sphere at " << distance << ", " << angle;
        }
    // An endless tube above the surface: r/h, as for a strip of its width.
    scenes::Light tube = areaLight(LightType::Tube, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, 1.0f);
    tube.lengthMetres = 2e4f;
    EXPECT_NEAR(seen(matte(), {tube}) / (pi * 0.3), 1.0, 2e-3) << "tube";
}

/// Half the sum over the edges of the angle that an edge subtends times the height of the unit normal of its plane
/// (Lambert 1760).
TEST_F(AreaLightTruth, aPolygonLightsAMatteSurfaceAsLambertSays) {
    const scenes::LightCorners outlines[] = {
        cornersOf({{-0.4f, -0.3f}, {0.7f, 0.0f}, {0.1f, 0.6f}}),
        cornersOf({{0, 0}, {1, -0.5f}, {0.5f, 0}, {1, 0.5f}, {0, 0.3f}}), // concave
        cornersOf({{0, 0.5f},
                   {0.4f, 0.4f},
                   {0.6f, 0},
                   {0.4f, -0.3f},
                   {0, -0.5f},
                   {-0.4f, -0.4f},
                   {-0.5f, 0},
                   {-0.3f, 0.3f}})};
    for (const scenes::LightCorners& corners : outlines)
        for (const glm::dvec3& at :
             {glm::dvec3(0.2, 0.1, 1.0), glm::dvec3(-1.0, 0.5, 1.2), glm::dvec3(0.0, 0.0, 40.0)}) {
            scenes::Light light = areaLight(LightType::Polygon, at, -at - glm::dvec3(0.0, 0.2, 0.4), 1.0f);
            light.corners = corners;
            double sum = 0.0;
            const glm::dvec3 acrossWS = glm::cross(light.directionWS, light.alongWS);
            const auto cornerWS = [&](std::size_t i) {
                const glm::dvec2 corner(corners.metres[i % corners.count]);
                return glm::normalize(at + corner.x * light.alongWS + corner.y * acrossWS);
            };
            for (std::size_t i = 0; i < corners.count; ++i) {
                const glm::dvec3 normal = glm::cross(cornerWS(i), cornerWS(i + 1));
                sum += std::asin(glm::length(normal)) * glm::normalize(normal).z; // below a right angle
            }
            EXPECT_NEAR(seen(matte(), {light}) / (0.5 * std::abs(sum)), 1.0, 1e-4) // edges of small ones cancel
                << corners.count << " corners at " << at.z;
        }
}

TEST_F(AreaLightTruth, aSquarePolygonIsTheRectangleOfItsSides) {
    for (const double roughness : {0.2, 0.6})
        for (const glm::dvec3& at :
             {glm::dvec3(-0.5, 0.1, 1.0), glm::dvec3(0.6, 0.0, 0.2), glm::dvec3(-1.0, 2.0, 9.0)}) {
            const scenes::Material metal = twoSidedMetal(0.5, roughness);
            scenes::Light rectangle = areaLight(LightType::Rectangle, at, -at, 1.0f), polygon = rectangle;
            polygon.type = LightType::Polygon;
            rectangle.widthMetres = 1.5f;
            for (glm::vec2& corner : polygon.corners.metres) corner.x *= 1.5f;
            const double wanted = seen(metal, {rectangle}, {0.5, 0.0, 1.0});
            EXPECT_GT(wanted, 1e-4);
            EXPECT_NEAR(seen(metal, {polygon}, {0.5, 0.0, 1.0}) / wanted, 1.0, 1e-4) << roughness << ", " << at.z;
            std::reverse(polygon.corners.metres.begin(), polygon.corners.metres.begin() + 4);
            EXPECT_NEAR(seen(metal, {polygon}, {0.5, 0.0, 1.0}) / wanted, 1.0, 1e-4) << "the other way round";
        }
}

TEST_F(AreaLightTruth, flatLightsShineFromTheirFrontAndWhereTheyAreTwoSidedFromTheBack) {
    for (const LightType type : kFlatTypes) {
        scenes::Light light = areaLight(type, {0.1, 0.2, 1.0}, {0.0, 0.0, 1.0}, 1.0f);
        EXPECT_EQ(seen(matte(), {light}), 0.0);
        light.isTwoSided = true;
        scenes::Light front = light;
        front.directionWS = -light.directionWS;
        front.isTwoSided = false;
        EXPECT_NEAR(seen(matte(), {light}), seen(matte(), {front}), 1e-6);
    }
}

TEST_F(AreaLightTruth, aLightThatSetsWithNothingInItsWayLosesNothingToShadows) {
    for (const LightType type : {LightType::Sphere, LightType::Tube, LightType::Disk})
        for (const double height : {0.2, 0.0, -0.2}) {
            scenes::Light light = areaLight(type, {0.9, 0.0, height}, {-1.0, 0.0, 0.0}, 3.0f);
            const double open = seen(matte(), {light});
            EXPECT_GT(open, 1e-3);
            light.castsShadow = true;
            EXPECT_NEAR(seen(matte(), {light}), open, 1e-6 * open) << scenes::infoOf(type).name << " at " << height;
        }
}

/// The six walls of a 4 m box around the origin.
std::vector<scenes::Light> wallsOfBox() {
    std::vector<scenes::Light> walls;
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double side : {-1.0, 1.0}) {
            scenes::Light wall = areaLight(LightType::Rectangle, side * 2.0 * axis, -side * axis, 1.0f);
            wall.widthMetres = wall.heightMetres = 4.0f;
            walls.push_back(wall);
        }
    return walls;
}

/// A white furnace: six walls give uniform radiance, so each lobe reflects its directional albedo.
TEST_F(AreaLightTruth, aBoxOfRectanglesIsAWhiteFurnace) {
    const std::vector<scenes::Light> walls = wallsOfBox();
    EXPECT_NEAR(seen(matte(), walls), pi, 2e-5);
    // E(mu, alpha) of a height-correlated GGX lobe with F = 1, shading.md section 6, accurate to 2e-4.
    constexpr double kCosines[] = {0.1, 0.5, 1.0}, kAlphas[] = {0.05, 0.25, 1.0};
    constexpr double kReflected[3][3] = {{.9113, .9927, .9973}, {.8916, .8572, .9158}, {.7602, .4507, .3069}};
    for (int a = 0; a < 3; ++a)
        for (int m = 0; m < 3; ++m) {
            const scenes::Material white = twoSidedMetal(1.0, std::sqrt(kAlphas[a]));
            EXPECT_NEAR(seen(white, walls, atCosine(kCosines[m])), kReflected[a][m], 1e-3)
                << "alpha " << kAlphas[a] << ", cosine " << kCosines[m];
        }
}

/// In the box, coats and sheens receive uniform light. Their reflection of a uniform environment is tested against the
/// reference (EnvironmentTruth).
TEST_F(AreaLightTruth, aBoxOfRectanglesLightsCoatsAndSheensAsAnEvenEnvironmentDoes) {
    const std::vector<scenes::Light> walls = wallsOfBox();
    for (const scenes::Material& material : {coatedSheet(), velvet()})
        for (const double cosView : {0.1, 0.5, 1.0}) {
            const double even = seen(material, {}, atCosine(cosView), evenEnvironment(1.0));
            EXPECT_GT(even, 0.1) << material.name;
            // Six lobe integrals in single precision, and edges that cancel where walls meet.
            EXPECT_NEAR(seen(material, walls, atCosine(cosView)), even, 1e-3)
                << material.name << ", cosine " << cosView;
        }
}

/// The same for anisotropic lobes: their stretched shape still fills the hemisphere above the surface.
TEST_F(AreaLightTruth, aBoxOfRectanglesLightsBrushedMetalAsAnEvenEnvironmentDoes) {
    scenes::Material brushed = twoSidedMetal(1.0, 0.5);
    brushed.anisotropyStrength = 0.8f;
    brushed.anisotropyRotationRadians = 0.6f;
    for (const double cosView : {0.15, 0.5, 1.0}) {
        const double even = seen(brushed, {}, atCosine(cosView), evenEnvironment(1.0));
        EXPECT_NEAR(seen(brushed, wallsOfBox(), atCosine(cosView)), even, 1e-3) << cosView;
    }
}

/// Spheres of radius 0.3 m against the closed form of the roughest lobe. Its shape is a linearly transformed cosine,
/// which may err by half of the distance in docs/area-lights.md; a plain cosine errs three to six times as much.
TEST_F(AreaLightTruth, aSphereFillsOfTheRoughestLobeWhatItsClosedFormSays) {
    const scenes::Material metal = twoSidedMetal(1.0, 1.0);
    for (const auto& [degrees, distanceOfShapes] : {std::pair(0.0, 0.030), {60.0, 0.052}, {80.0, 0.100}}) {
        const double angle = degrees * pi / 180.0, cosView = std::cos(angle), albedo = roughestAlbedo(cosView);
        double worst = 0.0, worstOfCosine = 0.0;
        for (const auto& [axis, halfAngle] :
             {std::pair(0.0, 0.1), {0.0, 0.3}, {0.0, 0.6}, {0.0, 1.0}, {0.0, 1.3}, {1.0, 0.2}, {1.0, 0.5}})
            for (const double turn : {0.0, 0.5 * pi, pi}) {
                const glm::dvec3 towards(std::sin(axis) * std::cos(turn), std::sin(axis) * std::sin(turn),
                                         std::cos(axis));
                const scenes::Light sphere =
                    areaLight(LightType::Sphere, 0.3 / std::sin(halfAngle) * towards, {0.0, 0.0, -1.0}, 1.0f);
                const double truth = roughestShareOfCap(cosView, axis, halfAngle);
                const double shown = seen(metal, {sphere}, {std::sin(angle), 0.0, cosView});
                // The albedo table is accurate to 1e-3.
                EXPECT_NEAR(shown, truth, 0.5 * distanceOfShapes * albedo + 1e-3 * truth)
                    << degrees << " degrees, " << halfAngle << " around " << axis << ", turned by " << turn;
                const double cosine = albedo * std::pow(std::sin(halfAngle), 2) * std::cos(axis);
                worst = std::max(worst, std::abs(shown - truth) / albedo);
                worstOfCosine = std::max(worstOfCosine, std::abs(cosine - truth) / albedo);
            }
        fmt::print("{} degrees: off by up to {:.4f} of the albedo, a cosine by {:.4f}\n", degrees, worst,
                   worstOfCosine);
        EXPECT_LT(2.0 * worst, worstOfCosine) << degrees;
    }
}

/// A flat light fills half of the hemisphere of a point in its plane, within its outline, and nothing beside it: the
/// limit of points on either side of the plane. The reference treats it as filling the hemisphere before the plane.
TEST_F(AreaLightTruth, aTwoSidedLightThatStandsThroughASurfaceFillsHalfOfWhatItsFootSees) {
    for (const LightType type : kFlatTypes)
        for (const double aside : {0.0, 3.0}) {
            SCOPED_TRACE(testing::Message() << scenes::infoOf(type).name << ", " << aside << " m aside");
            scenes::Light light = areaLight(type, {0.0, aside, 0.0}, {1.0, 0.0, 0.0}, 1.0f);
            light.isTwoSided = true;
            const double wanted = aside == 0.0 ? 0.5 * pi : 0.0;
            EXPECT_NEAR(seen(matte(), {light}), wanted, 1e-5);
            scenes::Light before = light;
            before.positionWS.x = -1e-5; // it shines towards +x
            EXPECT_NEAR(seen(matte(), {before}), wanted, 1e-3);
            light.isTwoSided = false;
            EXPECT_EQ(seen(matte(), {light}), 0.0) << "its plane belongs to its back";

            scenes::Scene scene = quadScene(matte());
            light.isTwoSided = true;
            light.isSeen = false;
            scene.lights = {light};
            makeOrthographic(scene.cameras[0], 1e-4);
            EXPECT_NEAR(double(validation::referencePicture(scene, ofSize(3, 3)).picture.rgba[4 * 4]), wanted, 1e-4);
        }
}

/// A material with wrap lighting, also lit from behind its surface.
TEST_F(AreaLightTruth, aSmallLightWrapsAsAPointLightDoes) {
    scenes::Material body = matte();
    body.subsurface.method = scenes::SubsurfaceMethod::Wrap;
    body.subsurface.wrap = 0.8f;
    body.subsurface.bodyRadiusMetres = 1.0f;
    const auto ratioAt = [&](double cosine) {
        const glm::dvec3 positionWS = 2.0 * atCosine(cosine);
        scenes::Light small = areaLight(LightType::Sphere, positionWS, -positionWS, 1000.0f);
        small.radiusMetres = 0.01f;
        const double ofPoint = seen(body, {pointLight(positionWS, 1.0f)});
        EXPECT_GT(ofPoint, 0.0);
        return seen(body, {small}) / ofPoint;
    };
    EXPECT_NEAR(ratioAt(-0.3) / ratioAt(0.5), 1.0, 1e-3);
}

/// A range applies the window (1 - (d / range)^4)^2 of the distance to the centre, as for point lights.
TEST_F(AreaLightTruth, aRangeDimsALightByTheWindowOfItsDistance) {
    for (const LightType type : kAreaTypes)
        for (const double share : {0.3, 0.7, 0.95, 1.0}) {
            scenes::Light light = areaLight(type, {0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}, 1.0f);
            const double whole = seen(matte(), {light});
            light.rangeMetres = float(2.0 / share);
            const double window = 1.0 - std::pow(share, 4.0);
            EXPECT_NEAR(seen(matte(), {light}), window * window * whole, 1e-5 * whole)
                << scenes::infoOf(type).name << ", at " << share << " of its range";
        }
}

/// Just above the size below which outlines count as points, at grazing angles: (r/d)^2 cos.
TEST_F(AreaLightTruth, smallOutlinesKeepTheirDigitsAtGrazingAngles) {
    for (const double cosine : {0.1, 0.3, 0.7})
        for (const double share : {2.1e-3, 1e-2}) {
            const double distance = 0.3 / share;
            const glm::dvec3 at = distance * glm::dvec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
            const double factor = share * share * cosine;
            EXPECT_NEAR(seen(matte(), {areaLight(LightType::Sphere, at, -at, 1.0f)}) / (pi * factor), 1.0, 1e-3)
                << cosine << ", " << share;
        }
}

/// Compensation for multiple scattering between microfacets applies to environment light only.
TEST_F(AreaLightTruth, lightsAreNotCompensated) {
    scenes::Scene scene = quadScene(twoSidedMetal(1.0, 1.0));
    scene.lights = {areaLight(LightType::Disk, {0.3, 0.2, 1.5}, {0.0, 0.0, -1.0}, 3.0f)};
    scene.environment = evenEnvironment(0.0);
    frame::FrameSettings settings = ofSize(16, 9);
    engine::Renderer renderer(context(), scene);
    const std::vector<float> plain = renderer.render(Technique::Deferred, settings).radiance;
    settings.environment.compensates = true;
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, plain);
}

/// A mirror shows a light fully or not at all, wherever its outline is.
TEST_F(AreaLightTruth, aMirrorSeesTheShapeOfALight) {
    const scenes::Material mirror = twoSidedMetal(1.0, 0.0);
    for (const LightType type : kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        const scenes::Light light = areaLight(type, {-1.0, 0.0, 1.0}, {1.0, 0.0, -1.0}, 2.0f);
        EXPECT_NEAR(seen(mirror, {light}, {1.0, 0.0, 1.0}), 2.0, 0.02);
        EXPECT_NEAR(seen(mirror, {light}, {1.0, 2.0, 1.0}), 0.0, 0.02);
        EXPECT_NEAR(seen(mirror, {light}, {1.0, 0.0, 6.0}), 0.0, 0.02);
    }
}

/// Radiance is continuous where outlines become so small that they count as points.
TEST_F(AreaLightTruth, lightsGoOverIntoSmallOnesWithoutAStep) {
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const LightType type : kAreaTypes) {
            const scenes::Material metal = twoSidedMetal(1.0, roughness);
            double before = 0.0;
            for (double distance = 20.0; distance < 3000.0; distance *= 1.07) {
                const glm::dvec3 at = distance * glm::normalize(glm::dvec3(-0.5, 0.1, 1.0));
                const scenes::Light light = areaLight(type, at, -at, 1.0f);
                const double here = seen(metal, {light}, {0.5, 0.0, 1.0}) * distance * distance;
                if (before > 0.0) {
                    EXPECT_NEAR(here / before, 1.0, 0.03) << scenes::infoOf(type).name << " at " << distance;
                }
                before = here;
            }
        }
}

TEST_F(AreaLightTruth, extremeSizesAndPlacesGiveFiniteLight) {
    constexpr float kRadiance = 1e6f;
    for (const double roughness : {0.0, 0.3, 1.0})
        for (const glm::dvec3& toViewer : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 1e-3)}) {
            const scenes::Material metal = twoSidedMetal(0.5, roughness);
            const double fromEverywhere = seen(metal, {}, toViewer, evenEnvironment(kRadiance));
            for (const LightType type : kAreaTypes)
                for (const float size : {1e-6f, 1e-2f, 1.0f, 1e3f, 1e6f})
                    for (const glm::dvec3& at :
                         {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1e-5), glm::dvec3(0.0, 0.0, -0.1),
                          glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(1e5, 0.0, 1.0)}) {
                        scenes::Light light = areaLight(type, at, {0.3, 0.0, -1.0}, kRadiance);
                        light.alongWS = glm::normalize(glm::cross(light.directionWS, glm::dvec3(0.0, 1.0, 0.0)));
                        light.widthMetres = light.heightMetres = light.lengthMetres = light.radiusMetres = size;
                        for (glm::vec2& corner : light.corners.metres) corner *= size;
                        const double radiance = seen(metal, {light}, toViewer);
                        EXPECT_TRUE(std::isfinite(radiance) && radiance >= 0.0 && radiance <= 1.001 * fromEverywhere)
                            << scenes::infoOf(type).name << " of " << size << " at " << at.x << " " << at.z << ": "
                            << radiance << ", of light from everywhere " << fromEverywhere;
                    }
        }
}

} // namespace
} // namespace tessera
