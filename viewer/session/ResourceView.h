#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/graph/Resource.h"
#include "scenes/Image.h"
#include "viewer/session/Magnification.h"

namespace tessera::viewer {

struct ResourceContents;

/// Which resource of the render graph, or image of the scene, the window displays, and how.
struct ResourceView {
    enum class Channels : std::uint8_t { All, Red, Green, Blue, Alpha };
    enum class Words : std::uint8_t { Unsigned, Float, Hexadecimal };

    std::string name;                              ///< in the plan, or of the image; empty: none
    std::shared_ptr<const ResourceContents> image; ///< contents of an image; null: a resource of the render graph
    int level = 0, layer = 0;
    Channels channels = Channels::All;
    bool fitsRange = true;            ///< black and white are those of rangeOf(),
    float least = 0.0f, most = 1.0f;  ///< else these values
    bool isCurved = false;            ///< applies the sRGB curve between them
    std::optional<Words> words;       ///< format of a buffer's words; none: likelyWords()
    Magnification magnification = {}; ///< of the texture

    /// Selects another resource, or none.
    void show(std::string resource) {
        *this = {};
        name = std::move(resource);
    }
    /// Selects an image of the scene, whose stored values are displayed.
    void show(const scenes::Image& shown, std::string title);
};

/// Contents of a resource of the render graph at the end of a frame, or of an image of the scene.
struct ResourceContents {
    std::string name;  ///< in the plan
    std::string fault; ///< why the contents are unknown; empty: they are known
    graph::ResourceDesc desc;
    glm::ivec2 sizeTexels{0};         ///< of a texture's level
    std::vector<glm::uvec4> texels;   ///< of a layer, rows from the top, see gpu::Texture::downloadComponents()
    std::size_t bytes = 0;            ///< size of a buffer,
    std::vector<std::uint32_t> words; ///< and its words that were read

    bool isTexture() const { return std::holds_alternative<graph::TextureDesc>(desc); }
    /// A component of a texel as stored; of normalised formats from 0 or -1 to 1.
    double number(std::size_t texel, int component) const;
    /// "(12, 40): 0.25 0.5 0.75 1", with the components of the format.
    std::string texelText(glm::ivec2 texel) const;
    /// "depth: D32F 1280 x 720", "light list: 4096 bytes"; if the contents are unknown, the reason.
    std::string text() const;
    /// Floats if nearly all words are 0 or floats of usual magnitudes, else whole numbers.
    ResourceView::Words likelyWords() const;
    /// Formats a word as a number.
    static std::string wordText(std::uint32_t word, ResourceView::Words words);
};

/// From the least finite number in the displayed channels to one that 99.5 % of them do not exceed; 0 to 1 if there is
/// none. Depths of 0, where nothing is drawn, are ignored.
struct NumberRange {
    double least = 0.0, most = 1.0;
};
NumberRange rangeOf(const ResourceContents& contents, ResourceView::Channels channels);

/// Display colours of a texture's texels, rows from the top: black at the start of the range, white at its end, magenta
/// for numbers that are not finite. A single channel is grey.
std::vector<glm::u8vec4> colorsOf(const ResourceContents& contents, ResourceView::Channels channels,
                                  const NumberRange& range, bool isCurved);

} // namespace tessera::viewer
