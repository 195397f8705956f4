#pragma once
#include <cstddef>
#include <string_view>

namespace tessera {

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
