#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class SceneJsonCameras : public OneElement {
protected:
    SceneJsonCameras() : OneElement("cameras") {}
    Camera cameraOf(const std::string& camera) const { return import(camera).cameras.at(0); }
};
using SceneJsonOptions = SceneFiles;

/// A column of the camera's matrix.
glm::dvec3 columnOf(const Camera& camera, int column) {
    return glm::dvec3(camera.worldFromCamera[column]);
}

TEST_F(SceneJsonCameras, aCameraLooksFromItsPositionAtItsTarget) {
    const Camera camera = cameraOf(
        R"({"name": "c", "position": [5, 0, 0], "target": [0, 0, 0], "fovYDegrees": 90, "near": 2, "far": 30})");
    EXPECT_EQ(camera.name, "c");
    EXPECT_EQ(camera.projection, Projection::Perspective);
    EXPECT_EQ(columnOf(camera, 3), glm::dvec3(5, 0, 0));
    EXPECT_EQ(columnOf(camera, 2), glm::dvec3(1, 0, 0));
    EXPECT_EQ(columnOf(camera, 1), glm::dvec3(0, 1, 0));
    EXPECT_DOUBLE_EQ(camera.fovYRadians, std::numbers::pi / 2);
    EXPECT_EQ(camera.nearMetres, 2.0);
    EXPECT_EQ(camera.farMetres, 30.0);
    const Camera plain = cameraOf(R"({"position": [0, 0, 1], "direction": [0, 0, -2]})");
    EXPECT_EQ(plain.name, "camera 0");
    EXPECT_EQ(columnOf(plain, 2), glm::dvec3(0, 0, 1));
    EXPECT_EQ(plain.farMetres, std::numeric_limits<double>::infinity());
}

TEST_F(SceneJsonCameras, upTurnsThePicture) {
    const Camera camera = cameraOf(R"({"position": [0, 0, 1], "direction": [0, 0, -1], "up": [3, 0, 0]})");
    EXPECT_EQ(columnOf(camera, 1), glm::dvec3(1, 0, 0));
}

TEST_F(SceneJsonCameras, anOrthographicCameraHasItsHalfHeight) {
    const Camera camera = cameraOf(
        R"({"type": "orthographic", "position": [0, 9, 0], "direction": [0, -1, 0], "halfHeight": 3, "near": 0})");
    EXPECT_EQ(camera.projection, Projection::Orthographic);
    EXPECT_EQ(camera.halfHeightMetres, 3.0);
    EXPECT_EQ(camera.nearMetres, 0.0);
    EXPECT_EQ(errorOf(R"({"type": "orthographic", "position": [0, 9, 0], "direction": [0, -1, 0]})"),
              ": lacks the key 'halfHeight'; add it");
}

TEST_F(SceneJsonCameras, aMatrixPlacesTheCamera) {
    const Camera camera = cameraOf(R"({"matrix": [0, 0, -1, 0,  0, 1, 0, 0,  1, 0, 0, 0,  4, 5, 6, 1]})");
    EXPECT_EQ(columnOf(camera, 2), glm::dvec3(1, 0, 0));
    EXPECT_EQ(columnOf(camera, 3), glm::dvec3(4, 5, 6));
    EXPECT_EQ(errorBeyondSchemaOf(R"({"matrix": [2, 0, 0, 0,  0, 2, 0, 0,  0, 0, 2, 0,  0, 0, 0, 1]})"),
              "/matrix: a camera's matrix must only rotate and move; remove its scale");
    EXPECT_EQ(errorOf(R"({"matrix": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1], "up": [0, 1, 0]})"),
              "/up: is given beside 'matrix'; keep one");
    EXPECT_EQ(errorOf(R"({"matrix": [1, 0, 0]})"), "/matrix: has 3 elements; exactly 16 are needed");
}

TEST_F(SceneJsonCameras, impossibleCamerasAreRefused) {
    const std::string start = R"({"position": [0, 0, 1], "target": [0, 0, 0], )";
    for (const auto& [camera, error] :
         {std::pair<std::string, std::string>(start + R"("fovYDegrees": 180})",
                                              "/fovYDegrees: is 180; less than 180 is needed"),
          {start + R"("fovYDegrees": 0})", "/fovYDegrees: is 0; more than 0 is needed"},
          {start + R"("near": 0})", "/near: is 0; more than 0 is needed"},
          {start + R"("direction": [0, 0, 1]})", "/target: is given beside 'direction'; keep one"},
          {start + R"("type": "fisheye"})",
           "/type: there is no projection 'fisheye'; valid are perspective, orthographic"},
          {R"({"position": [0, 0, 1]})", ": lacks the key 'target'; add it"}})
        EXPECT_EQ(errorOf(camera), error);
    EXPECT_EQ(errorBeyondSchemaOf(R"({"position": [0, 0, 1], "target": [0, 0, 1]})"),
              "/target: is the camera's own position; give another point");
    EXPECT_EQ(errorBeyondSchemaOf(start + R"("near": 2, "far": 2})"),
              "/far: is 2, not beyond the near plane at 2; move it away");
    EXPECT_EQ(folder.errorBeyondSchemaOf(document(start + R"("name": "a"}, )" + start + R"("name": "a"})")),
              "/cameras/1: the name 'a' is taken by element 0; give another");
}

TEST_F(SceneJsonOptions, optionsAndBackgroundAreKept) {
    const Scene scene = folder.import(R"({"tessera": 1,
        "cameras": [{"name": "front", "position": [0, 0, 1], "target": [0, 0, 0]}],
        "environment": {"background": [0.5, 1, 2]},
        "options": {"technique": "deferred", "camera": "front", "prune": false, "exposureEV": -1.5,
                    "size": [640, 361]}})");
    EXPECT_EQ(scene.background, glm::vec3(0.5f, 1, 2));
    EXPECT_EQ(scene.options.camera, "front");
    const std::map<std::string, OptionValue, std::less<>> requested{
        {"technique", "deferred"}, {"prune", false}, {"exposureEV", -1.5}, {"size", std::vector<double>{640, 361}}};
    EXPECT_EQ(scene.options.requested, requested);
    EXPECT_EQ(folder.import(R"({"tessera": 1})").options, SceneOptions());
}

TEST_F(SceneJsonOptions, wrongOptionsAreRefused) {
    const auto with = [](const std::string& options) { return R"({"tessera": 1, "options": {)" + options + "}}"; };
    for (const auto& [option, error] :
         {std::pair(R"("size": [0, "1"])", "/size/1: is text; a number is needed"),
          {R"("layout": null)",
           "/layout: is no setting's value; give a name, a number, true or false, or an array of numbers"},
          {R"("layout": "")", "/layout: is empty; give a name"},
          {R"("defaultLight": 1)", "/defaultLight: is a number; true or false is needed"},
          {R"("clip": 1)", "/clip: is a number; text is needed"}})
        EXPECT_EQ(folder.errorOf(with(option)), std::string("/options") + error);
    EXPECT_EQ(folder.errorBeyondSchemaOf(with(R"("clip": "run")")),
              "/options/clip: the scene has no clip, so none is called 'run'; leave it out");
    EXPECT_EQ(folder.import(with(R"("clip": "none")")).options.clip, "none");
    const auto many = listOf(257, [](int i) { return fmt::format("\"k{}\": 1", i); });
    EXPECT_EQ(folder.errorOf(with(many)), "/options: has 257 members; at most 256 are allowed");
    EXPECT_EQ(folder.errorBeyondSchemaOf(with(R"("camera": "back")")),
              "/options/camera: there is no camera 'back'; there are none");
}

} // namespace
} // namespace tessera::scenes
