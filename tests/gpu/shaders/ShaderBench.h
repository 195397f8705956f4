#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "renderer/shader/ProgramLibrary.h"
#include "shaders/shared/slots.h"
#include "tests/support/GlContext.h"
#include "tests/support/ShaderFolder.h"
#include "tests/support/TempFolder.h"

namespace tessera::test {

/// Runs the product's shader functions on test data: compute shaders of shaders/stress/, and of tests/gpu/ as test/.
/// They include from the product's shader tree in shaderFolder().
class ShaderBench {
public:
    ShaderBench() : ShaderBench([](const std::filesystem::path&) {}) {}

    /// `edit` changes the sources before they are read; its argument is their folder.
    explicit ShaderBench(const std::function<void(const std::filesystem::path&)>& edit)
        : library_(shader::SourceTree(sources(edit))) {}

    /// Runs one invocation per record. A shader reads vec4 inputs[] (binding 0) and writes vec4 outputs[] (binding 1),
    /// a fixed number of each per record, which the shader defines.
    std::vector<glm::vec4> run(const std::string& file, const shader::Defines& defines,
                               const std::vector<glm::vec4>& inputs, std::size_t records,
                               std::size_t outputsPerRecord) {
        const gpu::Program& program = library_.get({file, "", "", file, defines});
        const gpu::Buffer in = gpu::Buffer::of("inputs", inputs);
        const gpu::Buffer out("outputs", records * outputsPerRecord * sizeof(glm::vec4), gpu::BufferUse::Readback);
        gpu::useProgram(program);
        gpu::bindStorageBuffer(0, in);
        gpu::bindStorageBuffer(1, out);
        gpu::dispatch(std::uint32_t((records + kGroup - 1) / kGroup));
        gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
        return out.downloadAs<glm::vec4>(records * outputsPerRecord);
    }

    shader::ProgramLibrary& programs() { return library_; }

private:
    static constexpr std::size_t kGroup = 64; ///< local_size_x of every test shader

    const std::filesystem::path& sources(const std::function<void(const std::filesystem::path&)>& edit) {
        const std::filesystem::path root(TESSERA_SOURCE_DIR);
        const auto recursive = std::filesystem::copy_options::recursive;
        std::filesystem::copy(shaderFolder(), folder_.path(), recursive);
        std::filesystem::create_directories(folder_.path() / "test");
        for (const char* part : {"shaders", "layout", "gbuffer", "validation"}) {
            for (const auto& entry : std::filesystem::directory_iterator(root / "tests/gpu" / part)) {
                if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") continue;
                std::filesystem::copy_file(entry.path(), folder_.path() / "test" / entry.path().filename());
            }
        }
        edit(folder_.path());
        return folder_.path();
    }

    TempFolder folder_;
    shader::ProgramLibrary library_;
};

} // namespace tessera::test
