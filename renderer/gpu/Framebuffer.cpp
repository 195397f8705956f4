#include "renderer/gpu/Framebuffer.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"

namespace tessera::gpu {
namespace {

std::string describe(const graph::Target& target) {
    const graph::TextureDesc desc = graph::mipDesc(target.texture->desc(), target.part.level);
    std::string text = fmt::format("'{}' {} x {} {}, {} sample{}", target.texture->label(), desc.width, desc.height,
                                   graph::formatInfo(desc.format).name, desc.samples, desc.samples == 1 ? "" : "s");
    if (target.part != graph::Part()) text += fmt::format(", level {}, layer {}", target.part.level, target.part.layer);
    return text;
}

std::string describe(const Attachments& attachments) {
    std::string text;
    for (std::size_t i = 0; i < attachments.colors.size(); ++i)
        if (attachments.colors[i].texture)
            text += fmt::format("{}colour {} = {}", text.empty() ? "" : "; ", i, describe(attachments.colors[i]));
    if (attachments.depth.texture)
        text += fmt::format("{}depth = {}", text.empty() ? "" : "; ", describe(attachments.depth));
    return text.empty() ? "nothing" : text;
}

std::string statusName(GLenum status) {
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "a texture of this format cannot be attached there";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "nothing is attached";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "the attachments' samples differ";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "the driver does not support this combination of formats";
    default:
        return fmt::format("framebuffer status 0x{:x}", status);
    }
}

std::vector<graph::Target> targets(const Attachments& attachments) {
    std::vector<graph::Target> all{attachments.depth};
    all.insert(all.end(), attachments.colors.begin(), attachments.colors.end());
    return all;
}

void attach(std::uint32_t framebuffer, GLenum point, const graph::Target& target) {
    const auto& [texture, part] = target;
    if (texture->desc().shape == graph::Shape::Flat)
        glNamedFramebufferTexture(framebuffer, point, texture->id(), part.level);
    else
        glNamedFramebufferTextureLayer(framebuffer, point, texture->id(), part.level, part.layer);
}

[[noreturn]] void fail(const Attachments& attachments, const std::string& why) {
    throw std::runtime_error(fmt::format("a framebuffer cannot be made: {} ({})", why, describe(attachments)));
}

} // namespace

Framebuffer::Framebuffer(const Attachments& attachments) {
    for (const graph::Target& target : targets(attachments)) {
        if (!target.texture) continue;
        const graph::TextureDesc desc = graph::mipDesc(target.texture->desc(), target.part.level);
        if (width_ != 0 && (width_ != desc.width || height_ != desc.height))
            fail(attachments, "the attachments' sizes differ");
        width_ = desc.width;
        height_ = desc.height;
    }
    std::uint32_t id = 0;
    glCreateFramebuffers(1, &id);
    id_ = Id(id);
    std::vector<GLenum> drawBuffers;
    for (std::size_t i = 0; i < attachments.colors.size(); ++i) {
        const GLenum point = GL_COLOR_ATTACHMENT0 + GLenum(i);
        drawBuffers.push_back(attachments.colors[i].texture ? point : GLenum(GL_NONE));
        if (attachments.colors[i].texture) attach(id, point, attachments.colors[i]);
    }
    if (attachments.depth.texture) attach(id, GL_DEPTH_ATTACHMENT, attachments.depth);
    glNamedFramebufferDrawBuffers(id, GLsizei(drawBuffers.size()), drawBuffers.data());
    if (drawBuffers.empty() || drawBuffers.front() == GL_NONE) glNamedFramebufferReadBuffer(id, GL_NONE);
    labelObject(LabelKind::Framebuffer, id, describe(attachments));
    try {
        throwIfFailed(fmt::format("making a framebuffer ({})", describe(attachments)));
        const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
        if (status != GL_FRAMEBUFFER_COMPLETE) {
            Context::current()->debugLog().takeFailures(); // some drivers also report it through the debug output
            fail(attachments, statusName(status));
        }
    } catch (...) {
        glDeleteFramebuffers(1, &id);
        throw;
    }
}

Framebuffer::~Framebuffer() {
    if (const std::uint32_t id = id_.value()) glDeleteFramebuffers(1, &id);
}

const Framebuffer& FramebufferCache::get(const Attachments& attachments) {
    std::vector<std::uint64_t> key;
    for (const auto& [texture, part] : targets(attachments)) {
        key.push_back(texture ? *texture->serial() : 0);
        key.push_back(std::uint64_t(part.level) << 32 | std::uint64_t(part.layer));
    }
    if (const auto found = entries_.find(key); found != entries_.end()) return found->second.framebuffer;
    collect();
    Entry entry{{}, Framebuffer(attachments)};
    for (const graph::Target& target : targets(attachments))
        if (target.texture) entry.textures.emplace_back(target.texture->serial());
    return entries_.emplace(std::move(key), std::move(entry)).first->second.framebuffer;
}

const Framebuffer& FramebufferCache::get(const Texture& color, const Texture* depth) {
    return get(Attachments{{&color}, depth});
}

void FramebufferCache::collect() {
    std::erase_if(entries_, [](const auto& entry) {
        const auto& alive = entry.second.textures;
        return std::any_of(alive.begin(), alive.end(), [](const auto& texture) { return texture.expired(); });
    });
}

} // namespace tessera::gpu
