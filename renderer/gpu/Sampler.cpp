#include "renderer/gpu/Sampler.h"

#include <algorithm>
#include <cassert>

#include <glad/gl.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"

namespace tessera::gpu {
namespace {

// GL_TEXTURE_MAX_ANISOTROPY of ARB_texture_filter_anisotropic (core since 4.6).
constexpr GLenum kTextureMaxAnisotropy = 0x84FE;

GLint glWrap(scenes::Wrap wrap) {
    switch (wrap) {
    case scenes::Wrap::Repeat:
        return GL_REPEAT;
    case scenes::Wrap::ClampToEdge:
        return GL_CLAMP_TO_EDGE;
    case scenes::Wrap::MirroredRepeat:
        return GL_MIRRORED_REPEAT;
    }
    assert(false);
    return GL_REPEAT;
}

GLint glFilter(scenes::Filter filter) {
    switch (filter) {
    case scenes::Filter::Nearest:
        return GL_NEAREST;
    case scenes::Filter::Linear:
        return GL_LINEAR;
    case scenes::Filter::NearestMipmapNearest:
        return GL_NEAREST_MIPMAP_NEAREST;
    case scenes::Filter::LinearMipmapNearest:
        return GL_LINEAR_MIPMAP_NEAREST;
    case scenes::Filter::NearestMipmapLinear:
        return GL_NEAREST_MIPMAP_LINEAR;
    case scenes::Filter::LinearMipmapLinear:
        return GL_LINEAR_MIPMAP_LINEAR;
    }
    assert(false);
    return GL_LINEAR;
}

/// Magnification has no mip levels.
GLint glMagnification(scenes::Filter filter) {
    return usesNearest(filter) ? GL_NEAREST : GL_LINEAR;
}

} // namespace

bool usesNearest(scenes::Filter filter) {
    return filter == scenes::Filter::Nearest || filter == scenes::Filter::NearestMipmapNearest ||
           filter == scenes::Filter::NearestMipmapLinear;
}

Sampler::Sampler(std::string label, const scenes::Sampler& sampler, float maxAnisotropy) {
    std::uint32_t id = 0;
    glCreateSamplers(1, &id);
    id_ = Id(id);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, glMagnification(sampler.magnification));
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, glFilter(sampler.minification));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, glWrap(sampler.wrapU));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, glWrap(sampler.wrapV));
    const float anisotropy = std::min(maxAnisotropy, Context::current()->capabilities().maxAnisotropy);
    if (anisotropy > 1.0f) glSamplerParameterf(id, kTextureMaxAnisotropy, anisotropy);
    labelObject(LabelKind::Sampler, id, label);
}

Sampler Sampler::linearClamp() {
    return Sampler("linear, clamped", {.magnification = scenes::Filter::Linear,
                                       .minification = scenes::Filter::Linear,
                                       .wrapU = scenes::Wrap::ClampToEdge,
                                       .wrapV = scenes::Wrap::ClampToEdge});
}

Sampler::~Sampler() {
    if (const std::uint32_t id = id_.value()) glDeleteSamplers(1, &id);
}

} // namespace tessera::gpu
