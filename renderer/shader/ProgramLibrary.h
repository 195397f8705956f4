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

/// What is wrong with the new source of a program.
struct ShaderFault {
    std::string text;    ///< with file and line
    std::string program; ///< its name and defines; empty where a source cannot even be read
};
/// What reading the sources again came to.
struct Reloading {
    std::size_t programs = 0; ///< that have another form now
    std::vector<ShaderFault> faults;
};

/// Every program of the process, compiled once per distinct variant, on the context that is current at its first use.
class ProgramLibrary : public graph::ProgramSource {
public:
    explicit ProgramLibrary(SourceTree tree = SourceTree());

    /// Compiles at the first request. The reference holds as long as the library, also across reload(). Throws
    /// gpu::ShaderError whose log lines name file and line, or InputError when a source is missing or the hook of the
    /// program's scene is faulty.
    const gpu::Program& get(const ProgramDesc& desc) override;
    /// Issues all that are missing before collecting the first, so that drivers that can compile in parallel do. Throws
    /// as get(), after every good one has been kept.
    void warm(std::span<const ProgramDesc> descs);
    /// Reads the sources again and recompiles what changed. A program whose new source is faulty keeps its last good
    /// form.
    Reloading reload();
    /// True once after a file of the source folder changed, or a hook of a program that was asked for, faulty ones
    /// too; embedded sources never do.
    bool sourcesChanged();
    /// Whether there is a source folder or a hook: what sourcesChanged() looks at.
    bool watchesFiles() const { return !tree_.isEmbedded() || !hooks_.empty(); }

    const SourceTree& tree() const { return tree_; }
    std::size_t size() const { return entries_.size(); }
    /// How many programs reload() has given another form so far. What is kept of their results is out of date when this
    /// grows.
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
    std::optional<Time> treeChange_;                        ///< as sourcesChanged() saw it last
    std::map<std::string, std::optional<Time>> hooks_;      ///< the same of their files; none: it was not there
    std::map<std::string, std::unique_ptr<Entry>> entries_; ///< by ProgramDesc::key()
    std::size_t reloaded_ = 0;
};

} // namespace tessera::shader
