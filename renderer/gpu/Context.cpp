#include "renderer/gpu/Context.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glad/gl.h>

#include "base/Lowercase.h"
#include "renderer/gpu/ContextWays.h"
#include "renderer/gpu/Debug.h"

namespace tessera::gpu {
namespace {

thread_local Context* currentContext = nullptr;

// GL_MAX_TEXTURE_MAX_ANISOTROPY of ARB_texture_filter_anisotropic (core since 4.6).
constexpr GLenum kMaxTextureMaxAnisotropy = 0x84FF;

std::string text(GLenum name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return value ? value : "";
}

GLint64 integer(GLenum name) {
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return value;
}

bool hasExtension(std::string_view wanted) {
    const auto count = integer(GL_NUM_EXTENSIONS);
    for (GLint64 i = 0; i < count; ++i)
        if (wanted == reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i)))) return true;
    return false;
}

/// Mesa maps the index of its shader cache into memory and fills it: on a full disk that ends the process.
void avoidShaderCacheOnFullDisk() {
    constexpr std::uintmax_t kIndexBytes = 2u << 20;
    const char *own = std::getenv("MESA_SHADER_CACHE_DIR"), *all = std::getenv("XDG_CACHE_HOME"),
               *home = std::getenv("HOME");
    std::filesystem::path folder = own ? own : all ? all : home ? home : "";
    std::error_code error;
    while (folder.has_relative_path() && !std::filesystem::exists(folder, error)) folder = folder.parent_path();
    if (folder.empty()) return;
    const std::filesystem::space_info space = std::filesystem::space(folder, error);
    if (!error && space.available < kIndexBytes) setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

/// Sample counts of multisampled textures of this format, descending as GL lists them.
std::vector<int> samplesOf(GLenum internalFormat) {
    GLint count = 0;
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, internalFormat, GL_NUM_SAMPLE_COUNTS, 1, &count);
    std::vector<int> samples(std::size_t(std::max(count, 0)));
    if (!samples.empty())
        glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, internalFormat, GL_SAMPLES, count, samples.data());
    return samples;
}

/// Sample positions in a pixel. GL reports them for the bound framebuffer only.
std::vector<glm::vec2> placesOf(int samples) {
    std::uint32_t texture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture);
    glTextureStorage2DMultisample(texture, samples, GL_RGBA32F, 1, 1, GL_TRUE);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    std::vector<glm::vec2> places(std::size_t(samples), glm::vec2(0.5f));
    for (std::size_t i = 0; i < places.size(); ++i) glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(i), &places[i].x);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    return places;
}

std::vector<std::vector<glm::vec2>> commonSamplePlaces() {
    std::vector<int> common;
    for (const int samples : samplesOf(GL_RGBA32F)) {
        const auto has = [&](GLenum internalFormat) {
            const std::vector<int> others = samplesOf(internalFormat);
            return std::find(others.begin(), others.end(), samples) != others.end();
        };
        if (samples > 1 && has(GL_R32F) && has(GL_DEPTH_COMPONENT32F)) common.push_back(samples);
    }
    std::sort(common.begin(), common.end());
    std::vector<std::vector<glm::vec2>> places{{glm::vec2(0.5f)}};
    for (const int samples : common) places.push_back(placesOf(samples));
    return places;
}

bool isSoftwareRenderer(const std::string& name) {
    const std::string renderer = inLowercase(name);
    constexpr std::array<std::string_view, 4> kNames{"llvmpipe", "softpipe", "swrast", "software rasterizer"};
    return std::any_of(kNames.begin(), kNames.end(),
                       [&](std::string_view kind) { return renderer.find(kind) != std::string::npos; });
}

void GLAD_API_PTR onDebugMessage(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* log) {
    // ShaderError reports compiler messages, from the program's log.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    const std::string_view said =
        length < 0 ? std::string_view(message) : std::string_view(message, std::size_t(length));
    static_cast<DebugLog*>(const_cast<void*>(log))->add(type, id, severity, said);
}

