#include "passes/ShadowAtlasPass.h"

#include <algorithm>

#include "renderer/frame/ShadowCameras.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/shadow_maps.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// Layout of the atlas in the image: strips of whole faces, stacked vertically, since the atlas may be very wide.
struct Layout {
    int strips = 1;
    int stripTexels = 1; ///< width of a strip
    double texelsPerPixel = 0.0;
    glm::ivec2 stripPixels{0};
    glm::ivec2 corner{0}; ///< lower-left of all strips, in pixels

    glm::ivec2 stripCorner(int strip) const { return corner + glm::ivec2(0, (strips - 1 - strip) * stripPixels.y); }
};

/// Chooses the number of strips that makes texels largest.
Layout layoutOf(const frame::ShadowMaps& maps, const glm::ivec2& sizePixels) {
    int largest = 1;
    for (const frame::ShadowFace& face : maps.faces) largest = std::max(largest, face.sideTexels);
    const int blocks = maps.atlasTexels.x / largest;
    Layout best;
    for (int strips = 1; strips <= blocks; ++strips) {
        const int width = (blocks + strips - 1) / strips * largest;
        const glm::dvec2 texels = glm::dvec2(width, strips * maps.atlasTexels.y) / glm::dvec2(sizePixels);
        const double texelsPerPixel = std::max(texels.x, texels.y);
        if (strips > 1 && texelsPerPixel >= best.texelsPerPixel) continue;
        const glm::dvec2 pixels = glm::dvec2(width, maps.atlasTexels.y) / texelsPerPixel;
        best = {strips, width, texelsPerPixel, glm::max(glm::ivec2(pixels + 1e-6), glm::ivec2(1)), {}};
    }
    best.corner = (sizePixels - best.stripPixels * glm::ivec2(1, best.strips)) / 2;
    return best;
}

/// The pixels of a strip that may show a face, whose corner is in texels of the strip.
gpu::Rectangle pixelsOf(const glm::ivec2& cornerTexels, int sideTexels, const glm::ivec2& stripCorner,
                        const Layout& layout) {
    const glm::dvec2 low = glm::dvec2(cornerTexels) / layout.texelsPerPixel;
    const glm::dvec2 high = glm::dvec2(cornerTexels + sideTexels) / layout.texelsPerPixel;
    const glm::ivec2 first(glm::floor(low));
    const glm::ivec2 size = glm::max(glm::min(glm::ivec2(glm::ceil(high)), layout.stripPixels) - first, glm::ivec2(0));
    return {stripCorner.x + first.x, stripCorner.y + first.y, size.x, size.y};
}

void drawFaces(const frame::ShadowMaps& maps, const Layout& layout, const graph::PassContext& context) {
    for (const frame::ShadowedLight& light : maps.lights) {
        for (int i = 0; i < light.faces && light.sideTexels > 0; ++i) {
            const frame::ShadowFace& face = maps.faces[light.firstFace + std::size_t(i)];
            const int strip = face.cornerTexels.x / layout.stripTexels;
            const glm::ivec2 first(strip * layout.stripTexels, 0), stripCorner = layout.stripCorner(strip);
            gpu::setScissor(pixelsOf(face.cornerTexels - first, face.sideTexels, stripCorner, layout));
            const bool isParallel = face.camera.projection == scenes::Projection::Orthographic;
            const shared::ShownFaceConstants constants{
                glm::vec4(stripCorner, layout.texelsPerPixel, first.x),
                glm::vec4(face.cornerTexels, face.sideTexels, i + 1),
                glm::vec4(isParallel ? 0.0f : float(frame::kFaceNearShare), 0.0f, 0.0f, 0.0f)};
            context.constants(UNIFORM_PASS, constants);
            gpu::drawFullscreenTriangle();
        }
    }
}

} // namespace

shader::ProgramDesc ShadowAtlasPass::program() {
    return shader::screenProgram("shadow_atlas", "passes/shadow_atlas.frag");
}

ShadowAtlasPass::Outputs ShadowAtlasPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "shown_atlas",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program());
            if (inputs.atlas) out.atlas = pass.read(*inputs.atlas);
            out.radiance = pass.create("radiance", spec.renderTarget(graph::Format::Rgba32Float));
            out.depth =
                pass.create("depth", spec.renderTarget(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [drawn = inputs.drawn](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearDepth(0.0f);
            gpu::clearColor(0, glm::vec4(0.0f, 0.0f, 0.0f, out.atlas ? 0.0f : 1.0f));
            if (!out.atlas) return;
            const frame::PreparedView& prepared = drawn->prepared;
            const Layout layout = layoutOf(prepared.shadowMaps, prepared.spec.settings.sizePixels);
            gpu::setScissor(
                {layout.corner.x, layout.corner.y, layout.stripPixels.x, layout.strips * layout.stripPixels.y});
            gpu::clearColor(0, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
            gpu::setState({});
            gpu::useProgram(context.program());
            gpu::bindTexture(TEXTURE_UNIT_SHADOWS, context.texture(*out.atlas));
            drawFaces(prepared.shadowMaps, layout, context);
        });
}

} // namespace tessera::passes
