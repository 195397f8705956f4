#include "scenes/import/Files.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "base/Utf8.h"

namespace tessera::scenes {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
    std::error_code failure;
    return fs::is_regular_file(path, failure);
}

/// Removes and returns the first UTF-8 character of `text`; invalid bytes are read as Latin-1.
std::uint32_t takeCharacter(std::string_view& text) {
    const std::size_t size = std::max<std::size_t>(letterBytes(text), 1);
    const auto byteAt = [&](std::size_t i) -> std::uint32_t { return static_cast<unsigned char>(text[i]); };
    std::uint32_t character = size == 1 ? byteAt(0) : byteAt(0) & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) character = character << 6 | (byteAt(i) & 0x3fu);
    text.remove_prefix(size);
    return character;
}

/// Lower case of ASCII, Latin-1, Greek and Cyrillic letters, and of Latin Extended-A, whose cases alternate.
std::uint32_t lowered(std::uint32_t c) {
    const auto within = [c](std::uint32_t first, std::uint32_t last) { return c >= first && c <= last; };
    if (within('A', 'Z') || (within(0xc0, 0xde) && c != 0xd7) || within(0x391, 0x3a9) || within(0x410, 0x42f))
        return c + 0x20;
    if (within(0x400, 0x40f)) return c + 0x50;
    if (within(0x100, 0x137) || within(0x14a, 0x177)) return c | 1;
    return (within(0x139, 0x148) || within(0x179, 0x17e)) && c % 2 == 1 ? c + 1 : c;
}

/// Combining accents, vowels and final consonants of Hangul, and the voicing marks of kana.
bool isCombining(std::uint32_t c) {
    return (c >= 0x300 && c <= 0x36f) || (c >= 0x1160 && c <= 0x11ff) || c == 0x3099 || c == 0x309a;
}

std::u32string charactersOf(std::string_view text) {
    std::u32string characters;
    while (!text.empty()) characters.push_back(lowered(takeCharacter(text)));
    return characters;
}

/// The entry of a folder that matches `name` by isSameName(); of several the first in byte order.
std::optional<fs::path> entryLike(const fs::path& folder, const std::string& name) {
    std::optional<fs::path> found;
    std::error_code failure;
    constexpr std::size_t kMostBytes = 4 * 255; // no file system has longer names
    if (name.size() > kMostBytes) return std::nullopt;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        const fs::path own = entry->path().filename();
        if (isSameName(own.string(), name) && (!found || own < *found)) found = own;
    }
    return found;
}

std::optional<fs::path> fileLike(const fs::path& folder, const std::string& name) {
    fs::path path = fs::path(name).is_absolute() ? "/" : folder;
    std::error_code failure;
    for (const fs::path& part : fs::path(name).relative_path()) {
        if (part.empty() || fs::exists(path / part, failure)) {
            path /= part;
        } else if (const std::optional<fs::path> entry = entryLike(path, part.string())) {
            path /= *entry;
        } else {
            return std::nullopt;
        }
    }
    return isFile(path) ? std::optional(path) : std::nullopt;
}

} // namespace

std::vector<std::byte> readFileBytes(const std::filesystem::path& file, LoadLedger& ledger) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
        throw InputError(fmt::format("{}: there is no such file; check the name and the folder", file.string()));
    if (!std::filesystem::is_regular_file(status))
        throw InputError(fmt::format("{}: is not a regular file; name the file itself", file.string()));
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) throw InputError(fmt::format("{}: cannot be opened; check its permissions", file.string()));
    ledger.addFile(file);
    ledger.charge(size, [&] { return file.string(); });
    std::vector<std::byte> bytes(size);
    if (size > 0 && !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw InputError(
            fmt::format("{}: only {} of its {} bytes could be read", file.string(), stream.gcount(), size));
    return bytes;
}

bool isSameName(const std::string& a, const std::string& b) {
    const std::u32string left = charactersOf(a), right = charactersOf(b);
    std::size_t i = 0, j = 0;
    const auto skipMarks = [](const std::u32string& text, std::size_t& at) {
        const std::size_t start = at;
        while (at < text.size() && isCombining(text[at])) ++at;
        return at > start;
    };
    while (i < left.size() && j < right.size()) {
        const char32_t l = left[i++], r = right[j++];
        const bool isMarkedLeft = skipMarks(left, i), isMarkedRight = skipMarks(right, j);
        const bool isComposed =
            (isMarkedLeft && !isMarkedRight && r > 0x7f) || (isMarkedRight && !isMarkedLeft && l > 0x7f);
        if (isMarkedLeft == isMarkedRight ? l != r : !isComposed) return false;
    }
    return i == left.size() && j == right.size();
}

NamedFile fileNamed(const fs::path& folder, const std::string& name) {
    std::string plain = name;
    const bool isQuoted =
        plain.size() > 1 && (plain.front() == '"' || plain.front() == '\'') && plain.back() == plain.front();
    if (isQuoted) plain = plain.substr(1, plain.size() - 2);
    std::string slashed = plain;
    std::ranges::replace(slashed, '\\', '/');
    for (const std::string& spelling : {name, plain, slashed})
        if (isFile(folder / spelling)) return {folder / spelling};
    const std::string base = slashed.substr(0, slashed.find('?'));
    if (const std::optional<fs::path> found = fileLike(folder, base)) return {*found, true, false};
    const bool hasDrive = base.size() > 1 && std::isalpha(static_cast<unsigned char>(base[0])) != 0 && base[1] == ':';
    if (hasDrive || base.starts_with('/'))
        if (const std::optional<fs::path> found = fileLike(folder, base.substr(base.rfind('/') + 1)))
            return {*found, true, false};
    return {folder / name, false};
}

} // namespace tessera::scenes
