#include "viewer/edit/LightLife.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "tests/support/Random.h"
#include "tests/unit/viewer/Scenes.h"

namespace tessera::viewer {
namespace {

using scenes::Interpolation;
using scenes::Light;
using scenes::LightAnimationKind;
using scenes::LightKeyed;

constexpr LightKeyed kMembers[] = {LightKeyed::Position, LightKeyed::Direction, LightKeyed::Color,
                                   LightKeyed::Intensity};

Light spot() {
    Light light;
    light.name = "lamp";
    light.type = scenes::LightType::Spot;
    light.positionWS = {1, 2, 3};
    light.color = {0.5f, 0.25f, 1.0f};
    light.intensity = 7.0f;
    return light;
}

/// Returns the light as read back from the JSON of a scene file.
Light savedAndRead(const Light& light) {
    const nlohmann::json written(scenes::write::lightJson(light));
    return scenes::scenejson::readLight(scenes::JsonValue(written, {}), 0);
}

TEST(LightLife, aKeyThatIsAddedLeavesTheLightAsItIsThen) {
    for (const LightKeyed member : kMembers) {
        Light light = spot();
        light.flicker.emplace();
        EXPECT_EQ(keysOf(light, member), nullptr);
        const Light before = scenes::lightAtTime(light, 1.5);
        EXPECT_EQ(addKey(light, member, 1.5), 0u);
        EXPECT_EQ(addKey(light, member, 0.5), 0u) << "before the other one";
        EXPECT_EQ(addKey(light, member, 1.5), 1u) << "it is there already";
        ASSERT_NE(keysOf(light, member), nullptr);
        EXPECT_EQ(keysOf(light, member)->timesSeconds, (std::vector{0.5, 1.5}));
        for (const double timeSeconds : {-1.0, 1.0, 1.5, 9.0}) {
            const Light now = scenes::lightAtTime(light, timeSeconds);
            EXPECT_EQ(now.positionWS, before.positionWS);
            EXPECT_EQ(now.directionWS, before.directionWS);
            EXPECT_EQ(now.color, before.color);
        }
        EXPECT_EQ(scenes::lightAtTime(light, 1.5).intensity, before.intensity) << "it flickers as before";
        EXPECT_TRUE(savedAndRead(light) == light);
    }
}

TEST(LightLife, keysMoveInTimeAsFarAsTheirNeighboursAndTakeValues) {
    Light light = spot();
    for (const double timeSeconds : {0.0, 1.0, 2.0}) addKey(light, LightKeyed::Intensity, timeSeconds);
    setKey(light, LightKeyed::Intensity, 1, {3.0, 0, 0});
    moveKey(light, LightKeyed::Intensity, 1, 1.75);
    EXPECT_EQ(scenes::lightAtTime(light, 1.75).intensity, 3.0f);
    moveKey(light, LightKeyed::Intensity, 1, 5.0);
    EXPECT_EQ(keysOf(light, LightKeyed::Intensity)->timesSeconds[1], 2.0 - kLeastKeyGapSeconds);
    moveKey(light, LightKeyed::Intensity, 1, -5.0);
    EXPECT_EQ(keysOf(light, LightKeyed::Intensity)->timesSeconds[1], kLeastKeyGapSeconds);
    moveKey(light, LightKeyed::Intensity, 2, 8.0);
    EXPECT_EQ(keysOf(light, LightKeyed::Intensity)->timesSeconds[2], 8.0) << "nothing is behind the last";
    addKey(light, LightKeyed::Direction, 0.0);
    setKey(light, LightKeyed::Direction, 0, {0, 3, 4});
    const glm::dvec3 turned = keysOf(light, LightKeyed::Direction)->values[0];
    EXPECT_LT(glm::length(turned - glm::dvec3(0.0, 0.6, 0.8)), 1e-15) << "of unit length";
    setKey(light, LightKeyed::Direction, 0, {0, 0, 0});
    EXPECT_EQ(keysOf(light, LightKeyed::Direction)->values[0], turned) << "that is no direction";
    EXPECT_TRUE(savedAndRead(light) == light);
}

TEST(LightLife, keysInAnyOrderAreSavedAsKeyframesAlone) {
    Light light = spot();
    for (const LightKeyed member : {LightKeyed::Intensity, LightKeyed::Direction, LightKeyed::Color})
        addKey(light, member, 1.0);
    const nlohmann::json written(scenes::write::lightJson(light));
    EXPECT_EQ(written.at("keyframes").size(), 3u);
    EXPECT_FALSE(written.contains("fields")) << written;
    EXPECT_TRUE(savedAndRead(light) == light);
}

TEST(LightLife, withItsLastKeyALightIsWhatThatSaid) {
    for (const LightKeyed member : kMembers) {
        Light light = spot();
        addKey(light, member, 1.0);
        addKey(light, member, 2.0);
        setKey(light, member, 1, {0, 1, 0});
        const Light then = scenes::lightAtTime(light, 2.0);
        removeKey(light, member, 0);
        ASSERT_NE(keysOf(light, member), nullptr);
        removeKey(light, member, 0);
        EXPECT_EQ(keysOf(light, member), nullptr);
        EXPECT_FALSE(scenes::movesByItself(light));
        EXPECT_TRUE(scenes::lightAtTime(light, 0.0) == light);
        EXPECT_EQ(light.positionWS, then.positionWS);
        EXPECT_EQ(light.directionWS, then.directionWS);
        EXPECT_EQ(light.color, then.color);
        EXPECT_EQ(light.intensity, then.intensity);
    }
    Light dark = spot(); // keys of files may be below a light's minimum
    addKey(dark, LightKeyed::Color, 0.0);
    setKey(dark, LightKeyed::Color, 0, {-1, 0.5, 0});
    removeKey(dark, LightKeyed::Color, 0);
    EXPECT_EQ(dark.color, glm::vec3(0.0f, 0.5f, 0.0f));
}

TEST(LightLife, splinesGetTangentsAndKeepThemInStep) {
    Light light = spot();
    for (const double timeSeconds : {0.0, 1.0, 3.0}) addKey(light, LightKeyed::Position, timeSeconds);
    setKey(light, LightKeyed::Position, 1, {2, 2, 3});
    setKey(light, LightKeyed::Position, 2, {4, 2, 3});
    setInterpolation(light, LightKeyed::Position, Interpolation::CubicSpline);
    EXPECT_LT(std::abs(scenes::lightAtTime(light, 2.0).positionWS.x - 3.0), 1e-12) << "a straight line at one speed";
    addKey(light, LightKeyed::Position, 2.0);
    EXPECT_LT(std::abs(scenes::lightAtTime(light, 1.5).positionWS.x - 2.5), 1e-12);
    EXPECT_TRUE(savedAndRead(light) == light);
    removeKey(light, LightKeyed::Position, 1);
    EXPECT_TRUE(savedAndRead(light) == light);
    setRepeat(light, LightKeyed::Position, scenes::KeyRepeat::Loop);
    setInterpolation(light, LightKeyed::Position, Interpolation::Step);
    EXPECT_TRUE(keysOf(light, LightKeyed::Position)->inTangents.empty());
    EXPECT_TRUE(savedAndRead(light) == light);
}

TEST(LightLife, aWayBeginsWhereTheLightIs) {
    constexpr LightAnimationKind kKinds[] = {LightAnimationKind::Orbit, LightAnimationKind::Wobble,
                                             LightAnimationKind::Path, LightAnimationKind::Keyframes};
    for (const LightAnimationKind from : kKinds)
        for (const LightAnimationKind to : kKinds) {
            Light light = spot();
            chooseWay(light, from, 0.75, 2.0);
            const Light before = light;
            const glm::dvec3 shownWS = scenes::lightAtTime(light, 2.0).positionWS;
            chooseWay(light, to, 2.0, 2.0);
            EXPECT_EQ(light.animation->kind, to);
            EXPECT_TRUE(savedAndRead(light) == light) << int(from) << " " << int(to);
            if (from == to) {
                EXPECT_TRUE(light == before);
            }
            // Conversion between a path and keys starts at 0 s, so the position at other times may change.
            const bool isOfPlaces = from == LightAnimationKind::Path && to == LightAnimationKind::Keyframes;
            if (!isOfPlaces) {
                EXPECT_LT(glm::distance(scenes::lightAtTime(light, 2.0).positionWS, shownWS), 1e-12)
                    << int(from) << " " << int(to);
            }
        }
}

TEST(LightLife, aPathThatBecomesKeysAndBackHasItsPointsAndPeriod) {
    for (const bool isOpen : {false, true}) {
        Light light = spot();
        chooseWay(light, LightAnimationKind::Path, 0.0, 2.0);
        light.animation->isOpen = isOpen;
        light.animation->periodSeconds = 6.0;
        const scenes::LightAnimation before = *light.animation;
        chooseWay(light, LightAnimationKind::Keyframes, 0.0, 2.0);
        EXPECT_EQ(scenes::lightAtTime(light, 6.0).positionWS, before.pointsWS[0]);
        chooseWay(light, LightAnimationKind::Path, 0.0, 2.0);
        EXPECT_EQ(light.animation->pointsWS, before.pointsWS);
        EXPECT_EQ(light.animation->isOpen, isOpen);
        EXPECT_EQ(light.animation->periodSeconds, 6.0);
    }
}

TEST(LightLife, pointsOfAPathComeAndGoAndKeepItALength) {
    Light light = spot();
    chooseWay(light, LightAnimationKind::Path, 0.0, 2.0);
    std::vector<glm::dvec3>& pointsWS = light.animation->pointsWS;
    ASSERT_EQ(pointsWS.size(), 4u);
    addPathPoint(light, 3);
    EXPECT_EQ(pointsWS.back(), glm::dvec3(1, 2, 4)) << "halfway back to the first";
    light.animation->isOpen = true;
    addPathPoint(light, 4);
    EXPECT_EQ(pointsWS.back(), glm::dvec3(1, 2, 3)) << "beyond the end";
    EXPECT_TRUE(movePathPoint(light, 5, {9, 9, 9}));
    EXPECT_TRUE(savedAndRead(light) == light);
    while (light.animation->pointsWS.size() > 2) EXPECT_TRUE(removePathPoint(light, 0));
    EXPECT_FALSE(removePathPoint(light, 0)) << "one point is no path";
    EXPECT_FALSE(movePathPoint(light, 0, {9, 9, 9})) << "that has no length";
    EXPECT_EQ(light.animation->pointsWS.size(), 2u);
    EXPECT_TRUE(scenes::hasLength(*light.animation));
}

TEST(LightLife, editsAtRandomAreSaved) {
    State state;
    state.open = test::opened("room");
    test::changeLight(state, 0, [](Light& light) { light.type = scenes::LightType::Spot; });
    tessera::test::Random random(11);
    for (int edit = 0; edit < 200; ++edit) {
        test::changeLight(state, 0, [&](Light& light) {
            const LightKeyed member = kMembers[std::size_t(random.index(4))];
            const scenes::LightKeys* keys = keysOf(light, member);
            const double timeSeconds = random.between(-3.0, 9.0);
            if (random.index(6) == 0)
                return chooseWay(light, LightAnimationKind(random.index(4)), timeSeconds, random.between(0.5, 2.0));
            const bool goesElse = member == LightKeyed::Position && keys == nullptr && light.animation;
            if (goesElse && light.animation->kind == LightAnimationKind::Path) {
                const auto point = std::size_t(random.index(int(light.animation->pointsWS.size())));
                if (random.index(2) == 0) return addPathPoint(light, point);
                if (random.index(2) == 0) return void(removePathPoint(light, point));
                return void(movePathPoint(light, point, 3.0 * random.direction()));
            }
            if (keys == nullptr || random.index(3) == 0) return void(addKey(light, member, timeSeconds));
            const auto key = std::size_t(random.index(int(keys->timesSeconds.size())));
            switch (random.index(4)) {
            case 0:
                return removeKey(light, member, key);
            case 1:
                return moveKey(light, member, key, timeSeconds);
            case 2:
                return setKey(light, member, key, glm::abs(random.direction()));
            default:
                return setInterpolation(light, member, Interpolation(random.index(3)));
            }
        });
        ASSERT_NO_THROW(scenes::checkScene(state.open->scene())) << "edit " << edit;
        ASSERT_TRUE(savedAndRead(state.open->scene().lights[0]) == state.open->scene().lights[0]) << "edit " << edit;
    }
    EXPECT_GT(state.open->history().undoable(), 100u);
}

} // namespace
} // namespace tessera::viewer
