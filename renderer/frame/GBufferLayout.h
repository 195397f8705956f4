#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/Features.h"
#include "renderer/graph/Format.h"

/// The G-buffer as a table of channels. The table drives textures, shader defines (encoder and decoder in
/// shaders/lib/gbuffer.glsl), plans and the error attribution.
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

enum class Encoding : std::uint8_t { Exact, Packed };

struct ChannelInfo {
    Channel channel;
    std::string_view name;   ///< as in plans: "albedo"
    std::string_view define; ///< GBUFFER_<define>
    std::string_view meaning;
    graph::Format exact;
    graph::Format packed;
    std::string_view packedEncoding; ///< in words
    std::string_view needed;         ///< which scenes need it
};
std::span<const ChannelInfo> channelTable();

/// One encoding for every channel. `exact` keeps fp32; `packed` takes 12 bytes a pixel, 16 where materials change the
/// specular colour, and 4 more where some emit, 4 where some are anisotropic, 8 where some are coated and 4 where some
/// have a sheen; depth comes on top.
struct GBufferLayout {
    std::array<Encoding, kChannelCount> encoding{};

    Encoding operator[](Channel channel) const { return encoding[static_cast<std::size_t>(channel)]; }
    graph::Format format(Channel channel) const;
    bool operator==(const GBufferLayout&) const = default;
};

struct LayoutInfo {
    std::string_view name;
    std::string_view summary;
    GBufferLayout layout;
};
/// The named layouts, `exact` first.
std::span<const LayoutInfo> layoutTable();

/// The channels that surfaces of these features need, in table order: attachment i is element i. `normalTexel` is for
/// the view that shows it, and shows nothing of tangents, coats and sheens. In fp32 the fourth components of albedo and
/// normal are free: alpha and metallic go there, and the microsurface channel is left out, where all surfaces are
/// metallic_roughness with the usual specular lobe.
std::vector<Channel> neededChannels(const FeatureSet& features, const GBufferLayout& layout, bool normalTexel);

/// GBUFFER_<NAME> = attachment and GBUFFER_<NAME>_PACKED = 0 or 1 of each channel; GBUFFER_SPARE_COMPONENTS where alpha
/// and metallic lie in the fourth components of others.
Defines channelDefines(const GBufferLayout& layout, std::span<const Channel> channels);

} // namespace tessera::frame
