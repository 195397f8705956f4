// Tone maps of saturated colours, compared with their authors' publications in double precision and in other forms: the
// ACES matrices follow from primaries, white points and desaturation, AgX's outset is the published inverse, Khronos's
// toe and shoulder are those of its text.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shaders/shared/display.h"
#include "tests/gpu/shaders/ShaderBench.h"

namespace tessera {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

/// Chromaticities of red, green, blue and white.
struct Gamut {
    dvec2 primaries[3];
    dvec2 white;
};
constexpr dvec2 kD65{0.3127, 0.3290}, kAcesWhite{0.32168, 0.33767};
constexpr Gamut kRec709{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}, kD65};
constexpr Gamut kAp1{{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}}, kAcesWhite};

dvec3 xyzOf(const dvec2& xy) {
    return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y};
}
/// XYZ from linear RGB. Source: SMPTE RP 177.
dmat3 xyzFrom(const Gamut& gamut) {
    const dmat3 p(xyzOf(gamut.primaries[0]), xyzOf(gamut.primaries[1]), xyzOf(gamut.primaries[2]));
    const dvec3 s = glm::inverse(p) * xyzOf(gamut.white);
    return {p[0] * s.x, p[1] * s.y, p[2] * s.z};
}
/// Source: Lam 1985 (Bradford), as the ACES transforms use it.
dmat3 adapted(const dvec2& from, const dvec2& to) {
    const dmat3 cone = glm::transpose(dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const dvec3 ratio = (cone * xyzOf(to)) / (cone * xyzOf(from));
    return glm::inverse(cone) * dmat3(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z) * cone;
}
/// Desaturates towards the luminance of AP1. Source: ACES 1.0, RRT_SAT_FACTOR = 0.96 and ODT_SAT_FACTOR = 0.93.
dmat3 saturation(double factor) {
    const dmat3 xyz = xyzFrom(kAp1);
    const dvec3 luminance(xyz[0].y, xyz[1].y, xyz[2].y);
    dmat3 m;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] = (1.0 - factor) * luminance[c] + (r == c ? factor : 0.0);
    return m;
}

/// Source: S. Hill 2017, whose matrices are these to five digits.
dmat3 acesIn() {
    return saturation(0.96) * glm::inverse(xyzFrom(kAp1)) * adapted(kD65, kAcesWhite) * xyzFrom(kRec709);
}
dmat3 acesOut() {
    return glm::inverse(xyzFrom(kRec709)) * adapted(kAcesWhite, kD65) * xyzFrom(kAp1) * saturation(0.93);
}
dmat3 toFiveDigits(dmat3 m) {
    for (int c = 0; c < 3; ++c) m[c] = glm::round(m[c] * 1e5) / 1e5;
    return m;
}
dvec3 aces(const dvec3& color) {
    static const dmat3 in = toFiveDigits(acesIn()), out = toFiveDigits(acesOut());
    dvec3 fit = in * color;
    for (int c = 0; c < 3; ++c) {
        const double v = fit[c];
        fit[c] = (v * v + 0.0245786 * v - 0.000090537) / (0.983729 * v * v + 0.4329510 * v + 0.238081);
    }
    return glm::clamp(out * fit, 0.0, 1.0);
}

/// Source: B. Wrensch 2023, "Minimal AgX Implementation": the inset, its curve, and the outset, rows first.
const dmat3 kAgxInset =
    glm::transpose(dmat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643, 0.0423282422610123,
                         0.878468636469772, 0.0791661274605434, 0.0423756549057051, 0.0784336, 0.879142973793104));
const dmat3 kAgxOutset = glm::transpose(dmat3(1.19687900512017, -0.0980208811401368, -0.0990297440797205,
                                              -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
                                              -0.0529716355144438, -0.0980434501171241, 1.15107367264116));
