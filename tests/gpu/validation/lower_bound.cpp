// The measured lower bound: its shaders compute the product's lighting, and it reports all of its figures.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/PrepareView.h"
#include "passes/DeferredLightingPass.h"
#include "scenes/Load.h"
#include "shaders/shared/models.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "validation/lower_bound/LowerBoundBench.h"
#include "validation/lower_bound/LowerBoundLights.h"

namespace tessera {
namespace {

using validation::LowerBoundLighting;

/// One light of every type and falloff.
frame::PackedLights everyKind() {
    frame::PackedLights lights;
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        lights.texels.emplace_back().color.w = float(int(type.type));
        if (type.hasPosition() && !type.isArea)
            lights.texels.emplace_back().color.w = float(int(type.type) | LIGHT_ATTENUATION);
    }
    return lights;
}

/// Number of values that differ.
int differences(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] == b[i] ? 0 : 1;
    return count;
}

class LowerBoundTest : public test::GlTest {
protected:
    static constexpr glm::ivec2 kSize{160, 90};
    static constexpr validation::LightStoreInfo kProductsStore{LIGHT_STORE_TEXEL, "texel buffer", "LIGHT_STORE_TEXEL"};

    static frame::FrameSettings settings() {
        frame::FrameSettings result;
        result.sizePixels = kSize;
        return result;
    }
    static scenes::Scene lattice(int lights) {
        scenes::LoadOptions options;
        options.lights = lights;
        return scenes::loadScene("lattice", options);
    }
    /// Specs of a scene with one model and one type of light, and of all features, whose models and types alternate.
    static std::vector<frame::FrameSpec> specs() {
        const scenes::Scene scene = lattice(16);
        std::vector<frame::FrameSpec> result{engine::prepareView(scene, engine::Technique::Forward, settings()).spec};
        // Every pixel of the lower bound's surface has another material.
        result[0].features.add(frame::Feature::VaryingMaterials);
        result[0].channels = frame::neededChannels(result[0].features, settings().layout, false);
        result.emplace_back().settings = settings();
        result.back().features = frame::allFeatures();
        result.back().channels = frame::neededChannels(result.back().features, settings().layout, false);
        return result;
    }
    static frame::PackedLights lightsOf(const frame::FrameSpec& spec, int count) {
        if (spec.features[frame::featureOf(scenes::LightType::Spot)])
            return validation::lowerBoundLights(everyKind(), count);
        return validation::lowerBoundLights({}, count);
    }
    static std::vector<float> draw(LowerBoundLighting& lighting, const validation::LightStoreInfo& store) {
        lighting.draw(store);
        return lighting.download();
    }

    /// The lower bound's surface in an exact G-buffer.
    struct StoredSurface {
        std::vector<std::unique_ptr<gpu::Texture>> channels; ///< in the order of FrameSpec::channels
        std::unique_ptr<gpu::Texture> depth;
    };
    StoredSurface storeSurface(const frame::FrameSpec& spec, const LowerBoundLighting& lighting) {
        StoredSurface stored;
        gpu::Attachments attachments;
        for (const frame::GBufferTexture& texture : spec.gbufferTextures()) {
            stored.channels.push_back(std::make_unique<gpu::Texture>(texture.name, spec.texture(texture.format)));
            attachments.colors.push_back(stored.channels.back().get());
        }
        stored.depth = std::make_unique<gpu::Texture>("depth", spec.texture(graph::Format::Depth32Float));
        attachments.depth = stored.depth.get();
        const gpu::Framebuffer gbuffer(attachments);
        gpu::bindFramebuffer(gbuffer);
        gpu::PipelineState state;
        state.depthTest = gpu::DepthTest::Always;
        state.depthWrite = true;
        gpu::setState(state);
        gpu::useProgram(bench.programs().get(
            frame::frameProgram(spec, "bound_gbuffer", "passes/fullscreen.vert", "test/bound_gbuffer.frag",
                                frame::channelDefines(spec.settings.layout, spec.channels))));
        lighting.bindConstants();
        gpu::drawFullscreenTriangle();
        return stored;
    }

