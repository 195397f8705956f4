// Keeping a resource of the frame graph to the end changes no pixel, and returns the resource that the plan describes.
#include <gmock/gmock.h>

#include "renderer/graph/Plan.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using namespace test;

class KeptResources : public ImageTest {
protected:
    /// Keeps each resource of the plan in turn.
    void expectAllOf(const scenes::Scene& scene, engine::Technique technique, const frame::FrameSettings& settings) {
        engine::Renderer renderer(context(), scene);
        const engine::RenderedFrame truth = renderer.render(technique, settings);
        EXPECT_FALSE(renderer.keptResource());
        const graph::Plan plan =
            engine::planFrame(scene, technique, engine::settingsOn(context().capabilities(), settings));
        ASSERT_GT(plan.resources.size(), 3u);
        for (const graph::Plan::Resource& resource : plan.resources) {
            SCOPED_TRACE(resource.name);
            renderer.keepResource(resource.name);
            const engine::RenderedFrame drawn = renderer.render(technique, settings);
            EXPECT_TRUE(drawn.radiance == truth.radiance && drawn.display == truth.display);
            const std::optional<engine::KeptResource> kept = renderer.keptResource();
            if (!kept) { // shadow maps are already drawn
                EXPECT_TRUE(resource.name.starts_with("shadow_draw"));
                continue;
            }
            ASSERT_NE(kept->texture == nullptr, kept->buffer == nullptr);
            if (kept->texture == nullptr) {
                EXPECT_EQ(resource.format, "buffer");
                EXPECT_LE(kept->bytes, kept->buffer->bytes());
                continue;
            }
            const graph::TextureDesc& desc = kept->texture->desc();
            EXPECT_EQ(resource.format, graph::formatInfo(desc.format).name);
            EXPECT_EQ(glm::ivec2(resource.width, resource.height), glm::ivec2(desc.width, desc.height));
            if (resource.name == "depth") {
                EXPECT_TRUE(kept->texture->downloadAs<float>() == renderer.downloadDepth());
            }
        }
        renderer.keepResource("nothing");
        renderer.draw(technique, settings);
        EXPECT_FALSE(renderer.keptResource());
    }
};

TEST_F(KeptResources, ofADeferredFrameWithShadowMapsAndOfAClusteredOne) {
    const scenes::Scene scene = scenes::loadScene("room");
    expectAllOf(scene, engine::Technique::Deferred, withShadows(ofSize(48, 27), frame::ShadowFilter::Pcf));
    expectAllOf(scene, engine::Technique::ClusteredForward, ofSize(48, 27));
}

} // namespace
} // namespace tessera
