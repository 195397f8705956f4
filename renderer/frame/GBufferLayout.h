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

/// The G-buffer as a table of channels. The table drives textures, shader defines (`put` and `take` functions per
/// channel in shaders/lib/gbuffer/gbuffer_channels.glsl), plans, the derived error bounds and the error attribution. A
/// second table lists the flag bits stored beside the channels.
namespace tessera::frame {

/// A frame needs at most eight channels, the number of colour attachments that OpenGL guarantees.
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

/// Bits of a channel's fields, in the order of ChannelInfo::fields; 0 after the last.
using FieldWidths = std::array<std::uint8_t, 4>;

struct ChannelInfo {
    Channel channel;
    std::string_view name;   ///< as in plans: "albedo"
    std::string_view define; ///< GBUFFER_<define>
    std::string_view meaning;
    std::string_view fields; ///< names of the fields that the widths refer to
    FieldWidths packed;
    FieldWidths slim;
    std::string_view needed; ///< which scenes need it, in words
    bool ofMaterial;         ///< is constant over a surface unless its material varies
    bool isDirection;        ///< its first three exact components are a unit vector
    /// Whether scenes with these features need it. `normalTexel`: the frame displays the texels of normal maps.
    bool (*isNeeded)(const FeatureSet& features, bool normalTexel);
};
std::span<const ChannelInfo> channelTable();

/// The encoding of each channel. `Exact` channels have their own RGBA32F texture, unless pixels store material numbers;
/// the fields of the others are packed into 32-bit words, in table order. The encoding of a channel does not depend on
/// the other channels, so that omitting one leaves the image bit-identical.
struct GBufferLayout {
    std::array<Encoding, kChannelCount> encoding{};

    Encoding operator[](Channel channel) const { return encoding[static_cast<std::size_t>(channel)]; }
    const FieldWidths& widths(Channel channel) const; ///< of a channel that is not exact
    bool operator==(const GBufferLayout&) const = default;
};

/// Error bounds of a layout's images against `exact`; derived in docs/numerics.md.
struct LayoutPromise {
    double relMse;  ///< at most
    double p999Rel; ///< bound of the relative difference of 99.9 % of the pixels
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
/// The first row: deferred images are bit-identical to forward.
const LayoutInfo& exactLayout();

/// Error bounds of a layout, named or mixed: those of its coarsest channel.
const LayoutPromise& promiseOf(const GBufferLayout& layout);

/// The channels that surfaces with these features need, in table order. `normalTexel` is for the view that displays it,
/// which needs no tangents, coats and sheens.
///  - If no material varies and every channel of materials would be exact, these are omitted: two words hold the
///    normal's code and the material's number, and lighting reads its values from the table of all materials.
///  - Else, if all surfaces are metallic_roughness with the default specular lobe, alpha and metallic go into the
///    unused fourth components (fp32) of albedo and normal, and the microsurface channel is omitted.
std::vector<Channel> neededChannels(const FeatureSet& features, const GBufferLayout& layout, bool normalTexel);

/// Whether pixels store material numbers in place of material channels.
bool holdMaterialNumber(const GBufferLayout& layout, std::span<const Channel> channels);

struct GBufferTexture {
    std::string name; ///< the channel's name, or "words", "words 4 to 5"
    graph::Format format;
    bool operator==(const GBufferTexture&) const = default;
};
/// The textures of the channels, by attachment: the exact ones, then the words, four, two or one per texture.
std::vector<GBufferTexture> gbufferTextures(const GBufferLayout& layout, std::span<const Channel> channels);
int bytesPerPixel(const GBufferLayout& layout, std::span<const Channel> channels); ///< without depth

/// Flag bits that pixels store beside the channels: small integers that no layout rounds.
enum class Mark : std::uint8_t { Facets, Lift, Subsurface, Occlusion, Count };
inline constexpr std::size_t kMarkCount = static_cast<std::size_t>(Mark::Count);

struct MarkInfo {
    Mark mark;
    std::string_view name;   ///< as in plans: "facets"
    std::string_view define; ///< GBUFFER_<define>
    std::string_view meaning;
    int bits;
    /// The channel whose fourth exact component stores it if the channels take all attachments.
    Channel beside;
    std::string_view needed; ///< which scenes need it, in words
    bool ofMaterial;         ///< implied by the material number where pixels store one
    bool (*isNeeded)(const FeatureSet& features);
};
std::span<const MarkInfo> markTable();

/// The flag bits that surfaces with these features need beside the channels, in table order.
std::vector<Mark> neededMarks(const FeatureSet& features, const GBufferLayout& layout,
                              std::span<const Channel> channels);
/// The attachment of the flag bits, after those of the channels, with one or two words. None without flag bits or if
/// the channels take all attachments.
std::optional<GBufferTexture> markTexture(const GBufferLayout& layout, std::span<const Channel> channels,
                                          std::span<const Mark> marks);
/// GBUFFER_MARKS is that attachment. GBUFFER_MARK_LIST lists the flags for shaders/lib/gbuffer/gbuffer_marks.glsl, each
/// with its two functions, first bit and width; GBUFFER_<NAME> is the first bit. Flags stored in a channel are
/// GBUFFER_<NAME>_IN_<CHANNEL> instead.
Defines markDefines(const GBufferLayout& layout, std::span<const Channel> channels, std::span<const Mark> marks);

/// Attachment and encoding of the stored normals.
struct StoredNormals {
    std::size_t attachment = 0;
    culling::NormalEncoding encoding;
};
std::optional<StoredNormals> storedNormals(const GBufferLayout& layout, std::span<const Channel> channels);

/// GBUFFER_CHANNELS lists the channels for shaders/lib/gbuffer/gbuffer_channels.glsl, each with its two functions and
/// its place. GBUFFER_<NAME> is an exact channel's attachment, or the first bit of another channel's fields, whose
/// widths are GBUFFER_<NAME>_WIDTHS. GBUFFER_EXACT_CHANNELS and GBUFFER_WORDS count exact channels and words;
/// GBUFFER_WORD_TEXTURE is the first attachment with words. GBUFFER_SPARE_COMPONENTS: alpha and metallic are in fourth
/// components of other channels. GBUFFER_MATERIAL_NUMBER: the material's number follows the normal's code.
Defines channelDefines(const GBufferLayout& layout, std::span<const Channel> channels);

} // namespace tessera::frame
