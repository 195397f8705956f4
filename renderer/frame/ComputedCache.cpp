#include "renderer/frame/ComputedCache.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "renderer/frame/LobeTable.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/lobe_table.h"

namespace tessera::frame {

namespace {

/// Change with what filterEnvironment() and makeLobeTable() compute.
constexpr std::uint64_t kEnvironmentVersion = 10, kLobeVersion = 6;

/// Of words and bytes; another one in the place of any single word gives another hash for sure.
class WordHash {
public:
    explicit WordHash(std::uint64_t start) : value_(start) {}
    void add(std::uint64_t word) {
        value_ = (value_ ^ word) * 0xff51afd7ed558ccdu;
        value_ ^= value_ >> 32;
    }
    void add(std::span<const std::byte> bytes) {
        for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), sizeof(std::uint64_t)))) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data(), std::min(bytes.size(), sizeof(word)));
            add(word);
        }
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_;
};

/// Parts of memory that lie in a file one after the other, behind its key and their hash.
using Parts = std::vector<std::span<std::byte>>;

std::uint64_t hashOf(std::uint64_t key, const Parts& parts) {
    WordHash hash(key);
    for (const std::span<std::byte>& part : parts) hash.add(part);
    return hash.value();
}

/// Whether all was there as it was written, and nothing else.
bool read(const std::filesystem::path& file, std::uint64_t key, const Parts& parts) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false; // a pipe would wait for its other end
    std::ifstream in(file, std::ios::binary);
    std::uint64_t found[2] = {};
    if (!in.read(reinterpret_cast<char*>(found), sizeof(found)) || found[0] != key) return false;
    for (const std::span<std::byte>& part : parts)
        if (!in.read(reinterpret_cast<char*>(part.data()), std::streamsize(part.size()))) return false;
    return in.peek() == std::ifstream::traits_type::eof() && found[1] == hashOf(key, parts);
}

/// The first fault, until it is taken; none is noted after it.
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
    // What to do about a file that somebody named does not help with one that nobody did.
    fault.text = fmt::format("{} cannot be kept, so that it is computed anew each time: {}; make its folder writable, "
                             "or name another with XDG_CACHE_HOME",
                             file.string(), reason.substr(0, reason.find("; ")));
}

void write(const std::filesystem::path& file, std::uint64_t key, const Parts& parts) {
    const std::uint64_t head[] = {key, hashOf(key, parts)};
    std::string bytes(reinterpret_cast<const char*>(head), sizeof(head));
    for (const std::span<std::byte>& part : parts)
        bytes.append(reinterpret_cast<const char*>(part.data()), part.size());
    try {
        std::filesystem::create_directories(file.parent_path());
        // A pipe would wait for its other end, and a link leads to a file that is not the cache's.
        const std::filesystem::file_status status = std::filesystem::symlink_status(file);
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
            !std::filesystem::is_directory(status))
            std::filesystem::remove(file);
        writeFileAtomically(file.string(), bytes);
    } catch (const std::filesystem::filesystem_error& error) { // it is computed anew next time
        noteFault(file, error.code().message());
    } catch (const std::exception& error) {
        noteFault(file, error.what());
    }
}

std::uint64_t keyOf(const scenes::Image& map) {
    WordHash hash(0x9e3779b97f4a7c15u ^ kEnvironmentVersion);
    hash.add(std::uint64_t(map.width));
    hash.add(std::uint64_t(map.height));
    hash.add(map.texels);
    return hash.value();
}

/// Room for what a map is filtered to.
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
    // A relative one is to be ignored. Source: XDG Base Directory Specification.
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
    const std::uint64_t key = keyOf(map);
    const std::filesystem::path file = *folder / fmt::format("environment-{:016x}.bin", key);
    FilteredEnvironment result = emptyFor(map);
    if (read(file, key, partsOf(result))) return result;
    result = filterEnvironment(map, progress);
    write(file, key, partsOf(result));
    return result;
}

std::vector<glm::vec4> cachedLobeTable(const std::optional<std::filesystem::path>& folder) {
    if (!folder) return makeLobeTable();
    const std::filesystem::path file = *folder / fmt::format("lobes-{}.bin", kLobeVersion);
    std::vector<glm::vec4> table(std::size_t(LOBE_TABLE_SIDE) * LOBE_TABLE_SIDE * LOBE_TABLE_LAYERS);
    if (read(file, kLobeVersion, {std::as_writable_bytes(std::span(table))})) return table;
    table = makeLobeTable();
    write(file, kLobeVersion, {std::as_writable_bytes(std::span(table))});
    return table;
}

} // namespace tessera::frame