dvec3 agx(const dvec3& color) {
    constexpr double kSixthFirst[] = {15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232};
    constexpr double kLeastEv = -12.47393, kMostEv = 4.026069;
    dvec3 curve = kAgxInset * color;
    for (int c = 0; c < 3; ++c) {
        const double ev = curve[c] > 0.0 ? std::clamp(std::log2(curve[c]), kLeastEv, kMostEv) : kLeastEv;
        const double x = (ev - kLeastEv) / (kMostEv - kLeastEv);
        curve[c] = 0.0;
        for (int power = 6; power >= 0; --power) curve[c] += kSixthFirst[6 - power] * std::pow(x, power);
    }
    return glm::pow(glm::clamp(kAgxOutset * curve, 0.0, 1.0), dvec3(2.2));
}

/// Source: Khronos Group 2024, "PBR Neutral Tone Mapper", the formulas of its specification: F90 = 0.04, Ks = 0.8 - F90
/// and Kd = 0.15.
dvec3 khronosNeutral(const dvec3& color) {
    constexpr double kF90 = 0.04, kKs = 0.8 - kF90, kKd = 0.15;
    const double x = std::min({color.r, color.g, color.b});
    const double f = x <= 2.0 * kF90 ? x - x * x / (4.0 * kF90) : kF90;
    const double p = std::max({color.r, color.g, color.b}) - f;
    if (p <= kKs) return color - f;
    const double pn = 1.0 - (1.0 - kKs) * (1.0 - kKs) / (p + 1.0 - 2.0 * kKs);
    const double g = 1.0 / (kKd * (p - pn) + 1.0);
    return (color - f) * (pn / p) * g + pn * (1.0 - g);
}

dvec3 published(const dvec3& color, std::uint32_t curve) {
    return curve == TONEMAP_KHRONOS_NEUTRAL ? khronosNeutral(color)
           : curve == TONEMAP_ACES          ? aces(color)
           : curve == TONEMAP_AGX           ? agx(color)
                                            : color;
}

/// Source: IEC 61966-2-1.
double srgbCode(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::exp(std::log(c) / 2.4) - 0.055;
}

/// Primaries, their complements, skin, foliage, sky, flame and grey, from dark to far above white; and values around
/// the boundaries of piecewise formulas.
std::vector<dvec3> colours() {
    constexpr dvec3 kHues[] = {{1, 0, 0}, {0, 1, 0},          {0, 0, 1},          {1, 1, 0},          {0, 1, 1},
                               {1, 0, 1}, {0.46, 0.24, 0.16}, {0.12, 0.25, 0.05}, {0.15, 0.3, 0.8},   {1.0, 0.35, 0.06},
                               {1, 1, 1}, {0.9, 0.97, 1.0},   {1.0, 0.9, 0.94},   {0.02, 0.03, 0.025}};
    std::vector<dvec3> all;
    for (const dvec3& hue : kHues)
        for (const double scale : {0.0001, 0.001, 0.004, 0.006, 0.02, 0.1, 0.3, 0.7, 1.0, 1.8, 4.0, 13.0, 40.0, 500.0})
            all.push_back(hue * scale);
    // Khronos's toe ends at a smallest channel of 0.08, its shoulder begins at a largest of 0.76 above the toe.
    for (const double least : {0.0793, 0.0807})
        for (const double most : {0.1, 0.5, 0.793, 0.807}) all.push_back({most, least, 0.09});
    for (const double linear : {0.00311, 0.00315}) all.push_back(dvec3(linear)); // the piece below 0.0031308
    return all;
}

constexpr std::uint32_t kCurves[] = {TONEMAP_NONE, TONEMAP_KHRONOS_NEUTRAL, TONEMAP_ACES, TONEMAP_AGX};

