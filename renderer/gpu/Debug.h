#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::gpu {

/// What the driver said through KHR_debug since the last check point. The driver's C callback only fills this; an
/// exception thrown through it would be undefined.
class DebugLog {
public:
    /// One message, as the driver's callback gives it. Errors, and messages of high or medium severity, are failures;
    /// advice on performance is a warning, since drivers disagree widely on it; the rest is dropped.
    void add(std::uint32_t type, std::uint32_t id, std::uint32_t severity, std::string_view text);
    void pushGroup(std::string_view name) { groups_.emplace_back(name); }
    void popGroup() { groups_.pop_back(); }

    /// Failures so far, each beginning with the debug groups it happened in ("frame / lighting: ..."); empties the
    /// list.
    std::vector<std::string> takeFailures();
    std::vector<std::string> takeWarnings();

private:
    std::string inGroups(std::string_view text) const;
    std::vector<std::string> groups_;
    std::vector<std::string> failures_;
    std::vector<std::string> warnings_;
};

/// The check point: throws std::runtime_error naming pass and message when the driver reported a failure since the last
/// one. `when` says what was going on ("creating buffer 'lights'"). Also asks glGetError, so contexts without debug
/// output work.
void throwIfFailed(std::string_view when = {});

/// As throwIfFailed(), for what allocates `bytes`: GL_OUT_OF_MEMORY becomes a text that names `what` and its size.
void throwIfAllocationFailed(std::string_view what, std::size_t bytes);

/// Throws what throwIfAllocationFailed() throws of GL_OUT_OF_MEMORY.
[[noreturn]] void failAllocation(std::string_view what, std::size_t bytes);

/// Names the GL calls of its scope in driver messages and in frame debuggers.
class DebugGroup {
public:
    explicit DebugGroup(std::string_view name);
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

/// The kinds of GL object that carry a label.
enum class LabelKind { Buffer, Texture, Sampler, Shader, Program, VertexArray, Framebuffer, Query };

/// Labels a GL object for messages and frame debuggers; over-long labels are cut to what the driver takes.
void labelObject(LabelKind kind, std::uint32_t id, std::string_view label);

} // namespace tessera::gpu
