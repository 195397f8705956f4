#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <string>

#include "apps/FramePattern.h"
#include "apps/Shard.h"

namespace tessera::app {

/// Which frames of a sequence are finished, and of which settings: a text file beside them, to which a line is appended
/// when a frame's file is whole. A line holds a number for all that the picture depends on, one for the file's bytes,
/// and the file's name. So a run may be killed at any time, and a file that was cut off, changed or replaced since is
/// no finished frame. A shard appends to a file of its own and reads those of the others.
class FrameJournal {
public:
    /// Reads what the journals of these frames hold. Throws InputError where one cannot be read.
    FrameJournal(const FramePattern& pattern, const Shard& shard);

    /// Where the journal of a shard is: for f_%04d.png f_frames.png.txt, of shard 2/4 f_frames.png.2of4.txt.
    static std::string fileOf(const FramePattern& pattern, const Shard& shard);

    /// Throws what add() would throw for the place alone, before the work is done in vain.
    static void requireWritable(const FramePattern& pattern, const Shard& shard);

    /// Whether the file of that path is there as these settings made it.
    bool isFinished(const std::string& path, std::uint64_t settings) const;
    /// To be called when the file is written. Throws std::runtime_error where the journal cannot be.
    void add(const std::string& path, std::uint64_t settings, std::span<const std::uint8_t> bytes);

private:
    std::string file_;
    std::set<std::string> lines_;
    bool endsWithinLine_ = false; ///< the last line of the shard's own file was cut off
};

} // namespace tessera::app
