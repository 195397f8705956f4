#include <algorithm>

#include <fmt/format.h>

#include "scenes/AreaLight.h"
#include "scenes/Load.h"
#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Random.h"
#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class SceneJsonAreaLights : public OneElement {
protected:
    SceneJsonAreaLights() : OneElement("lights") {}
    static std::string placed(const std::string& members) { return R"({"position": [1, 2, 3], )" + members + "}"; }
    Light areaLight(const std::string& members) const { return import(placed(members)).lights.at(0); }
};

TEST_F(SceneJsonAreaLights, everyShapeHasItsStatedValues) {
    const Light panel = areaLight(R"("type": "rectangle", "direction": [0, -2, 0], "width": 3, "height": 0.5,
        "along": [0, 7, -2], "twoSided": true, "seen": false, "intensity": 40, "falloff": {"type": "inverse_square", "range": 9})");
    EXPECT_EQ(panel.type, LightType::Rectangle);
    expectMembers(panel, "widthMetres 3, heightMetres 0.5, directionWS 0 -1 0, isTwoSided 1, isSeen 0, rangeMetres 9");
    expectMembers(panel, "alongWS 0 0 -1"); // the part along the direction is ignored
    expectMembers(areaLight(R"("type": "disk", "target": [1, 2, 4], "radius": 0.25)"),
                  "radiusMetres 0.25, directionWS 0 0 1, isTwoSided 0, isSeen 1, rangeMetres inf");
    expectMembers(areaLight(R"("type": "sphere", "radius": 2)"), "radiusMetres 2");
    expectMembers(areaLight(R"("type": "tube", "direction": [1, 0, 0], "length": 1.5, "radius": 0.02)"),
                  "lengthMetres 1.5, radiusMetres 0.02");
    const Light polygon = areaLight(R"("type": "polygon", "direction": [0, -1, 0], "along": [0, 0, 2],
        "corners": [[0, 0], [1, 0], [0.5, 0.25], [0, 2]], "twoSided": true)");
    EXPECT_EQ(polygon.type, LightType::Polygon);
    EXPECT_EQ(polygon.corners, tessera::test::cornersOf({{0, 0}, {1, 0}, {0.5f, 0.25f}, {0, 2}}));
    expectMembers(polygon, "alongWS 0 0 1, isTwoSided 1");
}

TEST_F(SceneJsonAreaLights, aWidthThatIsNotStatedIsHorizontal) {
    const auto along = [&](const char* direction) {
        return areaLight(fmt::format(R"("type": "rectangle", "direction": {})", direction)).alongWS;
    };
    EXPECT_EQ(along("[0, 0, 1]"), glm::dvec3(1, 0, 0));
    EXPECT_EQ(along("[0, 0, -1]"), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(along("[1, 0, 0]"), glm::dvec3(0, 0, -1));
    for (const char* vertical : {"[0, 1, 0]", "[0, -1, 0]"}) EXPECT_EQ(along(vertical), glm::dvec3(1, 0, 0));
    tessera::test::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        glm::dvec3 direction = random.direction();
        if (i % 2 == 0) direction.y = random.logarithmic(1.0, 1e20); // all but vertical
        direction = glm::normalize(direction);
        const glm::dvec3 usual = usualAlong(direction);
        EXPECT_NEAR(glm::dot(usual, direction), 0.0, 1e-15);
        EXPECT_NEAR(glm::length(usual), 1.0, 1e-15);
        EXPECT_NEAR(usual.y, 0.0, 1e-6);
    }
}

TEST_F(SceneJsonAreaLights, whatAShapeCannotHaveIsRefusedByKeyAndValue) {
    const auto error = [&](const std::string& light) { return errorOf(placed(light)); };
    const std::string panel = R"("type": "rectangle", "direction": [0, 0, 1])",
                      polygon = R"("type": "polygon", "direction": [0, 0, 1])";
    EXPECT_EQ(errorBeyondSchemaOf(placed(panel + R"(, "along": [0, 0, -2.5])")),
              "/along: is (0, 0, -2.5), which runs along the light's direction; give a vector across it");
    EXPECT_EQ(errorBeyondSchemaOf(placed(polygon + R"(, "corners": [[0, 0], [1, 1], [1, 0], [0, 1]])")),
              "/corners: let the edge from number 0 to 1 meet that from number 2 to 3; move one of them");
    for (const auto& [light, refusal] :
         {std::pair<std::string, std::string>(panel + R"(, "along": [0, 0, 0])",
                                              "/along: has no length; give a direction"),
          {panel + R"(, "width": -1)", "/width: is -1; at least 0 is needed"},
          {panel + R"(, "height": 1000001)", "/height: is 1000001; at most 1000000 is allowed"},
          {panel + R"(, "radius": 1)",
           ": a rectangle light has no key 'radius'; valid are type, name, enabled, color, intensity, flicker, "
           "keyframes, position, falloff, animation, direction, target, along, width, height, twoSided, seen, "
           "texture, castsShadow, fields"},
          {panel + R"(, "twoSided": 1)", "/twoSided: is a number; true or false is needed"},
          {panel + R"(, "seen": 1)", "/seen: is a number; true or false is needed"},
          {polygon, ": lacks the key 'corners'; add it"},
          {R"("type": "sphere")", ": lacks the key 'radius'; add it"},
          {R"("type": "tube", "radius": 1)", ": lacks the key 'direction'; add it"}})
        EXPECT_EQ(error(light), refusal);
    for (const char* corners : {"[[0, 0], [1, 1]]", "[[0, 0], [1, 0], [1]]", "[[0, 0], [1, 0], [1, 1000001]]"})
        EXPECT_NE(error(polygon + R"(, "corners": )" + corners), "") << corners;
    EXPECT_THAT(error(R"("type": "sphere", "radius": 1, "twoSided": true)"),
                StartsWith(": a sphere light has no key 'twoSide"));
    for (const char* shape :
         {R"("type": "rectangle", "direction": [0, 0, 1])", R"("type": "disk", "direction": [0, 0, 1], "radius": 1)",
          R"("type": "sphere", "radius": 1)", R"("type": "tube", "direction": [0, 0, 1], "radius": 1)",
          R"("type": "polygon", "direction": [0, 0, 1], "corners": [[0, 0], [1, 0], [0, 1]])"}) {
        const std::string text = error(std::string(shape) + R"(, "falloff": {"type": "attenuation", "C": 1})");
        EXPECT_THAT(text, StartsWith("/falloff/type: a "));
        EXPECT_THAT(text, HasSubstr("light has no falloff 'attenuation', since its shape decides how its light falls "
                                    "off; inverse_square may end it by a range"));
    }
}

