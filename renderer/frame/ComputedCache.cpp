#include "renderer/frame/ComputedCache.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Sha256.h"
#include "renderer/frame/LobeTable.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/lobe_table.h"

namespace tessera::frame {

namespace {

/// Hash of the sources of filterEnvironment() and makeLobeTable(): renderer/CMakeLists.txt lists them.
constexpr std::string_view kSources = TESSERA_COMPUTED_VERSION;
/// Maximum number of files in the folder; each map and each version of the program has its own.
constexpr std::size_t kMostFiles = 32;

/// Memory blocks stored one after the other in a file, after its header.
using Parts = std::vector<std::span<std::byte>>;

/// The header of a file.
struct Head {
    Sha256Digest key, content; ///< hash of all inputs; hash of the key and the parts
    bool operator==(const Head&) const = default;
};

Head headOf(const Sha256Digest& key, const Parts& parts) {
    Sha256 hash;
    hash.add(key);
    for (const std::span<std::byte>& part : parts) hash.add(part);
    return {key, hash.digest()};
}

/// Adds an integer to a key in a fixed byte order, independent of the machine.
void add(Sha256& hash, std::uint64_t number) {
    std::array<std::byte, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = std::byte(number >> (8 * i) & 0xff);
    hash.add(bytes);
}

/// Sets the modification time by the precise clock: a file system's clock may advance in steps of milliseconds.
void noteUse(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
}

/// Reads the parts. Returns false if the file is missing, altered, too short or too long.
bool read(const std::filesystem::path& file, const Sha256Digest& key, const Parts& parts) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false; // opening a pipe would block
    std::ifstream in(file, std::ios::binary);
    Head found{};
    if (!in.read(reinterpret_cast<char*>(&found), sizeof(found)) || found.key != key) return false;
    for (const std::span<std::byte>& part : parts)
        if (!in.read(reinterpret_cast<char*>(part.data()), std::streamsize(part.size()))) return false;
    if (in.peek() != std::ifstream::traits_type::eof() || found != headOf(key, parts)) return false;
    noteUse(file);
    return true;
}

/// The first write failure until it is taken; later ones are ignored.
struct CacheFault {
    std::mutex mutex;
    std::string text;
    bool isNoted = false;
};
CacheFault& cacheFault() {
    static CacheFault fault;
    return fault;
}

void noteFault(const std::filesystem::path& file, const std::string& reason) {
    CacheFault& fault = cacheFault();
    const std::lock_guard lock(fault.mutex);
    if (std::exchange(fault.isNoted, true)) return;
    // Drops the advice after "; ": it applies to files named by the user, not to cache files.
    fault.text = fmt::format("{} cannot be kept, so that it is computed anew each time: {}; make its folder writable, "
                             "or name another with XDG_CACHE_HOME",
                             file.string(), reason.substr(0, reason.find("; ")));
}

/// Removes the least recently used cache files beyond kMostFiles.
void removeOldest(const std::filesystem::path& folder) {
    std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".bin") || !(name.starts_with("environment-") || name.starts_with("lobes-"))) continue;
        const auto time = entry.last_write_time(error);
        if (!error) files.emplace_back(time, entry.path());
    }
    std::ranges::sort(files, std::greater());
    for (std::size_t i = kMostFiles; i < files.size(); ++i) std::filesystem::remove(files[i].second, error);
}

void write(const std::filesystem::path& file, const Sha256Digest& key, const Parts& parts) {
    const Head head = headOf(key, parts);
    std::string bytes(reinterpret_cast<const char*>(&head), sizeof(head));
    for (const std::span<std::byte>& part : parts)
        bytes.append(reinterpret_cast<const char*>(part.data()), part.size());
    try {
        std::filesystem::create_directories(file.parent_path());
        // Opening a pipe would block, and a link leads to a file outside the cache.
        const std::filesystem::file_status status = std::filesystem::symlink_status(file);
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
            !std::filesystem::is_directory(status))
            std::filesystem::remove(file);
        writeFileAtomically(file.string(), bytes);
        noteUse(file);
        removeOldest(file.parent_path());
    } catch (const std::filesystem::filesystem_error& error) { // the result is recomputed next time
        noteFault(file, error.code().message());
    } catch (const std::exception& error) {
        noteFault(file, error.what());
    }
}

/// Hash of the texels and of all other inputs of filterEnvironment().
Sha256Digest keyOf(const scenes::Image& map) {
    Sha256 hash;
    hash.add(std::as_bytes(std::span(kSources)));
    for (const std::uint64_t number :
         {std::uint64_t(map.width), std::uint64_t(map.height), std::uint64_t(map.texels.size())})
        add(hash, number);
    hash.add(map.texels);
    return hash.digest();
}

Sha256Digest lobeKey() {
    Sha256 hash;
    hash.add(std::as_bytes(std::span(kSources)));
    return hash.digest();
}

/// Allocates the filtered result of a map.
FilteredEnvironment emptyFor(const scenes::Image& map) {
    const auto shape = [](int side) {
        return DividedOctahedron{side, std::vector<glm::vec3>(std::size_t((side + 1) * (side + 1)))};
    };
    const int halvings = filteredHalvingsOf(map);
    FilteredEnvironment empty;
    for (int level = 0; level < ENVIRONMENT_LEVELS; ++level)
        empty.levels.push_back(shape(shared::filteredSide(halvings, level)));
    empty.irradiance = shape(ENVIRONMENT_IRRADIANCE_SIDE);
    return empty;
}

Parts partsOf(FilteredEnvironment& filtered) {
    Parts parts;
    for (DividedOctahedron& level : filtered.levels) parts.push_back(std::as_writable_bytes(std::span(level.corners)));
    parts.push_back(std::as_writable_bytes(std::span(filtered.irradiance.corners)));
    return parts;
}

} // namespace

std::optional<std::filesystem::path> cacheFolder() {
    // Relative paths are ignored. Source: XDG Base Directory Specification.
    if (const char* folder = std::getenv("XDG_CACHE_HOME");
        folder != nullptr && std::filesystem::path(folder).is_absolute())
        return std::filesystem::path(folder) / "tessera";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".cache" / "tessera";
    return {};
}

std::string takeCacheFault() {
    CacheFault& fault = cacheFault();
    const std::lock_guard lock(fault.mutex);
    return std::exchange(fault.text, {});
}

FilteredEnvironment cachedEnvironment(const scenes::Image& map, const std::optional<std::filesystem::path>& folder,
                                      const std::function<void(double)>& progress) {
    if (!folder) return filterEnvironment(map, progress);
    const Sha256Digest key = keyOf(map);
    const std::filesystem::path file = *folder / fmt::format("environment-{}.bin", hexadecimal(key));
    FilteredEnvironment result = emptyFor(map);
    if (read(file, key, partsOf(result))) return result;
    result = filterEnvironment(map, progress);
    write(file, key, partsOf(result));
    return result;
}

std::vector<glm::vec4> cachedLobeTable(const std::optional<std::filesystem::path>& folder) {
    if (!folder) return makeLobeTable();
    const Sha256Digest key = lobeKey();
    const std::filesystem::path file = *folder / fmt::format("lobes-{}.bin", hexadecimal(key));
    std::vector<glm::vec4> table(std::size_t(LOBE_TABLE_SIDE) * LOBE_TABLE_SIDE * LOBE_TABLE_LAYERS);
    if (read(file, key, {std::as_writable_bytes(std::span(table))})) return table;
    table = makeLobeTable();
    write(file, key, {std::as_writable_bytes(std::span(table))});
    return table;
}

} // namespace tessera::frame
