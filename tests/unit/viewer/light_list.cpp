#include "viewer/edit/LightList.h"

#include "scenes/AreaLight.h"

#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;

Lights named(std::initializer_list<const char*> names) {
    Lights lights;
    for (const char* name : names) lights.emplace_back().name = name;
    return lights;
}

std::vector<std::string> namesOf(const Lights& lights) {
    std::vector<std::string> names;
    for (const scenes::Light& light : lights) names.push_back(light.name);
    return names;
}

using Names = std::vector<std::string>;

/// A point light with this kind of animation, or static if `kind` is -1.
scenes::Light movingLight(int kind) {
    scenes::Light light;
    light.positionWS = {0.5, 1.5, -2.0};
    if (kind < 0) return light;
    scenes::LightAnimation& animation = light.animation.emplace();
    animation.kind = scenes::LightAnimationKind(kind);
    animation.periodSeconds = 3.0;
    animation.amplitudeMetres = {1, 1, 0};
    animation.keys.timesSeconds = {0.0, 1.0};
    animation.pointsWS = {{0, 0, 0}, {1, 1, 1}};
    animation.keys.values = animation.pointsWS;
    return light;
}

TEST(LightList, everyNewNameIsFreeAndOthersNeverChange) {
    Lights lights = named({"lamp", "sun", "lamp 3"});
    for (const int index : {0, 0, 2}) lights.push_back(copiesOfLights(lights, {index}).front());
    lights.push_back(newLight(lights, lights[1]));
    lights.push_back(newLight(lights, scenes::Light()));
    EXPECT_EQ(namesOf(lights), (Names{"lamp", "sun", "lamp 3", "lamp 2", "lamp 4", "lamp 5", "sun 2", "light"}));
}

TEST(LightList, aCopyIsExactlyTheLightButForItsName) {
    Lights lights = named({"lamp"});
    lights[0].intensity = 7.0f;
    lights[0].animation.emplace().periodSeconds = 3.0;
    scenes::Light copy = copiesOfLights(lights, {0}).front();
    copy.name = "lamp";
    EXPECT_TRUE(copy == lights[0]);
}

TEST(LightList, anIndexGoesWithItsLightWhileOthersComeAndGo) {
    EXPECT_EQ(indexAfter(2, 3, 1, 0), 2) << "one behind it went";
    EXPECT_EQ(indexAfter(2, 0, 1, 0), 1) << "one before it went";
    EXPECT_FALSE(indexAfter(2, 2, 1, 0)) << "it went itself";
    EXPECT_EQ(indexAfter(2, 2, 0, 1), 3) << "one came to where it was";
    EXPECT_EQ(indexAfter(2, 2, 1, 1), 2) << "it was changed";
    EXPECT_FALSE(indexAfter(2, 0, 4, 9)) << "others took the place of all";
    EXPECT_EQ(toggledSolo({}, 2), 2);
    EXPECT_FALSE(toggledSolo(0, 0));
    EXPECT_EQ(toggledSolo(0, 1), 1);
}

TEST(LightList, aMovedLightFollowsTheDragAtItsOwnDepthAlsoWhereItIsAnimated) {
    for (const scenes::Camera& lens : {perspective({1, 2, 8}, {0, 1, 0}), orthographic({1, 2, 8}, {0, 1, 0}, 3.0)}) {
        const CameraPose pose = poseOf(lens, kBox);
        for (int kind = -1; kind < 4; ++kind) {
            scenes::Light light = movingLight(kind);
            const double timeSeconds = 0.3;
            const glm::dvec3 before = shownAt(lens, scenes::lightAtTime(light, timeSeconds).positionWS);
            moveLight(light, timeSeconds, pose, lens, {30.0, -12.0}, kHeightPixels);
            const glm::dvec3 after = shownAt(lens, scenes::lightAtTime(light, timeSeconds).positionWS);
            EXPECT_NEAR(after.x - before.x, 30.0, 1e-9);
            EXPECT_NEAR(after.y - before.y, -12.0, 1e-9);
            EXPECT_NEAR(after.z, before.z, 1e-12);
        }
    }
}

TEST(LightList, aLightBehindTheEyeIsMovedAsAtTheFocus) {
    const scenes::Camera lens = perspective({0, 0, 8}, {0, 0, 0});
    const CameraPose pose = poseOf(lens, kBox);
    scenes::Light light;
    light.positionWS = {0, 0, 50};
    moveLight(light, 0.0, pose, lens, {100.0, 0.0}, kHeightPixels);
    EXPECT_NEAR(light.positionWS.x, 100.0 * metresPerPixel(lens, pose, pose.focusMetres, kHeightPixels), 1e-12);
}

