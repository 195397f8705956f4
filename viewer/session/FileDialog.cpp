#include "viewer/session/FileDialog.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Utf8.h"
#include "scenes/Load.h"
#include "viewer/session/FileTypes.h"

namespace tessera::viewer {
namespace {

using Path = std::filesystem::path;

constexpr const char* kAbove = "..";

bool isSeparator(char c) {
    return c == '/' || c == char(Path::preferred_separator);
}

/// Length of a text up to and including its last separator.
std::size_t folderPart(const std::string& text) {
    std::size_t end = text.size();
    while (end > 0 && !isSeparator(text[end - 1])) --end;
    return end;
}

/// Converts A to Z to lower case. Other letters stay distinct, as in file systems.
std::string folded(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

bool beginsWith(const std::string& name, const std::string& begin) {
    return folded(name).starts_with(folded(begin));
}

bool isOffered(const Path& file, FileDialog::Purpose purpose) {
    const FileType* const type = fileTypeOf(file);
    if (type == nullptr) return false;
    return purpose == FileDialog::Purpose::Open ? type->opens != FileType::Opens::Nothing
                                                : type->saves != FileType::Saves::Nothing;
}

bool isFolderAt(const Path& place) {
    std::error_code error;
    return std::filesystem::is_directory(place, error);
}

bool isThere(const Path& place) {
    std::error_code error;
    return std::filesystem::exists(std::filesystem::symlink_status(place, error));
}

/// An absolute path without ".", ".." and a trailing separator.
Path tidy(const Path& folder) {
    std::error_code error;
    Path tidied = std::filesystem::absolute(folder, error).lexically_normal();
    if (error) return folder;
    if (!tidied.has_filename() && tidied.has_relative_path()) tidied = tidied.parent_path();
    return tidied;
}

std::string savedEndings() {
    std::vector<std::string_view> endings;
    for (const FileType& type : fileTypes())
        if (type.saves != FileType::Saves::Nothing) endings.push_back(type.extension);
    return fmt::format("{}", fmt::join(endings, ", "));
}

/// Entries whose names begin with `begin`, without hidden files if it is empty. Throws filesystem_error. A folder may
/// hold a hundred thousand files, and is read at every typed letter.
std::vector<FileEntry> entriesOf(const Path& folder, const std::string& begin, FileDialog::Purpose purpose) {
    struct Found {
        FileEntry entry;
        std::string folded;
    };
    std::vector<Found> all;
    for (const std::filesystem::directory_entry& found : std::filesystem::directory_iterator(folder)) {
        std::string name = found.path().filename().string();
        if (!beginsWith(name, begin) || (name.starts_with('.') && begin.empty())) continue;
        std::error_code error;
        const bool isFolder = found.is_directory(error); // no further system call, except for links
        if (!isFolder && !isOffered(found.path(), purpose)) continue;
        std::string small = folded(name);
        all.push_back({{std::move(name), isFolder}, std::move(small)});
    }
    std::ranges::sort(all, [](const Found& a, const Found& b) {
        return std::tuple(!a.entry.isFolder, std::string_view(a.folded), std::string_view(a.entry.name)) <
               std::tuple(!b.entry.isFolder, std::string_view(b.folded), std::string_view(b.entry.name));
    });
    std::vector<FileEntry> entries;
    entries.reserve(all.size());
    for (Found& found : all) entries.push_back(std::move(found.entry));
    return entries;
}

} // namespace

FileDialog::FileDialog(Purpose purpose, const Path& folder, std::string text, std::string reason)
    : purpose_(purpose), folder_(tidy(folder)), text_(std::move(text)), reason_(std::move(reason)) {
    list();
    const auto isAbove = [](const FileEntry& entry) { return entry.name == kAbove; };
    if (text_.empty() && fault_.empty() && std::ranges::all_of(entries_, isAbove)) showBuiltin();
}

Path FileDialog::resolved(const std::string& text) const {
    if (text.empty()) return folder_;
    const bool isFromHome = text[0] == '~' && (text.size() == 1 || isSeparator(text[1]));
    if (const auto home = homeFolder(); isFromHome && home)
        return tidy(*home / text.substr(std::min<std::size_t>(2, text.size())));
    return tidy(folder_ / text);
}

void FileDialog::list() {
    entries_.clear();
    chosen_.reset();
    isMoved_ = true;
    isChosenByHand_ = confirmsReplacing_ = false;
    fault_.clear();
    const std::size_t nameBegin = folderPart(text_);
    const std::string begin = purpose_ == Purpose::Open ? text_.substr(nameBegin) : std::string();
    if (isBuiltin_ && nameBegin == 0) {
        listed_.reset();
        for (const scenes::BuiltinScene& builtin : scenes::builtinScenes())
            if (beginsWith(std::string(builtin.name), begin))
                entries_.push_back({std::string(builtin.name), false, std::string(builtin.purpose)});
    } else {
        listed_ = resolved(text_.substr(0, nameBegin));
        if (begin.empty() && listed_->has_relative_path()) entries_.push_back({kAbove, true});
        try {
            for (FileEntry& entry : entriesOf(*listed_, begin, purpose_)) entries_.push_back(std::move(entry));
        } catch (const std::filesystem::filesystem_error& error) {
            fault_ = fmt::format("{} cannot be read: {}", listed_->string(), error.code().message());
        }
    }
    if (!begin.empty() && !entries_.empty()) chosen_ = 0;
}

void FileDialog::type(const std::string& text) {
    if (text == text_) return;
    text_ = text;
    list();
}

void FileDialog::step(int lines) {
    if (entries_.empty()) return;
    const int count = int(entries_.size());
    // In a typed folder, the first step skips "..".
    const bool skipsAbove = purpose_ == Purpose::Open && !text_.empty() && count > 1 && entries_.front().name == kAbove;
    const int from = chosen_ ? int(*chosen_) : lines < 0 ? count : skipsAbove ? 0 : -1;
    choose(std::size_t(std::clamp(from + lines, 0, count - 1)));
    isMoved_ = true;
}

void FileDialog::choose(std::size_t entry) {
    if (entry >= entries_.size()) return;
    chosen_ = entry;
    isChosenByHand_ = true;
    confirmsReplacing_ = false;
}

void FileDialog::complete() {
    const std::string begin = text_.substr(folderPart(text_));
    std::optional<std::string> common;
    bool isFolder = false;
    for (const FileEntry& entry : entries_) {
        if (entry.name == kAbove || !beginsWith(entry.name, begin)) continue;
        isFolder = !common && entry.isFolder; // only if a single name matches
        if (!common) common = entry.name;
        const std::string one = folded(*common), other = folded(entry.name);
        const auto ends = std::ranges::mismatch(one, other);
        common->resize(std::size_t(ends.in1 - one.begin()));
        while (!common->empty() && beginningOf(entry.name, common->size()).size() != common->size()) common->pop_back();
    }
    if (!common || common->size() < begin.size()) return;
    type(text_.substr(0, folderPart(text_)) + *common + (isFolder ? "/" : ""));
}

void FileDialog::goTo(const Path& folder) {
    enter(tidy(folder));
}

void FileDialog::enter(const Path& folder) {
    folder_ = folder;
    isBuiltin_ = false;
    text_ = purpose_ == Purpose::Save ? text_.substr(folderPart(text_)) : std::string();
    list();
}

void FileDialog::showBuiltin() {
    if (purpose_ != Purpose::Open) return;
    isBuiltin_ = true;
    text_.clear();
    list();
}

std::optional<std::string> FileDialog::accept(bool replaces) {
    const bool namesEntry = chosen_ && (isChosenByHand_ || !listed_ || !isThere(resolved(text_)));
    if (!namesEntry || (purpose_ == Purpose::Save && !isChosenByHand_)) return acceptText(replaces);
    const FileEntry entry = entries_[*chosen_];
    if (!listed_) return entry.name;
    const Path place = entry.name == kAbove ? listed_->parent_path() : *listed_ / entry.name;
    if (entry.isFolder) {
        enter(place);
        return std::nullopt;
    }
    if (purpose_ == Purpose::Open) return place.string();
    // The name of an existing file: replacing it still has to be confirmed.
    type(text_.substr(0, folderPart(text_)) + entry.name);
    isChosenByHand_ = false;
    return acceptText(replaces);
}

std::optional<std::string> FileDialog::acceptText(bool replaces) {
    if (text_.empty()) return std::nullopt;
    const Path place = resolved(text_);
    if (isFolderAt(place)) {
        text_.clear();
        enter(place);
        return std::nullopt;
    }
    if (purpose_ == Purpose::Save) return acceptName(replaces);
    if (scenes::builtinScene(text_) != nullptr) return text_;
    if (!isThere(place))
        fault_ = fmt::format("{} is not there", place.string());
    else if (!isOffered(place, purpose_))
        fault_ = fmt::format("{} is no file that can be opened", place.string());
    else
        return place.string();
    return std::nullopt;
}

std::optional<std::string> FileDialog::acceptName(bool replaces) {
    const Path place = resolved(text_);
    fault_.clear();
    confirmsReplacing_ = false;
    if (!isOffered(place, purpose_)) {
        fault_ = fmt::format("A name ends in one of {}", savedEndings());
    } else if (!isFolderAt(place.parent_path())) {
        fault_ = fmt::format("{} is no folder", place.parent_path().string());
    } else if (isThere(place) && !replaces) {
        confirmsReplacing_ = true;
        fault_ = fmt::format("{} is there already", place.filename().string());
    } else {
        return place.string();
    }
    return std::nullopt;
}

std::optional<Path> homeFolder() {
#if defined(_WIN32)
    const char* const value = std::getenv("USERPROFILE");
#else
    const char* const value = std::getenv("HOME");
#endif
    if (value == nullptr || !Path(value).is_absolute()) return std::nullopt;
    return Path(value);
}

std::vector<std::string> foldersOf(std::span<const std::string> files) {
    std::vector<std::string> folders;
    for (const std::string& file : files) {
        const std::string folder = Path(file).parent_path().string();
        if (!folder.empty() && std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
    }
    return folders;
}

} // namespace tessera::viewer
