#include <algorithm>

#include <fmt/format.h>

#include "base/Lowercase.h"
#include "base/OneLine.h"
#include "base/PictureLibrary.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// OpenImageIO's message without final punctuation, to embed in another.
std::string reasonOf(const std::string& text) {
    return oneLine(text.substr(0, text.find_last_not_of(" .\r\n") + 1));
}

TexelFormat texelFormatOf(PictureHeader::Samples samples) {
    if (samples == PictureHeader::Samples::Bits8) return TexelFormat::Rgba8Unorm;
    return samples == PictureHeader::Samples::Bits16 ? TexelFormat::Rgba16Unorm : TexelFormat::Rgba32Float;
}

/// Indices of the red, green, blue and alpha channels of a file; alpha -1: none. Other channels, such as depth, are
/// ignored.
struct Channels {
    int red, green, blue, alpha;

    int count() const { return 1 + std::max({red, green, blue, alpha}); }
};

Channels channelsOf(const PictureHeader& header) {
    const auto named = [&](std::string_view name) {
        for (std::size_t i = 0; i < header.channelNames.size(); ++i)
            if (isSameWord(header.channelNames[i], name)) return int(i);
        return -1;
    };
    const int alpha = header.alphaChannel < header.channels ? header.alphaChannel : -1;
    const Channels byName{named("r"), named("g"), named("b"), alpha};
    if (byName.red >= 0 && byName.green >= 0 && byName.blue >= 0 && byName.count() <= header.channels) return byName;
    const bool isGrey = header.channels < 3;
    return isGrey ? Channels{0, 0, 0, alpha} : Channels{0, 1, 2, alpha};
}

/// Reads RGBA texels: grey is replicated, a missing alpha is 1.
template <typename Channel>
bool readTexels(PictureInput& input, const Channels& channels, std::span<Channel> texels) {
    const auto stride = std::size_t(channels.count());
    std::vector<Channel> stored(texels.size() / 4 * stride);
    if (!input.read(channels.count(), stored.data())) return false;
    Channel* to = texels.data();
    for (const Channel* from = stored.data(); from != stored.data() + stored.size(); from += stride) {
        *to++ = from[channels.red];
        *to++ = from[channels.green];
        *to++ = from[channels.blue];
        *to++ = channels.alpha >= 0 ? from[channels.alpha] : kOneOf<Channel>;
    }
    return true;
}

DecodedPicture decode(PictureInput& input, const PictureSource& source) {
    PictureHeader header;
    if (!input.open(header)) throw std::runtime_error(input.error());
    if (header.width <= 0 || header.height <= 0 || header.depth > 1 || header.channels <= 0 || header.isDeep)
        throw InputError(fmt::format("{}: the picture has {}x{}x{} texels of {} channels{}; a flat picture with at "
                                     "least one of each is needed",
                                     source.name, header.width, header.height, header.depth, header.channels,
                                     header.isDeep ? ", with several samples at different depths a texel" : ""));
    const TexelFormat texels = texelFormatOf(header.samples);
    // The reader's copy, unless claimedSize() has charged it, its output, and the texels made of that.
    const std::uint64_t copies = source.format.claimedSize != nullptr ? 1 : 2;
    DecodedPicture decoded = source.blank(header.width, header.height, texels,
                                          (copies * std::uint64_t(header.channels) + 4) * texelBytes(texels) / 4);
    decoded.tags = {header.software, header.isFloatingPoint || isSameWord(header.colorSpace, "linear"),
                    header.orientation, header.isAssociated};
    Image& image = decoded.image;
    const bool isRead = withChannel(texels, [&]<typename Channel>(Channel) {
        return readTexels(input, channelsOf(header), texelsOf<Channel>(image));
    });
    if (!isRead) source.fail(reasonOf(input.error()));
    const DisplayWindow window{header.left, header.top, header.displayedWidth, header.displayedHeight};
    const bool isPlaced =
        window.left != 0 || window.top != 0 || window.width != image.width || window.height != image.height;
    if (window.width > 0 && isPlaced) {
        PictureFormat format = source.format;
        format.maxTexelsAByte = 0; // the black border takes no bytes of the file
        try {
            Image placed = PictureSource{source.bytes, source.name, format, source.ledger}
                               .blank(window.width, window.height, texels, texelBytes(texels))
                               .image;
            placeInWindow(image, window, header.alphaChannel >= 0, placed);
            image = std::move(placed);
        } catch (const MemoryRefused&) {
            throw;
        } catch (const InputError&) {
            source.noteRepair(
                fmt::format("its display window of {}x{} texels is too large", window.width, window.height),
                fmt::format("the {}x{} texels of its data window are taken alone", image.width, image.height));
        }
    }
    return decoded;
}

} // namespace

DecodedPicture decodeByOiio(const PictureSource& source) {
    std::span<const std::byte> bytes = source.bytes;
    std::vector<std::byte> reduced;
    if (source.format.takeOutMetadata != nullptr) {
        source.ledger.charge(bytes.size(), [&] { return source.name + ": a copy of the picture's file"; });
        reduced.assign(bytes.begin(), bytes.end());
        bytes = reduced;
    }
    std::unique_ptr<PictureInput> input;
    try {
        input = PictureLibrary::get().input(std::string(source.format.name), bytes);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", source.name, oneLine(error.what())));
    }
    try {
        if (source.format.takeOutMetadata != nullptr) source.format.takeOutMetadata(reduced);
        return decode(*input, {bytes, source.name, source.format, source.ledger});
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // some readers throw other types
        source.fail(reasonOf(error.what()), "cannot be decoded");
    }
}

} // namespace tessera::scenes
