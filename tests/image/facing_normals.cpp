// Shading normals that point away from the viewer on surfaces that face the viewer.
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/frame/GBufferLayout.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/image/FlatTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using namespace test;

constexpr double kFacingLeast = 1.0 / 64.0; ///< kLeastFacing of shaders/lib/raster/facing.glsl
constexpr int kCoarseBallPixels = 64;

/// Coarse balls side by side before an orthographic camera, with interpolated normals, rotated so that some point away
/// from the viewer. No visible triangle is within a cosine of 0.037 of the horizon.
scenes::Scene coarseBalls(const std::vector<scenes::Material>& materials) {
    constexpr double kHalfHeightMetres = 1.05;
    scenes::Scene scene = quadScene({});
    scene.meshes[0] = {};
    scenes::builtin::appendSphere(scene.meshes[0], {}, 1.0, 8, 6);
    scene.materials = materials;
    scene.nodes.clear();
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const double x = kHalfHeightMetres * (2.0 * double(i) + 1.0 - double(materials.size()));
        glm::dmat4 placed = glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.0, 0.0));
        placed = glm::rotate(placed, 0.15, glm::dvec3(0.0, 1.0, 0.0));
        placed = glm::rotate(placed, 0.2, glm::dvec3(1.0, 0.0, 0.0));
        scenes::Node& node = scene.nodes.emplace_back();
        node.parentFromNode = placed;
        node.instances = {{0, int(i)}};
    }
    makeOrthographic(scene.cameras[0], kHalfHeightMetres);
    return scene;
}

scenes::Material whiteMetal() {
    scenes::Material material = metalOf(0.3);
    return material;
}

/// A material per kind of lobe.
std::vector<scenes::Material> glossyMaterials() {
    scenes::Material brushed = whiteMetal();
    brushed.perceptualRoughness = 0.5f;
    brushed.anisotropyStrength = 0.7f;
    scenes::Material coated;
    coated.baseColor = glm::vec4(0.3f, 0.1f, 0.1f, 1.0f);
    coated.metallic = 0.0f;
    coated.clearcoat = 1.0f;
    coated.clearcoatPerceptualRoughness = 0.2f;
    scenes::Material cloth = coated;
    cloth.clearcoat = 0.0f;
    cloth.sheenColor = glm::vec3(0.8f);
    cloth.sheenPerceptualRoughness = 0.5f;
    scenes::Material plastic = coated;
    plastic.model = scenes::MaterialModel::BlinnPhong;
    plastic.exponent = 20.0f;
    return {whiteMetal(), brushed, coated, cloth, plastic};
}

std::vector<scenes::Light> lightsAround() {
    return {pointLight({4.0, 3.0, 2.0}, 30.0f), pointLight({-6.0, 1.0, -3.0}, 60.0f),
            pointLight({0.0, -5.0, 1.0}, 20.0f)};
}

class FacingNormals : public EnvironmentTest {
protected:
    static frame::FrameSettings settingsFor(std::size_t balls) {
        frame::FrameSettings settings = ofSize(kCoarseBallPixels * int(balls), kCoarseBallPixels);
        settings.environment.backdrop = frame::Backdrop::Off;
        return settings;
    }
    /// Renders the normal view with both filters, and passes its covered pixels to `judge`.
    template <typename Judge>
    void judgeNormals(const scenes::Scene& scene, Technique technique, const Judge& judge) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = withView(settingsFor(1), frame::DebugView::Normal);
        for (const frame::TextureFilter filter : {frame::TextureFilter::Hardware, frame::TextureFilter::Exact}) {
            settings.filter = filter;
            const std::vector<float> normals = renderer.render(technique, settings).radiance;
            std::vector<glm::dvec3> covered;
            for (std::size_t i = 0; i < normals.size(); i += 4)
                if (normals[i + 3] != 0.0f) covered.emplace_back(normals[i], normals[i + 1], normals[i + 2]);
            judge(covered, filter);
        }
    }
    /// Expects no pixel of a white metal under uniform radiance of 1 to be dark, or brighter than the light.
    void expectNoDarkPixel(engine::Renderer& renderer, Technique technique, const frame::FrameSettings& settings,
                           double least, double most) {
        const std::vector<float> seen = renderer.render(technique, settings).radiance;
        std::vector<float> inside;
        for (std::size_t i = 0; i < seen.size(); i += 4)
            if (seen[i + 3] == 1.0f) inside.push_back(seen[i]);
        ASSERT_GT(inside.size(), 2000u);
        std::sort(inside.begin(), inside.end());
        const float median = inside[inside.size() / 2];
        EXPECT_GT(median, 0.9f);
        EXPECT_GE(inside.front(), float(least) * median);
        EXPECT_LE(inside.back(), float(most));
    }
};

