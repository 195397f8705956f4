#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/bench/BenchPlan.h"
#include "validation/bench/BenchRecord.h"
#include "validation/bench/FolderLock.h"
#include "validation/bench/MeasureGroup.h"

namespace tessera::validation {

/// Maximum number of shards of a run.
inline constexpr int kMostShards = 10000;

/// The identity of a run. Points of runs are merged only if all of it except shard and command is equal.
struct RunIdentity {
    std::string machine, renderer;
    std::string driver; ///< OpenGL version string, which includes the driver's version
    std::string commit;
    std::string settings; ///< the options of the frames
    std::string against;  ///< the requested truth of the errors
    int frames = 0;
    /// The part measured here: the groups whose index is shard - 1 modulo shards.
    int shard = 1, shards = 1;
    std::string command;
};

/// What happens to an unfinished run in the folder of a new one.
enum class EarlierRun : std::uint8_t {
    Keep,   ///< it stays, and the new run is refused
    Resume, ///< it continues; refused if it is a different run
    Replace ///< it is deleted
};

/// The state of a run, in the folder `parts` of its output, so that the run can be killed at any time, resumed, and
/// merged with other shards. run.json holds the identity of the run, group-NNN.json the progress of a group; its images
/// lie beside it. Files are written atomically. The folder is locked for the lifetime of the store.
class BenchStore {
public:
    /// Begins or resumes a run in `folder`, which must exist. Throws InputError if an unfinished run there is to stay;
    /// if the run to resume differs, naming the difference, or its scene has changed; and if files are damaged. Throws
    /// std::runtime_error if another process, which it names, uses the folder, or if nothing can be written.
    BenchStore(const std::string& folder, const RunIdentity& identity, const BenchPlan& plan, EarlierRun earlier);

    const std::string& folder() const { return folder_; }
    /// Whether this shard measures the group.
    bool isOfShard(std::size_t group) const;
    GroupState load(std::size_t group) const; ///< empty if nothing is kept
    void keep(std::size_t group, const GroupState& state) const;
    std::string keepPicture(std::size_t group, const std::string& name, const DisplayImage& image) const;

private:
    std::string folder_;
    FolderLock lock_;
    int shard_ = 1, shards_ = 1;
};

/// Reads all results kept in `folder`, in the order of the plan. Throws InputError if it holds no run or is damaged.
BenchRecord recordIn(const std::string& folder);

/// Reads the bytes of a kept image.
std::vector<std::uint8_t> keptPicture(const std::string& folder, const std::string& file);

} // namespace tessera::validation
