#include "engine/HookProgram.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/frame/HookConstants.h"
#include "renderer/frame/LightRounds.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/hook.h"
#include "shaders/shared/slots.h"

namespace tessera::engine {

shader::ProgramDesc hookProgram(const std::string& name, const scenes::Hook& hook) {
    shader::ProgramDesc desc;
    desc.name = name;
    desc.compute = "passes/" + name + ".comp";
    desc.defines = frame::hookDefines(frame::hookShape(hook));
    desc.defines.emplace_back("DEPTH_ONLY", "0");
    return desc;
}

HookRun::HookRun(const std::string& name, const scenes::Hook& hook, double timeSeconds,
                 shader::ProgramLibrary& programs)
    : constants_(gpu::Buffer::of("hook", std::vector{frame::hookConstants(hook, timeSeconds)})), file_(hook.file) {
    gpu::useProgram(programs.get(hookProgram(name, hook)));
    gpu::bindUniformBuffer(UNIFORM_HOOK, constants_);
}

gpu::Buffer HookRun::runInto(std::uint32_t givenSlot, const gpu::Buffer& given, std::uint32_t takenSlot,
                             std::size_t count, std::size_t bytes) const {
    gpu::Buffer taken("made by hook", bytes, gpu::BufferUse::Readback);
    gpu::bindStorageBuffer(givenSlot, given);
    gpu::bindStorageBuffer(takenSlot, taken);
    gpu::dispatch(std::uint32_t((count + HOOK_GROUP - 1) / HOOK_GROUP));
    gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
    return taken;
}

void HookRun::failCut() const {
    throw InputError(fmt::format("{}: its loops take more than {} iterations, after which they are ended; take fewer",
                                 file_, frame::kMostHookIterations));
}

} // namespace tessera::engine