TEST(LightList, anAnimatedLightIsPlacedAtAPointAndTime) {
    for (int kind = -1; kind < 4; ++kind) {
        scenes::Light light = movingLight(kind);
        const scenes::Light before = light;
        const glm::dvec3 wantedWS(-4.1, 0.3, 7.7);
        placeLight(light, 0.4, wantedWS);
        EXPECT_LT(glm::distance(scenes::lightAtTime(light, 0.4).positionWS, wantedWS), 1e-12) << kind;
        // From there on it moves as before, displaced by a constant.
        const glm::dvec3 stepWS = wantedWS - scenes::lightAtTime(before, 0.4).positionWS;
        EXPECT_LT(glm::distance(scenes::lightAtTime(light, 0.9).positionWS,
                                scenes::lightAtTime(before, 0.9).positionWS + stepWS),
                  1e-12)
            << kind;
    }
}

TEST(LightList, anOrbitBeginsAndAStopEndsWhereTheLightIs) {
    for (const double timeSeconds : {0.0, 0.7, 2.0, 4.0, 6.5, 12345.678, -1.3}) {
        scenes::Light light;
        light.positionWS = {3, 2, 1};
        orbitLight(light, 1.5, 4.0, timeSeconds);
        ASSERT_TRUE(light.animation);
        EXPECT_GE(light.animation->phase, 0.0);
        EXPECT_LT(light.animation->phase, 1.0);
        EXPECT_LT(glm::distance(scenes::lightAtTime(light, timeSeconds).positionWS, glm::dvec3(3, 2, 1)), 1e-11);
        const glm::dvec3 halfwayWS = scenes::lightAtTime(light, timeSeconds + 2.0).positionWS;
        EXPECT_LT(glm::distance(halfwayWS, glm::dvec3(0, 2, 1)), 1e-11);
        stopLight(light, timeSeconds + 2.0);
        EXPECT_FALSE(light.animation);
        EXPECT_EQ(light.positionWS, halfwayWS);
    }
}

TEST(LightList, aStoppedLightKeepsItsIntensityAndItsFlicker) {
    scenes::Light light;
    light.intensity = 10.0f;
    light.animation.emplace();
    light.flicker.emplace();
    const scenes::Light before = light;
    stopLight(light, 0.3);
    EXPECT_EQ(light.intensity, before.intensity);
    EXPECT_EQ(light.flicker, before.flicker);
}

TEST(LightList, aStoppedLightKeepsWhatItsKeyframesSaidThen) {
    scenes::Light light;
    light.type = scenes::LightType::Directional;
    for (const auto of : {scenes::LightKeyed::Direction, scenes::LightKeyed::Intensity}) {
        scenes::LightKeys& keys = light.keyframes.emplace_back();
        keys.of = of;
        keys.timesSeconds = {0.0, 1.0};
        keys.values = {{1, 0, 0}, {0, 1, 0}};
    }
    const scenes::Light then = scenes::lightAtTime(light, 0.25);
    stopLight(light, 0.25);
    EXPECT_FALSE(scenes::movesByItself(light));
    EXPECT_EQ(light.directionWS, then.directionWS);
    EXPECT_EQ(light.intensity, 0.75f);
}

TEST(LightList, turningALightByHandEndsWhatTurnsItByItself) {
    scenes::Light light;
    light.type = scenes::LightType::Spot;
    light.animation.emplace().looksAhead = true;
    light.keyframes.emplace_back().of = scenes::LightKeyed::Direction;
    light.keyframes.emplace_back().of = scenes::LightKeyed::Color;
    const scenes::Light before = light;
    turnLight(light, light.directionWS);
    EXPECT_TRUE(light == before) << "no turn";
    turnLight(light, {1, 0, 0});
    EXPECT_FALSE(light.animation->looksAhead);
    EXPECT_FALSE(scenes::hasKeys(light, scenes::LightKeyed::Direction));
    EXPECT_TRUE(scenes::hasKeys(light, scenes::LightKeyed::Color));
}

TEST(LightList, lightsThatBeginToFlickerDoSoDifferently) {
    scenes::Light first, second;
    letFlicker(first, true, 0);
    letFlicker(second, true, 1);
    EXPECT_NE(scenes::lightAtTime(first, 0.3).intensity, scenes::lightAtTime(second, 0.3).intensity);
    letFlicker(first, false, 0);
    EXPECT_TRUE(first == scenes::Light());
}

