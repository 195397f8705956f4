#include <algorithm>
#include <random>

#include "scenes/Pose.h"
#include "tests/support/AnimatedModels.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"
#include "tests/unit/scenes/gltf/TruthOfAnimation.h"

/// Deformed vertices compared with an independent computation from the files.
namespace tessera::scenes::gltf::test {
namespace {

struct DrawnCorner {
    glm::dvec3 placeWS;
    glm::dvec3 normalWS;
    bool isMirrored = false; ///< the whole mesh, by its node
};

std::vector<DrawnCorner> drawnCorners(const Scene& scene) {
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    std::vector<DrawnCorner> corners;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        const glm::dmat3 normalFromNode = glm::transpose(glm::inverse(glm::dmat3(worldFromNode[node])));
        const bool isMirrored = glm::determinant(glm::dmat3(worldFromNode[node])) < 0.0;
        for (const MeshInstance& instance : scene.nodes[node].instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            for (const std::uint32_t vertex : mesh.indices)
                corners.push_back({glm::dvec3(worldFromNode[node] * glm::dvec4(mesh.positionsOS[vertex], 1.0)),
                                   normalFromNode * glm::dvec3(mesh.normalsOS[vertex]), isMirrored});
        }
    }
    return corners;
}

/// Maximum that keeps NaN.
void widen(double& most, double difference) {
    if (!(difference <= most)) most = difference;
}

/// Largest errors of positions, as a fraction of the model's extent, and of normal directions.
struct Difference {
    double place = 0.0, normal = 0.0;
    bool hasOtherSides = false; ///< some corner is mirrored but its mesh is not, or vice versa
};

/// Largest error of a joint's matrix at the time of the latest corners(), as a fraction of the matrix. 0 unless the
/// model has exactly one skin.
double differenceOfJoints(const Scene& scene, const TruthOfAnimation& truth) {
    if (truth.skins() != 1 || scene.rig.skins.empty()) return 0.0;
    const Skin& skin = scene.rig.skins.front();
    EXPECT_EQ(skin.joints.size(), truth.joints());
    if (skin.joints.size() != truth.joints()) return 0.0;
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    double most = 0.0;
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
        const glm::dmat4 found = worldFromNode[std::size_t(skin.joints[joint])] * skin.jointFromBind[joint];
        double difference = 0.0, size = 0.0;
        for (int column = 0; column < 4; ++column) {
            const auto axis = [column](int c) { return column == c ? 1.0 : 0.0; };
            const glm::dvec3 wanted = truth.byJoint(joint, {axis(0), axis(1), axis(2)}, axis(3));
            widen(difference, glm::distance(glm::dvec3(found[column]), wanted));
            size = std::max(size, glm::length(wanted));
        }
        widen(most, difference / size);
    }
    return most;
}

Difference differenceAt(Scene& scene, TruthOfAnimation& truth, int clip, double time) {
    scene.rig.playing.clear();
    if (clip >= 0) scene.rig.playing.push_back(clip);
    poseScene(scene, time);
    EXPECT_NO_THROW(checkScene(scene));
    const std::vector<DrawnCorner> drawn = drawnCorners(scene);
    const std::vector<TruthOfAnimation::Corner> wanted = truth.corners(clip, time);
    Difference difference;
    EXPECT_EQ(drawn.size(), wanted.size());
    if (drawn.size() != wanted.size()) return difference;
    Box3 box;
    for (const TruthOfAnimation::Corner& corner : wanted) box.extend(corner.placeWS);
    const double extent = std::max(glm::length(box.max - box.min), glm::length(glm::max(glm::abs(box.min), box.max)));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        widen(difference.place, glm::distance(drawn[i].placeWS, wanted[i].placeWS) / extent);
        difference.hasOtherSides = difference.hasOtherSides || drawn[i].isMirrored != wanted[i].mirrored;
        const glm::dvec3 normal = (drawn[i].isMirrored ? -1.0 : 1.0) * wanted[i].normalWS;
        if (!(glm::length(normal) > 1e-12)) continue;
        widen(difference.normal, glm::distance(glm::normalize(drawn[i].normalWS), glm::normalize(normal)));
    }
    return difference;
}

