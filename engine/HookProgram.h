#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Hook.h"

/// Functions of a scene's hook that run beside the frame, in compute shaders, and what they make is read back.
namespace tessera::engine {

/// What they are called: passes/<name>.comp.
inline constexpr const char* kHookSurfaces = "hook_surfaces";
inline constexpr const char* kHookVertices = "hook_vertices";
shader::ProgramDesc hookProgram(const std::string& name, const scenes::Hook& hook);

/// One of them at a time; its program is in use as long as no other is.
class HookRun {
public:
    /// Throws InputError where the hook is faulty.
    HookRun(const std::string& name, const scenes::Hook& hook, double timeSeconds, shader::ProgramLibrary& programs);

    /// Runs the hook on `count` items and returns a row an item. The slots are those of its storage blocks. Throws
    /// InputError where loops of the hook were ended early.
    template <typename Row>
    std::vector<Row> run(std::uint32_t givenSlot, const gpu::Buffer& given, std::uint32_t takenSlot,
                         std::size_t count) const {
        std::vector<Row> rows =
            runInto(givenSlot, given, takenSlot, count, count * sizeof(Row)).template downloadAs<Row>(count);
        if (std::ranges::any_of(rows, [](const Row& row) { return row.isCut != 0; })) failCut();
        return rows;
    }

private:
    /// The buffer of so many bytes that it has written.
    gpu::Buffer runInto(std::uint32_t givenSlot, const gpu::Buffer& given, std::uint32_t takenSlot, std::size_t count,
                        std::size_t bytes) const;

    [[noreturn]] void failCut() const;

    gpu::Buffer constants_;
    std::string file_; ///< of the hook
};

} // namespace tessera::engine