/// 46 pixels have an interpolated normal that points away, and 9 more one below the minimum cosine.
TEST_F(FacingNormals, faceTheViewerInEveryPixel) {
    const scenes::Scene scene = coarseBalls({whiteMetal()});
    for (const Technique technique : {Technique::Forward, Technique::Deferred})
        judgeNormals(scene, technique, [](const std::vector<glm::dvec3>& normals, frame::TextureFilter) {
            int bent = 0;
            for (const glm::dvec3& normal : normals) { // the viewer is at +z
                EXPECT_GE(normal.z, kFacingLeast / std::hypot(1.0, kFacingLeast) - 1e-6);
                bent += normal.z < 1.1 * kFacingLeast ? 1 : 0; // bent from at most 24 degrees below the horizon
            }
            EXPECT_GT(normals.size(), 2000u);
            EXPECT_GE(bent, 40);
        });
}

/// A white metal reflects 0.88 to 1 of uniform light at any angle, at this roughness (the table of
/// EnvironmentTruth.aWhiteFurnaceLosesWhatThePublishedTableSays); 0.03 allows for the renderer's tables.
TEST_F(FacingNormals, leaveNoDarkPixelOnACoarseBallOfMetalInEvenLight) {
    scenes::Scene scene = coarseBalls({whiteMetal()});
    scene.environment = evenEnvironment(1.0);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = settingsFor(1);
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        SCOPED_TRACE(info.name);
        expectNoDarkPixel(renderer, info.technique, settings, 0.85, 1.03);
    }
    settings.environment.light = EnvironmentLight::Sampled;
    settings.environment.samples = 256;
    SCOPED_TRACE("by samples");
    expectNoDarkPixel(renderer, Technique::Deferred, settings, 0.85, 1.1); // with noise
}

/// The minimum cosine exceeds the error of stored normals, so that quantisation never turns one away again.
TEST_F(FacingNormals, faceTheViewerInEveryLayoutOfTheGBuffer) {
    scenes::Scene scene = coarseBalls({whiteMetal()});
    scene.environment = evenEnvironment(1.0);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = settingsFor(1);
    for (const frame::LayoutInfo& info : frame::layoutTable()) {
        SCOPED_TRACE(info.name);
        settings.layout = info.layout;
        expectNoDarkPixel(renderer, Technique::Deferred, settings, 0.8, 1.05);
    }
}

TEST_F(FacingNormals, areTheSameInEveryTechniqueToTheLastBit) {
    const std::vector<scenes::Material> materials = glossyMaterials();
    scenes::Scene scene = coarseBalls(materials);
    scene.lights = lightsAround();
    scene.environment = builtinEnvironment("studio");
    engine::Renderer renderer(context(), scene);
    expectParity(renderer, settingsFor(materials.size()));
}

/// Lit by lights alone, which need no samples. Tolerances of referenceTolerance(), without silhouettes.
TEST_F(FacingNormals, areThoseOfTheReference) {
    const std::vector<scenes::Material> materials = glossyMaterials();
    scenes::Scene scene = coarseBalls(materials);
    scene.lights = lightsAround();
    engine::Renderer renderer(context(), scene);
    validation::CompareRequest request;
    request.techniques = {Technique::Forward, Technique::Deferred};
    request.against = validation::Reference{};
    request.settings = settingsFor(materials.size());
    request.settings.filter = frame::TextureFilter::Exact;
    request.hardwareFilter = false;
    for (const validation::ComparePair& pair :
         validation::compareTechniques(renderer, context().capabilities(), request).record.pairs) {
        SCOPED_TRACE(pair.a);
        EXPECT_TRUE(pair.verdict.ok) << testing::PrintToString(pair.verdict.missed);
        EXPECT_LT(pair.figures.excluded, 0.02);
    }
}

