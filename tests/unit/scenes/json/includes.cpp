#include <cmath>
#include <set>

#include "tests/support/AssetsFolder.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/PictureBytes.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using SceneJsonInclude = SceneFiles;
using tessera::test::AssetsFolder;

std::string including(const std::string& include) {
    return R"({"tessera": 1, "include": [)" + include + "]}";
}

TEST_F(SceneJsonInclude, anIncludeIsANodeAboveTheFilesOwn) {
    const Scene scene = folder.import(including(
        R"({"file": "models/bust.obj"}, {"file": "models/bust.obj", "name": "second"}, {"file": "parts/lamps.json"})"));
    std::vector<std::string> names;
    std::vector<int> parents;
    for (const Node& node : scene.nodes) {
        names.push_back(node.name);
        parents.push_back(node.parent);
    }
    EXPECT_THAT(names, ElementsAre("bust", "bust", "second", "bust", "lamps", "lamp", "shade"));
    EXPECT_THAT(parents, ElementsAre(-1, 0, -1, 2, -1, 4, 5));
    EXPECT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.nodes[6].instances.at(0).mesh, 2);
    EXPECT_EQ(scene.materials.at(std::size_t(scene.nodes[6].instances[0].material)).name, "brass");
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("no material library defines 'brass'")));
}

TEST_F(SceneJsonInclude, picturesOfAnIncludeStayWithItsMaterials) {
    folder.write("models/paint.mtl", "newmtl paint\nmap_Kd ../pictures/specular.tga\n");
    folder.write("models/painted.obj", "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    folder.write("models/first.mtl", "newmtl paint\nmap_Kd ../pictures/albedo.tga\n");
    folder.write("models/first.obj", "mtllib first.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    const Scene scene = folder.import(including(R"({"file": "models/first.obj"}, {"file": "models/painted.obj"})"));
    const auto redOf = [&](std::size_t material) {
        const int image = scene.materials.at(material).texture(TextureSlot::BaseColor).image;
        return std::to_integer<int>(scene.images.at(std::size_t(image)).texels.at(0));
    };
    EXPECT_EQ(redOf(0), 10);
    EXPECT_EQ(redOf(1), 40);
}

TEST_F(SceneJsonInclude, transformsScaleThenRotateThenTranslate) {
    const auto placed = [&](const std::string& placement) {
        const Scene scene = folder.import(including(R"({"file": "models/bust.obj", )" + placement + "}"));
        return glm::dvec3(worldFromNodes(scene).at(1) * glm::dvec4(1.0, 2.0, 3.0, 1.0));
    };
    expectNear(placed(R"("transform": {})"), {1, 2, 3});
    expectNear(placed(R"("transform": {"translation": [10, 20, 30]})"), {11, 22, 33});
    expectNear(placed(R"("transform": {"scale": 2})"), {2, 4, 6});
    expectNear(placed(R"("transform": {"scale": [2, 3, -1]})"), {2, 6, -3});
    expectNear(placed(R"("transform": {"rotation": [0, 0, 1, 1]})"), {-2, 1, 3});
    expectNear(placed(R"("transform": {"eulerDegrees": [0, 0, 90]})"), {-2, 1, 3});
    // About X first: (1, -3, 2), then about Z: (3, 1, 2).
    expectNear(placed(R"("transform": {"eulerDegrees": [90, 0, 90]})"), {3, 1, 2});
    expectNear(placed(R"("transform": {"translation": [10, 0, 0], "scale": 2, "eulerDegrees": [0, 0, 90]})"),
               {6, 2, 6});
    expectNear(placed(R"("matrix": [0, 1, 0, 0,  -1, 0, 0, 0,  0, 0, 1, 0,  10, 0, 0, 1])"), {8, 1, 3});
}

TEST_F(SceneJsonInclude, lightsAndCamerasMoveAlong) {
    const Scene scene = folder.import(including(
        R"({"file": "parts/lamps.json", 
            "transform": {"scale": 2, "eulerDegrees": [0, 0, 90], "translation": [0, 0, 1]}})"));
    const Light& light = scene.lights.at(0);
    expectNear(light.positionWS, {-4, 2, 7});
    expectNear(light.directionWS, {0, 1, 0});
    EXPECT_EQ(light.rangeMetres, 7.0f);
    const glm::dmat4& camera = scene.cameras.at(0).worldFromCamera;
    expectNear(glm::dvec3(camera[3]), {-4, 2, 7});
    expectNear(glm::dvec3(camera[2]), {0, 0, 1});
    expectNear(glm::dvec3(camera[1]), {-1, 0, 0});
}

TEST_F(SceneJsonInclude, animationsMoveAlong) {
    folder.write("parts/moving.json", R"({"tessera": 1, "lights": [
        {"type": "point", "position": [1, 0, 0], "animation": {"type": "orbit", "periodSeconds": 4}},
        {"type": "point", "position": [1, 0, 0],
         "animation": {"type": "wobble", "amplitude": [0, 1, 0], "periodSeconds": 4}},
        {"type": "point", "position": [0, 0, 0],
         "animation": {"type": "keyframes", "times": [0, 2], "points": [[0, 0, 0], [2, 0, 0]]}},
        {"type": "directional", "direction": [0, 0, 1],
         "keyframes": {"direction": {"times": [0, 2], "values": [[0, 0, 1], [1, 0, 0]]}}}]})");
    const Scene alone = folder.import(including(R"({"file": "parts/moving.json"})"));
    // Mirrored, turned and moved: at every time, the included light is the original light, transformed.
    const Scene moved = folder.import(
        including(R"({"file": "parts/moving.json", "matrix": [0, 1, 0, 0,  1, 0, 0, 0,  0, 0, 1, 0,  5, 6, 7, 1]})"));
    const glm::dvec3 turnedWS = lightAtTime(alone.lights.at(3), 0.3).directionWS;
    expectNear(lightAtTime(moved.lights.at(3), 0.3).directionWS, {turnedWS.y, turnedWS.x, turnedWS.z});
    for (std::size_t i = 0; i < 3; ++i) {
        for (const double seconds : {0.0, 0.3, 1.0, 2.5}) {
            const glm::dvec3 at = lightAtTime(alone.lights.at(i), seconds).positionWS;
            expectNear(lightAtTime(moved.lights.at(i), seconds).positionWS, {at.y + 5.0, at.x + 6.0, at.z + 7.0});
        }
    }
}

