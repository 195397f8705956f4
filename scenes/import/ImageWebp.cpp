#include <memory>

#include <webp/decode.h>
#include <webp/demux.h>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// The first chunk with a name; empty if there is none.
std::span<const std::byte> chunkOf(const WebPDemuxer& file, const char* name) {
    WebPChunkIterator chunk;
    if (WebPDemuxGetChunk(&file, name, 1, &chunk) == 0) return {};
    const auto bytes = std::as_bytes(std::span(chunk.chunk.bytes, chunk.chunk.size));
    WebPDemuxReleaseChunkIterator(&chunk);
    return bytes; // points into the file
}

} // namespace

DecodedPicture decodeWebp(const PictureSource& source) {
    const WebPData data{reinterpret_cast<const std::uint8_t*>(source.bytes.data()), source.bytes.size()};
    const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> file(WebPDemux(&data), WebPDemuxDelete);
    constexpr std::string_view kWhy = "libwebp cannot read it";
    source.require(file != nullptr, kWhy);
    constexpr std::size_t kTexelBytes = 4;
    const auto width = int(WebPDemuxGetI(file.get(), WEBP_FF_CANVAS_WIDTH)),
               height = int(WebPDemuxGetI(file.get(), WEBP_FF_CANVAS_HEIGHT));
    // libwebp holds a second copy of the texels while decoding.
    DecodedPicture decoded = source.blank(width, height, TexelFormat::Rgba8Unorm, 2 * kTexelBytes);
    decoded.tags.orientation = orientationOfTiff(chunkOf(*file, "EXIF"));
    // The only frame, or the first of an animation, which may cover a part of the canvas.
    WebPIterator frame;
    source.require(WebPDemuxGetFrame(file.get(), 1, &frame) != 0, kWhy);
    const std::size_t rowBytes = std::size_t(width) * kTexelBytes,
                      offset = std::size_t(frame.y_offset) * rowBytes + std::size_t(frame.x_offset) * kTexelBytes;
    const std::span texels = texelsOf<std::uint8_t>(decoded.image);
    const bool isDecoded =
        offset < texels.size() && WebPDecodeRGBAInto(frame.fragment.bytes, frame.fragment.size, &texels[offset],
                                                     texels.size() - offset, int(rowBytes)) != nullptr;
    WebPDemuxReleaseIterator(&frame);
    source.require(isDecoded, kWhy);
    return decoded;
}

} // namespace tessera::scenes
