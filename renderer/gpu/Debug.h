#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::gpu {

/// Driver messages of KHR_debug since the last check. The driver's C callback only records them, since an exception
/// thrown through it would be undefined behaviour.
class DebugLog {
public:
    /// Records a message of the driver's callback. Errors, and messages of high or medium severity, are failures;
    /// advice on performance is a warning, since drivers disagree widely on it; the rest is dropped.
    void add(std::uint32_t type, std::uint32_t id, std::uint32_t severity, std::string_view text);
    void pushGroup(std::string_view name) { groups_.emplace_back(name); }
    void popGroup() { groups_.pop_back(); }

    /// Returns and clears the failures, each prefixed with its debug groups ("frame / lighting: ...").
    std::vector<std::string> takeFailures();
    std::vector<std::string> takeWarnings();

private:
    std::string inGroups(std::string_view text) const;
    std::vector<std::string> groups_;
    std::vector<std::string> failures_;
    std::vector<std::string> warnings_;
};

/// Throws std::runtime_error naming pass and message if the driver reported a failure since the last check. `when`
/// names the current operation ("creating buffer 'lights'"). Also polls glGetError, for contexts without debug output.
void throwIfFailed(std::string_view when = {});

/// As throwIfFailed(), after an allocation of `bytes`: reports GL_OUT_OF_MEMORY by failAllocation().
void throwIfAllocationFailed(std::string_view what, std::size_t bytes);

/// Throws std::runtime_error naming `what`, its size and a remedy.
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

/// Labels a GL object for messages and frame debuggers; truncates labels beyond the driver's limit.
void labelObject(LabelKind kind, std::uint32_t id, std::string_view label);

} // namespace tessera::gpu