TEST_F(SceneJsonInclude, backgroundAndOptionsOfAnIncludeNeverCount) {
    const Scene scene = folder.import(including(R"({"file": "parts/lamps.json"})"));
    EXPECT_EQ(scene.background, glm::vec3(0));
    EXPECT_TRUE(scene.options.requested.empty());
}

TEST_F(SceneJsonInclude, theAssetsFolderIsTakenFromTheEnvironment) {
    const std::string text = including(R"({"file": "${TESSERA_ASSETS}/bust.obj"})");
    {
        const AssetsFolder assets((folder.path() / "models").c_str());
        EXPECT_EQ(folder.import(text).meshes.size(), 1u);
        EXPECT_EQ(folder.errorBeyondSchemaOf(including(R"({"file": "${HOME}/bust.obj"})")),
                  "/include/0/file: '${HOME}/bust.obj': only ${TESSERA_ASSETS} is replaced in file names, once");
    }
    const AssetsFolder unset(nullptr);
    EXPECT_EQ(folder.errorBeyondSchemaOf(text),
              "/include/0/file: needs the environment variable TESSERA_ASSETS, which is not set; set it to the folder "
              "of the third-party models");
}

TEST_F(SceneJsonInclude, builtinScenesAreIncludedByName) {
    const Scene scene = folder.import(including(R"({"file": "builtin:room", "name": "cell"})"));
    EXPECT_EQ(scene.nodes.at(0).name, "cell");
    EXPECT_GT(triangleCount(scene), 0u);
    EXPECT_EQ(folder.errorBeyondSchemaOf(including(R"({"file": "builtin:rom"})")),
              "/include/0/file: there is no built-in scene 'rom'; did you mean 'room'?");
}

TEST_F(SceneJsonInclude, wrongFilesAreRefused) {
    EXPECT_EQ(folder.errorBeyondSchemaOf(including(R"({"file": "none.obj"})")),
              "/include/0/file: there is no file '" + folder.path().string() +
                  "/none.obj'; names are relative to the document's folder");
    EXPECT_EQ(folder.errorBeyondSchemaOf(including(R"({"file": "pictures/albedo.tga"})")),
              "/include/0/file: 'pictures/albedo.tga' is not a scene file; give a .gltf, .glb, .obj or .json file");
    EXPECT_EQ(folder.errorOf(including(R"({"name": "x"})")), "/include/0: lacks the key 'file'; add it");
}

TEST_F(SceneJsonInclude, aCycleIsRefusedNamingItsChain) {
    folder.write("b.json", R"({"tessera": 1, "include": [{"file": "parts/c.json"}]})");
    const std::filesystem::path last =
        folder.write("parts/c.json", R"({"tessera": 1, "include": [{"file": "lamps.json"}, {"file": "../b.json"}]})");
    const std::filesystem::path file = folder.write("scene.json", including(R"({"file": "b.json"})"));
    EXPECT_EQ(inputErrorOf([&] { underLedger(importSceneJson, file); }),
              (folder.path() / "parts/../parts/c.json").lexically_normal().string() +
                  ":/include/1/file: includes itself: b.json -> c.json -> b.json; remove one of the includes");
    EXPECT_EQ(folder.errorBeyondSchemaOf(including(R"({"file": "scene.json"})")),
              "/include/0/file: includes itself: scene.json -> scene.json; remove one of the includes");
}

