#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/culling/SurfacePictures.h"
#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "renderer/graph/Format.h"

/// The G-buffer as a table of channels. The table drives textures, shader defines (a `put` and a `take` a channel in
/// shaders/lib/gbuffer/gbuffer_channels.glsl), plans, the derived error bounds and the error attribution. A second
/// table lists the marks that lie beside them.
namespace tessera::frame {

/// A frame needs at most eight of them, which is what OpenGL guarantees to draw into at once.
enum class Channel : std::uint8_t {
    Albedo,
    Normal,
    Microsurface,
    Specular,
    Emission,
    Tangent,
    Clearcoat,
    Sheen,
    NormalTexel,
    Count
};
inline constexpr std::size_t kChannelCount = static_cast<std::size_t>(Channel::Count);

enum class Encoding : std::uint8_t { Exact, Packed, Slim };

/// Bits of a channel's fields, in the order of ChannelInfo::fields; 0 behind the last.
using FieldWidths = std::array<std::uint8_t, 4>;

struct ChannelInfo {
    Channel channel;
    std::string_view name;   ///< as in plans: "albedo"
    std::string_view define; ///< GBUFFER_<define>
    std::string_view meaning;
    std::string_view fields; ///< what the widths are of
    FieldWidths packed;
    FieldWidths slim;
    std::string_view needed; ///< which scenes need it, in words
    bool ofMaterial;         ///< is constant over a surface unless its material varies
    bool isDirection;        ///< its first three exact components are a unit vector
    /// Whether scenes of these features need it, in frames that show the texels of normal maps or not.
    bool (*isNeeded)(const FeatureSet& features, bool normalTexel);
};
std::span<const ChannelInfo> channelTable();

/// The encoding of each channel. Channels that are `Exact` have an RGBA32F texture of their own, unless pixels hold the
/// number of their material; the fields of the others lie end to end in 32-bit words, in table order. How a channel is
/// encoded never depends on which others there are, so that leaving one out changes no bit of the picture.
struct GBufferLayout {
    std::array<Encoding, kChannelCount> encoding{};

    Encoding operator[](Channel channel) const { return encoding[static_cast<std::size_t>(channel)]; }
    const FieldWidths& widths(Channel channel) const; ///< of a channel that is not exact
    bool operator==(const GBufferLayout&) const = default;
};

/// What pictures of a layout are held to against `exact`; derived in docs/numerics.md.
struct LayoutPromise {
    double relMse;  ///< at most
    double p999Rel; ///< 99.9 % of the pixels differ by no more, relatively
    double bias;    ///< at most, of its magnitude
    bool operator==(const LayoutPromise&) const = default;
};

struct LayoutInfo {
    std::string_view name;
    std::string_view summary;
    GBufferLayout layout;
    LayoutPromise promise;
};
/// The named layouts, `exact` first.
std::span<const LayoutInfo> layoutTable();
/// The first row: deferred lights what forward does, to the last bit.
const LayoutInfo& exactLayout();

/// What the pictures of a layout, named or mixed, are held to: the promise of its coarsest channel.
const LayoutPromise& promiseOf(const GBufferLayout& layout);

/// The channels that surfaces of these features need, in table order. `normalTexel` is for the view that shows it, and
/// shows nothing of tangents, coats and sheens.
///  - Where no material varies and every channel of materials would be exact, these are left out: two words hold the
///    normal's code and the material's number, and lighting reads its values from the table of all materials.
///  - Else alpha and metallic go into the fourth components of albedo and normal, which are free in fp32, and the
///    microsurface channel is left out, where all surfaces are metallic_roughness with the usual specular lobe.
std::vector<Channel> neededChannels(const FeatureSet& features, const GBufferLayout& layout, bool normalTexel);

/// Whether these channels leave a pixel's material to the table of all materials.
bool holdMaterialNumber(const GBufferLayout& layout, std::span<const Channel> channels);

struct GBufferTexture {
    std::string name; ///< that of its channel, or "words", "words 4 to 5"
    graph::Format format;
    bool operator==(const GBufferTexture&) const = default;
};
/// What the channels are stored in; attachment i is element i: the exact ones, then the words, four, two or one a
/// texture.
std::vector<GBufferTexture> gbufferTextures(const GBufferLayout& layout, std::span<const Channel> channels);
int bytesPerPixel(const GBufferLayout& layout, std::span<const Channel> channels); ///< without depth

/// What pixels hold beside the channels, in whole numbers of few bits that no layout rounds.
enum class Mark : std::uint8_t { Facets, Lift, Subsurface, Occlusion, Count };
inline constexpr std::size_t kMarkCount = static_cast<std::size_t>(Mark::Count);

struct MarkInfo {
    Mark mark;
    std::string_view name;   ///< as in plans: "facets"
    std::string_view define; ///< GBUFFER_<define>
    std::string_view meaning;
    int bits;
    /// Where the channels take all attachments: that of which the fourth exact component holds it.
    Channel beside;
    std::string_view needed; ///< which scenes need it, in words
    bool ofMaterial;         ///< where pixels hold the number of their material, that says it
    bool (*isNeeded)(const FeatureSet& features);
};
std::span<const MarkInfo> markTable();

/// Those that surfaces of these features need beside the channels, in table order.
std::vector<Mark> neededMarks(const FeatureSet& features, const GBufferLayout& layout,
                              std::span<const Channel> channels);
/// The attachment behind those of the channels that holds them, in one word or two; none where there are no marks, or
/// the channels take all attachments.
std::optional<GBufferTexture> markTexture(const GBufferLayout& layout, std::span<const Channel> channels,
                                          std::span<const Mark> marks);
/// GBUFFER_MARKS is that attachment, GBUFFER_MARK_LIST lists the marks for shaders/lib/gbuffer/gbuffer_marks.glsl, each
/// with its two functions, its first bit and how many it has; GBUFFER_<NAME> is the first bit. Marks that lie beside a
/// channel are GBUFFER_<NAME>_IN_<CHANNEL> instead.
Defines markDefines(const GBufferLayout& layout, std::span<const Channel> channels, std::span<const Mark> marks);

/// Where the normals of surfaces are stored, if they are.
struct StoredNormals {
    std::size_t attachment = 0;
    culling::NormalEncoding encoding;
};
std::optional<StoredNormals> storedNormals(const GBufferLayout& layout, std::span<const Channel> channels);

/// GBUFFER_CHANNELS lists the channels for shaders/lib/gbuffer/gbuffer_channels.glsl, each with its two functions and
/// its place. Of an exact one GBUFFER_<NAME> is its attachment, of others the bit where its fields begin and
/// GBUFFER_<NAME>_WIDTHS their widths. GBUFFER_EXACT_CHANNELS is the number of exact ones, GBUFFER_WORDS of words and
/// GBUFFER_WORD_TEXTURE the attachment of the first. GBUFFER_SPARE_COMPONENTS where alpha and metallic lie in the
/// fourth components of others, GBUFFER_MATERIAL_NUMBER where the material's number follows the normal's code.
Defines channelDefines(const GBufferLayout& layout, std::span<const Channel> channels);

} // namespace tessera::frame