/// A floor whose normals are those of its triangles keeps them up to the horizon, even below the minimum cosine. Bent
/// ones would be off by up to 0.0156.
TEST_F(FacingNormals, ofAFlatFloorStayAsTheyAreUpToItsHorizon) {
    constexpr double kRollRadians = 0.3;
    const glm::dvec3 up(-std::sin(kRollRadians), std::cos(kRollRadians), 0.0);
    scenes::Scene scene = quadScene(whiteMetal());
    scene.meshes[0] = {};
    scenes::builtin::appendFloor(scene.meshes[0], {0.0, 0.0, -50.0}, {200.0, 100.0}, {4, 4});
    scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), kRollRadians, glm::dvec3(0.0, 0.0, 1.0));
    scene.lights = {pointLight({0.0, 5.0, -10.0}, 10.0f)};
    scenes::Camera& camera = scene.cameras[0];
    camera.nearMetres = 0.01;
    camera.farMetres = 1000.0;
    for (const scenes::Projection projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        camera.projection = projection;
        if (projection == scenes::Projection::Perspective) {
            camera.fovYRadians = 0.2; // the rows below the horizon are 0.2 degrees apart
            camera.worldFromCamera = glm::translate(glm::dmat4(1.0), 0.05 * up);
        } else {
            constexpr double kCosine = 0.004, kDistanceMetres = 45.0;
            const glm::dvec3 middle(0.0, 0.0, -50.0);
            camera.halfHeightMetres = 0.15;
            camera.worldFromCamera = scenes::worldFromLookAt(
                middle + kDistanceMetres * (kCosine * up + std::sqrt(1.0 - kCosine * kCosine) * glm::dvec3(0, 0, 1)),
                middle);
        }
        judgeNormals(scene, Technique::Deferred,
                     [&](const std::vector<glm::dvec3>& normals, frame::TextureFilter filter) {
                         double worst = 0.0;
                         for (const glm::dvec3& normal : normals) worst = std::max(worst, glm::distance(normal, up));
                         EXPECT_GT(normals.size(), 1000u);
                         EXPECT_LT(worst, 1e-5)
                             << (projection == scenes::Projection::Perspective ? "perspective" : "orthographic")
                             << (filter == frame::TextureFilter::Exact ? ", exact" : ", hardware");
                     });
    }
}

/// Bit-identical images without bending: a flat surface is never bent, at any angle.
TEST_F(FacingNormals, ofFlatSurfacesKeepEveryBit) {
    const ShaderMutant unbent("lib/raster/facing.glsl", "const float kLeastFacing = 1.0 / 64.0;",
                              "const float kLeastFacing = -2.0;");
    scenes::Scene scene = quadScene(whiteMetal());
    scene.meshes[0] = {};
    scenes::builtin::appendFloor(scene.meshes[0], {0.0, 0.0, -50.0}, {200.0, 100.0}, {4, 4});
    scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0.0, 0.0, 1.0));
    scene.lights = {pointLight({0.0, 5.0, -10.0}, 10.0f)};
    scenes::Camera& camera = scene.cameras[0];
    camera.nearMetres = 0.01;
    camera.farMetres = 1000.0;
    camera.fovYRadians = 0.2;
    camera.worldFromCamera = glm::translate(glm::dmat4(1.0), 0.05 * glm::dvec3(-std::sin(0.3), std::cos(0.3), 0.0));
    // Where normals turn away, the mutant changes the image.
    const scenes::Scene ball = coarseBalls({whiteMetal()});
    frame::FrameSettings settings = settingsFor(1);
    settings.view = frame::DebugView::Normal;
    for (const frame::TextureFilter filter : {frame::TextureFilter::Hardware, frame::TextureFilter::Exact}) {
        settings.filter = filter;
        const auto radiance = [&](const scenes::Scene& shown, const shader::SourceTree& shaders) {
            return drawn(shown, settings, Technique::Forward, shaders);
        };
        EXPECT_EQ(radiance(scene, shader::SourceTree()), radiance(scene, unbent.tree()));
        EXPECT_NE(radiance(ball, shader::SourceTree()), radiance(ball, unbent.tree()));
    }
}

