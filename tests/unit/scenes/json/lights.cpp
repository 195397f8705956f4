#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using test::SceneFolder;
using testing::ElementsAre;

Light lightOf(const SceneFolder& folder, const std::string& light) {
    return folder.import(R"({"tessera": 1, "lights": [)" + light + "]}").lights.at(0);
}

std::string errorOfLight(const SceneFolder& folder, const std::string& light) {
    return folder.errorOf(R"({"tessera": 1, "lights": [)" + light + "]}");
}

std::string point(const std::string& members) {
    return R"({"type": "point", "position": [1, 2, 3])" + (members.empty() ? members : ", " + members) + "}";
}

TEST(SceneJsonLights, aPointLightHasItsStatedValues) {
    const SceneFolder folder;
    const Light plain = lightOf(folder, point(""));
    EXPECT_EQ(plain.name, "light 0");
    EXPECT_EQ(plain.type, LightType::Point);
    EXPECT_TRUE(plain.enabled);
    EXPECT_EQ(plain.positionWS, glm::dvec3(1, 2, 3));
    EXPECT_EQ(plain.falloff, Falloff::InverseSquare);
    EXPECT_EQ(plain.rangeMetres, kInfinity);
    const Light light =
        lightOf(folder, point(R"("name": "lamp", "enabled": false, "color": [0.5, 0.25, 0], "intensity": 40)"));
    EXPECT_EQ(light.name, "lamp");
    EXPECT_FALSE(light.enabled);
    EXPECT_FALSE(light.castsShadow);
    EXPECT_TRUE(lightOf(folder, point(R"("castsShadow": true)")).castsShadow);
    EXPECT_EQ(light.radiusMetres, 0.0f);
    EXPECT_EQ(lightOf(folder, point(R"("radius": 0.25)")).radiusMetres, 0.25f);
    EXPECT_EQ(light.color, glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(light.intensity, 40.0f);
}

TEST(SceneJsonLights, lightsAreInDocumentOrderAfterIncludedOnes) {
    const SceneFolder folder;
    const Scene scene = folder.import(R"({"tessera": 1, "lights": [
        {"name": "b", "type": "point", "position": [0, 0, 0]}, {"name": "a", "type": "point", "position": [0, 0, 0]}],
        "include": [{"file": "parts/lamps.json"}]})");
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[1].name, "b");
    EXPECT_EQ(scene.lights[2].name, "a");
}

TEST(SceneJsonLights, bothFalloffsAreKept) {
    const SceneFolder folder;
    const Light window = lightOf(folder, point(R"("falloff": {"type": "inverse_square", "range": 12})"));
    EXPECT_EQ(window.falloff, Falloff::InverseSquare);
    EXPECT_EQ(window.rangeMetres, 12.0f);
    const Light coefficients = lightOf(folder, point(R"("falloff": {"type": "attenuation", "A": 1, "C": 0.5})"));
    EXPECT_EQ(coefficients.falloff, Falloff::Attenuation);
    EXPECT_EQ(coefficients.attenuation, glm::vec3(1, 0, 0.5f));
}

TEST(SceneJsonLights, attenuationWithoutOrBelowZeroIsRefused) {
    const SceneFolder folder;
    for (const char* falloff : {R"({"type": "attenuation"})", R"({"type": "attenuation", "A": 0, "B": 0, "C": 0})"})
        EXPECT_EQ(errorOfLight(folder, point(std::string(R"("falloff": )") + falloff)),
                  "/lights/0/falloff: the attenuation coefficients A, B and C are all 0, which divides by 0; give at "
                  "least one above 0");
    EXPECT_EQ(errorOfLight(folder, point(R"("falloff": {"type": "attenuation", "A": 1, "B": -0.5})")),
              "/lights/0/falloff/B: the attenuation coefficient B is -0.5; it must not be negative");
    EXPECT_EQ(errorOfLight(folder, point(R"("falloff": {"type": "attenuation", "A": 1, "range": 5})")),
              "/lights/0/falloff: an attenuation falloff has no key 'range'; valid are type, A, B, C");
    EXPECT_EQ(errorOfLight(folder, point(R"("falloff": {"type": "linear"})")),
              "/lights/0/falloff/type: there is no falloff 'linear'; valid are inverse_square, attenuation");
}

