#include "tests/support/GBufferBounds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "shaders/shared/models.h"

namespace tessera::frame {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

int largestCode(int width) {
    return (1 << width) - 1;
}
double share(int width) {
    return 1.0 / largestCode(width);
}
/// One step of a square root; the number of steps is the largest multiple of 5 that fits.
double root(int width) {
    return 1.0 / (largestCode(width) / 5 * 5);
}
double fourthRootOfAlpha(int width) {
    return share(width) * (1.0 - std::pow(ALPHA_MIN, 0.25));
}
/// A step d = 2/(2^width - 2) of both coordinates moves a point of the octahedron |x| + |y| + |z| = 1 by at most
/// sqrt(6) d, and the octahedron's points are at least 1/sqrt(3) from its centre.
double octahedralDegrees(int width) {
    return std::sqrt(18.0) * 2.0 / (largestCode(width) - 1) * kDegrees;
}
/// A tangent tilts as far as its normal, and rotates about it by half its step and with the frame that the decoder
/// builds from an inexact normal: by up to tan 35.3 degrees = sqrt(1/2) of the normal's error, 35.3 degrees being the
/// normal's largest elevation over the plane perpendicular to the axis farthest from it. Half a step of the diamond
/// rotates most at the middle of a side, where it counts twice.
double tangentDegrees(const FieldWidths& tangent, const FieldWidths& normal) {
    const double lean = octahedralDegrees(normal[0]);
    const double turn = 2.0 / (largestCode(tangent[1]) - 1) * kDegrees + std::sqrt(0.5) * lean;
    return std::hypot(lean, turn);
}
double contrastOfIor(int width) {
    return 2.0 / (largestCode(width) / 10 * 10);
}
/// 8 bits hold the exponent; the mantissa has the rest and a leading 1.
double relativeOfFloat(int width) {
    return std::ldexp(1.0, -(width - 8));
}
/// Error relative to the largest colour. A step is 2^(exponent - width), and the largest colour is at least 2^(exponent
/// - 1), or is rounded up to it from less than a step below, in steps of the next lower exponent.
double relativeOfSharedExponent(const FieldWidths& widths, std::size_t color) {
    const int coarsest = std::min({widths[1], widths[2], widths[3]});
    return std::ldexp(2.0, -widths[color]) / (1.0 - std::ldexp(1.0, -coarsest));
}
const FieldWidths& widthsIn(Encoding encoding, Channel channel) {
    const ChannelInfo& info = channelTable()[static_cast<std::size_t>(channel)];
    return encoding == Encoding::Packed ? info.packed : info.slim;
}

} // namespace

std::vector<FieldBound> fieldBounds(Encoding encoding) {
    assert(encoding != Encoding::Exact);
    const auto widths = [encoding](Channel channel) -> const FieldWidths& { return widthsIn(encoding, channel); };
    std::vector<FieldBound> bounds;
    const auto roots = [&](Channel channel) {
        constexpr std::string_view kNames[] = {"square root of red", "square root of green", "square root of blue"};
        for (std::size_t i = 0; i < 3; ++i) bounds.push_back({channel, kNames[i], "", root(widths(channel)[i])});
    };
    roots(Channel::Albedo);
    bounds.push_back({Channel::Normal, "direction", "degrees", octahedralDegrees(widths(Channel::Normal)[0])});

    const FieldWidths& micro = widths(Channel::Microsurface);
    bounds.push_back({Channel::Microsurface, "fourth root of alpha", "", fourthRootOfAlpha(micro[1])});
    bounds.push_back({Channel::Microsurface, "(ior-1)/(ior+1)", "", contrastOfIor(micro[2] + micro[3])});
    bounds.push_back({Channel::Microsurface, "F90", "", share(micro[2])});
    bounds.push_back({Channel::Microsurface, "metallic", "", share(micro[3])});
    bounds.push_back(
        {Channel::Microsurface, "exponent", "of its value", relativeOfFloat(micro[1] + micro[2] + micro[3])});
    roots(Channel::Specular);
    constexpr std::string_view kColours[] = {"red", "green", "blue"};
    for (std::size_t i = 0; i < 3; ++i) {
        bounds.push_back({Channel::Emission, kColours[i], "of the largest colour",
                          relativeOfSharedExponent(widths(Channel::Emission), i + 1)});
    }
    const FieldWidths& tangent = widths(Channel::Tangent);
    bounds.push_back({Channel::Tangent, "direction", "degrees", tangentDegrees(tangent, widths(Channel::Normal))});
    bounds.push_back({Channel::Tangent, "fourth root of alpha", "", fourthRootOfAlpha(tangent[2])});
    const FieldWidths& coat = widths(Channel::Clearcoat);
    bounds.push_back({Channel::Clearcoat, "direction", "degrees", 0.5 * octahedralDegrees(coat[0])});
    bounds.push_back({Channel::Clearcoat, "share", "", share(coat[2])});
    bounds.push_back({Channel::Clearcoat, "fourth root of alpha", "", fourthRootOfAlpha(coat[3])});
    roots(Channel::Sheen);
    bounds.push_back({Channel::Sheen, "fourth root of alpha", "", fourthRootOfAlpha(widths(Channel::Sheen)[3])});
    for (std::size_t i = 0; i < 3; ++i)
        bounds.push_back({Channel::NormalTexel, kColours[i], "", share(widths(Channel::NormalTexel)[i])});
    return bounds;
}

RadianceRange radianceRange(Encoding encoding) {
    assert(encoding != Encoding::Exact);
    const FieldWidths& widths = widthsIn(encoding, Channel::Emission);
    const int top = (1 << (widths[0] - 1)) + 4; // equals topExponent() of shaders/lib/gbuffer/gbuffer_encodings.glsl
    return {std::ldexp(1.0, top - largestCode(widths[0]) - 1), std::ldexp(1.0 - std::ldexp(1.0, -widths[1]), top)};
}

} // namespace tessera::frame
