#include "apps/FrameSequence.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Median.h"
#include "base/Milliseconds.h"
#include "scenes/Fingerprint.h"

namespace tessera::app {

FrameSequence::FrameSequence(const FrameSequenceOptions& options) : options_(options), pattern_(options.pattern) {
    for (std::size_t place = 0; place < options.range.count(); ++place)
        if (options.shard.has(place)) frames_.push_back(options.range.frame(place));
    unfinished_ = frames_;
}

std::vector<std::string> FrameSequence::outputs() const {
    std::vector<std::string> files{FrameJournal::fileOf(pattern_, options_.shard)};
    for (const int frame : frames_) files.push_back(pattern_.path(frame));
    return files;
}

void FrameSequence::requireWritable() const {
    if (!frames_.empty()) { // the others are in the same folder, with names no longer than the last
        tessera::requireWritable(pattern_.path(frames_.front()));
        tessera::requireWritable(pattern_.path(frames_.back()));
    }
    FrameJournal::requireWritable(pattern_, options_.shard);
}

double FrameSequence::secondsOf(int frame, const frame::FrameSettings& settings) const {
    const double seconds = settings.timeSeconds + frame / options_.framesPerSecond;
    const bool isOver = options_.repeatsClip && clipSeconds_ > 0.0 && seconds >= clipSeconds_;
    return isOver ? std::fmod(seconds, clipSeconds_) : seconds; // as the viewer plays it
}

std::string FrameSequence::framesBehindClip(const frame::FrameSettings& settings) const {
    const FrameRange& range = options_.range;
    const int last = range.frame(range.count() - 1);
    if (options_.repeatsClip || !(clipSeconds_ > 0.0) || !(secondsOf(last, settings) > clipSeconds_)) return {};
    std::size_t place = 0;
    while (!(secondsOf(range.frame(place), settings) > clipSeconds_)) ++place;
    const int first = range.frame(place);
    const std::string frames =
        first == last ? fmt::format("frame {} lies", last) : fmt::format("frames {} to {} lie", first, last);
    return fmt::format("{} behind the clip's end at {:.3g} s, where it stands still; --loop begins it again", frames,
                       clipSeconds_);
}

/// Hash of all inputs of an image. Equal times have equal text.
std::uint64_t FrameSequence::settingsOf(double timeSeconds) const {
    const std::string text = fmt::format("{}time {}", depends_, timeSeconds);
    return scenes::fingerprint(std::as_bytes(std::span(text)));
}

void FrameSequence::leaveOutFinished(const engine::ViewRequest& request, const scenes::Scene& scene,
                                     const std::string& maker) {
    for (const int frame : frames_)
        if (!std::isfinite(secondsOf(frame, request.settings)))
            throw InputError(fmt::format("frame {} has no finite time at {} frames a second; give more with --fps",
                                         frame, options_.framesPerSecond));
    depends_ = fmt::format("{}\n{:016x}\n", maker, scenes::fingerprint(scene));
    for (const engine::Setting& setting : engine::settingTable())
        if (setting.key != "time") depends_ += fmt::format("{} {}\n", setting.key, setting.text(request, &scene));
    journal_.emplace(pattern_, options_.shard);
    std::erase_if(unfinished_, [&](int frame) {
        return journal_->isFinished(pattern_.path(frame), settingsOf(secondsOf(frame, request.settings)));
    });
}

void FrameSequence::draw(const Outputs& outputs, const frame::FrameSettings& settings, const MakePicture& make) {
    using Clock = std::chrono::steady_clock;
    frame::FrameSettings one = settings;
    outputs.at(FrameJournal::fileOf(pattern_, options_.shard));
    for (const int frame : unfinished_) {
        const Clock::time_point start = Clock::now();
        const std::string path = outputs.at(pattern_.path(frame));
        one.timeSeconds = secondsOf(frame, settings);
        const std::vector<std::uint8_t> bytes = make(path, one);
        writeFileAtomically(path, bytes);
        journal_.value().add(path, settingsOf(one.timeSeconds), bytes);
        ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
}

std::string FrameSequence::summary() const {
    std::string text = fmt::format("{} frame{}: {} drawn, {} skipped", frames_.size(), frames_.size() == 1 ? "" : "s",
                                   ms_.size(), frames_.size() - ms_.size());
    if (ms_.size() < frames_.size()) text += " (finished already)";
    if (!ms_.empty()) text += fmt::format(", median {} ms", millisecondsText(medianOf(ms_)));
    return text;
}

} // namespace tessera::app
