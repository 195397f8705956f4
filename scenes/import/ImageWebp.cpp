#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <webp/decode.h>
#include <webp/demux.h>

#include "base/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// The first chunk of a name; empty where there is none.
std::span<const std::byte> chunkOf(const WebPDemuxer& file, const char* name) {
    WebPChunkIterator chunk;
    if (WebPDemuxGetChunk(&file, name, 1, &chunk) == 0) return {};
    const auto bytes = std::as_bytes(std::span(chunk.chunk.bytes, chunk.chunk.size));
    WebPDemuxReleaseChunkIterator(&chunk);
    return bytes; // of the file itself
}

/// Writers put TIFF tags into the chunk EXIF with or without JPEG's six bytes ahead of them.
int orientationOf(const WebPDemuxer& file) {
    constexpr std::string_view kJpegPrefix("Exif\0\0", 6);
    std::span<const std::byte> exif = chunkOf(file, "EXIF");
    if (exif.size() > kJpegPrefix.size() && std::memcmp(exif.data(), kJpegPrefix.data(), kJpegPrefix.size()) == 0)
        exif = exif.subspan(kJpegPrefix.size());
    return orientationOfTiff(exif);
}

} // namespace

DecodedPicture decodeWebp(std::span<const std::byte> bytes, const std::string& name, const PictureFormat& format,
                          LoadLedger& ledger) {
    const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
    const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> file(WebPDemux(&data), WebPDemuxDelete);
    const auto require = [&](bool isGood) {
        if (!isGood) throw InputError(fmt::format("{}: the webp picture is broken or cut short; save it again", name));
    };
    require(file != nullptr);
    DecodedPicture decoded;
    Image& image = decoded.image;
    image.name = name;
    image.width = static_cast<int>(WebPDemuxGetI(file.get(), WEBP_FF_CANVAS_WIDTH));
    image.height = static_cast<int>(WebPDemuxGetI(file.get(), WEBP_FF_CANVAS_HEIGHT));
    image.format = TexelFormat::Rgba8Unorm;
    decoded.tags.orientation = orientationOf(*file);
    // libwebp holds as many texels again while it decodes.
    requirePictureSize({image.width, image.height, 2 * texelBytes(image.format)}, bytes, name, format, ledger);
    const std::size_t rowBytes = static_cast<std::size_t>(image.width) * texelBytes(image.format);
    image.texels.resize(rowBytes * static_cast<std::size_t>(image.height));
    // The only frame, or the first of an animation, which may cover a part of the canvas.
    WebPIterator frame;
    require(WebPDemuxGetFrame(file.get(), 1, &frame) != 0);
    const std::size_t offset = static_cast<std::size_t>(frame.y_offset) * rowBytes +
                               static_cast<std::size_t>(frame.x_offset) * texelBytes(image.format);
    const bool isDecoded = offset < image.texels.size() &&
                           WebPDecodeRGBAInto(frame.fragment.bytes, frame.fragment.size,
                                              reinterpret_cast<std::uint8_t*>(image.texels.data()) + offset,
                                              image.texels.size() - offset, static_cast<int>(rowBytes)) != nullptr;
    WebPDemuxReleaseIterator(&frame);
    require(isDecoded);
    return decoded;
}

} // namespace tessera::scenes