class ToneMaps : public test::GlTest {
protected:
    /// The largest error of any channel of any colour, in units of the tolerance.
    static double worst(test::ShaderBench& bench) {
        const std::vector<dvec3> all = colours();
        double worst = 0.0;
        for (const std::uint32_t curve : kCurves) {
            std::vector<glm::vec4> inputs;
            for (const dvec3& color : all) inputs.emplace_back(glm::vec3(color), float(curve));
            const std::vector<glm::vec4> outputs = bench.run("test/tone_maps.comp", {}, inputs, inputs.size(), 2);
            for (std::size_t i = 0; i < all.size(); ++i) {
                const dvec3 color(inputs[i]);
                const dvec3 wanted = published(color, curve);
                for (int c = 0; c < 3; ++c) {
                    worst = std::max(worst, std::abs(outputs[2 * i][c] - wanted[c]) / allowed(curve, wanted[c]));
                    worst = std::max(worst, std::abs(outputs[2 * i + 1][c] - srgbCode(color[c])) / kPower);
                }
            }
        }
        return worst;
    }

private:
    /// Tolerance of codes: GLSL lets log2 be off by 2^-21 between 1/2 and 2 and exp2 by 3 units in the last place and
    /// more, so that pow with an exponent below 1 is off by some ten.
    static constexpr double kPower = 1.5e-6;
    /// Horner's sums of AgX's curve reach 25, where a rounding is 1e-6; two of these, times 2.2 for the power and 1.2
    /// for the outset. The others have ten or so roundings of values up to 1.
    static double allowed(std::uint32_t curve, double wanted) {
        return curve == TONEMAP_AGX ? 6e-6 : 6e-7 * std::max(wanted, 1.0);
    }
};

TEST_F(ToneMaps, saturatedColoursGetTheirPublishedValues) {
    test::ShaderBench bench;
    const double off = worst(bench);
    fmt::print("the worst is {:.3g} of the bound\n", off);
    EXPECT_LE(off, 1.0);
}

TEST_F(ToneMaps, thePublishedMatricesFollowFromTheirPrimaries) {
    // Hill's first and last coefficients, to the digits that he gives.
    EXPECT_EQ(toFiveDigits(acesIn())[0][0], 0.59719);
    EXPECT_EQ(toFiveDigits(acesIn())[2][2], 0.83777);
    EXPECT_EQ(toFiveDigits(acesOut())[0][0], 1.60475);
    EXPECT_EQ(toFiveDigits(acesOut())[2][2], 1.07602);
    // AgX moves the primaries a fifth of the way to white.
    Gamut inset = kRec709;
    for (dvec2& primary : inset.primaries) primary += 0.2 * (kD65 - primary);
    const dmat3 derived = glm::inverse(xyzFrom(kRec709)) * xyzFrom(inset);
    const dmat3 none = kAgxInset * kAgxOutset;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            EXPECT_NEAR(kAgxInset[c][r], derived[c][r], 2e-4) << "its author rounded XYZ-from-RGB to four digits";
            EXPECT_NEAR(none[c][r], c == r ? 1.0 : 0.0, 1e-14);
        }
    }
}

/// Positions and lengths of the numbers with a decimal point in the code, except zero.
std::vector<std::pair<std::size_t, std::size_t>> constantsIn(const std::string& code) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t at = 0; at < code.size();) {
        if (code.compare(at, 2, "//") == 0) {
            at = std::min(code.find('\n', at), code.size());
        } else if (std::isdigit(static_cast<unsigned char>(code[at]))) {
            const std::size_t end = std::min(code.find_first_not_of("0123456789.", at), code.size());
            const std::string number = code.substr(at, end - at);
            if (number.find('.') != std::string::npos && std::stod(number) != 0.0) found.emplace_back(at, end - at);
            at = end;
        } else {
            ++at;
        }
    }
    return found;
}

TEST_F(ToneMaps, everyConstantThatIsOffByOnePercentIsNoticed) {
    std::ifstream stream(test::shaderFolder() / "shared/tonemap.h");
    std::stringstream text;
    text << stream.rdbuf();
    const std::string code = text.str();
    const auto constants = constantsIn(code);
    EXPECT_GT(constants.size(), 50u);
    for (const auto& [at, length] : constants) {
        const std::string number = code.substr(at, length);
        std::string changed = code;
        changed.replace(at, length, fmt::format("{:.15f}", 1.01 * std::stod(number)));
        test::ShaderBench bench(
            [&](const std::filesystem::path& sources) { std::ofstream(sources / "shared/tonemap.h") << changed; });
        EXPECT_GT(worst(bench), 1.0) << number << " in line "
                                     << std::count(code.begin(), code.begin() + long(at), '\n') + 1;
    }
}

} // namespace
} // namespace tessera
