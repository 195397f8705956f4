#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gpu/Id.h"

namespace tessera::gpu {

enum class Stage : std::uint8_t { Vertex, Geometry, Fragment, Compute };
std::string_view stageName(Stage stage); ///< "vertex", "geometry", "fragment", "compute"

struct StageSource {
    Stage stage;
    std::string source;
};

/// Thrown for a program that does not compile or link. The text holds every stage's log and the program's name.
class ShaderError : public std::runtime_error {
public:
    struct StageLog {
        Stage stage;
        std::string text;
    };
    ShaderError(std::string program, std::vector<StageLog> stageLogs, std::string linkLog);
    const std::string& program() const { return program_; }
    const std::vector<StageLog>& stageLogs() const { return stageLogs_; } ///< of the stages that failed
    const std::string& linkLog() const { return linkLog_; }               ///< empty when a stage failed
    std::string log() const; ///< all logs, without the program's name, which lists all its defines

private:
    std::string program_;
    std::vector<StageLog> stageLogs_;
    std::string linkLog_;
};

enum class BlockKind { Uniform, Storage };

/// A member of an interface block as the linked program lays it out; names as GL reports them ("lights[0].positionVS").
struct BlockMember {
    std::string name;
    std::size_t offset = 0;         ///< bytes from the block's start
    std::size_t arrayStride = 0;    ///< bytes, of an array of plain values; 0: no array
    std::size_t matrixStride = 0;   ///< bytes between columns; 0: no matrix
    std::size_t topArrayStride = 0; ///< bytes between elements of the outermost array of a storage block; 0: no array
};

/// A linked GL program and its queried properties.
struct LinkedProgram {
    explicit LinkedProgram(Id linked);
    ~LinkedProgram();
    LinkedProgram(const LinkedProgram&) = delete;
    LinkedProgram& operator=(const LinkedProgram&) = delete;
    Id id;
    std::map<std::uint32_t, std::size_t> uniformBlockBytes; ///< by slot
};

class Program {
public:
    /// Compiles and links, unless the context caches a program of this name and sources (Context::keepPrograms()).
    /// Throws ShaderError with the driver's logs, or if a stage samples more textures than the driver offers per stage.
    Program(std::string label, std::span<const StageSource> stages);
    Program(Program&&) noexcept = default;
    Program& operator=(Program&&) noexcept = default;

    /// The active members of a uniform or storage block by offset; empty when the program has no such active block.
    std::vector<BlockMember> blockMembers(std::string_view block, BlockKind kind) const;
    /// GL_BUFFER_DATA_SIZE of the block, bytes; 0 when the program has no such active block.
    std::size_t blockBytes(std::string_view block, BlockKind kind) const;
    /// Binding slot of a block or of a sampler or image uniform; -1 when it is not active.
    int blockSlot(std::string_view block, BlockKind kind) const;
    int samplerUnit(std::string_view uniform) const;
    /// Number of textures and buffer textures that a stage samples; array elements count individually.
    int sampledTextures(Stage stage) const;
    /// GL_BUFFER_DATA_SIZE of the active uniform block at a slot, bytes; 0 when there is none.
    std::size_t uniformBlockBytes(std::uint32_t slot) const;

    std::uint32_t id() const { return linked_ ? linked_->id.value() : 0; } ///< 0 if moved from
    const std::string& label() const { return label_; }

private:
    friend class PendingProgram;
    Program(std::string label, std::shared_ptr<const LinkedProgram> linked)
        : label_(std::move(label)), linked_(std::move(linked)) {}
    std::string label_;
    std::shared_ptr<const LinkedProgram> linked_; ///< shared by programs of the same sources
};

/// A program under construction. The constructor only issues the work, so that a driver with
/// KHR_parallel_shader_compile builds many at once; finish() collects.
class PendingProgram {
public:
    PendingProgram(std::string label, std::span<const StageSource> stages);
    ~PendingProgram();
    PendingProgram(PendingProgram&&) noexcept = default;
    PendingProgram& operator=(PendingProgram&&) noexcept = default;
    /// Waits for the driver. Throws ShaderError.
    Program finish();

private:
    struct PendingShader {
        Stage stage;
        Id id;
    };
    std::string label_;
    std::string key_; ///< key in the context's cache; empty: no cache
    std::shared_ptr<const LinkedProgram> kept_;
    std::vector<PendingShader> shaders_;
    Id id_;
};

} // namespace tessera::gpu
