#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using test::SceneFolder;

Camera cameraOf(const SceneFolder& folder, const std::string& camera) {
    return folder.import(R"({"tessera": 1, "cameras": [)" + camera + "]}").cameras.at(0);
}

std::string errorOfCamera(const SceneFolder& folder, const std::string& camera) {
    return folder.errorOf(R"({"tessera": 1, "cameras": [)" + camera + "]}");
}

TEST(SceneJsonCameras, aCameraLooksFromItsPositionAtItsTarget) {
    const SceneFolder folder;
    const Camera camera = cameraOf(
        folder,
        R"({"name": "c", "position": [5, 0, 0], "target": [0, 0, 0], "fovYDegrees": 90, "near": 2, "far": 30})");
    EXPECT_EQ(camera.name, "c");
    EXPECT_EQ(camera.projection, Projection::Perspective);
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[3]), glm::dvec3(5, 0, 0));
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[2]), glm::dvec3(1, 0, 0));
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[1]), glm::dvec3(0, 1, 0));
    EXPECT_DOUBLE_EQ(camera.fovYRadians, std::numbers::pi / 2);
    EXPECT_EQ(camera.nearMetres, 2.0);
    EXPECT_EQ(camera.farMetres, 30.0);
    const Camera plain = cameraOf(folder, R"({"position": [0, 0, 1], "direction": [0, 0, -2]})");
    EXPECT_EQ(plain.name, "camera 0");
    EXPECT_EQ(glm::dvec3(plain.worldFromCamera[2]), glm::dvec3(0, 0, 1));
    EXPECT_EQ(plain.farMetres, std::numeric_limits<double>::infinity());
}

TEST(SceneJsonCameras, upTurnsThePicture) {
    const SceneFolder folder;
    const Camera camera = cameraOf(folder, R"({"position": [0, 0, 1], "direction": [0, 0, -1], "up": [3, 0, 0]})");
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[1]), glm::dvec3(1, 0, 0));
}

TEST(SceneJsonCameras, anOrthographicCameraHasItsHalfHeight) {
    const SceneFolder folder;
    const Camera camera = cameraOf(
        folder,
        R"({"type": "orthographic", "position": [0, 9, 0], "direction": [0, -1, 0], "halfHeight": 3, "near": 0})");
    EXPECT_EQ(camera.projection, Projection::Orthographic);
    EXPECT_EQ(camera.halfHeightMetres, 3.0);
    EXPECT_EQ(camera.nearMetres, 0.0);
    EXPECT_EQ(errorOfCamera(folder, R"({"type": "orthographic", "position": [0, 9, 0], "direction": [0, -1, 0]})"),
              "/cameras/0: lacks the key 'halfHeight'; add it");
}

TEST(SceneJsonCameras, aMatrixPlacesTheCamera) {
    const SceneFolder folder;
    const Camera camera = cameraOf(folder, R"({"matrix": [0, 0, -1, 0,  0, 1, 0, 0,  1, 0, 0, 0,  4, 5, 6, 1]})");
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[2]), glm::dvec3(1, 0, 0));
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[3]), glm::dvec3(4, 5, 6));
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  R"({"tessera": 1, "cameras": [{"matrix": [2, 0, 0, 0,  0, 2, 0, 0,  0, 0, 2, 0,  0, 0, 0, 1]}]})"),
              "/cameras/0/matrix: a camera's matrix must only rotate and move; remove its scale");
    EXPECT_EQ(
        errorOfCamera(folder, R"({"matrix": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1], "up": [0, 1, 0]})"),
        "/cameras/0/up: is given beside 'matrix'; keep one");
    EXPECT_EQ(errorOfCamera(folder, R"({"matrix": [1, 0, 0]})"),
              "/cameras/0/matrix: has 3 elements; exactly 16 are needed");
}