/// A floor viewed by parallel rays at one cosine, with normals of one direction that points away from the viewer: from
/// vertices, from a map, of a back face. Triangles at a cosine c below 1/32 have a minimum of c / 2, others of 1/64.
TEST_F(FacingNormals, areTurnedToHalfOfTheTrianglesOwnCosine) {
    constexpr double kDistanceMetres = 45.0;
    const glm::dvec3 leaningWS = glm::normalize(glm::dvec3(0.0, 1.0, -0.5)), middle(0.0, 0.0, -50.0);
    enum class Kind { Vertices, Map, BackFace };
    for (const Kind kind : {Kind::Vertices, Kind::Map, Kind::BackFace}) {
        scenes::Material material = whiteMetal();
        material.doubleSided = kind == Kind::BackFace;
        material.normalMapSpace = scenes::NormalMapSpace::Object;
        scenes::Scene scene = quadScene(material);
        scenes::Mesh& mesh = scene.meshes[0];
        mesh = {};
        scenes::builtin::appendFloor(mesh, {}, {200.0, 100.0}, {4, 4});
        scene.nodes[0].parentFromNode = glm::translate(glm::dmat4(1.0), middle);
        if (kind == Kind::Vertices) {
            mesh.normalsOS.assign(mesh.positionsOS.size(), glm::vec3(leaningWS));
        } else if (kind == Kind::Map) {
            scene.images = {floatImage(glm::vec4(glm::vec3(leaningWS * 0.5 + 0.5), 1.0f))};
            scene.materials[0].texture(scenes::TextureSlot::Normal).image = 0;
        } else {
            // Upside down: the viewer sees the back of the normals.
            const glm::dmat4 over = glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0.0, 0.0, 1.0));
            scene.nodes[0].parentFromNode = scene.nodes[0].parentFromNode * over;
            mesh.normalsOS.assign(mesh.positionsOS.size(), glm::vec3(glm::transpose(glm::dmat3(over)) * -leaningWS));
        }
        scenes::Camera& camera = scene.cameras[0];
        camera.projection = scenes::Projection::Orthographic;
        camera.nearMetres = 0.01;
        camera.farMetres = 1000.0;
        for (const double cosine : {0.01, 0.025, 0.06}) {
            camera.halfHeightMetres = 0.15;
            const glm::dvec3 toViewerWS(0.0, cosine, std::sqrt(1.0 - cosine * cosine));
            camera.worldFromCamera = scenes::worldFromLookAt(middle + kDistanceMetres * toViewerWS, middle);
            const double least = cosine < 2.0 * kFacingLeast ? 0.5 * cosine : kFacingLeast;
            const double along = glm::dot(leaningWS, toViewerWS);
            ASSERT_LT(along, 0.0);
            const double wanted = least / std::sqrt(1.0 - along * along + least * least);
            judgeNormals(scene, Technique::Forward,
                         [&](const std::vector<glm::dvec3>& normals, frame::TextureFilter filter) {
                             double worst = 0.0;
                             for (const glm::dvec3& normal : normals)
                                 worst = std::max(worst, std::abs(glm::dot(normal, toViewerWS) / wanted - 1.0));
                             EXPECT_GT(normals.size(), 1000u);
                             // The whole instead of the half is off by 1. The cosine is computed from corners in fp32,
                             // or from the change of depth between pixels.
                             EXPECT_LT(worst, filter == frame::TextureFilter::Exact ? 2e-3 : 0.05)
                                 << "kind " << int(kind) << ", cosine " << cosine;
                         });
        }
    }
}

} // namespace
} // namespace tessera
