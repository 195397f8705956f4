#include "scenes/import/GltfContainer.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/FileBytes.h"

namespace tessera::scenes::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;       ///< "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;   ///< "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942; ///< "BIN\0"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

static_assert(std::endian::native == std::endian::little, "glTF numbers are little-endian");

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

std::string textOf(std::span<const std::byte> bytes) {
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3); // a byte order mark is not JSON, but editors write it
    return text;
}

Container readBinary(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
        throw InputError(fmt::format("{}: the glb is cut short: {} bytes do not hold its headers", name, bytes.size()));
    if (const std::uint32_t version = wordAt(bytes, 4); version != 2)
        throw InputError(fmt::format("{}: is glb version {}; only version 2 (glTF 2.0) is supported", name, version));
    const std::size_t length = wordAt(bytes, 8);
    if (length > bytes.size() || length < kHeaderBytes + kChunkHeaderBytes)
        throw InputError(fmt::format("{}: the glb is cut short or broken: its header says {} bytes, the file has {}",
                                     name, length, bytes.size()));
    Container container;
    std::size_t at = kHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        if (length - at < kChunkHeaderBytes)
            throw InputError(fmt::format("{}: the glb is broken: chunk {} has no room for its header", name, chunk));
        const std::size_t chunkBytes = wordAt(bytes, at);
        const std::uint32_t type = wordAt(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (chunkBytes > length - at)
            throw InputError(fmt::format("{}: the glb is broken: chunk {} says {} bytes, {} are left", name, chunk,
                                         chunkBytes, length - at));
        const std::span<const std::byte> content = bytes.subspan(at, chunkBytes);
        if (chunk == 0) {
            if (type != kJsonChunk)
                throw InputError(fmt::format("{}: the glb is broken: its first chunk is not JSON", name));
            container.json = textOf(content);
        } else if (type == kBinaryChunk && !container.binary) {
            container.binary.emplace(content.begin(), content.end());
        }
        at += chunkBytes;
    }
    return container;
}

} // namespace

Container readContainer(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::vector<std::byte> bytes = readFileBytes(file, ledger);
    const std::string name = file.string();
    ledger.charge(bytes.size(), [&] { return name; }); // once more, cut into its parts
    if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", name));
    if (bytes.size() >= 4 && wordAt(bytes, 0) == kMagic) return readBinary(bytes, name);
    Container container{textOf(bytes), std::nullopt};
    const std::size_t first = container.json.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || container.json[first] != '{')
        throw InputError(fmt::format("{}: is neither glTF JSON (begins with '{{') nor glb (begins with 'glTF')", name));
    return container;
}

} // namespace tessera::scenes::gltf
