#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Hook.h"

/// Functions of a scene's hook that run beside the frame, in compute shaders, and what they make is read back.
namespace tessera::engine {

/// What they are called: passes/<name>.comp, whose groups are of 64.
inline constexpr const char* kHookSurfaces = "hook_surfaces";
inline constexpr const char* kHookVertices = "hook_vertices";
shader::ProgramDesc hookProgram(const std::string& name, const scenes::Hook& hook);

/// One of them at a time; its program is in use as long as no other is.
class HookRun {
public:
    /// Throws InputError where the hook is faulty.
    HookRun(const std::string& name, const scenes::Hook& hook, double timeSeconds, shader::ProgramLibrary& programs);

    /// What it makes of what is given, `count` times so many numbers. The slots are those of its storage blocks.
    std::vector<float> run(std::uint32_t givenSlot, const gpu::Buffer& given, std::uint32_t takenSlot,
                           std::size_t count, std::size_t numbersEach) const;

private:
    gpu::Buffer constants_;
};

} // namespace tessera::engine
