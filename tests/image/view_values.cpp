#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "base/Error.h"
#include "engine/PrepareView.h"
#include "shaders/shared/faults.h"
#include "tests/image/FlatTest.h"
#include "tests/support/ErrorText.h"

namespace tessera {
namespace {

using namespace test;
using engine::Technique;
using scenes::Material;
using scenes::MaterialModel;
using scenes::Scene;
using scenes::TextureSlot;

class ViewValues : public FlatTest {
protected:
    engine::RenderedFrame shown(const Scene& scene, frame::DebugView view, Technique technique,
                                frame::FrameSettings settings = {}) {
        settings.sizePixels = {kSide, kSide};
        settings.view = view;
        return frameOf(scene, settings, technique);
    }
};

frame::FrameSettings viewSettings(frame::DebugView view) {
    frame::FrameSettings settings;
    settings.view = view;
    return settings;
}

TEST_F(ViewValues, theTexelViewIsExactlyTheMapInBothSpaces) {
    const scenes::Image map = image8([](int x, int y) {
        return std::array<int, 4>{20 + 30 * x, 250 - 30 * y, 130 + 4 * x + 8 * y, 255};
    });
    for (const scenes::NormalMapSpace space : {scenes::NormalMapSpace::Tangent, scenes::NormalMapSpace::Object}) {
        Material material;
        material.normalMapSpace = space;
        const Scene scene = texturedScene(flatScene(material), TextureSlot::Normal, map);
        const engine::RenderedFrame view = frame(scene, viewSettings(frame::DebugView::NormalTexel));
        for (std::size_t i = 0; i < std::size_t(kSide * kSide); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(view.radiance[4 * i + c], int(map.texels[4 * i + c]) / 255.0, 1.2e-7)
                    << i; // an fp32 step below 1
                EXPECT_EQ(view.display[4 * i + c], std::uint8_t(map.texels[4 * i + c])) << i;
            }
    }
}

TEST_F(ViewValues, theDiffuseViewIsExactlyTheBaseColourOfEveryModel) {
    for (const MaterialModel model :
         {MaterialModel::SingleColor, MaterialModel::Lambert, MaterialModel::BlinnPhong, MaterialModel::Microfacet,
          MaterialModel::MicrofacetAnisotropic, MaterialModel::MetallicRoughness}) {
        SCOPED_TRACE(int(model));
        Material material;
        material.model = model;
        material.baseColor = {0.75f, 0.5f, 0.125f, 1.0f};
        const engine::RenderedFrame view = frame(flatScene(material), viewSettings(frame::DebugView::Diffuse));
        EXPECT_EQ(pixel(view, 3, 4), material.baseColor);
    }
}

/// The quad's normal, tilted by a map, in the three spaces.
TEST_F(ViewValues, oneNormalIsShownInWorldViewAndObjectSpace) {
    Material material;
    material.normalMapSpace = scenes::NormalMapSpace::Object;
    Scene scene = texturedScene(flatScene(material), TextureSlot::Normal, uniformImage({176, 208, 216, 255}));
    const glm::dvec3 normalOS = glm::normalize(glm::dvec3(176, 208, 216) * 2.0 / 255.0 - 1.0);
    const glm::dmat4 turn = glm::rotate(glm::rotate(glm::dmat4(1.0), 0.7, {0, 1, 0}), 0.4, {1, 0, 0});
    // Mirrored and stretched differently along each axis; the camera keeps looking at its front.
    const glm::dmat4 node = turn * glm::scale(glm::dmat4(1.0), glm::dvec3(-3.0, 2.0, 0.5));
    scene.nodes[0].parentFromNode = node;
    scene.cameras[0].worldFromCamera = turn * scene.cameras[0].worldFromCamera;
    scene.materials[0].doubleSided = false;
    const glm::dvec3 normalVS = glm::normalize(normalOS / glm::dvec3(-3.0, 2.0, 0.5));
    const struct {
        frame::DebugView view;
        glm::dvec3 wanted;
    } cases[] = {{frame::DebugView::Normal, glm::dmat3(turn) * normalVS},
                 {frame::DebugView::NormalView, normalVS},
                 {frame::DebugView::NormalObject, normalOS}};
    for (const auto& [view, wanted] : cases) {
        SCOPED_TRACE(frame::debugViewInfo(view).name);
        for (const frame::LightingSpace space : {frame::LightingSpace::World, frame::LightingSpace::View})
            for (const frame::TextureFilter filter : {frame::TextureFilter::Hardware, frame::TextureFilter::Exact}) {
                frame::FrameSettings settings = viewSettings(view);
                settings.space = space;
                settings.filter = filter;
                const glm::vec4 found = pixel(frame(scene, settings), kSide / 2, kSide / 2);
                // A dozen fp32 roundings of 2^-24 each, some on values that the node made six times as large.
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 2e-6) << c;
            }
    }
}

TEST_F(ViewValues, anObjectSpaceNormalIsFiniteAndThatOfThePlaneWhereTheNodeFlattensIt) {
    Material material;
    material.normalMapSpace = scenes::NormalMapSpace::Object;
    Scene scene = texturedScene(flatScene(material), TextureSlot::Normal, uniformImage({176, 208, 216, 255}));
    scene.nodes[0].parentFromNode = glm::scale(glm::dmat4(1.0), glm::dvec3(1.5, 2.0, 0.0));
    EXPECT_EQ(glm::vec3(pixel(frame(scene, viewSettings(frame::DebugView::Normal)), 4, 4)), glm::vec3(0, 0, 1));
    EXPECT_EQ(glm::vec3(pixel(frame(scene, viewSettings(frame::DebugView::NormalObject)), 4, 4)), glm::vec3(0));
}

/// Three quads behind each other, drawn from back to front.
Scene layers(const Material& material) {
    Scene scene = quadScene(material);
    for (const double z : {0.25, 0.5}) {
        scene.nodes.push_back(scene.nodes[0]);
        scene.nodes.back().parentFromNode[3].z = z;
    }
    return scene;
}

TEST_F(ViewValues, overdrawIsExactlyTheSurfacesThatEachTechniqueShades) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        SCOPED_TRACE(info.name);
        const bool prepass = info.geometry == engine::Geometry::DepthFirst;
        const Scene opaque = layers(Material{});
        const engine::RenderedFrame drawn = shown(opaque, frame::DebugView::Overdraw, info.technique);
        EXPECT_EQ(pixel(drawn, 4, 4), prepass ? glm::vec4(1.0f) : glm::vec4(3, 3, 3, 1));
        Scene mixed = opaque; // a pane of glass before them, another behind
        Material glass;
        glass.alphaMode = scenes::AlphaMode::Blend;
        mixed.materials.push_back(glass);
        for (const double z : {0.75, -1.0}) {
            mixed.nodes.push_back(mixed.nodes[0]);
            mixed.nodes.back().instances[0].material = 1;
            mixed.nodes.back().parentFromNode[3].z = z;
        }
        const engine::RenderedFrame behindGlass = shown(mixed, frame::DebugView::Overdraw, info.technique);
        EXPECT_EQ(pixel(behindGlass, 4, 4), prepass ? glm::vec4(2, 2, 2, 1) : glm::vec4(4, 4, 4, 1));
    }
}