TEST_F(SceneJsonAreaLights, aRectangleTurnedAnyWayIsReadBackIdentically) {
    tessera::test::Random random(8);
    for (int i = 0; i < 500; ++i) {
        Light light;
        light.name = "panel";
        light.type = LightType::Rectangle;
        light.directionWS = random.direction();
        light.alongWS = random.around(light.directionWS, 0.0, 0.0);
        if (i % 2 == 0) light.alongWS = usualAlong(light.directionWS);
        const nlohmann::json written(write::lightJson(light));
        EXPECT_EQ(written.contains("along"), i % 2 == 1);
        EXPECT_TRUE(scenejson::readLight(JsonValue(written, {}), 0) == light) << written.dump();
    }
}

TEST_F(SceneJsonAreaLights, anIncludedRectangleIsTurnedWithItsWidth) {
    folder.write("parts/panel.json", R"({"tessera": 1, "lights": [
        {"type": "rectangle", "position": [0, 1, 0], "direction": [0, 0, -1], "along": [1, 0, 0], "width": 2}]})");
    const Scene scene = folder.import(R"({"tessera": 1, "include": [
        {"file": "parts/panel.json", "transform": {"scale": [3, 1, 1], "eulerDegrees": [0, 90, 0]}}]})");
    const Light& light = scene.lights.at(0);
    EXPECT_LT(glm::distance(light.directionWS, glm::dvec3(-1, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(light.alongWS, glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_EQ(light.widthMetres, 2.0f) << "scales change directions alone";
}

TEST_F(SceneJsonAreaLights, thoseThatAreOnAndHaveNoAreaAreReportedInOneLine) {
    const auto warningsOf = [&](const std::string& lights) {
        return loadScene(folder.file("areas.json", R"({"tessera": 1, "lights": [)" + lights + "]}")).warnings;
    };
    const auto panel = [](const char* name, const char* more) {
        return fmt::format(
            R"({{"name": "{}", "type": "rectangle", "position": [0, 0, 0], "direction": [0, 0, 1], {}}})", name, more);
    };
    const auto isOf = [](const std::string& warning) { return warning.find("area of 0") != std::string::npos; };
    const std::string good = panel("lamp", R"("width": 0.001)"), off = panel("off", R"("width": 0, "enabled": false)"),
                      flat = panel("sign", R"("width": 0)"), gone = panel("door", R"("height": 0)");
    EXPECT_EQ(std::ranges::count_if(warningsOf(good + "," + off), isOf), 0);
    const std::vector<std::string> ofOne = warningsOf(good + "," + flat), ofTwo = warningsOf(flat + "," + gone);
    EXPECT_EQ(std::ranges::count(ofOne, "the light 'sign' has an area of 0 and stays dark; give it a size"), 1);
    EXPECT_EQ(std::ranges::count(ofTwo, "2 lights have an area of 0 and stay dark, first 'sign'; give them a size"), 1);
    EXPECT_EQ(std::ranges::count_if(ofTwo, isOf), 1);
}

TEST_F(SceneJsonAreaLights, anIncludedPolygonIsMirroredWithItsPart) {
    folder.write("parts/sign.json", R"({"tessera": 1, "lights": [
        {"type": "polygon", "position": [0, 0, 0], "direction": [0, 0, 1], "along": [1, 0, 0],
         "corners": [[0, 0], [2, 0], [2, 1]]}]})");
    const auto placesOf = [](const Light& light) {
        std::vector<glm::dvec3> places;
        for (const glm::vec2& corner : light.corners.all())
            places.push_back(double(corner.x) * light.alongWS +
                             double(corner.y) * glm::cross(light.directionWS, light.alongWS));
        return places;
    };
    for (const auto& [scale, sign] : {std::pair{"[1, 1, 1]", glm::dvec3(1)},
                                      {"[-1, 1, 1]", glm::dvec3(-1, 1, 1)},
                                      {"[1, -1, 1]", glm::dvec3(1, -1, 1)},
                                      {"[1, 1, -1]", glm::dvec3(1, 1, -1)}}) {
        const Scene scene = folder.import(fmt::format(
            R"({{"tessera": 1, "include": [{{"file": "parts/sign.json", "transform": {{"scale": {}}}}}]}})", scale));
        const std::vector<glm::dvec3> places = placesOf(scene.lights.at(0)),
                                      wanted{glm::dvec3(0), sign * glm::dvec3(2, 0, 0), sign * glm::dvec3(2, 1, 0)};
        ASSERT_EQ(places.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_LT(glm::distance(places[i], wanted[i]), 1e-12) << scale;
    }
}

} // namespace
} // namespace tessera::scenes
