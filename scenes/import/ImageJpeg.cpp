#include <csetjmp>
#include <cstdio> // jpeglib.h needs it first

#include <fmt/format.h>
#include <jpeglib.h>

#include "base/OneLine.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// libjpeg's fatal error, else its first warning, and the jump target of a fatal error.
struct JpegComplaint : jpeg_error_mgr {
    std::jmp_buf place;
    char text[JMSG_LENGTH_MAX] = {};

    void note(j_common_ptr jpeg) {
        if (text[0] == '\0') format_message(jpeg, text);
    }
};

[[noreturn]] void onJpegError(j_common_ptr jpeg) {
    auto& complaint = *static_cast<JpegComplaint*>(jpeg->err);
    complaint.format_message(jpeg, complaint.text);
    std::longjmp(complaint.place, 1);
}

void onJpegMessage(j_common_ptr jpeg, int level) {
    constexpr int kWarning = -1;
    if (level == kWarning) static_cast<JpegComplaint*>(jpeg->err)->note(jpeg);
}

/// Appends an end marker as libjpeg's default source does, but without a warning: all texels may still be present.
boolean endFile(j_decompress_ptr jpeg) {
    static constexpr JOCTET kEnd[] = {0xff, JPEG_EOI};
    jpeg->src->next_input_byte = kEnd;
    jpeg->src->bytes_in_buffer = sizeof kEnd;
    return TRUE;
}

class JpegReader {
public:
    explicit JpegReader(std::span<const std::byte> bytes) : bytes_(bytes) {
        jpeg_.err = jpeg_std_error(&complaint_);
        complaint_.error_exit = onJpegError;
        complaint_.emit_message = onJpegMessage;
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    // libjpeg leaves the two functions below by longjmp(), so they have no object with a destructor.

    bool readHeader() {
        if (setjmp(complaint_.place) != 0) return false;
        jpeg_create_decompress(&jpeg_);
        jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
        jpeg_.src->fill_input_buffer = endFile;
        jpeg_read_header(&jpeg_, TRUE);
        hasInks_ = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
        jpeg_.out_color_space = hasInks_ ? JCS_CMYK : JCS_EXT_RGBA;
        return true;
    }

    /// Returns the number of rows read, fewer if libjpeg fails. It fills missing parts of a truncated file with grey.
    std::size_t readRows(Image& image) {
        if (setjmp(complaint_.place) != 0) return jpeg_.output_scanline;
        jpeg_start_decompress(&jpeg_);
        const std::size_t rowBytes = std::size_t{4} * jpeg_.output_width;
        while (jpeg_.output_scanline < jpeg_.output_height) {
            auto* row = reinterpret_cast<JSAMPLE*>(image.texels.data() + jpeg_.output_scanline * rowBytes);
            jpeg_read_scanlines(&jpeg_, &row, 1);
        }
        return jpeg_.output_scanline;
    }

    int width() const { return int(jpeg_.image_width); }
    int height() const { return int(jpeg_.image_height); }
    bool hasInks() const { return hasInks_; }
    std::string complaint() const { return oneLine(complaint_.text); }

private:
    std::span<const std::byte> bytes_;
    JpegComplaint complaint_{};
    jpeg_decompress_struct jpeg_{};
    bool hasInks_ = false; ///< cyan, magenta, yellow and black
};

/// Converts CMYK to RGB. Files store inverted ink values, as Adobe does.
void mixInks(Image& image) {
    for (std::size_t at = 0; at < image.texels.size(); at += 4) {
        const int black = std::to_integer<int>(image.texels[at + 3]);
        for (std::size_t c = at; c < at + 3; ++c)
            image.texels[c] = std::byte((std::to_integer<int>(image.texels[c]) * black + 127) / 255);
        image.texels[at + 3] = std::byte{0xff};
    }
}

} // namespace

DecodedPicture decodeJpeg(const PictureSource& source) {
    JpegReader reader(source.bytes);
    if (!reader.readHeader()) source.fail(reader.complaint());
    DecodedPicture decoded = source.blank(reader.width(), reader.height(), TexelFormat::Rgba8Unorm, 4);
    decoded.tags.orientation = orientationOfJpeg(source.bytes);
    if (reader.readRows(decoded.image) == 0) source.fail(reader.complaint());
    if (!reader.complaint().empty())
        source.noteRepair(fmt::format("the jpeg picture is broken or cut short ({})", reader.complaint()),
                          "drawn as far as it can be read");
    if (reader.hasInks()) mixInks(decoded.image);
    return decoded;
}

} // namespace tessera::scenes