    /// That surface, lit by the shader of the deferred techniques.
    std::vector<float> deferredPicture(const frame::FrameSpec& spec, const LowerBoundLighting& lighting) {
        const StoredSurface stored = storeSurface(spec, lighting);
        const gpu::Texture radiance("radiance", spec.texture(graph::Format::Rgba32Float));
        const gpu::Framebuffer target({{&radiance}, nullptr});
        gpu::bindFramebuffer(target);
        gpu::setState({});
        gpu::useProgram(bench.programs().get(passes::DeferredLightingPass::program(spec, {})));
        lighting.bindConstants();
        lighting.bindLights(kProductsStore);
        for (std::size_t i = 0; i < stored.channels.size(); ++i)
            gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), *stored.channels[i]);
        gpu::bindTexture(TEXTURE_UNIT_DEPTH, *stored.depth);
        gpu::drawFullscreenTriangle();
        return radiance.downloadAs<float>();
    }

    test::ShaderBench bench;
};

TEST_F(LowerBoundTest, everyLightStoreGivesTheVerySamePicture) {
    for (const frame::FrameSpec& spec : specs()) {
        LowerBoundLighting lighting(bench.programs(), spec);
        lighting.setLights(lightsOf(spec, validation::LowerBoundBench::kManyLights));
        const std::vector<float> first = draw(lighting, validation::lightStoreTable()[0]);
        EXPECT_GT(*std::min_element(first.begin(), first.end()), 0.0f);
        for (const validation::LightStoreInfo& store : validation::lightStores(context().capabilities()))
            EXPECT_EQ(differences(draw(lighting, store), first), 0) << store.name;
    }
}

TEST_F(LowerBoundTest, itsPictureEqualsThatOfTheDeferredTechniques) {
    for (const frame::FrameSpec& spec : specs()) {
        LowerBoundLighting lighting(bench.programs(), spec);
        for (const int count :
             {0, 1, validation::LowerBoundBench::kFewLights, validation::LowerBoundBench::kManyLights}) {
            lighting.setLights(lightsOf(spec, count));
            EXPECT_EQ(differences(draw(lighting, validation::lightStoreTable()[0]),
                                  deferredPicture(lighting.spec(), lighting)),
                      0)
                << count << " lights";
        }
    }
}

TEST_F(LowerBoundTest, hardwareThatReadsConstantsFromBlocksGivesTheVerySamePicture) {
    for (const frame::FrameSpec& spec : specs()) {
        LowerBoundLighting lighting(bench.programs(), spec);
        lighting.setLights(lightsOf(spec, validation::LowerBoundBench::kManyLights));
        frame::FrameSpec onHardware = lighting.spec();
        onHardware.settings.softwareBackend = !spec.settings.softwareBackend;
        ASSERT_NE(passes::DeferredLightingPass::program(spec, {}).defines,
                  passes::DeferredLightingPass::program(onHardware, {}).defines);
        EXPECT_EQ(differences(deferredPicture(onHardware, lighting), deferredPicture(lighting.spec(), lighting)), 0);
    }
}

TEST_F(LowerBoundTest, everyLightReachesEveryPixelFromTheFront) {
    for (const frame::FrameSpec& spec : specs()) {
        LowerBoundLighting lighting(bench.programs(), spec);
        const frame::PackedLights lights = lightsOf(spec, validation::LowerBoundBench::kManyLights);
        for (std::size_t i = 0; i < lights.texels.size(); ++i) {
            frame::PackedLights one;
            one.texels = {lights.texels[i]};
            one.shapes = {lights.shapes[i]};
            if (!lights.corners.empty()) one.corners = {lights.corners[i]};
            lighting.setLights(one);
            const std::vector<float> picture = draw(lighting, validation::lightStoreTable()[0]);
            ASSERT_GT(*std::min_element(picture.begin(), picture.end()), 0.0f);
        }
    }
}