/// Expects correct positions, normals and joints at a time of a clip, and sides where `hasSides`.
void expectTrueAt(Scene& scene, TruthOfAnimation& truth, int clip, double time, bool hasSides) {
    SCOPED_TRACE(testing::Message() << "clip " << clip << " at " << time << " s");
    const Difference difference = differenceAt(scene, truth, clip, time);
    EXPECT_LT(difference.place, 1e-5);
    EXPECT_LT(difference.normal, 1e-3);
    EXPECT_FALSE(hasSides && difference.hasOtherSides);
    EXPECT_LT(differenceOfJoints(scene, truth), 1e-5);
}

/// Compares positions and normals of all clips, and of none, at times inside and outside of the clip.
void expectTrue(const std::filesystem::path& file) {
    SCOPED_TRACE(file.string());
    Scene scene = underLedger(importGltf, file);
    TruthOfAnimation truth(file);
    ASSERT_EQ(scene.rig.clips.size(), truth.clips());
    for (int clip = -1; clip < int(truth.clips()); ++clip) {
        const double length = clip < 0 ? 0.0 : truth.lengthSeconds(std::size_t(clip));
        std::vector<double> times{0.0};
        if (clip >= 0) {
            EXPECT_EQ(lengthSeconds(scene.rig.clips[std::size_t(clip)]), length);
            times.insert(times.end(), {0.37 * length, length + 1.0});
        }
        for (const double time : times) expectTrueAt(scene, truth, clip, time, true);
    }
}

/// A cloud of triangles deformed by a chain of joints, one of them mirroring, and two targets, by every interpolation.
Builder randomModel(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> even(-1.0f, 1.0f);
    constexpr std::size_t kVertices = 90, kJoints = 6, kKeys = 5;
    const auto numbers = [&](std::size_t count, float scale = 1.0f) {
        std::vector<float> list(count);
        for (float& number : list) number = scale * even(random);
        return list;
    };
    Builder builder;
    Json nodes = Json::array(
        {{{"mesh", 0}, {"skin", 0}, {"scale", {-2, 1, 1}}, {"translation", {9, 9, 9}}, {"weights", {0.25, 0}}}});
    Json joints = Json::array();
    for (std::size_t i = 1; i <= kJoints; ++i) {
        Json& node = nodes.emplace_back();
        const std::vector<float> q = numbers(4);
        node = {{"translation", numbers(3, 0.5f)}, {"rotation", q}, {"scale", {i == 2 ? -1.1 : 0.9, 1.2, 1.0}}};
        if (i < kJoints) node["children"] = Json::array({i + 1});
        joints.push_back(i);
    }
    builder.json["nodes"] = nodes;
    builder.json["scenes"][0]["nodes"] = Json::array({1, 0});
    Json& primitive = builder.primitive();
    std::vector<float> normals = numbers(3 * kVertices);
    for (std::size_t v = 0; v < kVertices; ++v) {
        const glm::vec3 unit = glm::normalize(glm::vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]));
        for (int c = 0; c < 3; ++c) normals[3 * v + std::size_t(c)] = unit[c];
    }
    primitive["attributes"]["POSITION"] = builder.add("VEC3", numbers(3 * kVertices));
    primitive["attributes"]["NORMAL"] = builder.add("VEC3", normals);
    for (const char* set : {"0", "1"}) {
        std::vector<std::uint16_t> followed(4 * kVertices);
        for (std::uint16_t& joint : followed) joint = std::uint16_t(random() % kJoints);
        std::vector<float> weights = numbers(4 * kVertices);
        for (float& weight : weights) weight = std::abs(weight);
        primitive["attributes"][std::string("JOINTS_") + set] = builder.add("VEC4", followed);
        primitive["attributes"][std::string("WEIGHTS_") + set] = builder.add("VEC4", weights);
    }
    primitive["targets"] = Json::array();
    for (int target = 0; target < 2; ++target)
        primitive["targets"].push_back(Json::object({{"POSITION", builder.add("VEC3", numbers(3 * kVertices, 0.3f))},
                                                     {"NORMAL", builder.add("VEC3", numbers(3 * kVertices, 0.3f))}}));
    builder.json["skins"] = Json::array({Json::object({{"joints", joints}})});
    std::vector<float> matrices;
    for (std::size_t joint = 0; joint < kJoints; ++joint)
        for (int i = 0; i < 16; ++i)
            matrices.push_back(i % 4 == 3 ? float(i == 15) : float(i % 5 == 0) + 0.2f * even(random));
    builder.json["skins"][0]["inverseBindMatrices"] = builder.add("MAT4", matrices);

    Json samplers = Json::array(), channels = Json::array();
    std::vector<float> times;
    for (std::size_t key = 0; key < kKeys; ++key) times.push_back(0.3f * float(key) + 0.1f * float(key * key));
    const int input = builder.add("SCALAR", times);
    const auto animate = [&](int node, const char* path, std::size_t width, const char* way) {
        const std::size_t values = kKeys * (std::string(way) == "CUBICSPLINE" ? 3 : 1);
        const bool isWeights = std::string(path) == "weights";
        const char* const type = isWeights ? "SCALAR" : width == 4 ? "VEC4" : "VEC3";
        const int output = builder.add(type, numbers(values * width));
        channels.push_back(
            Json::object({{"sampler", samplers.size()}, {"target", Json::object({{"node", node}, {"path", path}})}}));
        samplers.push_back(Json::object({{"input", input}, {"output", output}, {"interpolation", way}}));
    };
    animate(1, "rotation", 4, "LINEAR");
    animate(2, "rotation", 4, "CUBICSPLINE");
    animate(3, "rotation", 4, "STEP");
    animate(4, "translation", 3, "CUBICSPLINE");
    animate(5, "scale", 3, "LINEAR");
    animate(0, "weights", 2, "CUBICSPLINE");
    builder.json["animations"] = Json::array({Json::object({{"samplers", samplers}, {"channels", channels}})});
    return builder;
}

