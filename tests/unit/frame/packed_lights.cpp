#include "renderer/frame/PackedLights.h"

#include <tuple>

#include <gmock/gmock.h>

#include "tests/support/Random.h"
#include "tests/unit/frame/Lights.h"

namespace tessera::frame {
namespace {

using scenes::Falloff;
using scenes::Light;
using scenes::LightType;
using test::pack;
using testing::ElementsAre;
using testing::IsEmpty;

Light light(LightType type, const glm::dvec3& positionWS = {0, 0, -5}) {
    Light result;
    result.type = type;
    result.positionWS = positionWS;
    return result;
}
/// A light with attenuation coefficients A, B and C.
Light attenuated(const glm::vec3& abc, LightType type = LightType::Point, const glm::dvec3& positionWS = {0, 0, -5}) {
    Light result = light(type, positionWS);
    result.falloff = Falloff::Attenuation;
    result.attenuation = abc;
    return result;
}

TEST(PackedLights, everyKindIsPackedAsItsShaderReadsIt) {
    Light ranged = light(LightType::Point);
    ranged.rangeMetres = 4.0f;
    ranged.color = {1.0f, 0.5f, 0.25f};
    ranged.intensity = 8.0f;
    const PackedLights packed = pack({light(LightType::Directional), light(LightType::Point), ranged,
                                      light(LightType::Spot), attenuated({1, 2, 3}, LightType::Spot)});
    ASSERT_EQ(packed.texels.size(), 5u);
    EXPECT_THAT(packed.sceneIndex, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_EQ(packed.texels[0].position, glm::vec4(0, 0, 1, 0)); // towards the light, which travels along -z
    EXPECT_EQ(packed.texels[0].color.w, float(int(LightType::Directional)));
    EXPECT_EQ(packed.texels[1].position, glm::vec4(0, 0, -5, 0)); // no range: 1/range^2 is 0
    EXPECT_EQ(packed.texels[1].color.w, float(int(LightType::Point)));
    EXPECT_NEAR(packed.texels[2].position.w, 1.0f / 16.0f, 1e-6f); // rounded up by up to 1e-6 of itself
    EXPECT_GE(packed.texels[2].position.w, 1.0f / 16.0f);
    EXPECT_EQ(glm::vec3(packed.texels[2].color), glm::vec3(8.0f, 4.0f, 2.0f));
    EXPECT_EQ(packed.texels[3].color.w, float(int(LightType::Spot)));
    EXPECT_EQ(glm::vec3(packed.shapes[3].axis), glm::vec3(0, 0, -1));
    EXPECT_EQ(packed.texels[4].color.w, float(int(LightType::Spot) | LIGHT_ATTENUATION));
    EXPECT_EQ(glm::vec3(packed.shapes[4].attenuation), glm::vec3(1, 2, 3));
    EXPECT_EQ(packed.texels[4].position.w, 0.0f);
}

TEST(PackedLights, theConeIsScaledFromOneInsideToZeroOutside) {
    Light spot = light(LightType::Spot);
    spot.innerConeRadians = 0.3f;
    spot.outerConeRadians = 0.9f;
    const shared::LightShapeTexels packed = pack({spot}).shapes.at(0);
    const auto cone = [](int kind, const shared::LightShapeTexels& shape, double angle) {
        const glm::dvec3 toLight(std::sin(angle), 0.0, std::cos(angle)), axis(shape.axis); // the light travels along -z
        const double apart =
            (kind & LIGHT_BROAD) != 0 ? glm::dot(toLight, axis) : glm::dot(toLight + axis, toLight + axis);
        return double(shape.attenuation.w) - double(shape.axis.w) * apart;
    };
    EXPECT_NEAR(cone(int(LightType::Spot), packed, 0.3), 1.0, 1e-6); // fp32 weight and offset of order one
    EXPECT_NEAR(cone(int(LightType::Spot), packed, 0.9), 0.0, 1e-6);
    spot.innerConeRadians = spot.outerConeRadians; // a hard edge is held at KHR_lights_punctual's least width
    EXPECT_EQ(pack({spot}).shapes.at(0).axis.w, 500.0f);
    // From a laser's cone to nearly a full sphere, each precise relative to its cosine difference.
    for (const double outer : {1e-4, 1e-2, 1.0, 1.1, 1.5, 1.6, 2.0, 2.2, 3.0, 3.14159}) {
        SCOPED_TRACE(outer);
        spot.outerConeRadians = float(outer);
        spot.innerConeRadians = 0.0f;
        const PackedLights lights = pack({spot});
        const int kind = int(lights.texels.at(0).color.w);
        const shared::LightShapeTexels& one = lights.shapes.at(0);
        const double angle = double(spot.outerConeRadians), cosine = std::cos(angle);
        const double fromPole = std::min(1.0 - cosine, 1.0 + cosine);
        EXPECT_NEAR(cone(kind, one, angle), 0.0, 3e-7 * fromPole * 2.0 * std::abs(double(one.axis.w)) + 1e-12);
        EXPECT_NEAR(shared::coneCosOuter(kind, one), cosine, 2e-7);
        EXPECT_EQ(shared::coneTravel(one), glm::vec3(0, 0, -1));
    }
}

TEST(PackedLights, theSetHoldsExactlyTheKindsThatWerePacked) {
    Light off = light(LightType::Spot);
    off.enabled = false;
    const auto features = [](const std::vector<Light>& lights) { return pack(lights).features.has; };
    const auto only = [](std::initializer_list<Feature> list) {
        FeatureSet set;
        for (const Feature feature : list) set.add(feature);
        return set.has;
    };
    EXPECT_EQ(features({}), only({}));
    EXPECT_EQ(features({off}), only({}));
    for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot})
        EXPECT_EQ(features({light(type)}), only({featureOf(type)})) << int(type);
    EXPECT_EQ(features({attenuated({1, 0, 0})}), only({featureOf(LightType::Point), Feature::AttenuationLights}));
}

TEST(PackedLights, offDarkAndUnseenLightsAreLeftOutExactlyWhenPruning) {
    Light off = light(LightType::Point), black = light(LightType::Point), noRange = black,
          noCone = light(LightType::Spot);
    off.enabled = false;
    black.intensity = 0.0f;
    noRange.rangeMetres = 0.0f;
    noCone.outerConeRadians = 0.0f;
    Light behind = light(LightType::Point, {0, 0, 10});
    behind.rangeMetres = 5.0f;
    const std::vector<Light> lights{off, black, noRange, noCone, behind, light(LightType::Point)};
    const PackedLights pruned = pack(lights);
    EXPECT_THAT(pruned.sceneIndex, ElementsAre(5));
    EXPECT_EQ(pruned.off, 1u);
    EXPECT_EQ(pruned.dark, 3u);
    EXPECT_EQ(pruned.unseen, 1u);
    FrameSettings keep;
    keep.prune = false;
    const PackedLights whole = pack(lights, keep);
    EXPECT_THAT(whole.sceneIndex, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_EQ(whole.off, 1u);
    EXPECT_EQ(whole.dark + whole.unseen, 0u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(glm::vec3(whole.texels[i].color), glm::vec3(0.0f)) << "dark lights add exactly 0";
}

TEST(PackedLights, aLightThatIsLeftOutNeverReachesAPointInTheFrustum) {
    test::Random random(4);
    FrameSettings settings;
    settings.rangeTolerance = 0.01;
    for (const scenes::Projection projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        scenes::Camera camera;
        camera.projection = projection;
        camera.nearMetres = 0.5;
        camera.halfHeightMetres = 5.0;
        std::vector<Light> lights;
        for (int i = 0; i < 2000; ++i) {
            lights.push_back(light(random.index(2) == 0 ? LightType::Point : LightType::Spot,
                                   random.direction() * random.between(0.0, 30.0)));
            lights.back().rangeMetres = float(random.between(0.5, 10.0));
            if (random.index(2) == 0) continue;
            lights.back().falloff = Falloff::Attenuation;
            lights.back().attenuation = {random.unit(), random.unit(), random.between(1.0, 100.0)};
        }
        const PackedLights packed = pack(lights, settings, camera);
        EXPECT_GT(packed.truncated.ended, 500u);
        EXPECT_GT(packed.unseen, 500u);
        EXPECT_GT(packed.texels.size(), 500u);
        std::vector<bool> kept(lights.size(), false);
        for (const int i : packed.sceneIndex) kept[std::size_t(i)] = true;
        const double aspect = 640.0 / 360.0, slope = std::tan(0.5 * camera.fovYRadians);
        for (int i = 0; i < 4000; ++i) {
            const double depth = random.between(0.5, 40.0);
            const double halfHeight =
                projection == scenes::Projection::Perspective ? slope * depth : camera.halfHeightMetres;
            // Half of the points lie on the frustum's surface, where a wrong plane fails first.
            const auto place = [&] { return i % 2 == 0 ? random.between(-1.0, 1.0) : double(random.index(2) * 2 - 1); };
            const glm::dvec3 point(place() * halfHeight * aspect, place() * halfHeight, -depth);
            for (std::size_t j = 0; j < lights.size(); ++j)
                ASSERT_TRUE(kept[j] || glm::distance(point, lights[j].positionWS) >=
                                           reachMetres(lights[j], settings.rangeTolerance))
                    << "light " << j;
        }
    }
}

TEST(PackedLights, lightsWithoutEndAreNotLeftOut) {
    Light far = attenuated({1, 0, 0}, LightType::Point, {0, 0, 1000});
    far.rangeMetres = 1.0f; // a range applies to the other falloff only
    EXPECT_EQ(
        pack({far, light(LightType::Point, {0, 0, 1e6}), light(LightType::Directional, {0, 0, 1e6})}).texels.size(),
        3u);
}

TEST(PackedLights, aToleranceEndsFalloffByABCAndNothingElse) {
    Light ended = attenuated({0, 0, 1});
    ended.intensity = 8.0f; // 8 / r^2 = 1/2 at 4 m
    Light below = ended, level = ended, behind = ended, off = ended, black = ended;
    below.attenuation = {16.0f, 0.0f, 1.0f}; // 1/2 at distance 0
    level.attenuation = {1.0f, 0.0f, 0.0f};
    behind.positionWS = {0, 0, 10};
    behind.attenuation = {0.0f, 0.0f, 4.0f}; // range 2 m
    off.enabled = false;
    black.color = glm::vec3(0.0f);
    const std::vector<Light> lights{ended, below, level, behind, off, black, light(LightType::Point)};
    const PackedLights without = pack(lights);
    EXPECT_THAT(without.sceneIndex, ElementsAre(0, 1, 2, 3, 6));
    EXPECT_EQ(without.everywhere, 5u);
    EXPECT_EQ(without.truncated.endless, 4u);
    EXPECT_EQ(without.truncated.sum(), 4u);
    FrameSettings settings;
    settings.rangeTolerance = 0.5;
    const PackedLights with = pack(lights, settings);
    EXPECT_THAT(with.sceneIndex, ElementsAre(0, 2, 6));
    EXPECT_EQ(with.everywhere, 2u);
    EXPECT_EQ(with.dark, 2u); // below, black
    EXPECT_EQ(with.unseen, 1u);
    EXPECT_GE(with.texels[0].position.w, 1.0f / 16.0f); // rounded up by up to 1e-6 of itself
    EXPECT_NEAR(with.texels[0].position.w, 1.0f / 16.0f, 1e-6f);
    EXPECT_EQ(with.truncated.ended, 2u);
    EXPECT_EQ(with.truncated.belowAlready, 1u);
    EXPECT_EQ(with.truncated.endless, 1u);
    EXPECT_NEAR(with.truncated.shortestMetres, 2.0, 1e-14); // a few roundings of double
    EXPECT_NEAR(with.truncated.longestMetres, 4.0, 1e-14);
    settings.prune = false;
    const PackedLights kept = pack(lights, settings);
    EXPECT_THAT(kept.sceneIndex, ElementsAre(0, 1, 2, 3, 5, 6));
    EXPECT_EQ(glm::vec3(kept.texels[1].color), glm::vec3(0.0f)) << "dark lights add exactly 0";
}

TEST(PackedLights, aRangeWhoseSquareLeavesFp32IsPackedAsNone) {
    Light far = light(LightType::Point);
    far.rangeMetres = 1e17f;
    EXPECT_GT(pack({far}).texels.at(0).position.w, 0.0f);
    far.rangeMetres = 1e20f;
    EXPECT_EQ(pack({far}).texels.at(0).position.w, 0.0f);
    EXPECT_EQ(pack({far}).everywhere, 1u);
}

TEST(PackedLights, soloLeavesExactlyThatLight) {
    FrameSettings solo;
    solo.soloLight = 1;
    const std::vector<Light> lights{light(LightType::Point), light(LightType::Spot), light(LightType::Directional)};
    const PackedLights packed = pack(lights, solo);
    EXPECT_THAT(packed.sceneIndex, ElementsAre(1));
    EXPECT_EQ(packed.off, 2u);
    EXPECT_EQ(packed.shown, 0);
}

TEST(PackedLights, theShownLightIsTheFirstThatIsOnOrNoneWhenItIsLeftOut) {
    Light off = light(LightType::Point), behind = light(LightType::Point, {0, 0, 10});
    off.enabled = false;
    behind.rangeMetres = 1.0f;
    EXPECT_EQ(pack({off, light(LightType::Point), light(LightType::Spot)}).shown, 0);
    const PackedLights hidden = pack({off, behind, light(LightType::Spot)});
    EXPECT_THAT(hidden.sceneIndex, ElementsAre(2));
    EXPECT_EQ(hidden.shown, 1) << "no light of the list: the other one must not be shown in its place";
    EXPECT_EQ(pack({}).shown, 0);
    EXPECT_THAT(pack({}).texels, IsEmpty());
}

TEST(PackedLights, viewsOfShadowsShowTheFirstLightInViewThatCastsSome) {
    Light behind = light(LightType::Point, {0, 0, 10}), dark = light(LightType::Point), lit = light(LightType::Spot);
    behind.rangeMetres = 1.0f;
    dark.intensity = 0.0f;
    behind.castsShadow = dark.castsShadow = lit.castsShadow = true;
    const std::vector<Light> lights{light(LightType::Point), behind, dark, lit, lit};
    FrameSettings settings;
    for (const bool prune : {true, false}) {
        settings.prune = prune;
        const auto shown = [&](DebugView view) {
            settings.view = view;
            const PackedLights packed = pack(lights, settings);
            return packed.sceneIndex.at(std::size_t(packed.shown));
        };
        settings.shadows = {};
        EXPECT_EQ(shown(DebugView::Shadow), 3) << prune;
        EXPECT_EQ(shown(DebugView::Cascades), 3) << prune;
        EXPECT_EQ(shown(DebugView::Distribution), 0) << prune;
        settings.shadows = {scenes::ShadowRequest::Kind::None};
        EXPECT_EQ(shown(DebugView::Shadow), 0) << "none casts any";
    }
}

TEST(PackedLights, extremeIntensitiesStayFinite) {
    Light bright = light(LightType::Point);
    bright.color = glm::vec3(1e20f);
    bright.intensity = 1e20f;
    EXPECT_EQ(pack({bright}).texels.at(0).color.x, 1e30f);
}

TEST(PackedLights, positionsKeepTheirDigitsFarFromTheOrigin) {
    scenes::Camera camera;
    camera.worldFromCamera[3] = {1e7, 0, 0, 1};
    const PackedLights packed = pack({light(LightType::Point, {1e7 + 0.125, 0.0, -1.0})}, {}, camera);
    EXPECT_EQ(glm::vec3(packed.texels.at(0).position), glm::vec3(0.125f, 0.0f, -1.0f));
}

TEST(PackedLights, keyframesArePackedAsALightThatStandsStillAsTheySay) {
    Light keyed = light(LightType::Spot);
    keyed.intensity = 0.0f; // the keyframes light it
    for (const auto& [of, first, last] :
         {std::tuple(scenes::LightKeyed::Direction, glm::dvec3(0, 0, -1), glm::dvec3(0, -1, 0)),
          std::tuple(scenes::LightKeyed::Color, glm::dvec3(1), glm::dvec3(1, 0, 0)),
          std::tuple(scenes::LightKeyed::Intensity, glm::dvec3(0), glm::dvec3(8, 0, 0))}) {
        scenes::LightKeys& keys = keyed.keyframes.emplace_back();
        keys.of = of;
        keys.timesSeconds = {0.0, 1.0};
        keys.values = {first, last};
    }
    FrameSettings settings;
    settings.prune = true;
    EXPECT_EQ(pack({keyed}, settings).dark, 1u);
    settings.timeSeconds = 0.5;
    Light still = light(LightType::Spot);
    still.directionWS = glm::normalize(glm::dvec3(0, -1, -1));
    still.color = {1.0f, 0.5f, 0.5f};
    still.intensity = 4.0f;
    const PackedLights moving = pack({keyed}, settings), standing = pack({still}, settings);
    ASSERT_EQ(moving.texels.size(), 1u);
    EXPECT_EQ(moving.texels[0].color, standing.texels[0].color);
    EXPECT_LT(glm::distance(moving.shapes.at(0).axis, standing.shapes.at(0).axis), 1e-6f); // rounding to fp32
}

TEST(PackedLights, anAnimatedLightIsPackedWhereItIsAtThatTime) {
    Light moving = light(LightType::Point);
    moving.animation = scenes::LightAnimation{};
    moving.animation->kind = scenes::LightAnimationKind::Keyframes;
    moving.animation->keys.timesSeconds = {0.0, 2.0};
    moving.animation->keys.values = {{0, 0, -5}, {4, 0, -5}};
    FrameSettings settings;
    settings.timeSeconds = 1.0;
    EXPECT_EQ(glm::vec3(pack({moving}, settings).texels.at(0).position), glm::vec3(2, 0, -5));
}

} // namespace
} // namespace tessera::frame
