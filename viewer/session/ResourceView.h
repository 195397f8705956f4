#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/graph/Resource.h"
#include "viewer/session/Magnification.h"

namespace tessera::viewer {

/// Which resource of the render graph the window shows, and how.
struct ResourceView {
    enum class Channels : std::uint8_t { All, Red, Green, Blue, Alpha };
    enum class Words : std::uint8_t { Unsigned, Float, Hexadecimal };

    std::string name; ///< in the plan; empty: none is shown
    int level = 0, layer = 0;
    Channels channels = Channels::All;
    bool fitsRange = true;            ///< black and white are as rangeOf() says,
    float least = 0.0f, most = 1.0f;  ///< else these numbers
    bool isCurved = false;            ///< by the curve of sRGB between them, as displays take light
    std::optional<Words> words;       ///< how a buffer's are shown; none: as likelyWords() says
    Magnification magnification = {}; ///< of the texture

    /// Shows another one, or none.
    void show(std::string resource) {
        *this = {};
        name = std::move(resource);
    }
};

/// What a resource of the render graph held at the end of a frame.
struct ResourceContents {
    std::string name;  ///< in the plan
    std::string fault; ///< why nothing is known of it; empty: it is
    graph::ResourceDesc desc;
    glm::ivec2 sizeTexels{0};         ///< of a texture's level
    std::vector<glm::uvec4> texels;   ///< of a layer, rows from the top, as gpu::Texture::downloadComponents()
    std::size_t bytes = 0;            ///< of a buffer,
    std::vector<std::uint32_t> words; ///< and those that were read

    bool isTexture() const { return std::holds_alternative<graph::TextureDesc>(desc); }
    /// A component of a texel: a number as it is stored, of normalised formats from 0 or -1 to 1.
    double number(std::size_t texel, int component) const;
    /// "(12, 40): 0.25 0.5 0.75 1", in the components that the format has.
    std::string texelText(glm::ivec2 texel) const;
    /// "depth: D32F 1280 x 720", "light list: 4096 bytes"; of what is missing, why.
    std::string text() const;
    /// Floats, where nearly all words are 0 or floats of usual magnitudes; else whole numbers.
    ResourceView::Words likelyWords() const;
    /// A word as a number.
    static std::string wordText(std::uint32_t word, ResourceView::Words words);
};

/// From the least finite number in the channels that are shown to one that 99.5 % of them do not exceed; 0 to 1 where
/// there is none. Depths of 0, where nothing is drawn, do not count.
struct NumberRange {
    double least = 0.0, most = 1.0;
};
NumberRange rangeOf(const ResourceContents& contents, ResourceView::Channels channels);

/// The colours of a texture's texels, rows from the top: black at the range's beginning, white at its end; numbers that
/// are not finite are magenta. A single channel is grey.
std::vector<glm::u8vec4> colorsOf(const ResourceContents& contents, ResourceView::Channels channels,
                                  const NumberRange& range, bool isCurved);

} // namespace tessera::viewer
