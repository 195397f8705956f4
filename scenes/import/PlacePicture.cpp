#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// Black: opaque where it is no part of an image with alpha.
void fillBlack(Image& image, bool isOpaque) {
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.texels.assign(count * texelBytes(image.format), std::byte{0});
    if (!isOpaque) return;
    const auto setAlpha = [&]<typename T>(T one) {
        for (std::size_t i = 1; i <= count; ++i)
            std::memcpy(image.texels.data() + (4 * i - 1) * sizeof one, &one, sizeof one);
    };
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        return setAlpha(std::uint8_t{0xff});
    case TexelFormat::Rgba16Unorm:
        return setAlpha(std::uint16_t{0xffff});
    case TexelFormat::Rgba32Float:
        return setAlpha(1.0f);
    }
}

} // namespace

/// Source: TIFF revision 6.0, "Orientation". Rows of 5 to 8 are columns; the first row is the last of 3, 4, 6 and 7.
void turnUpright(Image& image, int orientation, LoadLedger& ledger) {
    if (orientation <= 1 || orientation > 8) return;
    const bool hasColumns = orientation >= 5;
    const bool fromRight = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool fromBottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    ledger.charge(image.texels.size(), [&] { return image.name + ": the picture turned upright"; });
    const auto columns = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height);
    const std::size_t width = hasColumns ? rows : columns, height = hasColumns ? columns : rows;
    const std::size_t bytes = texelBytes(image.format);
    std::vector<std::byte> turned(image.texels.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t right = hasColumns ? row : column, down = hasColumns ? column : row;
            const std::size_t x = fromRight ? width - 1 - right : right, y = fromBottom ? height - 1 - down : down;
            std::memcpy(turned.data() + (y * width + x) * bytes, image.texels.data() + (row * columns + column) * bytes,
                        bytes);
        }
    image.texels = std::move(turned);
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
}

Image placedInWindow(const Image& image, const DisplayWindow& window, bool hasAlpha) {
    Image placed;
    placed.name = image.name;
    placed.format = image.format;
    placed.width = window.width;
    placed.height = window.height;
    fillBlack(placed, !hasAlpha);
    // The overlap of both, counted in texels of the displayed image.
    const std::int64_t left = std::max<std::int64_t>(window.left, 0), top = std::max<std::int64_t>(window.top, 0);
    const std::int64_t right = std::min<std::int64_t>(window.left + image.width, window.width);
    const std::int64_t bottom = std::min<std::int64_t>(window.top + image.height, window.height);
    if (left >= right) return placed;
    const std::size_t bytes = texelBytes(image.format);
    for (std::int64_t row = top; row < bottom; ++row)
        std::memcpy(placed.texels.data() + std::size_t(row * window.width + left) * bytes,
                    image.texels.data() + std::size_t((row - window.top) * image.width + left - window.left) * bytes,
                    std::size_t(right - left) * bytes);
    return placed;
}

void noteRepair(const std::string& name, const std::string& flaw, const std::string& repair, LoadLedger& ledger) {
    if (ledger.wishes().isStrict) throw InputError(fmt::format("{}: {}; save it again", name, flaw));
    ledger.warn(fmt::format("{}: {}; {}", name, flaw, repair));
}

} // namespace tessera::scenes
