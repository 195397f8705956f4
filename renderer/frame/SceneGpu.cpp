#include "renderer/frame/SceneGpu.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "renderer/frame/Diffusion.h"
#include "renderer/frame/PackedMaterial.h"
#include "renderer/frame/TextureLevels.h"
#include "renderer/gpu/TexelBuffer.h"
#include "scenes/InUse.h"
#include "scenes/Shadows.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

namespace {

/// Uniform buffer offset alignment valid on every driver (the largest GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT allowed).
constexpr std::size_t kUniformAlignment = 256;

/// Bytes between the constants of two materials.
constexpr std::size_t kMaterialStride =
    (sizeof(shared::MaterialConstants) + kUniformAlignment - 1) / kUniformAlignment * kUniformAlignment;

/// Anisotropy of material textures under the hardware filter. Larger values double the cost of a textured pass on
/// software rasterisers, so it stays at trilinear.
constexpr float kAnisotropy = 1.0f;

std::vector<bool> transparentMaterials(const scenes::Scene& scene) {
    std::vector<bool> transparent;
    for (const scenes::Material& material : scene.materials) transparent.push_back(scenes::isTransparent(material));
    return transparent;
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

/// Vertex attributes of DrawRows; each view has its own buffer of them.
const std::array<gpu::VertexAttribute, 6>& drawAttributes() {
    static const std::array<gpu::VertexAttribute, 6> attributes = [] {
        std::array<gpu::VertexAttribute, 6> result;
        for (std::uint32_t row = 0; row < 3; ++row) {
            const std::size_t offset = row * sizeof(glm::vec4);
            result[row] = attribute(ATTRIBUTE_DRAW_POSITION_ROW0 + row, 4, nullptr, sizeof(DrawRows),
                                    offsetof(DrawRows, position) + offset, 1);
            result[3 + row] = attribute(ATTRIBUTE_DRAW_NORMAL_ROW0 + row, 4, nullptr, sizeof(DrawRows),
                                        offsetof(DrawRows, normal) + offset, 1);
        }
        return result;
    }();
    return attributes;
}

gpu::PipelineState stateOf(gpu::PipelineState state, bool doubleSided, bool mirrored) {
    state.cullFace = state.farSides                   ? gpu::CullFace::Front
                     : doubleSided || state.bothSides ? gpu::CullFace::None
                                                      : gpu::CullFace::Back;
    state.frontFaceClockwise = mirrored;
    return state;
}

/// Whether the blend mode depends on the order of draws.
bool isLayered(gpu::Blend blend) {
    return blend == gpu::Blend::AlphaPremultiplied || blend == gpu::Blend::AlphaStraight ||
           blend == gpu::Blend::Transmitting;
}

std::uint64_t newRevision() {
    static std::atomic<std::uint64_t> latest = 0;
    return ++latest;
}

} // namespace

SceneGpu::SceneGpu(const scenes::Scene& scene, scenes::ClosedMeshes& closedMeshes, const FeatureSet& features,
                   TextureFilter filter, scenes::SubsurfaceRequest subsurface)
    : scene_(scene), features_(features), filter_(filter), subsurface_(subsurface), closedMeshes_(closedMeshes),
      materialsInUse_(scenes::inUse(scene).materials), geometry_(makeGeometry(scene, features)),
      draws_(makeDraws(geometry_.ranges)), materials_(makeMaterials()) {
    uploadTextures();
    revisedMaterials_ = casterMaterials();
    casterRevision_ = newRevision();
}

SceneGpu::Geometry SceneGpu::makeGeometry(const scenes::Scene& scene, const FeatureSet& features) {
    const VertexStreams streams = makeVertexStreams(scene, features);
    Geometry geometry;
    geometry.tangentBases = tangentBases(scene);
    geometry.ranges = streams.ranges;
    std::vector<gpu::VertexAttribute> attributes;
    const auto stream = [&](std::uint32_t location, const char* label, const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (values.empty()) return;
        geometry.vertices.push_back(std::make_unique<gpu::Buffer>(gpu::Buffer::of(label, values)));
        geometry.streams.push_back(geometry.vertices.back().get());
        attributes.push_back(attribute(location, Value::length(), geometry.streams.back(), sizeof(Value)));
    };
    stream(ATTRIBUTE_POSITION, "positions", streams.positionsOS);
    stream(ATTRIBUTE_NORMAL, "normals", streams.normalsOS);
    stream(ATTRIBUTE_TANGENT, "tangents", streams.tangentsOS);
    stream(ATTRIBUTE_TEXCOORD0, "texture_coordinates_0", streams.texCoords[0]);
    stream(ATTRIBUTE_TEXCOORD1, "texture_coordinates_1", streams.texCoords[1]);
    stream(ATTRIBUTE_COLOR, "vertex_colors", streams.colors);
    if (features[Feature::Shadows]) { // also without triangles, since a frame may still bind it
        geometry.facetNormals = std::make_unique<gpu::Buffer>(gpu::Buffer::of("facet_normals", streams.facetNormalsOS));
        attributes.push_back(attribute(ATTRIBUTE_FACET_NORMAL, 3, geometry.facetNormals.get(), sizeof(glm::vec3)));
    }
    for (const gpu::VertexAttribute& ofDraw : drawAttributes()) attributes.push_back(ofDraw);
    geometry.indices = std::make_unique<gpu::Buffer>(gpu::Buffer::of("indices", streams.indices));
    geometry.array = std::make_unique<gpu::VertexArray>("scene", attributes, geometry.indices.get());
    return geometry;
}

SceneGpu::Draws SceneGpu::makeDraws(const VertexStreams::Ranges& ranges) const {
    Draws draws{transparentMaterials(scene_), makeDrawList(scene_), {}};
    const std::vector<DiffusionObject> diffusing = diffusionObjects(scene_, subsurface_, {});
    for (Draw& draw : draws.list.draws) {
        draws.ranges.push_back(ranges.at({draw.mesh, draw.material}));
        const auto own = std::ranges::find(diffusing, draw.instance, &DiffusionObject::instance);
        if (own != diffusing.end()) draw.diffusionNumber = 1 + int(own - diffusing.begin());
    }
    return draws;
}

SceneGpu::Materials SceneGpu::makeMaterials() {
    constexpr std::size_t kTabledBytes = MATERIAL_TEXELS * sizeof(glm::vec4);
    static_assert(kTabledBytes == offsetof(shared::MaterialConstants, uvRow0));
    std::vector<std::byte> bytes(kMaterialStride * scene_.materials.size());
    std::vector<std::byte> tabled;
    PackedSubsurfaces subsurfaces = packSubsurfaces(scene_, subsurface_);
    Materials materials;
    materials.closedBodies = scenes::closedBodies(scene_, closedMeshes_);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
        shared::MaterialConstants constants = packMaterial(scene_.materials[i], subsurfaces.rowOf[i]);
        for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
            if (shadersDecode(scene_.materials[i], slot)) constants.uvRow1[slot].w += float(TEXTURE_MODE_SRGB);
        }
        if (scene_.hook && scene_.hook->changes(i)) constants.kind.y |= MATERIAL_FLAG_HOOKED;
        if (materials.closedBodies[i]) constants.kind.y |= MATERIAL_FLAG_CLOSED;
        constants.kind.w = glm::uint(tabled.size() / kTabledBytes);
        std::memcpy(bytes.data() + i * kMaterialStride, &constants, sizeof constants);
        if (!materialsInUse_[i]) continue;
        const auto* const first = reinterpret_cast<const std::byte*>(&constants);
        tabled.insert(tabled.end(), first, first + kTabledBytes);
    }
    materials.constants = std::make_unique<gpu::Buffer>(gpu::Buffer::of("materials", bytes));
    if (!features_[Feature::VaryingMaterials] && !tabled.empty())
        materials.tabled = std::make_unique<gpu::Buffer>(gpu::Buffer::of("material table", tabled));
    if (features_.enteringLight()) {
        subsurfaces.rows.resize(SUBSURFACE_MOST); // size of the uniform block
        materials.subsurfaces = std::make_unique<gpu::Buffer>(gpu::Buffer::of("subsurfaces", subsurfaces.rows));
    }
    return materials;
}

