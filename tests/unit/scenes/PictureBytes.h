#pragma once
// Images as bytes: seeds of the fuzzers' corpus, TIFFs built entry by entry, and the memory cost of reading them.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenes/import/PictureCodecs.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes::test {

inline const std::filesystem::path kSeeds = std::filesystem::path(TESSERA_SOURCE_DIR) / "tests/fuzz/corpus";

inline std::string bytesOfSeed(const char* name) {
    std::ifstream stream(kSeeds / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Writes the scanned head's files of a TESSERA_ASSETS folder, with a triangle instead of the scan.
inline void writeScan(const TempFolder& folder) {
    folder.write("LeePerrySmith/head.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    for (const char* name : {"albedo_2k.jpg", "specular_2k.jpg", "normal_object_2k.jpg"})
        folder.write(std::string("LeePerrySmith/") + name, bytesOfSeed("picture/small.jpg"));
}

inline Image decoded(const std::string& bytes, const std::string& name, std::optional<std::uint64_t> limitBytes = {}) {
    LoadLedger ledger(limitBytes);
    return decodeImage(std::as_bytes(std::span(bytes)), name, ledger);
}

inline std::string refusalOf(const std::string& bytes, const std::string& name,
                             std::optional<std::uint64_t> limitBytes = {}) {
    return inputErrorOf([&] { decoded(bytes, name, limitBytes); });
}

/// Stored texel values of an image.
template <typename T>
std::vector<T> storedTexels(const Image& image) {
    std::vector<T> texels(image.texels.size() / sizeof(T));
    std::memcpy(texels.data(), image.texels.data(), image.texels.size());
    return texels;
}

/// A size of /proc/self/status in bytes, or 0.
inline std::uint64_t statusBytes(std::string_view key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key)) return 1024 * std::stoull(line.substr(key.size()));
    return 0;
}

/// Peak growth of the process while `action` runs. Source: Linux, proc(5): writing 5 resets the peak.
inline std::uint64_t growthOf(const std::function<void()>& action) {
    std::ofstream clear("/proc/self/clear_refs");
    EXPECT_TRUE(clear << 5 << std::flush) << "the peak stays what it was, and nothing can be measured";
    const std::uint64_t before = statusBytes("VmHWM:");
    EXPECT_GT(before, 0u);
    action();
    return statusBytes("VmHWM:") - before;
}

/// An entry of a TIFF's directory. `isPlace`: its value is an offset into the data after the directory.
struct TiffEntry {
    int tag, type;
    std::uint32_t count, value;
    bool isPlace = false;
};
inline constexpr int kByte = 1, kAscii = 2, kShort = 3, kLong = 4, kLong8 = 16;

enum class ByteOrder { Little, Big };

inline std::string numberText(std::uint32_t number, int bytes, ByteOrder order) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(number >> (8 * (order == ByteOrder::Big ? bytes - 1 - i : i)));
    return text;
}

/// A PFM image, rows given from the top.
inline std::string pfmOf(int width, int height, const std::vector<float>& rgb) {
    std::string text = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    for (int y = height - 1; y >= 0; --y)
        text.append(reinterpret_cast<const char*>(rgb.data() + std::size_t(3 * y * width)),
                    std::size_t(3 * width) * sizeof(float));
    return text;
}

inline const std::string kPngBegin = "\x89PNG\r\n\x1a\n";

/// The check sum of a chunk of a PNG, from its name on. Source: PNG specification, annex D.
inline std::uint32_t crcOf(const std::string& bytes) {
    std::uint32_t crc = ~0u;
    for (const char byte : bytes) {
        crc ^= std::uint8_t(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}
inline std::string pngChunk(const std::string& name, const std::string& content) {
    return numberText(std::uint32_t(content.size()), 4, ByteOrder::Big) + name + content +
           numberText(crcOf(name + content), 4, ByteOrder::Big);
}

/// An uncompressed PNG with these bits per channel; colour types are 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA. A
/// `claimedSide` replaces both sides in its header. Source: RFC 2083, RFC 1951 section 3.2.4.
inline std::string pngOf(int width, int height, int bits, int colourType, const std::string& texels,
                         int claimedSide = 0) {
    const auto big = [](int value, int bytes) { return numberText(std::uint32_t(value), bytes, ByteOrder::Big); };
    const std::size_t rowBytes = texels.size() / std::size_t(height);
    std::string rows;
    for (std::size_t y = 0; y < std::size_t(height); ++y) rows += '\0' + texels.substr(y * rowBytes, rowBytes);
    const auto size = std::uint32_t(rows.size());
    std::uint32_t a = 1, b = 0;
    for (const char byte : rows) b = (b + (a = (a + std::uint8_t(byte)) % 65521)) % 65521;
    return kPngBegin +
           pngChunk("IHDR", big(claimedSide > 0 ? claimedSide : width, 4) +
                                big(claimedSide > 0 ? claimedSide : height, 4) + big(bits, 1) + big(colourType, 1) +
                                std::string(3, '\0')) +
           pngChunk("IDAT", "\x78\x01\x01" + numberText(size, 2, ByteOrder::Little) +
                                numberText(~size, 2, ByteOrder::Little) + rows +
                                numberText(b << 16 | a, 4, ByteOrder::Big)) +
           pngChunk("IEND", "");
}

inline std::string tiffOf(const std::vector<TiffEntry>& entries, const std::string& rest,
                          ByteOrder order = ByteOrder::Little) {
    const auto number = [&](std::uint32_t value, int bytes) { return numberText(value, bytes, order); };
    const auto places = std::uint32_t(8 + 2 + 12 * entries.size() + 4);
    std::string tiff = (order == ByteOrder::Big ? "MM" : "II") + number(42, 2) + number(8, 4);
    tiff += number(std::uint32_t(entries.size()), 2);
    for (const TiffEntry& entry : entries) {
        tiff += number(std::uint32_t(entry.tag), 2) + number(std::uint32_t(entry.type), 2) + number(entry.count, 4);
        const int bytes = entry.type == kByte ? 1 : entry.type == kShort ? 2 : 4;
        if (bytes < 4 && entry.count == 1 && !entry.isPlace)
            tiff += number(entry.value, bytes) + std::string(std::size_t(4 - bytes), '\0');
        else
            tiff += number(entry.value + (entry.isPlace ? places : 0), 4);
    }
    return tiff + number(0, 4) + rest;
}

/// Entries of a single grey texel, 0x7f, which is the first byte after the directory.
inline std::vector<TiffEntry> oneTexel() {
    return {{256, kShort, 1, 1},      {257, kShort, 1, 1}, {258, kShort, 1, 8}, {262, kShort, 1, 1},
            {273, kLong, 1, 0, true}, {278, kShort, 1, 1}, {279, kLong, 1, 1}};
}

/// A TIFF of one texel with one more entry, of type `type`, that has this value.
inline std::string tiffWith(int tag, const std::string& value, int type = kByte) {
    std::vector<TiffEntry> entries = oneTexel();
    const std::size_t size = type == kShort ? 2 : 1;
    entries.push_back({tag, type, std::uint32_t(value.size() / size), 1, true});
    return tiffOf(entries, '\x7f' + value);
}

} // namespace tessera::scenes::test
