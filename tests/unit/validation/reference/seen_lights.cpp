// Intersections of rays with the surfaces of lights, compared with sphere tracing.
#include "validation/reference/SeenLights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <gtest/gtest.h>

#include "scenes/LookAt.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Random.h"
#include "tests/unit/scenes/TinyScene.h"
#include "validation/reference/Render.h"

namespace tessera::reference {
namespace {

using scenes::LightType;
using test::kAreaTypes;

ShiningLight lamp(LightType type) {
    ShiningLight shining;
    shining.light.type = type;
    shining.light.directionWS = {0.0, 0.0, 1.0};
    shining.light.radiusMetres = 0.5f;
    shining.color = glm::dvec3(2.0, 1.0, 0.5);
    shining.positionRWS = {0.0, 0.0, -5.0};
    return shining;
}

/// Distance from a point to the surface; negative inside solids.
double distanceTo(const ShiningLight& shining, const glm::dvec3& placeRWS) {
    const scenes::Light& light = shining.light;
    const glm::dvec3 place = placeRWS - shining.positionRWS;
    const double along = glm::dot(place, light.directionWS), radius = light.radiusMetres;
    const double away = glm::length(place - along * light.directionWS);
    switch (light.type) {
    case LightType::Sphere:
        return glm::length(place) - radius;
    case LightType::Disk:
        return std::hypot(along, std::max(away - radius, 0.0));
    case LightType::Tube: {
        const double beyond = std::abs(along) - 0.5 * double(light.lengthMetres), aside = away - radius;
        return std::min(std::max(beyond, aside), 0.0) + std::hypot(std::max(beyond, 0.0), std::max(aside, 0.0));
    }
    case LightType::Polygon: {
        const glm::dvec2 at(glm::dot(place, light.alongWS),
                            glm::dot(place, glm::cross(light.directionWS, light.alongWS)));
        const std::span<const glm::vec2> corners = light.corners.all();
        double aside = std::numeric_limits<double>::infinity();
        bool isWithin = false;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 a(corners[i]), edge = glm::dvec2(corners[(i + 1) % corners.size()]) - a;
            const double share = std::clamp(glm::dot(at - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
            aside = std::min(aside, glm::distance(at, a + share * edge));
            if ((a.y > at.y) != (a.y + edge.y > at.y) && at.x < a.x + edge.x * (at.y - a.y) / edge.y)
                isWithin = !isWithin;
        }
        return std::hypot(along, isWithin ? 0.0 : aside);
    }
    default: {
        const double x = std::abs(glm::dot(place, light.alongWS)) - 0.5 * double(light.widthMetres);
        const double y =
            std::abs(glm::dot(place, glm::cross(light.directionWS, light.alongWS))) - 0.5 * double(light.heightMetres);
        return glm::length(glm::dvec3(std::max(x, 0.0), std::max(y, 0.0), along));
    }
    }
}

constexpr double kNear = 1e-9, kFarMetres = 100.0;

/// The depth at which a ray meets the surface, by sphere tracing; -1 where it misses, nothing where it grazes.
std::optional<double> steppedTo(const ShiningLight& light, const Ray& ray) {
    const double length = glm::length(ray.direction);
    double depth = 0.0;
    for (int step = 0; step < 20000; ++step) {
        const double distance = distanceTo(light, ray.at(depth));
        if (distance < kNear) return depth;
        depth += distance / length;
        if (depth > kFarMetres) return -1.0;
    }
    return {};
}

TEST(ReferenceSeenLights, raysMeetSurfacesWhereStepsAlongThemEnd) {
    tessera::test::Random random(21);
    int met = 0, missed = 0;
    std::array<int, std::size(kAreaTypes)> metOf{};
    for (int i = 0; i < 25000; ++i) { // 5000 of each type
        scenes::Camera camera;
        camera.nearMetres = 1e-6;
        camera.farMetres = kFarMetres;
        camera.projection = i % 2 == 0 ? scenes::Projection::Perspective : scenes::Projection::Orthographic;
        camera.halfHeightMetres = 2.0;
        camera.worldFromCamera = scenes::worldFromLookAt(glm::dvec3(0.0), random.direction());
        ShiningLight light = lamp(kAreaTypes[i / 2 % kAreaTypes.size()]);
        light.light.isTwoSided = true;
        light.light.directionWS = random.direction();
        if (i % 9 == 0) light.light.directionWS = {i % 2 ? -1.0 : 0.0, i % 2 ? 0.0 : -1.0, 0.0};
        light.light.alongWS = random.around(light.light.directionWS, 0.0, 0.0);
        for (float scenes::Light::*metres : {&scenes::Light::widthMetres, &scenes::Light::heightMetres,
                                             &scenes::Light::lengthMetres, &scenes::Light::radiusMetres})
            light.light.*metres = float(random.logarithmic(0.1, 3.0));
        light.light.corners.metres[2] = {-0.2f, 0.0f}; // a reflex corner
        for (glm::vec2& corner : light.light.corners.metres)
            corner *= glm::vec2(light.light.widthMetres, light.light.heightMetres);
        light.positionRWS = glm::dmat3(camera.worldFromCamera) *
                            glm::dvec3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), -random.between(4.0, 9.0));
        const CameraRays rays(camera, {64, 64});
        const Ray ray = rays.through(glm::dvec2(random.between(0.0, 64.0), random.between(0.0, 64.0)));
        if (distanceTo(light, ray.at(0.0)) < 0.0) continue;
        const std::optional<double> wanted = steppedTo(light, ray);
        if (!wanted) continue;
        const ShiningLight lights[] = {light};
        const SeenLights seen(lights, rays);
        const std::optional<SeenLights::Met> found = seen.before(ray, 1e9);
        ASSERT_EQ(found.has_value(), *wanted >= 0.0) << scenes::infoOf(light.light.type).name << " " << i;
        if (!found) {
            ++missed;
            continue;
        }
        ++met;
        ++metOf[std::size_t(i / 2 % 5)];
        // At grazing rays the last step ends farther before the surface.
        EXPECT_NEAR(found->depthMetres, *wanted, 1e-4) << scenes::infoOf(light.light.type).name << " " << i;
        EXPECT_NEAR(distanceTo(light, ray.at(found->depthMetres)), 0.0, 1e-11);
    }
    // Of a thousand rays per type 185 meet a sphere, 155 a tube, 95 a disk, 20 a rectangle and 7 a polygon, which has
    // two fifths of its rectangle: estimated from the mean projected areas of such sizes.
    EXPECT_GT(met, 2000);
    EXPECT_GT(missed, 2000);
    for (std::size_t i = 0; i < metOf.size(); ++i) EXPECT_GT(metOf[i], 15) << scenes::infoOf(kAreaTypes[i]).name;
}

class ReferenceLightInView : public testing::Test {
protected:
    std::optional<SeenLights::Met> met(const std::vector<ShiningLight>& lights, double depthMetres = 1e9) const {
        const CameraRays rays(camera_, {1, 1});
        return SeenLights(lights, rays).before(rays.through(0, 0), depthMetres);
    }
    scenes::Camera camera_;
};

TEST_F(ReferenceLightInView, onlyFrontsAndOutsidesBetweenThePlanesAreMet) {
    for (const LightType type : kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        const bool isFlat = scenes::infoOf(type).isFlat;
        ShiningLight light = lamp(type);
        ASSERT_TRUE(met({light}));
        EXPECT_NEAR(met({light})->depthMetres, isFlat ? 5.0 : 4.5, 1e-12);
        EXPECT_TRUE(met({light}, 5.0));
        EXPECT_FALSE(met({light}, 4.4));
        light.light.isSeen = false;
        EXPECT_FALSE(met({light}));
        light = lamp(type);
        light.light.radiusMetres = light.light.widthMetres = 0.0f;
        for (glm::vec2& corner : light.light.corners.metres) corner *= 1e-7f;
        EXPECT_FALSE(met({light}));
        light = lamp(type);
        light.light.directionWS.z = -1.0;
        EXPECT_EQ(met({light}).has_value(), !isFlat);
        light.light.isTwoSided = true;
        EXPECT_TRUE(met({light}));
        light.positionRWS.z = 0.0;
        EXPECT_FALSE(met({light})) << "from inside";
        light.positionRWS.z = 5.0;
        EXPECT_FALSE(met({light})) << "behind";
        camera_.farMetres = 4.0;
        EXPECT_FALSE(met({lamp(type)}));
        camera_ = {};
        camera_.nearMetres = 5.2;
        EXPECT_FALSE(met({lamp(type)})) << "the near plane cuts it open";
        camera_ = {};
    }
    EXPECT_FALSE(met({lamp(LightType::Point)}));
    EXPECT_FALSE(met({lamp(LightType::Spot)}));
}

TEST_F(ReferenceLightInView, theNearestIsMetAndOfSeveralInOnePlaceTheLast) {
    std::vector<ShiningLight> lights{lamp(LightType::Sphere), lamp(LightType::Disk), lamp(LightType::Rectangle)};
    EXPECT_EQ(met(lights)->light, 0u);
    lights[0].positionRWS.z = -6.0;
    EXPECT_EQ(met(lights)->light, 2u);
    lights[1].positionRWS.z = -4.0;
    EXPECT_EQ(met(lights)->light, 1u);
}

/// A white triangle in z = 0 that is visible to a pixel, and a light before it.
class ReferencePictureOfALight : public testing::Test {
protected:
    ReferencePictureOfALight() {
        scene_.background = {0.5f, 0.25f, 0.125f};
        scene_.materials[0].model = scenes::MaterialModel::SingleColor;
        scenes::Light light = lamp(LightType::Sphere).light;
        light.positionWS = {0.5, 1.0, 2.0};
        light.intensity = 4.0f;
        scene_.lights = {light};
        settings_.sizePixels = {1, 1};
        settings_.camera.worldFromCamera = scenes::worldFromLookAt({0.5, 1.0, 5.0}, {0.5, 1.0, 0.0});
    }
    /// Makes the triangle half transparent.
    void makeTransparent() {
        scene_.materials[0].alphaMode = scenes::AlphaMode::Blend;
        scene_.materials[0].baseColor.a = 0.5f;
        scene_.materials[0].doubleSided = true;
    }
    scenes::Scene scene_ = scenes::tinyScene();
    Settings settings_;
};

TEST_F(ReferencePictureOfALight, showsItsRadianceBeforeTheSurfaceWhoseIdStays) {
    const Rendered seen = render(scene_, settings_);
    EXPECT_EQ(seen.radiance[0], glm::dvec3(4.0));
    EXPECT_EQ(seen.covered[0], 1);
    EXPECT_EQ(seen.ids[0].object, 1u);
    EXPECT_TRUE(seen.alternatives[0].empty());
    scene_.lights[0].isSeen = false;
    EXPECT_EQ(render(scene_, settings_).radiance[0], glm::dvec3(1.0));
    scene_.lights[0].isSeen = true;
    scene_.lights[0].positionWS.z = -1.0;
    EXPECT_EQ(render(scene_, settings_).radiance[0], glm::dvec3(1.0)) << "behind the surface";
    scene_.nodes[0].instances.clear();
    const Rendered alone = render(scene_, settings_);
    EXPECT_EQ(alone.radiance[0], glm::dvec3(4.0));
    EXPECT_EQ(alone.covered[0], 1);
    EXPECT_EQ(alone.ids[0], Ids{});
}

TEST_F(ReferencePictureOfALight, transparentSurfacesBeforeItAreBlendedOverIt) {
    makeTransparent();
    EXPECT_EQ(render(scene_, settings_).radiance[0], glm::dvec3(4.0)) << "all of the surface is behind";
    EXPECT_NE(render(scene_, settings_).ids[0].transparent, 0u);
    scene_.lights[0].positionWS.z = -1.0;
    EXPECT_EQ(render(scene_, settings_).radiance[0], glm::dvec3(0.5 * 1.0 + 0.5 * 4.0));
}

TEST_F(ReferencePictureOfALight, whereRoundingDecidesBothAreAllowed) {
    const auto allows = [&](const glm::dvec3& radiance) {
        const Rendered rendered = render(scene_, settings_);
        return rendered.radiance[0] == radiance || std::ranges::any_of(rendered.alternatives[0], [&](const Span& span) {
                   return span.least == radiance && span.most == radiance;
               });
    };
    // The outline of a rectangle through the pixel's centre.
    scenes::Light& light = scene_.lights[0];
    light.type = LightType::Rectangle;
    light.positionWS.x = 0.0;
    EXPECT_TRUE(allows(glm::dvec3(4.0)));
    EXPECT_TRUE(allows(glm::dvec3(1.0)));
    // In the plane of the surface.
    light.positionWS = {0.5, 1.0, 0.0};
    EXPECT_TRUE(allows(glm::dvec3(4.0)));
    EXPECT_TRUE(allows(glm::dvec3(1.0)));
    makeTransparent();
    EXPECT_TRUE(allows(glm::dvec3(4.0)));
    EXPECT_TRUE(allows(glm::dvec3(2.5)));
    settings_.findsAlternatives = false;
    EXPECT_TRUE(render(scene_, settings_).alternatives[0].empty());
}

/// A tenth of a pixel beside the outline, or a millimetre before a surface 5 m away, only one value is allowed.
TEST_F(ReferencePictureOfALight, whereRoundingDoesNotDecideOneAloneIsAllowed) {
    scenes::Light& light = scene_.lights[0];
    light.type = LightType::Rectangle;
    const double pixelMetres = 2.0 * 5.0 * std::tan(0.5 * settings_.camera.fovYRadians) * 3.0 / 5.0; // at z = 2
    const double edgeX = 0.5 - 0.5 * double(light.widthMetres);
    for (const double side : {1.0, -1.0}) {
        light.positionWS = {edgeX + side * 0.1 * pixelMetres, 1.0, 2.0};
        const Rendered rendered = render(scene_, settings_);
        EXPECT_EQ(rendered.radiance[0], glm::dvec3(side > 0.0 ? 4.0 : 1.0));
        EXPECT_TRUE(rendered.alternatives[0].empty());
    }
    for (const double metres : {1e-3, -1e-3}) {
        light.positionWS = {0.5, 1.0, metres};
        const Rendered rendered = render(scene_, settings_);
        EXPECT_EQ(rendered.radiance[0], glm::dvec3(metres > 0.0 ? 4.0 : 1.0));
        EXPECT_TRUE(rendered.alternatives[0].empty());
    }
}

} // namespace
} // namespace tessera::reference