TEST(AnimationTruth, randomSkinsAndTargetsAreWhereASecondComputationPutsThem) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const Builder builder = randomModel(seed);
        const std::filesystem::path file = builder.folder.write("model.gltf", builder.json.dump());
        Scene scene = underLedger(importGltf, file);
        TruthOfAnimation truth(file);
        for (const double time : {-1e9, 0.0, 0.1, 0.41, 1.0, 1.7, 2.79, 1e9})
            expectTrueAt(scene, truth, 0, time, false);
        expectTrueAt(scene, truth, -1, 0.0, false);
    }
}

TEST(AnimationTruth, modelsOfTheRepositoryAreWhereASecondComputationPutsThem) {
    for (const char* model : {"skinned_bar.gltf", "morphing_box.gltf"}) // the deformed models
        expectTrue(tessera::test::ownModelsFolder() / model);
}

TEST(AnimationTruth, modelsOfTheAssetsFolderAreWhereASecondComputationPutsThem) {
    std::vector<std::string> models(std::begin(tessera::test::kAnimatedModels),
                                    std::end(tessera::test::kAnimatedModels));
    for (int i = 0; i < 12; ++i) {
        const std::string two = (i < 10 ? "0" : "") + std::to_string(i);
        models.push_back("AssetGenerator/Positive/Animation_Skin/Animation_Skin_" + two + ".gltf");
        models.push_back("AssetGenerator/Positive/Instancing/Instancing_" + two + ".gltf");
    }
    int compared = 0;
    for (const std::string& model : models) {
        const std::optional<std::filesystem::path> file = tessera::test::fileOfAssets(model);
        if (!file) continue;
        expectTrue(*file);
        ++compared;
    }
    if (compared == 0) GTEST_SKIP() << "there is no folder of third-party models that has any of them";
}

/// Animated or deformed models of Debian's assimp-testmodels; GltfSweep prints why others are refused.
TEST(AnimationTruth, packagedModelsAreWhereASecondComputationPutsThem) {
    const std::filesystem::path folder = "/usr/share/assimp/models/glTF2";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    std::vector<std::string> compared;
    for (const std::filesystem::path& model : tessera::test::modelsBelow(folder)) {
        try {
            if (!hasPoses(underLedger(importGltf, model))) continue;
        } catch (const InputError&) {
            continue;
        }
        expectTrue(model);
        compared.push_back(model.stem().string());
    }
    for (const char* name : {"AnimatedMorphCube", "simple_skin"})
        EXPECT_TRUE(std::ranges::find(compared, name) != compared.end()) << name;
}

} // namespace
} // namespace tessera::scenes::gltf::test