Capabilities readCapabilities(std::string contextWay) {
    Capabilities capabilities;
    capabilities.vendor = text(GL_VENDOR);
    capabilities.renderer = text(GL_RENDERER);
    capabilities.version = text(GL_VERSION);
    capabilities.glslVersion = text(GL_SHADING_LANGUAGE_VERSION);
    capabilities.contextWay = std::move(contextWay);
    capabilities.isSoftware = isSoftwareRenderer(capabilities.renderer);
    // Mesa's rasterisers snap vertices for coverage, not for depth.
    if (!capabilities.isSoftware)
        capabilities.snapPixels = std::sqrt(0.5f) * std::exp2(-float(integer(GL_SUBPIXEL_BITS)));
    // Observed with Mesa 22.3's zink over lavapipe.
    capabilities.indexesUniformBlocks = !(capabilities.isSoftware && capabilities.renderer.starts_with("zink"));
    capabilities.maxTextureBufferTexels = std::size_t(integer(GL_MAX_TEXTURE_BUFFER_SIZE));
    capabilities.maxUniformBlockBytes = std::size_t(integer(GL_MAX_UNIFORM_BLOCK_SIZE));
    capabilities.maxStorageBlockBytes = std::size_t(integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
    capabilities.maxTextureSize = int(integer(GL_MAX_TEXTURE_SIZE));
    capabilities.maxSamples = int(integer(GL_MAX_COLOR_TEXTURE_SAMPLES));
    capabilities.texturesAStage = int(integer(GL_MAX_TEXTURE_IMAGE_UNITS));
    capabilities.samplePlaces = commonSamplePlaces();
    if (hasExtension("GL_ARB_texture_filter_anisotropic") || hasExtension("GL_EXT_texture_filter_anisotropic"))
        glGetFloatv(kMaxTextureMaxAnisotropy, &capabilities.maxAnisotropy);
    capabilities.parallelShaderCompile = GLAD_GL_KHR_parallel_shader_compile != 0;
    return capabilities;
}

} // namespace

void Answers::add(const std::string& way, const std::runtime_error& error) {
    all.push_back(fmt::format("{}: {}", way, error.what()));
    if (dynamic_cast<const DriverTooOld*>(&error) != nullptr) tooOld = error.what();
}

std::unique_ptr<Context> Context::create(const ContextOptions& options) {
    Answers answers;
    std::unique_ptr<Context> context;
    Context* const previous = currentContext;
    releaseCurrent();
    const bool egl = options.kind != ContextKind::Window;
    const bool window = options.kind != ContextKind::Egl;
    // Visible output needs the window; EGL is then the fallback, so that a program still runs without a display.
    avoidShaderCacheOnFullDisk();
    if (window && options.visible) context = createWindowContext(options, answers);
    if (!context && egl) context = createEglContext(options, answers);
    if (!context && window && !options.visible) context = createWindowContext(options, answers);
    if (context) return context;
    if (previous) previous->makeCurrent();
    if (!answers.tooOld.empty())
        throw std::runtime_error(
            fmt::format("no OpenGL 4.5 context can be made: {}; use another driver, such as Mesa's llvmpipe (Debian: "
                        "libgl1-mesa-dri, without GALLIUM_DRIVER in the environment); all that were tried: {}",
                        answers.tooOld, fmt::join(answers.all, "; ")));
    throw std::runtime_error(fmt::format(
        "no OpenGL 4.5 context can be made ({}); install a driver (Debian: libegl1 libgl1-mesa-dri{}, or the maker's)",
        fmt::join(answers.all, "; "), window ? " libglx-mesa0 and a running display for windows" : ""));
}

Context::Context(std::string contextWay, LoadFunction load) : load_(load), debugLog_(std::make_unique<DebugLog>()) {
    capabilities_.contextWay = std::move(contextWay);
}

Context::~Context() {
    if (currentContext == this) currentContext = nullptr;
}

void Context::makeCurrent() {
    if (currentContext == this) return;
    // X servers refuse a GLX context on a thread with a current EGL context.
    releaseCurrent();
    makeCurrentImpl();
    // Entry points may differ between drivers, and glad keeps one set.
    gladLoadGL(load_);
    currentContext = this;
}

void Context::releaseCurrent() {
    if (currentContext) currentContext->releaseImpl();
    currentContext = nullptr;
}

Context* Context::current() {
    return currentContext;
}

void Context::initialise(bool debug) {
    const int version = gladLoadGL(load_);
    if (version < GLAD_MAKE_VERSION(4, 5))
        throw DriverTooOld(
            fmt::format("the driver offers OpenGL {}.{}", GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)));
    capabilities_ = readCapabilities(std::move(capabilities_.contextWay));
    if (debug) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(onDebugMessage, debugLog_.get());
    }
    if (capabilities_.parallelShaderCompile) glMaxShaderCompilerThreadsKHR(0xffffffffu); // as many as the driver likes

    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DITHER);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glCreateVertexArrays(1, &emptyVertexArray_);
    currentContext = this;
    throwIfFailed("while the context was set up");
}

} // namespace tessera::gpu
