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

/// Makes the bytes of a picture's file, of a path that messages name.
using MakePicture =
    std::function<std::vector<std::uint8_t>(const std::string& path, const frame::FrameSettings& settings)>;

/// What a sequence of pictures is, as the command line says it.
struct FrameSequenceOptions {
    std::string pattern;
    FrameRange range;
    double framesPerSecond = 30.0; ///< of scene time
    Shard shard;
    bool repeatsClip = false; ///< time begins again at the end of the clip that plays
};

/// Pictures in numbered files: frame k shows the time of the request + k / framesPerSecond seconds, less whole lengths
/// of the clip that plays where that is repeated. A shard has every Nth. Frames that are finished already, by an
/// earlier run of the same request, are not made again.
class FrameSequence {
public:
    /// Throws InputError for a pattern without one place for a number.
    explicit FrameSequence(const FrameSequenceOptions& options);

    /// The length of the clip that plays, 0 where none has any. To be called before all that looks at times.
    void takeClip(double lengthSeconds) { clipSeconds_ = lengthSeconds; }
    /// "frames 31 to 89 lie behind the clip's end at 1.04 s, ..." of the whole range; empty where there are none, or
    /// the clip is repeated.
    std::string framesBehindClip(const frame::FrameSettings& settings) const;

    /// The files that are written here: the shard's frames and its journal.
    std::vector<std::string> outputs() const;
    /// Throws std::runtime_error where they cannot be.
    void requireWritable() const;

    /// Finds the frames that are finished, to be called before draw(). `maker` says what pictures depend on besides the
    /// request and its scene: the program, the renderer. Throws InputError where a frame's time is not finite.
    void leaveOutFinished(const engine::ViewRequest& request, const scenes::Scene& scene, const std::string& maker);
    /// How many are to be made.
    std::size_t unfinished() const { return unfinished_.size(); }
    /// Makes and writes them, in the order of their numbers. Throws what `make` does, and std::runtime_error where a
    /// file cannot be written.
    void draw(const Outputs& outputs, const frame::FrameSettings& settings, const MakePicture& make);

    /// "90 frames: 60 drawn, 30 skipped (finished already), median 12.3 ms"
    std::string summary() const;

private:
    double secondsOf(int frame, const frame::FrameSettings& settings) const;
    std::uint64_t settingsOf(double timeSeconds) const;

    FrameSequenceOptions options_;
    FramePattern pattern_;
    double clipSeconds_ = 0.0; ///< 0: no clip plays, or only poses do
    std::vector<int> frames_, unfinished_;
    std::string depends_; ///< on what a picture does besides its time, as text
    std::optional<FrameJournal> journal_;
    std::vector<double> ms_; ///< by frame that was made
};

} // namespace tessera::app
