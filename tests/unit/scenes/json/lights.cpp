#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class SceneJsonLights : public OneElement {
protected:
    SceneJsonLights() : OneElement("lights") {}
    Light lightOf(const std::string& light) const { return import(light).lights.at(0); }
};

std::string point(const std::string& members) {
    return R"({"type": "point", "position": [1, 2, 3])" + (members.empty() ? members : ", " + members) + "}";
}

TEST_F(SceneJsonLights, aPointLightHasItsStatedValues) {
    const Light plain = lightOf(point(""));
    EXPECT_EQ(plain.name, "light 0");
    EXPECT_EQ(plain.type, LightType::Point);
    EXPECT_EQ(plain.falloff, Falloff::InverseSquare);
    expectMembers(plain, "enabled 1, positionWS 1 2 3, rangeMetres inf, castsShadow 0, radiusMetres 0");
    const Light light = lightOf(point(R"("name": "lamp", "enabled": false, "color": [0.5, 0.25, 0], "intensity": 40,
        "castsShadow": true, "radius": 0.25)"));
    EXPECT_EQ(light.name, "lamp");
    expectMembers(light, "enabled 0, color 0.5 0.25 0, intensity 40, castsShadow 1, radiusMetres 0.25");
}

TEST_F(SceneJsonLights, lightsAreInDocumentOrderAfterIncludedOnes) {
    const Scene scene = folder.import(R"({"tessera": 1, "lights": [
        {"name": "b", "type": "point", "position": [0, 0, 0]}, {"name": "a", "type": "point", "position": [0, 0, 0]}],
        "include": [{"file": "parts/lamps.json"}]})");
    std::vector<std::string> names;
    for (const Light& light : scene.lights) names.push_back(light.name);
    EXPECT_THAT(names, ElementsAre("bulb", "b", "a"));
}

TEST_F(SceneJsonLights, bothFalloffsAreKept) {
    const Light window = lightOf(point(R"("falloff": {"type": "inverse_square", "range": 12})"));
    EXPECT_EQ(window.falloff, Falloff::InverseSquare);
    EXPECT_EQ(window.rangeMetres, 12.0f);
    const Light coefficients = lightOf(point(R"("falloff": {"type": "attenuation", "A": 1, "C": 0.5})"));
    EXPECT_EQ(coefficients.falloff, Falloff::Attenuation);
    EXPECT_EQ(coefficients.attenuation, glm::vec3(1, 0, 0.5f));
}

TEST_F(SceneJsonLights, attenuationWithoutOrBelowZeroIsRefused) {
    for (const char* falloff : {R"({"type": "attenuation"})", R"({"type": "attenuation", "A": 0, "B": 0, "C": 0})"})
        EXPECT_EQ(errorOf(point(std::string(R"("falloff": )") + falloff)),
                  "/falloff: the attenuation coefficients A, B and C are all 0, which divides by 0; give at "
                  "least one above 0");
    EXPECT_EQ(errorOf(point(R"("falloff": {"type": "attenuation", "A": 1, "B": -0.5})")),
              "/falloff/B: the attenuation coefficient B is -0.5; it must not be negative");
    EXPECT_EQ(errorOf(point(R"("falloff": {"type": "attenuation", "A": 1, "range": 5})")),
              "/falloff: an attenuation falloff has no key 'range'; valid are type, A, B, C");
    EXPECT_EQ(errorOf(point(R"("falloff": {"type": "linear"})")),
              "/falloff/type: there is no falloff 'linear'; valid are inverse_square, attenuation");
}

TEST_F(SceneJsonLights, directionsAreOfUnitLength) {
    const Light sun = lightOf(R"({"type": "directional", "direction": [0, -3, -4]})");
    EXPECT_EQ(sun.type, LightType::Directional);
    // One rounding of a square root in double precision.
    EXPECT_NEAR(sun.directionWS.y, -0.6, 1e-15);
    EXPECT_NEAR(sun.directionWS.z, -0.8, 1e-15);
    EXPECT_EQ(lightOf(R"({"type": "directional", "direction": [1e300, 0, 0]})").directionWS, glm::dvec3(1, 0, 0));
    EXPECT_EQ(errorOf(R"({"type": "directional", "direction": [0, 0, 0]})"),
              "/direction: has no length; give a direction");
    EXPECT_EQ(errorOf(R"({"type": "directional"})"), ": lacks the key 'direction'; add it");
}

