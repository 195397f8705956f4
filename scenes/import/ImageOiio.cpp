#include <algorithm>
#include <cstring>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include "base/Error.h"
#include "base/OneLine.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// What OpenImageIO says, to stand within a message.
std::string reasonOf(const std::string& text) {
    return oneLine(text.substr(0, text.find_last_not_of(" .\r\n") + 1));
}

TexelFormat texelFormatOf(OIIO::TypeDesc type) {
    switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
        return TexelFormat::Rgba8Unorm;
    case OIIO::TypeDesc::UINT16:
    case OIIO::TypeDesc::INT16:
        return TexelFormat::Rgba16Unorm;
    default:
        return TexelFormat::Rgba32Float;
    }
}

/// Which channels of a file are red, green, blue and alpha, which may be missing: -1. Beside them stand depth and the
/// like, which nothing uses.
struct Channels {
    int red, green, blue, alpha;

    int count() const { return 1 + std::max({red, green, blue, alpha}); }
};

Channels channelsOf(const OIIO::ImageSpec& spec) {
    const auto named = [&](const char* name) {
        for (std::size_t i = 0; i < spec.channelnames.size(); ++i)
            if (OIIO::Strutil::iequals(spec.channelnames[i], name)) return static_cast<int>(i);
        return -1;
    };
    const int alpha = spec.alpha_channel < spec.nchannels ? spec.alpha_channel : -1;
    const Channels byName{named("r"), named("g"), named("b"), alpha};
    if (byName.red >= 0 && byName.green >= 0 && byName.blue >= 0 && byName.count() <= spec.nchannels) return byName;
    const bool isGrey = spec.nchannels < 3;
    return isGrey ? Channels{0, 0, 0, alpha} : Channels{0, 1, 2, alpha};
}

/// Grey is replicated, a missing alpha is `one`.
template <typename T>
bool readTexels(OIIO::ImageInput& input, const Channels& channels, OIIO::TypeDesc type, T one, Image& image) {
    const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto stride = static_cast<std::size_t>(channels.count());
    std::vector<T> stored(texels * stride);
    if (!input.read_image(0, 0, 0, channels.count(), type, stored.data())) return false;
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

bool readTexels(OIIO::ImageInput& input, const Channels& channels, Image& image) {
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        return readTexels<std::uint8_t>(input, channels, OIIO::TypeDesc::UINT8, 0xff, image);
    case TexelFormat::Rgba16Unorm:
        return readTexels<std::uint16_t>(input, channels, OIIO::TypeDesc::UINT16, 0xffff, image);
    case TexelFormat::Rgba32Float:
        return readTexels<float>(input, channels, OIIO::TypeDesc::FLOAT, 1.0f, image);
    }
    return false;
}

PictureTags tagsOf(const OIIO::ImageSpec& spec) {
    PictureTags tags;
    tags.software = spec.get_string_attribute("Software");
    tags.isLinear = spec.format.is_floating_point() ||
                    OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "Linear");
    tags.isCropped = spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
                     spec.height != spec.full_height;
    tags.orientation = spec.get_int_attribute("Orientation", 1);
    return tags;
}

/// The bytes of the file. OpenImageIO 2.4's own pread() reads what lies before them for an offset below 0, as broken
/// tables of offsets hold.
class FileInMemory : public OIIO::Filesystem::IOMemReader {
public:
    explicit FileInMemory(std::span<const std::byte> bytes) : IOMemReader(bytes.data(), bytes.size()), bytes_(bytes) {}

    std::size_t pread(void* target, std::size_t count, std::int64_t offset) override {
        if (offset < 0 || static_cast<std::uint64_t>(offset) >= bytes_.size()) return 0;
        const std::span<const std::byte> rest = bytes_.subspan(static_cast<std::size_t>(offset));
        count = std::min(count, rest.size());
        std::memcpy(target, rest.data(), count);
        return count;
    }

private:
    std::span<const std::byte> bytes_;
};

DecodedPicture decode(OIIO::ImageInput& input, std::span<const std::byte> bytes, const std::string& name,
                      const PictureFormat& format, LoadLedger& ledger) {
    if (format.claimedSize != nullptr) {
        const PictureSize claimed = format.claimedSize(bytes);
        const bool isTold = claimed.width != 0 || claimed.height != 0; // else the reader says what is wrong
        if (isTold) requirePictureSize(claimed, bytes, name, format, ledger);
    }
    // Alpha is coverage or opacity, and colours are meant without it.
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec spec;
    if (!input.open(fmt::format("picture.{}", format.name), spec, config)) throw std::runtime_error(input.geterror());

    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0 || spec.deep)
        throw InputError(fmt::format("{}: the picture has {}x{}x{} texels of {} channels{}; a flat picture with at "
                                     "least one of each is needed",
                                     name, spec.width, spec.height, spec.depth, spec.nchannels,
                                     spec.deep ? ", with several samples at different depths a texel" : ""));
    DecodedPicture decoded{{}, tagsOf(spec)};
    Image& image = decoded.image;
    image.name = name;
    image.width = spec.width;
    image.height = spec.height;
    image.format = texelFormatOf(spec.format);
    // The reader's own copy, where its header did not tell it, what it hands over, and the texels made of that.
    const std::uint64_t copies = format.claimedSize != nullptr ? 1 : 2;
    const std::uint64_t bytesATexel =
        copies * static_cast<std::uint64_t>(spec.nchannels) * texelBytes(image.format) / 4 + texelBytes(image.format);
    requirePictureSize({spec.width, spec.height, bytesATexel}, bytes, name, format, ledger);
    if (!readTexels(input, channelsOf(spec), image))
        throw InputError(fmt::format("{}: the {} picture is broken or cut short ({}); save it again", name, format.name,
                                     reasonOf(input.geterror())));
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
    // Declared first: the reader asks for it until it ends.
    FileInMemory file(bytes);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(std::string(format.name));
    if (!input)
        throw std::runtime_error(fmt::format("{}: OpenImageIO cannot read {} ({}); install it with that format", name,
                                             format.name, reasonOf(OIIO::geterror())));
    if (!input->supports("ioproxy") || !input->set_ioproxy(&file))
        throw std::runtime_error(
            fmt::format("{}: this OpenImageIO cannot read {} from memory; install 2.4 or newer", name, format.name));
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