TEST_F(ViewValues, faultsArePaintedAndNothingElseIs) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    const struct {
        glm::vec3 emission;
        std::array<int, 3> painted;
    } cases[] = {{{kNaN, 1.0f, kInfinite}, {255, 0, 255}},
                 {{0.5f, -kInfinite, -1.0f}, {0, 255, 255}},
                 {{0.5f, -1e-30f, 2.0f}, {255, 255, 0}},
                 {{1.0f, 1.0f, 1.0f}, {188, 188, 188}},
                 {{-0.0f, 0.0f, 0.0f}, {0, 0, 0}}};
    for (const auto& [emission, painted] : cases) {
        Material material = unlit();
        material.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
        material.emissive = emission;
        for (const Technique technique : {Technique::Forward, Technique::Deferred, Technique::DeferredVolumes}) {
            const engine::RenderedFrame view = shown(flatScene(material), frame::DebugView::Faults, technique);
            const std::size_t middle = 4 * std::size_t(kSide / 2 * kSide + kSide / 2);
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(view.display[middle + c], painted[c], painted[0] == 188 ? 1 : 0) << emission.x; // rounding
        }
    }
}

TEST_F(ViewValues, storedChannelsShowTheGBufferBitForBit) {
    Material material;
    material.baseColor = {0.25f, 0.5f, 1.0f, 1.0f};
    material.metallic = 0.375f;
    material.perceptualRoughness = 0.5f;
    Scene scene = flatScene(Material{});
    scene.materials.push_back(material);
    for (scenes::Node& node : scene.nodes)
        for (scenes::MeshInstance& instance : node.instances) instance.material = int(scene.materials.size()) - 1;
    ASSERT_EQ(scene.materials.size(), 2u);
    // Out of the image, so that the first material is in use and the second one's index is 1.
    scene.nodes.push_back(scene.nodes.back());
    scene.nodes.back().instances.front().material = 0;
    scene.nodes.back().parentFromNode[3] += glm::dvec4(100.0, 0.0, 0.0, 0.0);
    const auto stored = [&](frame::Channel channel, bool fourth, const frame::GBufferLayout& layout) {
        frame::FrameSettings settings;
        settings.layout = layout;
        return shown(scene, frame::storedDebugView({channel, fourth}), Technique::Deferred, settings);
    };
    const frame::GBufferLayout exact = frame::exactLayout().layout, packed = frame::layoutTable()[1].layout;
    EXPECT_EQ(pixel(stored(frame::Channel::Albedo, false, exact), 4, 4), glm::vec4(0.25f, 0.5f, 1.0f, 1.0f));
    EXPECT_EQ(pixel(stored(frame::Channel::Albedo, true, exact), 4, 4), glm::vec4(0.375f, 0.375f, 0.375f, 1.0f));
    EXPECT_EQ(pixel(stored(frame::Channel::Normal, false, exact), 4, 4), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(stored(frame::Channel::Normal, false, exact).display[0], 128) << "directions are n/2 + 1/2";
    EXPECT_EQ(pixel(stored(frame::Channel::Normal, true, exact), 4, 4).r, 0.25f) << "alpha";
    // Fields as fractions of their largest codes. The normal is octahedral: 0 is the middle of an odd number of steps.
    const float middle = 16383.0f / 32767.0f;
    EXPECT_EQ(pixel(stored(frame::Channel::Normal, false, packed), 4, 4), glm::vec4(middle, middle, 0, 1));
    // The square root of the colour in 10 bits, of which 1020 steps, a multiple of five, are used; a value between two
    // steps rounds to either.
    const glm::vec4 codes = pixel(stored(frame::Channel::Albedo, false, packed), 4, 4) * 1023.0f;
    EXPECT_NEAR(codes.r, 0.5 * 1020.0, 1e-3);
    EXPECT_NEAR(codes.g, std::sqrt(0.5) * 1020.0, 1.0);
    EXPECT_NEAR(codes.b, 1020.0, 1e-3);
    for (const float code : {codes.r, codes.g, codes.b}) EXPECT_NEAR(code, std::round(code), 1e-4) << "a whole code";
}

/// There the error of the stored normal affects the tangent's frame least (docs/numerics.md).
TEST_F(ViewValues, aTangentIsStoredBesideTheAxisFarthestFromItsNormal) {
    Material material = materialOf(MaterialModel::MicrofacetAnisotropic);
    const Scene upright = flatScene(material);
    frame::FrameSettings settings;
    settings.layout = frame::layoutTable()[1].layout;
    const frame::DebugView view = frame::storedDebugView({frame::Channel::Tangent, false});
    std::array<int, 3> order{0, 1, 2}; // of the normal's components by size
    do {
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 normal;
            normal[order[0]] = 0.2 * sign;
            normal[order[1]] = -0.5;
            normal[order[2]] = 0.8 * sign;
            const glm::dvec3 n = glm::normalize(normal), right = glm::normalize(glm::cross(normal, {0.3, 0.4, 0.5}));
            const glm::dmat4 turn(glm::dmat3(right, glm::cross(n, right), n));
            Scene scene = upright;
            scene.nodes[0].parentFromNode = turn * scene.nodes[0].parentFromNode;
            scene.cameras[0].worldFromCamera = turn * scene.cameras[0].worldFromCamera;
            const float code = 3.0f * pixel(shown(scene, view, Technique::Deferred, settings), 4, 4).r;
            EXPECT_EQ(code, float(order[0])) << normal.x << " " << normal.y << " " << normal.z;
        }
    } while (std::ranges::next_permutation(order).found);
}