TEST(LightList, aLightOfAnyTypeThatIsChosenCanBeSavedAndAnAreaShines) {
    for (const scenes::LightTypeInfo& first : scenes::lightTypes()) {
        for (const scenes::LightTypeInfo& second : scenes::lightTypes()) {
            scenes::Scene scene;
            scenes::Light& light = scene.lights.emplace_back();
            if (!first.isArea) light.falloff = scenes::Falloff::Attenuation;
            light.directionWS = glm::normalize(glm::dvec3(0.8, 0.1, 0.2));
            chooseType(light, first.type, 10.0);
            chooseType(light, second.type, 10.0);
            EXPECT_EQ(light.type, second.type);
            EXPECT_NO_THROW(scenes::checkScene(scene)) << first.name << ", then " << second.name;
            EXPECT_EQ(scenes::hasSurface(light), second.isArea);
            if (!first.isArea && !second.isArea) {
                EXPECT_EQ(light.falloff, scenes::Falloff::Attenuation);
                EXPECT_EQ(light.radiusMetres, 0.0f);
            }
        }
    }
    scenes::Light light;
    light.radiusMetres = 0.125f;
    chooseType(light, scenes::LightType::Sphere, 10.0);
    EXPECT_EQ(light.radiusMetres, 0.125f) << "it has one already";
}

/// A light of a type with all members set, but without a radius if its type needs none.
scenes::Light lightOfAll(const scenes::LightTypeInfo& type) {
    scenes::Light light;
    light.name = "lamp";
    light.type = type.type;
    light.color = {0.1f, 0.2f, 0.3f};
    light.directionWS = glm::normalize(glm::dvec3(0.8, 0.1, 0.2));
    light.alongWS = scenes::usualAlong(light.directionWS);
    light.radiusMetres = type.isArea ? 0.3f : 0.0f;
    light.falloff = type.isArea ? scenes::Falloff::InverseSquare : scenes::Falloff::Attenuation;
    light.attenuation = {1.0f, 0.5f, 0.25f};
    light.rangeMetres = 7.0f;
    light.widthMetres = 0.7f;
    light.heightMetres = 0.4f;
    light.lengthMetres = 1.7f;
    light.corners.metres[1] = {0.9f, -0.8f};
    light.isTwoSided = true;
    scenes::LightKeys& keys = light.keyframes.emplace_back();
    keys.of = scenes::LightKeyed::Direction;
    keys.timesSeconds = {1.0};
    keys.values = {light.directionWS};
    return light;
}

TEST(LightList, aTypeThatComesBackBringsAllThatTheLightHad) {
    for (const scenes::LightTypeInfo& first : scenes::lightTypes())
        for (const scenes::LightTypeInfo& second : scenes::lightTypes())
            for (const scenes::LightTypeInfo& third : scenes::lightTypes()) {
                const Lights lights{lightOfAll(first)};
                scenes::Light light = lights[0];
                TypeChooser chooser;
                for (const scenes::LightType type : {second.type, third.type, first.type})
                    chooser.choose(0, light, type, 10.0);
                EXPECT_TRUE(light == lights[0]) << first.name << ", " << second.name << ", " << third.name;
            }
}

TEST(LightList, aRectangleBecomesThePolygonOfItsCornersUnlessThoseOfThePolygonWereSet) {
    scenes::Light light;
    light.type = scenes::LightType::Rectangle;
    light.widthMetres = 1.5f;
    light.heightMetres = 1.25f;
    const scenes::Light rectangle = light;
    TypeChooser chooser;
    const auto choose = [&](scenes::LightType type) { chooser.choose(0, light, type, 10.0); };
    const auto largest = [&] { return light.corners.metres[2]; };
    choose(scenes::LightType::Polygon);
    EXPECT_EQ(largest(), glm::vec2(0.75f, 0.625f));
    EXPECT_DOUBLE_EQ(scenes::signedArea(light.corners), 1.5 * 1.25);
    choose(scenes::LightType::Rectangle);
    EXPECT_EQ(light.corners, rectangle.corners);
    light.widthMetres = 3.0f;
    choose(scenes::LightType::Polygon);
    EXPECT_EQ(largest(), glm::vec2(1.5f, 0.625f)) << "as wide as the rectangle is now";
    EXPECT_TRUE(moveCorner(light, 2, {2.0f, 1.0f}));
    choose(scenes::LightType::Rectangle);
    choose(scenes::LightType::Polygon);
    EXPECT_EQ(largest(), glm::vec2(2.0f, 1.0f));
    light.type = scenes::LightType::Rectangle;
    light.corners = {};
    light.widthMetres = 0.0f;
    choose(scenes::LightType::Polygon);
    EXPECT_EQ(light.corners, scenes::LightCorners()) << "of no area";
}

