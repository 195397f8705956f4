#include "scenes/import/PictureCodecs.h"

#include <cmath>
#include <csetjmp>
#include <cstring>

#include <fmt/format.h>
#include <png.h>

#include "base/Error.h"

namespace tessera::scenes {
namespace {

/// The bytes that libpng reads, and what it says is wrong with them.
struct Source {
    std::span<const std::byte> bytes;
    std::size_t at = 0;
    std::string problem;
};

void readBytes(png_structp png, png_bytep target, std::size_t count) {
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (count > source.bytes.size() - source.at) png_error(png, "the file ends early");
    std::memcpy(target, source.bytes.data() + source.at, count);
    source.at += count;
}

[[noreturn]] void onError(png_structp png, png_const_charp text) {
    static_cast<Source*>(png_get_error_ptr(png))->problem = text;
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : source_{bytes, 0, {}} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, onError, onWarning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw std::bad_alloc();
        png_set_read_fn(png_, &source_, readBytes);
        // Skips all chunks that decoding does not need but these two, so that no text of megabytes is kept.
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("gAMA\0sRGB"),
                                    2);
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    // libpng leaves the two functions below by longjmp(), past no object that has a destructor.

    bool readHeader() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_info(png_, info_);
        png_set_expand(png_); // palettes, fewer than 8 bits, a transparent colour
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
        png_set_swap(png_); // stored big-endian
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    bool readRows(std::span<png_bytep> rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_image(png_, rows.data());
        png_read_end(png_, nullptr);
        return true;
    }

    /// True when the file says that its numbers are light itself. Source: PNG specification, 11.3.2.5 and 11.3.2.6.
    bool isLinear() const {
        constexpr double kClose = 0.005; // some writers round 1
        int intent = 0;
        double gamma = 0.0;
        return png_get_sRGB(png_, info_, &intent) == 0 && png_get_gAMA(png_, info_, &gamma) != 0 &&
               std::abs(gamma - 1.0) < kClose;
    }
    int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
    int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
    bool has16Bits() const { return png_get_bit_depth(png_, info_) == 16; }
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
    const std::string& problem() const { return source_.problem; }

private:
    Source source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

} // namespace

DecodedPicture decodePng(std::span<const std::byte> bytes, const std::string& name, const PictureFormat& format,
                         LoadLedger& ledger) {
    Reader reader(bytes);
    const auto require = [&](bool good) {
        if (!good)
            throw InputError(
                fmt::format("{}: the png picture is broken or cut short ({}); save it again", name, reader.problem()));
    };
    require(reader.readHeader());
    DecodedPicture decoded;
    decoded.tags.isLinear = reader.isLinear();
    Image& image = decoded.image;
    image.name = name;
    image.width = reader.width();
    image.height = reader.height();
    image.format = reader.has16Bits() ? TexelFormat::Rgba16Unorm : TexelFormat::Rgba8Unorm;
    requirePictureSize({image.width, image.height, texelBytes(image.format)}, bytes, name, format, ledger);
    image.texels.resize(reader.rowBytes() * static_cast<std::size_t>(image.height));
    std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
    for (std::size_t row = 0; row < rows.size(); ++row)
        rows[row] = reinterpret_cast<png_bytep>(image.texels.data() + row * reader.rowBytes());
    require(reader.readRows(rows));
    return decoded;
}

} // namespace tessera::scenes