void SceneGpu::updateMaterials() {
    std::optional<Geometry> geometry;
    if (features_.tangents() && tangentBases(scene_) != geometry_.tangentBases)
        geometry = makeGeometry(scene_, features_);
    // Transparent surfaces are drawn last and sorted separately.
    std::optional<Draws> draws;
    if (geometry || transparentMaterials(scene_) != draws_.transparentMaterials)
        draws = makeDraws(geometry ? geometry->ranges : geometry_.ranges);
    Materials materials = makeMaterials();
    // Nothing throws from here on.
    materials_ = std::move(materials);
    if (geometry) geometry_ = std::move(*geometry);
    if (draws) draws_ = std::move(*draws);
    if (std::vector<CasterMaterial> now = casterMaterials(); now != revisedMaterials_) {
        revisedMaterials_ = std::move(now);
        casterRevision_ = newRevision();
    }
}

void SceneGpu::updateGeometry() {
    Geometry geometry = makeGeometry(scene_, features_);
    Draws draws = makeDraws(geometry.ranges);
    Materials materials = makeMaterials();
    std::vector<CasterMaterial> revised = casterMaterials();
    // Nothing throws from here on.
    geometry_ = std::move(geometry);
    draws_ = std::move(draws);
    materials_ = std::move(materials);
    casters_.reset();
    revisedMaterials_ = std::move(revised);
    casterRevision_ = newRevision();
}

