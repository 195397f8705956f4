#include "renderer/frame/GBufferLayout.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "shaders/shared/material.h"
#include "shaders/shared/normals.h"

namespace tessera::frame {

namespace {

using graph::Format;

/// Colour attachments that OpenGL guarantees.
constexpr std::size_t kMostAttachments = 8;

const ChannelInfo& infoOf(Channel channel) {
    return channelTable()[static_cast<std::size_t>(channel)];
}
const MarkInfo& infoOf(Mark mark) {
    return markTable()[static_cast<std::size_t>(mark)];
}

/// The first bit of each flag, in order, so that no flag crosses a word; then the end of the last one.
std::vector<int> firstBits(std::span<const Mark> marks) {
    std::vector<int> bits{0};
    for (const Mark mark : marks) {
        const int width = infoOf(mark).bits;
        int& first = bits.back();
        if (first / 32 != (first + width - 1) / 32) first = (first / 32 + 1) * 32;
        bits.push_back(first + width);
    }
    return bits;
}

/// A channel's name as in its functions' names: "NormalTexel".
std::string capitalised(std::string_view name) {
    std::string words;
    bool begins = true;
    for (const char c : name) {
        if (c != '_') words += begins ? char(c - 'a' + 'A') : c;
        begins = c == '_';
    }
    return words;
}

bool haveSpareComponents(const GBufferLayout& layout) {
    return layout[Channel::Albedo] == Encoding::Exact && layout[Channel::Normal] == Encoding::Exact;
}

bool contain(std::span<const Channel> channels, Channel channel) {
    return std::find(channels.begin(), channels.end(), channel) != channels.end();
}

/// Fields of the normal with material numbers: the normal code that all techniques light, and the number.
constexpr FieldWidths kNormalAndNumber{NORMAL_SHARE_BITS, NORMAL_SHARE_BITS, NORMAL_AXIS_BITS, 11};
static_assert(MATERIAL_TABLE_MOST <= 1 << kNormalAndNumber[3]);

/// The fields of a channel in words; all 0 if it has its own texture.
FieldWidths fieldsOf(const GBufferLayout& layout, std::span<const Channel> channels, Channel channel) {
    if (layout[channel] != Encoding::Exact) return layout.widths(channel);
    return channel == Channel::Normal && holdMaterialNumber(layout, channels) ? kNormalAndNumber : FieldWidths{};
}

int bitsOf(const FieldWidths& fields) {
    return std::accumulate(fields.begin(), fields.end(), 0);
}

/// Where a channel is stored: in its own texture, or at a bit of the words.
struct Place {
    Channel channel;
    FieldWidths fields; ///< in words
    bool hasOwnTexture;
    int at; ///< attachment of its own texture, or bit
};
struct Places {
    std::vector<Place> channels;
    int textures = 0; ///< of exact channels; those of words follow
    int words = 0;

