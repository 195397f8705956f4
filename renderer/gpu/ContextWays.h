#pragma once
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/gpu/Context.h"

namespace tessera::gpu {

/// A driver that works, but has no OpenGL 4.5; the text says which, and what it has.
class DriverTooOld : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Messages of the attempts that gave no context.
struct Answers {
    std::vector<std::string> all; ///< "EGL surfaceless: eglInitialize failed, EGL_NOT_INITIALIZED"
    std::string tooOld;           ///< of a driver that works but is too old; empty where there is none
    void add(const std::string& way, const std::runtime_error& error);
};

/// The ways to a context that Context::create() tries. On failure each returns null and adds its attempt and the answer
/// to `answers`.

/// Without a display: Mesa's surfaceless platform, every EGL device, EGL's default display. A hardware device is
/// preferred to a software rasteriser, wherever in this order it comes.
std::unique_ptr<Context> createEglContext(const ContextOptions& options, Answers& answers);

/// A GLFW window, hidden unless visible.
std::unique_ptr<Context> createWindowContext(const ContextOptions& options, Answers& answers);

} // namespace tessera::gpu