TEST_F(SceneJsonLights, aSpotLightHasItsConesInRadians) {
    const Light spot = lightOf(R"({"type": "spot", "position": [0, 2, 0], "target": [0, 0, 0],
                                           "innerDegrees": 30, "outerDegrees": 60})");
    EXPECT_EQ(spot.directionWS, glm::dvec3(0, -1, 0));
    constexpr float kPi = std::numbers::pi_v<float>;
    EXPECT_FLOAT_EQ(spot.innerConeRadians, kPi / 6);
    EXPECT_FLOAT_EQ(spot.outerConeRadians, kPi / 3);
    const Light plain = lightOf(R"({"type": "spot", "position": [0, 2, 0], "direction": [1, 0, 0]})");
    EXPECT_EQ(plain.directionWS, glm::dvec3(1, 0, 0));
    EXPECT_EQ(plain.innerConeRadians, 0.0f);
    EXPECT_FLOAT_EQ(plain.outerConeRadians, kPi / 4);
}

TEST_F(SceneJsonLights, impossibleSpotsAreRefused) {
    const std::string start = R"({"type": "spot", "position": [0, 2, 0], )";
    EXPECT_EQ(errorBeyondSchemaOf(start + R"("direction": [1, 0, 0], "innerDegrees": 50, "outerDegrees": 45})"),
              "/innerDegrees: is 50, wider than the half angle of the outer cone of 45 degrees; make it narrower");
    EXPECT_EQ(errorBeyondSchemaOf(start + R"("target": [0, 2, 0]})"),
              "/target: is the light's own position; give another point");
    EXPECT_EQ(errorOf(start + R"("direction": [1, 0, 0], "outerDegrees": 91})"),
              "/outerDegrees: is 91; at most 90 is allowed");
    EXPECT_EQ(errorOf(start + R"("direction": [1, 0, 0], "target": [0, 0, 0]})"),
              "/target: is given beside 'direction'; keep one");
}

TEST_F(SceneJsonLights, typesThatThereAreNotAreRefusedByName) {
    EXPECT_EQ(errorOf(R"({"type": "area"})"),
              "/type: 'area' names no shape; types of area lights are rectangle, disk, sphere, tube, polygon");
    EXPECT_EQ(errorOf(R"({"type": "environment"})"),
              "/type: light from everywhere is no light of this list; give the document a key 'environment'");
    EXPECT_EQ(errorOf(R"({"type": "spott"})"), "/type: there is no light type 'spott'; did you mean 'spot'?");
}

TEST_F(SceneJsonLights, numbersOutOfRangeAreRefused) {
    for (const auto& [members, error] :
         {std::pair(R"("intensity": -1)", "/intensity: is -1; at least 0 is needed"),
          {R"("intensity": 1e39)", "/intensity: is 1e+39; at most 3.4028234663852886e+38 is allowed"},
          {R"("color": [1, 1])", "/color: has 2 elements; exactly 3 are needed"},
          {R"("color": [1, 1, 1, 1])", "/color: has 4 elements; exactly 3 are needed"},
          {R"("color": [1, -1, 1])", "/color/1: is -1; at least 0 is needed"},
          {R"("enabled": 1)", "/enabled: is a number; true or false is needed"},
          {R"("falloff": {"type": "inverse_square", "range": -2})", "/falloff/range: is -2; at least 0 is needed"},
          {R"("flicker": {"frequencyHz": 0})", "/flicker/frequencyHz: is 0; more than 0 is needed"},
          {R"("flicker": {"frequencyHz": 2000})", "/flicker/frequencyHz: is 2000; at most 1000 is allowed"}})
        EXPECT_EQ(errorOf(point(members)), error);
}

