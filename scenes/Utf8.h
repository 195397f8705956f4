#pragma once
#include <cstddef>
#include <string_view>

namespace tessera {

/// How many bytes the letter at the beginning of a UTF-8 text has; 0 where there is none, as in other encodings.
inline std::size_t letterBytes(std::string_view text) {
    if (text.empty()) return 0;
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t count = first < 0x80   ? 1
                              : first < 0xc2 ? 0
                              : first < 0xe0 ? 2
                              : first < 0xf0 ? 3
                              : first < 0xf5 ? 4
                                             : 0;
    if (count > text.size()) return 0;
    for (std::size_t i = 1; i < count; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xc0u) != 0x80u) return 0;
    return count;
}

/// The beginning of a UTF-8 text, of at most so many bytes, that ends with a whole letter.
inline std::string_view beginningOf(std::string_view text, std::size_t mostBytes) {
    if (text.size() <= mostBytes) return text;
    constexpr std::size_t kLongestLetter = 4;
    const auto continuesLetter = [&](std::size_t at) {
        return (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u;
    };
    std::size_t end = mostBytes;
    while (end > 0 && mostBytes - end < kLongestLetter && continuesLetter(end)) --end;
    return text.substr(0, continuesLetter(end) ? mostBytes : end); // what is no UTF-8 ends anywhere
}

} // namespace tessera
