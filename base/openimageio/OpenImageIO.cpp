#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/PictureLibrary.h"

/// The module that PictureLibrary::get() loads.
namespace tessera {
namespace {

/// A file in memory with checked offsets. OpenImageIO 2.4's pread() reads before the buffer for negative offsets, which
/// broken offset tables contain.
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

PictureHeader::Samples samplesOf(OIIO::TypeDesc type) {
    switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
        return PictureHeader::Samples::Bits8;
    case OIIO::TypeDesc::UINT16:
    case OIIO::TypeDesc::INT16:
        return PictureHeader::Samples::Bits16;
    default:
        return PictureHeader::Samples::Other;
    }
}

PictureHeader headerOf(const OIIO::ImageSpec& spec) {
    PictureHeader header;
    header.width = spec.width;
    header.height = spec.height;
    header.depth = spec.depth;
    header.channels = spec.nchannels;
    header.isDeep = spec.deep;
    header.samples = samplesOf(spec.format);
    header.isFloatingPoint = spec.format.is_floating_point();
    header.channelNames = spec.channelnames;
    header.alphaChannel = spec.alpha_channel;
    // Readers that return unassociated alpha, as open() requests, report that they did.
    header.isAssociated = spec.alpha_channel >= 0 && spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
    header.orientation = spec.get_int_attribute("Orientation", 1);
    header.software = spec.get_string_attribute("Software");
    header.colorSpace = spec.get_string_attribute("oiio:ColorSpace");
    return header;
}

/// OpenImageIO's message without final punctuation, to embed in another.
std::string reasonOf(const std::string& text) {
    return text.substr(0, text.find_last_not_of(" .\r\n") + 1);
}

class Input : public PictureInput {
public:
    Input(const std::string& format, std::span<const std::byte> bytes) : format_(format), file_(bytes) {
        input_ = OIIO::ImageInput::create(format);
        if (!input_)
            throw std::runtime_error(fmt::format("OpenImageIO cannot read {} ({}); install it with that format", format,
                                                 reasonOf(OIIO::geterror())));
        if (!input_->supports("ioproxy") || !input_->set_ioproxy(&file_))
            throw std::runtime_error(
                fmt::format("this OpenImageIO cannot read {} from memory; install 2.4 or newer", format));
    }

    bool open(PictureHeader& header) override {
        // Requests colours that are not premultiplied by alpha. Some readers premultiply nevertheless.
        OIIO::ImageSpec config, spec;
        config.attribute("oiio:UnassociatedAlpha", 1);
        if (!input_->open(fmt::format("picture.{}", format_), spec, config)) return false;
        header = headerOf(spec);
        // Not for TIFF, whose positions in inches or centimetres OpenImageIO returns as texels.
        if (format_ == "openexr") {
            header.left = std::int64_t{spec.x} - spec.full_x;
            header.top = std::int64_t{spec.y} - spec.full_y;
            header.displayedWidth = spec.full_width;
            header.displayedHeight = spec.full_height;
        }
        return true;
    }
    bool read(int channels, std::uint8_t* samples) override { return read(channels, OIIO::TypeDesc::UINT8, samples); }
    bool read(int channels, std::uint16_t* samples) override { return read(channels, OIIO::TypeDesc::UINT16, samples); }
    bool read(int channels, float* samples) override { return read(channels, OIIO::TypeDesc::FLOAT, samples); }
    std::string error() override { return input_->geterror(); }

private:
    bool read(int channels, OIIO::TypeDesc type, void* samples) {
        return input_->read_image(0, 0, 0, channels, type, samples);
    }

    std::string format_;
    FileInMemory file_; ///< declared before the reader, which uses it until destroyed
    std::unique_ptr<OIIO::ImageInput> input_;
};

std::string firstLine(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

std::vector<std::uint8_t> encode(const char* format, const OIIO::ImageSpec& spec, const void* pixels) {
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &proxy);
    if (!output)
        throw std::runtime_error(
            fmt::format("this OpenImageIO cannot write {}: {}", format, firstLine(OIIO::geterror())));
    if (!output->open(format, spec) || !output->write_image(spec.format, pixels) || !output->close())
        throw std::runtime_error(fmt::format("cannot encode {}: {}", format, firstLine(output->geterror())));
    return bytes;
}

class Library : public PictureLibrary {
public:
    std::unique_ptr<PictureInput> input(const std::string& format, std::span<const std::byte> bytes) override {
        return std::make_unique<Input>(format, bytes);
    }

    std::vector<std::uint8_t> encodeExr(int width, int height, const float* rgba) override {
        OIIO::ImageSpec spec(width, height, 4, OIIO::TypeDesc::FLOAT);
        // ITU-R BT.709 red, green, blue and the D65 white, as x y pairs.
        const float chromaticities[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
        spec.attribute("compression", "zip");
        spec.attribute("oiio:ColorSpace", "Linear");
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
        spec.attribute("Software", kPictureSoftware);
        spec.attribute("DateTime", ""); // else the time of writing is added, and equal images give unequal files
        return encode("exr", spec, rgba);
    }

    std::vector<std::uint8_t> encodePng(int width, int height, const std::uint8_t* rgb) override {
        OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("Software", kPictureSoftware);
        return encode("png", spec, rgb);
    }
};

} // namespace
} // namespace tessera

extern "C" tessera::PictureLibrary* tesseraPictureLibrary() {
    static tessera::Library library;
    return &library;
}
