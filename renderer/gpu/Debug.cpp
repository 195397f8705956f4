#include "renderer/gpu/Debug.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glad/gl.h>

#include "renderer/gpu/Context.h"

namespace tessera::gpu {
namespace {

// The smallest GL_MAX_LABEL_LENGTH and GL_MAX_DEBUG_MESSAGE_LENGTH that OpenGL 4.5 allows (tables 23.65, 23.75), minus
// one for the terminator, which counts.
constexpr std::size_t kMaxLabel = 255;
constexpr std::size_t kMaxGroupName = 1023;

DebugLog& log() {
    assert(Context::current() && "a GL object is used on a thread without a current context");
    return Context::current()->debugLog();
}

std::string_view errorName(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    default:
        return "an unknown GL error";
    }
}

std::vector<GLenum> drainErrors() {
    std::vector<GLenum> errors;
    constexpr std::size_t kMost = 16; // a lost context reports errors forever
    for (GLenum error = glGetError(); error != GL_NO_ERROR && errors.size() < kMost; error = glGetError())
        errors.push_back(error);
    return errors;
}

[[noreturn]] void fail(std::string_view when, const std::vector<std::string>& failures) {
    throw std::runtime_error(
        fmt::format("OpenGL failed{}{}: {}", when.empty() ? "" : " ", when, fmt::join(failures, "; ")));
}

/// Failures of the debug output; without debug output, the names of the errors.
std::vector<std::string> failures(const std::vector<GLenum>& errors) {
    std::vector<std::string> said = log().takeFailures();
    if (said.empty())
        for (const GLenum error : errors) said.emplace_back(errorName(error));
    return said;
}

GLenum identifier(LabelKind kind) {
    switch (kind) {
    case LabelKind::Buffer:
        return GL_BUFFER;
    case LabelKind::Texture:
        return GL_TEXTURE;
    case LabelKind::Sampler:
        return GL_SAMPLER;
    case LabelKind::Shader:
        return GL_SHADER;
    case LabelKind::Program:
        return GL_PROGRAM;
    case LabelKind::VertexArray:
        return GL_VERTEX_ARRAY;
    case LabelKind::Framebuffer:
        return GL_FRAMEBUFFER;
    case LabelKind::Query:
        return GL_QUERY;
    }
    assert(false);
    return GL_NONE;
}

} // namespace

void DebugLog::add(std::uint32_t type, std::uint32_t id, std::uint32_t severity, std::string_view text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ' || text.back() == '\0')) text.remove_suffix(1);
    const bool grave = severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM;
    if (type == GL_DEBUG_TYPE_ERROR || (grave && type != GL_DEBUG_TYPE_PERFORMANCE))
        failures_.push_back(inGroups(fmt::format("{} (message {})", text, id)));
    else if (grave)
        warnings_.push_back(inGroups(fmt::format("{} (message {})", text, id)));
}

std::string DebugLog::inGroups(std::string_view text) const {
    return groups_.empty() ? std::string(text) : fmt::format("{}: {}", fmt::join(groups_, " / "), text);
}

std::vector<std::string> DebugLog::takeFailures() {
    return std::exchange(failures_, {});
}
std::vector<std::string> DebugLog::takeWarnings() {
    return std::exchange(warnings_, {});
}

void throwIfFailed(std::string_view when) {
    const std::vector<std::string> said = failures(drainErrors());
    if (!said.empty()) fail(when, said);
}

void failAllocation(std::string_view what, std::size_t bytes) {
    throw std::runtime_error(fmt::format(
        "not enough graphics memory for {} ({} bytes); use a smaller picture, fewer samples or smaller textures", what,
        bytes));
}

void throwIfAllocationFailed(std::string_view what, std::size_t bytes) {
    const std::vector<GLenum> errors = drainErrors();
    const std::vector<std::string> said = failures(errors);
    if (std::find(errors.begin(), errors.end(), GLenum(GL_OUT_OF_MEMORY)) != errors.end()) failAllocation(what, bytes);
    if (!said.empty()) fail(fmt::format("creating {}", what), said);
}

DebugGroup::DebugGroup(std::string_view name) {
    log().pushGroup(name);
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(std::min(name.size(), kMaxGroupName)), name.data());
}

DebugGroup::~DebugGroup() {
    glPopDebugGroup();
    log().popGroup();
}

void labelObject(LabelKind kind, std::uint32_t id, std::string_view label) {
    glObjectLabel(identifier(kind), id, GLsizei(std::min(label.size(), kMaxLabel)), label.data());
}

} // namespace tessera::gpu