TEST_F(ViewValues, storedChannelsAreNotShownWhereThereAreNone) {
    const Scene scene = flatScene(Material{});
    const auto message = [&](Technique technique, frame::Channel channel) -> std::string {
        frame::FrameSettings settings = viewSettings(frame::storedDebugView({channel, false}));
        return errorText<InputError>([&] { engine::prepareView(scene, technique, settings); });
    };
    EXPECT_EQ(message(Technique::ForwardPlus, frame::Channel::Albedo),
              "technique forward_plus does not support view gbuffer.albedo, since it has no G-buffer; deferred, "
              "deferred_volumes, tiled_deferred, clustered_deferred do");
    EXPECT_EQ(message(Technique::Deferred, frame::Channel::Sheen),
              "view gbuffer.sheen: this frame's G-buffer has no such channel, which is for scenes with cloth; it has "
              "albedo, normal");
    EXPECT_EQ(message(Technique::Deferred, frame::Channel::NormalTexel), "") << "stored when it is shown";
}

TEST_F(ViewValues, theDepthViewIsTheDistanceAheadOfTheEyeHoweverFar) {
    for (const double metres : {3.0, 1e3, 1e6}) {
        Scene scene = quadScene(unlit());
        scene.nodes.push_back(scene.nodes[0]); // twice as large, a metre behind
        scene.nodes[1].parentFromNode = glm::dmat4(2.0);
        scene.nodes[1].parentFromNode[3] = {0, 0, -1, 1};
        scene.cameras[0].worldFromCamera[3].z = metres;
        scene.cameras[0].fovYRadians = 2.0 * std::atan(1.4 / metres); // 1.4 m up and down at the quad
        const engine::RenderedFrame view = frame(scene, viewSettings(frame::DebugView::Depth));
        // Some four roundings of 2^-24 each.
        EXPECT_NEAR(pixel(view, kSide / 2, kSide / 2).r, metres, 3e-7 * metres);
        EXPECT_NEAR(pixel(view, 0, 0).r, metres + 1.0, 3e-7 * (metres + 1.0));
    }
}

