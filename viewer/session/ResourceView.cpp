#include "viewer/session/ResourceView.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "base/Srgb.h"
#include "renderer/graph/Access.h"
#include "viewer/edit/Thumbnail.h"

namespace tessera::viewer {
namespace {

const graph::FormatInfo& formatOf(const ResourceContents& contents) {
    return graph::formatInfo(std::get<graph::TextureDesc>(contents.desc).format);
}

/// [first, end) of the displayed components: alpha is not a colour.
std::pair<int, int> shownComponents(const ResourceContents& contents, ResourceView::Channels channels) {
    const int count = formatOf(contents).components;
    if (channels == ResourceView::Channels::All) return {0, std::min(count, 3)};
    const int component = std::min(int(channels) - int(ResourceView::Channels::Red), count - 1);
    return {component, component + 1};
}

/// Copies the image as floats.
ResourceContents contentsOf(const scenes::Image& image, const std::string& name) {
    constexpr std::int64_t kMostTexels = std::int64_t(4096) * 4096; // a copy takes 16 bytes per texel
    constexpr graph::Format kFormats[] = {graph::Format::Rgba8Unorm, graph::Format::Rgba16Unorm,
                                          graph::Format::Rgba32Float};
    ResourceContents contents;
    contents.name = name;
    contents.desc = graph::TextureDesc{kFormats[std::size_t(image.format)], image.width, image.height};
    contents.sizeTexels = {image.width, image.height};
    if (std::int64_t(image.width) * image.height > kMostTexels) {
        contents.fault =
            fmt::format("{} x {} texels are too many to show; 4096 x 4096 fit.", image.width, image.height);
        return contents;
    }
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) contents.texels.push_back(glm::floatBitsToUint(texelOf(image, x, y)));
    return contents;
}

} // namespace

void ResourceView::show(const scenes::Image& shown, std::string title) {
    show(std::move(title));
    image = std::make_shared<ResourceContents>(contentsOf(shown, name));
    fitsRange = false;
    isCurved = shown.format == scenes::TexelFormat::Rgba32Float; // integers are displayed as they are stored
}

double ResourceContents::number(std::size_t texel, int component) const {
    const std::uint32_t bits = texels[texel][component];
    return formatOf(*this).integer ? double(bits) : double(std::bit_cast<float>(bits));
}

std::string ResourceContents::text() const {
    if (!fault.empty()) return fmt::format("{}: {}", name, fault);
    if (!isTexture()) return fmt::format("{}: {} bytes", name, bytes);
    return fmt::format("{}: {} {}", name, formatOf(*this).name, graph::describeSize(desc));
}

std::string ResourceContents::texelText(glm::ivec2 texel) const {
    std::string text = fmt::format("({}, {}):", texel.x, texel.y);
    const std::size_t number = std::size_t(texel.y) * std::size_t(sizeTexels.x) + std::size_t(texel.x);
    for (int component = 0; component < formatOf(*this).components; ++component)
        text += formatOf(*this).integer ? fmt::format(" {}", texels[number][component])
                                        : fmt::format(" {:.6g}", this->number(number, component));
    return text;
}

ResourceView::Words ResourceContents::likelyWords() const {
    constexpr std::size_t kMostLooked = 4096;
    const std::size_t looked = std::min(words.size(), kMostLooked);
    std::size_t floats = 0, zeros = 0;
    for (std::size_t i = 0; i < looked; ++i) {
        const float magnitude = std::abs(std::bit_cast<float>(words[i]));
        floats += magnitude > 1e-9f && magnitude < 1e9f;
        zeros += words[i] == 0;
    }
    return floats > 0 && floats + zeros > looked - looked / 8 ? ResourceView::Words::Float
                                                              : ResourceView::Words::Unsigned;
}

std::string ResourceContents::wordText(std::uint32_t word, ResourceView::Words words) {
    switch (words) {
    case ResourceView::Words::Unsigned:
        return fmt::format("{}", word);
    case ResourceView::Words::Float:
        return fmt::format("{:.6g}", std::bit_cast<float>(word));
    case ResourceView::Words::Hexadecimal:
        break;
    }
    return fmt::format("{:08x}", word);
}

NumberRange rangeOf(const ResourceContents& contents, ResourceView::Channels channels) {
    const auto [first, end] = shownComponents(contents, channels);
    std::vector<double> numbers;
    numbers.reserve(contents.texels.size() * std::size_t(end - first));
    for (std::size_t texel = 0; texel < contents.texels.size(); ++texel)
        for (int component = first; component < end; ++component)
            if (const double number = contents.number(texel, component);
                std::isfinite(number) && !(formatOf(contents).depth && number == 0.0))
                numbers.push_back(number);
    if (numbers.empty()) return {};
    constexpr double kInRange = 0.995; // with the brightest highlights, the rest would be black
    const auto most = numbers.begin() + std::ptrdiff_t(std::ceil(kInRange * double(numbers.size() - 1)));
    std::nth_element(numbers.begin(), most, numbers.end());
    return {*std::min_element(numbers.begin(), most + 1), *most};
}

std::vector<glm::u8vec4> colorsOf(const ResourceContents& contents, ResourceView::Channels channels,
                                  const NumberRange& range, bool isCurved) {
    const auto [first, end] = shownComponents(contents, channels);
    const double span = range.most > range.least ? range.most - range.least : 1.0;
    std::vector<glm::u8vec4> colors(contents.texels.size(), glm::u8vec4(0, 0, 0, 255));
    for (std::size_t texel = 0; texel < colors.size(); ++texel) {
        glm::u8vec4& color = colors[texel];
        for (int component = first; component < end; ++component) {
            const double number = contents.number(texel, component);
            if (!std::isfinite(number)) {
                color = {255, 0, 255, 255};
                break;
            }
            const double share = std::clamp((number - range.least) / span, 0.0, 1.0);
            color[component - first] = std::uint8_t(std::lround(255.0 * (isCurved ? srgbFromLinear(share) : share)));
        }
        if (end - first == 1 && color != glm::u8vec4(255, 0, 255, 255)) color.y = color.z = color.x;
    }
    return colors;
}

} // namespace tessera::viewer
