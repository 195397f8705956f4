#include "validation/Html.h"

#include "validation/Base64.h"
#include "validation/PictureFile.h"

namespace tessera::validation {
namespace {

/// Length of the valid UTF-8 sequence that `text` begins with, or 0 (The Unicode Standard, table 3-7).
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const auto isTail = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
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

} // namespace

std::string escapedHtml(std::string_view text) {
    constexpr std::string_view kReplacement = "\xef\xbf\xbd"; // U+FFFD
    std::string html;
    html.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        const char first = text.front();
        const bool isControl = (first >= 0 && first < 0x20 && first != '\n' && first != '\t') || first == 0x7f;
        if (length == 0 || isControl)
            html += kReplacement;
        else if (first == '&')
            html += "&amp;";
        else if (first == '<')
            html += "&lt;";
        else if (first == '>')
            html += "&gt;";
        else if (first == '"')
            html += "&quot;";
        else if (first == '\'')
            html += "&#39;";
        else
            html += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return html;
}

std::string dataUri(const DisplayImage& image) {
    return pngDataUri(encodePng(image));
}

std::string pngDataUri(std::span<const std::uint8_t> bytes) {
    return "data:image/png;base64," + base64(bytes);
}

} // namespace tessera::validation