    const Place* find(Channel channel) const {
        const auto found = std::ranges::find(channels, channel, &Place::channel);
        return found == channels.end() ? nullptr : &*found;
    }
};
Places placesOf(const GBufferLayout& layout, std::span<const Channel> channels) {
    Places places;
    int bits = 0;
    for (const Channel channel : channels) {
        const FieldWidths fields = fieldsOf(layout, channels, channel);
        const int width = bitsOf(fields);
        places.channels.push_back({channel, fields, width == 0, width == 0 ? places.textures++ : bits});
        bits += width;
    }
    places.words = (bits + 31) / 32;
    return places;
}

bool canHoldMaterialNumber(const GBufferLayout& layout) {
    return layout[Channel::Normal] == Encoding::Exact &&
           std::ranges::all_of(channelTable(), [&](const ChannelInfo& info) {
               return !info.ofMaterial || layout[info.channel] == Encoding::Exact;
           });
}

/// The channels without material numbers: pixels store their whole surface.
std::vector<Channel> channelsOfSurfaces(const FeatureSet& features, const GBufferLayout& layout, bool normalTexel) {
    const bool alphaAndMetallicOnly =
        features.soleModel &&
        scenes::infoOf(*features.soleModel).microsurface == scenes::Microsurface::MetallicRoughness &&
        !features[Feature::Specular];
    const bool spare =
        alphaAndMetallicOnly && haveSpareComponents(layout) && layout[Channel::Microsurface] == Encoding::Exact;
    std::vector<Channel> channels;
    for (const ChannelInfo& row : channelTable()) {
        if (row.channel == Channel::Microsurface && spare) continue;
        if (row.isNeeded(features, normalTexel)) channels.push_back(row.channel);
    }
    return channels;
}

} // namespace

const LayoutInfo& exactLayout() {
    return layoutTable().front();
}

const LayoutPromise& promiseOf(const GBufferLayout& layout) {
    const Encoding coarsest = *std::max_element(layout.encoding.begin(), layout.encoding.end());
    return layoutTable()[static_cast<std::size_t>(coarsest)].promise;
}

const FieldWidths& GBufferLayout::widths(Channel channel) const {
    assert((*this)[channel] != Encoding::Exact);
    return (*this)[channel] == Encoding::Packed ? infoOf(channel).packed : infoOf(channel).slim;
}

std::vector<Channel> neededChannels(const FeatureSet& features, const GBufferLayout& layout, bool normalTexel) {
    std::vector<Channel> channels = channelsOfSurfaces(features, layout, normalTexel);
    if (features.litModels() && !features[Feature::VaryingMaterials] && canHoldMaterialNumber(layout))
        std::erase_if(channels, [](Channel channel) { return infoOf(channel).ofMaterial; });
    return channels;
}

bool holdMaterialNumber(const GBufferLayout& layout, std::span<const Channel> channels) {
    return layout[Channel::Normal] == Encoding::Exact && contain(channels, Channel::Normal) &&
           !contain(channels, Channel::Albedo);
}

std::vector<GBufferTexture> gbufferTextures(const GBufferLayout& layout, std::span<const Channel> channels) {
    const Places places = placesOf(layout, channels);
    std::vector<GBufferTexture> textures;
    for (const Place& place : places.channels)
        if (place.hasOwnTexture) textures.push_back({std::string(infoOf(place.channel).name), Format::Rgba32Float});
    for (int word = 0; word < places.words;) {
        const int left = places.words - word;
        const int held = left >= 4 ? 4 : left >= 2 ? 2 : 1;
        textures.push_back({word == 0   ? std::string("words")
                            : held == 1 ? fmt::format("words {}", word)
                                        : fmt::format("words {} to {}", word, word + held - 1),
                            held == 4   ? Format::Rgba32Uint
                            : held == 2 ? Format::Rg32Uint
                                        : Format::R32Uint});
        word += held;
    }
    return textures;
}

int bytesPerPixel(const GBufferLayout& layout, std::span<const Channel> channels) {
    int bytes = 0;
    for (const GBufferTexture& texture : gbufferTextures(layout, channels))
        bytes += graph::formatInfo(texture.format).bytes;
    return bytes;
}

std::optional<StoredNormals> storedNormals(const GBufferLayout& layout, std::span<const Channel> channels) {
    const Places places = placesOf(layout, channels);
    const Place* const normal = places.find(Channel::Normal);
    if (!normal) return {};
    if (normal->hasOwnTexture) return StoredNormals{std::size_t(normal->at), {culling::NormalForm::Vector}};
    StoredNormals stored{std::size_t(places.textures), {}}; // the first with words
    if (holdMaterialNumber(layout, channels)) return stored;
    stored.encoding = {culling::NormalForm::Octahedral, unsigned(normal->at), normal->fields[0]};
    return stored;
}

std::vector<Mark> neededMarks(const FeatureSet& features, const GBufferLayout& layout,
                              std::span<const Channel> channels) {
    const bool haveMaterials = !channels.empty() && !holdMaterialNumber(layout, channels);
    std::vector<Mark> marks;
    for (const MarkInfo& row : markTable())
        if (row.isNeeded(features) && (!row.ofMaterial || haveMaterials)) marks.push_back(row.mark);
    return marks;
}

std::optional<GBufferTexture> markTexture(const GBufferLayout& layout, std::span<const Channel> channels,
                                          std::span<const Mark> marks) {
    if (marks.empty() || gbufferTextures(layout, channels).size() >= kMostAttachments) return {};
    std::string name;
    for (const Mark mark : marks) name += (name.empty() ? "" : " and ") + std::string(infoOf(mark).name);
    const int words = (firstBits(marks).back() + 31) / 32;
    assert(words <= 2);
    return GBufferTexture{name, words == 2 ? Format::Rg32Uint : Format::R32Uint};
}

Defines markDefines(const GBufferLayout& layout, std::span<const Channel> channels, std::span<const Mark> marks) {
    Defines defines;
    if (!markTexture(layout, channels, marks)) {
        for (const Mark mark : marks)
            defines.emplace_back(
                fmt::format("GBUFFER_{}_IN_{}", infoOf(mark).define, infoOf(infoOf(mark).beside).define), "1");
        return defines;
    }
    const std::vector<int> bits = firstBits(marks);
    std::string list;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const MarkInfo& info = infoOf(marks[i]);
        defines.emplace_back("GBUFFER_" + std::string(info.define), std::to_string(bits[i]));
        list += fmt::format("{}MARK(codeOf{}, take{}, {}, {})", list.empty() ? "" : " ", capitalised(info.name),
                            capitalised(info.name), bits[i], info.bits);
    }
    defines.emplace_back("GBUFFER_MARKS", std::to_string(gbufferTextures(layout, channels).size()));
    defines.emplace_back("GBUFFER_MARK_LIST", list);
    return defines;
}

Defines channelDefines(const GBufferLayout& layout, std::span<const Channel> channels) {
    if (channels.empty()) return {};
    Defines defines;
    std::string list;
    const Places places = placesOf(layout, channels);
    for (const Place& place : places.channels) {
        const ChannelInfo& info = infoOf(place.channel);
        const FieldWidths& w = place.fields;
        const std::string name = "GBUFFER_" + std::string(info.define);
        const std::string widths = fmt::format("{}, {}, {}, {}", w[0], w[1], w[2], w[3]);
        defines.emplace_back(name, std::to_string(place.at));
        if (!place.hasOwnTexture) defines.emplace_back(name + "_WIDTHS", widths);
        const std::string functions = fmt::format("put{0}, take{0}", capitalised(info.name));
        list += list.empty() ? "" : " ";
        list += place.hasOwnTexture ? fmt::format("EXACT_CHANNEL({}, {})", functions, place.at)
                                    : fmt::format("PACKED_CHANNEL({}, {}, ivec4({}))", functions, place.at, widths);
    }
    defines.emplace_back("GBUFFER_CHANNELS", list);
    defines.emplace_back("GBUFFER_EXACT_CHANNELS", std::to_string(places.textures));
    defines.emplace_back("GBUFFER_WORDS", std::to_string(places.words));
    if (places.words > 0) defines.emplace_back("GBUFFER_WORD_TEXTURE", std::to_string(places.textures));
    if (holdMaterialNumber(layout, channels))
        defines.emplace_back("GBUFFER_MATERIAL_NUMBER", "1");
    else if (contain(channels, Channel::Albedo) && !contain(channels, Channel::Microsurface) &&
             haveSpareComponents(layout))
        defines.emplace_back("GBUFFER_SPARE_COMPONENTS", "1");
    return defines;
}

} // namespace tessera::frame
