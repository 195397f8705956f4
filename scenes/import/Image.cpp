#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Extension.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

bool begins(std::span<const std::byte> bytes, const PictureSignature& signature) {
    return !signature.bytes.empty() && bytes.size() >= signature.offset + signature.bytes.size() &&
           std::memcmp(bytes.data() + signature.offset, signature.bytes.data(), signature.bytes.size()) == 0;
}

bool hasSignature(const PictureFormat& format) {
    return !format.signatures[0].bytes.empty();
}

/// An extension is without its dot here.
bool hasExtension(const PictureFormat& format, std::string_view extension) {
    return !extension.empty() && std::ranges::find(format.extensions, extension) != std::end(format.extensions);
}

/// "a, b or c": the formats that are decoded.
std::string decodedNames() {
    std::string names;
    std::string_view last;
    for (const PictureFormat& format : pictureFormats()) {
        if (format.decode == nullptr) continue;
        if (!last.empty()) names += (names.empty() ? "" : ", ") + std::string(last);
        last = format.name;
    }
    return names + " or " + std::string(last);
}

/// By the first bytes, regardless of the name; by the extension if no signature matches. Throws InputError for other
/// formats.
const PictureFormat& formatOf(std::span<const std::byte> bytes, const std::string& name) {
    const auto refusal = [&](const std::string& what) {
        return InputError(fmt::format("{}: {}; convert the picture to {}", name, what, decodedNames()));
    };
    const auto unsupported = [](std::string_view format) {
        return fmt::format("the picture format {} is not supported", format);
    };
    for (const PictureFormat& format : pictureFormats()) {
        if (std::ranges::none_of(format.signatures, [&](const auto& one) { return begins(bytes, one); })) continue;
        if (format.decode == nullptr) throw refusal(unsupported(format.name));
        return format;
    }
    const std::string dotted = extensionOf(name), extension = dotted.substr(dotted.empty() ? 0 : 1);
    bool hasKnownExtension = extension.empty();
    for (const PictureFormat& format : pictureFormats()) {
        if (!hasExtension(format, extension)) continue;
        if (!hasSignature(format)) return format;
        hasKnownExtension = true;
    }
    throw refusal(hasKnownExtension ? "is in no known picture format" : unsupported(extension));
}

DecodedPicture decodePicture(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger) {
    if (bytes.empty()) throw InputError(fmt::format("{}: the picture is empty (0 bytes); save it again", name));
    const PictureFormat& format = formatOf(bytes, name);
    const std::uint64_t mark = ledger.usedBytes();
    DecodedPicture decoded = format.decode(bytes, name, format, ledger);
    ledger.settle(mark, decoded.image.texels.size());
    return decoded;
}

DecodedPicture readStored(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    DecodedPicture decoded = decodePicture(readFileBytes(file, ledger), file.string(), ledger);
    ledger.settle(mark, decoded.image.texels.size());
    return decoded;
}

template <typename T>
void divideByAlpha(Image& image) {
    constexpr bool kIsInteger = std::is_integral_v<T>;
    constexpr double kOne = kIsInteger ? double(std::numeric_limits<T>::max()) : 1.0;
    const std::span texels(reinterpret_cast<T*>(image.texels.data()), image.texels.size() / sizeof(T));
    for (std::size_t i = 0; i < texels.size(); i += 4) {
        const double alpha = double(texels[i + 3]);
        if (!(alpha > 0.0)) continue;
        for (std::size_t channel = i; channel < i + 3; ++channel) {
            const double value = double(texels[channel]) * kOne / alpha;
            texels[channel] = static_cast<T>(kIsInteger ? std::min(std::round(value), kOne) : value);
        }
    }
}

Image textureOf(DecodedPicture picture) {
    Image& image = picture.image;
    if (picture.tags.isAssociated) {
        switch (image.format) {
        case TexelFormat::Rgba8Unorm:
            divideByAlpha<std::uint8_t>(image);
            break;
        case TexelFormat::Rgba16Unorm:
            divideByAlpha<std::uint16_t>(image);
            break;
        case TexelFormat::Rgba32Float:
            divideByAlpha<float>(image);
            break;
        }
    }
    return std::move(image);
}

} // namespace

DecodedPicture readPicture(const std::filesystem::path& file, LoadLedger& ledger) {
    DecodedPicture decoded = readStored(file, ledger);
    const std::uint64_t mark = ledger.usedBytes();
    turnUpright(decoded.image, decoded.tags.orientation, ledger);
    ledger.settle(mark, 0);
    decoded.tags.orientation = 1;
    return decoded;
}

Image readImage(const std::filesystem::path& file, LoadLedger& ledger) {
    return textureOf(readStored(file, ledger));
}

Image decodeImage(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger) {
    return textureOf(decodePicture(bytes, name, ledger));
}

} // namespace tessera::scenes
