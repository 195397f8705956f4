#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/gpu/Program.h"
#include "renderer/graph/Execute.h"
#include "renderer/shader/ProgramDesc.h"

namespace tessera::shader {

/// An error in the new source of a program.
struct ShaderFault {
    std::string text;    ///< with file and line
    std::string program; ///< its name and defines; empty if a source could not be expanded
};
/// The result of ProgramLibrary::reload().
struct Reloading {
    std::size_t programs = 0; ///< number of programs replaced
    std::vector<ShaderFault> faults;
};

/// All programs of the process, compiled once per variant, on the context that is current at first use.
class ProgramLibrary : public graph::ProgramSource {
public:
    explicit ProgramLibrary(SourceTree tree = SourceTree());

    /// Compiles on first use. The reference is valid as long as the library, also across reload(). Throws
    /// gpu::ShaderError whose log lines name file and line, or InputError if a source is missing or the scene's hook is
    /// faulty.
    const gpu::Program& get(const ProgramDesc& desc) override;
    /// Compiles the missing programs, issuing all before collecting the first, so that drivers can compile in parallel.
    /// Throws as get(), after all valid programs are stored.
    void warm(std::span<const ProgramDesc> descs);
    /// Rereads the sources and recompiles changed programs. A program with faulty new source keeps its last working
    /// version.
    Reloading reload();
    /// Returns true once after a change of a file in the source folder, or of a requested program's hook, even if
    /// faulty. Embedded sources never change.
    bool sourcesChanged();
    /// Whether sourcesChanged() watches any file: a source folder or a hook.
    bool watchesFiles() const { return !tree_.isEmbedded() || !hooks_.empty(); }

    const SourceTree& tree() const { return tree_; }
    std::size_t size() const { return entries_.size(); }
    /// Number of programs that reload() has replaced so far. Cached results of programs are stale when this grows.
    std::size_t reloaded() const { return reloaded_; }

private:
    using Time = std::filesystem::file_time_type;
    void noteHook(const ProgramDesc& desc);

    struct Entry {
        ProgramDesc desc;
        std::vector<ExpandedStage> stages;
        gpu::Program program;
    };
    SourceTree tree_;
    std::optional<Time> treeChange_;                        ///< the newest change at the last sourcesChanged()
    std::map<std::string, std::optional<Time>> hooks_;      ///< the same by hook file; none: it was missing
    std::map<std::string, std::unique_ptr<Entry>> entries_; ///< by ProgramDesc::key()
    std::size_t reloaded_ = 0;
};

} // namespace tessera::shader
