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
/// By name and sources.
using KeptPrograms = std::map<std::string, std::shared_ptr<const LinkedProgram>>;

/// Auto: EGL first, then a hidden window; the other way round when a visible window is asked for.
enum class ContextKind { Auto, Window, Egl };

struct ContextOptions {
    ContextKind kind = ContextKind::Auto;
    bool debug = true;    ///< a debug context: messages of high and medium severity become exceptions (Debug.h)
    bool visible = false; ///< a window on the screen; a headless context draws into framebuffers of its own only
    int width = 64;       ///< of the window, screen coordinates
    int height = 64;
    std::string title = "Tessera";
};

/// An OpenGL 4.5 core context with the conventions of the house set once: zero-to-one clip space with a lower-left
/// origin, sRGB encoding of sRGB targets, no dithering, byte-aligned pixel rows. Every other object of renderer/gpu
/// belongs to the context that was current when it was made and must die before it, while it is current.
class Context {
public:
    /// Makes a context and makes it current instead of the thread's present one. Throws std::runtime_error when none
    /// can be had; the text says which ways were tried, what each answered and what to install.
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

    /// From now on programs of one name and the very same sources are compiled once, whoever asks for them, and kept:
    /// for tests, whose renderers come and go. All can share one, since programs hold no uniforms of their own.
    void keepPrograms() { keptPrograms_.emplace(); }
    /// Ends that; to be called while the context is current, and before it dies.
    void forgetPrograms() { keptPrograms_.reset(); }
    KeptPrograms* keptPrograms() { return keptPrograms_ ? &*keptPrograms_ : nullptr; } ///< null: keeps none

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
    /// To be called by the derived constructor once its context is current: loads OpenGL, reads capabilities, sets
    /// state.
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
