#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tessera {

/// What the Software field of written files says.
inline constexpr const char* kPictureSoftware = "tessera";

/// What a file says of its picture.
struct PictureHeader {
    int width = 0, height = 0, depth = 0; ///< texels
    int channels = 0;
    bool isDeep = false; ///< several samples at different depths a texel
    enum class Samples { Bits8, Bits16, Other } samples = Samples::Other;
    bool isFloatingPoint = false;
    std::vector<std::string> channelNames;
    int alphaChannel = -1;     ///< -1: none
    bool isAssociated = false; ///< colours are multiplied by alpha
    /// The texels' place within the displayed image, and its size; 0: the texels alone are displayed.
    std::int64_t left = 0, top = 0;
    int displayedWidth = 0, displayedHeight = 0;
    int orientation = 1; ///< of Exif
    std::string software, colorSpace;
};

/// A picture that is being read.
class PictureInput {
public:
    virtual ~PictureInput() = default;
    virtual bool open(PictureHeader& header) = 0;
    /// Rows from the top, the first `channels` of each texel.
    virtual bool read(int channels, std::uint8_t* samples) = 0;
    virtual bool read(int channels, std::uint16_t* samples) = 0;
    virtual bool read(int channels, float* samples) = 0;
    /// Why the latest of them failed.
    virtual std::string error() = 0;
};

/// OpenImageIO. It brings some 260 libraries, which take 0.4 s to load: a program that reads and writes no picture does
/// without.
class PictureLibrary {
public:
    /// Loads it with the first call. Throws std::runtime_error where it is not installed.
    static PictureLibrary& get();

    /// A reader of this format by OpenImageIO's name, of a file in memory that outlives it. Throws std::runtime_error
    /// where there is none.
    virtual std::unique_ptr<PictureInput> input(const std::string& format, std::span<const std::byte> bytes) = 0;
    /// As writeExr() and writePng() say (PictureFile.h). Throws std::runtime_error.
    virtual std::vector<std::uint8_t> encodeExr(int width, int height, const float* rgba) = 0;
    virtual std::vector<std::uint8_t> encodePng(int width, int height, const std::uint8_t* rgb) = 0;

protected:
    ~PictureLibrary() = default;
};

/// The only function of the module that PictureLibrary::get() loads.
using MakePictureLibrary = PictureLibrary*();
inline constexpr const char* kMakePictureLibrary = "tesseraPictureLibrary";

} // namespace tessera
