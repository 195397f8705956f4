#include "viewer/show/ResourceCapture.h"

#include <algorithm>
#include <utility>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/graph/Execute.h"
#include "viewer/show/KeepsUnused.h"

namespace tessera::viewer {
namespace {

constexpr std::size_t kMostWords = std::size_t(1) << 22; ///< read from a buffer at most

/// While one exists, frames keep a resource, zero-initialised where no pass writes.
class KeptInFrames {
public:
    KeptInFrames(engine::Renderer& renderer, const std::string& name) : renderer_(renderer) {
        renderer_.keepResource(name);
        renderer_.backend().setClearsAllocations(true);
    }
    ~KeptInFrames() {
        renderer_.keepResource({});
        renderer_.backend().setClearsAllocations(false);
    }
    KeptInFrames(const KeptInFrames&) = delete;
    KeptInFrames& operator=(const KeptInFrames&) = delete;

private:
    engine::Renderer& renderer_;
};

/// Resolves a texture to one sample per texel.
gpu::Texture resolved(const gpu::Texture& texture) {
    graph::TextureDesc desc = texture.desc();
    desc.samples = 1;
    gpu::Texture single("resolved " + texture.label(), desc);
    const bool isDepth = graph::formatInfo(desc.format).depth;
    const auto framebuffer = [isDepth](const gpu::Texture& of) {
        return gpu::Framebuffer(isDepth ? gpu::Attachments{.colors = {}, .depth = &of}
                                        : gpu::Attachments{.colors = {&of}});
    };
    gpu::blit(framebuffer(texture), framebuffer(single), !isDepth, isDepth);
    return single;
}

void readTexture(const gpu::Texture& texture, int level, int layer, ResourceContents& contents) {
    if (texture.desc().samples > 1) return readTexture(resolved(texture), 0, 0, contents);
    contents.desc = texture.desc();
    const graph::TextureDesc size = graph::mipDesc(texture.desc(), level);
    contents.sizeTexels = {size.width, size.height};
    contents.texels = texture.downloadComponents(level, layer);
    // GL's rows start at the bottom.
    for (int row = 0; row < size.height / 2; ++row)
        std::swap_ranges(contents.texels.begin() + std::ptrdiff_t(row) * size.width,
                         contents.texels.begin() + std::ptrdiff_t(row + 1) * size.width,
                         contents.texels.begin() + std::ptrdiff_t(size.height - 1 - row) * size.width);
}

} // namespace

bool ResourceCapture::update(Facts& facts, const State& state, Screen& screen, const Screen::Wanted& wanted,
                             bool isAtRest, const std::function<bool()>& givesUp) {
    awaitsRest_ = false;
    retired_.reset();
    const ResourceView& view = state.resource;
    if (!state.open || view.name.empty()) {
        read_.reset();
        shown_.reset();
        contents_.reset();
        retired_ = std::move(picture_);
        return std::exchange(facts.resource, std::nullopt).has_value();
    }
    const Source source{view.name, view.level, view.layer, std::min(state.activeSide, wanted.sides - 1), wanted};
    if (view.image) {
        read_.reset();
        if (std::exchange(contents_, view.image) != view.image) shown_.reset();
    } else if (read_ != source) {
        awaitsRest_ = !isAtRest;
        if (isAtRest) awaitsRest_ = !read(screen, source, givesUp);
    }
    const Shown now{view.channels, view.fitsRange, view.least, view.most, view.isCurved};
    if (!contents_ || shown_ == now) return false;
    shown_ = now;
    show(facts, view);
    return true;
}

bool ResourceCapture::read(Screen& screen, const Source& source, const std::function<bool()>& givesUp) {
    read_ = source; // even if it fails: a retry would fail again
    engine::Renderer& renderer = *screen.renderer();
    const Look& look = source.wanted.looks[std::size_t(source.side)];
    try {
        const KeepsUnused keeps(renderer.backend());
        const KeptInFrames kept(renderer, source.name);
        const gpu::BandedDrawing banded(givesUp);
        renderer.draw(look.technique, look.settings);
    } catch (const graph::Interrupted&) {
        read_.reset();
        return false;
    }
    auto contents = std::make_shared<ResourceContents>();
    contents->name = source.name;
    const std::optional<engine::KeptResource> resource = renderer.keptResource();
    if (!resource) {
        contents->fault = "The frame has no resource of this name, or keeps what an earlier frame computed.";
    } else if (resource->texture != nullptr) {
        const graph::TextureDesc& desc = resource->texture->desc();
        readTexture(*resource->texture, std::min(source.level, desc.levels - 1),
                    std::min(source.layer, desc.layers - 1), *contents);
    } else {
        contents->desc = graph::BufferDesc{resource->bytes};
        contents->bytes = resource->bytes;
        contents->words =
            resource->buffer->downloadAs<std::uint32_t>(std::min(resource->bytes / sizeof(std::uint32_t), kMostWords));
    }
    contents_ = std::move(contents);
    shown_.reset();
    return true;
}

void ResourceCapture::show(Facts& facts, const ResourceView& view) {
    facts.resource = Facts::Resource{};
    facts.resource->contents = contents_;
    if (!contents_->fault.empty() || !contents_->isTexture()) return;
    const NumberRange range =
        view.fitsRange ? rangeOf(*contents_, view.channels) : NumberRange{double(view.least), double(view.most)};
    const graph::TextureDesc desc{graph::Format::Rgba8Unorm, contents_->sizeTexels.x, contents_->sizeTexels.y};
    if (!picture_ || picture_->desc() != desc) {
        retired_ = std::move(picture_);
        picture_ = std::make_unique<gpu::Texture>("shown resource", desc);
    }
    picture_->upload(0, colorsOf(*contents_, view.channels, range, view.isCurved));
    facts.resource->picture = picture_->id();
    facts.resource->range = range;
}

} // namespace tessera::viewer
