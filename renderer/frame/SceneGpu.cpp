#include "renderer/frame/SceneGpu.h"

#include <cstring>

#include <fmt/format.h>

#include "renderer/frame/PackedMaterial.h"
#include "renderer/frame/TextureLevels.h"
#include "renderer/gpu/Commands.h"
#include "scenes/InUse.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

namespace {

/// What GL guarantees to accept as offset of a uniform range (the largest GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT allowed).
constexpr std::size_t kUniformAlignment = 256;

/// Anisotropy of material textures under the hardware filter. Doubles the cost of a textured pass on software
/// rasterisers, so it stays at trilinear.
constexpr float kAnisotropy = 1.0f;

std::vector<scenes::AlphaMode> alphaModes(const scenes::Scene& scene) {
    std::vector<scenes::AlphaMode> modes;
    for (const scenes::Material& material : scene.materials) modes.push_back(material.alphaMode);
    return modes;
}

std::vector<std::optional<TangentBasis>> tangentBases(const scenes::Scene& scene) {
    std::vector<std::optional<TangentBasis>> bases;
    for (const scenes::Material& material : scene.materials) bases.push_back(tangentBasis(material));
    return bases;
}

gpu::VertexAttribute attribute(std::uint32_t location, int components, const gpu::Buffer* buffer, std::size_t stride,
                               std::size_t offset = 0, std::uint32_t divisor = 0) {
    gpu::VertexAttribute result;
    result.location = location;
    result.components = components;
    result.buffer = buffer;
    result.stride = stride;
    result.offset = offset;
    result.divisor = divisor;
    return result;
}

} // namespace

SceneGpu::SceneGpu(const scenes::Scene& scene, const FeatureSet& features, TextureFilter filter)
    : scene_(scene), features_(features), filter_(filter), drawList_(makeDrawList(scene)),
      alphaModes_(alphaModes(scene)), materialsInUse_(scenes::inUse(scene).materials) {
    uploadGeometry(makeVertexStreams(scene_, features_));
    uploadMaterials();
    uploadTextures();
}

void SceneGpu::uploadGeometry(const VertexStreams& streams) {
    tangentBases_ = tangentBases(scene_);
    vertexBuffers_.clear();
    drawRows_ =
        std::make_unique<gpu::Buffer>("draw rows", drawList_.draws.size() * sizeof(DrawRows), gpu::BufferUse::Dynamic);
    std::vector<gpu::VertexAttribute> attributes;
    const auto stream = [&](std::uint32_t location, const char* label, const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (values.empty()) return;
        vertexBuffers_.push_back(std::make_unique<gpu::Buffer>(gpu::Buffer::of(label, values)));
        attributes.push_back(attribute(location, Value::length(), vertexBuffers_.back().get(), sizeof(Value)));
    };
    stream(ATTRIBUTE_POSITION, "positions", streams.positionsOS);
    stream(ATTRIBUTE_NORMAL, "normals", streams.normalsOS);
    stream(ATTRIBUTE_TANGENT, "tangents", streams.tangentsOS);
    stream(ATTRIBUTE_TEXCOORD0, "texture coordinates 0", streams.texCoords[0]);
    stream(ATTRIBUTE_TEXCOORD1, "texture coordinates 1", streams.texCoords[1]);
    stream(ATTRIBUTE_COLOR, "vertex colours", streams.colors);
    for (std::uint32_t row = 0; row < 3; ++row) {
        const std::size_t offset = row * sizeof(glm::vec4);
        attributes.push_back(attribute(ATTRIBUTE_DRAW_POSITION_ROW0 + row, 4, drawRows_.get(), sizeof(DrawRows),
                                       offsetof(DrawRows, position) + offset, 1));
        attributes.push_back(attribute(ATTRIBUTE_DRAW_NORMAL_ROW0 + row, 4, drawRows_.get(), sizeof(DrawRows),
                                       offsetof(DrawRows, normal) + offset, 1));
    }
    indices_ = std::make_unique<gpu::Buffer>(gpu::Buffer::of("indices", streams.indices));
    vertexArray_ = std::make_unique<gpu::VertexArray>("scene", attributes, indices_.get());

    ranges_ = streams.ranges;
    uploadDraws();
}

void SceneGpu::uploadDraws() {
    std::vector<gpu::DrawIndexedCommand> commands;
    for (const Draw& draw : drawList_.draws) {
        const VertexStreams::Range& range = ranges_.at({draw.mesh, draw.material});
        commands.push_back({range.indexCount, 1, range.firstIndex, range.baseVertex, std::uint32_t(commands.size())});
    }
    commands_ = std::make_unique<gpu::Buffer>(gpu::Buffer::of("draw commands", commands));
}

void SceneGpu::uploadMaterials() {
    materialStride_ =
        (sizeof(shared::MaterialConstants) + kUniformAlignment - 1) / kUniformAlignment * kUniformAlignment;
    constexpr std::size_t kTabledBytes = MATERIAL_TEXELS * sizeof(glm::vec4);
    static_assert(kTabledBytes == offsetof(shared::MaterialConstants, uvRow0));
    std::vector<std::byte> bytes(materialStride_ * scene_.materials.size());
    std::vector<std::byte> tabled;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
        shared::MaterialConstants constants = packMaterial(scene_.materials[i]);
        for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
            if (shadersDecode(scene_.materials[i], slot)) constants.uvRow1[slot].w += float(TEXTURE_MODE_SRGB);
        }
        constants.kind.w = glm::uint(tabled.size() / kTabledBytes);
        std::memcpy(bytes.data() + i * materialStride_, &constants, sizeof constants);
        if (!materialsInUse_[i]) continue;
        const auto* const first = reinterpret_cast<const std::byte*>(&constants);
        tabled.insert(tabled.end(), first, first + kTabledBytes);
    }
    if (!features_[Feature::VaryingMaterials] && !tabled.empty()) {
        materialTable_.reset();
        tabledMaterials_ = std::make_unique<gpu::Buffer>(gpu::Buffer::of("material table", tabled));
        materialTable_ =
            std::make_unique<gpu::TexelBuffer>("material table", graph::Format::Rgba32Uint, *tabledMaterials_);
    }
    materials_ = std::make_unique<gpu::Buffer>(gpu::Buffer::of("materials", bytes));
}

