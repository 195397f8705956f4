#pragma once
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/gpu/Context.h"

namespace tessera::gpu {

/// Thrown for a working driver without OpenGL 4.5; the text names its version.
class DriverTooOld : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Errors of failed attempts to create a context.
struct Answers {
    std::vector<std::string> all; ///< "EGL surfaceless: eglInitialize failed, EGL_NOT_INITIALIZED"
    std::string tooOld;           ///< error of a driver without OpenGL 4.5; empty: none
    void add(const std::string& way, const std::runtime_error& error);
};

/// Attempts of Context::create(). On failure each returns null and adds its name and error to `answers`.

/// Creates a headless context: tries Mesa's surfaceless platform, every EGL device, EGL's default display. Prefers a
/// hardware device to a software rasteriser, regardless of this order.
std::unique_ptr<Context> createEglContext(const ContextOptions& options, Answers& answers);

/// Creates the context of a GLFW window, hidden unless options.visible.
std::unique_ptr<Context> createWindowContext(const ContextOptions& options, Answers& answers);

} // namespace tessera::gpu