TEST(SceneJsonLights, directionsAreOfUnitLength) {
    const SceneFolder folder;
    const Light sun = lightOf(folder, R"({"type": "directional", "direction": [0, -3, -4]})");
    EXPECT_EQ(sun.type, LightType::Directional);
    // One rounding of a square root in double precision.
    EXPECT_NEAR(sun.directionWS.y, -0.6, 1e-15);
    EXPECT_NEAR(sun.directionWS.z, -0.8, 1e-15);
    EXPECT_EQ(lightOf(folder, R"({"type": "directional", "direction": [1e300, 0, 0]})").directionWS,
              glm::dvec3(1, 0, 0));
    EXPECT_EQ(errorOfLight(folder, R"({"type": "directional", "direction": [0, 0, 0]})"),
              "/lights/0/direction: has no length; give a direction");
    EXPECT_EQ(errorOfLight(folder, R"({"type": "directional"})"), "/lights/0: lacks the key 'direction'; add it");
}

TEST(SceneJsonLights, aSpotLightHasItsConesInRadians) {
    const SceneFolder folder;
    const Light spot = lightOf(folder, R"({"type": "spot", "position": [0, 2, 0], "target": [0, 0, 0],
                                           "innerDegrees": 30, "outerDegrees": 60})");
    EXPECT_EQ(spot.directionWS, glm::dvec3(0, -1, 0));
    constexpr float kPi = std::numbers::pi_v<float>;
    EXPECT_FLOAT_EQ(spot.innerConeRadians, kPi / 6);
    EXPECT_FLOAT_EQ(spot.outerConeRadians, kPi / 3);
    const Light plain = lightOf(folder, R"({"type": "spot", "position": [0, 2, 0], "direction": [1, 0, 0]})");
    EXPECT_EQ(plain.directionWS, glm::dvec3(1, 0, 0));
    EXPECT_EQ(plain.innerConeRadians, 0.0f);
    EXPECT_FLOAT_EQ(plain.outerConeRadians, kPi / 4);
}

TEST(SceneJsonLights, impossibleSpotsAreRefused) {
    const SceneFolder folder;
    const std::string start = R"({"type": "spot", "position": [0, 2, 0], )";
    EXPECT_EQ(
        folder.errorBeyondSchemaOf(R"({"tessera": 1, "lights": [)" + start +
                                   R"("direction": [1, 0, 0], "innerDegrees": 50, "outerDegrees": 45}]})"),
        "/lights/0/innerDegrees: is 50, wider than the half angle of the outer cone of 45 degrees; make it narrower");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "lights": [)" + start + R"("target": [0, 2, 0]}]})"),
              "/lights/0/target: is the light's own position; give another point");
    EXPECT_EQ(errorOfLight(folder, start + R"("direction": [1, 0, 0], "outerDegrees": 91})"),
              "/lights/0/outerDegrees: is 91; at most 90 is allowed");
    EXPECT_EQ(errorOfLight(folder, start + R"("direction": [1, 0, 0], "target": [0, 0, 0]})"),
              "/lights/0/target: is given beside 'direction'; keep one");
}

TEST(SceneJsonLights, typesThatThereAreNotAreRefusedByName) {
    const SceneFolder folder;
    EXPECT_EQ(errorOfLight(folder, R"({"type": "area"})"),
              "/lights/0/type: 'area' names no shape; types of area lights are rectangle, disk, sphere, tube, polygon");
    EXPECT_EQ(errorOfLight(folder, R"({"type": "environment"})"),
              "/lights/0/type: light from everywhere is no light of this list; give the document a key 'environment'");
    EXPECT_EQ(errorOfLight(folder, R"({"type": "spott"})"),
              "/lights/0/type: there is no light type 'spott'; did you mean 'spot'?");
}