void SceneGpu::updateMaterials() {
    // First what may throw, so that all is as it was then.
    std::optional<VertexStreams> streams;
    if (features_.tangents() && tangentBases(scene_) != tangentBases_) streams = makeVertexStreams(scene_, features_);
    uploadMaterials();
    // Blended surfaces are drawn last, in an order of their own.
    const bool reorders = alphaModes(scene_) != alphaModes_;
    if (reorders) {
        alphaModes_ = alphaModes(scene_);
        drawList_ = makeDrawList(scene_);
    }
    if (streams)
        uploadGeometry(*streams);
    else if (reorders)
        uploadDraws();
}

bool SceneGpu::shadersDecode(const scenes::Material& material, std::size_t slot) const {
    const int image = material.textures[slot].image;
    return filter_ == TextureFilter::Exact && image != scenes::kNone && slotIsSrgb(scenes::TextureSlot(slot)) &&
           scene_.images[std::size_t(image)].format == scenes::TexelFormat::Rgba8Unorm;
}

void SceneGpu::uploadTextures() {
    white_ = std::make_unique<gpu::Texture>("white", graph::TextureDesc{graph::Format::Rgba8Unorm, 1, 1, 1});
    white_->upload(0, std::vector<std::uint8_t>(4, 255));
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
        const scenes::Material& material = scene_.materials[i];
        for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
            const scenes::TextureUse& use = material.textures[slot];
            if (!materialsInUse_[i] || use.image == scenes::kNone) {
                bound_.push_back({white_.get(), nullptr});
            } else {
                const bool srgb = slotIsSrgb(scenes::TextureSlot(slot)) && !shadersDecode(material, slot);
                // Exact filtering fetches texels. A sampler would change nothing there but the number of programs that
                // a driver compiles: llvmpipe compiles one for each.
                const bool fetches = filter_ == TextureFilter::Exact;
                bound_.push_back({uploadImage(use.image, srgb), fetches ? nullptr : sampler(use.sampler)});
            }
        }
    }
}

const gpu::Texture* SceneGpu::uploadImage(int index, bool srgb) {
    std::unique_ptr<gpu::Texture>& texture = textures_[{index, srgb}];
    if (texture) return texture.get();
    const scenes::Image& image = scene_.images[std::size_t(index)];
    const graph::TextureDesc desc{storedFormat(image.format, srgb), image.width, image.height, 1};
    const int levels = filter_ == TextureFilter::Exact ? 1 : gpu::mipLevelsFor(image.width, image.height);
    texture = std::make_unique<gpu::Texture>(image.name, desc, levels);
    if (isStoredDecoded(image, srgb))
        texture->upload(0, decodedTexels(image));
    else
        texture->upload(0, std::span<const std::byte>(image.texels));
    if (levels > 1 && hasOddLevel(image.width, image.height)) {
        int level = 0;
        for (const std::vector<std::byte>& texels : smallerLevels(image, srgb)) texture->upload(++level, texels);
    } else if (levels > 1) {
        texture->generateMips();
    }
    return texture.get();
}

const gpu::Sampler* SceneGpu::sampler(const scenes::Sampler& wanted) {
    for (const auto& [known, object] : samplers_) {
        if (known == wanted) return object.get();
    }
    const std::string label = fmt::format("material sampler {}", samplers_.size());
    samplers_.emplace_back(wanted, std::make_unique<gpu::Sampler>(label, wanted, kAnisotropy));
    return samplers_.back().second.get();
}

void SceneGpu::setView(const CameraView& view) {
    drawRows_->upload(makeDrawRows(drawList_, view));
    transparent_ = sortedTransparent(drawList_, view);
}

void SceneGpu::bindMaterialTable() const {
    if (materialTable_) gpu::bindTexelBuffer(TEXTURE_UNIT_MATERIALS, *materialTable_);
}

void SceneGpu::bindMaterial(int material) const {
    gpu::bindUniformBuffer(UNIFORM_MATERIAL, *materials_, std::size_t(material) * materialStride_,
                           sizeof(shared::MaterialConstants));
    for (std::uint32_t slot = 0; slot < TEXTURE_SLOT_COUNT; ++slot) {
        const BoundTexture& bound = bound_[std::size_t(material) * TEXTURE_SLOT_COUNT + slot];
        gpu::bindTexture(slot, *bound.texture, bound.sampler);
    }
}

void SceneGpu::draw(const std::vector<Batch>& batches, const gpu::PipelineState& state) const {
    gpu::bindVertexArray(*vertexArray_);
    int boundMaterial = -1;
    for (const Batch& batch : batches) {
        gpu::PipelineState batchState = state;
        const bool doubleSided = scene_.materials[std::size_t(batch.material)].doubleSided;
        batchState.cullFace = doubleSided ? gpu::CullFace::None : gpu::CullFace::Back;
        batchState.frontFaceClockwise = batch.mirrored;
        gpu::setState(batchState);
        if (batch.material != boundMaterial) bindMaterial(batch.material);
        boundMaterial = batch.material;
        gpu::drawIndexedIndirect(*commands_, std::uint32_t(batch.first), std::uint32_t(batch.count));
    }
}

} // namespace tessera::frame
