#include "scenes/import/PictureCodecs.h"

#include <cmath>
#include <csetjmp>
#include <cstring>

#include <fmt/format.h>
#include <png.h>

namespace tessera::scenes {
namespace {

/// The bytes that libpng reads, and its error.
struct PngBytes {
    std::span<const std::byte> bytes;
    bool isBroken = false; ///< reads as much as possible
    std::size_t at = 0;
    std::string problem;
    std::size_t rows = 0; ///< read so far, in all passes of interlacing
};

void readBytes(png_structp png, png_bytep target, std::size_t count) {
    auto& source = *static_cast<PngBytes*>(png_get_io_ptr(png));
    // libpng requests kilobytes of compressed texels, and drops the rest if fewer are left.
    constexpr std::size_t kLastBytes = 65536;
    if (source.isBroken && source.bytes.size() - source.at < kLastBytes) png_set_compression_buffer_size(png, 1);
    if (count > source.bytes.size() - source.at) png_error(png, "the file ends early");
    std::memcpy(target, source.bytes.data() + source.at, count);
    source.at += count;
}

[[noreturn]] void onError(png_structp png, png_const_charp text) {
    static_cast<PngBytes*>(png_get_error_ptr(png))->problem = text;
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

class PngReader {
public:
    /// `isBroken`: ignores wrong checksums and reads as far as possible.
    PngReader(std::span<const std::byte> bytes, bool isBroken) : source_{bytes, isBroken, 0, {}, 0} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, onError, onWarning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw std::bad_alloc();
        png_set_read_fn(png_, &source_, readBytes);
        // Skips all chunks that decoding does not need, except these two, so that megabytes of text are not kept.
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("gAMA\0sRGB"),
                                    2);
        if (!isBroken) return;
        png_set_crc_action(png_, PNG_CRC_WARN_USE, PNG_CRC_WARN_USE);
        png_set_option(png_, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    // libpng leaves the two functions below by longjmp(), so they have no object with a destructor.

    bool readHeader() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_info(png_, info_);
        png_set_expand(png_); // palettes, fewer than 8 bits, a transparent colour
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
        png_set_swap(png_); // stored big-endian
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    bool readRows(std::span<png_bytep> rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        // Rows of early passes fill the missing rows of a truncated file.
        for (int pass = 0; pass < passes_; ++pass)
            for (png_bytep& row : rows) {
                png_read_rows(png_, nullptr, &row, 1);
                ++source_.rows;
            }
        png_read_end(png_, nullptr);
        return true;
    }

    /// Whether the file declares linear values. Source: PNG specification, 11.3.2.5 and 11.3.2.6.
    bool isLinear() const {
        constexpr double kClose = 0.005; // some writers round 1
        int intent = 0;
        double gamma = 0.0;
        return png_get_sRGB(png_, info_, &intent) == 0 && png_get_gAMA(png_, info_, &gamma) != 0 &&
               std::abs(gamma - 1.0) < kClose;
    }
    int width() const { return int(png_get_image_width(png_, info_)); }
    int height() const { return int(png_get_image_height(png_, info_)); }
    bool has16Bits() const { return png_get_bit_depth(png_, info_) == 16; }
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
    const std::string& problem() const { return source_.problem; }
    std::size_t rowsRead() const { return source_.rows; }

private:
    PngBytes source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 1;
};

struct PngResult {
    DecodedPicture picture;
    std::size_t rows = 0; ///< read, in all passes
    std::string problem;  ///< empty: none
};

PngResult readPng(const PictureSource& source, bool isBroken) {
    PngReader reader(source.bytes, isBroken);
    if (!reader.readHeader()) return {{}, 0, reader.problem()};
    const TexelFormat texels = reader.has16Bits() ? TexelFormat::Rgba16Unorm : TexelFormat::Rgba8Unorm;
    PngResult result;
    result.picture = source.blank(reader.width(), reader.height(), texels, texelBytes(texels));
    result.picture.tags.isLinear = reader.isLinear();
    std::vector<png_bytep> rows;
    for (std::size_t row = 0; row < std::size_t(reader.height()); ++row)
        rows.push_back(reinterpret_cast<png_bytep>(result.picture.image.texels.data() + row * reader.rowBytes()));
    if (!reader.readRows(rows)) result.problem = reader.problem();
    result.rows = reader.rowsRead();
    return result;
}

} // namespace

DecodedPicture decodePng(const PictureSource& source) {
    const std::uint64_t mark = source.ledger.usedBytes();
    PngResult result = readPng(source, false);
    if (result.problem.empty()) return std::move(result.picture);
    const std::string problem = result.problem;
    result = {};
    source.ledger.settle(mark, 0);
    if (!source.ledger.importOptions().isStrict) result = readPng(source, true);
    source.require(result.rows > 0, problem);
    source.noteRepair(fmt::format("the png picture is broken or cut short ({})", problem),
                      "drawn as far as it can be read");
    return std::move(result.picture);
}

} // namespace tessera::scenes