TEST_F(SceneJsonInclude, includesWithoutEndAreRefused) {
    folder.write("d12.json", R"({"tessera": 1})");
    for (int level = 11; level >= 0; --level) {
        const std::string next = R"({"file": "d)" + std::to_string(level + 1) + R"(.json"})";
        folder.write(std::string("d") + std::to_string(level) + ".json", including(next + ", " + next));
    }
    const std::string error = inputErrorOf([&] { underLedger(importSceneJson, folder.path() / "d0.json"); });
    EXPECT_THAT(error, HasSubstr("is include number 4097 of the scene; at most 4096 are read"));
}

TEST_F(SceneJsonInclude, impossibleTransformsAreRefused) {
    const auto errorOf = [&](const std::string& placement) {
        return folder.errorOf(including(R"({"file": "models/bust.obj", )" + placement + "}"));
    };
    EXPECT_EQ(errorOf(R"("transform": {"rotation": [0, 0, 0, 0]})"),
              "/include/0/transform/rotation: has no length; give a unit quaternion x, y, z, w");
    EXPECT_EQ(errorOf(R"("transform": {"rotation": [0, 0, 0, 1], "eulerDegrees": [0, 0, 0]})"),
              "/include/0/transform/eulerDegrees: is given beside 'rotation'; keep one");
    EXPECT_EQ(errorOf(R"("transform": {}, "matrix": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1])"),
              "/include/0/matrix: is given beside 'transform'; keep one");
    EXPECT_EQ(errorOf(R"("matrix": [1, 0, 0, 5,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1])"),
              "/include/0/matrix: is not affine: its fourth row, every fourth number, must be 0, 0, 0, 1; write it "
              "column by column");
    EXPECT_EQ(
        errorOf(R"("transform": {"move": [1, 0, 0]})"),
        "/include/0/transform: a transform has no key 'move'; valid are translation, rotation, eulerDegrees, scale");
}

TEST_F(SceneJsonInclude, theLeePerrySmithSceneBindsItsMaps) {
    writeScan(folder);
    const AssetsFolder assets(folder.path().c_str());
    const Scene scene = underLedger(importSceneJson, std::filesystem::path(TESSERA_SOURCE_DIR) / "scenes" / "files" /
                                                         "lee_perry_smith.json");
    checkScene(scene);
    EXPECT_EQ(triangleCount(scene), 1u);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.images.size(), 3u);
    EXPECT_EQ(scene.materials[0].normalMapSpace, NormalMapSpace::Object);
    std::set<int> images;
    for (const TextureSlot slot : {TextureSlot::BaseColor, TextureSlot::SpecularColor, TextureSlot::Normal})
        images.insert(scene.materials[0].texture(slot).image);
    EXPECT_EQ(images, (std::set<int>{0, 1, 2}));
}

TEST_F(SceneJsonInclude, aChainOfIncludesOrBasesIsNotFollowedForever) {
    for (const char* link : {R"("include": [{"file": "FILE"}])", R"("base": {"file": "FILE"})"}) {
        const TempFolder chain;
        const auto documentOf = [&](int next) {
            std::string text = std::string(R"({"tessera": 1, )") + link + "}";
            return text.replace(text.find("FILE"), 4, std::to_string(next) + ".json");
        };
        for (int i = 0; i < 5000; ++i) chain.write(std::to_string(i) + ".json", documentOf(i + 1));
        chain.write("5000.json", R"({"tessera": 1})");
        EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, chain.path() / "0.json"); }),
                    HasSubstr("is document 65 of a chain"));
        EXPECT_NO_THROW(underLedger(importSceneJson, chain.path() / "4950.json"));
    }
}

TEST_F(SceneJsonInclude, aScaleThatLeavesACameraNoDirectionIsTheIncludesFault) {
    EXPECT_THAT(
        folder.errorBeyondSchemaOf(including(R"({"file": "parts/lamps.json", "transform": {"scale": [1, 0, 1]}})")),
        testing::AllOf(testing::StartsWith("/include/0: its transform leaves"), HasSubstr("no direction")));
}

TEST_F(SceneJsonInclude, aScaleWhoseSquareLeavesDoubleNeverTakesADirection) {
    folder.write("parts/orbit.json", R"({"tessera": 1, "lights": [{"type": "spot", "position": [0, 0, 0],
        "direction": [0, -1, 0], "intensity": 1, "outerDegrees": 30,
        "animation": {"type": "orbit", "axis": [0, 0, 1], "periodSeconds": 1}}]})");
    for (const char* scale : {"1e170", "1e-170"}) {
        const Scene scene = folder.import(
            including(R"({"file": "parts/orbit.json", "transform": {"scale": )" + std::string(scale) + "}}"));
        EXPECT_EQ(scene.lights.at(0).directionWS, glm::dvec3(0.0, -1.0, 0.0)) << scale;
        EXPECT_EQ(scene.lights.at(0).animation->axisWS, glm::dvec3(0.0, 0.0, 1.0)) << scale;
    }
}

} // namespace
} // namespace tessera::scenes
