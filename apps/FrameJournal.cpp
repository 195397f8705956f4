#include "apps/FrameJournal.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "scenes/Fingerprint.h"
#include "scenes/import/Files.h"

namespace tessera::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kJournalEnd = ".txt";

std::string stemOf(const FramePattern& pattern) {
    return pattern.pathWith("frames");
}

std::string beginningOfLine(std::uint64_t settings) {
    return fmt::format("{:016x} ", settings);
}

std::string lineOf(const std::string& path, std::uint64_t settings, std::span<const std::byte> bytes) {
    return beginningOfLine(settings) +
           fmt::format("{:016x} {}", scenes::fingerprint(bytes), fs::path(path).filename().string());
}

std::string contentsOf(const fs::path& file) {
    scenes::LoadLedger ledger;
    const std::vector<std::byte> bytes = scenes::readFileBytes(file, ledger);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void requireRegular(const std::string& file) {
    std::error_code unknown;
    const fs::file_status status = fs::status(file, unknown);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw InputError(fmt::format("{}: is no file that can record which frames are finished; take it away or render "
                                     "to another name",
                                     file));
}

} // namespace

void FrameJournal::requireWritable(const FramePattern& pattern, const Shard& shard) {
    const std::string file = fileOf(pattern, shard);
    tessera::requireWritable(file);
    requireRegular(file);
}

std::string FrameJournal::fileOf(const FramePattern& pattern, const Shard& shard) {
    const std::string which = shard.count > 1 ? fmt::format(".{}of{}", shard.index, shard.count) : "";
    return stemOf(pattern) + which + kJournalEnd;
}

FrameJournal::FrameJournal(const FramePattern& pattern, const Shard& shard) : file_(fileOf(pattern, shard)) {
    const fs::path stem = stemOf(pattern);
    const std::string own = fs::path(file_).filename().string(), begin = stem.filename().string();
    const fs::path folder = stem.has_parent_path() ? stem.parent_path() : fs::path(".");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(begin + ".") || !name.ends_with(kJournalEnd) || !entry.is_regular_file()) continue;
        const std::string text = contentsOf(entry.path());
        if (name == own) endsWithinLine_ = !text.empty() && text.back() != '\n';
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) lines_.insert(line);
    }
}

bool FrameJournal::isFinished(const std::string& path, std::uint64_t settings) const {
    // Reads the file only if a line has these settings.
    const auto near = lines_.lower_bound(beginningOfLine(settings));
    if (near == lines_.end() || !near->starts_with(beginningOfLine(settings))) return false;
    try {
        scenes::LoadLedger ledger;
        return lines_.contains(lineOf(path, settings, scenes::readFileBytes(path, ledger)));
    } catch (const InputError&) { // missing, or not a regular file
        return false;
    }
}

void FrameJournal::add(const std::string& path, std::uint64_t settings, std::span<const std::uint8_t> bytes) {
    const std::string line = lineOf(path, settings, std::as_bytes(bytes));
    const std::string text = (endsWithinLine_ ? "\n" : "") + line + "\n";
    requireRegular(file_);
    std::FILE* const file = std::fopen(file_.c_str(), "ab");
    bool good = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    good = good && std::fflush(file) == 0;
    int error = errno;
    if (file != nullptr && std::fclose(file) != 0 && good) {
        good = false;
        error = errno;
    }
    if (!good)
        throw std::runtime_error(fmt::format("cannot write {}: {}; free some space or name another place", file_,
                                             std::generic_category().message(error)));
    endsWithinLine_ = false;
    lines_.insert(line);
}

} // namespace tessera::app
