#pragma once
#include <cstring>
#include <memory>
#include <vector>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/GBufferLayout.h"
#include "shaders/shared/models.h"
#include "tests/gpu/shaders/ShaderBench.h"

namespace tessera::test {

/// In the order of store.frag; compared bytewise.
struct StoredSurface {
    glm::vec3 albedo{0.5f};
    float metallic = 0.0f;
    glm::vec3 normal{0, 0, 1};
    float alpha = 0.25f;
    glm::vec3 specular{0.5f};
    float iorOrF90 = 1.0f;
    glm::vec3 emission{0.0f};
    float model = float(scenes::MaterialModel::Microfacet);
    glm::vec3 normalTexel{0.5f, 0.5f, 1.0f};
    float exponent = 0.0f;
    glm::vec3 tangent{1, 0, 0};
    float alphaBitangent = 0.25f;
    glm::vec2 coatNormal{0.0f}; ///< octahedral
    float coatFactor = 0.0f;
    float coatAlpha = 0.25f;
    glm::vec3 sheenColor{0.0f};
    float sheenAlpha = 0.25f;
    float masking = 0.0f;
    glm::vec3 unused{0.0f};
};
constexpr std::size_t kVectors = 9;
static_assert(sizeof(StoredSurface) == kVectors * sizeof(glm::vec4));

inline const shader::Defines kEveryMember = frame::featureDefines(frame::allFeatures());

/// Renders surfaces into the channels of the table and reads them back.
class GBufferTest : public GlTest {
protected:
    /// All channels; the normal-map texel in a separate run, as OpenGL guarantees eight attachments.
    std::vector<StoredSurface> roundTrip(const std::vector<StoredSurface>& surfaces, frame::Encoding encoding) {
        std::vector<frame::Channel> channels;
        for (const frame::ChannelInfo& info : frame::channelTable())
            if (info.channel != frame::Channel::NormalTexel) channels.push_back(info.channel);
        std::vector<StoredSurface> result = roundTrip(surfaces, encoding, channels);
        const std::vector<StoredSurface> texels = roundTrip(surfaces, encoding, {frame::Channel::NormalTexel});
        for (std::size_t i = 0; i < result.size(); ++i) result[i].normalTexel = texels[i].normalTexel;
        return result;
    }

    std::vector<StoredSurface> roundTrip(const std::vector<StoredSurface>& surfaces, frame::Encoding encoding,
                                         const std::vector<frame::Channel>& channels) {
        constexpr int kWidth = 512;
        const int height = (int(surfaces.size()) + kWidth - 1) / kWidth;
        std::vector<StoredSurface> padded = surfaces;
        padded.resize(std::size_t(kWidth * height));

        frame::GBufferLayout layout;
        layout.encoding.fill(encoding);
        std::vector<std::unique_ptr<gpu::Texture>> textures;
        gpu::Attachments attachments;
        for (const frame::GBufferTexture& texture : frame::gbufferTextures(layout, channels)) {
            const graph::TextureDesc desc{texture.format, kWidth, height, 1};
            textures.push_back(std::make_unique<gpu::Texture>(texture.name, desc));
            attachments.colors.push_back(textures.back().get());
        }
        shader::Defines defines = frame::channelDefines(layout, channels);
        defines.insert(defines.end(), kEveryMember.begin(), kEveryMember.end());
        defines.emplace_back("WIDTH", std::to_string(kWidth));

        const gpu::Program& store =
            bench.programs().get({"store", "passes/fullscreen.vert", "test/store.frag", "", defines});
        const gpu::Buffer in = gpu::Buffer::of("surfaces", padded);
        gpu::FramebufferCache framebuffers;
        gpu::bindFramebuffer(framebuffers.get(attachments));
        gpu::setState({});
        gpu::useProgram(store);
        gpu::bindStorageBuffer(0, in);
        gpu::drawFullscreenTriangle();

        for (std::size_t i = 0; i < textures.size(); ++i)
            gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), *textures[i]);
        const std::vector<glm::vec4> out =
            bench.run("test/load.comp", defines, {glm::vec4(0.0f)}, padded.size(), kVectors);
        std::vector<StoredSurface> result(padded.size());
        std::memcpy(static_cast<void*>(result.data()), out.data(), result.size() * sizeof(StoredSurface));
        result.resize(surfaces.size());
        return result;
    }

    ShaderBench bench;
};

} // namespace tessera::test