TEST(SceneJsonCameras, impossibleCamerasAreRefused) {
    const SceneFolder folder;
    const std::string start = R"({"position": [0, 0, 1], "target": [0, 0, 0], )";
    EXPECT_EQ(errorOfCamera(folder, start + R"("fovYDegrees": 180})"),
              "/cameras/0/fovYDegrees: is 180; less than 180 is needed");
    EXPECT_EQ(errorOfCamera(folder, start + R"("fovYDegrees": 0})"),
              "/cameras/0/fovYDegrees: is 0; more than 0 is needed");
    EXPECT_EQ(errorOfCamera(folder, start + R"("near": 0})"), "/cameras/0/near: is 0; more than 0 is needed");
    EXPECT_EQ(errorOfCamera(folder, start + R"("direction": [0, 0, 1]})"),
              "/cameras/0/target: is given beside 'direction'; keep one");
    EXPECT_EQ(errorOfCamera(folder, start + R"("type": "fisheye"})"),
              "/cameras/0/type: there is no projection 'fisheye'; valid are perspective, orthographic");
    EXPECT_EQ(errorOfCamera(folder, R"({"position": [0, 0, 1]})"), "/cameras/0: lacks the key 'target'; add it");
    EXPECT_EQ(
        folder.errorBeyondSchemaOf(R"({"tessera": 1, "cameras": [{"position": [0, 0, 1], "target": [0, 0, 1]}]})"),
        "/cameras/0/target: is the camera's own position; give another point");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "cameras": [)" + start + R"("near": 2, "far": 2}]})"),
              "/cameras/0/far: is 2, not beyond the near plane at 2; move it away");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  R"({"tessera": 1, "cameras": [{"name": "a", "position": [0, 0, 1], "target": [0, 0, 0]},
                                                {"name": "a", "position": [0, 0, 1], "target": [0, 0, 0]}]})"),
              "/cameras/1: the name 'a' is taken by element 0; give another");
}

TEST(SceneJsonOptions, optionsAndBackgroundAreKept) {
    const SceneFolder folder;
    const Scene scene = folder.import(R"({"tessera": 1,
        "cameras": [{"name": "front", "position": [0, 0, 1], "target": [0, 0, 0]}],
        "environment": {"background": [0.5, 1, 2]},
        "options": {"technique": "deferred", "camera": "front", "prune": false, "exposureEV": -1.5,
                    "size": [640, 361]}})");
    EXPECT_EQ(scene.background, glm::vec3(0.5f, 1, 2));
    EXPECT_EQ(scene.options.camera, "front");
    const std::map<std::string, Wish, std::less<>> wishes{
        {"technique", "deferred"}, {"prune", false}, {"exposureEV", -1.5}, {"size", std::vector<double>{640, 361}}};
    EXPECT_EQ(scene.options.wishes, wishes);
    EXPECT_EQ(folder.import(R"({"tessera": 1})").options, SceneOptions());
}

TEST(SceneJsonOptions, wrongOptionsAreRefused) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "options": {"size": [0, "1"]}})"),
              "/options/size/1: is text; a number is needed");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "options": {"layout": null}})"),
              "/options/layout: is no setting's value; give a name, a number, true or false, or an array of numbers");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "options": {"layout": ""}})"), "/options/layout: is empty; give a name");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "options": {"defaultLight": 1}})"),
              "/options/defaultLight: is a number; true or false is needed");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "options": {"clip": 1}})"),
              "/options/clip: is a number; text is needed");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "options": {"clip": "run"}})"),
              "/options/clip: the scene has no clip, so none is called 'run'; leave it out");
    EXPECT_EQ(folder.import(R"({"tessera": 1, "options": {"clip": "none"}})").options.clip, "none");
    const auto many = test::listOf(257, [](int i) { return fmt::format("\"k{}\": 1", i); });
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "options": {)" + many + "}}"),
              "/options: has 257 members; at most 256 are allowed");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "options": {"camera": "back"}})"),
              "/options/camera: there is no camera 'back'; there are none");
}

} // namespace
} // namespace tessera::scenes
