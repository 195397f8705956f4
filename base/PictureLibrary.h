#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tessera {

/// The Software field of written files.
inline constexpr const char* kPictureSoftware = "tessera";

/// The header of an image file.
struct PictureHeader {
    int width = 0, height = 0, depth = 0; ///< texels
    int channels = 0;
    bool isDeep = false; ///< several samples at different depths per texel
    enum class Samples { Bits8, Bits16, Other } samples = Samples::Other;
    bool isFloatingPoint = false;
    std::vector<std::string> channelNames;
    int alphaChannel = -1;     ///< -1: none
    bool isAssociated = false; ///< colours are multiplied by alpha
    /// Offset of the texels (data window) in the displayed image (display window), and its size; both 0: only the
    /// texels are displayed.
    std::int64_t left = 0, top = 0;
    int displayedWidth = 0, displayedHeight = 0;
    int orientation = 1; ///< as in Exif
    std::string software, colorSpace;
};

/// A reader of one image.
class PictureInput {
public:
    virtual ~PictureInput() = default;
    virtual bool open(PictureHeader& header) = 0;
    /// Reads rows from the top, the first `channels` channels of each texel.
    virtual bool read(int channels, std::uint8_t* samples) = 0;
    virtual bool read(int channels, std::uint16_t* samples) = 0;
    virtual bool read(int channels, float* samples) = 0;
    /// Reason of the latest failure.
    virtual std::string error() = 0;
};

/// Interface to OpenImageIO, loaded on demand: its some 260 libraries take 0.4 s to load.
class PictureLibrary {
public:
    /// Loads it on the first call. Throws std::runtime_error if it is not installed.
    static PictureLibrary& get();

    /// Makes a reader for `format` (OpenImageIO's name) and a file in memory that outlives it. Throws
    /// std::runtime_error if the format is not supported.
    virtual std::unique_ptr<PictureInput> input(const std::string& format, std::span<const std::byte> bytes) = 0;
    /// Encode as described for writeExr() and writePng() (PictureFile.h). Throw std::runtime_error.
    virtual std::vector<std::uint8_t> encodeExr(int width, int height, const float* rgba) = 0;
    virtual std::vector<std::uint8_t> encodePng(int width, int height, const std::uint8_t* rgb) = 0;

protected:
    ~PictureLibrary() = default;
};

/// The only function of the module that PictureLibrary::get() loads.
using MakePictureLibrary = PictureLibrary*();
inline constexpr const char* kMakePictureLibrary = "tesseraPictureLibrary";

} // namespace tessera
