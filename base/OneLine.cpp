#include "base/OneLine.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/Utf8.h"

namespace tessera {

std::string oneLine(std::string_view text, std::size_t mostBytes) {
    std::string line;
    bool isNew = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c == '\n' || c == '\r') {
            isNew = !line.empty();
            continue;
        }
        if (isNew) line += "; ";
        isNew = false;
        const std::string_view letter = text.substr(i, letterBytes(text.substr(i)));
        const bool isC1 = letter.size() == 2 && c == 0xc2 && static_cast<unsigned char>(letter[1]) < 0xa0;
        if (letter.empty() || c < 0x20 || c == 0x7f)
            line += fmt::format("\\x{:02x}", c);
        else if (isC1)
            line += fmt::format("\\x{:02x}", static_cast<unsigned char>(letter[1]));
        else
            line += letter;
        i += std::max<std::size_t>(letter.size(), 1) - 1;
    }
    if (line.size() > mostBytes) line = std::string(beginningOf(line, mostBytes)) + "...";
    return line;
}

} // namespace tessera
