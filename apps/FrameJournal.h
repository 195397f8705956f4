#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <string>

#include "apps/FramePattern.h"
#include "apps/Shard.h"

namespace tessera::app {

/// Journal of the finished frames of a sequence: a text file beside them, with one line per completely written frame. A
/// line holds a hash of all inputs of the image, a hash of the file's bytes, and the file's name. A run may therefore
/// be killed at any time, and truncated, changed or replaced files do not count as finished. A shard appends to its own
/// journal and reads those of the others.
class FrameJournal {
public:
    /// Reads all journals of these frames. Throws InputError if one cannot be read.
    FrameJournal(const FramePattern& pattern, const Shard& shard);

    /// Path of a shard's journal: f_frames.png.txt for f_%04d.png, f_frames.png.2of4.txt for its shard 2/4.
    static std::string fileOf(const FramePattern& pattern, const Shard& shard);

    /// Throws early if the journal cannot be written.
    static void requireWritable(const FramePattern& pattern, const Shard& shard);

    /// Whether the file exists, unchanged since it was written with these settings.
    bool isFinished(const std::string& path, std::uint64_t settings) const;
    /// Records a written file. Throws std::runtime_error if the journal cannot be written.
    void add(const std::string& path, std::uint64_t settings, std::span<const std::uint8_t> bytes);

private:
    std::string file_;
    std::set<std::string> lines_;
    bool endsWithinLine_ = false; ///< the last line of the shard's journal was cut off
};

} // namespace tessera::app