TEST_F(SceneJsonLights, everyAnimationMovesTheLight) {
    const auto positionAt = [&](const std::string& animation, double seconds) {
        return lightAtTime(lightOf(point(R"("animation": )" + animation)), seconds).positionWS;
    };
    const std::string orbit = R"({"type": "orbit", "center": [1, 2, 0], "axis": [0, 2, 0], "periodSeconds": 8)";
    expectNear(positionAt(orbit + "}", 0.0), {1, 2, 3});
    expectNear(positionAt(orbit + "}", 4.0), {1, 2, -3});
    expectNear(positionAt(orbit + R"(, "phase": 0.5})", 0.0), {1, 2, -3});
    expectNear(positionAt(R"({"type": "wobble", "amplitude": [1, 0, 2], "periodSeconds": 4})", 1.0), {2, 2, 5});
    expectNear(positionAt(R"({"type": "path", "points": [[0, 0, 0], [2, 0, 0]], "periodSeconds": 4})", 1.0), {1, 0, 0});
    expectNear(
        positionAt(R"({"type": "path", "points": [[0, 0, 0], [2, 0, 0]], "open": true, "periodSeconds": 4})", 2.0),
        {2, 0, 0});
    // The curve bulges by an eighth of a square's side at the middle of the side.
    expectNear(positionAt(R"({"type": "path", "points": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
                              "line": "catmull_rom", "periodSeconds": 8})",
                          1.0),
               {0, -1.25, 0});
    EXPECT_EQ(lightAtTime(lightOf(R"({"type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0],
                  "animation": {"type": "path", "points": [[0, 0, 0], [2, 0, 0]], "lookAhead": true,
                                "periodSeconds": 4}})"),
                          3.0)
                  .directionWS,
              glm::dvec3(-1, 0, 0));
    expectNear(positionAt(R"({"type": "keyframes", "times": [1, 3], "points": [[0, 0, 0], [2, 0, 0]],
                              "interpolation": "cubic_spline", "inTangents": [[0, 0, 0], [0, 4, 0]],
                              "outTangents": [[0, 4, 0], [0, 0, 0]], "repeat": "ping_pong"})",
                          4.0),
               {1, 0, 0});
    expectNear(positionAt(R"({"type": "keyframes", "times": [1, 3], "points": [[0, 0, 0], [2, 0, 0]],
                              "interpolation": "step", "repeat": "loop"})",
                          4.0),
               {0, 0, 0});
    expectNear(positionAt(R"({"type": "keyframes", "times": [1, 3], "points": [[0, 0, 0], [2, 0, 0]]})", 1.5),
               {0.5, 0, 0});
}

TEST_F(SceneJsonLights, keyframesAreOfDirectionColourAndIntensity) {
    const Light light = lightOf(R"({"type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0], "keyframes": {
        "intensity": {"times": [0, 1], "values": [2, 4], "repeat": "loop"},
        "direction": {"times": [0, 2], "values": [[3, 0, 0], [0, 0, 5]]},
        "color": {"times": [1, 2], "values": [[0, 0, 0], [1, 0.5, 0]], "interpolation": "cubic_spline",
                  "inTangents": [[0, 0, 0], [0, 0, 0]], "outTangents": [[0, 0, 0], [0, 0, 0]]}}})");
    ASSERT_EQ(light.keyframes.size(), 3u);
    const Light then = lightAtTime(light, 1.5);
    EXPECT_EQ(then.intensity, 3.0f);
    EXPECT_EQ(then.color, glm::vec3(0.5f, 0.25f, 0.0f));
    // Rounding of sine and cosine.
    EXPECT_LT(glm::distance(then.directionWS,
                            glm::dvec3(std::cos(0.375 * std::numbers::pi), 0.0, std::sin(0.375 * std::numbers::pi))),
              1e-14);
}

TEST_F(SceneJsonLights, brokenKeyframesAreRefused) {
    for (const auto& [keyframes, error] :
         {std::pair(R"("direction": {"times": [0], "values": [[0, 1, 0]]})",
                    ": an object of keyframes of a point light has no key 'direction'; valid are color, intensity"),
          {R"("intensity": {"times": [0], "values": [-1]})", "/intensity/values/0: is -1; at least 0 is needed"},
          {R"("color": {"times": [0], "values": [[1, -1, 1]]})", "/color/values/0/1: is -1; at least 0 is needed"},
          {R"("intensity": {"times": [0]})", "/intensity: lacks the key 'values'; add it"}})
        EXPECT_EQ(errorOf(point(std::string(R"("keyframes": {)") + keyframes + "}")),
                  std::string("/keyframes") + error);
    EXPECT_EQ(errorOf(R"({"type": "directional", "direction": [1, 0, 0], "keyframes": {
                  "direction": {"times": [0], "values": [[0, 0, 0]]}}})"),
              "/keyframes/direction/values/0: has no length; give a direction");
    EXPECT_EQ(errorBeyondSchemaOf(point(R"("keyframes": {"intensity": {"times": [3, 2], "values": [1, 2]}})")),
              "/keyframes/intensity/times/1: is 2, which does not follow 3; times must ascend");
}