TEST(SceneJsonLights, numbersOutOfRangeAreRefused) {
    const SceneFolder folder;
    EXPECT_EQ(errorOfLight(folder, point(R"("intensity": -1)")), "/lights/0/intensity: is -1; at least 0 is needed");
    EXPECT_EQ(errorOfLight(folder, point(R"("intensity": 1e39)")),
              "/lights/0/intensity: is 1e+39; at most 3.4028234663852886e+38 is allowed");
    EXPECT_EQ(errorOfLight(folder, point(R"("color": [1, 1])")),
              "/lights/0/color: has 2 elements; exactly 3 are needed");
    EXPECT_EQ(errorOfLight(folder, point(R"("color": [1, 1, 1, 1])")),
              "/lights/0/color: has 4 elements; exactly 3 are needed");
    EXPECT_EQ(errorOfLight(folder, point(R"("color": [1, -1, 1])")), "/lights/0/color/1: is -1; at least 0 is needed");
    EXPECT_EQ(errorOfLight(folder, point(R"("enabled": 1)")),
              "/lights/0/enabled: is a number; true or false is needed");
    EXPECT_EQ(errorOfLight(folder, point(R"("falloff": {"type": "inverse_square", "range": -2})")),
              "/lights/0/falloff/range: is -2; at least 0 is needed");
}

TEST(SceneJsonLights, everyAnimationMovesTheLight) {
    const SceneFolder folder;
    const auto positionAt = [&](const std::string& animation, double seconds) {
        return lightAtTime(lightOf(folder, point(R"("animation": )" + animation)), seconds).positionWS;
    };
    const auto expectNear = [](const glm::dvec3& a, const glm::dvec3& b) {
        EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z; // rounding of sine and cosine
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
    // The middle of a square's side is an eighth of it farther out on the curve.
    expectNear(positionAt(R"({"type": "path", "points": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
                              "line": "catmull_rom", "periodSeconds": 8})",
                          1.0),
               {0, -1.25, 0});
    EXPECT_EQ(lightAtTime(lightOf(folder, R"({"type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0],
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

TEST(SceneJsonLights, keyframesAreOfDirectionColourAndIntensity) {
    const SceneFolder folder;
    const Light light =
        lightOf(folder, R"({"type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0], "keyframes": {
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

TEST(SceneJsonLights, brokenKeyframesAreRefused) {
    const SceneFolder folder;
    const auto error = [&](const std::string& keyframes) {
        return errorOfLight(folder, point(R"("keyframes": )" + keyframes));
    };
    EXPECT_EQ(error(R"({"direction": {"times": [0], "values": [[0, 1, 0]]}})"),
              "/lights/0/keyframes: an object of keyframes of a point light has no key 'direction'; valid are color, "
              "intensity");
    EXPECT_EQ(error(R"({"intensity": {"times": [0], "values": [-1]}})"),
              "/lights/0/keyframes/intensity/values/0: is -1; at least 0 is needed");
    EXPECT_EQ(error(R"({"color": {"times": [0], "values": [[1, -1, 1]]}})"),
              "/lights/0/keyframes/color/values/0/1: is -1; at least 0 is needed");
    EXPECT_EQ(error(R"({"intensity": {"times": [0]}})"),
              "/lights/0/keyframes/intensity: lacks the key 'values'; add it");
    EXPECT_EQ(errorOfLight(folder, R"({"type": "directional", "direction": [1, 0, 0], "keyframes": {
                  "direction": {"times": [0], "values": [[0, 0, 0]]}}})"),
              "/lights/0/keyframes/direction/values/0: has no length; give a direction");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "lights": [)" +
                                         point(R"("keyframes": {"intensity": {"times": [3, 2], "values": [1, 2]}})") +
                                         "]}"),
              "/lights/0/keyframes/intensity/times/1: is 2, which does not follow 3; times must ascend");
}

