#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/FrameJournal.h"
#include "apps/FramePattern.h"
#include "apps/FrameRange.h"
#include "apps/Outputs.h"
#include "apps/Shard.h"
#include "engine/Settings.h"

namespace tessera::app {

/// Renders and encodes an image file; messages name `path`.
using MakePicture =
    std::function<std::vector<std::uint8_t>(const std::string& path, const frame::FrameSettings& settings)>;

/// Options of an image sequence, as given on the command line.
struct FrameSequenceOptions {
    std::string pattern;
    FrameRange range;
    double framesPerSecond = 30.0; ///< of scene time
    Shard shard;
    bool repeatsClip = false; ///< time wraps at the end of the active clip
};

/// Images in numbered files. Frame k shows the request's time + k / framesPerSecond seconds, modulo the length of the
/// active clip if that repeats. A shard has every Nth frame. Frames finished by an earlier run of the same request are
/// skipped.
class FrameSequence {
public:
    /// Throws InputError for a pattern without exactly one frame-number placeholder.
    explicit FrameSequence(const FrameSequenceOptions& options);

    /// Sets the length of the active clip; 0: none plays, or only poses. Call before any function that uses times.
    void takeClip(double lengthSeconds) { clipSeconds_ = lengthSeconds; }
    /// "frames 31 to 89 lie behind the clip's end at 1.04 s, ..." for the whole range; empty if none do, or the clip
    /// repeats.
    std::string framesBehindClip(const frame::FrameSettings& settings) const;

    /// The files that draw() writes: the shard's frames and its journal.
    std::vector<std::string> outputs() const;
    /// Throws std::runtime_error if the outputs cannot be written.
    void requireWritable() const;

    /// Skips finished frames; call before draw(). `maker` identifies the other inputs of images besides the request and
    /// its scene: the program and the renderer. Throws InputError if a frame's time is not finite.
    void leaveOutFinished(const engine::ViewRequest& request, const scenes::Scene& scene, const std::string& maker);
    /// Number of frames to draw.
    std::size_t unfinished() const { return unfinished_.size(); }
    /// Draws and writes the unfinished frames in ascending order. Throws what `make` throws, and std::runtime_error if
    /// a file cannot be written.
    void draw(const Outputs& outputs, const frame::FrameSettings& settings, const MakePicture& make);

    /// "90 frames: 60 drawn, 30 skipped (finished already), median 12.3 ms"
    std::string summary() const;

private:
    double secondsOf(int frame, const frame::FrameSettings& settings) const;
    std::uint64_t settingsOf(double timeSeconds) const;

    FrameSequenceOptions options_;
    FramePattern pattern_;
    double clipSeconds_ = 0.0; ///< 0: no clip plays, or only poses
    std::vector<int> frames_, unfinished_;
    std::string depends_; ///< all inputs of an image except its time, as text
    std::optional<FrameJournal> journal_;
    std::vector<double> ms_; ///< per drawn frame
};

} // namespace tessera::app
