#include "base/PictureFile.h"

#include <cassert>
#include <future>
#include <stdexcept>

#include "base/AtomicFile.h"
#include "base/PictureLibrary.h"

namespace tessera {

std::vector<std::uint8_t> encodeExr(const Picture& picture) {
    assert(picture.isConsistent());
    std::vector<float> values = picture.rgba;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) values[4 * i + 3] = picture.covered[i] ? 1.f : 0.f;
    return PictureLibrary::get().encodeExr(picture.width, picture.height, values.data());
}

void writeExr(const std::string& path, const Picture& picture) {
    writeFileAtomically(path, encodeExr(picture));
}

Png encodePng(const DisplayImage& image) {
    assert(image.isConsistent());
    return {image.width, image.height, PictureLibrary::get().encodePng(image.width, image.height, image.rgb.data())};
}

std::vector<Png> encodePngs(std::span<const DisplayImage> images) {
    std::vector<std::future<Png>> encoding;
    for (const DisplayImage& image : images)
        encoding.push_back(std::async(std::launch::async, [&image] { return encodePng(image); }));
    std::vector<Png> pngs;
    for (std::future<Png>& png : encoding) pngs.push_back(png.get());
    return pngs;
}

void writePng(const std::string& path, const DisplayImage& image) {
    writeFileAtomically(path, encodePng(image).bytes);
}

} // namespace tessera