TEST(SceneJsonLights, brokenAnimationsAreRefused) {
    const SceneFolder folder;
    EXPECT_EQ(lightOf(folder, point(R"("flicker": {"amplitude": 0.25, "seed": 7})")).flicker,
              (LightFlicker{.amplitude = 0.25, .seed = 7}));
    EXPECT_EQ(errorOfLight(folder, point(R"("flicker": {"frequencyHz": 0})")),
              "/lights/0/flicker/frequencyHz: is 0; more than 0 is needed");
    EXPECT_EQ(errorOfLight(folder, point(R"("flicker": {"frequencyHz": 2000})")),
              "/lights/0/flicker/frequencyHz: is 2000; at most 1000 is allowed");
    const auto animationError = [&](const std::string& animation) {
        return errorOfLight(folder, point(R"("animation": )" + animation));
    };
    const auto beyondSchema = [&](const std::string& animation) {
        return folder.errorBeyondSchemaOf(R"({"tessera": 1, "lights": [)" + point(R"("animation": )" + animation) +
                                          "]}");
    };
    EXPECT_EQ(animationError(R"({"type": "orbit", "periodSeconds": 0})"),
              "/lights/0/animation/periodSeconds: is 0; more than 0 is needed");
    EXPECT_EQ(animationError(R"({"type": "orbit", "axis": [0, 0, 0], "periodSeconds": 1})"),
              "/lights/0/animation/axis: has no length; give a direction");
    EXPECT_EQ(animationError(R"({"type": "path", "points": [[0, 0, 0]], "periodSeconds": 1})"),
              "/lights/0/animation/points: has 1 elements; at least 2 are needed");
    EXPECT_EQ(beyondSchema(R"({"type": "path", "points": [[1, 2, 3], [1, 2, 3], [1, 2, 3]], "periodSeconds": 1})"),
              "/lights/0/animation/points: are all one place, and a path needs a length; move one of them");
    EXPECT_EQ(animationError(R"({"type": "path", "points": [[0, 0, 0], [1, 0, 0]], "periodSeconds": 1, "line": "b"})"),
              "/lights/0/animation/line: there is no line of a path 'b'; valid are straight, catmull_rom");
    const std::string ahead =
        R"("animation": {"type": "path", "points": [[0, 0, 0], [1, 0, 0]], "periodSeconds": 1, "lookAhead": true})";
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "lights": [)" + point(ahead) + "]}"),
              "/lights/0/animation/lookAhead: a point light has no direction; leave this out");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  R"({"tessera": 1, "lights": [{"type": "spot", "position": [0, 0, 0], "direction": [0, 1, 0],
                  "keyframes": {"direction": {"times": [0], "values": [[0, 1, 0]]}}, )" +
                  ahead + "}]}"),
              "/lights/0/animation/lookAhead: the light's direction has keyframes; keep one of both");
    EXPECT_EQ(animationError(R"({"type": "wobble", "periodSeconds": 1})"),
              "/lights/0/animation: lacks the key 'amplitude'; add it");
    EXPECT_EQ(animationError(R"({"type": "keyframes", "periodSeconds": 1, "times": [0], "points": [[0, 0, 0]]})"),
              "/lights/0/animation: a keyframes animation has no key 'periodSeconds'; valid are type, times, points, "
              "interpolation, repeat");
    EXPECT_EQ(animationError(R"({"type": "spin"})"),
              "/lights/0/animation/type: there is no animation 'spin'; valid are orbit, wobble, path, keyframes");
    EXPECT_EQ(beyondSchema(R"({"type": "keyframes", "times": [1, 1], "points": [[0, 0, 0], [0, 0, 0]]})"),
              "/lights/0/animation/times/1: is 1, which does not follow 1; times must ascend");
    EXPECT_EQ(beyondSchema(R"({"type": "keyframes", "times": [1, 2], "points": [[0, 0, 0]]})"),
              "/lights/0/animation/points: has 1 elements for 2 times; give one for each");
    EXPECT_EQ(beyondSchema(R"({"type": "keyframes", "times": [1], "points": [[0, 0, 0]],
                               "interpolation": "cubic_spline", "inTangents": [[0, 0, 0], [0, 0, 0]],
                               "outTangents": [[0, 0, 0]]})"),
              "/lights/0/animation/inTangents: has 2 elements for 1 times; give one for each");
    EXPECT_EQ(animationError(R"({"type": "keyframes", "times": [1], "points": [[0, 0, 0]], "interpolation": "wild"})"),
              "/lights/0/animation/interpolation: there is no interpolation 'wild'; valid are linear, step, "
              "cubic_spline");
    EXPECT_EQ(
        errorOfLight(folder, R"({"type": "directional", "direction": [1, 0, 0], "animation": {"type": "orbit"}})"),
        "/lights/0: a directional light has no key 'animation'; valid are type, name, enabled, color, intensity, "
        "flicker, keyframes, direction, castsShadow, angularRadiusDegrees, fields");
}

} // namespace
} // namespace tessera::scenes