bool SceneGpu::isCaster(const Draw& draw) const {
    return draw.castsShadow && scenes::castsShadow(scene_.materials[std::size_t(draw.material)]);
}

std::vector<SceneGpu::CasterMaterial> SceneGpu::casterMaterials() const {
    const std::vector<std::size_t> passed = packSubsurfaces(scene_, subsurface_).passed;
    std::vector<CasterMaterial> materials;
    for (std::size_t i = 0; i < passed.size(); ++i) {
        const scenes::Material& material = scene_.materials[i];
        materials.emplace_back(scenes::castsShadow(material), material.alphaMode, material.alphaCutoff,
                               material.baseColor.w, passed[i]);
    }
    return materials;
}

void SceneGpu::makeCasters() {
    std::vector<CasterMaterial> materials = casterMaterials();
    if (casters_ && materials == treeMaterials_) return;
    const CasterTree tree = makeCasterTree(scene_, packSubsurfaces(scene_, subsurface_).passed);
    Casters casters{tree.space, std::make_unique<gpu::Buffer>(gpu::Buffer::of("casters", tree.texels))};
    if (const std::size_t read = casters.texels->texels(graph::Format::Rgba32Uint).texels(); read < tree.texels.size())
        throw std::runtime_error(fmt::format("the casters of shadows take {} texels of a buffer, of which the driver "
                                             "reads {}; give --shadow-filter hard",
                                             tree.texels.size(), read));
    casters_ = std::move(casters);
    treeMaterials_ = std::move(materials);
}

void SceneGpu::makeFacetNormals() {
    if (features_[Feature::Shadows]) return;
    FeatureSet features = features_;
    features.add(Feature::Shadows);
    Geometry geometry = makeGeometry(scene_, features);
    std::vector<VertexStreams::Range> ranges;
    for (const Draw& draw : draws_.list.draws) ranges.push_back(geometry.ranges.at({draw.mesh, draw.material}));
    // Nothing throws from here on.
    features_ = features;
    geometry_ = std::move(geometry);
    draws_.ranges = std::move(ranges);
}

