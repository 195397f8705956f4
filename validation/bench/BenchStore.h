#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/bench/BenchPlan.h"
#include "validation/bench/BenchRecord.h"
#include "validation/bench/FolderLock.h"
#include "validation/bench/MeasureGroup.h"

namespace tessera::validation {

/// A run may be cut into so many shards.
inline constexpr int kMostShards = 10000;

/// What a run is. Points may be put beside each other only where all of this but the shard and the command is the same.
struct RunIdentity {
    std::string machine, renderer;
    std::string driver; ///< the version of OpenGL that it tells, and with it its own
    std::string commit;
    std::string settings; ///< the options of the frames
    std::string against;  ///< the requested truth of the errors
    int frames = 0;
    /// Which part of the groups is measured here: those whose number is shard - 1 modulo shards.
    int shard = 1, shards = 1;
    std::string command;
};

/// What becomes of an unfinished run that a folder holds when another is to begin there.
enum class EarlierRun : std::uint8_t {
    Keep,   ///< it stays, and the new one is refused
    Resume, ///< it goes on; refused where it is another run
    Replace ///< it goes
};

/// What is kept of a run in the folder `parts` of its output, so that it can be killed at any time, resumed, and merged
/// with its other shards: run.json says what the run is, group-NNN.json how far each group is, beside its pictures.
/// Files are written whole or not at all. The folder is locked as long as the store lives.
class BenchStore {
public:
    /// Begins a run in `folder`, which must exist: anew, or where it was left. Throws InputError when an unfinished run
    /// there is to stay; when the run to go on with is another one, saying in what, or of a scene that has changed
    /// since; and when files are damaged. Throws std::runtime_error when another process uses the folder, saying which,
    /// and when nothing can be written.
    BenchStore(const std::string& folder, const RunIdentity& identity, const BenchPlan& plan, EarlierRun earlier);

    const std::string& folder() const { return folder_; }
    /// Whether a group is measured here at all.
    bool isOfShard(std::size_t group) const;
    GroupState load(std::size_t group) const; ///< an empty state where nothing is kept
    void keep(std::size_t group, const GroupState& state) const;
    std::string keepPicture(std::size_t group, const std::string& name, const DisplayImage& image) const;

private:
    std::string folder_;
    FolderLock lock_;
    int shard_ = 1, shards_ = 1;
};

/// All that is kept in `folder`, in the order of the plan. Throws InputError where that is no run or damaged.
BenchRecord recordIn(const std::string& folder);

/// The bytes of a picture that is kept.
std::vector<std::uint8_t> keptPicture(const std::string& folder, const std::string& file);

} // namespace tessera::validation
