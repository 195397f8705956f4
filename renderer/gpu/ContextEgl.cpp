#include <array>
#include <cassert>
#include <map>
#include <stdexcept>
#include <string_view>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include "renderer/gpu/ContextWays.h"

namespace tessera::gpu {
namespace {

std::string errorName(EGLint error) {
    switch (error) {
    case EGL_SUCCESS:
        return "no error code";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
        return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
        return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    default:
        return fmt::format("EGL error 0x{:x}", error);
    }
}

[[noreturn]] void fail(std::string_view call) {
    throw std::runtime_error(fmt::format("{} failed, {}", call, errorName(eglGetError())));
}

bool listed(const char* extensions, std::string_view wanted) {
    for (std::string_view rest = extensions ? extensions : ""; !rest.empty();) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == wanted) return true;
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return false;
}

/// An initialised display, reference-counted, since eglTerminate ends it for all contexts that share it.
class Display {
public:
    explicit Display(EGLDisplay display) : display_(display) {
        if (display == EGL_NO_DISPLAY) fail("opening the display");
        if (!eglInitialize(display, nullptr, nullptr)) fail("eglInitialize");
        ++users()[display];
    }
    ~Display() {
        if (--users()[display_] == 0) eglTerminate(display_);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    operator EGLDisplay() const { return display_; }

private:
    static std::map<EGLDisplay, int>& users() {
        static std::map<EGLDisplay, int> counts;
        return counts;
    }
    EGLDisplay display_;
};

/// The OpenGL version of a driver that lacks 4.5; empty if it creates no context at all.
std::string offered(EGLDisplay display, EGLConfig config) {
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (context == EGL_NO_CONTEXT) return {};
    std::string text;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        using GetString = const unsigned char* (*)(unsigned int);
        const auto getString = reinterpret_cast<GetString>(eglGetProcAddress("glGetString"));
        const auto said = [&](unsigned int name) {
            const unsigned char* value = getString != nullptr ? getString(name) : nullptr;
            return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "?");
        };
        constexpr unsigned int kRenderer = 0x1F01, kVersion = 0x1F02; // GL_RENDERER, GL_VERSION
        text = fmt::format("the driver '{}' offers OpenGL {}", said(kRenderer), said(kVersion));
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, context);
    return text;
}

class EglContext final : public Context {
public:
    EglContext(std::string way, EGLDisplay display, bool debug)
        : Context(std::move(way), eglGetProcAddress), display_(display), context_(display_, debug) {
        makeCurrentImpl();
        initialise(debug);
    }

private:
    struct Handle {
        Handle(EGLDisplay onDisplay, bool debug) : display(onDisplay) {
            if (!listed(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
                throw std::runtime_error("it lacks EGL_KHR_surfaceless_context");
            if (!eglBindAPI(EGL_OPENGL_API)) fail("eglBindAPI");
            constexpr std::array kConfig{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
            EGLConfig config = nullptr;
            EGLint count = 0;
            if (!eglChooseConfig(display, kConfig.data(), &config, 1, &count)) fail("eglChooseConfig");
            if (count == 0) throw std::runtime_error("it has no configuration for OpenGL");
            const std::array attributes{EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_CONTEXT_OPENGL_DEBUG,
                                        debug ? EGL_TRUE : EGL_FALSE,
                                        EGL_NONE};
            context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
            if (context != EGL_NO_CONTEXT) return;
            const EGLint error = eglGetError();
            if (const std::string less = offered(display, config); !less.empty()) throw DriverTooOld(less);
            throw std::runtime_error("eglCreateContext failed, " + errorName(error));
        }
        ~Handle() {
            if (eglGetCurrentContext() == context)
                eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display, context);
        }
        Handle(const Handle&) = delete;
        Handle& operator=(const Handle&) = delete;
        EGLDisplay display;
        EGLContext context = EGL_NO_CONTEXT;
    };

    void makeCurrentImpl() override {
        if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_.context))
            fail("eglMakeCurrent");
    }

    void releaseImpl() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

    Display display_;
    Handle context_;
};

template <typename Function>
Function entryPoint(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Tries displays in order, and keeps the first software context as fallback.
class Search {
public:
    Search(const ContextOptions& options, Answers& answers) : options_(options), answers_(answers) {}

    /// Tries a display; a context of a hardware device ends the search.
    void tryDisplay(const std::string& way, EGLDisplay display) {
        if (done()) return;
        Context::releaseCurrent(); // a failing attempt leaves no context current
        try {
            auto context = std::make_unique<EglContext>(way, display, options_.debug);
            auto& place = context->capabilities().isSoftware ? software_ : hardware_;
            if (!place) place = std::move(context);
        } catch (const std::runtime_error& error) {
            answers_.add(way, error);
        }
    }
    void refuse(std::string answer) { answers_.all.push_back(std::move(answer)); }
    bool done() const { return hardware_ != nullptr; }
    bool hasSoftware() const { return software_ != nullptr; }
    std::unique_ptr<Context> result() {
        std::unique_ptr<Context> found = hardware_ ? std::move(hardware_) : std::move(software_);
        software_.reset();
        if (found) found->makeCurrent();
        return found;
    }

private:
    const ContextOptions& options_;
    Answers& answers_;
    std::unique_ptr<Context> hardware_, software_;
};

void tryDevices(Search& search, PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay) {
    const auto queryDevices = entryPoint<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto queryString = entryPoint<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (!queryDevices || !queryString) return search.refuse("EGL devices: not offered");
    EGLint count = 0;
    if (!queryDevices(0, nullptr, &count) || count == 0) return search.refuse("EGL devices: none");
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    queryDevices(count, devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[std::size_t(i)];
        // A second software context is of no use.
        if (search.hasSoftware() && listed(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
        search.tryDisplay(fmt::format("EGL device {}", i),
                          getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
}

} // namespace

std::unique_ptr<Context> createEglContext(const ContextOptions& options, Answers& answers) {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto getPlatformDisplay = entryPoint<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    Search search(options, answers);
    if (getPlatformDisplay && listed(extensions, "EGL_MESA_platform_surfaceless"))
        search.tryDisplay("EGL surfaceless",
                          getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    else
        search.refuse("EGL surfaceless: not offered");
    if (!search.done() && getPlatformDisplay && listed(extensions, "EGL_EXT_platform_device"))
        tryDevices(search, getPlatformDisplay);
    if (!search.done() && !search.hasSoftware())
        search.tryDisplay("EGL default display", eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return search.result();
}

} // namespace tessera::gpu
