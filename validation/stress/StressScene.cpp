#include "validation/stress/StressScene.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Shapes.h"
#include "validation/stress/StressModels.h"
#include "validation/stress/StressRandom.h"

namespace tessera::validation {

using namespace scenes::builtin;

scenes::Light stressLight(const glm::dvec3& positionWS, float candela) {
    scenes::Light light;
    light.positionWS = positionWS;
    light.intensity = candela;
    return light;
}

void moveScene(scenes::Scene& scene, double scale, const glm::dvec3& offsetWS) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), offsetWS) * glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
    for (scenes::Node& node : scene.nodes)
        if (node.parent == scenes::kNone) node.parentFromNode = moved * node.parentFromNode;
    for (scenes::Light& light : scene.lights) {
        light.positionWS = offsetWS + scale * light.positionWS;
        light.intensity *= float(scale * scale);
    }
    for (scenes::Camera& camera : scene.cameras) {
        camera.worldFromCamera[3] = glm::dvec4(offsetWS + scale * glm::dvec3(camera.worldFromCamera[3]), 1.0);
        camera.nearMetres *= scale;
        camera.farMetres *= scale;
        camera.halfHeightMetres *= scale;
    }
}

int addUniformImage(scenes::Scene& scene, const glm::ivec4& texel) {
    constexpr int kSide = 8;
    scenes::Image image;
    image.name = "uniform";
    image.width = image.height = kSide;
    for (int i = 0; i < kSide * kSide; ++i)
        for (int c = 0; c < 4; ++c) image.texels.push_back(std::byte(texel[c]));
    return addImage(scene, std::move(image));
}

scenes::Scene stressScene() {
    scenes::Scene scene;
    scene.name = "stress";
    const int stone = addMaterial(scene, lambert("floor", {0.6f, 0.5f, 0.4f}));
    scenes::Mesh floor, ball, board;
    appendFloor(floor, glm::dvec3(0.0), {4.0, 4.0}, {4, 4});
    appendSphere(ball, glm::dvec3(0.0), 0.4, 24, 16);
    appendQuad(board, {-0.44, 0.0, 0.0}, {0.44, 0.0, 0.0}, {0.44, 1.0, 0.0}, {-0.44, 1.0, 0.0});
    addNode(scene, "floor", glm::dmat4(1.0), {{addMesh(scene, "floor", floor), stone}});
    const int ballMesh = addMesh(scene, "ball", ball), boardMesh = addMesh(scene, "board", board);
    const auto count = double(stressModels().size());
    double place = 0.0;
    for (const StressModel& model : stressModels()) {
        scenes::Material material;
        material.name = scenes::infoOf(model.model).name;
        material.model = model.model;
        material.baseColor = {0.7f, 0.3f, 0.2f, 1.0f};
        material.metallic = 0.5f;
        if (model.setRoughness) model.setRoughness(material, 0.6);
        const int index = addMaterial(scene, material);
        const double x = 0.9 * (place - 0.5 * (count - 1.0));
        addNode(scene, material.name, glm::translate(glm::dmat4(1.0), {x, 0.5, 0.6}), {{ballMesh, index}});
        const glm::dmat4 lean = glm::rotate(glm::dmat4(1.0), glm::radians(-20.0), glm::dvec3(1, 0, 0));
        addNode(scene, "board", glm::translate(glm::dmat4(1.0), {x, 0.1, -1.2}) * lean, {{boardMesh, index}});
        place += 1.0;
    }
    scene.lights = {stressLight({1.0, 2.5, 1.5}, 20.0f), stressLight({-2.0, 3.0, 2.0}, 30.0f)};
    scene.lights[1].type = scenes::LightType::Spot;
    scene.lights[1].directionWS = glm::normalize(glm::dvec3(2.0, -2.5, -2.0));
    addCamera(scene, "front", {0.0, 2.5, 4.5}, {0.0, 0.4, 0.0}, 40.0);
    return scene;
}

scenes::Scene stressFloor() {
    scenes::Scene scene;
    scene.name = "stress floor";
    const int white = addMaterial(scene, lambert("floor", glm::vec3(1.0f)));
    scenes::Mesh floor;
    // Off-centre: no pixel's centre lies on the diagonal, where either triangle would be right.
    appendFloor(floor, {0.013, 0.0, 0.0}, {2.2, 2.2}, {1, 1});
    addNode(scene, "floor", glm::dmat4(1.0), {{addMesh(scene, "floor", floor), white}});
    scenes::Camera camera;
    camera.name = "above";
    camera.worldFromCamera = scenes::worldFromLookAt({0.0, 2.0, 0.0}, glm::dvec3(0.0), {0.0, 0.0, -1.0});
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 1.0;
    scene.cameras = {camera};
    return scene;
}

namespace {

/// Adds a camera at `eyeMetres`, above and to a side, whose view a circle of `radiusMetres` about the origin fills.
void addFarCamera(scenes::Scene& scene, double eyeMetres, double radiusMetres) {
    const glm::dvec3 directionWS = glm::normalize(glm::dvec3(0.48, 0.6, 0.64));
    addCamera(scene, "far", eyeMetres * directionWS, glm::dvec3(0.0),
              glm::degrees(2.0 * std::atan(radiusMetres / eyeMetres)));
}

} // namespace

scenes::Scene stressFarFloor(double eyeMetres) {
    scenes::Scene scene;
    scene.name = "far floor";
    scenes::Mesh floor;
    appendFloor(floor, glm::dvec3(0.0), {1.0, 1.0}, {1, 1});
    const int stone = addMaterial(scene, microfacet("floor", {0.6f, 0.5f, 0.4f}, 1.5f, 0.4f));
    addNode(scene, "floor", glm::dmat4(1.0), {{addMesh(scene, "floor", floor), stone}});
    addFarCamera(scene, eyeMetres, 0.45);
    return scene;
}

scenes::Scene stressFarBall(double eyeMetres, int lights) {
    scenes::Scene scene;
    scene.name = "far ball";
    scenes::Mesh ball;
    appendSphere(ball, glm::dvec3(0.0), 0.5, 96, 64);
    const int stone = addMaterial(scene, microfacet("ball", {0.6f, 0.5f, 0.4f}, 1.5f, 0.4f));
    addNode(scene, "ball", glm::dmat4(1.0), {{addMesh(scene, "ball", ball), stone}});
    StressRandom random(77);
    for (int i = 0; i < lights; ++i) {
        scene.lights.push_back(stressLight(random.direction() * (0.5 + random.logarithmic(0.01, 0.3)), 0.02f));
        scene.lights.back().rangeMetres = 0.4f;
    }
    addFarCamera(scene, eyeMetres, 0.55);
    return scene;
}

} // namespace tessera::validation
