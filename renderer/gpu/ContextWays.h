#pragma once
#include <memory>
#include <string>
#include <vector>

#include "renderer/gpu/Context.h"

namespace tessera::gpu {

/// The ways to a context that Context::create() tries. Each returns null after adding to `answers` what it tried and
/// what it was told ("EGL surfaceless: eglInitialize failed, EGL_NOT_INITIALIZED").

/// Without a display: Mesa's surfaceless platform, every EGL device, EGL's default display. A hardware device is
/// preferred to a software rasteriser, wherever in this order it comes.
std::unique_ptr<Context> createEglContext(const ContextOptions& options, std::vector<std::string>& answers);

/// A GLFW window, hidden unless visible.
std::unique_ptr<Context> createWindowContext(const ContextOptions& options, std::vector<std::string>& answers);

} // namespace tessera::gpu
