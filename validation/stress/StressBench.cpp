#include "validation/stress/StressBench.h"

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"
#include "shaders/shared/stress.h"

namespace tessera::validation {

std::vector<glm::vec4> StressBench::run(const std::string& shader, const shader::Defines& defines,
                                        const std::vector<glm::vec4>& inputs, std::size_t records,
                                        std::size_t outputsPerRecord) {
    const gpu::Program& program = programs_.get({shader, "", "", shader, defines});
    const gpu::Buffer in = gpu::Buffer::of("stress inputs", inputs);
    const gpu::Buffer out("stress outputs", records * outputsPerRecord * sizeof(glm::vec4), gpu::BufferUse::Readback);
    gpu::useProgram(program);
    gpu::bindStorageBuffer(STORAGE_STRESS_INPUTS, in);
    gpu::bindStorageBuffer(STORAGE_STRESS_OUTPUTS, out);
    gpu::dispatch(std::uint32_t((records + STRESS_GROUP - 1) / STRESS_GROUP));
    gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
    std::vector<glm::vec4> outputs = out.downloadAs<glm::vec4>(records * outputsPerRecord);
    for (glm::vec4& output : outputs) output *= measuredTimes_;
    return outputs;
}

} // namespace tessera::validation
