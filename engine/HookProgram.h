#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Hook.h"

/// Runs functions of a scene's hook in compute shaders, outside of frames, and reads their results back.
namespace tessera::engine {

/// Program names; the source is passes/<name>.comp.
inline constexpr const char* kHookSurfaces = "hook_surfaces";
inline constexpr const char* kHookVertices = "hook_vertices";
shader::ProgramDesc hookProgram(const std::string& name, const scenes::Hook& hook);

/// A bound hook program, valid until another program is used.
class HookRun {
public:
    /// Throws InputError where the hook is faulty.
    HookRun(const std::string& name, const scenes::Hook& hook, double timeSeconds, shader::ProgramLibrary& programs);

    /// Runs the hook on `count` items and returns one row per item. The slots are those of its storage blocks. Throws
    /// InputError if loops of the hook were truncated.
    template <typename Row>
    std::vector<Row> run(std::uint32_t givenSlot, const gpu::Buffer& given, std::uint32_t takenSlot,
                         std::size_t count) const {
        std::vector<Row> rows =
            runInto(givenSlot, given, takenSlot, count, count * sizeof(Row)).template downloadAs<Row>(count);
        if (std::ranges::any_of(rows, [](const Row& row) { return row.isCut != 0; })) failCut();
        return rows;
    }

private:
    /// Runs the hook and returns its output buffer of `bytes`.
    gpu::Buffer runInto(std::uint32_t givenSlot, const gpu::Buffer& given, std::uint32_t takenSlot, std::size_t count,
                        std::size_t bytes) const;

    [[noreturn]] void failCut() const;

    gpu::Buffer constants_;
    std::string file_; ///< of the hook
};

} // namespace tessera::engine
