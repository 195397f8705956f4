#pragma once
#include <cstddef>
#include <string_view>

namespace tessera {

/// Length in bytes of the first UTF-8 character of a text; 0 if the text is empty or not UTF-8.
/// Source: The Unicode Standard, table 3-7.
inline std::size_t letterBytes(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const auto isTail = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return text.empty() ? 0 : 1;
    if (first >= 0xc2 && first <= 0xdf) return isTail(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        const bool isOverlong = first == 0xe0 && second < 0xa0;
        const bool isSurrogate = first == 0xed && second > 0x9f;
        return isTail(1) && isTail(2) && !isOverlong && !isSurrogate ? 3 : 0;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        const bool isOverlong = first == 0xf0 && second < 0x90;
        const bool isBeyond = first == 0xf4 && second > 0x8f;
        return isTail(1) && isTail(2) && isTail(3) && !isOverlong && !isBeyond ? 4 : 0;
    }
    return 0;
}

/// The longest prefix of at most `mostBytes` bytes that ends with a complete UTF-8 character.
inline std::string_view beginningOf(std::string_view text, std::size_t mostBytes) {
    if (text.size() <= mostBytes) return text;
    constexpr std::size_t kLongestLetter = 4;
    const auto continuesLetter = [&](std::size_t at) {
        return (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u;
    };
    std::size_t end = mostBytes;
    while (end > 0 && mostBytes - end < kLongestLetter && continuesLetter(end)) --end;
    return text.substr(0, continuesLetter(end) ? mostBytes : end); // invalid UTF-8 is cut anywhere
}

} // namespace tessera