TEST_F(LowerBoundTest, neighbouringPixelsNeverShareAPropertyOfTheSurface) {
    constexpr double kMostAlike = 1e-3; // two values may round to the same one
    for (const frame::FrameSpec& spec : specs()) {
        const StoredSurface stored = storeSurface(spec, LowerBoundLighting(bench.programs(), spec));
        const auto expectVaried = [](const gpu::Texture& texture, std::size_t components, std::size_t component) {
            const std::vector<float> values = texture.downloadAs<float>();
            std::size_t same = 0;
            for (std::size_t i = components + component; i < values.size(); i += components)
                same += values[i] == values[i - components] ? 1 : 0;
            EXPECT_LE(same, kMostAlike * values.size() / components) << "component " << component;
        };
        // A microfacet model is never metallic and stores its masking there, a discrete option like the model.
        const auto expectMetallicVaried = [](const gpu::Texture& microsurface) {
            const std::vector<glm::vec4> values = microsurface.downloadAs<glm::vec4>();
            for (std::size_t i = 1; i < values.size(); ++i) {
                const auto model = unsigned(values[i].y);
                if (model == unsigned(scenes::MaterialModel::Microfacet) ||
                    model == unsigned(scenes::MaterialModel::MicrofacetAnisotropic))
                    continue;
                ASSERT_NE(values[i].w, values[i - 1].w) << "metallic of pixel " << i;
            }
        };
        expectVaried(*stored.depth, 1, 0);
        for (std::size_t channel = 0; channel < spec.channels.size(); ++channel) {
            SCOPED_TRACE(frame::channelTable()[std::size_t(spec.channels[channel])].name);
            switch (spec.channels[channel]) {
            case frame::Channel::Albedo: // and metallic
            case frame::Channel::Normal: // and alpha
                for (const std::size_t component : {0, 1, 2, 3}) expectVaried(*stored.channels[channel], 4, component);
                break;
            case frame::Channel::Specular:
                for (const std::size_t component : {0, 1, 2}) expectVaried(*stored.channels[channel], 4, component);
                break;
            case frame::Channel::Microsurface: // alpha, index of refraction, F90 or exponent; not the model
                for (const std::size_t component : {0, 2}) expectVaried(*stored.channels[channel], 4, component);
                expectMetallicVaried(*stored.channels[channel]);
                break;
            case frame::Channel::Tangent: // and alpha
                for (const std::size_t component : {0, 1, 2, 3}) expectVaried(*stored.channels[channel], 4, component);
                break;
            case frame::Channel::Clearcoat: // normal, alpha; the factor only if the model has one
                for (const std::size_t component : {0, 1, 3}) expectVaried(*stored.channels[channel], 4, component);
                break;
            case frame::Channel::Sheen: // alpha; the colour only if the model has one
                expectVaried(*stored.channels[channel], 4, 3);
                break;
            default: // not used by the loop over lights
                break;
            }
        }
    }
}

TEST_F(LowerBoundTest, itsGeometryCoversExactlyThePixelsOfTheProduct) {
    for (const char* name : {"lattice", "hall"}) {
        const scenes::Scene scene = scenes::loadScene(name);
        engine::Renderer renderer(context(), scene);
        validation::LowerBoundGeometry geometry(renderer, settings());
        geometry.draw(glm::dvec3(0.0));
        const std::vector<float> drawn = geometry.download();
        const engine::RenderedFrame frame = renderer.render(engine::Technique::Forward, settings());
        std::size_t covered = 0;
        for (int y = 0; y < kSize.y; ++y) {
            for (int x = 0; x < kSize.x; ++x) {
                const std::size_t at = std::size_t((kSize.y - 1 - y) * kSize.x + x) * 4; // rows run from the bottom
                const bool isCovered = frame.radiance[std::size_t(y * kSize.x + x) * 4 + 3] > 0.0f;
                ASSERT_EQ(drawn[at] == 1.0f, isCovered) << name << " " << x << " " << y;
                covered += isCovered;
            }
        }
        EXPECT_GT(covered, std::size_t(kSize.x * kSize.y) / 10) << name;
    }
}

TEST_F(LowerBoundTest, geometryAndEveryLightStoreCostSomething) {
    const scenes::Scene scene = lattice(256);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings large = settings();
    large.sizePixels = {320, 180};
    validation::LowerBoundBench lowerBound(renderer, large);
    const validation::LowerBoundFigures figures = lowerBound.measure({.rounds = 7});
    EXPECT_GT(figures.geometryMs, 0.0);
    ASSERT_EQ(figures.stores.size(), validation::lightStores(context().capabilities()).size());
    fmt::print("R {:.2f} ms\n", figures.geometryMs);
    for (const validation::LowerBoundFigures::Store& store : figures.stores) {
        fmt::print("r {:.2f} ns, {}\n", store.nsPerPair, store.name);
        EXPECT_GT(store.nsPerPair, 0.0) << store.name;
        EXPECT_GE(store.nsPerPair, figures.fastestStore()->nsPerPair);
    }
}

TEST_F(LowerBoundTest, aSceneWithoutLightHasNoCostPerPair) {
    const scenes::Scene scene = lattice(0);
    engine::Renderer renderer(context(), scene);
    validation::LowerBoundBench lowerBound(renderer, settings());
    const validation::LowerBoundFigures figures = lowerBound.measure({.rounds = 1});
    EXPECT_TRUE(figures.stores.empty());
    EXPECT_FALSE(figures.whyNoStores.empty());
    EXPECT_EQ(figures.lowerBoundMs(0.0), figures.geometryMs);
    EXPECT_FALSE(figures.lowerBoundMs(1.0).has_value());
}

} // namespace
} // namespace tessera
