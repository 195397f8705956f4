#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "renderer/gpu/Capabilities.h"

namespace tessera::gpu {

class DebugLog;
struct LinkedProgram;
/// Keyed by name and sources.
using KeptPrograms = std::map<std::string, std::shared_ptr<const LinkedProgram>>;

/// Auto: EGL first, then a hidden window; the reverse if a visible window is requested.
enum class ContextKind { Auto, Window, Egl };

struct ContextOptions {
    ContextKind kind = ContextKind::Auto;
    bool debug = true;    ///< a debug context: messages of high and medium severity become exceptions (Debug.h)
    bool visible = false; ///< shows the window; headless contexts draw into framebuffer objects only
    int width = 64;       ///< of the window, screen coordinates
    int height = 64;
    std::string title = "Tessera";
};

/// An OpenGL 4.5 core context with the engine's conventions set: zero-to-one clip space with a lower-left origin, sRGB
/// encoding of sRGB targets, no dithering, byte-aligned pixel rows. Every other object of renderer/gpu belongs to the
/// context that was current at its creation and must be destroyed before it, while it is current.
class Context {
public:
    /// Creates a context and makes it current on the thread. Throws std::runtime_error if that fails; the text lists
    /// every attempt with its error, and what to install.
    static std::unique_ptr<Context> create(const ContextOptions& options = {});
    virtual ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Capabilities& capabilities() const { return capabilities_; }
    void makeCurrent();
    /// Leaves the calling thread without a current context.
    static void releaseCurrent();
    /// The calling thread's context, or null.
    static Context* current();

    /// Caches linked programs by name and sources from now on; for tests, which create many renderers. Renderers can
    /// share them, since programs hold no uniform values.
    void keepPrograms() { keptPrograms_.emplace(); }
    /// Drops that cache. Must be called while the context is current, before its destruction.
    void forgetPrograms() { keptPrograms_.reset(); }
    KeptPrograms* keptPrograms() { return keptPrograms_ ? &*keptPrograms_ : nullptr; } ///< null: no cache

    /// Shows the window's back buffer; headless contexts do nothing.
    virtual void swapBuffers() {}
    /// The GLFWwindow* behind a windowed context, for input and user interfaces; null when headless.
    virtual void* windowHandle() const { return nullptr; }

    DebugLog& debugLog() { return *debugLog_; }
    /// The vertex array of draws without vertex buffers; core profiles need one bound.
    std::uint32_t emptyVertexArray() const { return emptyVertexArray_; }

protected:
    using LoadFunction = void (*(*)(const char* name))();
    Context(std::string contextWay, LoadFunction load);
    /// Loads OpenGL, reads capabilities and sets state. Derived constructors call it once their context is current.
    void initialise(bool debug);

private:
    virtual void makeCurrentImpl() = 0;
    virtual void releaseImpl() = 0;
    Capabilities capabilities_;
    LoadFunction load_;
    std::unique_ptr<DebugLog> debugLog_;
    std::uint32_t emptyVertexArray_ = 0;
    std::optional<KeptPrograms> keptPrograms_;
};

} // namespace tessera::gpu