TEST_F(ViewValues, aLightThatIsDarkHasNoHighlightToShowAndAnotherNeverStandsInForIt) {
    Material material = materialOf(MaterialModel::Microfacet);
    Scene scene = flatScene(material);
    scene.lights = {pointLight({0.0, 0.0, 1.0}, 1.0f), pointLight({0.5, 0.5, 1.0}, 1.0f)};
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = viewSettings(frame::DebugView::Distribution);
    settings.sizePixels = {kSide, kSide};
    const auto brightest = [&](Technique technique) {
        const std::vector<float> values = renderer.render(technique, settings).radiance;
        float most = 0.0f;
        for (std::size_t i = 0; i < values.size(); i += 4) most = std::max(most, values[i]);
        return most;
    };
    for (const Technique technique : {Technique::Forward, Technique::Deferred}) {
        scene.lights[0].intensity = 1.0f;
        EXPECT_GT(brightest(technique), 0.1f);
        scene.lights[0].intensity = 0.0f; // it is still the displayed light, but not packed
        EXPECT_EQ(brightest(technique), 0.0f);
    }
}

TEST_F(ViewValues, distributionsOfAnySizeFitTheDisplay) {
    Material material = materialOf(MaterialModel::Microfacet);
    Scene scene = flatScene(material);
    scenes::Light sun = sunLight({0, 0, -1}, 1.0f);
    scene.lights = {sun};
    int last = 0;
    for (const float alpha : {1.0f, 0.5f, 0.25f, 0.1f}) { // D = 1 / (pi alpha^2): 0.3 to 32
        scene.materials[0].alpha = alpha;
        const engine::RenderedFrame view = frame(scene, viewSettings(frame::DebugView::Distribution));
        const double d = 1.0 / (std::numbers::pi * alpha * alpha);
        EXPECT_NEAR(view.radiance[0], d, 1e-5 * d);
        EXPECT_GT(view.display[0], last);
        last = view.display[0];
    }
    EXPECT_LT(last, 255);
}

} // namespace
} // namespace tessera
