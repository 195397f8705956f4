#include "scenes/import/GltfDocument.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::scenes::gltf {
namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// A '%' that two hexadecimal digits do not follow stands for itself.
std::string percentDecoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape =
            text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
        if (escape) {
            decoded.push_back(static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2])));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

/// Value of a base64 digit (RFC 4648, both alphabets), or -1.
int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::vector<std::byte> base64Decoded(std::string_view text) {
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bitCount = 0;
    std::size_t digits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (std::isspace(static_cast<unsigned char>(c))) continue;
        if (c == '=') {
            if (text.find_first_not_of("= \t\r\n", i) != std::string_view::npos)
                throw InputError("its base64 goes on after the padding '='");
            break;
        }
        const int digit = base64Digit(c);
        if (digit < 0) throw InputError(fmt::format("its base64 has an invalid character at position {}", i));
        ++digits;
        bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffffu;
        bitCount += 6;
        if (bitCount >= 8) {
            bitCount -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bitCount & 0xffu));
        }
    }
    if (digits % 4 == 1) throw InputError("its base64 is cut short");
    return bytes;
}

/// In any case of letters.
bool startsWith(std::string_view text, std::string_view lowerCase) {
    const auto isSame = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    return text.size() >= lowerCase.size() &&
           std::equal(lowerCase.begin(), lowerCase.end(), text.begin(), [&](char b, char a) { return isSame(a, b); });
}

/// RFC 3986: a letter, then letters, digits, '+', '-' or '.', then ':'. One letter alone is a Windows drive.
bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2 || !std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
    for (const char c : uri.substr(0, colon))
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return false;
    return true;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return startsWith(uri, "data:");
}

std::vector<std::byte> decodeDataUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos)
        throw InputError("its data URI has no comma before the data");
    std::string header(uri.substr(0, comma));
    std::erase(header, ' ');
    const std::string data = percentDecoded(uri.substr(comma + 1));
    constexpr std::string_view kBase64 = ";base64";
    if (header.size() >= kBase64.size() &&
        startsWith(std::string_view(header).substr(header.size() - kBase64.size()), kBase64))
        return base64Decoded(data);
    const auto* first = reinterpret_cast<const std::byte*>(data.data());
    return {first, first + data.size()};
}

NamedFile fileOfUri(std::string_view uri, const std::filesystem::path& folder) {
    constexpr std::string_view kFile = "file:";
    if (startsWith(uri, kFile)) uri.remove_prefix(kFile.size());
    if (uri.empty()) throw InputError("its uri is empty");
    if ((uri.starts_with("//") && !uri.starts_with("///")) || hasScheme(uri))
        throw InputError(
            fmt::format("its uri '{}' is not a relative path; put the file beside the model", uri.substr(0, 80)));
    const std::string decoded = percentDecoded(uri);
    if (decoded.find('\0') != std::string::npos) throw InputError("its uri holds a zero character");
    const NamedFile file = fileNamed(folder, decoded);
    if (file.isFound && file.isAsNamed) return file;
    const NamedFile literal = fileNamed(folder, std::string(uri));
    return literal.isFound && (literal.isAsNamed || !file.isFound) ? literal : file;
}

} // namespace tessera::scenes::gltf