TEST_F(SceneJsonLights, brokenAnimationsAreRefused) {
    EXPECT_EQ(lightOf(point(R"("flicker": {"amplitude": 0.25, "seed": 7})")).flicker,
              (LightFlicker{.amplitude = 0.25, .seed = 7}));
    const auto animated = [](const std::string& animation) { return point(R"("animation": {)" + animation + "}"); };
    for (const auto& [animation, error] :
         {std::pair(R"("type": "orbit", "periodSeconds": 0)", "/periodSeconds: is 0; more than 0 is needed"),
          {R"("type": "orbit", "axis": [0, 0, 0], "periodSeconds": 1)", "/axis: has no length; give a direction"},
          {R"("type": "path", "points": [[0, 0, 0]], "periodSeconds": 1)",
           "/points: has 1 elements; at least 2 are needed"},
          {R"("type": "path", "points": [[0, 0, 0], [1, 0, 0]], "periodSeconds": 1, "line": "b")",
           "/line: there is no line of a path 'b'; valid are straight, catmull_rom"},
          {R"("type": "wobble", "periodSeconds": 1)", ": lacks the key 'amplitude'; add it"},
          {R"("type": "keyframes", "periodSeconds": 1, "times": [0], "points": [[0, 0, 0]])",
           ": a keyframes animation has no key 'periodSeconds'; valid are type, times, points, interpolation, repeat"},
          {R"("type": "spin")", "/type: there is no animation 'spin'; valid are orbit, wobble, path, keyframes"},
          {R"("type": "keyframes", "times": [1], "points": [[0, 0, 0]], "interpolation": "wild")",
           "/interpolation: there is no interpolation 'wild'; valid are linear, step, cubic_spline"}})
        EXPECT_EQ(errorOf(animated(animation)), std::string("/animation") + error);
    const std::string ahead =
        R"("type": "path", "points": [[0, 0, 0], [1, 0, 0]], "periodSeconds": 1, "lookAhead": true)";
    for (const auto& [animation, error] :
         {std::pair<std::string, const char*>(
              R"("type": "path", "points": [[1, 2, 3], [1, 2, 3], [1, 2, 3]], "periodSeconds": 1)",
              "/points: are all one place, and a path needs a length; move one of them"),
          {ahead, "/lookAhead: a point light has no direction; leave this out"},
          {R"("type": "keyframes", "times": [1, 1], "points": [[0, 0, 0], [0, 0, 0]])",
           "/times/1: is 1, which does not follow 1; times must ascend"},
          {R"("type": "keyframes", "times": [1, 2], "points": [[0, 0, 0]])",
           "/points: has 1 elements for 2 times; give one for each"},
          {R"("type": "keyframes", "times": [1], "points": [[0, 0, 0]], "interpolation": "cubic_spline",
              "inTangents": [[0, 0, 0], [0, 0, 0]], "outTangents": [[0, 0, 0]])",
           "/inTangents: has 2 elements for 1 times; give one for each"}})
        EXPECT_EQ(errorBeyondSchemaOf(animated(animation)), std::string("/animation") + error);
    EXPECT_EQ(errorBeyondSchemaOf(R"({"type": "spot", "position": [0, 0, 0], "direction": [0, 1, 0],
                  "keyframes": {"direction": {"times": [0], "values": [[0, 1, 0]]}}, "animation": {)" +
                                  ahead + "}}"),
              "/animation/lookAhead: the light's direction has keyframes; keep one of both");
    EXPECT_EQ(errorOf(R"({"type": "directional", "direction": [1, 0, 0], "animation": {"type": "orbit"}})"),
              ": a directional light has no key 'animation'; valid are type, name, enabled, color, intensity, "
              "flicker, keyframes, direction, castsShadow, angularRadiusDegrees, fields");
}

} // namespace
} // namespace tessera::scenes
