#include <algorithm>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/OneLine.h"
#include "base/PictureLibrary.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// What OpenImageIO says, to stand within a message.
std::string reasonOf(const std::string& text) {
    return oneLine(text.substr(0, text.find_last_not_of(" .\r\n") + 1));
}

TexelFormat texelFormatOf(PictureHeader::Samples samples) {
    switch (samples) {
    case PictureHeader::Samples::Bits8:
        return TexelFormat::Rgba8Unorm;
    case PictureHeader::Samples::Bits16:
        return TexelFormat::Rgba16Unorm;
    case PictureHeader::Samples::Other:
        break;
    }
    return TexelFormat::Rgba32Float;
}

bool isSameWord(std::string_view a, std::string_view b) {
    const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    return std::ranges::equal(a, b, {}, small, small);
}

/// Which channels of a file are red, green, blue and alpha, which may be missing: -1. Beside them stand depth and the
/// like, which nothing uses.
struct Channels {
    int red, green, blue, alpha;

    int count() const { return 1 + std::max({red, green, blue, alpha}); }
};

Channels channelsOf(const PictureHeader& header) {
    const auto named = [&](std::string_view name) {
        for (std::size_t i = 0; i < header.channelNames.size(); ++i)
            if (isSameWord(header.channelNames[i], name)) return static_cast<int>(i);
        return -1;
    };
    const int alpha = header.alphaChannel < header.channels ? header.alphaChannel : -1;
    const Channels byName{named("r"), named("g"), named("b"), alpha};
    if (byName.red >= 0 && byName.green >= 0 && byName.blue >= 0 && byName.count() <= header.channels) return byName;
    const bool isGrey = header.channels < 3;
    return isGrey ? Channels{0, 0, 0, alpha} : Channels{0, 1, 2, alpha};
}

/// Grey is replicated, a missing alpha is `one`.
template <typename T>
bool readTexels(PictureInput& input, const Channels& channels, T one, Image& image) {
    const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto stride = static_cast<std::size_t>(channels.count());
    std::vector<T> stored(texels * stride);
    if (!input.read(channels.count(), stored.data())) return false;
    image.texels.resize(texels * 4 * sizeof(T));
    T* to = reinterpret_cast<T*>(image.texels.data());
    for (const T* from = stored.data(); from != stored.data() + stored.size(); from += stride) {
        *to++ = from[channels.red];
        *to++ = from[channels.green];
        *to++ = from[channels.blue];
        *to++ = channels.alpha >= 0 ? from[channels.alpha] : one;
    }
    return true;
}

bool readTexels(PictureInput& input, const Channels& channels, Image& image) {
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        return readTexels<std::uint8_t>(input, channels, 0xff, image);
    case TexelFormat::Rgba16Unorm:
        return readTexels<std::uint16_t>(input, channels, 0xffff, image);
    case TexelFormat::Rgba32Float:
        return readTexels<float>(input, channels, 1.0f, image);
    }
    return false;
}

PictureTags tagsOf(const PictureHeader& header) {
    PictureTags tags;
    tags.software = header.software;
    tags.isLinear = header.isFloatingPoint || isSameWord(header.colorSpace, "linear");
    tags.orientation = header.orientation;
    tags.isAssociated = header.isAssociated;
    return tags;
}

DecodedPicture decode(PictureInput& input, std::span<const std::byte> bytes, const std::string& name,
                      const PictureFormat& format, LoadLedger& ledger) {
    if (format.claimedSize != nullptr) {
        const PictureSize claimed = format.claimedSize(bytes);
        const bool isTold = claimed.width != 0 || claimed.height != 0; // else the reader says what is wrong
        if (isTold) requirePictureSize(claimed, bytes, name, format, ledger);
    }
    PictureHeader header;
    if (!input.open(header)) throw std::runtime_error(input.error());

    if (header.width <= 0 || header.height <= 0 || header.depth > 1 || header.channels <= 0 || header.isDeep)
        throw InputError(fmt::format("{}: the picture has {}x{}x{} texels of {} channels{}; a flat picture with at "
                                     "least one of each is needed",
                                     name, header.width, header.height, header.depth, header.channels,
                                     header.isDeep ? ", with several samples at different depths a texel" : ""));
    DecodedPicture decoded{{}, tagsOf(header)};
    Image& image = decoded.image;
    image.name = name;
    image.width = header.width;
    image.height = header.height;
    image.format = texelFormatOf(header.samples);
    // The reader's own copy, where its header did not tell it, what it hands over, and the texels made of that.
    const std::uint64_t copies = format.claimedSize != nullptr ? 1 : 2;
    const std::uint64_t bytesATexel =
        copies * static_cast<std::uint64_t>(header.channels) * texelBytes(image.format) / 4 + texelBytes(image.format);
    requirePictureSize({header.width, header.height, bytesATexel}, bytes, name, format, ledger);
    if (!readTexels(input, channelsOf(header), image))
        throw InputError(fmt::format("{}: the {} picture is broken or cut short ({}); save it again", name, format.name,
                                     reasonOf(input.error())));
    const DisplayWindow window{header.left, header.top, header.displayedWidth, header.displayedHeight};
    const bool isPlaced =
        window.left != 0 || window.top != 0 || window.width != image.width || window.height != image.height;
    if (window.width > 0 && window.height > 0 && isPlaced) {
        PictureFormat blank = format;
        blank.maxTexelsAByte = 0; // black around the texels takes no byte of the file
        try {
            requirePictureSize({window.width, window.height, texelBytes(image.format)}, bytes, name, blank, ledger);
            image = placedInWindow(image, window, header.alphaChannel >= 0);
        } catch (const MemoryRefused&) {
            throw;
        } catch (const InputError&) {
            noteRepair(
                name, fmt::format("its display window of {}x{} texels is too large", window.width, window.height),
                fmt::format("the {}x{} texels of its data window are taken alone", image.width, image.height), ledger);
        }
    }
    return decoded;
}

} // namespace

DecodedPicture decodeByOiio(std::span<const std::byte> bytes, const std::string& name, const PictureFormat& format,
                            LoadLedger& ledger) {
    std::vector<std::byte> reduced;
    if (format.takeOutMetadata != nullptr) {
        ledger.charge(bytes.size(), [&] { return fmt::format("{}: a copy of the picture's file", name); });
        reduced.assign(bytes.begin(), bytes.end());
        bytes = reduced;
    }
    std::unique_ptr<PictureInput> input;
    try {
        input = PictureLibrary::get().input(std::string(format.name), bytes);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", name, oneLine(error.what())));
    }
    try {
        if (format.takeOutMetadata != nullptr) format.takeOutMetadata(reduced);
        return decode(*input, bytes, name, format, ledger);
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // some readers throw their own
        throw InputError(fmt::format("{}: the {} picture cannot be decoded ({}); save it again", name, format.name,
                                     reasonOf(error.what())));
    }
}

} // namespace tessera::scenes