TEST(LightList, typesComeBackOfEachLightWhileOthersComeAndGo) {
    Lights points, spheres; // with alternating falloffs
    TypeChooser chooser;
    for (std::size_t i = 0; i < 4; ++i) {
        points.push_back(lightOfAll(scenes::infoOf(scenes::LightType::Point)));
        if (i % 2 == 1) points[i].falloff = scenes::Falloff::InverseSquare;
        spheres.push_back(points[i]);
        chooser.choose(i, spheres[i], scenes::LightType::Sphere, 10.0);
    }
    const auto comesBack = [&](std::size_t light, std::size_t index) {
        scenes::Light changed = spheres[light];
        chooser.choose(index, changed, scenes::LightType::Point, 10.0);
        return changed == points[light];
    };
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(comesBack(i, i)) << i;
    chooser.follow(1, 1, 0); // a light is deleted
    EXPECT_TRUE(comesBack(0, 0));
    EXPECT_TRUE(comesBack(2, 1));
    EXPECT_TRUE(comesBack(3, 2));
    EXPECT_FALSE(comesBack(0, 3)) << "nothing is known of such a one";
    chooser.follow(0, 0, 1); // a light is added before them
    EXPECT_FALSE(comesBack(0, 0));
    EXPECT_TRUE(comesBack(2, 2));
}

TEST(LightList, whatWasChangedMeanwhileStaysAndOtherLightsGetNothing) {
    const Lights lights{lightOfAll(scenes::infoOf(scenes::LightType::Point)), scenes::Light()};
    TypeChooser chooser;
    scenes::Light light = lights[0], other = lights[1];
    chooser.choose(0, light, scenes::LightType::Disk, 10.0);
    light.radiusMetres = 0.75f;
    light.widthMetres = 2.5f;
    other.type = scenes::LightType::Disk;
    other.radiusMetres = 0.5f;
    chooser.choose(1, other, scenes::LightType::Point, 10.0);
    EXPECT_EQ(other.falloff, scenes::Falloff::InverseSquare);
    EXPECT_EQ(other.radiusMetres, 0.5f);
    chooser.choose(0, light, scenes::LightType::Point, 10.0);
    EXPECT_EQ(light.radiusMetres, 0.75f);
    EXPECT_EQ(light.widthMetres, 2.5f);
    EXPECT_EQ(light.falloff, scenes::Falloff::Attenuation);
    // After another scene is opened.
    chooser.choose(0, light, scenes::LightType::Disk, 10.0);
    chooser.forget();
    chooser.choose(0, light, scenes::LightType::Point, 10.0);
    EXPECT_EQ(light.falloff, scenes::Falloff::InverseSquare);
}

TEST(LightList, cornersOfAPolygonNeverMakeNoOutline) {
    scenes::Light light;
    light.type = scenes::LightType::Polygon; // a square of 1 m by default
    EXPECT_TRUE(moveCorner(light, 2, {0.0f, -0.25f}));
    EXPECT_EQ(light.corners.metres[2], glm::vec2(0.0f, -0.25f));
    const scenes::Light before = light;
    EXPECT_FALSE(moveCorner(light, 2, {0.0f, -0.5f})) << "onto an edge";
    EXPECT_FALSE(moveCorner(light, 2, {0.0f, -2.0f})) << "across an edge";
    EXPECT_TRUE(light == before);
    for (std::size_t count = 5; count <= scenes::LightCorners::kMost; ++count) {
        EXPECT_TRUE(addCorner(light));
        EXPECT_EQ(light.corners.count, count);
    }
    EXPECT_EQ(light.corners.metres[4], glm::vec2(-0.5f, 0.0f)) << "in the middle of the last edge";
    EXPECT_FALSE(addCorner(light));
    for (std::size_t count = 7; count >= scenes::LightCorners::kLeast; --count) EXPECT_TRUE(removeCorner(light));
    EXPECT_FALSE(removeCorner(light));
    EXPECT_EQ(light.corners.count, scenes::LightCorners::kLeast);
}

TEST(LightList, theWidthOfARectangleStaysAcrossItsDirection) {
    scenes::Light light;
    light.type = scenes::LightType::Rectangle;
    turnLight(light, {3.0, 0.0, -4.0});
    EXPECT_LT(glm::distance(light.directionWS, glm::dvec3(0.6, 0.0, -0.8)), 1e-15);
    EXPECT_LT(glm::distance(light.alongWS, glm::dvec3(0.8, 0.0, 0.6)), 1e-15);
    EXPECT_TRUE(layLight(light, {0.0, 5.0, 0.0}));
    EXPECT_EQ(light.alongWS, glm::dvec3(0, 1, 0));
    turnLight(light, {0.0, -2.0, 0.0}); // along its former width
    EXPECT_NEAR(glm::dot(light.alongWS, light.directionWS), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(light.alongWS), 1.0, 1e-15);
    const scenes::Light before = light;
    EXPECT_FALSE(layLight(light, {0.0, 3.0, 0.0}));
    EXPECT_FALSE(layLight(light, glm::dvec3(0.0)));
    EXPECT_TRUE(light == before);
    scenes::Light spot;
    spot.type = scenes::LightType::Spot;
    turnLight(spot, {1.0, 0.0, 0.0});
    EXPECT_EQ(spot.alongWS, scenes::Light().alongWS) << "others have no width";
}

} // namespace
} // namespace tessera::viewer
