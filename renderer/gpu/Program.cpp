#include "renderer/gpu/Program.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"
#include "shaders/shared/slots.h"

namespace tessera::gpu {
namespace {

GLenum glStage(Stage stage) {
    switch (stage) {
    case Stage::Vertex:
        return GL_VERTEX_SHADER;
    case Stage::Geometry:
        return GL_GEOMETRY_SHADER;
    case Stage::Fragment:
        return GL_FRAGMENT_SHADER;
    case Stage::Compute:
        return GL_COMPUTE_SHADER;
    }
    assert(false);
    return GL_NONE;
}

std::string shaderLog(std::uint32_t shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string text(std::size_t(std::max(length, 0)), '\0');
    if (length > 0) glGetShaderInfoLog(shader, length, nullptr, text.data());
    while (!text.empty() && text.back() == '\0') text.pop_back();
    return text.empty() ? "the driver gave no reason" : text;
}

std::string linkLog(std::uint32_t program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string text(std::size_t(std::max(length, 0)), '\0');
    if (length > 0) glGetProgramInfoLog(program, length, nullptr, text.data());
    while (!text.empty() && text.back() == '\0') text.pop_back();
    return text.empty() ? "the driver gave no reason" : text;
}

std::string logText(const std::vector<ShaderError::StageLog>& stages, const std::string& link) {
    std::string text;
    const auto add = [&text](std::string_view what, std::string_view log) {
        text += fmt::format("{}\n{}\n", what, log);
        while (text.ends_with("\n\n")) text.pop_back();
    };
    for (const ShaderError::StageLog& stage : stages)
        add(fmt::format("a {} shader cannot be compiled:", stageName(stage.stage)), stage.text);
    if (!link.empty()) add("a shader program cannot be linked:", link);
    return text;
}

/// Puts the error location first, since the program's name lists all its defines.
std::string errorText(const std::string& program, const std::vector<ShaderError::StageLog>& stages,
                      const std::string& link) {
    return logText(stages, link) + fmt::format("It is program '{}'.", program);
}

} // namespace

std::string_view stageName(Stage stage) {
    switch (stage) {
    case Stage::Vertex:
        return "vertex";
    case Stage::Geometry:
        return "geometry";
    case Stage::Fragment:
        return "fragment";
    case Stage::Compute:
        return "compute";
    }
    assert(false);
    return "";
}

ShaderError::ShaderError(std::string program, std::vector<StageLog> stageLogs, std::string linkLog)
    : std::runtime_error(errorText(program, stageLogs, linkLog)), program_(std::move(program)),
      stageLogs_(std::move(stageLogs)), linkLog_(std::move(linkLog)) {}

std::string ShaderError::log() const {
    return logText(stageLogs_, linkLog_);
}

PendingProgram::PendingProgram(std::string label, std::span<const StageSource> stages) : label_(std::move(label)) {
    throwIfFailed(fmt::format("before compiling '{}'", label_));
    if (const KeptPrograms* kept = Context::current()->keptPrograms()) {
        key_ = label_;
        for (const StageSource& stage : stages) key_ += fmt::format("\n{}\n{}", stageName(stage.stage), stage.source);
        if (const auto found = kept->find(key_); found != kept->end()) {
            kept_ = found->second;
            return;
        }
    }
    id_ = Id(glCreateProgram());
    labelObject(LabelKind::Program, id_.value(), label_);
    for (const StageSource& stage : stages) {
        PendingShader& shader =
            shaders_.emplace_back(PendingShader{stage.stage, Id(glCreateShader(glStage(stage.stage)))});
        const char* text = stage.source.data();
        const GLint length = GLint(stage.source.size());
        glShaderSource(shader.id.value(), 1, &text, &length);
        labelObject(LabelKind::Shader, shader.id.value(), fmt::format("{} ({})", label_, stageName(stage.stage)));
        glCompileShader(shader.id.value());
        glAttachShader(id_.value(), shader.id.value());
    }
    glLinkProgram(id_.value());
}

PendingProgram::~PendingProgram() {
    for (const PendingShader& shader : shaders_)
        if (const std::uint32_t id = shader.id.value()) glDeleteShader(id);
    if (const std::uint32_t id = id_.value()) glDeleteProgram(id);
}

Program PendingProgram::finish() {
    if (kept_) return Program(label_, kept_);
    std::vector<ShaderError::StageLog> faults;
    for (const PendingShader& shader : shaders_) {
        GLint compiled = GL_FALSE;
        glGetShaderiv(shader.id.value(), GL_COMPILE_STATUS, &compiled);
        if (!compiled) faults.push_back({shader.stage, shaderLog(shader.id.value())});
    }
    if (!faults.empty()) throw ShaderError(label_, std::move(faults), {});
    GLint linked = GL_FALSE;
    glGetProgramiv(id_.value(), GL_LINK_STATUS, &linked);
    if (!linked) throw ShaderError(label_, {}, linkLog(id_.value()));
    for (const PendingShader& shader : shaders_) glDetachShader(id_.value(), shader.id.value());
    throwIfFailed(fmt::format("building '{}'", label_));
    const auto linkedProgram = std::make_shared<const LinkedProgram>(std::move(id_));
    Program program(label_, linkedProgram);
    for (const PendingShader& shader : shaders_) {
        const int sampled = program.sampledTextures(shader.stage);
        GLint offered = 0;
        glGetIntegerv(shader.stage == Stage::Vertex    ? GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS
                      : shader.stage == Stage::Compute ? GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS
                                                       : GL_MAX_TEXTURE_IMAGE_UNITS,
                      &offered);
        if (sampled <= offered) continue;
        throw ShaderError(label_, {},
                          fmt::format("its {} shader samples {} textures, and this driver offers {}",
                                      stageName(shader.stage), sampled, offered));
    }
    if (KeptPrograms* kept = Context::current()->keptPrograms(); kept && !key_.empty())
        kept->emplace(key_, linkedProgram);
    return program;
}

Program::Program(std::string label, std::span<const StageSource> stages)
    : Program(PendingProgram(std::move(label), stages).finish()) {}

LinkedProgram::LinkedProgram(Id linked) : id(std::move(linked)) {
    GLint blocks = 0;
    glGetProgramInterfaceiv(id.value(), GL_UNIFORM_BLOCK, GL_ACTIVE_RESOURCES, &blocks);
    for (GLint block = 0; block < blocks; ++block) {
        constexpr std::array<GLenum, 2> kProperties{GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
        std::array<GLint, 2> values{};
        glGetProgramResourceiv(id.value(), GL_UNIFORM_BLOCK, GLuint(block), GLsizei(kProperties.size()),
                               kProperties.data(), GLsizei(values.size()), nullptr, values.data());
        uniformBlockBytes[std::uint32_t(values[0])] = std::size_t(values[1]);
    }
}

std::size_t Program::uniformBlockBytes(std::uint32_t slot) const {
    const auto found = linked_->uniformBlockBytes.find(slot);
    return found == linked_->uniformBlockBytes.end() ? 0 : found->second;
}

LinkedProgram::~LinkedProgram() {
    // GL keeps a deleted current program until another one becomes current. Code that saves and restores the current
    // program, as Dear ImGui does, would restore a deleted name.
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    if (std::uint32_t(current) == id.value()) glUseProgram(0);
    glDeleteProgram(id.value());
}

} // namespace tessera::gpu