bool SceneGpu::shadersDecode(const scenes::Material& material, std::size_t slot) const {
    const int image = material.textures[slot].image;
    return filter_ == TextureFilter::Exact && image != scenes::kNone &&
           scenes::infoOf(scenes::TextureSlot(slot)).isSrgb &&
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
                const bool srgb = scenes::infoOf(scenes::TextureSlot(slot)).isSrgb && !shadersDecode(material, slot);
                // Exact filtering fetches texels, so a sampler would only add programs for the driver to compile:
                // llvmpipe compiles one for each.
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
    const int levels = filter_ == TextureFilter::Exact ? 1 : graph::mipLevelsFor(image.width, image.height);
    const graph::TextureDesc desc{storedFormat(image.format, srgb), image.width, image.height, 1, levels};
    texture = std::make_unique<gpu::Texture>(image.name, desc);
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

std::vector<gpu::DrawIndexedCommand> SceneGpu::commandsOf(const ViewDraws& draws) const {
    std::vector<gpu::DrawIndexedCommand> commands;
    commands.reserve(draws.seen.size());
    for (const int draw : draws.seen) {
        const VertexStreams::Range& range = draws_.ranges[std::size_t(draw)];
        commands.push_back({range.indexCount, 1, range.firstIndex, range.baseVertex, std::uint32_t(commands.size())});
    }
    return commands;
}

void SceneGpu::bindMaterial(int material) const {
    gpu::bindUniformBuffer(UNIFORM_MATERIAL, *materials_.constants, std::size_t(material) * kMaterialStride,
                           sizeof(shared::MaterialConstants));
    for (std::uint32_t slot = 0; slot < TEXTURE_SLOT_COUNT; ++slot) {
        const BoundTexture& bound = bound_[std::size_t(material) * TEXTURE_SLOT_COUNT + slot];
        gpu::bindTexture(slot, *bound.texture, bound.sampler);
    }
}

void SceneGpu::bindVertices(const ViewBuffers& view) const {
    for (const gpu::VertexAttribute& ofDraw : drawAttributes()) geometry_.array->setBuffer(ofDraw, view.rows);
    gpu::bindVertexArray(*geometry_.array);
}

void SceneGpu::draw(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                    std::optional<gpu::Blend> transmitting) const {
    bindVertices(view);
    int boundMaterial = -1;
    for (const Batch& batch : batches) {
        const scenes::Material& material = scene_.materials[std::size_t(batch.material)];
        if (state.farSides && !scenes::hasBody(material)) continue;
        if (state.farSidesOfClosed && !materials_.closedBodies[std::size_t(batch.material)]) continue;
        gpu::PipelineState own = stateOf(state, material.doubleSided, batch.mirrored);
        if (transmitting && scenes::isTransmissive(material)) own.blend = *transmitting;
        gpu::setState(own);
        if (batch.material != boundMaterial) bindMaterial(batch.material);
        boundMaterial = batch.material;
        const auto drawBatch = [&] {
            gpu::drawIndexedIndirect(view.commands, std::uint32_t(batch.first), std::uint32_t(batch.count));
        };
        // Draws back faces first: the right order of a two-sided surface if it is convex.
        if (isLayered(own.blend) && own.cullFace == gpu::CullFace::None) {
            own.cullFace = gpu::CullFace::Front;
            gpu::setState(own);
            drawBatch();
            own.cullFace = gpu::CullFace::Back;
            gpu::setState(own);
        }
        drawBatch();
    }
}

void SceneGpu::drawPart(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                        const Part& part) const {
    assert(state.blend == gpu::Blend::None && !state.farSides);
    bindVertices(view);
    int boundMaterial = -1;
    std::size_t next = 0; // the number of the next draw's first triangle
    for (const Batch& batch : batches) {
        bool isBound = false;
        for (const gpu::DrawIndexedCommand& command :
             part.commands.subspan(std::size_t(batch.first), std::size_t(batch.count))) {
            const std::size_t own = std::exchange(next, next + trianglesIn(command));
            const std::size_t begin = std::max(own, part.first), end = std::min(next, part.first + part.count);
            if (begin >= end) continue;
            if (!isBound) {
                const scenes::Material& material = scene_.materials[std::size_t(batch.material)];
                gpu::setState(stateOf(state, material.doubleSided, batch.mirrored));
                if (batch.material != boundMaterial) bindMaterial(batch.material);
                boundMaterial = batch.material;
                isBound = true;
            }
            gpu::drawIndexed(command.firstIndex + std::uint32_t(3 * (begin - own)), std::uint32_t(3 * (end - begin)),
                             command.baseVertex, command.baseInstance);
        }
    }
}

void SceneGpu::drawDepth(const ViewBuffers& view, std::span<const Batch> batches, const gpu::PipelineState& state,
                         const DepthPrograms& programs) const {
    bindVertices(view);
    for (const DepthBatch& batch : depthBatches(scene_, batches)) {
        gpu::setState(stateOf(state, batch.doubleSided, batch.mirrored));
        const bool hasHoles = batch.maskedBy && programs.masked;
        gpu::useProgram(hasHoles ? *programs.masked : programs.bare);
        if (hasHoles) bindMaterial(*batch.maskedBy);
        gpu::drawIndexedIndirect(view.commands, std::uint32_t(batch.first), std::uint32_t(batch.count));
    }
}

} // namespace tessera::frame
